"""Resolve masses, inertias and boundary conditions."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Literal

from lambda_core.case.case import Case
from lambda_core.case.motion import CageBody, InnerRing, OuterRing
from lambda_core.catalogue.protocol import CageRow
from lambda_core.domain.elements import BODIES, DOFS, TILTS, TRANSLATIONS, BodyName
from lambda_core.domain.units import show
from lambda_core.elements.ball.geometry import Geometry
from lambda_core.laws.context import Material
from lambda_core.model.bearing_model import Body, Cage, DofState, TimeFunction
from lambda_core.model.bodies.loads import body_loads
from lambda_core.model.laws.time_functions import time_function
from lambda_core.model.ledger import Ledger

LEAST_SHARE = 1e-6  # of what the geometry of a body has; with less it would follow noise
ONE_ROW = "is for bearings of two rows; this one has one row: leave it out"  # what a cage per row cannot be for
MOST_MASS = 1e9  # [kg] of one body; the heaviest rotors ever turned weigh 1e6 kg


@dataclass(frozen=True)
class Inertia:
    """Mass [kg] and inertia [kg m2] of a part.

    The part is axisymmetric; moments of inertia about its centre.
    """

    mass: float
    transverse: float
    polar: float

    def __add__(self, other: Inertia) -> Inertia:
        """Return both parts together, their centres in one place."""
        return Inertia(self.mass + other.mass, self.transverse + other.transverse, self.polar + other.polar)

    def half(self) -> Inertia:
        """Return half of everything."""
        return Inertia(0.5 * self.mass, 0.5 * self.transverse, 0.5 * self.polar)


def hollow_cylinder(mass: float, inner_radius: float, outer_radius: float, length: float) -> Inertia:
    """Return the inertia of a hollow cylinder.

    The moments are m (R^2 + r^2)/2 and m (3 (R^2 + r^2) + l^2)/12.
    """
    squares = inner_radius**2 + outer_radius**2
    return Inertia(mass, mass * (3.0 * squares + length**2) / 12.0, mass * squares / 2.0)


def groove_volume(groove_radius: float, race_diameter: float, shoulder_diameter: float) -> float:
    """Return the volume [m3] of a groove.

    The groove is a segment of a circle turned about the shaft (Pappus).

    The segment's centroid is taken at 2/5 of its height from the groove's bottom, exact for a parabola.
    """
    height = 0.5 * abs(shoulder_diameter - race_diameter)
    r = groove_radius
    area = r * r * math.acos(1.0 - height / r) - (r - height) * math.sqrt(2.0 * r * height - height * height)
    toward_shoulder = math.copysign(0.6 * height, shoulder_diameter - race_diameter)
    return area * math.pi * (race_diameter + 2.0 * toward_shoulder)


def ring_inertia(geometry: Geometry, ring: Literal["inner", "outer"], density: float) -> Inertia:
    """Estimate a ring as a hollow cylinder.

    The cylinder extends from the ring's seat to its shoulders, less the groove.

    On one side of an angular contact ring the shoulder is gone, down to the raceway: with that on both rings, these,
    the balls and the cage have the mass that a catalogue prints (tests/literature/test_kinds.py). So it is of double
    row ones, on one side of each groove; the outer ring of a self-aligning bearing is hollowed out by its sphere.
    """
    g = geometry
    if ring == "inner":
        small, large = g.bore_diameter, g.shoulder_diameter_inner
        groove = groove_volume(g.groove_radius_inner, g.race_diameter_inner, g.shoulder_diameter_inner)
    else:
        small, large = g.shoulder_diameter_outer, g.outside_diameter
        groove = groove_volume(g.groove_radius_outer, g.race_diameter_outer, g.shoulder_diameter_outer)
    if g.kind.on_sphere and ring == "outer":
        return _sphered_ring(g, density)
    volume = math.pi / 4.0 * (large**2 - small**2) * g.width - g.rows * groove
    cylinder = hollow_cylinder(density * volume, small / 2.0, large / 2.0, g.width)
    if not g.kind.one_sided:
        return cylinder
    if ring == "inner":
        large = g.race_diameter_inner
    else:
        small = g.race_diameter_outer
    low = math.pi / 4.0 * (large**2 - small**2) * g.width
    # half of each: the halves of a cylinder have half of its inertia about its middle
    return cylinder.half() + hollow_cylinder(density * low, small / 2.0, large / 2.0, g.width).half()


def _sphered_ring(g: Geometry, density: float) -> Inertia:
    """Return a self-aligning bearing's outer ring.

    It is a bar less the layer of a sphere between its faces.
    """
    sphere = g.groove_radius_outer
    volume = math.pi * ((0.25 * g.outside_diameter**2 - sphere**2) * g.width + g.width**3 / 12.0)
    mean = math.sqrt(0.25 * g.outside_diameter**2 - volume / (math.pi * g.width))  # hole of a cylinder of that volume
    return hollow_cylinder(density * volume, mean, 0.5 * g.outside_diameter, g.width)


def resolve_cage(
    spec: CageBody, row: CageRow, geometry: Geometry, material: Material, ledger: Ledger, *, is_there: bool
) -> tuple[Cage, Inertia]:
    """Return the cage's geometry and inertia.

    The geometry follows the formula of its type. A cage that does not exist is not checked.

    m = density fill pi d_m (radial D_w) (axial D_w); inertia of a hollow cylinder of that
    radial thickness and width about the pitch circle.
    """
    ball, pitch = geometry.ball_diameter, geometry.pitch_diameter

    def length(name: str, ratio: float, what: str) -> float:
        written: float | None = getattr(spec, name)
        if written is not None:
            ledger.given(f"bodies.cage.{name}", written, "length")
            return written
        ledger.record(f"bodies.cage.{name}", ratio * ball, "length", what, "assumed", row.radial_ratio.grade)
        return ratio * ball

    what = f"cage type {row.name}: {row.pocket_clearance_ratio.source}"
    pocket = length("pocket_clearance", row.pocket_clearance_ratio.value, what)
    thickness = length("radial_thickness", row.radial_ratio.value, what)
    width = length("width", row.axial_ratio.value, what)
    guidance = spec.guidance or row.guidance
    land = math.nan
    if guidance == "ball":
        if spec.land_clearance is not None:
            ledger.problem("bodies.cage.land_clearance", 'a cage with guidance = "ball" has no guiding land')
    elif spec.land_clearance is None and row.land_clearance_ratio is None:
        ledger.problem("bodies.cage.land_clearance", f'is required: cage type "{row.name}" has no usual land clearance')
    else:
        land = length("land_clearance", row.land_clearance_ratio.value if row.land_clearance_ratio else math.nan, what)
    if is_there:
        ledger.assume(
            f"cage {row.name}: pocket clearance {show(pocket, 'small_length', 4)}, mass and inertia after the "
            f"formula of its type ({row.pocket_clearance_ratio.source})"
        )
    for name, size, limit in (
        ("radial_thickness", thickness, pitch),
        ("width", width, geometry.outside_diameter),
    ):
        if not size < limit:
            shown = show(size, "length", 4), show(limit, "length", 4)
            ledger.problem(f"bodies.cage.{name}", f"{shown[0]} is too large: it must be smaller than {shown[1]}")
            thickness = width = ball
    mass = material.density * row.fill.value * math.pi * pitch * thickness * width
    if spec.per_row:
        _check_cage_per_row(spec, geometry, ledger)
    else:
        mass *= geometry.rows
        width += geometry.row_distance
    if geometry.rows == 2 and is_there:
        ledger.assume(
            "each row has a cage of its own; both have the same sizes, supports and loads"
            if spec.per_row
            else "one cage holds both rows, whose balls stand in turn"
        )
    inertia = hollow_cylinder(mass, 0.5 * (pitch - thickness), 0.5 * (pitch + thickness), width)
    if guidance not in ("ball", "inner ring", "outer ring"):
        ledger.problem("bodies.cage.type", f'"{row.name}" has the unknown guidance "{guidance}"')
    if is_there:
        _check_cage(geometry, pocket, land, ledger)
    return Cage(row.name, pocket, land, width, thickness, guidance, spec.per_row and is_there), inertia  # type: ignore[arg-type]


def _check_cage_per_row(spec: CageBody, geometry: Geometry, ledger: Ledger) -> None:
    """Refuse cages per row where they cannot be."""
    if geometry.rows == 1:
        ledger.problem("bodies.cage.per_row", ONE_ROW)
    if spec.x.stiffness or spec.x.damping:
        ledger.problem("bodies.cage.x", "of a cage per row is free, locked or a motion; a spring has no rest there")


def _check_cage(geometry: Geometry, pocket: float, land: float, ledger: Ledger) -> None:
    """Refuse pockets without bars between them.

    Report a guiding land that cannot act.
    """
    chord = geometry.pitch_diameter * math.sin(math.pi / geometry.ball_count)
    if geometry.ball_diameter + pocket >= chord:
        gap = show(chord - geometry.ball_diameter, "small_length", 4)
        ledger.problem(
            "bodies.cage.pocket_clearance",
            f"leaves no bars between the pockets: must be below {gap}, the gap between rolling elements",
        )
    if land > pocket:
        ledger.assume(
            f"the cage's land clearance {show(land, 'small_length', 4)} is above its pocket clearance "
            f"{show(pocket, 'small_length', 4)}: the pockets guide it, not the land"
        )


def resolve_inertia(name: str, spec: InnerRing | OuterRing | CageBody, estimate: Inertia, ledger: Ledger) -> Inertia:
    """Return mass and inertia of a part.

    Each comes from the case or from the estimate, whose inertia is scaled to a given mass.
    """
    path = f"bodies.{name}"
    _check_mass(f"{path}.mass", spec.mass, ledger)
    mass = spec.mass if spec.mass is not None else estimate.mass
    scale = mass / estimate.mass
    numbers = []
    for field, value, quantity in (
        ("mass", estimate.mass, "mass"),
        ("transverse_inertia", estimate.transverse * scale, "inertia"),
        ("polar_inertia", estimate.polar * scale, "inertia"),
    ):
        written = getattr(spec, field)
        if written is None:
            ledger.record(f"{path}.{field}", value, quantity, "estimated from the geometry", "derived")
        else:
            ledger.given(f"{path}.{field}", written, quantity)
            if written < LEAST_SHARE * value:
                least = show(LEAST_SHARE * value, quantity, 3)
                ledger.problem(f"{path}.{field}", f"{written:g} is below {least}, a millionth of its geometry's")
        numbers.append(value if written is None else written)
    return Inertia(*numbers)


def _check_mass(path: str, mass: float | None, ledger: Ledger) -> None:
    """Refuse a mass beyond double precision.

    Its motion could not be computed together with that of a ball.
    """
    if mass is not None and mass > MOST_MASS:
        ledger.problem(path, f"{mass:g} kg is more than a bearing carries: at most {MOST_MASS:g} kg")


def shaft_inertia(spec: InnerRing, geometry: Geometry, density: float, ledger: Ledger) -> Inertia:
    """Return the shaft that moves with the ring.

    It moves with the inner ring; given, or a solid bar as thick as the bore.
    """
    if not spec.shaft_mass:
        return Inertia(0.0, 0.0, 0.0)
    _check_mass("bodies.inner_ring.shaft_mass", spec.shaft_mass, ledger)
    if spec.shaft_mass > MOST_MASS:
        return Inertia(0.0, 0.0, 0.0)
    radius = geometry.bore_diameter / 2.0
    length = spec.shaft_mass / (density * math.pi * radius**2)
    bar = hollow_cylinder(spec.shaft_mass, 0.0, radius, length)
    ledger.given("bodies.inner_ring.shaft_mass", spec.shaft_mass, "mass")
    transverse, polar = spec.shaft_transverse_inertia, spec.shaft_polar_inertia
    if transverse is None or polar is None:
        ledger.assume(f"shaft of {show(spec.shaft_mass, 'mass')}: its inertia is that of a bar as thick as the bore")
    return Inertia(
        spec.shaft_mass,
        bar.transverse if transverse is None else transverse,
        bar.polar if polar is None else polar,
    )


def resolve_body(name: BodyName, case: Case, inertia: Inertia) -> Body:
    """Return one body with its boundary conditions and loads."""
    spec = getattr(case.bodies, name)
    dofs = {}
    for dof in DOFS:
        state = getattr(spec, dof)
        motion = time_function(getattr(state, "motion", None))
        if name == "inner_ring" and dof == "spin" and state.mode != "locked":
            motion = time_function(case.operation.speed)
        dofs[dof] = DofState(state.mode, motion, getattr(state, "stiffness", 0.0), state.damping)
    force, moment = body_loads(name, case)
    return Body(inertia.mass, inertia.transverse, inertia.polar, dofs, force, moment, spec.unbalance)


def check_bodies(case: Case, ledger: Ledger) -> None:
    """Note contradictions between drive, boundary conditions and loads."""
    inner, outer = case.bodies.inner_ring, case.bodies.outer_ring
    if case.operation.torque is not None and inner.spin.mode != "free":
        ledger.problem("operation.torque", 'a driving torque needs bodies.inner_ring.spin = "free"')
    speed = time_function(case.operation.speed)
    if inner.spin.mode == "locked" and speed.terms:
        ledger.problem("bodies.inner_ring.spin", '"locked" contradicts operation.speed: write "prescribed"')
    if inner.spin.mode == "free" and any(term.kind != "constant" for term in speed.terms):
        ledger.problem("operation.speed", "must be one value, because with a free spin it is the initial speed")
    if not case.depth.cage:
        for where, there in (
            ("loads.cage", case.loads.cage is not None),
            ("models.cage_contact", case.models.cage_contact is not None),
            ("parameters.cage_contact", "cage_contact" in case.parameters),
            *((f"forces.{e}", e in case.forces.model_fields_set) for e in ("ball_cage", "cage_inner", "cage_outer")),
            *((f"markers.{name}", marker.body == "cage") for name, marker in case.markers.items()),
        ):
            if there:
                ledger.problem(
                    where,
                    "contradicts depth.cage = false: there is no cage, leave it out (forces.ball_ball is for balls)",
                )
    elif "ball_ball" in case.forces.model_fields_set:
        ledger.problem("forces.ball_ball", "neighbours touch only without a cage: it needs depth.cage = false")
    _check_locked_loads(case, ledger)
    _say_free_tilt(case, ledger)
    if outer.spin.mode == "prescribed" and not time_function(outer.spin.motion).terms and not speed.terms:
        ledger.assume("nothing turns: both rings stand still")


def _say_free_tilt(case: Case, ledger: Ledger) -> None:
    """Report an inner ring that may tilt.

    The loads tilt it, and the case has no option for it.

    Radial load alone, or axial load alone, leaves the rings parallel.
    """
    inner = case.bodies.inner_ring
    silent = [dof for dof in TILTS if dof not in inner.model_fields_set]
    (x, y, z), (_, about_y, about_z) = body_loads("inner_ring", case)
    radial = bool(y.terms or z.terms or inner.shaft_mass)
    if silent and ((x.terms and radial) or about_y.terms or about_z.terms):
        ledger.assume(
            f"the inner ring is free to tilt ({' and '.join(silent)}): no shaft or second bearing holds it; friction "
            'and life differ where one does: bodies.inner_ring.tilt_y = "locked", or a stiffness'
        )


def _check_locked_loads(case: Case, ledger: Ledger) -> None:
    """Note loads along locked degrees of freedom.

    They would have no effect.
    """
    for name in BODIES:
        force, moment = body_loads(name, case)
        torque = TimeFunction() if case.operation.torque is not None and name == "inner_ring" else moment[0]
        for dof, load in zip((*TRANSLATIONS, "spin", *TILTS), (*force, torque, *moment[1:]), strict=True):
            mode = getattr(getattr(case.bodies, name), dof).mode
            if load.terms and mode != "free":
                ledger.problem(
                    f"bodies.{name}.{dof}", f"is {mode}, but a load acts along it: make it free or drop the load"
                )
