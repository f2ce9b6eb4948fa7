"""Loads and motions over time: values with two derivatives, and the shared state they prescribe."""

from __future__ import annotations

import math

from lambda_core.physics.compiled.layout import (
    CH_MOTION,
    NB,
    NS,
    PRESCRIBED,
    SAY,
    SAZ,
    SHARED,
    SSIGMA,
    SVX,
    SWY,
    SWZ,
    TF_CONSTANT,
    TF_HARMONIC,
    TF_RAMP,
    helper,
)


@helper
def evaluate_channels(t, terms, table, channels):
    """Write value, first and second derivative of every channel at time t [s]: (36, 3)."""
    channels[:, :] = 0.0
    for i in range(terms.shape[0]):
        channel = int(terms[i, 0])
        kind = int(terms[i, 1])
        if kind == TF_CONSTANT:
            channels[channel, 0] += terms[i, 2]
        elif kind == TF_RAMP:
            v0, v1, t0, t1 = terms[i, 2], terms[i, 3], terms[i, 4], terms[i, 5]
            if t <= t0:
                channels[channel, 0] += v0
            elif t >= t1:
                channels[channel, 0] += v1
            else:
                slope = (v1 - v0) / (t1 - t0)
                channels[channel, 0] += v0 + slope * (t - t0)
                channels[channel, 1] += slope
        elif kind == TF_HARMONIC:
            w = 2.0 * math.pi * terms[i, 3]
            s = terms[i, 2] * math.sin(w * t + terms[i, 4])
            c = terms[i, 2] * math.cos(w * t + terms[i, 4])
            channels[channel, 0] += s
            channels[channel, 1] += w * c
            channels[channel, 2] -= w * w * s
        else:
            _spline(t, table, int(terms[i, 6]), int(terms[i, 7]), channels, channel)


@helper
def _spline(t, table, start, count, channels, channel):
    """Add a cubic spline: per interval t_0, then coefficients of 1, u, u^2, u^3, u = t - t_0.

    The last row holds the end time and value; outside, the end values are held.
    """
    last = start + 5 * (count - 1)
    if t <= table[start]:
        channels[channel, 0] += table[start + 1]
        return
    if t >= table[last]:
        channels[channel, 0] += table[last + 1]
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
    channels[channel, 0] += c0 + u * (c1 + u * (c2 + u * c3))
    channels[channel, 1] += c1 + u * (2.0 * c2 + 3.0 * u * c3)
    channels[channel, 2] += 2.0 * c2 + 6.0 * u * c3


@helper
def fill_shared(t, y, bundle):
    """Write the whole shared state (36,) at time t: free entries from y, the others prescribed."""
    scratch = bundle.scratch
    system = bundle.system[0]
    shared, channels = scratch[SHARED], bundle.channels
    evaluate_channels(t, bundle.terms, bundle.table, channels)
    for body in range(3):
        o = NS * body
        for i in range(NS):
            shared[o + i] = 0.0
        for axis in range(3):
            if system.mode[6 * body + axis] == PRESCRIBED:
                shared[o + axis] = channels[CH_MOTION + 6 * body + axis, 0]
                shared[o + SVX + axis] = channels[CH_MOTION + 6 * body + axis, 1]
        # A small tilt (phi_y, phi_z) turns the axis to (1, phi_z, -phi_y).
        if system.mode[6 * body + 3] == PRESCRIBED:
            shared[o + SAZ] = -channels[CH_MOTION + 6 * body + 3, 0]
            shared[o + SWY] = channels[CH_MOTION + 6 * body + 3, 1]
        if system.mode[6 * body + 4] == PRESCRIBED:
            shared[o + SAY] = channels[CH_MOTION + 6 * body + 4, 0]
            shared[o + SWZ] = channels[CH_MOTION + 6 * body + 4, 1]
        if system.mode[6 * body + 5] == PRESCRIBED:
            shared[o + SSIGMA] = channels[CH_MOTION + 6 * body + 5, 0]
    active = bundle.active
    base = NB * system.balls
    for i in range(active.size):
        shared[active[i]] = y[base + i]
