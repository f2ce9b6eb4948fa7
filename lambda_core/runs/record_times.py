"""Choose the times at which a run records its integrals.

The grid depends on the case alone.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

from lambda_core.model.bearing_model import BearingModel
from lambda_core.model.laws.time_functions import peak
from lambda_core.runs.run_engine import RunEngine
from lambda_core.solver.drivers.engine import SAMPLES_PER_REVOLUTION

RECORDS_PER_REVOLUTION = 40


def record_interval(engine: RunEngine, models: Sequence[BearingModel]) -> float:
    """Return the time between records [s].

    It is simulated time, 1/40 of a nominal cage revolution.

    The engine's default of SAMPLES_PER_REVOLUTION says how long that is; with an
    interval of one's own, the inner ring's planned speed and D_w/d_m do, of the bearing whose cage turns fastest.
    """
    if not any(model.output.interval for model in models):
        return engine.sample_interval * SAMPLES_PER_REVOLUTION / RECORDS_PER_REVOLUTION
    found = []
    for model in models:
        speed = peak(model.inner_ring.dofs["spin"].motion)
        if speed == 0.0:
            return engine.sample_interval
        geometry = model.geometry
        cage = 0.5 * (1.0 - geometry.ball_diameter / geometry.pitch_diameter) * speed
        found.append(2.0 * math.pi / cage / RECORDS_PER_REVOLUTION)
    return min(found)


def next_multiple(now: float, interval: float) -> float:
    """Return the next multiple of `interval`.

    It lies after `now`, whatever the rounding.
    """
    number = math.floor(now / interval) + 1
    while number * interval <= now:
        number += 1
    return number * interval
