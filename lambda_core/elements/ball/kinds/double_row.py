"""Define double row angular contact ball bearings.

With the distance A of the groove centres and the free contact angle alpha_0, rings that go G_a against each other from
one row's touch to the other's have the resting angle sin(alpha_s) = sin(alpha_0) - G_a/(2 A); below zero the rows press
on each other (the formulas of :mod:`lambda_core.elements.ball.kinds.four_point`).
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from lambda_core.domain.units import show
from lambda_core.elements.ball.ball_kind import Angles, BallKind, Given
from lambda_core.elements.ball.kinds.angular_contact import HIGH_SHOULDERS
from lambda_core.elements.ball.two_rows import contact_angle, is_consistent
from lambda_core.formulas.kind_clearance import DOUBLE_ROW
from lambda_core.formulas.tolerances import Limits

if TYPE_CHECKING:
    from lambda_core.elements.ball.geometry import Geometry

_NAME = "double row"
_ARRANGEMENTS = ("O", "X")
_PATH = "bearing.clearance"
_AXIAL = "bearing.axial_clearance"
_DISTANCE = "bearing.geometry.row_distance"


def _belongs(geometry: Mapping[str, Any]) -> bool:
    return int(geometry.get("rows", 1)) == 2 and str(geometry.get("arrangement", "")) in ("", *_ARRANGEMENTS)


def _written(inline: Any) -> bool:
    return bool(inline.rows == 2 and inline.arrangement in (None, *_ARRANGEMENTS))


def _thrusts(geometry: Geometry, row: int) -> tuple[int, ...]:
    """Return the thrust of a row's groove.

    Back to back, the row on the left takes one to +x.
    """
    left = 1 if geometry.arrangement == "O" else -1
    return (left if row == 0 else -left,)


def _words(geometry: Geometry, free: str) -> str:
    return f"two rows {geometry.arrangement}, {show(geometry.row_distance, 'length', 4)} apart, {free}"


def _resolve(given: Given) -> Angles | None:
    """Return angles, clearance and distance of the rows.

    The result is None after a problem.
    """
    if not is_consistent(given, _NAME, _ARRANGEMENTS):
        return None
    free, centres, ledger = contact_angle(given), given.centres, given.ledger
    apart, axial = _apart(given), _axial_clearance(given)
    if apart is None or axial is None or math.isnan(free) or math.isnan(centres):
        return None
    sine = math.sin(free) - 0.5 * axial / centres
    if not 0.0 < sine < 1.0:
        ledger.problem(_AXIAL, f"{show(axial, 'small_length', 4)} lets the balls leave their grooves")
        return None
    resting = math.asin(sine)
    clearance = 2.0 * centres * (math.cos(resting) - math.cos(free))
    ledger.record(_PATH, clearance, "small_length", "from contact angle and axial clearance", "derived")
    return Angles(free, resting, Limits(clearance, clearance), given.inline.arrangement or "O", apart)


def _apart(given: Given) -> float | None:
    inline, row, ledger = given.inline, given.row, given.ledger
    if inline.row_distance is not None:
        ledger.given("bearing.row_distance", inline.row_distance, "length")
        return float(inline.row_distance)
    if row is not None and row.row_distance is not None:
        apart, said = float(ledger.row("bearing.row_distance", row.row_distance, "length")), row.row_distance
        ledger.assume(f"bearing.row_distance {show(apart, 'length', 4)}: {said.source} (grade {said.grade})")
        return apart
    ledger.problem(_DISTANCE, "is required for two rows")
    return None


def _axial_clearance(given: Given) -> float | None:
    bearing, row, ledger = given.bearing, given.row, given.ledger
    if bearing.clearance is not None and (given.named_class is None or row is None):
        ledger.problem(_PATH, "is a radial clearance: for two rows write contact_angle and axial_clearance")
        return None
    if bearing.axial_clearance is not None:
        ledger.given(_AXIAL, bearing.axial_clearance, "small_length")
        return float(bearing.axial_clearance)
    if row is None:
        ledger.problem(_AXIAL, "is required for two rows")
        return None
    limits = given.class_of(DOUBLE_ROW, _AXIAL)
    return None if limits is None else given.picked(limits)


KIND = BallKind(
    name=_NAME,
    title="Double row angular contact ball bearing",
    belongs=_belongs,
    written=_written,
    resolve=_resolve,
    thrusts=_thrusts,
    words=_words,
    rows=2,
    arrangement="O",
    arrangements=_ARRANGEMENTS,
    filling=(177.0, 200.0),  # of each row
    # Double row deep groove ball bearings: "two minutes of arc"; of double row angular contact SKF says that only
    # forces between balls and raceways take a misalignment, without a number (general catalogue 6000, Russian, pages
    # 391 and 438).
    tilt=math.radians(2.0 / 60.0),
    tilt_words=(
        "two rigid rows take it only by forces between balls and raceways; double row deep groove ball bearings take "
        "up to 0.58 mrad (2 minutes of arc)"
    ),
    one_sided=True,
    shoulders=HIGH_SHOULDERS,
    axial_clearance="20 um",
)
