"""Linear algebra of one dense block: factors with row pivoting, and their solution."""

from __future__ import annotations

from lambda_core.solver.layout import helper


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
