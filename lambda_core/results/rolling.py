"""Compute the cage speed of balls without slip.

They come from samples of a run and are the reference of cage slip.
"""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from lambda_core.formulas.kinematics import rolling_ratio

ROLLING = ("load", "contact_angle", "ball_radius", "ball_spin", "ball_velocity")  # channels that it takes


def rolling_of(samples: Mapping[str, NDArray[np.float64]], ball_diameter: float) -> float:
    """Return cage speed over inner ring speed.

    The balls do not slip; see :func:`.kinematics.rolling_ratio`.
    """
    radius = samples["ball_radius"]
    orbit = samples["ball_velocity"][..., 2] / radius
    return rolling_ratio(samples["load"], samples["contact_angle"], radius, samples["ball_spin"], orbit, ball_diameter)
