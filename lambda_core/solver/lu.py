"""Linear algebra of one dense block: factors with row pivoting, and their solution."""

from __future__ import annotations

from lambda_core.solver.layout import helper, rows_helper


@rows_helper
def inner_product(row, other, n):
    """Return the inner product of the first n entries of two rows, summed in any order: terms do not wait."""
    total = 0.0
    for i in range(n):
        total += row[i] * other[i]
    return total


@rows_helper
def take_multiple(row, factor, other, n):
    """Take a multiple of the first n entries of another row from a row."""
    for i in range(n):
        row[i] -= factor * other[i]


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
                take_multiple(m[i, k + 1 :], f, m[k, k + 1 :], n - k - 1)
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
        b[i] -= inner_product(m[i], b, i)
    for i in range(n - 1, -1, -1):
        b[i] = (b[i] - inner_product(m[i, i + 1 :], b[i + 1 :], n - i - 1)) / m[i, i]
