"""Define deep groove ball bearings."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

from lambda_core.elements.ball.ball_kind import BallKind

# "2 to 10 minutes of arc" for single deep-groove ball bearings: SKF, Rolling bearings, PUB BU/P1 17000 EN (2018).
TILT = math.radians(10.0 / 60.0)  # [rad]


def _belongs(geometry: Mapping[str, Any]) -> bool:
    angles = float(geometry.get("contact_angle", 0.0)), float(geometry.get("resting_angle", 0.0))
    return int(geometry.get("rows", 1)) == 1 and not geometry.get("arrangement") and max(angles) <= 0.0


KIND = BallKind(
    name="deep groove",
    title="Deep-groove ball bearing",
    belongs=_belongs,
    filling=(165.0, 198.0),
    tilt=TILT,
    tilt_words="deep-groove ball bearings take up to 2.9 mrad (10 minutes of arc)",
)
