"""Our integrator: variable-step BDF of order 2 with a block-arrow Newton iteration.

Order 2 because lightly damped contact modes sit in the unstable wedge of the higher orders. Error is controlled on
absolute scales per state, and by the energy that a step gives or takes. The step sequence depends on nothing but the
state, so a continued run is the uninterrupted one, bit for bit.
"""

from __future__ import annotations

from lambda_core.solver.integrator.arrow import factors_t
from lambda_core.solver.integrator.balance import add_to_integrals, leak_of_step
from lambda_core.solver.integrator.blocks import blocks_t
from lambda_core.solver.integrator.memory import evaluate_t, jacobian_t, memory_t
from lambda_core.solver.integrator.newton import norm, solve_step
from lambda_core.solver.layout import bundle_t, f8, helper, i8
from lambda_core.solver.status import Status

_WORN = 0.5  # convergence rate at the end of a step beyond which it is renewed for all
_SAFETY = 0.55  # of the step that the error would just allow: few steps are refused
_GROWTH = 1.7  # of the step, at most; BDF2 is stable up to 2.4
_STAY_CAREFUL = 4  # steps for which the iteration keeps beginning at the last speeds once that was needed
_MAX_AGE = 60  # steps after which the Jacobian is renewed in any case


advance_sig = i8(evaluate_t, jacobian_t, f8, i8, bundle_t, blocks_t, factors_t, memory_t)


@helper
def _predict(mem, h):
    """Extrapolate to the next time; returns the share of the correction that is error.

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
        ahead = h if history == 0 else h + h1
        return h / (h + ahead)
    w = h / h1
    gamma, back = h * (1.0 + w) / (1.0 + 2.0 * w), w * w / (1.0 + 2.0 * w)
    control.gamma, control.back = gamma, back
    for i in range(y.size):
        d1 = (y[i] - y1[i]) / h1
        d2 = (d1 - (y1[i] - y2[i]) / h2) / (h1 + h2)
        predicted[i] = y[i] + h * (d1 + (h + h1) * d2)
        base[i] = y[i] + back * (y[i] - y1[i])
    own = h * h * h * (1.0 + w) * (1.0 + w) / (w * (1.0 + 2.0 * w))
    ahead = h * (h + h1) * (h + h1 + h2)
    return own / (own + ahead)


@helper
def _interpolate(mem, t, h, at, row):
    """Write the state at `at` in (t - h, t] from the parabola through the last three points."""
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
def _accept(bundle, mem, h):
    """Make the new point the current one, add to the integrals, take samples."""
    control, count = mem.control[0], mem.count[0]
    t = control.time + h
    while control.next_sample <= t and count.samples_waiting < mem.sample_t.size:
        row = count.samples_waiting
        _interpolate(mem, t, h, control.next_sample, row)
        mem.sample_t[row] = control.next_sample
        count.samples_waiting += 1
        control.samples_taken += 1.0
        control.next_sample = control.samples_taken * control.sample_interval
    add_to_integrals(mem)
    for i in range(mem.shared.size):
        mem.shared1[i] = mem.shared[i]
        mem.shared[i] = bundle.shared[i]
    for i in range(mem.y.size):
        mem.y2[i] = mem.y1[i]
        mem.y1[i] = mem.y[i]
        mem.y[i] = mem.new[i]
    control.step_before, control.last_step = control.last_step, h
    control.time = t
    if count.history < 2:
        count.history += 1
    count.steps += 1
    count.jacobian_age += 1
    count.careful = max(count.careful - 1, 0)


def advance(evaluate, jacobian, until, max_work, bundle, bl, fa, mem):
    """Take steps until the time is past `until`, the sample buffer is full, or the work is done.

    Parameters
    ----------
    max_work : int
        Newton iterations, those of refused steps included, after which the caller is asked to go on: nobody hears
        a signal or looks at a clock meanwhile. Steps are the same however often that is.

    Returns
    -------
    int
        A Status: OK, BUFFER_FULL, UNFINISHED, STEP_TOO_SMALL, or REFUSED (see scratch.fault).
    """
    control, count = mem.control[0], mem.count[0]
    enough = count.newton_iterations + max_work
    while control.time < until and count.newton_iterations < enough:
        # The step in hand, which below gets only shorter, may cross several sample times: leave room for all of them.
        room = (mem.sample_t.size - 2 - count.samples_waiting) * control.sample_interval
        if control.step > room:
            if count.samples_waiting > 0:
                return Status.BUFFER_FULL
            control.step = room
        if count.history == 0:
            if evaluate(control.time, mem.y, bundle, mem.y1, mem.rates, 1) != Status.OK:
                return Status.REFUSED
            for i in range(mem.shared.size):
                mem.shared[i] = bundle.shared[i]
        if count.jacobian_age > _MAX_AGE:
            count.stale = 1
        renewed = count.stale == 1
        while True:
            h = control.step
            share = _predict(mem, h)
            outcome = solve_step(evaluate, jacobian, control.time + h, h, bundle, bl, fa, mem)
            if outcome == Status.OK:
                for i in range(mem.change.size):
                    mem.change[i] = share * (mem.new[i] - mem.predicted[i])
                error = norm(mem.change, mem.weight)
                if count.history >= 2:
                    error = max(error, leak_of_step(mem, h))
                factor = _SAFETY * (error + 1e-10) ** (-1.0 / 3.0 if count.history >= 2 else -0.5)
                if error <= 1.0:
                    break
                count.rejected += 1
                control.step = h * max(0.2, min(0.9, factor))
            else:
                count.failed += 1
                count.stale = 1
                bl.due[:] = 1
                if outcome == Status.REFUSED or renewed:
                    control.step = 0.3 * h
                if renewed:
                    count.careful = _STAY_CAREFUL
                renewed = True
            if control.step < control.shortest_step:
                return Status.REFUSED if outcome == Status.REFUSED else Status.STEP_TOO_SMALL
        _accept(bundle, mem, h)
        if control.convergence_rate > _WORN and control.convergence_rate < 1.0:
            count.stale = 1
        # Small changes of step are not worth a new factorisation.
        if factor > 1.15 or factor < 1.0:
            control.step = min(h * min(_GROWTH, factor), control.longest_step)
    return Status.OK if control.time >= until else Status.UNFINISHED
