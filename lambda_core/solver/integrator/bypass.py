"""Bypass converged bearings in Newton's later iterations.

All bearings of a machine take the same steps, which one of them needs so short; to the others the first correction of
such a step is nearly nothing. Where a bearing's states have moved by no more than the iteration may leave, root mean
square, since its contacts were computed, they are not computed again: what these moves change of its forces and rates
follows from its Jacobian, so that rings and balls stay in balance. What is left out is of the second order of the
moves, and what the Jacobian is out of date by times them: less than the moves wherever the iteration converges.

Energy is balanced with the forces and powers that were computed, and the moves since: :mod:`.balance`.
"""

from __future__ import annotations

import math

from lambda_core.solver.arrays.bundle import NB, NS
from lambda_core.solver.layout import first_of, helper
from lambda_core.solver.lu import inner_product
from lambda_core.solver.motion.bearing_sums import AGAIN


@helper
def reset_moves(want, bundle, mem):
    """Begin to add up the moves.

    They count from this evaluation; those of bypassed bearings count from an earlier one.
    """
    since = mem.since
    if want != AGAIN:
        since[:] = 0.0
        return
    for r in range(bundle.rows.size):
        row = bundle.rows[r]
        if bundle.bypassed[row.bearing] == 0:
            since[row.first_state : row.first_state + row.size * row.balls] = 0.0
    tail = bundle.system[0].tail
    for i in range(bundle.active.size):
        bearing = bundle.bodies[bundle.active[i] // NS].bearing
        if bearing < 0 or bundle.bypassed[bearing] == 0:
            since[tail + i] = 0.0


@helper
def _moved(b, bundle, mem):
    """Return a bearing's rms of moves.

    They count from the evaluation of bearing b and are over the error allowed per step.
    """
    total, count, tail = 0.0, 0, bundle.system[0].tail
    for r in range(bundle.rows.size):
        row = bundle.rows[r]
        if row.bearing == b:
            for i in range(row.first_state, row.first_state + row.size * row.balls):
                x = mem.since[i] * mem.weight[i]
                total += x * x
            count += row.size * row.balls
    for i in range(bundle.active.size):
        if bundle.bodies[bundle.active[i] // NS].bearing == b:
            x = mem.since[tail + i] * mem.weight[tail + i]
            total += x * x
            count += 1
    return math.sqrt(total / count)


@helper
def choose_bypassed(tolerance, bundle, bl, mem):
    """Choose the bearings to bypass next.

    They stay out of the next iteration; return the `want` to evaluate it with.

    None whose Jacobian is to be renewed: that is done where forces are computed. Never one alone, one whose balls touch
    each other, nor contacts that keep states, which are iterated with slopes of their own.
    """
    if bundle.bypassed.size == 1 or bundle.states.size > 0:
        return 1
    for b in range(bundle.bypassed.size):
        bundle.bypassed[b] = 1 if _moved(b, bundle, mem) <= tolerance else 0
    for r in range(bundle.rows.size):
        row = bundle.rows[r]
        if row.caged == 0:
            bundle.bypassed[row.bearing] = 0
        for j in range(row.first_ball, row.first_ball + row.balls):
            if mem.count[0].stale == 1 and bl.due[j] == 1:
                bundle.bypassed[row.bearing] = 0
    for b in range(bundle.bypassed.size):
        mem.count[0].bypasses += bundle.bypassed[b]
    return AGAIN


@helper
def follow(gamma, bundle, bl, fa, mem):
    """Add bypassed bearings' changes of rates.

    They go to the residual in mem.change, by their moves and their Jacobian.
    """
    since, change, own, tail = mem.since, mem.change, fa.tail, bundle.system[0].tail
    for r in range(bundle.rows.size):
        row = bundle.rows[r]
        if bundle.bypassed[row.bearing] == 0:
            continue
        n, columns = bl.reach.width[r], bl.reach.columns[r]
        for q in range(n):
            own[q] = since[tail + columns[q]]
        for j in range(row.first_ball, row.first_ball + row.balls):
            if row.size == NB:  # a size that the compiler knows
                _follow_element(gamma, first_of(row, j), NB, j, bl, n, columns, own, since, change, tail)
            else:
                _follow_element(gamma, first_of(row, j), row.size, j, bl, n, columns, own, since, change, tail)
        for q in range(n):
            change[tail + columns[q]] += gamma * inner_product(bl.d_own[r, q], own, n)


@helper
def _follow_element(gamma, first, size, j, bl, n, columns, own, since, change, tail):
    """Add the share of element j.

    The element has `size` states from `first` on.
    """
    its = since[first : first + size]
    for i in range(size):
        change[first + i] += gamma * (inner_product(bl.a[j, i], its, size) + inner_product(bl.b[j, i], own, n))
    for q in range(n):
        change[tail + columns[q]] += gamma * inner_product(bl.c[j, q], its, size)
