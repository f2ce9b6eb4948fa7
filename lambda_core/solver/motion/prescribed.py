"""Evaluate prescribed loads and motions over time.

It gives values with two derivatives.
"""

from __future__ import annotations

import math

import numpy as np

from lambda_core.solver.arrays.fault_roles import TIME_FUNCTION
from lambda_core.solver.faults import report
from lambda_core.solver.layout import helper, part, time_law
from lambda_core.solver.records import CONSTANT, GIVEN, HARMONIC, LAW, PRESCRIBED, RAMP


@helper
def _by_law(t, term, bundle, signal):
    """Add amplitude * f(t) of a law.

    Return 1 when well.
    """
    scratch = bundle.scratch[0]
    out = scratch.out[:]
    out[:3] = np.nan
    status = time_law(bundle.laws.times, term.law)(t, part(bundle.par, term.parameters), out)
    if status != 1 or not abs(out[0]) + abs(out[1]) + abs(out[2]) < np.inf:
        return report(scratch.fault, TIME_FUNCTION, status, term.law, t, out[0], out[1], out[2])
    signal.value += term.amplitude * out[0]
    signal.rate += term.amplitude * out[1]
    signal.acceleration += term.amplitude * out[2]
    return 1


@helper
def evaluate_signals(t, bundle):
    """Write every signal at time t [s].

    It has a value, a first and a second derivative; return 1 when well.
    """
    terms, table, signals = bundle.terms, bundle.table, bundle.signals
    for i in range(signals.size):
        signal = signals[i]
        signal.value, signal.rate, signal.acceleration = 0.0, 0.0, 0.0
    for i in range(terms.size):
        term = terms[i]
        signal = signals[term.signal]
        if term.kind == CONSTANT:
            signal.value += term.value
        elif term.kind == GIVEN:
            u = t - term.begin
            signal.value += term.value + u * (term.rate + 0.5 * u * term.acceleration)
            signal.rate += term.rate + u * term.acceleration
            signal.acceleration += term.acceleration
        elif term.kind == RAMP:
            if t <= term.begin:
                signal.value += term.before
            elif t >= term.end:
                signal.value += term.after
            else:
                slope = (term.after - term.before) / (term.end - term.begin)
                signal.value += term.before + slope * (t - term.begin)
                signal.rate += slope
        elif term.kind == HARMONIC:
            w = 2.0 * math.pi * term.frequency
            s = term.amplitude * math.sin(w * t + term.phase)
            c = term.amplitude * math.cos(w * t + term.phase)
            signal.value += s
            signal.rate += w * c
            signal.acceleration -= w * w * s
        elif term.kind == LAW:
            if _by_law(t, term, bundle, signal) != 1:
                return 0
        else:
            _spline(t, table, term.start, term.knots, signal)
    return 1


@helper
def _spline(t, table, start, count, signal):
    """Add a cubic spline.

    Each interval has t_0, then coefficients of 1, u, u^2, u^3, with u = t - t_0.

    The last row holds the end time and value; outside, the end values are held.
    """
    last = start + 5 * (count - 1)
    if t <= table[start]:
        signal.value += table[start + 1]
        return
    if t >= table[last]:
        signal.value += table[last + 1]
        return
    low, high = 0, count - 1
    while high - low > 1:
        middle = (low + high) // 2
        if table[start + 5 * middle] <= t:
            low = middle
        else:
            high = middle
    i = start + 5 * low
    u = t - table[i]
    c0, c1, c2, c3 = table[i + 1], table[i + 2], table[i + 3], table[i + 4]
    signal.value += c0 + u * (c1 + u * (c2 + u * c3))
    signal.rate += c1 + u * (2.0 * c2 + 3.0 * u * c3)
    signal.acceleration += 2.0 * c2 + 6.0 * u * c3


@helper
def _prescribe(body, inputs, now):
    """Write what is prescribed of a body's state."""
    for axis in range(3):
        if body.mode[axis] == PRESCRIBED:
            now.position[axis] = inputs.motion[axis].value
            now.velocity[axis] = inputs.motion[axis].rate
    # A small tilt (phi_y, phi_z) turns the axis to (1, phi_z, -phi_y).
    if body.mode[3] == PRESCRIBED:
        now.tilt[1] = -inputs.motion[3].value
        now.tilt_velocity[0] = inputs.motion[3].rate
    if body.mode[4] == PRESCRIBED:
        now.tilt[0] = inputs.motion[4].value
        now.tilt_velocity[1] = inputs.motion[4].rate
    if body.mode[5] == PRESCRIBED:
        now.spin = inputs.motion[5].value


@helper
def fill_shared(t, y, bundle):
    """Write the complete shared state at t.

    Free entries and the states of contacts come from y; the other entries are prescribed.

    Returns 1 when well.
    """
    shared = bundle.shared
    if evaluate_signals(t, bundle) != 1:
        return 0
    for i in range(shared.size):
        shared[i] = 0.0
    for b in range(bundle.bodies.size):
        _prescribe(bundle.bodies[b], bundle.inputs[b], bundle.bodies_now[b])
    active = bundle.active
    base = bundle.system[0].tail
    for i in range(active.size):
        shared[active[i]] = y[base + i]
    base += active.size
    for i in range(bundle.states.size):
        bundle.states[i] = y[base + i]
    return 1
