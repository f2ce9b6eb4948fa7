"""The Schur complement of several bearings on a shaft: positions are eliminated, speeds are left as a dense block.

The rate of a position depends on the state of its own body alone, of most on one speed (:mod:`.reach`): its row has a
few entries, and eliminating it costs few. It is the diagonal that is divided by, 1 but for terms of the order of a
tilt: what is left is the matrix of inertia, damping and stiffness that a step has, M - g C - g^2 K, as in Newmark's
method. Half of the states are speeds, and a dense block of half the size costs an eighth.
"""

from __future__ import annotations

from lambda_core.solver.layout import helper
from lambda_core.solver.lu import inner_product, lu_factor, lu_solve, take_multiple


@helper
def _among_positions(m, reach):
    """Factor the positions of every body in place, and divide the rows of positions by them: returns 0 when singular.

    Their entries at speeds become how the positions follow the speeds.
    """
    positions, ends, among = reach.positions, reach.ends, reach.among
    for a in range(positions.size):
        p, end = positions[a], ends[a]
        if not abs(m[p, p]) > 0.0:
            return 0
        for i in range(p + 1, end):
            if among[i] < 0 and m[i, p] != 0.0:
                m[i, p] /= m[p, p]
                take_multiple(m[i, p + 1 :], m[i, p], m[p, p + 1 :], end - p - 1)
    for a in range(positions.size - 1, -1, -1):
        p, end = positions[a], ends[a]
        for c in range(p + 1, end):
            if among[c] >= 0:
                for q in range(p + 1, end):
                    if among[q] < 0:
                        m[p, c] -= m[p, q] * m[q, c]
                m[p, c] /= m[p, p]
    return 1


@helper
def condense(m, reach, dense, turned, packed, pivots):
    """Factor m, whose rows of speeds keep their entries at positions; returns 0 when singular."""
    positions, ends, speeds, among = reach.positions, reach.ends, reach.speeds, reach.among
    n = speeds.size
    if _among_positions(m, reach) != 1:
        return 0
    for i in range(n):
        for k in range(n):
            turned[i, k] = m[speeds[k], speeds[i]]
    for a in range(positions.size):
        p = positions[a]
        for k in range(n):
            packed[k] = m[speeds[k], p]
        for c in range(p + 1, ends[a]):
            if among[c] >= 0 and m[p, c] != 0.0:
                take_multiple(turned[among[c]], m[p, c], packed, n)
    for i in range(n):
        for k in range(n):
            dense[i, k] = turned[k, i]
    return lu_factor(dense, pivots[:n])


@helper
def solve_condensed(m, reach, dense, packed, pivots, r):
    """Solve in place with the factors of :func:`condense`."""
    positions, ends, speeds, among = reach.positions, reach.ends, reach.speeds, reach.among
    for k in range(speeds.size):
        packed[k] = r[speeds[k]]
        r[speeds[k]] = 0.0
    for a in range(positions.size):
        p = positions[a]
        for i in range(p + 1, ends[a]):
            if among[i] < 0:
                r[i] -= m[i, p] * r[p]
    for a in range(positions.size - 1, -1, -1):
        p = positions[a]
        total = r[p]
        for q in range(p + 1, ends[a]):
            if among[q] < 0:
                total -= m[p, q] * r[q]
        r[p] = total / m[p, p]
    for k in range(speeds.size):
        packed[k] -= inner_product(m[speeds[k]], r, r.size)
    lu_solve(dense, pivots[: speeds.size], packed)
    for k in range(speeds.size):
        r[speeds[k]] = packed[k]
    for a in range(positions.size):
        p = positions[a]
        for c in range(p + 1, ends[a]):
            if among[c] >= 0:
                r[p] -= m[p, c] * r[c]
