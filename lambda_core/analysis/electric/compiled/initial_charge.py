"""Compute the periodic initial charges of a network.

A source that has long been on restores these charges after each of its periods.
"""

from __future__ import annotations

from lambda_core.analysis.electric.columns import ROTOR
from lambda_core.analysis.electric.compiled.array_types import shared_helper
from lambda_core.analysis.electric.compiled.modes import decay_functions, propagate


@shared_helper
def periodic(n, decay, s, winding, times, volts, y, drive, after, area, mean):
    """Write the amplitudes `y` of a periodic state.

    A period of the source ends where it began, without a breakdown.

    From nothing, a period leaves y(T) = -lambda I with I the integral of y, as the source ends where it began; with a
    start y_0 that comes back, y_0 (1 - exp(-lambda T)) = -lambda I, so y_0 = -(I/T) lambda T/(1 - exp(-lambda T)). A
    mode without any leak is then free of a mean, which the smallest leak would take away in time.

    Parameters
    ----------
    times, volts : float64[:]
        Corners of one period of the source.
    drive, after, area, mean : float64[:]
        Workspace.
    """
    for a in range(n):
        y[a], mean[a] = 0.0, 0.0
    for k in range(times.size - 1):
        dt = times[k + 1] - times[k]
        for a in range(n):
            drive[a] = s[a, ROTOR] * winding * (volts[k + 1] - volts[k]) / dt
        propagate(n, decay, y, drive, dt, after, area)
        for a in range(n):
            y[a] = after[a]
            mean[a] += area[a]
    length = times[times.size - 1] - times[0]
    for a in range(n):
        _, first, _ = decay_functions(decay[a] * length)
        y[a] = -mean[a] / length / first
