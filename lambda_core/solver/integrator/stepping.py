"""Choose, repeat and sample time steps.

It is that of every formula of integration: what a formula does in one step comes as functions. The sequence of steps
depends on nothing but the state, so a continued run is the uninterrupted one, bit for bit.
"""

from __future__ import annotations

from lambda_core.solver.integrator.blocks import blocks_t, factors_t
from lambda_core.solver.integrator.memory import evaluate_t, jacobian_t, memory_t
from lambda_core.solver.layout import bundle_t, f8, helper, i8
from lambda_core.solver.status import Status

_WORN = 0.5  # convergence rate at the end of a step beyond which it is renewed for all
_SAFETY = 0.55  # of the step that the error would just allow: few steps are refused
_GROWTH = 1.7  # of the step, at most; BDF2 is stable up to 2.4
_REGROWTH = 2.4  # the same behind a step that was cut to end at a stop
_STAY_CAREFUL = 4  # steps for which the iteration stays damped once that was needed
_MAX_AGE = 60  # steps after which the Jacobian is renewed in any case

advance_sig = i8(evaluate_t, jacobian_t, f8, i8, bundle_t, blocks_t, factors_t, memory_t)


@helper
def _take_samples(interpolate, mem, h):
    """Write the samples that lie in the step."""
    control, count = mem.control[0], mem.count[0]
    t = control.time + h
    while control.next_sample <= t and count.samples_waiting < mem.sample_t.size:
        row = count.samples_waiting
        interpolate(mem, t, h, control.next_sample, row)
        mem.sample_t[row] = control.next_sample
        count.samples_waiting += 1
        control.samples_taken += 1.0
        control.next_sample = control.samples_taken * control.sample_interval


@helper
def _length(control, history):
    """Return the length of the step.

    It is as planned, or ends at the stop, or halfway to it.

    Halfway, so that no step is cut to a small part of those before it. One that was cut does not change the plan.
    """
    h = control.step
    if history > 0:
        h = min(h, _REGROWTH * control.last_step)
    left = control.stop - control.time
    if left <= 0.0 or left >= 2.0 * h:
        return h
    return left if left <= h else 0.5 * left


@helper
def _accept(interpolate, shift, bundle, mem, h):
    """Accept the new point.

    Make it the current one, add to the integrals, take samples.
    """
    control, count = mem.control[0], mem.count[0]
    _take_samples(interpolate, mem, h)
    shift(bundle, mem, h)
    control.step_before, control.last_step = control.last_step, h
    control.time = control.stop if h == control.stop - control.time else control.time + h
    control.fourth_powers += h * h * h * h
    if count.history < 2:
        count.history += 1
    count.steps += 1
    count.jacobian_age += 1
    count.careful = max(count.careful - 1, 0)


@helper
def take_steps(begin, attempt, interpolate, shift, evaluate, jacobian, until, max_work, bundle, bl, fa, mem):
    """Take steps past `until`.

    They end earlier when the sample buffer is full or the work is done.

    Parameters
    ----------
    begin : function
        (evaluate, bundle, mem) -> Status: look at the state from which the first step goes.
    attempt : function
        (evaluate, jacobian, h, bundle, bl, fa, mem) -> Status, error over what is allowed, and the power of it that
        the step follows: try a step.
    interpolate : function
        (mem, t, h, at, row): write the state at `at` in (t - h, t] as a sample.
    shift : function
        (bundle, mem, h): make the new point the current one, advance the integrals.
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
        if count.history == 0 and begin(evaluate, bundle, mem) != Status.OK:
            return Status.REFUSED
        if count.jacobian_age > _MAX_AGE:
            count.stale = 1
        renewed = count.stale == 1
        while True:
            h = _length(control, count.history)
            outcome, error, power = attempt(evaluate, jacobian, h, bundle, bl, fa, mem)
            if outcome == Status.OK:
                factor = _SAFETY * (error + 1e-10) ** power
                if error <= 1.0:
                    break
                count.rejected += 1
                control.step = h * max(0.2, min(0.9, factor))
            else:
                count.failed += 1
                count.stale = 1
                bl.due[:] = 1
                if outcome == Status.REFUSED or count.careful > 0:
                    control.step = 0.3 * h
                if renewed:
                    count.careful = _STAY_CAREFUL
                renewed = True
            if control.step < control.shortest_step:
                return Status.REFUSED if outcome == Status.REFUSED else Status.STEP_TOO_SMALL
        _accept(interpolate, shift, bundle, mem, h)
        if control.convergence_rate > _WORN and control.convergence_rate < 1.0:
            count.stale = 1
        # Small changes of step are not worth a new factorisation.
        longer = min(h * min(_GROWTH, factor), control.longest_step)
        if factor < 1.0 or (factor > 1.15 and (h == control.step or longer > control.step)):
            control.step = longer
    return Status.OK if control.time >= until else Status.UNFINISHED
