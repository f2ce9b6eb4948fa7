"""Resolve the case of one bearing to its model.

What the case leaves open is filled from the catalogue or by a stated assumption; what is
missing, unknown, contradictory or impossible is collected and raised at once.
"""

from __future__ import annotations

import dataclasses
import hashlib
import json
from collections.abc import Callable, Iterable, Mapping
from typing import TYPE_CHECKING, Any, Protocol

from pydantic import BaseModel

from lambda_core.case.case import Case
from lambda_core.case.case_writer import standalone
from lambda_core.catalogue.protocol import BearingRow, CageRow, Catalogue
from lambda_core.domain.elements import BODIES, RACEWAYS
from lambda_core.domain.errors import Problem
from lambda_core.domain.roles import DEFAULT_MODELS, DEFAULT_RIB_MODELS, DEFAULT_ROLLER_MODELS
from lambda_core.domain.units import show
from lambda_core.elements.ball.geometry import Geometry
from lambda_core.laws.context import Material
from lambda_core.laws.jit.reach import content_key
from lambda_core.laws.law import Law
from lambda_core.model.bearing_model import (
    BearingModel,
    ChosenEvent,
    ChosenLaw,
    ChosenObserver,
    Depth,
    Output,
)
from lambda_core.model.bodies.possible_bodies import check_possible
from lambda_core.model.bodies.resolve_bodies import (
    Inertia,
    check_bodies,
    resolve_body,
    resolve_cage,
    resolve_inertia,
    ring_inertia,
    shaft_inertia,
)
from lambda_core.model.bodies.resolve_elastic import resolve_elastic
from lambda_core.model.bodies.resolve_materials import (
    lubrication_of,
    resolve_lubricant,
    resolve_material,
    resolve_oil_level,
)
from lambda_core.model.checks.fitted_paths import fit_problems, known_numbers
from lambda_core.model.geometry.free_tilts import hold_tilts
from lambda_core.model.geometry.geometry_checks import check_clearance
from lambda_core.model.geometry.resolve_clearance import clearance_in_operation, resolve_mounting
from lambda_core.model.geometry.resolve_designation import resolve_designation
from lambda_core.model.geometry.resolve_geometry import resolve_geometry, with_clearance
from lambda_core.model.geometry.roller_limits import check_roller_clearance
from lambda_core.model.geometry.shadowed_data import tell_shadows
from lambda_core.model.laws.interpolation import say_overshoot
from lambda_core.model.laws.law_packages import law_called, packaged_toml
from lambda_core.model.laws.resolve_laws import LawResolver, ModelSource
from lambda_core.model.laws.resolve_links import resolve_links, resolve_markers
from lambda_core.model.laws.resolve_states import check_states
from lambda_core.model.laws.time_laws import resolve_time_laws, signals_of
from lambda_core.model.ledger import Ledger
from lambda_core.model.rollers_in_motion import as_balls, check_roller_fit, rollers_of, with_ribs, with_rollers
from lambda_core.model.settings.contamination import contamination_of
from lambda_core.model.settings.resolve_electric import resolve_electric
from lambda_core.model.settings.resolve_solver import resolve_solver
from lambda_core.model.settings.resolve_thermal import check_thermal
from lambda_core.model.settings.resolve_watch import WatchSource, resolve_events, resolve_observers
from lambda_core.views.observer import Event, Observer

if TYPE_CHECKING:
    from lambda_core.model.machine_model import MachineModel


class PluginSource(ModelSource, WatchSource, Protocol):
    """Registry functions that the resolution needs."""


def resolve(
    case: Case,
    registry: PluginSource,
    catalogue: Catalogue,
    *,
    is_static: bool = False,
    place: Callable[[str], str] = str,
    defaults: Mapping[str, str] = DEFAULT_MODELS,
    has_grooves: bool = True,
) -> BearingModel:
    """Freeze a case into the model that a run needs.

    Parameters
    ----------
    case : Case
        What the engineer wrote.
    registry : PluginSource
        Models by role and name; observers and events by name.
    catalogue : Catalogue
        Bearings, lubricants, materials, cages, clearance classes.
    is_static : bool
        Whether the model is for an equilibrium alone, which needs no end in time.
    place : callable
        Where in the file stands what stands at a path of the case: a machine has several bearings.
    defaults : mapping
        Law of each role where the case has none.
    has_grooves : bool
        Whether the balls roll in grooves; those that stand for rollers do not.

    Raises
    ------
    CaseError
        With everything that is unknown, missing, contradictory or impossible.
    """
    found = rollers_of(case, catalogue, place)
    if found is not None:
        balls, usual = as_balls(case, found[0]), DEFAULT_MODELS | DEFAULT_ROLLER_MODELS
        model = resolve(balls, registry, catalogue, is_static=is_static, place=place, defaults=usual, has_grooves=False)
        of_ribs = usual | DEFAULT_RIB_MODELS
        ribs = _laws_of_ribs(with_ribs(balls, case), registry, catalogue, of_ribs, place) if found[0].ribs else {}
        model = with_rollers(
            model, case, *found, ribs, lambda role, name: law_called(registry, role, name, given=False)
        )
        if model.rollers is not None and model.mounting is not None:
            ledger = Ledger(place=place)
            check_roller_clearance(model.rollers, ledger)
            ledger.check(case.name)
        if place is str:
            check_roller_fit(case, model)
        return dataclasses.replace(model, case_toml=packaged_toml(standalone(case), registry))
    ledger, written = Ledger(assumptions=list(case.assumptions), place=place), case
    row, designation, case = resolve_designation(written, catalogue, ledger)
    known = row is not None or (case.bearing.designation is None and case.bearing.geometry is not None)
    bare = resolve_geometry(case.bearing, row, catalogue, ledger) if known else None
    parts = {part: resolve_material(part, case, catalogue, ledger) for part in ("inner", "outer", "balls")}
    cage_row = ledger.ask("bodies.cage.type", lambda: catalogue.cage(case.bodies.cage.type))
    parts["cage"] = resolve_material("cage", case, catalogue, ledger, cage_row.material if cage_row else None)
    materials = {part: known.material for part, known in parts.items()}
    lubricant, oil = resolve_lubricant(case.lubricant, catalogue, ledger)
    case = hold_tilts(case, bare[0], ledger) if bare else case
    case, courses = resolve_time_laws(case, signals_of, registry, ledger)
    if not is_static:
        say_overshoot(signals_of(case), ledger)
    check_bodies(case, ledger)
    check_thermal(case, ledger, has_cage=case.depth.cage or has_grooves)
    _settings(case, ledger)
    kind = bare[0].kind.name if bare else "deep groove"
    guidance = case.bodies.cage.guidance or (cage_row.guidance if cage_row else "ball")
    laws: dict[str, dict[str, ChosenLaw]] = {}
    if lubricant:
        laws = LawResolver(case, registry, lubricant, guidance, ledger, kind, defaults).resolve()
    markers = resolve_markers(case, ledger)
    between, more = resolve_links(case, registry, ledger)
    more |= courses
    electric = resolve_electric(case.electric.inlined(), registry, ledger) if case.electric else None
    observers, events = resolve_observers(case, registry, ledger), resolve_events(case, registry, ledger)
    if bare is None or cage_row is None or oil is None:
        ledger.check(case.name)
        raise AssertionError("a part is missing and no problem says why")
    _check_temperature(case, cage_row, ledger)
    geometry, bought = bare
    _possible(case, ledger)
    mounting = resolve_mounting(case, geometry, bought, parts["inner"].solid, parts["balls"].solid, ledger)
    if mounting is not None:
        geometry = with_clearance(geometry, clearance_in_operation(case, geometry, mounting, ledger))
    check_clearance(geometry, ledger, has_grooves=has_grooves)
    _possible(case, ledger)
    lubrication = lubrication_of(case.lubricant, lubricant)
    oil_level = resolve_oil_level(case.lubricant, lubricant, geometry.ball_diameter, ledger)
    cage, cage_estimate = resolve_cage(
        case.bodies.cage, cage_row, geometry, materials["cage"], ledger, is_there=case.depth.cage
    )
    inertias = _inertias(case, geometry, materials, cage_estimate, ledger)
    elastic = resolve_elastic(case, geometry, (cage, inertias["cage"].mass), materials, ledger)
    bodies = {name: resolve_body(name, case, inertias[name]) for name in BODIES}
    check_possible(case, geometry, bodies, ledger)
    solver = resolve_solver(case, geometry, laws, ledger, is_static=is_static)
    names = (designation, oil.name, *(material.name for material in materials.values()), cage_row.name)
    check_states(laws, observers, ledger)
    tell_shadows(catalogue, registry, (case, names), laws, ledger)
    if place is str:  # a machine checks its own
        ledger.problems += fit_problems(case.fit, known_numbers(laws, ledger.values))
    ledger.check(case.name)
    return BearingModel(
        name=case.name,
        title=_title(case, row, designation),
        geometry=geometry,
        ball_material=materials["balls"],
        inner_material=materials["inner"],
        outer_material=materials["outer"],
        cage_material=materials["cage"],
        oil=oil,
        oil_level=oil_level,
        lubrication=lubrication,
        oil_flow=case.thermal.oil_flow,
        roughness=case.surface.roughness,
        starvation=case.lubricant.starvation,
        gravity=(case.gravity.x, case.gravity.y, case.gravity.z),
        inner_ring=bodies["inner_ring"],
        outer_ring=bodies["outer_ring"],
        cage=cage,
        cage_body=bodies["cage"],
        laws={**laws, **more},
        depth=Depth(case.depth.cage, case.depth.strips, case.depth.rows),
        solver=solver,
        output=Output(case.output.interval or 0.0, case.output.checkpoint_interval),
        values=tuple(ledger.values),
        assumptions=tuple(ledger.assumptions),
        case_toml=packaged_toml(standalone(written), registry),
        plugins=_distributions(
            {**laws, **more, "electric": electric.laws if electric else {}}, [*observers.values(), *events.values()]
        ),
        markers=markers,
        thermal=case.thermal if case.operation.temperatures == "computed" else None,
        mounting=mounting,
        contradictions=tuple(ledger.contradictions),
        electric=electric,
        observers=observers,
        events=events,
        links=between,
        elastic=elastic,
        contamination=contamination_of(case, geometry.pitch_diameter, ledger),
        requirements=case.requirements,
    )


def _laws_of_ribs(
    case: Case,
    registry: PluginSource,
    catalogue: Catalogue,
    defaults: Mapping[str, str],
    place: Callable[[str], str],
) -> Mapping[str, Mapping[str, ChosenLaw]]:
    """Return the laws at ribs by element.

    The case has those of ribs at its raceways.
    """

    def renamed(text: str) -> str:
        text = text.replace("ball_inner", "rib_inner").replace("ball_outer", "rib_outer")
        return text.replace("the contacts of balls are points", "ends of rollers touch ribs at points")

    ledger = Ledger(place=lambda path: place(renamed(path)))
    lubricant, _ = resolve_lubricant(case.lubricant, catalogue, ledger)
    laws = LawResolver(case, registry, lubricant, "ball", ledger, defaults=defaults).resolve()
    ledger.problems = [Problem(one.where, renamed(one.message)) for one in ledger.problems]
    ledger.check(case.name)
    return {renamed(element): laws[element] for element in RACEWAYS}


def _distributions(
    laws: Mapping[str, Mapping[str, ChosenLaw]], watching: Iterable[ChosenObserver | ChosenEvent]
) -> tuple[str, ...]:
    """Return the distribution and version of used plugins.

    A chosen law, observer or event comes from the plugin.
    """
    found = {law.model.distribution for roles in laws.values() for law in roles.values()}
    found |= {chosen.item.distribution for chosen in watching}
    return tuple(sorted(found - {""}))


def _title(case: Case, row: BearingRow | None, designation: str) -> str:
    if row is None:
        return f"{designation or case.name} (geometry of the case)"
    edited = ", geometry edited" if case.bearing.geometry else ""
    return f"{designation} ({row.maker}{edited})"


def _possible(case: Case, ledger: Ledger) -> None:
    """Raise the problems of an impossible bearing.

    The next stages compute with its dimensions.
    """
    if any(problem.where.startswith("bearing.") for problem in ledger.problems):
        ledger.check(case.name)


def _check_temperature(case: Case, cage: CageRow, ledger: Ledger) -> None:
    """Report an oil too hot for the cage."""
    limit, oil = cage.maximum_temperature, case.lubricant.temperature
    if case.depth.cage and limit is not None and oil > limit.value:
        hot, rated = show(oil, "temperature", 4), show(limit.value, "temperature", 4)
        ledger.assume(f"the oil at {hot} is hotter than the cage type {cage.name} is made for ({rated})")


def _inertias(
    case: Case, geometry: Geometry, materials: Mapping[str, Material], cage: Inertia, ledger: Ledger
) -> dict[str, Inertia]:
    """Return mass and inertia of rings and cage.

    The shaft counts to the inner ring.
    """
    bodies = case.bodies
    rings = {ring: ring_inertia(geometry, ring, materials[ring].density) for ring in ("inner", "outer")}
    inner = resolve_inertia("inner_ring", bodies.inner_ring, rings["inner"], ledger)
    shaft = shaft_inertia(bodies.inner_ring, geometry, materials["inner"].density, ledger)
    ledger.assume("mass and inertia of the rings estimated from the geometry: hollow cylinders less their grooves")
    return {
        "inner_ring": inner + shaft,
        "outer_ring": resolve_inertia("outer_ring", bodies.outer_ring, rings["outer"], ledger),
        "cage": resolve_inertia("cage", bodies.cage, cage, ledger),
    }


def _settings(case: Case, ledger: Ledger) -> None:
    """Record the remaining settings; those left open become assumptions."""
    lubricant, surface = case.lubricant, case.surface
    ledger.given("lubricant.temperature", lubricant.temperature, "temperature")
    for section, name, quantity, sentence in (
        (lubricant, "starvation", "", "films fully flooded: no starvation is given"),
        (
            surface,
            "roughness",
            "small_length",
            "composite roughness sigma {}, as on measured raceways of 0.10 and 0.16 um",
        ),
    ):
        value, prefix = getattr(section, name), "surface" if section is surface else "lubricant"
        if name in section.model_fields_set:
            ledger.given(f"{prefix}.{name}", value, quantity)
        else:
            ledger.record(f"{prefix}.{name}", value, quantity, "default", "assumed")
            ledger.assume(sentence.format(show(value, quantity)) if "{}" in sentence else sentence)


def case_hash(model: BearingModel) -> str:
    """Return the hash of a run's inputs.

    It covers all that decides the numbers, and is equal in every process.

    The laws count with everything their kernels reach: an edited law has another hash. Name,
    title, sources and assumptions are left out: two cases that mean the same run share one.
    """
    silent = {"name", "title", "values", "assumptions", "contradictions", "case_toml", "plugins"}
    silent |= {"contamination", "requirements", "found_temperatures"}  # of ratings and bands
    if model.thermal is None:
        silent |= {"thermal", "mounting"}
    if model.electric is None:
        silent |= {"electric"}
    # Left out where a model has none: the hash is that from before there were any.
    absent = [name for name in ("observers", "events", "links", "elastic", "rollers") if not getattr(model, name)]
    names = [f.name for f in dataclasses.fields(model) if f.name not in (*silent, *absent)]
    data = {name: _plain(getattr(model, name)) for name in names}
    if model.solver.resolve == 0.0:
        del data["solver"]["resolve"]
    for name in ("resting_angle", "rows", "row_distance", "arrangement"):  # as before there were any
        if getattr(model.geometry, name) == Geometry.__dataclass_fields__[name].default:
            del data["geometry"][name]
    text = json.dumps(data, sort_keys=True, separators=(",", ":"))
    return hashlib.sha256(text.encode()).hexdigest()


def model_hash(model: BearingModel | MachineModel) -> str:
    """Return the hash of all that decides a model's numbers."""
    parts = [*model.surroundings, *map(case_hash, model.bearing_models.values())]
    return parts[0] if len(parts) == 1 else hashlib.sha256("\n".join(parts).encode()).hexdigest()


def _plain(value: Any) -> Any:
    """Return `value` as JSON data.

    Floats keep 13 digits, so that 0.1 um and 100 nm are one.
    """
    if isinstance(value, Law):
        laws = [function for function in (value.kernel, value.prepare) if function is not None]
        kept = [_plain(state) for state in value.states]  # none: as before there were any
        return [value.role, value.name, value.role_api, *(content_key(law) for law in laws), *kept]
    if isinstance(value, Observer | Event):
        return [value.name, value.key]
    if isinstance(value, BaseModel):
        return {name: _plain(getattr(value, name)) for name in type(value).model_fields}
    if dataclasses.is_dataclass(value) and not isinstance(value, type):
        return {f.name: _plain(getattr(value, f.name)) for f in dataclasses.fields(value) if f.name != "origins"}
    if callable(value):
        return content_key(value)
    if isinstance(value, Mapping):
        return {str(key): _plain(item) for key, item in value.items()}
    if isinstance(value, tuple | list):
        return [_plain(item) for item in value]
    return f"{value:.12e}" if isinstance(value, float) else value
