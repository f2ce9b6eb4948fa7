"""Define common-mode voltages by corners of straight lines.

Every corner is found from the number of its period alone: a span that is cut into stretches has the same corners.
"""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np

from lambda_core.case.electric import Inverter, Series, Sine, Step
from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.errors import UsageError

Turned = Callable[[FloatArray], FloatArray]  # times [s] -> angles of the rotor [rad]
_MOST = 2e7  # corners of one stretch
_LATER = 1e6  # after the end, where nothing changes any more [s]


def corners(
    source: Inverter | Sine | Step | Series, start: float, stop: float, turned: Turned, origin: float | None = None
) -> tuple[FloatArray, FloatArray]:
    """Return the corners of a source.

    Times [s] and volts over start..stop at least.

    Parameters
    ----------
    turned : callable
        Angle of the rotor [rad] at times [s]: an inverter's fundamental turns with it.
    origin : float, optional
        When the source began [s]; default: `start`.
    """
    origin = start if origin is None else origin
    begin, end = start - origin, stop - origin
    expected = _rate(source) * (end - begin)
    if expected > _MOST:
        raise UsageError(
            f"the source has {expected:.2g} corners in {end - begin:.3g} s, at most {_MOST:g} are computed: "
            "shorten electric.duration, or give a slower source"
        )
    if isinstance(source, Inverter):
        t, v = inverter(source, begin, end, lambda times: turned(times + origin))
    elif isinstance(source, Sine):
        rate = source.frequency * source.points
        count = np.arange(math.floor(begin * rate), math.ceil(end * rate) + 1)
        t = count / rate
        v = source.amplitude * np.sin(2.0 * math.pi * (count % source.points) / source.points)
    elif isinstance(source, Step):
        t = np.array([0.0, source.time, source.time + source.rise_time, source.time + source.rise_time + _LATER])
        v = np.array([0.0, 0.0, source.amplitude, source.amplitude])
        keep = np.concatenate([[True], np.diff(t) > 0.0])
        t, v = t[keep], v[keep]
    else:
        t, v = (_repeated if source.repeat else _held)(np.array(source.rows), begin, end)
    return t + origin, v


def period_of(rows: FloatArray) -> float:
    """Return after how long a measured series begins again [s].

    A series that ends at the voltage that it began with is one whole period. Otherwise its last row is one of the
    period, and the first row follows after the median distance of rows.
    """
    length = float(rows[-1, 0] - rows[0, 0])
    return length if rows[-1, 1] == rows[0, 1] else length + float(np.median(np.diff(rows[:, 0])))


def _rate(source: Inverter | Sine | Step | Series) -> float:
    """Return corners per second."""
    if isinstance(source, Inverter):
        return 16.0 * source.switching_frequency
    if isinstance(source, Sine):
        return source.frequency * source.points
    if isinstance(source, Step):
        return 0.0
    return len(source.rows) / period_of(np.array(source.rows)) if source.repeat else 0.0


def one_period(source: Inverter | Sine | Step | Series, origin: float, turned: Turned) -> tuple[FloatArray, FloatArray]:
    """Return the corners of a source's first period.

    The period began at `origin` [s]; a source without a period has no corners.

    The voltage ends where it began.
    """
    if isinstance(source, Inverter):
        return inverter(source, 0.0, 1.0 / source.switching_frequency, lambda times: turned(times + origin))
    if isinstance(source, Sine):
        count = np.arange(source.points + 1)
        volts = source.amplitude * np.sin(2.0 * math.pi * (count % source.points) / source.points)
        return count / (source.frequency * source.points), volts
    if isinstance(source, Series) and source.repeat:
        return _repeated(np.array(source.rows), 0.0, 0.0)
    return np.zeros(0), np.zeros(0)  # an edge, or a series that is not repeated


def reach(source: Inverter | Sine | Step | Series) -> float:
    """Return the known time ahead of the rotor [s].

    The voltage is known for this time ahead of the rotor's last known angle; 0 where it needs none.
    """
    return 1.0 / source.switching_frequency if isinstance(source, Inverter) else 0.0


def inverter(source: Inverter, start: float, stop: float, turned: Turned) -> tuple[FloatArray, FloatArray]:
    """Return the common-mode voltage of an inverter [V].

    Two-level inverter, (V_a + V_b + V_c)/3, over start..stop [s].

    Sine-triangle modulation, the references held over each half period of the triangle (Holmes and Lipo 2003, Pulse
    Width Modulation for Power Converters, ch. 3). Levels +-U_dc/2 and +-U_dc/6; six edges of U_dc/3 per switching
    period, each a straight line of the rise time around its instant. Half periods are whole: three edges each.
    """
    half = 0.5 / source.switching_frequency
    first = max(math.floor(start / half * (1.0 - 1e-15)), 0)
    number = np.arange(first, max(math.ceil(stop / half), first + 1))
    begin = np.asarray(number * half, dtype=np.float64)
    phase = source.pole_pairs * turned(begin)[:, None] - 2.0 * math.pi / 3.0 * np.arange(3)[None, :]
    reference = source.modulation * np.sin(phase)
    # On a rising flank of the triangle (from -1 to 1) a phase goes from + to - where the triangle passes it.
    rising = (number % 2 == 0)[:, None]
    share = 0.5 * (1.0 + np.where(rising, reference, -reference))
    share = np.clip(share, source.rise_time / half, 1.0 - source.rise_time / half)
    instant = begin[:, None] + share * half
    change = np.where(rising, -1.0, 1.0) * source.dc_link / 3.0
    t, v = _ramps(instant, change, source.rise_time)
    v += np.where(rising, 0.5, -0.5) * source.dc_link  # at the triangle's lowest point all three are at +
    t = np.concatenate([begin[:1], t.ravel(), [(number[-1] + 1) * half]])
    v = np.concatenate([v[0, :1], v.ravel(), v[-1, -1:]])
    keep = np.concatenate([[True], np.diff(t) > 0.0])
    return t[keep], v[keep]


def _ramps(instant: FloatArray, change: FloatArray, rise: float) -> tuple[FloatArray, FloatArray]:
    """Return the corners of sums of ramps.

    Each ramp lies around its instant and takes the rise time; the corners start at 0, row by row.
    """
    t = np.concatenate([instant - 0.5 * rise, instant + 0.5 * rise], axis=1)
    slope = np.concatenate([np.broadcast_to(change, instant.shape), np.broadcast_to(-change, instant.shape)], axis=1)
    order = np.argsort(t, axis=1, kind="stable")
    t = np.take_along_axis(t, order, axis=1)
    slope = np.cumsum(np.take_along_axis(slope, order, axis=1) / rise, axis=1)
    level = np.concatenate([np.zeros((len(t), 1)), np.cumsum(slope[:, :-1] * np.diff(t, axis=1), axis=1)], axis=1)
    step = np.abs(change).max()
    still = np.abs(slope) < 1e-6 * step / rise
    flat = still | np.concatenate([np.ones((len(t), 1), bool), still[:, :-1]], axis=1)
    return t, np.where(flat, step * np.round(level / step), level)  # on the levels exactly, whatever was added up


def _held(rows: FloatArray, start: float, stop: float) -> tuple[FloatArray, FloatArray]:
    """Return a measured series with constant ends.

    Its first voltage holds before it and its last one after it.
    """
    first, last = min(start, rows[0, 0]) - 1.0, max(stop, rows[-1, 0]) + _LATER
    return np.array([first, *rows[:, 0], last]), np.array([rows[0, 1], *rows[:, 1], rows[-1, 1]])


def _repeated(rows: FloatArray, start: float, stop: float) -> tuple[FloatArray, FloatArray]:
    """Return a measured series, repeated over start..stop.

    A straight line joins its ends where the series does not close.
    """
    begin, period = rows[0, 0], period_of(rows)
    t = rows[:, 0] - begin
    if rows[-1, 1] == rows[0, 1]:
        t, rows = t[:-1], rows[:-1]
    first = math.floor((start - begin) / period)
    turn = np.arange(first, max(math.ceil((stop - begin) / period), first + 1))
    found = begin + (t[None, :] + period * turn[:, None]).ravel()
    return np.append(found, begin + period * (turn[-1] + 1)), np.append(np.tile(rows[:, 1], turn.size), rows[0, 1])
