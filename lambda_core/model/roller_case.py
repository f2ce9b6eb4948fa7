"""Resolve the case of a roller bearing without motion."""

from __future__ import annotations

import math
from collections.abc import Iterable
from contextlib import closing
from dataclasses import dataclass, replace
from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np

from lambda_core.case.case import Case
from lambda_core.case.rollers import InlineRollers
from lambda_core.catalogue.protocol import Catalogue, RollerRow, Value
from lambda_core.catalogue.roller_designation import RollerDesignation, roller_designation
from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.elements import POSE
from lambda_core.domain.errors import CaseError, LambdaError, Problem
from lambda_core.domain.lubrication import Lubrication
from lambda_core.domain.units import parse
from lambda_core.domain.value_status import ESTIMATED, ValueStatus
from lambda_core.elements.roller.rib import tapered_angles
from lambda_core.elements.roller.roller_bearing import RollerBearing, is_conical
from lambda_core.elements.roller.roller_capacitance import Dielectric
from lambda_core.elements.roller.roller_clearance import roller_clearance
from lambda_core.elements.roller.roller_friction import FrictionParameters, OilState
from lambda_core.model.bearing_model import BearingModel, ResolvedValue
from lambda_core.model.bodies.resolve_bodies import ONE_ROW
from lambda_core.model.bodies.resolve_elastic import bent_rings
from lambda_core.model.bodies.resolve_materials import (
    is_grease,
    lubrication_of,
    materials_apart,
    resolve_lubricant,
    resolve_oil_level,
)
from lambda_core.model.checks.oil_table import OilLaw, oil_state
from lambda_core.model.checks.operating_limits import speed_warning
from lambda_core.model.geometry.roller_limits import check_roller_clearance, is_possible, refuse_geometry_of_balls
from lambda_core.model.geometry.roller_profile import profile_of
from lambda_core.model.laws.law_context import effective_modulus
from lambda_core.model.laws.roller_dielectric import dielectric_of_case
from lambda_core.model.laws.roller_laws import friction_of_case
from lambda_core.model.laws.time_functions import initial, time_function
from lambda_core.model.ledger import Ledger
from lambda_core.model.roller_loads import (
    Held,
    as_outer_ring,
    held_directions,
    inner_loads,
    outer_ring_loads,
    outer_speed,
    outer_support,
    prescribed_pose,
    ring_masses,
)
from lambda_core.model.roller_mounting import in_operation
from lambda_core.model.roller_rated import ratings_of
from lambda_core.model.settings.contamination import contamination_of
from lambda_core.views.roller_profile import RollerShape

if TYPE_CHECKING:
    from lambda_core.case.case_io import Source
    from lambda_core.discovery.api import Registry

_WHERE = "bearing.designation"
_NEEDED = ("kind", "roller_count", "roller_diameter", "effective_length", "pitch_diameter")
_QUANTITIES = {"roller_count": "", "contact_angle": "angle"}  # of what is no length
_BOUNDARY = ("bore_diameter", "outside_diameter", "width")
_REPLENISHMENT = {"oil bath": 3e-8, "oil jet": 3e-8, "under-race": 3e-8, "grease": 6e-8, "oil-air": 6e-8}
_WITHOUT_DRAG = ("under-race", "oil-air")
_CLASSES = "ISO 5753-1:2009, cylindrical roller bearings, as remembered"
_ROUGHNESS = "Wingertszahn et al. 2023, Lubricants 11, 369"
_SHORTER = 0.1  # effective length: roller less this share of the diameter at each end where nothing is known


@dataclass(frozen=True)
class RollerModel:
    """A roller bearing at its operating point, SI.

    Attributes
    ----------
    name, title : str
        Of the case, and what the bearing is.
    bearing : RollerBearing
        Geometry at operating clearance.
    loads : array
        On the inner ring: forces x, y, z [N], moments y, z [N m], (5,).
    held : tuple of bool
        Which displacements of the inner ring are held.
    speeds : tuple of float
        Of inner and outer ring [rad/s].
    oil : OilState
        At the inlet.
    friction : FrictionParameters
        Surfaces and supply.
    lubricant, base_type : str
        Name of the oil and kind of its base oil.
    lubrication : str
        How it gets to the rollers.
    temperature : float
        Of the oil [K].
    slices : int
        Laminae.
    contamination : float or None
        e_C of ISO 281; None: not given.
    assumptions : tuple of str
        In plain words.
    values : tuple of ResolvedValue
        Every value with its origin.
    displacement : array or None
        Where held directions of the inner ring are [m, rad], (5,); None: at zero.
    loose : tuple of str
        Directions in which a load moves both rings, because nothing holds the outer one.
    support : array or None
        Stiffness of what holds the outer ring, inf where it is rigid, (5,) [N/m, N m/rad]; None: rigid everywhere.
    outer_loads : array or None
        On the outer ring, as `loads`; they count where its support is elastic.
    dielectric : Dielectric or None
        The oil between electrodes, for the capacitance; None: not known.
    """

    name: str
    title: str
    bearing: RollerBearing
    loads: FloatArray
    held: Held
    speeds: tuple[float, float]
    oil: OilState
    friction: FrictionParameters
    lubricant: str
    base_type: str
    lubrication: Lubrication
    temperature: float
    slices: int
    contamination: float | None
    assumptions: tuple[str, ...]
    values: tuple[ResolvedValue, ...] = ()
    displacement: FloatArray | None = None
    loose: tuple[str, ...] = ()
    support: FloatArray | None = None
    outer_loads: FloatArray | None = None
    dielectric: Dielectric | None = None

    @property
    def drawing(self) -> FloatArray | None:
        """Stiffness towards the place of a held inner ring.

        It is that of the outer ring's support, zero where that is rigid or the inner ring free, (5,).
        """
        if self.support is None:
            return None
        return np.where(np.array(self.held) & np.isfinite(self.support), self.support, 0.0)

    def outer_displacement(self, carried: FloatArray) -> FloatArray:
        """Return where its support lets the outer ring go.

        The rollers take `carried` from the inner ring, (5,) [N, N m]; the result is (5,) [m, rad].
        """
        if self.support is None or self.outer_loads is None:
            return np.zeros(len(POSE))
        return (carried + self.outer_loads) / self.support

    @property
    def bearing_models(self) -> dict[str, RollerModel]:
        """Itself, under the empty name.

        A model in motion has the same property.
        """
        return {"": self}

    @property
    def warnings(self) -> list[str]:
        """Warnings of the catalogue's limits.

        They are known before anything is solved.
        """
        return list(speed_warning(abs(self.speeds[0] - self.speeds[1]), self.bearing.limiting_speed))


def roller_model(source: Source, overrides: Iterable[str] = ()) -> RollerModel | None:
    """Return the roller bearing of a case.

    None where the case is about balls or cannot be read as one bearing.

    Parameters
    ----------
    source, overrides
        As for :func:`check`.

    Returns
    -------
    RollerModel or None
        Geometry, loads, oil and surfaces at t = 0, with the origin of every value.

    Raises
    ------
    CaseError
        With everything that is missing, contradictory or impossible about the roller bearing.
    """
    from lambda_core.case.case_io import bearing_case
    from lambda_core.discovery.api import registry

    try:
        case = bearing_case(source, overrides)
    except LambdaError:
        return None  # the ordinary path says what is wrong with it
    known = registry()
    with closing(known.catalogue()) as catalogue:
        return _model(case, catalogue, known)


def rollers_at_rest(model: BearingModel) -> RollerModel:
    """Return a moving model as one at rest."""
    found = roller_model(model.case)
    assert found is not None  # the model has rollers from this case
    return found


def _model(case: Case, catalogue: Catalogue, known: Registry) -> RollerModel | None:
    bearing, ledger = case.bearing, Ledger(assumptions=list(case.assumptions))
    found = None
    if bearing.designation is not None:
        found = ledger.ask("bearing.", lambda: roller_designation(catalogue, str(bearing.designation), bearing.maker))
    if found is None and bearing.rollers is None and not ledger.problems:
        return None
    geometry = roller_geometry(case, found, catalogue, ledger)
    row, oil = resolve_lubricant(case.lubricant, catalogue, ledger)
    state, dielectric = None, None
    if row is not None and oil is not None:
        if case.lubricant.properties is not None:
            ledger.problem("lubricant.properties", "roller bearings take an oil of the catalogue: write its name alone")
        else:
            law = ledger.ask("lubricant.name", lambda: OilLaw(row, known))
            if law is not None:
                state = oil_state(law, case.lubricant.temperature, oil.thermal_conductivity)
            if law is not None and geometry is not None:
                density = partial(law.density, temperature=oil.temperature)
                dielectric = dielectric_of_case(case, row, oil, density, geometry, known, ledger)
    if geometry is not None:
        geometry = bent_rings(in_operation(case, geometry, catalogue, ledger), case, catalogue, ledger)
    level = resolve_oil_level(case.lubricant, row, geometry.diameter if geometry else 0.0, ledger)
    held, written = held_directions(case, ledger), friction_of_case(case, known, ledger)
    contamination = contamination_of(case, geometry.pitch_diameter, ledger) if geometry else None
    masses = ring_masses(case, geometry, catalogue) if geometry else (0.0, 0.0)
    loads, support, outer_loads = inner_loads(case, masses[0]), outer_support(case), outer_ring_loads(case, masses[1])
    held, loose = as_outer_ring(case, held, loads, outer_loads)
    if support is not None:
        loads = np.where(np.array(held) & np.isfinite(support), -outer_loads, loads)
    ledger.check(case.name)
    if geometry is None or state is None or row is None:
        raise CaseError(case.name, [Problem(_WHERE, "is not a complete roller bearing")])
    lubrication = lubrication_of(case.lubricant, row)
    if lubrication in _WITHOUT_DRAG:
        ledger.assume(f"drag of rollers is left out at an operating point: SKF has no law for {lubrication}")
    rollers = bearing.rollers or InlineRollers()
    level = -math.inf if is_grease(row) else level
    return RollerModel(
        name=case.name,
        title=roller_title(case, found, geometry),
        bearing=geometry,
        loads=loads,
        held=held,
        displacement=prescribed_pose(case),
        loose=loose,
        support=support,
        outer_loads=outer_loads,
        speeds=(initial(time_function(case.operation.speed)), outer_speed(case)),
        oil=state,
        friction=replace(friction_parameters(geometry, case.surface.roughness, lubrication, level), **written),
        lubricant=row.name,
        base_type=row.base_type,
        lubrication=lubrication,
        temperature=case.lubricant.temperature,
        slices=rollers.slices,
        contamination=contamination,
        assumptions=tuple(ledger.assumptions),
        values=tuple(ledger.values),
        dielectric=dielectric,
    )


def friction_parameters(
    rollers: RollerBearing, roughness: float, lubrication: Lubrication, level: float
) -> FrictionParameters:
    """Return surfaces and supply.

    The oil of a bath is at `level` above the lowest point of the pitch circle [m]. An oil jet drags twice as much as a
    bath to the middle of the lowest roller: SKF, Rolling bearings, catalogue 17000 EN (2018), chapter Friction.
    """
    heights = {"oil bath": max(level + 0.5 * rollers.diameter, 0.0), "oil jet": 0.5 * rollers.diameter}
    return FrictionParameters(
        raceway_roughness=roughness,
        rib_roughness=rollers.rib_roughness,
        replenishment=_REPLENISHMENT[lubrication],
        oil_height=heights.get(lubrication, 0.0),
        drag_factor=2.0 if lubrication == "oil jet" else 1.0,
    )


def roller_title(case: Case, found: RollerDesignation | None, geometry: RollerBearing) -> str:
    if found is None:
        return f"{case.name} (rollers of the case, {geometry.kind})"
    edited = ", rollers edited" if case.bearing.rollers else ""
    return f"{found.row.designation} ({found.row.maker}{edited})"


def roller_geometry(
    case: Case, found: RollerDesignation | None, catalogue: Catalogue, ledger: Ledger
) -> RollerBearing | None:
    """Return geometry and materials.

    The case's values come first, then the catalogue's; None follows a problem.
    """
    if found is None and any(problem.where.startswith("bearing.") for problem in ledger.problems):
        return None  # a wrong designation: what follows from it is not missing
    rollers, row = case.bearing.rollers or InlineRollers(), found.row if found else None
    boundary = _boundary(case, row, ledger)
    values = {name: _pick(rollers, row, name, ledger) for name in (*_NEEDED[1:], "roller_length", "contact_angle")}
    values["rib_height"] = _pick(rollers, row, "rib_height", ledger)
    is_given = "rib_roughness" in rollers.model_fields_set
    origin: tuple[str, ValueStatus] = ("case", "given") if is_given else (_ROUGHNESS, "default")
    ledger.record("bearing.rollers.rib_roughness", rollers.rib_roughness, "small_length", *origin)
    kind = rollers.kind or (row.kind if row else None)
    missing = [name for name in _NEEDED[1:] if values[name] is None] + ([] if kind else ["kind"])
    for name in missing:
        ledger.problem(f"bearing.rollers.{name}", "is required: the catalogue has no such bearing")
    if missing or boundary is None or kind is None:
        return None
    if is_conical(kind) != (values["contact_angle"] is not None):
        ledger.problem("bearing.rollers.contact_angle", "is required for tapered rollers and not allowed for others")
        return None
    _refuse_options_of_balls(case, is_conical(kind), ledger)
    number = {name: float(value or 0.0) for name, value in values.items()}
    length = number["roller_length"] or number["effective_length"] + 2.0 * _SHORTER * number["roller_diameter"]
    shape: dict[str, Any] = {
        "count": int(number["roller_count"]),
        "roller_diameter": number["roller_diameter"],
        "length": number["effective_length"],
        "pitch_diameter": number["pitch_diameter"],
        "contact_angle": number["contact_angle"],
    }
    dynamic, static, limit = ratings_of(case, row, shape, ledger)
    half = (
        shape["contact_angle"]
        and tapered_angles(shape["roller_diameter"], shape["pitch_diameter"], shape["contact_angle"]).half
    )
    profile = profile_of(rollers, row, RollerShape(shape["roller_diameter"], shape["length"], half), ledger)
    materials = materials_apart(("inner", "outer", "balls"), case, catalogue, ledger)
    inner, outer, roller = (materials[part] for part in ("inner", "outer", "balls"))
    try:
        bearing = RollerBearing(
            kind=kind,
            count=shape["count"],
            diameter=number["roller_diameter"],
            length=length,
            effective_length=number["effective_length"],
            pitch_diameter=number["pitch_diameter"],
            bore=boundary[0],
            outside=boundary[1],
            width=boundary[2],
            dynamic_rating=dynamic,
            static_rating=static,
            fatigue_limit=limit,
            contact_angle=number["contact_angle"],
            clearance=0.0 if is_conical(kind) else _clearance(case, found, boundary[0], ledger),
            end_play=rollers.end_play,
            rib_height=number["rib_height"],
            contact_height=rollers.contact_height or 0.0,
            end_radius=rollers.end_radius or 0.0,
            rib_roughness=rollers.rib_roughness,
            series=row.series if row else "",
            limiting_speed=row.limiting_speed.value if row and row.limiting_speed else None,
            caged=case.depth.cage,
            moduli=(effective_modulus(roller, inner), effective_modulus(roller, outer)),
            density=roller.density,
            **profile,
        )
    except ValueError as error:
        ledger.problem("bearing.rollers", str(error).replace("`", ""))
        return None
    check_roller_clearance(bearing, ledger)
    return bearing if is_possible(bearing, ledger) else None


def _refuse_options_of_balls(case: Case, conical: bool, ledger: Ledger) -> None:
    """Refuse options of balls and a tapered bearing's clearance."""
    bearing = case.bearing
    refuse_geometry_of_balls(bearing.geometry, ledger)
    if bearing.contact_angle is not None:
        ledger.problem(
            "bearing.contact_angle", "is that of ball bearings; of tapered rollers write bearing.rollers.contact_angle"
        )
    if bearing.axial_clearance is not None:
        ledger.problem("bearing.axial_clearance", "is that of ball bearings; rollers have bearing.rollers.end_play")
    if conical and bearing.clearance is not None:
        ledger.problem(
            "bearing.clearance",
            "a tapered roller bearing has none before it is mounted: its load closes it; leave it out",
        )
    if case.bodies.cage.per_row:
        ledger.problem("bodies.cage.per_row", ONE_ROW)


def _pick(rollers: InlineRollers, row: RollerRow | None, name: str, ledger: Ledger) -> float | None:
    """Return a value of case or catalogue.

    Assumed and derived ones are reported.
    """
    written: float | None = getattr(rollers, name)
    if written is not None:
        ledger.given(f"bearing.rollers.{name}", written, _QUANTITIES.get(name, "length"))
        return written
    value: Value | None = getattr(row, name) if row else None
    if value is None:
        return None
    ledger.row(f"bearing.rollers.{name}", value, _QUANTITIES.get(name, "length"), silent=True)
    if value.status in ESTIMATED and name == "roller_count":
        ledger.assume(f"rollers of the catalogue, grade {value.grade}: {value.source}")
    return value.value


def _boundary(case: Case, row: RollerRow | None, ledger: Ledger) -> tuple[float, float, float] | None:
    """Return bore, outside diameter and width [m].

    The result is None after a problem.
    """
    inline, found = case.bearing.geometry, []
    for name in _BOUNDARY:
        written = getattr(inline, name, None)
        if written:
            ledger.given(f"bearing.{name}", written, "length")
            found.append(float(written))
        elif row:
            found.append(ledger.row(f"bearing.{name}", getattr(row, name), "length", silent=True))
        else:
            ledger.problem(f"bearing.geometry.{name}", "is required: the catalogue has no such bearing")
    return (found[0], found[1], found[2]) if len(found) == len(_BOUNDARY) else None


def _clearance(case: Case, found: RollerDesignation | None, bore: float, ledger: Ledger) -> float:
    """Return the radial clearance [m].

    It is a value or, of a class, its value as picked.
    """
    text = case.bearing.clearance or (found.clearance if found else None) or "CN"
    if case.bearing.clearance is None and (found is None or found.clearance is None):
        ledger.assume("radial clearance class CN")
    if text[:1].isdigit() or text[:1] in "-+.":
        ledger.given("bearing.clearance", parse(text, "small_length"), "small_length")
        return parse(text, "small_length")
    if text == "geometry" or len(text) > 2:
        ledger.problem("bearing.clearance", f'"{text}": roller bearings take a class C2 to C5 or a value')
        return 0.0
    limits = ledger.ask("bearing.clearance", lambda: _limits(bore, text))
    if limits is None:
        return 0.0
    low, high = limits
    pick = case.bearing.clearance_pick
    clearance = {"minimum": low, "middle": 0.5 * (low + high), "maximum": high}[pick]
    status: ValueStatus = "given" if case.bearing.clearance or (found and found.clearance) else "assumed"
    ledger.record("bearing.clearance", clearance, "small_length", f"{pick} of {text}: {_CLASSES}", status)
    return clearance


def _limits(bore: float, text: str) -> tuple[float, float]:
    try:
        return roller_clearance(bore, text)
    except ValueError as error:
        raise LambdaError(str(error)) from None
