"""Common-mode voltage of the winding as corners of straight lines: what each kind of source makes of a span of time."""

from __future__ import annotations

import math

import numpy as np

from lambda_core.case.electric import Inverter, Series, Sine, Step
from lambda_core.domain.arrays import FloatArray


def corners(
    source: Inverter | Sine | Step | Series, start: float, stop: float, speed: float
) -> tuple[FloatArray, FloatArray]:
    """Return times [s] and volts of the corners of a source over start..stop.

    Parameters
    ----------
    speed : float
        Of the rotor [rad/s], for the fundamental of an inverter.
    """
    length = stop - start
    if isinstance(source, Inverter):
        t, v = inverter(source, length, source.pole_pairs * abs(speed) / (2.0 * math.pi))
    elif isinstance(source, Sine):
        count = max(math.ceil(length * source.frequency * source.points), 1)
        t = np.arange(count + 1) / (source.frequency * source.points)
        v = source.amplitude * np.sin(2.0 * math.pi * source.frequency * t)
    elif isinstance(source, Step):
        t = np.array([0.0, source.time, source.time + source.rise_time, source.time + source.rise_time + length])
        v = np.array([0.0, 0.0, source.amplitude, source.amplitude])
        keep = np.concatenate([[True], np.diff(t) > 0.0])
        t, v = t[keep], v[keep]
    else:
        t, v = _repeated(np.array(source.rows), length)
    return t + start, v


def inverter(source: Inverter, length: float, fundamental: float) -> tuple[FloatArray, FloatArray]:
    """Return the common-mode voltage of a two-level inverter, (V_a + V_b + V_c)/3, over `length` [s].

    Sine-triangle modulation, the references held over each half period of the triangle (Holmes and Lipo 2003, Pulse
    Width Modulation for Power Converters, ch. 3). Levels +-U_dc/2 and +-U_dc/6; six edges of U_dc/3 per switching
    period, each a straight line of the rise time around its instant.
    """
    half = 0.5 / source.switching_frequency
    count = math.ceil(length / half) + 1
    begin = np.arange(count) * half
    phase = 2.0 * math.pi * (fundamental * begin[:, None] - np.arange(3)[None, :] / 3.0)
    reference = source.modulation * np.sin(phase)
    # On a rising flank of the triangle (from -1 to 1) a phase goes from + to - where the triangle passes it.
    rising = (np.arange(count) % 2 == 0)[:, None]
    share = 0.5 * (1.0 + np.where(rising, reference, -reference))
    share = np.clip(share, source.rise_time / half, 1.0 - source.rise_time / half)
    instant = (begin[:, None] + share * half).ravel()
    change = np.broadcast_to(np.where(rising, -1.0, 1.0), share.shape).ravel() * source.dc_link / 3.0
    first = 0.5 * source.dc_link  # at the triangle's lowest point all three are at +
    return _ramps(instant, change, source.rise_time, first, length)


def _ramps(
    instant: FloatArray, change: FloatArray, rise: float, first: float, length: float
) -> tuple[FloatArray, FloatArray]:
    """Return the corners of a sum of ramps around their instants, each over the rise time."""
    t = np.concatenate([instant - 0.5 * rise, instant + 0.5 * rise])
    slope = np.concatenate([change, -change]) / rise
    order = np.argsort(t, kind="stable")
    t, slope = t[order], np.cumsum(slope[order])
    level = np.concatenate([[0.0], np.cumsum(slope[:-1] * np.diff(t))])
    step = np.abs(change).max()
    still = np.abs(slope) < 1e-6 * step / rise
    flat = still | np.concatenate([[True], still[:-1]])
    level = np.where(flat, step * np.round(level / step), level)  # on the levels exactly, whatever was added up
    t, v = np.concatenate([[0.0], t, [max(length, t[-1] + rise)]]), np.concatenate([[0.0], level, level[-1:]]) + first
    keep = np.concatenate([[True], np.diff(t) > 0.0])
    return t[keep], v[keep]


def _repeated(rows: FloatArray, length: float) -> tuple[FloatArray, FloatArray]:
    """Return a measured series, repeated until `length` is over; its end joins its start over one more row's step."""
    t = rows[:, 0] - rows[0, 0]
    period = t[-1] + float(np.median(np.diff(t)))
    times = max(math.ceil(length / period), 1)
    found = (t[None, :] + period * np.arange(times)[:, None]).ravel()
    return np.append(found, period * times), np.append(np.tile(rows[:, 1], times), rows[0, 1])
