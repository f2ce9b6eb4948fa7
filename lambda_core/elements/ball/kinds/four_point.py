"""Define four-point contact ball bearings.

With the distance A of the groove centres, the free contact angle alpha_0 and the resting angle alpha_s, that of the
shims which the arcs are ground with, rings that move against each other until balls touch have

    axial clearance   G_a = 2 A (sin(alpha_0) - sin(alpha_s)),
    radial clearance  G_r = 2 A (cos(alpha_s) - cos(alpha_0))

(Harris and Kotzalas 2006, ch. 2: P_d = S_d + 2 A (1 - cos(alpha_s)) and cos(alpha_0) = 1 - P_d/(2 A)).
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, NamedTuple

from lambda_core.domain.units import parse, show
from lambda_core.elements.ball.ball_kind import Angles, BallKind, Given, Shoulders
from lambda_core.elements.ball.kinds.deep_groove import TILT
from lambda_core.formulas.kind_clearance import FOUR_POINT as CLEARANCES
from lambda_core.formulas.tolerances import Limits

if TYPE_CHECKING:
    from lambda_core.elements.ball.geometry import Geometry

# Heights of shoulders in ball diameters of SKF's QJ: inner rings of those without a recess in their shoulders, outer
# rings of all; a test computes them anew.
FOUR_POINT_SHOULDERS = Shoulders({"inner": 0.247, "outer": 0.240}, "shoulders", "the mean of SKF's QJ")
# Axial over radial load from which on the balls of four-point contact run on one side: SKF, general catalogue 6000.
ONE_SIDE = 1.27
_PATH = "bearing.clearance"
_SHIM = "bearing.geometry.shim_angle"
_AXIAL = "bearing.axial_clearance"


class Resting(NamedTuple):
    """Angles [rad] and radial internal clearance, diametral [m]."""

    free: float
    resting: float
    clearance: float


def _belongs(geometry: Mapping[str, Any]) -> bool:
    alone = int(geometry.get("rows", 1)) == 1 and not geometry.get("arrangement")
    return alone and float(geometry.get("resting_angle", 0.0)) > 0.0


def _written(inline: Any) -> bool:
    return bool(inline.shim_angle)


def _thrusts(_: Geometry, __: int) -> tuple[int, ...]:
    return (1, -1)


def _words(geometry: Geometry, free: str) -> str:
    return f"four-point {free}shims {show(geometry.resting_angle, 'angle', 3)}, "


def _resolve(given: Given) -> Angles | None:
    """Return angles and clearance of four-point contact.

    The result is None after a problem.
    """
    bearing, distance, ledger = given.bearing, given.centres, given.ledger
    shim = given.inline.shim_angle
    free = _free_angle(given)
    if math.isnan(distance):
        return None
    value = bearing.clearance if given.named_class is None else None
    if value == "geometry":
        ledger.problem(_PATH, '"geometry" applies to single grooves only: give the shim angle and the contact angle')
        return None
    radial = parse(value, "small_length") if value else None
    if radial is not None:
        ledger.given(_PATH, radial, "small_length")
    if shim is not None:
        ledger.given("bearing.shim_angle", shim, "angle")
        found = _with_shims(given, shim, free, radial)
    elif free is None:
        ledger.problem("bearing.contact_angle", "is required for four-point contact, at which one side touches")
        return None
    else:
        found = _without_shims(given, free, radial)
    if found is None:
        return None
    if radial is None:
        ledger.record(_PATH, found.clearance, "small_length", "from contact angle and shims", "derived")
    return Angles(found.free, found.resting, Limits(found.clearance, found.clearance))


def _free_angle(given: Given) -> float | None:
    bearing, row, ledger = given.bearing, given.row, given.ledger
    if bearing.contact_angle is not None:
        ledger.given("bearing.contact_angle", bearing.contact_angle, "angle")
        return float(bearing.contact_angle)
    if row is None or row.contact_angle is None:
        return None
    return float(ledger.row("bearing.contact_angle", row.contact_angle, "angle"))


def _with_shims(given: Given, shim: float, free: float | None, radial: float | None) -> Resting | None:
    """Return the other values of a shim angle.

    They follow from the free angle, or from a clearance in its place.
    """
    bearing, distance, ledger = given.bearing, given.centres, given.ledger
    play = radial is not None or bearing.axial_clearance is not None
    if play and bearing.contact_angle is not None:
        ledger.problem(_SHIM, "follows from contact_angle and a clearance: give two of the three")
        return None
    if radial is not None:
        return _checked(math.cos(shim) - 0.5 * radial / distance, shim, radial, ledger)
    if bearing.axial_clearance is not None:
        ledger.given(_AXIAL, bearing.axial_clearance, "small_length")
        sine = math.sin(shim) + 0.5 * bearing.axial_clearance / distance
        if not math.sin(shim) < sine < 1.0:
            ledger.problem(_AXIAL, f"{show(bearing.axial_clearance, 'small_length', 4)} lets the balls leave the arcs")
            return None
        free = math.asin(sine)
    if free is None:
        ledger.problem("bearing.contact_angle", "is required in addition to the shim angle, or give a clearance")
        return None
    if not shim < free:
        ledger.problem(_SHIM, f"{show(shim, 'angle', 4)} must be below the contact angle of {show(free, 'angle', 4)}")
        return None
    return Resting(free, shim, 2.0 * distance * (math.cos(shim) - math.cos(free)))


def _checked(cosine: float, shim: float, radial: float, ledger: Any) -> Resting | None:
    if not math.cos(0.25 * math.pi) <= cosine < math.cos(shim):
        ledger.problem(_PATH, f"{show(radial, 'small_length', 4)} leaves no contact angle between shims and 45 deg")
        return None
    return Resting(math.acos(cosine), shim, radial)


def _without_shims(given: Given, free: float, radial: float | None) -> Resting | None:
    """Return the shim angle of a clearance.

    The clearance is that at the free angle: a radial one, an axial one, or a class.
    """
    distance, ledger = given.centres, given.ledger
    if radial is not None:
        cosine = math.cos(free) + 0.5 * radial / distance
        if not cosine < 1.0 or radial <= 0.0:
            largest = show(2.0 * distance * (1.0 - math.cos(free)), "small_length", 4)
            text = show(radial, "small_length", 4)
            ledger.problem(
                _PATH, f"{text} is not possible for four-point contact at this angle: above 0, below {largest}"
            )
            return None
        return _derived(free, math.acos(cosine), distance, ledger)
    axial = given.bearing.axial_clearance
    if axial is not None:
        ledger.given(_AXIAL, axial, "small_length")
    else:
        limits = given.class_of(CLEARANCES, _AXIAL)
        if limits is None:
            return None
        axial = given.picked(limits)
    sine = math.sin(free) - 0.5 * axial / distance
    if not 0.0 < sine < math.sin(free):
        largest = show(2.0 * distance * math.sin(free), "small_length", 4)
        ledger.problem(
            _AXIAL, f"{show(axial, 'small_length', 4)} is not possible for four-point contact: above 0, below {largest}"
        )
        return None
    return _derived(free, math.asin(sine), distance, ledger)


def _derived(free: float, shim: float, distance: float, ledger: Any) -> Resting:
    ledger.record("bearing.shim_angle", shim, "angle", "from contact angle and clearance", "derived", "C")
    ledger.assume(f"shim angle {show(shim, 'angle', 4)}: what contact angle, assumed grooves and clearance leave")
    return Resting(free, shim, 2.0 * distance * (math.cos(shim) - math.cos(free)))


KIND = BallKind(
    name="four-point",
    title="Four-point contact ball bearing",
    belongs=_belongs,
    written=_written,
    resolve=_resolve,
    thrusts=_thrusts,
    words=_words,
    arcs=2,
    filling=(249.0, 340.0),  # with a split ring
    tilt=TILT,
    tilt_words=(
        "of four-point contact the maker gives no number, deep groove ball bearings take up to 2.9 mrad (10 minutes of "
        "arc)"
    ),
    shoulders=FOUR_POINT_SHOULDERS,
    least_thrust=ONE_SIDE,
    thrust_words="balls of four-point contact run on both sides there, and slide (SKF)",
    axial_clearance="100 um",
)
