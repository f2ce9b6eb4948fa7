"""Linear algebra of the block-arrow matrix M = s I - g J: factor and solve in O(Z)."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numba import types

from lambda_core.solver.layout import NB, array1, array2, array3, helper, iarray1


class Factors(NamedTuple):
    """LU factors of the ball blocks and of the Schur complement."""

    lu: Any  # (Z, 9, 9)
    pivots: Any  # int64 (9 Z,)
    x: Any  # (Z, 9, n): A_j^-1 B_j
    c: Any  # (Z, n, 9): the scaled C_j
    schur: Any  # (n, n)
    schur_pivots: Any  # int64 (n,)
    scratch: Any  # (max(n, 9),)


factors_t = types.NamedTuple([array3, iarray1, array3, array3, array2, iarray1, array1], Factors)


def make_factors(balls: int, n: int) -> Factors:
    """Allocate for `balls` balls and n shared states."""
    return Factors(
        np.zeros((balls, NB, NB)),
        np.zeros(NB * balls, dtype=np.int64),
        np.zeros((balls, NB, n)),
        np.zeros((balls, n, NB)),
        np.zeros((n, n)),
        np.zeros(n, dtype=np.int64),
        np.zeros(max(n, NB)),
    )


@helper
def lu_factor(m, pivots):
    """Factor m in place with row pivoting; returns 0 when singular."""
    n = m.shape[0]
    for k in range(n):
        best, row = abs(m[k, k]), k
        for i in range(k + 1, n):
            if abs(m[i, k]) > best:
                best, row = abs(m[i, k]), i
        pivots[k] = row
        if not best > 0.0:
            return 0
        if row != k:
            for c in range(n):
                m[k, c], m[row, c] = m[row, c], m[k, c]
        inverse = 1.0 / m[k, k]
        for i in range(k + 1, n):
            f = m[i, k] * inverse
            m[i, k] = f
            if f != 0.0:
                for c in range(k + 1, n):
                    m[i, c] -= f * m[k, c]
    return 1


@helper
def lu_solve(m, pivots, b):
    """Solve in place with the factors of lu_factor."""
    n = m.shape[0]
    for k in range(n):
        row = pivots[k]
        if row != k:
            b[k], b[row] = b[row], b[k]
    for i in range(1, n):
        total = b[i]
        for c in range(i):
            total -= m[i, c] * b[c]
        b[i] = total
    for i in range(n - 1, -1, -1):
        total = b[i]
        for c in range(i + 1, n):
            total -= m[i, c] * b[c]
        b[i] = total / m[i, i]


@helper
def _solve_rows(m, pivots, b):
    """Solve m X = b for a matrix b (9, n) in place, row by row so that the inner loop runs along n."""
    size, n = b.shape
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
def arrow_factor(bl, shift, gamma, fa):
    """Factor shift I - gamma J; returns 0 when singular."""
    z, n = bl.b.shape[0], bl.b.shape[2]
    schur = fa.schur
    for i in range(n):
        for k in range(n):
            schur[i, k] = -gamma * bl.d[i, k]
        schur[i, i] += shift
    for j in range(z):
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
        _solve_rows(lu, pivots, x)
        for i in range(n):
            for k in range(NB):
                f = -gamma * bl.c[j, i, k]
                c[i, k] = f
                if f != 0.0:
                    for m in range(n):
                        schur[i, m] -= f * x[k, m]
    if n == 0:
        return 1
    return lu_factor(schur, fa.schur_pivots)


@helper
def arrow_solve(fa, r):
    """Solve in place for the right-hand side r, shape (9 Z + n,)."""
    z, n = fa.x.shape[0], fa.x.shape[2]
    tail = r[NB * z :]
    for j in range(z):
        part = r[NB * j : NB * j + NB]
        lu_solve(fa.lu[j], fa.pivots[NB * j : NB * j + NB], part)
        for i in range(n):
            total = 0.0
            for k in range(NB):
                total += fa.c[j, i, k] * part[k]
            tail[i] -= total
    if n > 0:
        lu_solve(fa.schur, fa.schur_pivots, tail)
    for j in range(z):
        for i in range(NB):
            total = 0.0
            for k in range(n):
                total += fa.x[j, i, k] * tail[k]
            r[NB * j + i] -= total
