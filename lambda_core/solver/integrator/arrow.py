"""Linear algebra of the block-arrow matrix M = s I - g J: factor and solve in O(Z).

The blocks of a ball hold the columns of its own bodies alone (:mod:`.reach`). What the balls of a row take from the
Schur complement is summed in a matrix of that size, which is taken out of the whole one and put back.

Every product is a sum of multiples of rows: the entries of a row do not wait for one another, as the terms of an inner
product do. So the ball blocks are kept as inverses, and the other blocks in the order in which they are gone through.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numba import types

from lambda_core.solver.integrator.reach import Reach
from lambda_core.solver.layout import NB, array1, array2, array3, helper, iarray1, rows_helper
from lambda_core.solver.lu import lu_factor, lu_solve


class Factors(NamedTuple):
    """Inverses of the ball blocks and LU factors of the Schur complement."""

    inverse: Any  # (Z, 9, 9): (A_j^-1)^T
    pivots: Any  # int64 (9,)
    x: Any  # (9, widest): A_j^-1 B_j of the ball in hand
    across: Any  # (Z, widest, 9): (A_j^-1 B_j)^T
    c: Any  # (Z, 9, widest): C_j^T, scaled
    schur: Any  # (n, n)
    schur_pivots: Any  # int64 (n,)
    own: Any  # (widest, widest): what one row of balls has of the Schur complement
    tail: Any  # (widest,): and of the shared part of a right-hand side
    part: Any  # (9,): one ball's part of a solution


factors_t = types.NamedTuple(
    [array3, iarray1, array2, array3, array3, array2, iarray1, array2, array1, array1], Factors
)


def make_factors(reach: Reach, n: int) -> Factors:
    """Allocate for the rows of balls that `reach` describes and n shared states."""
    balls, widest = int(reach.first[-1]), reach.columns.shape[1]
    return Factors(
        np.zeros((balls, NB, NB)),
        np.zeros(NB, dtype=np.int64),
        np.zeros((NB, widest)),
        np.zeros((balls, widest, NB)),
        np.zeros((balls, NB, widest)),
        np.zeros((n, n)),
        np.zeros(n, dtype=np.int64),
        np.zeros((widest, widest)),
        np.zeros(widest),
        np.zeros(NB),
    )


@rows_helper
def _add_ball(row, factor, other):
    """Add a multiple of another row of a ball's states."""
    for i in range(NB):
        row[i] += factor * other[i]


@rows_helper
def _add(row, factor, other, n):
    """Add a multiple of the first n entries of another row."""
    for i in range(n):
        row[i] += factor * other[i]


@helper
def _invert(m, pivots):
    """Invert a ball block in place: Gauss and Jordan's elimination with row pivoting; returns 0 when singular."""
    for k in range(NB):
        best, row = abs(m[k, k]), k
        for i in range(k + 1, NB):
            if abs(m[i, k]) > best:
                best, row = abs(m[i, k]), i
        pivots[k] = row
        if not best > 0.0:
            return 0
        if row != k:
            for c in range(NB):
                m[k, c], m[row, c] = m[row, c], m[k, c]
        inverse = 1.0 / m[k, k]
        m[k, k] = 1.0
        for c in range(NB):
            m[k, c] *= inverse
        for i in range(NB):
            if i != k:
                f = m[i, k]
                m[i, k] = 0.0
                _add_ball(m[i], -f, m[k])
    for k in range(NB - 1, -1, -1):
        row = pivots[k]
        if row != k:
            for i in range(NB):
                m[i, k], m[i, row] = m[i, row], m[i, k]
    return 1


@helper
def _factor_ball(bl, j, shift, gamma, fa, own, n):
    """Invert the block of ball j and take its share, of n columns, from `own`; returns 0 when singular."""
    m, x, across, c = fa.inverse[j], fa.x, fa.across[j], fa.c[j]
    for i in range(NB):
        for k in range(NB):
            m[k, i] = -gamma * bl.a[j, i, k]
        m[i, i] += shift
    if _invert(m, fa.pivots) != 1:
        return 0
    for i in range(NB):
        for q in range(n):
            x[i, q] = 0.0
        for k in range(NB):
            f = -gamma * m[k, i]
            if f != 0.0:
                _add(x[i], f, bl.b[j, k], n)
        for q in range(n):
            across[q, i] = x[i, q]
    for i in range(n):
        for k in range(NB):
            f = -gamma * bl.c[j, i, k]
            c[k, i] = f
            if f != 0.0:
                _add(own[i], -f, x[k], n)
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
    reach, own, part = bl.reach, fa.tail, fa.part
    shared = r[NB * fa.inverse.shape[0] :]
    for row in range(reach.width.size):
        n, columns = reach.width[row], reach.columns[row]
        for i in range(n):
            own[i] = shared[columns[i]]
        for j in range(reach.first[row], reach.first[row + 1]):
            its = r[NB * j : NB * j + NB]
            for i in range(NB):
                part[i] = 0.0
            for k in range(NB):
                _add_ball(part, its[k], fa.inverse[j, k])
            for k in range(NB):
                its[k] = part[k]
                _add(own, -part[k], fa.c[j, k], n)
        for i in range(n):
            shared[columns[i]] = own[i]
    if shared.size > 0:
        lu_solve(fa.schur, fa.schur_pivots, shared)
    for row in range(reach.width.size):
        n, columns = reach.width[row], reach.columns[row]
        for i in range(n):
            own[i] = shared[columns[i]]
        for j in range(reach.first[row], reach.first[row + 1]):
            its = r[NB * j : NB * j + NB]
            for i in range(NB):
                part[i] = its[i]
            for k in range(n):
                _add_ball(part, -own[k], fa.across[j, k])
            for i in range(NB):
                its[i] = part[i]
