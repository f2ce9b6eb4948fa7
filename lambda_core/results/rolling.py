"""Compute the speeds of cages.

That of balls without slip comes from samples of a run and is the reference of cage slip.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from lambda_core.domain.channels import RINGS
from lambda_core.formulas.kinematics import rolling_ratio

# Channels that it takes.
ROLLING = (
    "load", "contact_angle", "semi_axis_a", "ball_radius", "ball_azimuth", "ball_spin", "ball_velocity",
    "body_position",
)  # fmt: skip
SECOND_CAGE = ("second_cage_spin_angle", "body_spin_angle")  # likewise, of the second row's cage
# y/a of the two lines without slip in a groove: half of Hertz's load lies between them, 3 y/a - (y/a)^3 = 1, so that
# friction that grows with pressure pulls forwards and backwards alike (Johnson 1985, Contact Mechanics, section 8.5).
ROLLING_LINE = 2.0 * math.sin(math.radians(10.0))


def is_full_complement(model: Mapping[str, Any]) -> bool:
    """Tell whether rollers of a resolved model have no cage.

    Balls without one have their cage left out.
    """
    return model.get("rollers") is not None and not model["depth"]["cage"]


def rolling_of(samples: Mapping[str, NDArray[np.float64]], geometry: Mapping[str, Any], *, are_rollers: bool) -> float:
    """Return cage speed over inner ring speed.

    The balls do not slip; see :func:`.kinematics.rolling_ratio`.

    A ball touches its groove on a surface of the radius R_m = 2 R r/(R + r) across rolling (Harris and Kotzalas 2006,
    vol. 2, ch. 2). It rolls on two lines at y, y^2/(2 R_m) over the middle; a roller touches on a straight line.
    """
    radius, azimuth, diameter = samples["ball_radius"], samples["ball_azimuth"], float(geometry["ball_diameter"])
    place = samples["body_position"]
    apart = (place[..., 0, :] - place[..., 1, :])[..., None, :]
    rise = None
    if not are_rollers:
        groove = np.array([float(geometry[f"groove_radius_{ring}"]) for ring in RINGS])
        touching = diameter * groove / (0.5 * diameter + groove)
        rise = 0.5 * (ROLLING_LINE * samples["semi_axis_a"]) ** 2 / touching
    return rolling_ratio(
        samples["load"], samples["contact_angle"], radius, samples["ball_spin"],
        samples["ball_velocity"][..., 2] / radius, diameter,
        approach=apart[..., 1] * np.cos(azimuth) + apart[..., 2] * np.sin(azimuth), rise=rise,
    )  # fmt: skip


def second_cage_ratio(blocks: Iterable[Mapping[str, NDArray[np.float64]]]) -> float:
    """Return the second cage's speed over inner ring speed.

    It is the mean over all samples, relative to the outer ring; NaN without samples.

    Parameters
    ----------
    blocks : iterable of mappings
        SECOND_CAGE, samples block by block.
    """
    turned, rings = SECOND_CAGE
    ends = [
        np.array([block[turned][row], *block[rings][row, :2]])
        for block in blocks
        if block[turned].size
        for row in (0, -1)
    ]
    cage, inner, outer = ends[-1] - ends[0] if ends else (0.0, 0.0, 0.0)
    return float((cage - outer) / (inner - outer)) if inner != outer else math.nan
