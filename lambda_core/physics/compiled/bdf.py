"""Our integrator: variable-step BDF of order 2 with a block-arrow Newton iteration.

Order 2 because lightly damped contact modes sit in the unstable wedge of the higher
orders. Error is controlled on absolute scales per state. The step sequence depends on
nothing but the state, so a continued run is the uninterrupted one, bit for bit.
"""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np
from numba import types

from lambda_core.physics.compiled.arrow import arrow_factor, arrow_solve, factors_t
from lambda_core.physics.compiled.jacobian import blocks_t
from lambda_core.physics.compiled.kinematics import axis_x
from lambda_core.physics.compiled.layout import (
    BVX,
    FREE,
    I_DRIVE,
    I_INPUT,
    I_INPUT_ABS,
    NB,
    NI,
    NS,
    SAY,
    SAZ,
    SHARED,
    SSIGMA,
    SVX,
    array1,
    array2,
    bundle_t,
    f8,
    helper,
    i8,
    iarray1,
)

evaluate_sig = i8(f8, array1, bundle_t, array1, array1, i8)
jacobian_sig = i8(f8, array1, bundle_t, blocks_t)
evaluate_t = types.FunctionType(evaluate_sig)
jacobian_t = types.FunctionType(jacobian_sig)

# control: reals of the integrator
T, H, H1, H2, G_FACTORED, RATE, NEXT_SAMPLE, SAMPLE_STEP, H_MAX, H_MIN, T_LAST = range(11)
N_CONTROL = 16
# count: integers of the integrator
(
    HISTORY,
    STEPS,
    REJECTED,
    NEWTON,
    RHS,
    JACOBIANS,
    FACTORS,
    STALE,
    SAMPLES,
    AGE,
    FAILED,
    CAREFUL,
    LOCAL,
) = range(13)
N_COUNT = 16

OK, FULL, STEP_TOO_SMALL, FAULT = 0, 1, 2, 3

_NEWTON_TOLERANCE = 0.3  # of the error allowed per step
_MAX_NEWTON = 4
_MAX_LOCAL = 4  # more iterations where Jacobians of single balls are renewed on the way
_REFACTOR = 0.41  # relative change of gamma beyond which M is factored anew; not a tie with one growth of the step
_SLOW = 0.3  # convergence rate beyond which the Jacobian is renewed for the balls that are to blame
_WORN = 0.5  # convergence rate at the end of a step beyond which it is renewed for all
_SHARE = 0.05  # of the squared last change, from which a ball's part of the Jacobian is renewed
_FIRST_ORDER = 1.0  # largest change of a power, over itself, that a linearisation is trusted with
_SAFETY = 0.7  # of the step that the error would just allow
_GROWTH = 1.7  # of the step, at most; BDF2 is stable up to 2.4
_SWING = 0.04  # share of its square by which a correction turns round before the secant is taken
_STAY_CAREFUL = 4  # steps for which the iteration keeps beginning at the last speeds once that was needed
_MAX_AGE = 60  # steps after which the Jacobian is renewed in any case


class Memory(NamedTuple):
    """Everything the integrator remembers; saved as it is for a continuation."""

    y: Any  # (n,) at control[T]
    y1: Any  # (n,) one step before
    y2: Any  # (n,) two steps before
    weight: Any  # (n,) 1 / (tolerance * scale)
    integrals: Any  # (NI,)
    rates: Any  # (NI,) at control[T]
    control: Any  # (N_CONTROL,)
    count: Any  # int64 (N_COUNT,)
    predicted: Any  # (n,)
    base: Any  # (n,)
    new: Any  # (n,)
    slope: Any  # (n,)
    change: Any  # (n,)
    last_change: Any  # (n,) Newton correction of the iteration before
    last_move: Any  # (n,) and the move that was made of it
    new_rates: Any  # (NI,)
    sample_y: Any  # (capacity, n)
    sample_t: Any  # (capacity,)


memory_t = types.NamedTuple(
    [{"count": iarray1, "sample_y": array2}.get(name, array1) for name in Memory._fields],
    Memory,
)
advance_sig = i8(evaluate_t, jacobian_t, f8, i8, bundle_t, blocks_t, factors_t, memory_t)


def make_memory(y0: np.ndarray, scale: np.ndarray, tolerance: float, capacity: int = 256) -> Memory:
    """Allocate for the initial state y0 and absolute scales, both (n,)."""
    n = y0.size

    def new() -> np.ndarray:
        return np.zeros(n)

    return Memory(
        y0.copy(),
        new(),
        new(),
        1.0 / (tolerance * scale),
        np.zeros(NI),
        np.zeros(NI),
        np.zeros(N_CONTROL),
        np.zeros(N_COUNT, dtype=np.int64),
        new(),
        new(),
        new(),
        new(),
        new(),
        new(),
        new(),
        np.zeros(NI),
        np.zeros((capacity, n)),
        np.zeros(capacity),
    )


@helper
def _norm(v, weight):
    total = 0.0
    for i in range(v.size):
        x = v[i] * weight[i]
        total += x * x
    return math.sqrt(total / v.size)


@helper
def _predict(mem, h):
    """Extrapolate to the next time; returns (gamma, share of the correction that is error)."""
    y, y1, y2 = mem.y, mem.y1, mem.y2
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
        ahead = h if history == 0 else h + h1
        return h, h / (h + ahead)
    w = h / h1
    a0, a1 = (1.0 + w) * (1.0 + w) / (1.0 + 2.0 * w), w * w / (1.0 + 2.0 * w)
    for i in range(y.size):
        d1 = (y[i] - y1[i]) / h1
        d2 = (d1 - (y1[i] - y2[i]) / h2) / (h1 + h2)
        predicted[i] = y[i] + h * (d1 + (h + h1) * d2)
        base[i] = a0 * y[i] - a1 * y1[i]
    own = h * h * h * (1.0 + w) * (1.0 + w) / (w * (1.0 + 2.0 * w))
    ahead = h * (h + h1) * (h + h1 + h2)
    return h * (1.0 + w) / (1.0 + 2.0 * w), own / (own + ahead)


@helper
def _start(bundle, mem):
    """Write where the Newton iteration begins: the extrapolation, or where care is needed the last step's speeds.

    Friction in a contact at rest is almost a sign function: from a speed on the wrong side of it the iteration
    does not come back, from the last speeds it does.
    """
    new, base, careful = mem.new, NB * bundle.system[0].balls, mem.count[CAREFUL] > 0
    for i in range(new.size):
        new[i] = mem.predicted[i]
        if careful and ((i < base and i % NB >= BVX) or (i >= base and bundle.active[i - base] % NS >= SVX)):
            new[i] = mem.y[i]


@helper
def _move(mem, first, last, relax, again):
    """Move the states first..last by their correction; where corrections swing to and fro, by the secant.

    The correction c(x) is to vanish. Where it turned round, the root along the last move m is at
    c - theta (m + c - c_0), theta = c.(c - c_0)/|c - c_0|^2: Anderson 1965, J. ACM 12, 547, with one difference.
    """
    change, before, moved = mem.change, mem.last_change, mem.last_move
    swing, size, difference, along = 0.0, 0.0, 0.0, 0.0
    for i in range(first, last):
        change[i] *= relax
        w2 = mem.weight[i] * mem.weight[i]
        d = change[i] - before[i]
        swing += w2 * change[i] * before[i]
        size += w2 * before[i] * before[i]
        difference += w2 * d * d
        along += w2 * change[i] * d
    theta = along / difference if again and swing < -_SWING * size else 0.0
    for i in range(first, last):
        move = change[i] - theta * (moved[i] + change[i] - before[i])
        before[i], moved[i] = change[i], move
        mem.new[i] += move


@helper
def _renew(jacobian, t, gamma, bundle, bl, fa, mem):
    """Bring the Jacobian, if it is due, and the factors to the point evaluated last; returns 1 when well."""
    control, count = mem.control, mem.count
    if count[STALE] == 1:
        if jacobian(t, mem.new, bundle, bl) != 1:
            return 0
        control[G_FACTORED] = 0.0
        count[STALE] = 0
    if abs(gamma / (control[G_FACTORED] + 1e-300) - 1.0) > _REFACTOR:
        count[FACTORS] += 1
        if arrow_factor(bl, 1.0, gamma, fa) != 1:
            return 0
        control[G_FACTORED] = gamma
        control[RATE] = 1.0
    return 1


@helper
def _mark_slow(bl, mem, size):
    """Mark the balls that make most of the last change, of the given norm; returns how many."""
    change, weight = mem.change, mem.weight
    bar = _SHARE * size * size * change.size
    marked = 0
    for j in range(bl.due.size):
        total = 0.0
        for i in range(NB * j, NB * j + NB):
            x = change[i] * weight[i]
            total += x * x
        bl.due[j] = 1 if total > bar else 0
        marked += bl.due[j]
    return marked


@helper
def _force_change(b, i, bl, mem):
    """Return the change of force or moment component i on body b by the last move, to first order."""
    move, balls = mem.last_move, bl.due.size
    total = 0.0
    for j in range(balls):
        for c in range(NB):
            total += bl.reach[j, b, i, c] * move[NB * j + c]
    for column in range(3 * NS):
        k = bl.index[column]
        if k >= 0:
            total += bl.shared[b, i, column] * move[NB * balls + k]
    return total


@helper
def _correct_power(b, bundle, bl, mem):
    """Bring the power of what holds or drives a ring from the last iterate to the result, to first order.

    Tractions change steeply with slip: an error of the iterate that no loss would feel is felt by the torque times
    the speed of the ring. Supports hold (forces.body_rates) what is not free. A change that is larger than the power
    itself is none to first order (friction at rest is nearly a sign function of slip) and is left out.
    """
    system = bundle.system[0]
    o, d = NS * b, 6 * b
    shared, rates = bundle.scratch[SHARED], mem.new_rates
    power, drive = 0.0, 0.0
    for i in range(3):
        if system.mode[d + i] != FREE and shared[o + SVX + i] != 0.0:
            power -= _force_change(b, i, bl, mem) * shared[o + SVX + i]
    if system.mode[d + 5] != FREE and shared[o + SSIGMA] != 0.0:
        ay, az = shared[o + SAY], shared[o + SAZ]
        about = _force_change(b, 3, bl, mem) * axis_x(ay, az)
        about += _force_change(b, 4, bl, mem) * ay + _force_change(b, 5, bl, mem) * az
        drive = -about * shared[o + SSIGMA]
        power += drive
    if abs(power) > _FIRST_ORDER * abs(rates[I_INPUT]):
        return
    rates[I_DRIVE] += drive
    rates[I_INPUT] += power
    rates[I_INPUT_ABS] = abs(rates[I_INPUT])


@helper
def _newton(evaluate, jacobian, t, gamma, bundle, bl, fa, mem):
    """Solve new = base + gamma f(new); returns 1 converged, 0 not, -1 a kernel refused.

    A ball that bounces on a raceway or in its pocket spoils the convergence of all: where it is slow, the Jacobian is
    renewed at the iterate for the balls that change most. The rates of the running integrals are those of the last
    iterate, which differs from the result by less than the error allowed per step; the power of what holds or drives a
    ring, which feels that most, is brought to first order.
    """
    new, change, weight, count, control = (
        mem.new,
        mem.change,
        mem.weight,
        mem.count,
        mem.control,
    )
    n = new.size
    _start(bundle, mem)
    careful = count[CAREFUL] > 0
    before, limit = 0.0, _MAX_NEWTON
    for iteration in range(_MAX_NEWTON + _MAX_LOCAL):
        if iteration >= limit:
            return 0
        count[RHS] += 1
        if evaluate(t, new, bundle, mem.slope, mem.new_rates, 1) != 1:
            return -1
        if iteration == 0 and count[STALE] == 1:
            count[JACOBIANS] += 1
            count[AGE] = 0
        if _renew(jacobian, t, gamma, bundle, bl, fa, mem) != 1:
            return -1
        count[NEWTON] += 1
        for i in range(n):
            change[i] = mem.base[i] + gamma * mem.slope[i] - new[i]
        arrow_solve(fa, change)
        # A matrix factored for another gamma over- or undershoots by a known amount.
        relax = 2.0 / (1.0 + gamma / control[G_FACTORED])
        again = iteration > 0 and careful
        for j in range(bundle.system[0].balls):
            _move(mem, NB * j, NB * j + NB, relax, again)
        _move(mem, NB * bundle.system[0].balls, n, relax, again)
        size = _norm(change, weight)
        if not size < 1e12:
            return 0
        if iteration > 0:
            control[RATE] = max(0.2 * control[RATE], size / (before + 1e-300))
            if careful and size > 2.0 * before and size > _NEWTON_TOLERANCE:
                return 0
        # Secants hide the rate of convergence.
        rate = 1.0 if careful else control[RATE]
        if size * min(1.0, rate) <= _NEWTON_TOLERANCE:
            for b in range(2):
                _correct_power(b, bundle, bl, mem)
            return 1
        if iteration > 0 and not careful and size > _SLOW * before:
            if _mark_slow(bl, mem, size) == 0:
                return 0
            count[LOCAL] += 1
            count[STALE] = 1
            limit = min(limit + 1, _MAX_NEWTON + _MAX_LOCAL)
        before = size
    return 0


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
def _accept(mem, h):
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
    for i in range(NI):
        mem.integrals[i] += 0.5 * h * (mem.rates[i] + mem.new_rates[i])
        mem.rates[i] = mem.new_rates[i]
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
        if count[HISTORY] == 0 and evaluate(control[T], mem.y, bundle, mem.y1, mem.rates, 1) != 1:
            return FAULT
        if count[AGE] > _MAX_AGE:
            count[STALE] = 1
        renewed = count[STALE] == 1
        while True:
            h = control[H]
            gamma, share = _predict(mem, h)
            ok = _newton(evaluate, jacobian, control[T] + h, gamma, bundle, bl, fa, mem)
            if ok == 1:
                for i in range(mem.change.size):
                    mem.change[i] = share * (mem.new[i] - mem.predicted[i])
                error = _norm(mem.change, mem.weight)
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
        _accept(mem, h)
        if control[RATE] > _WORN and control[RATE] < 1.0:
            count[STALE] = 1
        # Small changes of step are not worth a new factorisation.
        if factor > 1.15 or factor < 1.0:
            control[H] = min(h * min(_GROWTH, factor), control[H_MAX])
    return OK
