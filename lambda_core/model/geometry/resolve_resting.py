"""Bearings of four-point contact: from two of what follows the third.

With the distance A of the groove centres, the free contact angle alpha_0 and the resting angle alpha_s, that of the
shims which the arcs are ground with, rings that move against each other until balls touch have

    axial clearance   G_a = 2 A (sin(alpha_0) - sin(alpha_s)),
    radial clearance  G_r = 2 A (cos(alpha_s) - cos(alpha_0))

(Harris and Kotzalas 2006, ch. 2: P_d = S_d + 2 A (1 - cos(alpha_s)) and cos(alpha_0) = 1 - P_d/(2 A)).
"""

from __future__ import annotations

import math
from typing import NamedTuple

from lambda_core.case.parts import CLEARANCE_CLASSES, Bearing
from lambda_core.catalogue.protocol import BearingRow
from lambda_core.domain.units import parse, show
from lambda_core.formulas.kind_clearance import FOUR_POINT as CLEARANCES
from lambda_core.model.geometry.resolve_clearance import PATH, class_of_kind, picked
from lambda_core.model.ledger import Ledger

FOUR_POINT = "four-point"  # kind of a row of the catalogue
_SHIM = "bearing.geometry.shim_angle"
_AXIAL = "bearing.axial_clearance"


class Resting(NamedTuple):
    """Angles [rad] and radial internal clearance, diametral [m]."""

    free: float
    resting: float
    clearance: float


def has_arcs(bearing: Bearing, row: BearingRow | None) -> bool:
    """Say whether each ring has two arcs: by the catalogue's kind, or by a shim angle."""
    inline = bearing.geometry
    return (row is not None and row.kind == FOUR_POINT) or bool(inline and inline.shim_angle)


def resolve_resting(
    bearing: Bearing, row: BearingRow | None, distance: float, bore: float, ledger: Ledger
) -> Resting | None:
    """Return angles and clearance of a four-point contact bearing; None after a problem.

    Parameters
    ----------
    distance : float
        A, of the groove centres [m].
    bore : float
        [m]
    """
    shim = bearing.geometry.shim_angle if bearing.geometry else None
    free = _free_angle(bearing, row, ledger)
    if math.isnan(distance):
        return None
    value = bearing.clearance if bearing.clearance and bearing.clearance[:2] not in CLEARANCE_CLASSES else None
    if value == "geometry":
        ledger.problem(PATH, '"geometry" is of single grooves: give the shim angle and the contact angle instead')
        return None
    radial = parse(value, "small_length") if value else None
    if radial is not None:
        ledger.given(PATH, radial, "small_length")
    if shim is not None:
        ledger.given("bearing.shim_angle", shim, "angle")
        found = _with_shims(bearing, shim, free, radial, distance, ledger)
    elif free is None:
        ledger.problem("bearing.contact_angle", "is required for four-point contact, at which one side touches")
        return None
    else:
        found = _without_shims(bearing, free, radial, distance, bore, ledger)
    if found is not None and radial is None:
        ledger.record(PATH, found.clearance, "small_length", "from contact angle and shims", "derived")
    return found


def _free_angle(bearing: Bearing, row: BearingRow | None, ledger: Ledger) -> float | None:
    if bearing.contact_angle is not None:
        ledger.given("bearing.contact_angle", bearing.contact_angle, "angle")
        return bearing.contact_angle
    if row is None or row.contact_angle is None:
        return None
    return ledger.row("bearing.contact_angle", row.contact_angle, "angle")


def _with_shims(
    bearing: Bearing, shim: float, free: float | None, radial: float | None, distance: float, ledger: Ledger
) -> Resting | None:
    """Return the rest of a given shim angle: from the free angle, or from a clearance in its place."""
    play = radial is not None or bearing.axial_clearance is not None
    if play and bearing.contact_angle is not None:
        ledger.problem(_SHIM, "contact_angle and a clearance leave nothing for it: give two of the three")
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


def _checked(cosine: float, shim: float, radial: float, ledger: Ledger) -> Resting | None:
    if not math.cos(0.25 * math.pi) <= cosine < math.cos(shim):
        ledger.problem(PATH, f"{show(radial, 'small_length', 4)} leaves no contact angle between shims and 45 deg")
        return None
    return Resting(math.acos(cosine), shim, radial)


def _without_shims(
    bearing: Bearing, free: float, radial: float | None, distance: float, bore: float, ledger: Ledger
) -> Resting | None:
    """Return the shim angle that leaves a clearance at the free angle: a radial one, an axial one, or a class."""
    if radial is not None:
        cosine = math.cos(free) + 0.5 * radial / distance
        if not cosine < 1.0 or radial <= 0.0:
            largest = show(2.0 * distance * (1.0 - math.cos(free)), "small_length", 4)
            text = show(radial, "small_length", 4)
            ledger.problem(PATH, f"{text} is none of four-point contact at this angle: above 0, below {largest}")
            return None
        return _derived(free, math.acos(cosine), distance, ledger)
    axial = bearing.axial_clearance
    if axial is not None:
        ledger.given(_AXIAL, axial, "small_length")
    else:
        limits = class_of_kind(CLEARANCES, bearing, bore, _AXIAL, ledger)
        if limits is None:
            return None
        axial = picked(limits, bearing.clearance_pick)
    sine = math.sin(free) - 0.5 * axial / distance
    if not 0.0 < sine < math.sin(free):
        largest = show(2.0 * distance * math.sin(free), "small_length", 4)
        ledger.problem(
            _AXIAL, f"{show(axial, 'small_length', 4)} is none of four-point contact: above 0, below {largest}"
        )
        return None
    return _derived(free, math.asin(sine), distance, ledger)


def _derived(free: float, shim: float, distance: float, ledger: Ledger) -> Resting:
    ledger.record("bearing.shim_angle", shim, "angle", "from contact angle and clearance", "derived", "C")
    ledger.assume(f"shim angle {show(shim, 'angle', 4)}: what contact angle, assumed grooves and clearance leave")
    return Resting(free, shim, 2.0 * distance * (math.cos(shim) - math.cos(free)))
