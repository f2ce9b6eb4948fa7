"""Resolve the case of a machine to its model.

Each bearing is resolved as one that is alone (:mod:`~lambda_core.model.resolve`); this module resolves what is
around them.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from contextlib import closing, nullcontext
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

from lambda_core.case.case import Case
from lambda_core.case.case_io import Source, read_tables
from lambda_core.case.case_writer import standalone
from lambda_core.case.machine import MachineCase, bearing_tables, place_in_machine
from lambda_core.case.salvage import InvalidCase, related
from lambda_core.case.written import merged, validate
from lambda_core.catalogue.protocol import Catalogue
from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.blas_threads import one_blas_thread
from lambda_core.domain.errors import CaseError, Problem
from lambda_core.domain.units import show
from lambda_core.formulas.elastic.beam import NODE
from lambda_core.formulas.elastic.body import Disc, ElasticBody, elements_of, rigid_body, shaft_body, with_discs
from lambda_core.formulas.elastic.merged_sections import SHORT, merged_sections
from lambda_core.formulas.elastic.sections import BodyMaterial, RoundSection
from lambda_core.formulas.fits import REFERENCE_TEMPERATURE
from lambda_core.formulas.gear_forces import GearForces, gear_forces
from lambda_core.model.bearing_model import BearingModel, ChosenLaw
from lambda_core.model.bodies.elastic_housing import elastic_housing
from lambda_core.model.bodies.fitting import fitting_warnings
from lambda_core.model.bodies.loads import all_loads, loads_on_parts, refuse_far_beyond, say_idle_loads
from lambda_core.model.bodies.locations import Places, places
from lambda_core.model.bodies.mounting import mounted, refuse_motion
from lambda_core.model.bodies.reduced_shaft import reduced_shaft
from lambda_core.model.bodies.resolve_bodies import hollow_cylinder
from lambda_core.model.bodies.resolve_materials import body_material
from lambda_core.model.bodies.rigid_bodies import (
    connections,
    connections_by_laws,
    refuse_idle_dampers,
    resistance,
    rigid_bodies,
    shaft_hold,
)
from lambda_core.model.checking import resolve
from lambda_core.model.checks.dependent_errors import independent, is_shape_known
from lambda_core.model.checks.fitted_paths import machine_fit_problems
from lambda_core.model.laws.interpolation import say_overshoot
from lambda_core.model.laws.law_packages import packaged_toml
from lambda_core.model.laws.time_functions import initial, planned_speed, time_function
from lambda_core.model.laws.time_laws import resolve_time_laws
from lambda_core.model.ledger import Ledger
from lambda_core.model.machine_model import GROUND, SHAFT, MachineLink, MachineModel, MountedBearing, Unbalance
from lambda_core.model.settings.machine_heat import check_heat, resolve_heat, stretch
from lambda_core.model.settings.machine_solver import changing, refuse_settings, with_settings
from lambda_core.model.settings.resolve_electric import resolve_machine_electric, with_circuits

_MOST_ELEMENTS = 250  # of a shaft: three nodes each, in full matrices
_SLENDEREST = 200  # diameters; elements are as long as thick, and matrices of more take minutes


@one_blas_thread()
def resolve_machine(
    source: Source,
    overrides: Iterable[str] = (),
    *,
    folder: Path | None = None,
    catalogue: Catalogue | None = None,
) -> MachineModel:
    """Read and resolve the case of a machine.

    It does not solve it.

    Parameters
    ----------
    source : str, Path, mapping or MachineCase
        File, plain tables as they stand in one, or a case.
    overrides : iterable of str
        Changes ``path=value``.
    folder : Path, optional
        That file names in plain tables are relative to; default: the working directory.
    catalogue : Catalogue, optional
        An open one, left open; default: one of its own.

    Returns
    -------
    MachineModel
        With the model of every bearing.

    Raises
    ------
    CaseError
        With every mistake at once: those of the file and those that only catalogue and geometry show, of all that the
        former leave.
    """
    from lambda_core.discovery.api import registry

    read = read_tables(source, folder).changed(overrides)
    tables, name, folder = merged({}, read.data), read.name, read.folder
    if read.root is not MachineCase:
        raise CaseError(name, [Problem("bearing", "is one bearing; this command needs a machine with a shaft")])
    found: list[Problem] = []
    case: MachineCase | None = None
    try:
        case = validate(MachineCase, tables, name, folder)
    except InvalidCase as error:
        found += error.problems
        case = error.remainder
    with closing(registry().catalogue()) if catalogue is None else nullcontext(catalogue) as opened:
        models = _bearings(tables, folder, opened, found)
        ledger = Ledger(assumptions=list(case.assumptions) if case else [])
        if case is not None:
            ledger.problems += machine_fit_problems(case.fit, tables, models)
        resolved = _shaft(case, models, opened, ledger, found) if case else None
    if found or ledger.problems or resolved is None or case is None:
        raise CaseError(name, [*found, *independent(found, ledger.problems, tables)])
    alone = standalone(case)
    return replace(resolved, case_toml=packaged_toml(tables if alone == case.written() else alone, registry()))


def _bearings(
    tables: Mapping[str, Any], folder: Path | None, catalogue: Catalogue, found: list[Problem]
) -> dict[str, BearingModel]:
    """Return the models of all bearings that can be resolved."""
    given, models = tables.get("bearings"), {}
    tables_of = given if isinstance(given, Mapping) else {}
    for name in (key for key, value in tables_of.items() if isinstance(value, Mapping)):
        try:
            case = validate(Case, bearing_tables(tables, name), name, folder)
        except InvalidCase as error:  # the mistakes are those of the machine's tables, which are known
            case = error.remainder
        if case is None:
            continue
        try:
            models[name] = resolve(case, catalogue, is_static=True, place=partial(place_in_machine, tables, name))
        except CaseError as error:
            known = [problem.where for problem in found]
            found += [one for one in error.problems if not any(related(one.where, where) for where in known)]
    return models


def _shaft(
    case: MachineCase,
    models: Mapping[str, BearingModel],
    catalogue: Catalogue,
    ledger: Ledger,
    found: Sequence[Problem],
) -> MachineModel | None:
    """Return the machine, None after a problem."""
    from lambda_core.discovery.api import registry

    folder, outside, shape_known = case.folder or Path(), None, is_shape_known(found)
    if case.shaft.reduced is not None:
        outside = reduced_shaft(folder / case.shaft.reduced, ledger)
        shape_known = outside is not None
    stand = places(case, outside, ledger)
    case = _in_place(case, stand)
    if case.shaft.is_rigid and shape_known:
        outside = _rigid(case, stand)
        shape_known = outside is not None
    if shape_known:
        _check_on_shaft(case, stand, outside, ledger)
    _check_one_place(case, stand, ledger)
    for key, bearing in case.bearings.items():
        refuse_motion(key, bearing, case.housing.reduced is not None or stand.seat(bearing.outer) != GROUND, ledger)
    case, laws = resolve_time_laws(case, changing, registry(), ledger)
    say_overshoot(changing(case), ledger)
    refuse_settings(case, ledger)
    check_heat(case, ledger)
    material = body_material(case.shaft.material, "shaft.material", catalogue, ledger)
    around = body_material(case.housing.material, "housing.material", catalogue, ledger)
    _check_torque(case, ledger)
    gears = _gears(case, ledger)
    discs = _discs(case, catalogue, ledger)
    bodies = rigid_bodies(case, catalogue, ledger)
    springs = connections(case, stand, ledger)
    links, more = connections_by_laws(case, stand, registry(), ledger)
    hold, brake = shaft_hold(case, stand, ledger), resistance(case, stand, ledger)
    electric = resolve_machine_electric(case.electric, list(case.bearings), registry(), ledger)
    models = with_circuits(models, electric)
    along = not case.shaft.is_rigid  # a rigid shaft is at its bearing, against which nothing grows
    strain = around.thermal_expansion * (case.housing.temperature - REFERENCE_TEMPERATURE) if around else 0.0
    bearings = sorted(
        (
            mounted(name, given, models[name], stand.seat(given.outer), strain * along * given.place, ledger)
            for name, given in case.bearings.items()
            if name in models
        ),
        key=lambda one: one.position,
    )
    _check_cells(bearings, ledger)
    _check_tilts(case, bearings, ledger)
    if len(bearings) == len(case.bearings):
        refuse_far_beyond(case, gears, bearings, ledger)
    housing, housing_damping = None, None
    if case.housing.reduced is not None:
        is_complete = len(bearings) == len(case.bearings) and not ledger.problems
        housing, housing_damping = elastic_housing(
            folder / case.housing.reduced, bearings if is_complete else (), ledger
        )
    if case.housing.reduced is None or housing is not None:
        refuse_idle_dampers(bearings, housing, ledger)
    if found or ledger.problems or material is None or around is None or len(bearings) < len(case.bearings):
        return None
    bearings[0] = _with_laws(bearings[0], {**more, **laws})
    body = _body(case, stand, material, links, discs, ledger) if outside is None else with_discs(outside, discs)
    if body is None:
        return None
    neglected = "equilibrium"
    if case.shaft.is_rigid:  # the balls of its one bearing are in equilibrium with their friction, too
        neglected = "displacement"
        ledger.assume("the shaft is rigid, its mass that of inner ring and discs: it has no sections")
    caged = {one.name: not one.model.full_complement for one in bearings}
    heat = resolve_heat(case, caged, body, (material, around), ledger)
    shared: dict[str, list[str]] = {}
    for name, model in models.items():
        for sentence in model.assumptions:
            shared.setdefault(sentence, []).append(name)
    for sentence, names in shared.items():
        ledger.assume(f"{', '.join(names)}: {sentence}")
    ledger.assume(f"bearing friction is neglected in the {neglected} of the shaft")
    gravity = (case.gravity.x, case.gravity.y, case.gravity.z)
    drive = case.shaft.drive if case.shaft.drive is not None else float(body.positions[0])
    acting = [(name, load.place) for name, load in case.loads.items() if stand.on_shaft("loads", name)]
    acting += [(name, gear.place) for name, gear in case.gears.items()]
    pulled = np.concatenate([body.weight(gravity), *(one.mass * np.array([*gravity, 0.0, 0.0, 0.0]) for one in bodies)])
    loads, varying = all_loads(case, stand, body, bodies, gears)
    part_loads = loads_on_parts(case, stand)
    say_idle_loads(part_loads, bearings, housing, ledger)
    resolved = MachineModel(
        name=case.name,
        body=body,
        bearings=tuple(bearings),
        housing=housing,
        housing_damping=housing_damping,
        loads=loads,
        growth=np.concatenate([_growth(case, body, material), np.zeros(NODE * len(bodies))]),
        weight=pulled,
        gravity=gravity,
        drive=body.rows(drive).start + 3,
        heat=heat,
        awaits_temperatures=case.operation.temperatures == "computed",
        speed=initial(time_function(case.operation.speed)),
        speed_over_time=time_function(case.operation.speed),
        varying=varying,
        twists=case.shaft.twists or case.operation.torque is not None,
        torque=None if case.operation.torque is None else time_function(case.operation.torque),
        springs=springs,
        links=links,
        hold=hold,
        resistance=brake,
        bodies=bodies,
        markers=tuple(stand.markers.items()),
        part_loads=part_loads,
        electric=electric,
        gears=gears,
        assumptions=tuple(ledger.assumptions),
        warnings=(*ledger.contradictions, *fitting_warnings(case, bearings, _outline(case))),
        outline=_outline(case) if outside is None else _drawn(body, bearings),
        discs=tuple((name, disc.place) for name, disc in case.discs.items()),
        load_places=tuple(acting),
        wheels=tuple((name, gear.place, gear.pitch_diameter) for name, gear in case.gears.items()),
        unbalances=_unbalances(case, bearings),
    )
    return resolved if ledger.problems else with_settings(case, resolved, ledger)


def _unbalances(case: MachineCase, bearings: Iterable[MountedBearing]) -> tuple[Unbalance, ...]:
    """Return the unbalances of discs and inner rings."""
    discs = [Unbalance(disc.place, disc.unbalance, disc.unbalance_angle) for disc in case.discs.values()]
    rings = [Unbalance(one.position, one.model.inner_ring.unbalance, 0.0) for one in bearings]
    return tuple(found for found in (*discs, *rings) if found.amount)


def _with_laws(mounted: MountedBearing, laws: Mapping[str, Mapping[str, ChosenLaw]]) -> MountedBearing:
    """Return a bearing with laws of connections and loads."""
    return replace(mounted, model=replace(mounted.model, laws={**mounted.model.laws, **laws})) if laws else mounted


def _rigid(case: MachineCase, stand: Places) -> ElasticBody | None:
    """Return a rigid shaft with its node at its bearing."""
    at = [place.point[0] for where, place in stand.of.items() if where.startswith("bearings.")]
    return rigid_body(at[0]) if len(case.bearings) == len(at) == 1 else None


def _in_place(case: MachineCase, stand: Places) -> MachineCase:
    """Return the case with the place of every part."""
    tables = {}
    for table in ("bearings", "discs", "gears", "loads", "connections"):
        parts = getattr(case, table)
        at = {name: stand.of[f"{table}.{name}"].point[0] for name in parts if f"{table}.{name}" in stand.of}
        tables[table] = {name: part.placed(at[name]) if name in at else part for name, part in parts.items()}
    return case.model_copy(update=tables)


def _check_on_shaft(case: MachineCase, stand: Places, outside: ElasticBody | None, ledger: Ledger) -> None:
    """Note everything off the shaft or its nodes."""
    laws = {f"connections.{name}" for name, one in case.connections.items() if one.is_by_law and case.shaft.is_rigid}
    on_shaft = {path: place for path, place in stand.of.items() if place.body == SHAFT and path not in laws}
    parts = {f"{path}.at": place.point[0] for path, place in on_shaft.items()}
    if not case.shaft.is_rigid:  # which moves every point along
        parts |= {f"markers.{name}.x": marker.x for name, marker in case.markers.items() if marker.body == "shaft"}
    for name, spring in case.connections.items():
        if stand.carrier(spring.to) == SHAFT and f"connections.{name}" not in laws:
            parts[f"connections.{name}.to"] = spring.place
    if case.shaft.drive is not None:
        parts["shaft.drive"] = case.shaft.drive
    length = sum(section.length for section in case.shaft.sections)
    slender = sum(section.length / section.diameter for section in case.shaft.sections)
    if slender > _SLENDEREST:
        ledger.problem(
            "shaft.sections", f"are {slender:.3g} diameters long, {_SLENDEREST} at most: are lengths and units right?"
        )
    for where, position in parts.items():
        at = show(position, "length", 6)
        if outside is None and not 0.0 <= position <= length * (1.0 + 1e-12):
            ledger.problem(where, f"{at} is not on the shaft: 0 mm to {show(length, 'length', 6)}")
        elif outside is not None and case.shaft.is_rigid and not outside.has_node(position):
            ledger.problem(
                where,
                f"{at} is not the place of the bearing: parts of a shaft without sections are at its bearing, "
                f"{show(float(outside.positions[0]), 'length', 6)}; move it there, or give shaft.sections",
            )
        elif outside is not None and not outside.has_node(position):
            nodes = ", ".join(f"{1e3 * x:.6g}" for x in outside.positions)
            ledger.problem(where, f"there is no node at {at}; nodes of the shaft are at {nodes} mm")


def _check_one_place(case: MachineCase, stand: Places, ledger: Ledger) -> None:
    """Note bearings in one place."""
    seen: dict[float, str] = {}
    for name, bearing in ((name, one) for name, one in case.bearings.items() if f"bearings.{name}" in stand.of):
        other = seen.setdefault(round(bearing.place, 7), name)
        if other != name:
            ledger.problem(f"bearings.{name}.at", f'is also that of "{other}"; give each bearing its own position')


def _check_cells(bearings: Sequence[MountedBearing], ledger: Ledger) -> None:
    """Note bearings with another contact grid than the first."""
    for other in bearings[1:]:
        one, two = bearings[0].model.depth, other.model.depth
        for option in ("strips", "rows"):
            if getattr(one, option) != getattr(two, option):
                ledger.problem(
                    f"bearings.{other.name}.depth.{option}",
                    f'is {getattr(two, option)}, and {getattr(one, option)} of "{bearings[0].name}": '
                    "all bearings of a machine need the same",
                )


def _check_tilts(case: MachineCase, bearings: Sequence[MountedBearing], ledger: Ledger) -> None:
    """Note free tilts of a rigid shaft.

    A self-aligning bearing takes any without resistance.
    """
    if not (case.shaft.is_rigid and any(one.model.geometry.kind.on_sphere for one in bearings)):
        return
    for dof in ("tilt_y", "tilt_z"):
        held = [getattr(case.shaft.support, dof), *(getattr(one, dof) for one in case.connections.values())]
        if not any(one.hold for one in held) and not any(one.is_by_law for one in case.connections.values()):
            ledger.problem(
                f"shaft.support.{dof}",
                'is free, and a self-aligning bearing holds no tilt: write "locked", a stiffness or a motion',
            )


def _check_torque(case: MachineCase, ledger: Ledger) -> None:
    """Note what contradicts a torque that drives the shaft."""
    if case.operation.torque is None:
        return
    if any(term.kind != "constant" for term in time_function(case.operation.speed).terms):
        ledger.problem("operation.speed", "must be one value, because with a driving torque it is the initial speed")
    for name, gear in case.gears.items():
        if gear.power is not None:
            ledger.problem(f"gears.{name}.power", "a torque drives the shaft: write the torque of the gear, too")


def _gears(case: MachineCase, ledger: Ledger) -> dict[str, GearForces]:
    """Return the forces of every gear at its speed."""
    found = {}
    for name, gear in case.gears.items():
        over_time = time_function(case.operation.speed)
        speed = planned_speed(over_time)
        if gear.power is not None and speed == 0.0:
            ledger.problem(f"gears.{name}.power", "needs a speed of the shaft: at rest write the torque")
            continue
        if gear.power is not None and any(term.kind != "constant" for term in over_time.terms):
            ledger.problem(f"gears.{name}.power", "needs a constant speed: where it changes write the torque")
            continue
        torque = gear.torque if gear.torque is not None else (gear.power or 0.0) / abs(speed)
        found[name] = gear_forces(
            torque, gear.pitch_diameter, mesh=gear.mesh, role=gear.role, spin=speed,
            pressure_angle=gear.pressure_angle, helix_angle=gear.helix_angle, hand=gear.hand or "right",
        )  # fmt: skip
    return found


def _outline(case: MachineCase) -> tuple[tuple[float, float, float, float], ...]:
    ends = np.cumsum([0.0, *(section.length for section in case.shaft.sections)]).tolist()
    return tuple((ends[i], ends[i + 1], s.diameter, s.bore) for i, s in enumerate(case.shaft.sections))


def _discs(case: MachineCase, catalogue: Catalogue, ledger: Ledger) -> list[Disc]:
    """Return the rigid bodies on the shaft with their masses."""
    found = []
    for name, given in case.discs.items():
        mass, polar, transverse = given.mass or 0.0, 0.0, 0.0
        if given.diameter is not None and given.width is not None:
            material = body_material(given.material, f"discs.{name}.material", catalogue, ledger)
            outer, inner = given.diameter**2, given.bore**2
            mass = 0.25 * math.pi * (outer - inner) * given.width * (material.density if material else 0.0)
            cylinder = hollow_cylinder(mass, 0.5 * given.bore, 0.5 * given.diameter, given.width)
            polar, transverse = cylinder.polar, cylinder.transverse
        if given.polar_inertia is not None:
            polar, transverse = given.polar_inertia, 0.5 * given.polar_inertia
        if given.transverse_inertia is not None:
            transverse = given.transverse_inertia
        found.append(Disc(given.place, mass, transverse, polar))
    return found


def _drawn(body: ElasticBody, bearings: Iterable[MountedBearing]) -> tuple[tuple[float, float, float, float], ...]:
    """Return one piece for a shaft without sections.

    It is for drawings, as thick as its smallest bearing's bore.

    One of a single node is as wide as its bearing.
    """
    smallest = min((bearing.model.geometry for bearing in bearings), key=lambda g: g.bore_diameter)
    half = 0.5 * smallest.width if body.is_rigid else 0.0
    return ((float(body.positions[0]) - half, float(body.positions[-1]) + half, smallest.bore_diameter, 0.0),)


def _body(
    case: MachineCase, stand: Places, material: BodyMaterial, links: Sequence[MachineLink], discs: list[Disc],
    ledger: Ledger,
) -> ElasticBody | None:  # fmt: skip
    """Return the shaft as a beam.

    None where its mesh would be too large, which the ledger reports then.
    """
    given = [(s.length, RoundSection(s.diameter, s.bore, material)) for s in case.shaft.sections]
    held = [place.point[0] for place in stand.of.values() if place.body == SHAFT]
    held += [place.point[0] for place in stand.markers.values() if place.body == SHAFT]
    held += [spring.place for spring in case.connections.values() if stand.carrier(spring.to) == SHAFT]
    held += [link.first.point[0] for link in links if link.first.body == SHAFT]
    drive = [] if case.shaft.drive is None else [case.shaft.drive]
    sections, places = merged_sections(given), [*held, *drive]
    if len(sections) < len(given):
        ledger.assume(
            f"short pieces of the shaft are merged into sections that bend like them: {len(given)} given, "
            f"{len(sections)} left"
        )
    count = elements_of(sections, [*places, *(disc.position for disc in discs)]).size - 1
    if count > _MOST_ELEMENTS:
        ledger.problem(
            "shaft.sections",
            f"and the places on the shaft make {count} elements, {_MOST_ELEMENTS} at most: leave out details; only "
            f"pieces shorter than {SHORT:g} of their diameter are merged",
        )
        return None
    return shaft_body(sections, places=places, discs=discs)


def _growth(case: MachineCase, body: ElasticBody, material: BodyMaterial) -> FloatArray:
    """Return the nodal forces of the shaft's thermal growth."""
    stretched = np.zeros(body.mass.shape[0])
    along = case.shaft.temperatures
    if along:
        places, temperatures = np.array(along).T
        moved = stretch(body.positions, places, temperatures, material)
    else:
        strain = material.thermal_expansion * (case.shaft.temperature - REFERENCE_TEMPERATURE)
        moved = strain * body.positions
    stretched[0 : NODE * body.positions.size : NODE] = moved
    found: FloatArray = body.stiffness @ stretched
    return found
