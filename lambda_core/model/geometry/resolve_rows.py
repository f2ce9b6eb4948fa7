"""Bearings of two rows, double row angular contact and self-aligning: how far their rows are apart, and their play.

**Double row.** With the distance A of the groove centres and the free contact angle alpha_0, rings that go G_a against
each other from one row's touch to the other's have the resting angle sin(alpha_s) = sin(alpha_0) - G_a/(2 A); below
zero the rows press on each other (the formulas of :mod:`lambda_core.model.geometry.resolve_resting`).

**Self-aligning.** The outer raceway is a sphere of radius R about the bearing's centre, on which a ball rests at the
contact angle alpha: its centre lies R - D_w/2 from the middle, so that

    R = D_w/2 + (d_m/2 + G_r/4)/cos(alpha),   row distance = 2 (R - D_w/2) sin(alpha) = (d_m + G_r/2) tan(alpha).

Rings that go across the shaft touch after the radial clearance G_r, at alpha.
"""

from __future__ import annotations

import math
from dataclasses import replace
from typing import NamedTuple

from lambda_core.case.case import Case
from lambda_core.case.parts import CLEARANCE_CLASSES, Bearing, InlineGeometry
from lambda_core.catalogue.protocol import BearingRow
from lambda_core.domain.units import parse, show
from lambda_core.formulas.kind_clearance import DOUBLE_ROW, SELF_ALIGNING
from lambda_core.formulas.tolerances import Limits
from lambda_core.model.bearing_model import SPHERICAL, Geometry
from lambda_core.model.geometry.resolve_clearance import PATH, class_of_kind, picked
from lambda_core.model.ledger import Ledger

DOUBLE, ALIGNING = "double row", "self-aligning"  # kinds of rows of the catalogue
_AXIAL = "bearing.axial_clearance"
_DISTANCE = "bearing.geometry.row_distance"
_OF_SPHERE = ("groove_radius_outer", "conformity_outer", "race_diameter_outer", "race_diameter_inner", "row_distance")
TILTS = ("tilt_y", "tilt_z")


class Rows(NamedTuple):
    """Angles [rad], radial clearance as bought, diametral [m], arrangement and distance [m] of two rows."""

    free: float
    resting: float
    bought: Limits
    arrangement: str
    distance: float


def has_two_rows(bearing: Bearing, row: BearingRow | None) -> bool:
    """Say whether the bearing has two rows: by the catalogue's kind, or as the case writes it."""
    if row is not None and row.kind in (DOUBLE, ALIGNING):
        return True
    return bool(bearing.geometry and bearing.geometry.rows == 2)


def is_self_aligning(bearing: Bearing, row: BearingRow | None) -> bool:
    """Say whether both rows run on one sphere: by the catalogue's kind, or as the case writes it."""
    if row is not None and row.kind == ALIGNING:
        return True
    return bool(bearing.geometry and bearing.geometry.arrangement == SPHERICAL)


def resolve_rows(bearing: Bearing, row: BearingRow | None, centres: float, bore: float, ledger: Ledger) -> Rows | None:
    """Return what is particular to two rows; None after a problem.

    Parameters
    ----------
    centres : float
        A, distance of the groove centres of double row angular contact [m]; not used of self-aligning bearings.
    bore : float
        [m]
    """
    inline = bearing.geometry or InlineGeometry()
    if not _consistent(inline, row, ledger):
        return None
    free = _contact_angle(bearing, row, ledger)
    if is_self_aligning(bearing, row):
        return _self_aligning(bearing, inline, free, bore, ledger)
    return _double_row(bearing, inline, row, free, centres, bore, ledger)


def _consistent(inline: InlineGeometry, row: BearingRow | None, ledger: Ledger) -> bool:
    if row is None:
        return True
    if row.kind not in (DOUBLE, ALIGNING):
        ledger.problem("bearing.geometry.rows", f"{row.designation} has one row: write two rows without a designation")
        return False
    if inline.rows == 1:
        ledger.problem("bearing.geometry.rows", f"{row.designation} has two rows: write one row without a designation")
        return False
    if inline.arrangement is not None and (inline.arrangement == SPHERICAL) != (row.kind == ALIGNING):
        ledger.problem("bearing.geometry.arrangement", f"{row.designation} is a bearing of the kind {row.kind}")
        return False
    return True


def _contact_angle(bearing: Bearing, row: BearingRow | None, ledger: Ledger) -> float:
    if bearing.contact_angle is not None:
        ledger.given("bearing.contact_angle", bearing.contact_angle, "angle")
        return bearing.contact_angle
    if row is not None and row.contact_angle is not None:
        return ledger.row("bearing.contact_angle", row.contact_angle, "angle")
    ledger.problem("bearing.contact_angle", "is required of two rows")
    return math.nan


def _double_row(
    bearing: Bearing,
    inline: InlineGeometry,
    row: BearingRow | None,
    free: float,
    centres: float,
    bore: float,
    ledger: Ledger,
) -> Rows | None:
    apart, axial = _apart(inline, row, ledger), _axial_clearance(bearing, row, bore, ledger)
    if apart is None or axial is None or math.isnan(free) or math.isnan(centres):
        return None
    sine = math.sin(free) - 0.5 * axial / centres
    if not 0.0 < sine < 1.0:
        ledger.problem(_AXIAL, f"{show(axial, 'small_length', 4)} lets the balls leave their grooves")
        return None
    resting = math.asin(sine)
    clearance = 2.0 * centres * (math.cos(resting) - math.cos(free))
    ledger.record(PATH, clearance, "small_length", "from contact angle and axial clearance", "derived")
    return Rows(free, resting, Limits(clearance, clearance), inline.arrangement or "O", apart)


def _apart(inline: InlineGeometry, row: BearingRow | None, ledger: Ledger) -> float | None:
    if inline.row_distance is not None:
        ledger.given("bearing.row_distance", inline.row_distance, "length")
        return inline.row_distance
    if row is not None and row.row_distance is not None:
        apart, said = ledger.row("bearing.row_distance", row.row_distance, "length"), row.row_distance
        ledger.assume(f"bearing.row_distance {show(apart, 'length', 4)}: {said.source} (grade {said.grade})")
        return apart
    ledger.problem(_DISTANCE, "is required of two rows")
    return None


def _axial_clearance(bearing: Bearing, row: BearingRow | None, bore: float, ledger: Ledger) -> float | None:
    named = bearing.clearance is not None and bearing.clearance[:2] in CLEARANCE_CLASSES
    if bearing.clearance is not None and not (named and row is not None):
        ledger.problem(PATH, "is radial: of two rows write contact_angle and axial_clearance")
        return None
    if bearing.axial_clearance is not None:
        ledger.given(_AXIAL, bearing.axial_clearance, "small_length")
        return bearing.axial_clearance
    if row is None:
        ledger.problem(_AXIAL, "is required of two rows")
        return None
    limits = class_of_kind(DOUBLE_ROW, bearing, bore, _AXIAL, ledger)
    return None if limits is None else picked(limits, bearing.clearance_pick)


def _self_aligning(bearing: Bearing, inline: InlineGeometry, free: float, bore: float, ledger: Ledger) -> Rows | None:
    for name in _OF_SPHERE:
        if getattr(inline, name) is not None:
            ledger.problem(
                f"bearing.geometry.{name}", "follows from ball, pitch, contact angle and clearance of the sphere"
            )
            return None
    if bearing.axial_clearance is not None:
        ledger.problem(_AXIAL, "of a self-aligning bearing write the radial one, bearing.clearance")
        return None
    text = bearing.clearance or "CN"
    bought: Limits | None
    if text[:2] in CLEARANCE_CLASSES:
        bought = class_of_kind(SELF_ALIGNING, bearing, bore, PATH, ledger)
    elif text == "geometry":
        ledger.problem(PATH, '"geometry" is of grooves: of a self-aligning bearing write a class or a value')
        return None
    else:
        value = parse(text, "small_length")
        ledger.given(PATH, value, "small_length")
        bought = Limits(value, value)
    if bought is None or math.isnan(free):
        return None
    return Rows(free, free, bought, SPHERICAL, math.nan)


def on_sphere(geometry: Geometry, clearance: float) -> Geometry:
    """Return a self-aligning bearing with its sphere and the distance of its rows for a radial clearance [m]."""
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
    """Return the diameter at which the sphere ends at the faces of the outer ring [m]."""
    return 2.0 * math.sqrt(max(geometry.groove_radius_outer**2 - 0.25 * geometry.width**2, 0.0))


def hold_tilts(case: Case, geometry: Geometry, ledger: Ledger) -> Case:
    """Return the case with the tilts of a self-aligning bearing's inner ring locked where it does not speak of them.

    The sphere turns under the balls without resistance: nothing in the bearing decides its misalignment.
    """
    inner = case.bodies.inner_ring
    if not geometry.self_aligning:
        return case
    for dof in TILTS:
        state = getattr(inner, dof)
        if dof in inner.model_fields_set and state.mode == "free" and not state.stiffness:
            ledger.problem(
                f"bodies.inner_ring.{dof}",
                "is free, and a self-aligning bearing holds no tilt: locked, prescribed (the misalignment), or with a "
                "stiffness",
            )
    silent = [dof for dof in TILTS if dof not in inner.model_fields_set]
    if not silent:
        return case
    ledger.assume(
        f"the inner ring does not tilt ({' and '.join(silent)}): a self-aligning bearing"
        " takes any misalignment without resistance, so that the shaft decides it; another one: "
        'tilt_y = { mode = "prescribed", motion = "10 mrad" }'
    )
    locked = {dof: type(getattr(inner, dof))(mode="locked") for dof in silent}
    bodies = case.bodies.model_copy(update={"inner_ring": inner.model_copy(update=locked)})
    return case.model_copy(update={"bodies": bodies})
