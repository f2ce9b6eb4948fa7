"""Run a damped Newton iteration where balls come to rest.

It starts from the last velocities and uses the exact Jacobian of the iterate.

Friction in a contact at rest is almost a sign function. From a speed on the wrong side of it an undamped iteration
goes to and fro for ever, in steps of any length. What is solved is M (v - v_0)/gamma = F(v) with a friction that
opposes v: its residual falls along Newton's direction, and a step of the search along it is taken where it falls
enough (Armijo 1966, Pacific J. Math. 16, 1; Dennis and Schnabel 1983, Numerical Methods, 6.3). The residual is
measured by the inertias, in which the balls' places have no part: those are linear in the speeds. Balls that have next
to no part in the residual keep their Jacobian, as long as it falls.
"""

from __future__ import annotations

from lambda_core.solver.arrays.bundle import BVX, BWT, NS, SVX
from lambda_core.solver.integrator.balance import finalise_step, leak_of_iterate
from lambda_core.solver.integrator.correction import norm, renew, solve_correction
from lambda_core.solver.layout import first_of, helper, large_helper
from lambda_core.solver.status import Status

_MAX_ITERATIONS = 20
_HALVINGS = 8  # of a move, at most
_FALL = 0.2  # of the squared residual, over the share of the move that is made
_RESTLESS = 0.01  # share of the squared residual from which a ball's part of the Jacobian is renewed


@helper
def _start(bundle, mem):
    """Begin at the extrapolated places and the last step's speeds."""
    new, base = mem.new, bundle.system[0].tail
    for i in range(new.size):
        new[i] = mem.predicted[i]
    for r in range(bundle.rows.size):
        row = bundle.rows[r]
        for j in range(row.first_ball, row.first_ball + row.balls):
            first = first_of(row, j)
            for i in range(first + BVX, first + BWT + 1):
                new[i] = mem.y[i]
    for i in range(bundle.active.size):
        if bundle.active[i] % NS >= SVX:
            new[base + i] = mem.y[base + i]


@helper
def _evaluate(evaluate, t, gamma, bundle, mem):
    """Evaluate at mem.new.

    Return the squared residual by the inertias, -1 where a law refuses.
    """
    mem.count[0].rhs_calls += 1
    if evaluate(t, mem.new, bundle, mem.slope, mem.rates, 1) != Status.OK:
        return -1.0
    total = 0.0
    for i in range(mem.new.size):
        off = mem.base[i] + gamma * mem.slope[i] - mem.new[i]
        total += mem.inertia[i] * off * off
    return total


@helper
def _search(evaluate, t, gamma, residual, bundle, mem):
    """Search along the correction.

    It goes as far as the residual falls. Return its value there, or -1 where it does not fall.
    """
    new, change, begin, share = mem.new, mem.change, mem.last_change, 1.0
    for i in range(new.size):
        begin[i] = new[i]
    for _ in range(_HALVINGS):
        for i in range(new.size):
            new[i] = begin[i] + share * change[i]
        found = _evaluate(evaluate, t, gamma, bundle, mem)
        if found >= 0.0 and found <= (1.0 - _FALL * share) * residual:
            return found
        share *= 0.5
    return -1.0


@helper
def _mark_restless(gamma, residual, bundle, bl, mem):
    """Mark the balls with the largest residual.

    They make most of the squared residual, so their Jacobian is renewed.
    """
    mem.count[0].stale = 1
    mem.count[0].ball_jacobians += 1
    for r in range(bundle.rows.size):
        row = bundle.rows[r]
        for j in range(row.first_ball, row.first_ball + row.balls):
            first, total = first_of(row, j), 0.0
            for i in range(first, first + row.size):
                off = mem.base[i] + gamma * mem.slope[i] - mem.new[i]
                total += mem.inertia[i] * off * off
            bl.due[j] = 1 if total > _RESTLESS * residual else 0


@large_helper
def solve_damped(evaluate, jacobian, t, h, tolerance, closer, bundle, bl, fa, mem):
    """Solve new = base + gamma f(new), damped.

    It works as newton.solve_step does; return a Status: OK, NOT_CONVERGED, REFUSED.
    """
    count, gamma = mem.count[0], mem.control[0].gamma
    if closer == 0:
        _start(bundle, mem)
    residual = _evaluate(evaluate, t, gamma, bundle, mem)
    if residual < 0.0:
        return Status.REFUSED
    for iteration in range(_MAX_ITERATIONS):
        renewed = count.stale == 1
        if renewed:
            bl.due[:] = 1
            count.jacobians += 1
            count.jacobian_age = 0
        else:
            _mark_restless(gamma, residual, bundle, bl, mem)
        count.newton_iterations += 1
        if renew(jacobian, t, gamma, bundle, bl, fa, mem) != Status.OK:
            return Status.REFUSED
        if solve_correction(gamma, 1, bundle, bl, fa, mem) != 1:
            return Status.NOT_CONVERGED
        if norm(mem.change, mem.weight) <= tolerance:
            for i in range(mem.new.size):
                mem.last_move[i], mem.since[i] = mem.change[i], mem.change[i]
                mem.new[i] += mem.change[i]
            if leak_of_iterate(bundle, mem, h) <= 1.0 or iteration + 1 == _MAX_ITERATIONS:
                finalise_step(bundle, mem)
                return Status.OK
            residual = _evaluate(evaluate, t, gamma, bundle, mem)
        else:
            residual = _search(evaluate, t, gamma, residual, bundle, mem)
            if residual < 0.0 and not renewed:
                count.stale = 1
                for i in range(mem.new.size):
                    mem.new[i] = mem.last_change[i]
                residual = _evaluate(evaluate, t, gamma, bundle, mem)
        if residual < 0.0:
            return Status.NOT_CONVERGED
    return Status.NOT_CONVERGED
