"""Factor and solve one dense block."""

from __future__ import annotations

from lambda_core.solver.arrays.factors import LANES, filled
from lambda_core.solver.layout import helper, rows_helper


@rows_helper
def inner_product(row, other, n):
    """Return the inner product of two rows.

    It covers their first n entries, summed in any order, so that terms do not wait.
    """
    total = 0.0
    for i in range(n):
        total += row[i] * other[i]
    return total


@rows_helper
def take_multiple(row, factor, other, n):
    """Take a row's multiple from a row.

    It takes the first n entries.
    """
    for i in range(n):
        row[i] -= factor * other[i]


@helper
def lu_factor(m, pivots):
    """Factor m in place.

    It uses row pivoting; return 0 when singular.
    """
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


filled_up = helper(filled)


@helper
def factor_turned(upper, lower, inverse, pivots):
    """Factor a matrix given by its transpose.

    The transpose is in `upper`, rows filled up; column pivoting; return 0 when singular.

    Multipliers go to `lower`, the inverse of the diagonal to `inverse`. Rows are gone through from where a whole vector
    begins: entries left of the diagonal stay zero.
    """
    n, width = upper.shape
    for k in range(n):
        lower[k, :] = 0.0
    for k in range(n):
        best, row = abs(upper[k, k]), k
        for i in range(k + 1, n):
            if abs(upper[i, k]) > best:
                best, row = abs(upper[i, k]), i
        pivots[k] = row
        if not best > 0.0:
            return 0
        if row != k:
            for c in range(width):
                upper[k, c], upper[row, c] = upper[row, c], upper[k, c]
                lower[k, c], lower[row, c] = lower[row, c], lower[k, c]
        inverse[k] = 1.0 / upper[k, k]
        begin = k // LANES * LANES
        for i in range(k + 1, n):
            f = upper[i, k] * inverse[k]
            if f != 0.0:
                take_multiple(upper[i, begin:], f, upper[k, begin:], width - begin)
                lower[i, k], upper[i, k] = f, 0.0
    return 1


@helper
def solve_turned(upper, lower, inverse, pivots, b, found):
    """Solve for b in place.

    It uses the factors of :func:`factor_turned`: rows are filled up, and stay so.

    What a sweep has found waits in `found`: a number that was just written among others holds up whoever reads all.
    """
    n, width = upper.shape
    for k in range(n):
        begin = k // LANES * LANES
        found[k] = b[k] * inverse[k]
        take_multiple(b[begin:], found[k], upper[k, begin:], width - begin)
    for k in range(n - 1, 0, -1):
        take_multiple(found, found[k], lower[k], -(-k // LANES) * LANES)
    for k in range(n):
        b[k] = found[k]
    for k in range(n - 1, -1, -1):
        row = pivots[k]
        if row != k:
            b[k], b[row] = b[row], b[k]
