"""Define self-aligning ball bearings.

On a sphere of radius R a ball rests at the contact angle alpha: its centre lies R - D_w/2 from the middle, so that

    R = D_w/2 + (d_m/2 + G_r/4)/cos(alpha),   row distance = 2 (R - D_w/2) sin(alpha) = (d_m + G_r/2) tan(alpha).

Rings that go across the shaft touch after the radial clearance G_r, at alpha.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import replace
from typing import TYPE_CHECKING, Any

from lambda_core.domain.units import parse, show
from lambda_core.elements.ball.ball_kind import Angles, BallKind, Given, Shoulders
from lambda_core.elements.ball.two_rows import contact_angle, is_consistent
from lambda_core.formulas.kind_clearance import SELF_ALIGNING
from lambda_core.formulas.tolerances import Limits

if TYPE_CHECKING:
    from lambda_core.elements.ball.geometry import Geometry

# Height of SKF's inner rings, whose printed shoulder is the one on the loaded side, in ball diameters; a test computes
# it anew.
ALIGNING_SHOULDERS = Shoulders({"inner": 0.13}, "shoulder", "the mean of SKF's self-aligning ball bearings")
_NAME, _ARRANGEMENT = "self-aligning", "spherical"
_PATH = "bearing.clearance"
_AXIAL = "bearing.axial_clearance"
_OF_SPHERE = ("groove_radius_outer", "conformity_outer", "race_diameter_outer", "race_diameter_inner", "row_distance")


def _belongs(geometry: Mapping[str, Any]) -> bool:
    return geometry.get("arrangement") == _ARRANGEMENT


def _written(inline: Any) -> bool:
    return bool(inline.arrangement == _ARRANGEMENT)


def _thrusts(_: Geometry, row: int) -> tuple[int, ...]:
    """Return the thrust of a row's groove.

    The row on the left takes one to -x.
    """
    return (-1 if row == 0 else 1,)


def _words(geometry: Geometry, free: str) -> str:
    return f"two rows {geometry.arrangement}, {show(geometry.row_distance, 'length', 4)} apart, {free}"


def _resolve(given: Given) -> Angles | None:
    """Return angle and clearance; None after a problem."""
    if not is_consistent(given, _NAME, (_ARRANGEMENT,)):
        return None
    free = contact_angle(given)
    inline, bearing, ledger = given.inline, given.bearing, given.ledger
    for name in _OF_SPHERE:
        if getattr(inline, name) is not None:
            ledger.problem(
                f"bearing.geometry.{name}", "follows from ball, pitch, contact angle and clearance of the sphere"
            )
            return None
    if bearing.axial_clearance is not None:
        ledger.problem(_AXIAL, "a self-aligning bearing has a radial clearance: write bearing.clearance")
        return None
    text = bearing.clearance
    bought: Limits | None
    if text is None or given.named_class is not None:
        bought = given.class_of(SELF_ALIGNING, _PATH)
    elif text == "geometry":
        ledger.problem(_PATH, '"geometry" applies to grooves: for a self-aligning bearing write a class or a value')
        return None
    else:
        value = parse(text, "small_length")
        ledger.given(_PATH, value, "small_length")
        bought = Limits(value, value)
    if bought is None or math.isnan(free):
        return None
    return Angles(free, free, bought, _ARRANGEMENT, math.nan)


def on_sphere(geometry: Geometry, clearance: float) -> Geometry:
    """Return a self-aligning bearing with its sphere.

    The distance of its rows gives a radial clearance [m].
    """
    ball, pitch, angle = geometry.ball_diameter, geometry.pitch_diameter, geometry.contact_angle
    reach = (0.5 * pitch + 0.25 * clearance) / math.cos(angle)  # of the balls' centres from the bearing's
    sphere = reach + 0.5 * ball
    return replace(
        geometry,
        clearance=clearance,
        race_diameter_inner=pitch - ball - 0.5 * clearance,
        race_diameter_outer=2.0 * sphere,
        groove_radius_outer=sphere,
        row_distance=2.0 * reach * math.sin(angle),
    )


def sphere_edge(geometry: Geometry) -> float:
    """Return the sphere's diameter at the faces [m].

    The sphere ends at the faces of the outer ring.
    """
    return 2.0 * math.sqrt(max(geometry.groove_radius_outer**2 - 0.25 * geometry.width**2, 0.0))


KIND = BallKind(
    name=_NAME,
    title="Self-aligning ball bearing",
    belongs=_belongs,
    written=_written,
    resolve=_resolve,
    thrusts=_thrusts,
    words=_words,
    rows=2,
    arrangement=_ARRANGEMENT,
    arrangements=(_ARRANGEMENT,),
    on_sphere=True,
    filling=(220.0, 301.0),  # of each row, whose rings are swivelled out for it
    # 2.5 degrees of series 12 and 22, 3 of 13 and 23: SKF, general catalogue 6000, Russian, page 476, table 4.
    tilt=math.radians(2.5),
    tilt_words="self-aligning ball bearings take up to 44 mrad (2.5 deg; series 13 and 23: 3)",
    walls=(0.21, 0.85),  # the outer wall is that behind the sphere's middle
    width=(0.84, 1.22),  # the balls fill it
    shoulders=ALIGNING_SHOULDERS,
    outer_shoulder=sphere_edge,
    with_clearance=on_sphere,
)
