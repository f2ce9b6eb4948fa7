"""From the case of a shaft to its model: every bearing resolved as its own case, every mistake at once."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from contextlib import closing, nullcontext
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from lambda_core.case.case_io import overridden
from lambda_core.case.case_writer import tables_toml
from lambda_core.case.parts import InlineMaterial
from lambda_core.case.shaft import ShaftCase, bearing_tables
from lambda_core.case.shaft_io import shaft_tables, validate_shaft
from lambda_core.catalogue.protocol import Catalogue
from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.errors import CaseError, Problem
from lambda_core.domain.fits import REFERENCE_TEMPERATURE
from lambda_core.domain.gear_forces import GearForces, gear_forces
from lambda_core.domain.units import show
from lambda_core.elastic.body import Disc, ElasticBody, shaft_body
from lambda_core.elastic.sections import BodyMaterial, RoundSection
from lambda_core.shaft.elastic_housing import housing_stiffness
from lambda_core.shaft.model import ShaftModel, ShaftSpring, Unbalance
from lambda_core.shaft.seating import mounted
from lambda_core.solver.drivers.held_ring import POSE
from lambda_core.system.bearing import BearingModel, TimeFunction
from lambda_core.system.checking import check
from lambda_core.system.ledger import Ledger
from lambda_core.system.time_functions import initial, planned_speed, time_function
from lambda_core.system.time_laws import refuse_laws

_COMPONENTS = ("force_x", "force_y", "force_z", "moment_x", "moment_y", "moment_z")
Source = str | Path | Mapping[str, Any] | ShaftCase


def check_shaft(
    source: Source,
    overrides: Iterable[str] = (),
    *,
    folder: Path | None = None,
    catalogue: Catalogue | None = None,
) -> ShaftModel:
    """Read and resolve the case of a shaft in bearings without solving it.

    Parameters
    ----------
    source : str, Path, mapping or ShaftCase
        File, plain tables as they stand in one, or a case.
    overrides : iterable of str
        Changes ``path=value``.
    folder : Path, optional
        That file names in plain tables are relative to; default: the working directory.
    catalogue : Catalogue, optional
        An open one, left open; default: one of its own.

    Returns
    -------
    ShaftModel
        With the model of every bearing.

    Raises
    ------
    CaseError
        With every mistake at once: those of the file and those that only catalogue and geometry show.
    """
    from lambda_core.discovery.manager import registry

    if isinstance(source, ShaftCase):
        tables, name, folder = source.written(), source.name, source.folder
    elif isinstance(source, Mapping):
        tables, name = dict(source), str(source.get("name", "shaft"))
    else:
        tables, name, folder = shaft_tables(source), Path(source).name, Path(source).resolve().parent
    tables = overridden(tables, overrides, ShaftCase)
    found: list[Problem] = []
    case: ShaftCase | None = None
    try:
        case = validate_shaft(tables, name, folder)
    except CaseError as error:
        found += error.problems
    with closing(registry().catalogue()) if catalogue is None else nullcontext(catalogue) as opened:
        models = _bearings(tables, folder, opened, found)
        ledger = Ledger(assumptions=list(case.assumptions) if case else [])
        resolved = _shaft(case, models, opened, ledger) if case else None
    if found or ledger.problems or resolved is None:
        raise CaseError(name, [*found, *(p for p in ledger.problems if p not in found)])
    return replace(resolved, case_toml=tables_toml(_anywhere(tables, folder)))


def _anywhere(tables: Mapping[str, Any], folder: Path | None) -> dict[str, Any]:
    """Return tables whose files are found from any folder."""
    housing = tables.get("housing")
    if not isinstance(housing, Mapping) or "reduced" not in housing:
        return dict(tables)
    return {**tables, "housing": {**housing, "reduced": str(((folder or Path()) / housing["reduced"]).absolute())}}


def _bearings(
    tables: Mapping[str, Any], folder: Path | None, catalogue: Catalogue, found: list[Problem]
) -> dict[str, BearingModel]:
    """Return the model of every bearing that can be resolved; what is wrong with the others comes into `found`."""
    given, models = tables.get("bearings"), {}
    tables_of = given if isinstance(given, Mapping) else {}
    for name in (key for key, value in tables_of.items() if isinstance(value, Mapping)):
        try:
            models[name] = check(bearing_tables(tables, name), folder=folder, catalogue=catalogue, is_static=True)
        except CaseError as error:
            for problem in error.problems:
                where = problem.where.replace("bodies.cage", f"bearings.{name}.cage")
                where = f"bearings.{name}{where[7:]}" if where.split(".")[0] == "bearing" else where
                where = f"bearings.{name}.{where}" if where.split(".")[0] == "elastic" else where
                if where != "name" and not any(_related(where, known.where) for known in found):
                    found.append(Problem(where, problem.message))
    return models


def _related(one: str, other: str) -> bool:
    return f"{one}.".startswith(f"{other}.") or f"{other}.".startswith(f"{one}.")


def _shaft(
    case: ShaftCase, models: Mapping[str, BearingModel], catalogue: Catalogue, ledger: Ledger
) -> ShaftModel | None:
    """Return the whole; None where a bearing is missing, whose problems are known."""
    _places(case, ledger)
    changing = [("operation.speed", case.operation.speed)]
    changing += [
        (f"loads.{key}.{name}", getattr(load, name)) for key, load in case.loads.items() for name in _COMPONENTS
    ]
    refuse_laws(changing, ledger)
    material = _material(case.shaft.material, "shaft.material", catalogue, ledger)
    around = _material(case.housing.material, "housing.material", catalogue, ledger)
    gears = _gears(case, ledger)
    discs = _discs(case, catalogue, ledger)
    if material is None or around is None or ledger.problems or len(models) < len(case.bearings):
        return None
    body = _body(case, material, discs)
    growth = around.thermal_expansion * (case.housing.temperature - REFERENCE_TEMPERATURE)
    bearings = sorted(
        (
            mounted(name, case.bearings[name], model, growth * case.bearings[name].position, ledger)
            for name, model in models.items()
        ),
        key=lambda one: one.position,
    )
    housing = None
    if case.housing.reduced is not None:
        housing = housing_stiffness((case.folder or Path()) / case.housing.reduced, bearings, ledger)
        if housing is None:
            return None
    shared: dict[str, list[str]] = {}
    for name, model in models.items():
        for sentence in model.assumptions:
            shared.setdefault(sentence, []).append(name)
    for sentence, names in shared.items():
        ledger.assume(f"{', '.join(names)}: {sentence}")
    ledger.assume("the friction of the bearings does not count in the balance of the shaft")
    drive = case.shaft.drive if case.shaft.drive is not None else 0.0
    places = [(name, part.position) for table in (case.loads, case.gears) for name, part in table.items()]
    return ShaftModel(
        name=case.name,
        body=body,
        bearings=tuple(bearings),
        housing=housing,
        loads=_loads(case, body, gears),
        growth=_growth(case, body, material),
        weight=body.weight((case.gravity.x, case.gravity.y, case.gravity.z)),
        gravity=(case.gravity.x, case.gravity.y, case.gravity.z),
        drive=body.rows(drive).start + 3,
        speed=initial(time_function(case.operation.speed)),
        speed_over_time=time_function(case.operation.speed),
        varying=_varying(case, body),
        twists=case.shaft.twists,
        springs=tuple(
            ShaftSpring(
                name,
                spring.position,
                tuple(getattr(spring, dof) for dof in POSE),
                tuple(getattr(spring, f"damping_{dof}") for dof in POSE),
            )
            for name, spring in case.springs.items()
        ),
        contamination=case.life.contamination,
        gears=gears,
        assumptions=tuple(ledger.assumptions),
        outline=_outline(case),
        discs=tuple((name, disc.position) for name, disc in case.discs.items()),
        load_places=tuple(places),
        wheels=tuple((name, gear.position, gear.pitch_diameter) for name, gear in case.gears.items()),
        unbalances=tuple(
            Unbalance(disc.position, disc.unbalance, disc.unbalance_angle)
            for disc in case.discs.values()
            if disc.unbalance
        ),
    )


def _places(case: ShaftCase, ledger: Ledger) -> None:
    """Note everything that stands beside the shaft, and bearings in one place."""
    parts = {f"{table}.{name}": part.position for table in ("bearings", "discs", "loads", "gears", "springs")
             for name, part in getattr(case, table).items()}  # fmt: skip
    if case.shaft.drive is not None:
        parts["shaft.drive"] = case.shaft.drive
    for path, position in parts.items():
        if not 0.0 <= position <= case.length * (1.0 + 1e-12):
            where = path if path == "shaft.drive" else f"{path}.position"
            ledger.problem(
                where, f"{show(position, 'length', 6)} is not on the shaft: 0 mm to {show(case.length, 'length', 6)}"
            )
    seen: dict[float, str] = {}
    for name, bearing in case.bearings.items():
        other = seen.setdefault(round(bearing.position, 7), name)
        if other != name:
            ledger.problem(f"bearings.{name}.position", f'is that of "{other}" too: bearings stand beside each other')


def _material(choice: str | InlineMaterial, where: str, catalogue: Catalogue, ledger: Ledger) -> BodyMaterial | None:
    if isinstance(choice, InlineMaterial):
        return BodyMaterial(choice.youngs_modulus, choice.poisson_ratio, choice.density, choice.thermal_expansion)
    row = ledger.ask(where, lambda: catalogue.material(choice))
    if row is None:
        return None
    names = ("youngs_modulus", "poisson_ratio", "density", "thermal_expansion")
    return BodyMaterial(*(getattr(row, name).value for name in names))


def _gears(case: ShaftCase, ledger: Ledger) -> dict[str, GearForces]:
    """Return the forces of every gear; a power needs a speed."""
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


def _outline(case: ShaftCase) -> tuple[tuple[float, float, float, float], ...]:
    ends = np.cumsum([0.0, *(section.length for section in case.shaft.sections)]).tolist()
    return tuple((ends[i], ends[i + 1], s.diameter, s.bore) for i, s in enumerate(case.shaft.sections))


def _discs(case: ShaftCase, catalogue: Catalogue, ledger: Ledger) -> list[Disc]:
    """Return the rigid bodies on the shaft, their masses given or from their shapes."""
    found = []
    for name, given in case.discs.items():
        mass, polar, transverse = given.mass or 0.0, 0.0, 0.0
        if given.diameter is not None and given.width is not None:
            material = _material(given.material, f"discs.{name}.material", catalogue, ledger)
            outer, inner = given.diameter**2, given.bore**2
            mass = 0.25 * math.pi * (outer - inner) * given.width * (material.density if material else 0.0)
            polar = mass * (outer + inner) / 8.0
            transverse = 0.5 * polar + mass * given.width**2 / 12.0
        if given.polar_inertia is not None:
            polar, transverse = given.polar_inertia, 0.5 * given.polar_inertia
        if given.transverse_inertia is not None:
            transverse = given.transverse_inertia
        found.append(Disc(given.position, mass, transverse, polar))
    return found


def _body(case: ShaftCase, material: BodyMaterial, discs: list[Disc]) -> ElasticBody:
    sections = [(s.length, RoundSection(s.diameter, s.bore, material)) for s in case.shaft.sections]
    places = [bearing.position for bearing in case.bearings.values()]
    places += [load.position for load in case.loads.values()]
    places += [gear.position for gear in case.gears.values()]
    places += [spring.position for spring in case.springs.values()]
    drive = [] if case.shaft.drive is None else [case.shaft.drive]
    return shaft_body(sections, places=[*places, *drive], discs=discs)


def _loads(case: ShaftCase, body: ElasticBody, gears: Mapping[str, GearForces]) -> FloatArray:
    """Return the nodal forces of loads and gears, shape (6 n,)."""
    found: FloatArray = np.zeros(body.mass.shape[0])
    for load in case.loads.values():
        found[body.rows(load.position)] += [initial(time_function(getattr(load, name))) for name in _COMPONENTS]
    for name, forces in gears.items():
        found[body.rows(case.gears[name].position)] += [*forces.force, *forces.moment]
    return found


def _varying(case: ShaftCase, body: ElasticBody) -> tuple[tuple[int, TimeFunction], ...]:
    """Return the rows of loads that change, with their values over time."""
    found = []
    for load in case.loads.values():
        for i, name in enumerate(_COMPONENTS):
            function = time_function(getattr(load, name))
            if any(term.kind != "constant" for term in function.terms):
                found.append((body.rows(load.position).start + i, function))
    return tuple(found)


def _growth(case: ShaftCase, body: ElasticBody, material: BodyMaterial) -> FloatArray:
    """Return the nodal forces that stretch the shaft as its temperature does, shape (6 n,)."""
    found: FloatArray = np.zeros(body.mass.shape[0])
    strain = material.thermal_expansion * (case.shaft.temperature - REFERENCE_TEMPERATURE)
    for begin, end, diameter, bore in _outline(case):
        push = RoundSection(diameter, bore, material).axial_stiffness * strain
        found[body.rows(begin).start] -= push
        found[body.rows(end).start] += push
    return found
