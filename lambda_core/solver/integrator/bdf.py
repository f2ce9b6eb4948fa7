"""Integrate by variable-step BDF of order 2.

The iteration is a block-arrow Newton one.

Order 2 because lightly damped contact modes sit in the unstable wedge of the higher orders. Error is controlled on
absolute scales per state, and by the energy that a step gives or takes.
"""

from __future__ import annotations

from lambda_core.solver.integrator.balance import add_to_integrals, keep_allowance, leak_of_step
from lambda_core.solver.integrator.correction import norm
from lambda_core.solver.integrator.newton import solve_step
from lambda_core.solver.integrator.stepping import take_steps
from lambda_core.solver.layout import helper
from lambda_core.solver.status import Status

# A ball at rest that the iteration leaves on the wrong side of static friction swings from step to step, as much in
# short steps as in long ones: no length of step would do. Where swings rule the step it is solved closer before its
# error is believed.
_SHORT = 0.01  # of the longest step: no vibration of a bearing is as fast
_QUIET = 0.1  # error over what is allowed: nothing to mend


@helper
def _begin(evaluate, bundle, mem):
    """Write dy/dt at the start into y1.

    It also writes the shared state.
    """
    if evaluate(mem.control[0].time, mem.y, bundle, mem.y1, mem.rates, 1) != Status.OK:
        return Status.REFUSED
    for i in range(mem.shared.size):
        mem.shared[i] = bundle.shared[i]
    return Status.OK


@helper
def _base_of_shared(mem):
    """Write the base of D(u) of what prescribed motions lead."""
    back = mem.control[0].back
    for i in range(mem.shared.size):
        mem.shared_base[i] = mem.shared[i] + back * (mem.shared[i] - mem.shared1[i])


@helper
def _predict(mem, h):
    """Extrapolate to the next time.

    Return the share of the correction that is error.

    Writes base and gamma of the quotient D(u) = (u - base)/gamma, base = u_1 + back (u_1 - u_2).
    """
    y, y1, y2, control = mem.y, mem.y1, mem.y2, mem.control[0]
    predicted, base = mem.predicted, mem.base
    h1, h2 = control.last_step, control.step_before
    history = mem.count[0].history
    if history < 2:
        for i in range(y.size):
            if history == 0:
                predicted[i] = y[i] + h * y1[i]  # y1 holds dy/dt at the start
            else:
                predicted[i] = y[i] + h * (y[i] - y1[i]) / h1
            base[i] = y[i]
        control.gamma, control.back = h, 0.0
        _base_of_shared(mem)
        ahead = h if history == 0 else h + h1
        return h / (h + ahead)
    w = h / h1
    gamma, back = h * (1.0 + w) / (1.0 + 2.0 * w), w * w / (1.0 + 2.0 * w)
    control.gamma, control.back = gamma, back
    _base_of_shared(mem)
    per_1, per_2, per_both = 1.0 / h1, 1.0 / h2, 1.0 / (h1 + h2)
    for i in range(y.size):
        d1 = (y[i] - y1[i]) * per_1
        d2 = (d1 - (y1[i] - y2[i]) * per_2) * per_both
        predicted[i] = y[i] + h * (d1 + (h + h1) * d2)
        base[i] = y[i] + back * (y[i] - y1[i])
    own = h * h * h * (1.0 + w) * (1.0 + w) / (w * (1.0 + 2.0 * w))
    ahead = h * (h + h1) * (h + h1 + h2)
    return own / (own + ahead)


@helper
def _interpolate(mem, t, h, at, row):
    """Write the state at `at` by a parabola.

    The time lies in (t - h, t], and the parabola goes through the last three points.
    """
    h1 = mem.control[0].last_step
    out = mem.sample_y[row]
    x = at - t
    for i in range(out.size):
        d1 = (mem.new[i] - mem.y[i]) / h
        out[i] = mem.new[i] + x * d1
        if mem.count[0].history > 0:
            d2 = (d1 - (mem.y[i] - mem.y1[i]) / h1) / (h + h1)
            out[i] += x * (x + h) * d2


@helper
def _error(mem, share):
    """Return the step's relative error.

    It is over what is allowed, which is a share of its distance from the extrapolation.
    """
    for i in range(mem.change.size):
        mem.change[i] = share * (mem.new[i] - mem.predicted[i])
    return norm(mem.change, mem.weight)


@helper
def _swings(mem, h):
    """Tell whether oscillation dissipates the energy.

    Nearly all that the scheme dissipates in this step is of speeds whose changes turned round.
    """
    w, swung, total = h / mem.control[0].last_step, 0.0, 0.0
    for i in range(mem.new.size):
        now, before = (mem.new[i] - mem.y[i]) / w, mem.y[i] - mem.y1[i]
        lost = mem.inertia[i] * (now - before) * (now - before)
        total += lost
        if now * before < 0.0:
            swung += lost
    return swung > 0.9 * total


@helper
def _attempt(evaluate, jacobian, h, bundle, bl, fa, mem):
    """Try a step; see stepping.take_steps."""
    share, history = _predict(mem, h), mem.count[0].history
    power = -1.0 / 3.0 if history >= 2 else -0.5
    error, closer = 0.0, 0
    while True:
        outcome = solve_step(evaluate, jacobian, mem.control[0].time + h, h, closer, bundle, bl, fa, mem)
        if outcome != Status.OK:
            return outcome, 0.0, power
        error = _error(mem, share)
        if history < 2:
            return outcome, error, power
        leak = leak_of_step(mem, h)
        error = max(error, leak)
        if closer == 1 or error <= _QUIET or h > _SHORT * mem.control[0].longest_step or not _swings(mem, h):
            return outcome, error, power
        closer = 1


@helper
def _shift(bundle, mem, h):
    """Make the new point current.

    The integrals change with it.
    """
    add_to_integrals(mem)
    if mem.count[0].history >= 2:
        keep_allowance(mem, h)
    for i in range(mem.shared.size):
        mem.shared1[i] = mem.shared[i]
        mem.shared[i] = bundle.shared[i]
    for i in range(mem.y.size):
        mem.y2[i] = mem.y1[i]
        mem.y1[i] = mem.y[i]
        mem.y[i] = mem.new[i]


def advance(evaluate, jacobian, until, max_work, bundle, bl, fa, mem):
    """Take steps; see stepping.take_steps."""
    return take_steps(_begin, _attempt, _interpolate, _shift, evaluate, jacobian, until, max_work, bundle, bl, fa, mem)
