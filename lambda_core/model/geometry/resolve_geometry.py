"""Resolve a designation or inline numbers to the inner geometry."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

from lambda_core.case.parts import CLEARANCE_CLASSES, Bearing, InlineGeometry
from lambda_core.catalogue.protocol import BearingRow, Catalogue
from lambda_core.domain.units import show
from lambda_core.elements.ball.ball_kind import Angles, BallKind, Given, Shoulders
from lambda_core.elements.ball.geometry import Geometry
from lambda_core.elements.ball.kinds import written_kind
from lambda_core.formulas.tolerances import Limits
from lambda_core.model.geometry.geometry_checks import check_geometry, mm
from lambda_core.model.geometry.resolve_clearance import class_of_kind, clearance_as_bought, picked
from lambda_core.model.ledger import Ledger

# ISO 76 and ISO 281 rate grooves up to 0.52 and 0.53; what is made lies below, as in the catalogue's estimates.
CONFORMITY_INNER, CONFORMITY_OUTER = 0.515, 0.525
# From a thousandth of the smallest bearing made to ten times the largest: beyond, a unit is wrong.
LEAST_LENGTH, MOST_LENGTH = 1e-6, 100.0  # [m]
SIZES = ("bore_diameter", "outside_diameter", "width")
INNER = ("ball_count", "ball_diameter")
# Shoulder diameters differ by 1.21 ball diameters: mean of catalogue shoulders, the same figure from
# which missing inner geometry is derived.
_SHOULDER_SPREAD = 1.21


@dataclass
class Picker:
    """Picker of dimensions.

    It takes them from the case, otherwise from the catalogue row, and notes the origin.
    """

    inline: InlineGeometry
    row: BearingRow | None
    ledger: Ledger

    def take(self, name: str) -> float | None:
        """Return one dimension in SI.

        None when neither the case nor the catalogue has it.
        """
        path, quantity = f"bearing.{name}", "" if name == "ball_count" else "length"
        written = getattr(self.inline, name)
        if written is not None:
            if quantity and not LEAST_LENGTH <= written <= MOST_LENGTH:
                span = f"{mm(LEAST_LENGTH)} to {mm(MOST_LENGTH)}"
                self.ledger.problem(f"bearing.geometry.{name}", f"{mm(written)} is not possible for a bearing: {span}")
            self.ledger.given(path, float(written), quantity)
            return float(written)
        found = getattr(self.row, name) if self.row else None
        if found is None:
            return None
        if found.status == "derived" and name in INNER and self.row:
            text = f"{found.value:g}" if name == "ball_count" else show(found.value, "length", 6)
            self.ledger.assume(f"{path} {text}: {found.source} (grade {found.grade})")
        return self.ledger.row(path, found, quantity)

    def _designs(self) -> str:
        """Name the likeliest designs of a row without inner geometry."""
        designs = self.row.candidates[:3] if self.row else ()
        shown = ", ".join(f"{d.ball_count} x {d.ball_diameter * 1e3:.6g} mm" for d in designs)
        return f" (designs that fit its ratings: {shown})" if shown else ""

    def need(self, name: str) -> float:
        """Return one required dimension.

        A missing one is noted as a problem, and is NaN.
        """
        value = self.take(name)
        if value is None:
            where = f"bearing.geometry.{name}"
            if self.row:
                label = f"{self.row.designation} of {self.row.maker}"
                self.ledger.problem(where, f"is required: the catalogue does not know it for {label}{self._designs()}")
            else:
                self.ledger.problem(where, "is required without a designation")
            return math.nan
        return value


def resolve_geometry(
    bearing: Bearing, row: BearingRow | None, catalogue: Catalogue, ledger: Ledger
) -> tuple[Geometry, Limits] | None:
    """Return the geometry and the clearance's limits.

    The geometry has the clearance as bought; the limits are those of this clearance.

    None when it cannot be built; the ledger says why.
    """
    inline = bearing.geometry or InlineGeometry()
    picker = Picker(inline, row, ledger)
    bore, outside, width = (picker.need(name) for name in SIZES)
    count, ball = picker.need("ball_count"), picker.need("ball_diameter")
    races = _races(picker)
    pitch = _pitch(picker, races, bore, outside)
    kind = written_kind(inline, row)
    spherical = kind is not None and kind.on_sphere
    grooves = (_groove(picker, "inner", ball), math.nan if spherical else _groove(picker, "outer", ball))
    resting, apart, arrangement, distance = 0.0, 0.0, "", sum(grooves) - ball
    bought: Limits | None = None
    if kind is not None:
        found = _of_kind(kind, bearing, row, distance, bore, ledger)
        angle = math.nan
        if found is not None:
            angle, resting, bought, arrangement, apart = found
    elif bearing.axial_clearance is not None:
        ledger.problem(
            "bearing.axial_clearance", "applies to four-point contact and two rows only; here write a clearance"
        )
        return None
    elif (angle := _contact_angle(bearing, row, ledger)) == 0.0:
        bought = clearance_as_bought(bearing, races, ball, bore, catalogue, ledger)
    else:
        bought = _clearance_of_angle(angle, distance, ledger)
    _ratings(picker)
    if bought is None or any(math.isnan(x) for x in (bore, outside, width, count, ball, pitch, grooves[0])):
        return None
    clearance = picked(bought, bearing.clearance_pick)
    as_bought = Geometry(
        ball_count=round(count),
        ball_diameter=ball,
        pitch_diameter=pitch,
        race_diameter_inner=math.nan,
        race_diameter_outer=math.nan,
        groove_radius_inner=grooves[0],
        groove_radius_outer=grooves[1],
        shoulder_diameter_inner=math.nan,
        shoulder_diameter_outer=math.nan,
        clearance=clearance,
        bore_diameter=bore,
        outside_diameter=outside,
        width=width,
        series=inline.series or (row.series if row else ""),
        contact_angle=angle,
        resting_angle=resting,
        rows=kind.rows if kind is not None else 1,
        row_distance=apart,
        arrangement=arrangement,
    )
    geometry = _with_shoulders(with_clearance(as_bought, clearance), picker)
    check_geometry(geometry, races, ledger)
    return geometry, bought


def _of_kind(
    kind: BallKind, bearing: Bearing, row: BearingRow | None, distance: float, bore: float, ledger: Ledger
) -> Angles | None:
    """Return angles and clearance of a bearing.

    Its kind is written; None follows a problem.
    """
    assert kind.resolve is not None  # a kind that can be written says what follows
    text = bearing.clearance
    return kind.resolve(
        Given(
            bearing,
            bearing.geometry or InlineGeometry(),
            row,
            distance,
            bore,
            ledger,
            lambda table, where: class_of_kind(table, bearing, bore, where, ledger),
            lambda limits: picked(limits, bearing.clearance_pick),
            text if text is not None and text[:2] in CLEARANCE_CLASSES else None,
        )
    )


def _with_shoulders(geometry: Geometry, picker: Picker) -> Geometry:
    """Return the geometry with its shoulders.

    A sphere ends at the faces of its ring.
    """
    size = geometry.ball_diameter, geometry.pitch_diameter
    kind = geometry.kind
    inner = _shoulder(picker, "inner", *size, kind.shoulders)
    if kind.outer_shoulder is None:
        outer = _shoulder(picker, "outer", *size, kind.shoulders)
    elif (outer := picker.take("shoulder_diameter_outer") or 0.0) == 0.0:
        outer = kind.outer_shoulder(geometry)
        picker.ledger.record("bearing.shoulder_diameter_outer", outer, "length", "the sphere at the faces", "derived")
    return replace(geometry, shoulder_diameter_inner=inner, shoulder_diameter_outer=outer)


def _contact_angle(bearing: Bearing, row: BearingRow | None, ledger: Ledger) -> float:
    """Return the free contact angle [rad].

    Angular contact bearings take it from the case, otherwise from the row; it is 0 for radial contact.

    A value of the clearance takes the place of the row's angle; a class is one of radial contact and is refused.
    """
    if bearing.contact_angle is not None:
        ledger.given("bearing.contact_angle", bearing.contact_angle, "angle")
        return bearing.contact_angle
    if row is None or row.contact_angle is None:
        return 0.0
    if bearing.clearance is not None:
        if bearing.clearance[:2] in CLEARANCE_CLASSES:
            angle = show(row.contact_angle.value, "angle", 3)
            ledger.problem(
                "bearing.clearance",
                f'"{bearing.clearance}" is a class of radial contact bearings: leave it out, {row.designation} has the '
                f"clearance of its contact angle of {angle}; or write a value",
            )
        return 0.0
    return ledger.row("bearing.contact_angle", row.contact_angle, "angle")


def _clearance_of_angle(angle: float, distance: float, ledger: Ledger) -> Limits:
    """Return the clearance of a contact angle.

    It is 2 A (1 - cos(alpha_0)) (Harris and Kotzalas 2006, eq. 2.9).
    """
    clearance = 2.0 * distance * (1.0 - math.cos(angle))
    ledger.record("bearing.clearance", clearance, "small_length", "from the free contact angle", "derived")
    return Limits(clearance, clearance)


def _races(picker: Picker) -> tuple[float | None, float | None]:
    """Return both raceway diameters.

    Those of a catalogue row count only with the row's own balls and pitch.
    """
    inline = picker.inline
    edited = inline.ball_diameter is not None or inline.pitch_diameter is not None
    own = inline.race_diameter_inner is not None and inline.race_diameter_outer is not None
    if edited and picker.row and not own:
        return None, None
    return picker.take("race_diameter_inner"), picker.take("race_diameter_outer")


def _ratings(picker: Picker) -> None:
    """Record limiting speed and load ratings.

    They serve limits, life and catalogue methods.

    A geometry of one's own has none of the row's ratings.
    """
    own_balls = picker.inline.ball_diameter is not None or picker.inline.ball_count is not None
    if picker.row and picker.row.limiting_speed is not None:
        picker.ledger.row("bearing.limiting_speed", picker.row.limiting_speed, "rotational_speed")
    for name in ("dynamic_rating", "static_rating", "fatigue_limit"):
        written = getattr(picker.inline, name, None)
        found = getattr(picker.row, name) if picker.row and not own_balls else None
        if written is not None:
            picker.ledger.given(f"bearing.{name}", written, "force")
        elif found is not None:
            picker.ledger.row(f"bearing.{name}", found, "force")


def with_clearance(geometry: Geometry, clearance: float) -> Geometry:
    """Return the geometry with a clearance [m].

    Both raceways are set for `clearance`.

    Pitch and ball diameters stay; each raceway takes half: d_i = d_m - D_w - G/2,
    d_o = d_m + D_w + G/2, so that d_o - d_i - 2 D_w = G. Of a self-aligning bearing the sphere goes with it.
    """
    if geometry.kind.with_clearance is not None:
        return geometry.kind.with_clearance(geometry, clearance)
    half = geometry.ball_diameter + clearance / 2.0
    return replace(
        geometry,
        clearance=clearance,
        race_diameter_inner=geometry.pitch_diameter - half,
        race_diameter_outer=geometry.pitch_diameter + half,
    )


def _pitch(picker: Picker, races: tuple[float | None, float | None], bore: float, outside: float) -> float:
    pitch, ledger = picker.take("pitch_diameter"), picker.ledger
    if pitch is not None:
        return pitch
    inner, outer = races
    if inner is not None and outer is not None:
        pitch = (inner + outer) / 2.0
        ledger.record("bearing.pitch_diameter", pitch, "length", "mean of the raceway diameters", "derived")
    else:
        pitch = (bore + outside) / 2.0
        if not math.isnan(pitch):
            ledger.record("bearing.pitch_diameter", pitch, "length", "mean of bore and outside diameter", "assumed")
            ledger.assume(f"pitch diameter {show(pitch, 'length', 6)}: mean of bore and outside diameter")
    return pitch


def _groove(picker: Picker, ring: str, ball: float) -> float:
    conformity = getattr(picker.inline, f"conformity_{ring}")
    written = getattr(picker.inline, f"groove_radius_{ring}")
    path = f"bearing.groove_radius_{ring}"
    if conformity is not None:
        if written is not None:
            picker.ledger.problem(
                f"bearing.geometry.conformity_{ring}", f"groove_radius_{ring} is given too: write one of them"
            )
        picker.ledger.record(path, conformity * ball, "length", "case (conformity)", "given")
        return float(conformity * ball)
    known = getattr(picker.row, f"groove_radius_{ring}") if picker.row else None
    own_ball = picker.row.ball_diameter if picker.row else None
    if written is None and known and own_ball and picker.inline.ball_diameter is not None:
        same_conformity = float(known.value / own_ball.value * ball)
        picker.ledger.record(path, same_conformity, "length", "conformity of the catalogue row, other balls", "derived")
        return same_conformity
    radius = picker.take(f"groove_radius_{ring}")
    if radius is None:
        usual = CONFORMITY_INNER if ring == "inner" else CONFORMITY_OUTER
        radius = usual * ball
        picker.ledger.record(path, radius, "length", f"usual conformity {usual:g} D_w", "assumed")
        picker.ledger.assume(f"{ring} groove radius {usual:g} D_w: usual conformity")
    return radius


def is_of_grooves(text: str) -> bool:
    """Tell whether a path is about grooves.

    It is that of a value or an assumption; shoulders count; rollers have none of both.
    """
    return text.startswith(("bearing.groove_", "bearing.shoulder_", "shoulder diameters:")) or " groove radius " in text


def _shoulder(picker: Picker, ring: str, ball: float, pitch: float, known: Shoulders | None) -> float:
    """Return the diameter of a ring's shoulder.

    An angular contact bearing has a high shoulder that carries the load; its diameter counts.

    Where it is not known it follows from the mean height of its kind; None: deep groove.
    """
    name = f"shoulder_diameter_{ring}"
    diameter = picker.take(name)
    sign = -1.0 if ring == "inner" else 1.0
    if diameter is None and known is not None:
        height = known.heights[ring]
        diameter = pitch + sign * (1.0 - 2.0 * height) * ball
        text = f"{known.what} {height:g} D_w over the raceway"
        picker.ledger.record(f"bearing.{name}", diameter, "length", text, "assumed")
        picker.ledger.assume(f"{ring} ring: {text}, {known.whose}")
    elif diameter is None:
        diameter = pitch + sign * 0.5 * _SHOULDER_SPREAD * ball
        picker.ledger.record(f"bearing.{name}", diameter, "length", "pitch -+ 0.605 D_w", "assumed")
        picker.ledger.assume("shoulder diameters: pitch diameter -+ 0.605 D_w, the mean of catalogue shoulders")
    return diameter
