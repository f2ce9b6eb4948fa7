"""Iterate Newton's method of one step.

Parts of the block-arrow matrix are renewed.
"""

from __future__ import annotations

from lambda_core.solver.integrator.balance import finalise_step, leak_of_iterate
from lambda_core.solver.integrator.bypass import choose_bypassed, reset_moves
from lambda_core.solver.integrator.correction import norm, renew, shared_norm, solve_correction
from lambda_core.solver.integrator.damped import solve_damped
from lambda_core.solver.layout import first_of, helper
from lambda_core.solver.motion.bearing_sums import is_bypassed
from lambda_core.solver.status import Status

# Of the error allowed per step, while there is no history. Friction in a contact at rest changes sign within far less:
# what the first steps leave of it turns it over at every later step, and those stay at nanoseconds.
_FIRST_STEPS = 0.03
# Of what the iteration may leave, in the bodies that all balls share, where vibrations are followed: what it leaves
# there shakes modes of the rings that hardly anything damps.
_SHARED = 0.1
_MAX_NEWTON = 6
_MAX_LOCAL = 4  # more iterations where Jacobians are renewed on the way
_SLOW = 0.3  # convergence rate beyond which the Jacobian is renewed for the balls that are to blame
_SHARE = 0.05  # of the squared last change, from which a ball's part of the Jacobian is renewed
_SWING = 0.04  # share of its square by which a correction turns round before the secant is taken


@helper
def _move(mem, first, last, relax, again):
    """Move states by their correction.

    They are the states first..last; where corrections swing to and fro, the secant moves them.

    The correction c(x) is to vanish. Where it turned round, the root along the last move m is at
    c - theta (m + c - c_0), theta = c.(c - c_0)/|c - c_0|^2: Anderson 1965, J. ACM 12, 547, with one difference.
    Returns whether the secant was taken.
    """
    change, before, moved = mem.change, mem.last_change, mem.last_move
    swing, size, difference, along = 0.0, 0.0, 0.0, 0.0
    if not again:
        for i in range(first, last):
            change[i] *= relax
            before[i], moved[i] = change[i], change[i]
            mem.new[i] += change[i]
        return False
    for i in range(first, last):
        change[i] *= relax
        w2 = mem.weight[i] * mem.weight[i]
        d = change[i] - before[i]
        swing += w2 * change[i] * before[i]
        size += w2 * before[i] * before[i]
        difference += w2 * d * d
        along += w2 * change[i] * d
    theta = along / difference if swing < -_SWING * size else 0.0
    for i in range(first, last):
        move = change[i] - theta * (moved[i] + change[i] - before[i])
        before[i], moved[i] = change[i], move
        mem.new[i] += move
    return theta != 0.0


@helper
def _relax(gamma, factored):
    """Return the moved share of a correction.

    Factors of another gamma miss by a known amount.
    """
    return 2.0 / (1.0 + gamma / factored)


@helper
def _move_all(bundle, fa, mem, want, again):
    """Move every state by its correction.

    It goes ball by ball; return whether a ball's corrections swung to and fro.
    """
    tail, moving, control = bundle.system[0].tail, mem.new.size - bundle.states.size, mem.control[0]
    swung = False
    for r in range(bundle.rows.size):
        row, relax = bundle.rows[r], _relax(control.gamma, fa.gamma[r])
        turn = again and not is_bypassed(row.bearing, bundle, want)
        for j in range(row.first_ball, row.first_ball + row.balls):
            first = first_of(row, j)
            swung |= _move(mem, first, first + row.size, relax, turn)
    swung |= _move(mem, tail, moving, _relax(control.gamma, control.factored_gamma), again)
    if moving < mem.new.size:
        swung |= _move(mem, moving, mem.new.size, 1.0, again)
    for i in range(mem.new.size):
        mem.since[i] += mem.last_move[i]
    return swung


@helper
def _renew_slow(bundle, bl, mem, size):
    """Mark the balls that converge slowly.

    They make most of the last change, of the given norm, so their Jacobian is renewed.

    Where no ball stands out the bodies that all share are slow, and it is renewed for all.
    """
    change, weight, count = mem.change, mem.weight, mem.count[0]
    bar = _SHARE * size * size * change.size
    marked = 0
    for r in range(bundle.rows.size):
        row = bundle.rows[r]
        for j in range(row.first_ball, row.first_ball + row.balls):
            first, total = first_of(row, j), 0.0
            for i in range(first, first + row.size):
                x = change[i] * weight[i]
                total += x * x
            bl.due[j] = 1 if total > bar else 0
            marked += bl.due[j]
    count.stale = 1
    if marked > 0:
        count.ball_jacobians += 1
    else:
        bl.due[:] = 1
        count.jacobians += 1
        count.jacobian_age = 0


@helper
def solve_step(evaluate, jacobian, t, h, closer, bundle, bl, fa, mem):
    """Solve new = base + gamma f(new).

    Return a Status: OK, NOT_CONVERGED, REFUSED.

    With `closer` (1 or 0) the iteration goes on from where it stands, to a tenth of what it leaves otherwise.

    A ball that bounces on a raceway or in its pocket spoils the convergence of all: where it is slow, the Jacobian is
    renewed at the iterate for the balls that change most. A ball that creeps near gross sliding throws Newton's
    iteration to and fro, whatever its Jacobian: it goes by the secant. Where nothing of that helps the iteration is
    damped (count.careful, see damped.solve_damped). Of several bearings those that hardly move rest (see bypass).
    The rates of the running integrals are those of
    the last iterate, brought to the result by what its residual says; the iteration goes on while they do not account
    for the energy.
    """
    change, weight, count, control = mem.change, mem.weight, mem.count[0], mem.control[0]
    gamma = control.gamma
    tolerance = _FIRST_STEPS if count.history < 2 or closer == 1 else control.newton_tolerance
    if count.careful > 0:
        return solve_damped(evaluate, jacobian, t, h, tolerance, closer, bundle, bl, fa, mem)
    if closer == 0:
        for i in range(mem.new.size):
            mem.new[i] = mem.predicted[i]
    before, limit, want = 0.0, _MAX_NEWTON, 1
    for iteration in range(_MAX_NEWTON + _MAX_LOCAL):
        if iteration >= limit:
            return Status.NOT_CONVERGED
        count.rhs_calls += 1
        if evaluate(t, mem.new, bundle, mem.slope, mem.rates, want) != Status.OK:
            return Status.REFUSED
        reset_moves(want, bundle, mem)
        if iteration == 0 and count.stale == 1:
            count.jacobians += 1
            count.jacobian_age = 0
        if renew(jacobian, t, gamma, bundle, bl, fa, mem) != Status.OK:
            return Status.REFUSED
        count.newton_iterations += 1
        if solve_correction(gamma, want, bundle, bl, fa, mem) != 1:
            return Status.NOT_CONVERGED
        swung = _move_all(bundle, fa, mem, want, iteration > 0)
        size = norm(change, weight)
        if not size < 1e12:
            return Status.NOT_CONVERGED
        if iteration > 0:
            control.convergence_rate = max(0.2 * control.convergence_rate, size / (before + 1e-300))
        # Secants hide the rate of convergence.
        rate = 1.0 if swung else control.convergence_rate
        good = size * min(1.0, rate) <= tolerance
        if good and mem.stages.shape[0] > 0:
            good = shared_norm(bundle, mem) * min(1.0, rate) <= _SHARED * tolerance
        if good and leak_of_iterate(bundle, mem, h) <= 1.0:
            finalise_step(bundle, mem)
            return Status.OK
        if iteration > 0 and size > _SLOW * before:
            _renew_slow(bundle, bl, mem, size)
            limit = min(limit + 1, _MAX_NEWTON + _MAX_LOCAL)
        want = 1 if good else choose_bypassed(tolerance, bundle, bl, mem)
        before = size
    return Status.NOT_CONVERGED
