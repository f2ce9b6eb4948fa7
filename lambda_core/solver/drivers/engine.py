"""Report the end of an integration; choose samples."""

from __future__ import annotations

import math
from dataclasses import dataclass

from lambda_core.model.bearing_model import BearingModel
from lambda_core.model.laws.law_context import max_speed
from lambda_core.model.settings.resolve_solver import SAMPLES_PER_PERIOD

# Enough for ball passes and pocket impacts; each sample costs about three right-hand sides.
SAMPLES_PER_REVOLUTION = 100.0
_MUCH_FASTER = 1.5  # a planned cage speed over that at the start, from which on it counts
_SPIN_FOR_SAMPLES = 1.0  # [rad/s] slowest cage speed that the default sampling interval is made for
FIRST_STEP, SMALLEST_STEP = 1e-7, 1e-14  # [s]
WORK_PER_CALL = 500  # Newton iterations: some hundredths of a second


@dataclass(frozen=True)
class Advance:
    """End of one :meth:`MotionEngine.advance`."""

    ok: bool
    message: str  # a sentence with model, distribution, ball, ring, time and inputs when not ok


def usual_interval(model: BearingModel, orbit: float) -> float:
    """Return the default time between samples [s].

    Parameters
    ----------
    model : BearingModel
        With its planned speed, and what is followed.
    orbit : float
        Speed of the cage at the start [rad/s].
    """
    start, g, resolve = abs(orbit), model.geometry, model.solver.resolve
    planned = 0.5 * (1.0 - g.ball_diameter / g.pitch_diameter) * max_speed(model)
    cage_speed = max(start if planned < _MUCH_FASTER * start else planned, _SPIN_FOR_SAMPLES)
    interval = 2.0 * math.pi / cage_speed / SAMPLES_PER_REVOLUTION
    return min(interval, 1.0 / (SAMPLES_PER_PERIOD * resolve)) if resolve else interval
