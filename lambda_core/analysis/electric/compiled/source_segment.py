"""Interpolate the source between its corners."""

from __future__ import annotations

import math

from lambda_core.analysis.electric.columns import ROTOR
from lambda_core.analysis.electric.compiled.array_types import helper


@helper
def slope_at(now, source):
    """Move `place` to the source's segment at `now`.

    Return its slope [V/s] and its end [s].
    """
    place, time, volt = source.place, source.time, source.volt
    while place[0] < time.size - 2 and time[place[0] + 1] <= now:
        place[0] += 1
    k = place[0]
    if now >= time[k + 1]:
        return 0.0, math.inf
    return (volt[k + 1] - volt[k]) / (time[k + 1] - time[k]), time[k + 1]


@helper
def voltage_at(now, source):
    """Return the source's voltage at `place` [V].

    `place` is on a segment of the source.
    """
    k, time, volt = source.place[0], source.time, source.volt
    if now >= time[k + 1]:
        return volt[k + 1]
    return volt[k] + (volt[k + 1] - volt[k]) / (time[k + 1] - time[k]) * (now - time[k])


@helper
def source_work(n, winding, volt, slope, dt, before, after, s, area):
    """Return the work of the source over dt [J].

    It is the integral of V C_w d(V - U).

    The part with U is taken by parts, so that it is exact with the exact integral of U.
    """
    integral = 0.0
    for a in range(n):
        integral += s[a, ROTOR] * area[a]
    end = volt + slope * dt
    return winding * (0.5 * (end - volt) * (end + volt) - (end * after - volt * before) + slope * integral)
