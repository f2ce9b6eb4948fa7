"""Factor the Schur complement of several bearings.

Positions are eliminated; speeds remain as a dense block.

The rate of a position depends on the state of its own body alone, of most on one speed (:mod:`.reach`): its row has a
few entries, and eliminating it costs few. It is the diagonal that is divided by, 1 but for terms of the order of a
tilt: what is left is the matrix of inertia, damping and stiffness that a step has, M - g C - g^2 K, as in Newmark's
method. Half of the states are speeds, and a dense block of half the size costs an eighth.

The dense block is kept, and factored, turned over: both sweeps of a solution are then sums of multiples of rows. Its
rows are filled up with zeros (:func:`~lambda_core.solver.lu.filled`).
"""

from __future__ import annotations

from lambda_core.solver.layout import helper
from lambda_core.solver.lu import factor_turned, solve_turned, take_multiple


@helper
def _among_positions(m, reach):
    """Factor the positions of every body.

    They are factored in place; divide the rows of positions by them and return 0 when singular.

    Their entries at speeds become how the positions follow the speeds.
    """
    positions, middles, ends = reach.positions, reach.middles, reach.ends
    for a in range(positions.size):
        p, middle, end = positions[a], middles[a], ends[a]
        if not abs(m[p, p]) > 0.0:
            return 0
        for i in range(p + 1, middle):
            if m[i, p] != 0.0:
                m[i, p] /= m[p, p]
                for c in range(p + 1, end):
                    m[i, c] -= m[i, p] * m[p, c]
    for a in range(positions.size - 1, -1, -1):
        p, middle, end = positions[a], middles[a], ends[a]
        for q in range(p + 1, middle):
            if m[p, q] != 0.0:
                for c in range(middle, end):
                    m[p, c] -= m[p, q] * m[q, c]
        for c in range(middle, end):
            m[p, c] /= m[p, p]
    return 1


@helper
def condense(m, reach, co):
    """Factor m, keeping the rows of positions.

    They are kept with it; return 0 when singular.
    """
    positions, middles, ends, speeds, among = reach.positions, reach.middles, reach.ends, reach.speeds, reach.among
    n = speeds.size
    if _among_positions(m, reach) != 1:
        return 0
    for k in range(n):
        row = m[speeds[k]]
        for i in range(n):
            co.upper[i, k] = row[speeds[i]]
        for a in range(positions.size):
            co.on_speeds[a, k] = row[positions[a]]
    for a in range(positions.size):
        p = positions[a]
        for c in range(middles[a], ends[a]):
            if m[p, c] != 0.0:
                take_multiple(co.upper[among[c]], m[p, c], co.on_speeds[a], co.packed.size)
    return factor_turned(co.upper, co.lower, co.inverse, co.pivots)


@helper
def _solve_positions(m, reach, r):
    """Solve in place for the positions, as if speeds stood."""
    positions, middles = reach.positions, reach.middles
    for a in range(positions.size):
        p = positions[a]
        for i in range(p + 1, middles[a]):
            r[i] -= m[i, p] * r[p]
    for a in range(positions.size - 1, -1, -1):
        p = positions[a]
        total = r[p]
        for q in range(p + 1, middles[a]):
            total -= m[p, q] * r[q]
        r[p] = total / m[p, p]


@helper
def solve_condensed(m, reach, co, r):
    """Solve in place with the factors of :func:`condense`."""
    positions, middles, ends, speeds, packed = reach.positions, reach.middles, reach.ends, reach.speeds, co.packed
    for k in range(speeds.size):
        packed[k] = r[speeds[k]]
    _solve_positions(m, reach, r)
    for a in range(positions.size):
        take_multiple(packed, r[positions[a]], co.on_speeds[a], packed.size)
    solve_turned(co.upper, co.lower, co.inverse, co.pivots, packed, co.found)
    for k in range(speeds.size):
        r[speeds[k]] = packed[k]
    for a in range(positions.size):
        p = positions[a]
        for c in range(middles[a], ends[a]):
            r[p] -= m[p, c] * r[c]
