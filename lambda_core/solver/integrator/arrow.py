"""Linear algebra of the block-arrow matrix M = s I - g J: factor and solve in O(Z).

The blocks of a ball hold the columns of its own bodies alone (:mod:`.reach`). What the balls of a row take from the
Schur complement is summed in a matrix of that size, which is taken out of the whole one and put back.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numba import types

from lambda_core.solver.integrator.reach import Reach
from lambda_core.solver.layout import NB, array1, array2, array3, helper, iarray1
from lambda_core.solver.lu import lu_factor, lu_solve


class Factors(NamedTuple):
    """LU factors of the ball blocks and of the Schur complement."""

    lu: Any  # (Z, 9, 9)
    pivots: Any  # int64 (9 Z,)
    x: Any  # (Z, 9, widest): A_j^-1 B_j
    c: Any  # (Z, widest, 9): the scaled C_j
    schur: Any  # (n, n)
    schur_pivots: Any  # int64 (n,)
    own: Any  # (widest, widest): what one row of balls has of the Schur complement
    tail: Any  # (widest,): and of the shared part of a right-hand side


factors_t = types.NamedTuple([array3, iarray1, array3, array3, array2, iarray1, array2, array1], Factors)


def make_factors(reach: Reach, n: int) -> Factors:
    """Allocate for the rows of balls that `reach` describes and n shared states."""
    balls, widest = int(reach.first[-1]), reach.columns.shape[1]
    return Factors(
        np.zeros((balls, NB, NB)),
        np.zeros(NB * balls, dtype=np.int64),
        np.zeros((balls, NB, widest)),
        np.zeros((balls, widest, NB)),
        np.zeros((n, n)),
        np.zeros(n, dtype=np.int64),
        np.zeros((widest, widest)),
        np.zeros(widest),
    )


@helper
def _solve_rows(m, pivots, b, n):
    """Solve m X = b for the first n columns of b (9, ...) in place, row by row so that the inner loop runs along n."""
    size = b.shape[0]
    for k in range(size):
        row = pivots[k]
        if row != k:
            for c in range(n):
                b[k, c], b[row, c] = b[row, c], b[k, c]
    for i in range(1, size):
        for k in range(i):
            f = m[i, k]
            if f != 0.0:
                for c in range(n):
                    b[i, c] -= f * b[k, c]
    for i in range(size - 1, -1, -1):
        for k in range(i + 1, size):
            f = m[i, k]
            if f != 0.0:
                for c in range(n):
                    b[i, c] -= f * b[k, c]
        inverse = 1.0 / m[i, i]
        for c in range(n):
            b[i, c] *= inverse


@helper
def _factor_ball(bl, j, shift, gamma, fa, own, n):
    """Factor the block of ball j and take its share, of n columns, from `own`; returns 0 when singular."""
    lu, x, c = fa.lu[j], fa.x[j], fa.c[j]
    pivots = fa.pivots[NB * j : NB * j + NB]
    for i in range(NB):
        for k in range(NB):
            lu[i, k] = -gamma * bl.a[j, i, k]
        lu[i, i] += shift
        for k in range(n):
            x[i, k] = -gamma * bl.b[j, i, k]
    if lu_factor(lu, pivots) != 1:
        return 0
    _solve_rows(lu, pivots, x, n)
    for i in range(n):
        for k in range(NB):
            f = -gamma * bl.c[j, i, k]
            c[i, k] = f
            if f != 0.0:
                for m in range(n):
                    own[i, m] -= f * x[k, m]
    return 1


@helper
def _exchange(schur, columns, own, n, out):
    """Take the n columns and rows of one row of balls out of the Schur complement, or put them back."""
    for i in range(n):
        for k in range(n):
            if out:
                own[i, k] = schur[columns[i], columns[k]]
            else:
                schur[columns[i], columns[k]] = own[i, k]


@helper
def arrow_factor(bl, shift, gamma, fa):
    """Factor shift I - gamma J; returns 0 when singular."""
    schur, reach = fa.schur, bl.reach
    for i in range(schur.shape[0]):
        for k in range(schur.shape[0]):
            schur[i, k] = -gamma * bl.d[i, k]
        schur[i, i] += shift
    for r in range(reach.width.size):
        n, columns = reach.width[r], reach.columns[r]
        whole = n == schur.shape[0]  # one bearing: nothing to take out
        own = schur if whole else fa.own
        if not whole:
            _exchange(schur, columns, own, n, True)
        for j in range(reach.first[r], reach.first[r + 1]):
            if _factor_ball(bl, j, shift, gamma, fa, own, n) != 1:
                return 0
        if not whole:
            _exchange(schur, columns, own, n, False)
    if schur.shape[0] == 0:
        return 1
    return lu_factor(schur, fa.schur_pivots)


@helper
def arrow_solve(bl, fa, r):
    """Solve in place for the right-hand side r, shape (9 Z + n,)."""
    reach, own = bl.reach, fa.tail
    shared = r[NB * fa.x.shape[0] :]
    for row in range(reach.width.size):
        n, columns = reach.width[row], reach.columns[row]
        for i in range(n):
            own[i] = shared[columns[i]]
        for j in range(reach.first[row], reach.first[row + 1]):
            part = r[NB * j : NB * j + NB]
            lu_solve(fa.lu[j], fa.pivots[NB * j : NB * j + NB], part)
            for i in range(n):
                total = 0.0
                for k in range(NB):
                    total += fa.c[j, i, k] * part[k]
                own[i] -= total
        for i in range(n):
            shared[columns[i]] = own[i]
    if shared.size > 0:
        lu_solve(fa.schur, fa.schur_pivots, shared)
    for row in range(reach.width.size):
        n, columns = reach.width[row], reach.columns[row]
        for i in range(n):
            own[i] = shared[columns[i]]
        for j in range(reach.first[row], reach.first[row + 1]):
            for i in range(NB):
                total = 0.0
                for k in range(n):
                    total += fa.x[j, i, k] * own[k]
                r[NB * j + i] -= total
