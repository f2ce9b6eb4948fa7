"""Our integrator: variable-step BDF of order 2 with a block-arrow Newton iteration.

Order 2 because lightly damped contact modes sit in the unstable wedge of the higher orders. Error is controlled on
absolute scales per state, and by the energy that a step gives or takes. The step sequence depends on nothing but the
state, so a continued run is the uninterrupted one, bit for bit.
"""

from __future__ import annotations

from lambda_core.physics.compiled.arrow import factors_t
from lambda_core.physics.compiled.balance import add_to_integrals, leak_of_step
from lambda_core.physics.compiled.blocks import blocks_t
from lambda_core.physics.compiled.layout import NS, SHARED, bundle_t, f8, helper, i8
from lambda_core.physics.compiled.memory import (
    AGE,
    BDF_BACK,
    BDF_GAMMA,
    CAREFUL,
    FAILED,
    H1,
    H2,
    H_MAX,
    H_MIN,
    HISTORY,
    NEXT_SAMPLE,
    RATE,
    REJECTED,
    SAMPLE_STEP,
    SAMPLES,
    STALE,
    STEPS,
    T_LAST,
    H,
    T,
    evaluate_t,
    jacobian_t,
    memory_t,
)
from lambda_core.physics.compiled.newton import norm, solve_step

OK, FULL, STEP_TOO_SMALL, FAULT = 0, 1, 2, 3

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
    y, y1, y2, control = mem.y, mem.y1, mem.y2, mem.control
    predicted, base = mem.predicted, mem.base
    h1, h2 = mem.control[H1], mem.control[H2]
    history = mem.count[HISTORY]
    if history < 2:
        for i in range(y.size):
            if history == 0:
                predicted[i] = y[i] + h * y1[i]  # y1 holds dy/dt at the start
            else:
                predicted[i] = y[i] + h * (y[i] - y1[i]) / h1
            base[i] = y[i]
        control[BDF_GAMMA], control[BDF_BACK] = h, 0.0
        ahead = h if history == 0 else h + h1
        return h / (h + ahead)
    w = h / h1
    gamma, back = h * (1.0 + w) / (1.0 + 2.0 * w), w * w / (1.0 + 2.0 * w)
    control[BDF_GAMMA], control[BDF_BACK] = gamma, back
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
    h1 = mem.control[H1]
    out = mem.sample_y[row]
    x = at - t
    for i in range(out.size):
        d1 = (mem.new[i] - mem.y[i]) / h
        out[i] = mem.new[i] + x * d1
        if mem.count[HISTORY] > 0:
            d2 = (d1 - (mem.y[i] - mem.y1[i]) / h1) / (h + h1)
            out[i] += x * (x + h) * d2


@helper
def _accept(bundle, mem, h):
    """Make the new point the current one, add to the integrals, take samples."""
    control, count = mem.control, mem.count
    t = control[T] + h
    while control[NEXT_SAMPLE] <= t and count[SAMPLES] < mem.sample_t.size:
        row = count[SAMPLES]
        _interpolate(mem, t, h, control[NEXT_SAMPLE], row)
        mem.sample_t[row] = control[NEXT_SAMPLE]
        count[SAMPLES] += 1
        control[T_LAST] += 1.0
        control[NEXT_SAMPLE] = control[T_LAST] * control[SAMPLE_STEP]
    add_to_integrals(mem)
    for i in range(3 * NS):
        mem.shared1[i] = mem.shared[i]
        mem.shared[i] = bundle.scratch[SHARED, i]
    for i in range(mem.y.size):
        mem.y2[i] = mem.y1[i]
        mem.y1[i] = mem.y[i]
        mem.y[i] = mem.new[i]
    control[H2], control[H1] = control[H1], h
    control[T] = t
    if count[HISTORY] < 2:
        count[HISTORY] += 1
    count[STEPS] += 1
    count[AGE] += 1
    count[CAREFUL] = max(count[CAREFUL] - 1, 0)


def advance(evaluate, jacobian, until, max_steps, bundle, bl, fa, mem):
    """Take steps until control[T] >= until, the sample buffer is full, or `max_steps` were taken.

    Returns
    -------
    int
        OK, FULL (drain the samples or go on), STEP_TOO_SMALL, or FAULT (see scratch[FAULT]).
    """
    control, count = mem.control, mem.count
    for _ in range(max_steps):
        if control[T] >= until:
            return OK
        # One step may cross several sample times: leave room for all of them.
        if count[SAMPLES] + control[H_MAX] / control[SAMPLE_STEP] + 2.0 > mem.sample_t.size:
            return FULL
        if count[HISTORY] == 0:
            if evaluate(control[T], mem.y, bundle, mem.y1, mem.rates, 1) != 1:
                return FAULT
            for i in range(3 * NS):
                mem.shared[i] = bundle.scratch[SHARED, i]
        if count[AGE] > _MAX_AGE:
            count[STALE] = 1
        renewed = count[STALE] == 1
        while True:
            h = control[H]
            share = _predict(mem, h)
            ok = solve_step(evaluate, jacobian, control[T] + h, h, bundle, bl, fa, mem)
            if ok == 1:
                for i in range(mem.change.size):
                    mem.change[i] = share * (mem.new[i] - mem.predicted[i])
                error = norm(mem.change, mem.weight)
                if count[HISTORY] >= 2:
                    error = max(error, leak_of_step(mem, h))
                factor = _SAFETY * (error + 1e-10) ** (-1.0 / 3.0 if count[HISTORY] >= 2 else -0.5)
                if error <= 1.0:
                    break
                count[REJECTED] += 1
                control[H] = h * max(0.2, min(0.9, factor))
            else:
                count[FAILED] += 1
                count[STALE] = 1
                bl.due[:] = 1
                if ok == -1 or renewed:
                    control[H] = 0.3 * h
                if renewed:
                    count[CAREFUL] = _STAY_CAREFUL
                renewed = True
            if control[H] < control[H_MIN]:
                return FAULT if ok == -1 else STEP_TOO_SMALL
        _accept(bundle, mem, h)
        if control[RATE] > _WORN and control[RATE] < 1.0:
            count[STALE] = 1
        # Small changes of step are not worth a new factorisation.
        if factor > 1.15 or factor < 1.0:
            control[H] = min(h * min(_GROWTH, factor), control[H_MAX])
    return OK
