"""Define single-row angular contact ball bearings."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from lambda_core.elements.ball.ball_kind import BallKind, Shoulders
from lambda_core.elements.ball.kinds.deep_groove import TILT

# Height of the high shoulder over the raceway in ball diameters: means of SKF's 72 BE and 73 BE in the catalogue
# (0.29 to 0.33 and 0.28 to 0.34); a test computes them anew.
HIGH_SHOULDERS = Shoulders(
    {"inner": 0.316, "outer": 0.309},
    "high shoulder",
    "the mean of SKF's 72 and 73 BE; the low one is not in the model",
)


def _belongs(geometry: Mapping[str, Any]) -> bool:
    resting = float(geometry.get("resting_angle", 0.0))
    alone = int(geometry.get("rows", 1)) == 1 and not geometry.get("arrangement")
    return alone and resting <= 0.0 and float(geometry.get("contact_angle", 0.0)) > 0.0


KIND = BallKind(
    name="angular contact",
    title="Angular contact ball bearing",
    belongs=_belongs,
    filling=(220.0, 325.0),
    tilt=TILT,
    tilt_words=(
        "of single row angular contact the maker gives no number, deep groove ball bearings take up to 2.9 mrad (10 "
        "minutes of arc)"
    ),
    one_sided=True,
    shoulders=HIGH_SHOULDERS,
)
