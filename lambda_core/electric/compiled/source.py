"""The source between two of its corners: straight lines through points in time."""

from __future__ import annotations

import math

from lambda_core.electric.columns import ROTOR
from lambda_core.electric.compiled.array_types import helper, shared_helper


@shared_helper
def slope_at(now, source_t, source_v, place):
    """Move `place` to the segment of the source at `now`; return its slope [V/s] and its end [s]."""
    while place[0] < source_t.size - 2 and source_t[place[0] + 1] <= now:
        place[0] += 1
    k = place[0]
    length = source_t[k + 1] - source_t[k]
    if now >= source_t[k + 1]:
        return 0.0, math.inf
    return (source_v[k + 1] - source_v[k]) / length, source_t[k + 1]


@helper
def voltage_at(now, source_t, source_v, place):
    """Return the source's voltage on the segment that `place` is at [V]."""
    k = place[0]
    if now >= source_t[k + 1]:
        return source_v[k + 1]
    return source_v[k] + (source_v[k + 1] - source_v[k]) / (source_t[k + 1] - source_t[k]) * (now - source_t[k])


@helper
def source_work(n, winding, volt, slope, dt, before, after, s, area):
    """Return the work of the source over dt [J]: the integral of V C_w d(V - U).

    The part with U is taken by parts, so that it is exact with the exact integral of U.
    """
    integral = 0.0
    for a in range(n):
        integral += s[a, ROTOR] * area[a]
    end = volt + slope * dt
    return winding * (0.5 * (end - volt) * (end + volt) - (end * after - volt * before) + slope * integral)
