"""Resolve the case of a roller bearing in motion.

Rings, cage, loads and settings are those of a bearing with as many elements of the same size; the rollers bring lines
for contacts with raceways, points for those of their ends with ribs, their own laws and inertias.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping
from dataclasses import replace
from typing import TYPE_CHECKING

from lambda_core.case.case import Case
from lambda_core.case.elastic import Elastic
from lambda_core.case.modelling import ForceElement
from lambda_core.case.parts import InlineGeometry
from lambda_core.catalogue.protocol import Catalogue
from lambda_core.catalogue.roller_designation import roller_designation
from lambda_core.domain.elements import NEIGHBOURS, RIBS, TILTS
from lambda_core.domain.errors import CaseError
from lambda_core.domain.roles import DEFAULT_LINE_MODELS, DEFAULT_ROLLER_MODELS, DEFAULT_SHAPE_MODELS
from lambda_core.domain.units import show
from lambda_core.elements.roller.roller_bearing import RollerBearing
from lambda_core.elements.roller.roller_friction import RIB_ASPERITIES, SKF_CONSTANTS, skf_kind
from lambda_core.elements.roller.roller_thrust import thrust_problem
from lambda_core.model.bearing_model import BearingModel, ChosenLaw, ResolvedValue
from lambda_core.model.bodies.resolve_elastic import bent_rings, waves_of_rings
from lambda_core.model.checks.fitted_paths import fit_problems, known_numbers
from lambda_core.model.geometry.resolve_geometry import is_of_grooves
from lambda_core.model.laws.law_defaults import law_sentences, record_law
from lambda_core.model.laws.roller_laws import law_of_rollers, written_parameters
from lambda_core.model.laws.time_functions import initial, time_function
from lambda_core.model.ledger import Ledger
from lambda_core.model.roller_case import roller_geometry, roller_model, roller_title
from lambda_core.model.roller_loads import STRAIGHT, held_directions

if TYPE_CHECKING:
    from lambda_core.laws.law import Law

_ELEMENTS = ("ball_inner", "ball_outer")
# What the balls that stand for rollers say: sizes and clearance of the rollers have their own sources.
_SIZES = ("bore_diameter", "outside_diameter", "width", "ball_count", "ball_diameter", "pitch_diameter", "clearance")
_OF_BALLS = {f"bearing.{name}" for name in _SIZES}
_SIDES = {1: "+x", -1: "-x"}
NEIGHBOUR, _NEIGHBOURS = next(iter(NEIGHBOURS)), "roller-roller"
# Force elements whose laws are those of lines or know the shape of rollers, and these roles.
_LINES = dict.fromkeys(_ELEMENTS, tuple(DEFAULT_LINE_MODELS))
_NEIGHBOUR_ROLES = ("cage_contact",)
_ELEMENTS_OF_SHAPES = {"ball_cage": ("cage_contact",), "fluid_drag": ("fluid_drag",)}


def rollers_of(
    case: Case, catalogue: Catalogue, place: Callable[[str], str] = str
) -> tuple[RollerBearing, str, tuple[str, ...], tuple[ResolvedValue, ...]] | None:
    """Return the rollers of a case.

    Also return their title, assumptions, and the origins of their values. The result is None for a case with balls.

    Parameters
    ----------
    place : callable
        Where in the file stands what stands at a path of the case: of a machine, whose shaft decides about thrust.

    Raises
    ------
    CaseError
        With everything that is missing, contradictory, or not followed in motion.
    """
    bearing, ledger, found = case.bearing, Ledger(place=place), None
    if bearing.designation is not None:
        found = ledger.ask("bearing.", lambda: roller_designation(catalogue, str(bearing.designation), bearing.maker))
    if found is None and bearing.rollers is None and not ledger.problems:
        return None
    rollers = roller_geometry(case, found, catalogue, ledger)
    if place is str:
        held_directions(case, ledger)
    elif not {*TILTS} & case.bodies.inner_ring.model_fields_set:
        ledger.assume(STRAIGHT)
    if rollers is not None:
        if place is str:
            _refuse_thrust(case, rollers, ledger)
        _check_complement(case, rollers, ledger)
        rollers = bent_rings(rollers, case, catalogue, ledger)
    rings = {f"rib_{rib.ring}" for rib in rollers.ribs} if rollers is not None else RIBS
    for name in (name for name in RIBS if name not in rings and getattr(case.forces, name) != ForceElement()):
        ledger.problem(f"forces.{name}", "this bearing has no such ribs: leave it out")
    ledger.check(case.name)
    assert rollers is not None  # else a problem says why
    if not rollers.ribs:
        ledger.assume("rollers are guided along the shaft by the pockets of their cage: no height of a rib is known")
    return rollers, roller_title(case, found, rollers), tuple(ledger.assumptions), tuple(ledger.values)


def _check_complement(case: Case, rollers: RollerBearing, ledger: Ledger) -> None:
    """Refuse cages that a kind does not have.

    Without one the message says how much room the rollers have.
    """
    if not rollers.full_complement:
        if case.models.cage_contact == _NEIGHBOURS:
            told = f'"{_NEIGHBOURS}" is the contact without a cage: it needs depth.cage = false'
            ledger.problem("models.cage_contact", told)
        return
    if case.depth.cage and "cage" in case.depth.model_fields_set:
        ledger.problem("depth.cage", f"{rollers.kind} rollers are a full complement without a cage: write false")
    ledger.assume(
        f"no cage: neighbouring rollers touch; they leave {show(rollers.room, 'length', 3)} of the pitch circle free, "
        "even gaps at the start"
    )


def _refuse_thrust(case: Case, rollers: RollerBearing, ledger: Ledger) -> None:
    """Refuse thrust that nothing carries.

    No rib takes it, or nothing presses tapered rollers together.
    """
    thrust, along = initial(time_function(case.loads.axial)), case.bodies.inner_ring.x
    if getattr(along, "mode", along) != "free":
        return
    problem = thrust_problem(rollers, thrust)
    if problem:
        ledger.problem("loads.axial", problem)


def check_roller_fit(case: Case, model: BearingModel) -> None:
    """Refuse fitted values at unknown paths.

    They are paths that neither the model in motion nor the quasi-static answer has. The error is a CaseError.
    """
    if case.fit is None:
        return
    rollers = roller_model(case)
    values = (*model.values, *(rollers.values if rollers is not None else ()))
    if found := fit_problems(case.fit, known_numbers(model.laws, values)):
        raise CaseError(case.name, found)


def as_balls(case: Case, rollers: RollerBearing) -> Case:
    """Return the case with balls for rollers.

    It has as many balls of the same diameter.

    The shaft holds the inner ring straight, and along its axis where nothing presses rollers on ribs.
    """
    sizes = {
        "bore_diameter": rollers.bore,
        "outside_diameter": rollers.outside,
        "width": rollers.width,
        "ball_count": rollers.count,
        "ball_diameter": rollers.diameter,
        "pitch_diameter": rollers.pitch_diameter,
    }
    geometry = InlineGeometry().model_copy(update=sizes)
    changes = {"designation": None, "maker": None, "rollers": None, "geometry": geometry}
    bearing = case.bearing.model_copy(update={**changes, "clearance": f"{rollers.clearance!r} m"})
    inner = case.bodies.inner_ring
    pressed = rollers.is_conical or bool(case.loads.axial)
    silent = [dof for dof in (*(() if pressed else ("x",)), *TILTS) if dof not in inner.model_fields_set]
    inner = inner.model_copy(update={dof: type(getattr(inner, dof))(mode="locked") for dof in silent})
    # Without a cage models.cage_contact is refused, as it is with balls.
    own = {*DEFAULT_LINE_MODELS, *DEFAULT_SHAPE_MODELS} - ({"cage_contact"} if rollers.full_complement else set())
    models = case.models.model_copy(update=dict.fromkeys(own))
    bodies = case.bodies.model_copy(update={"inner_ring": inner})
    parameters = {role: values for role, values in case.parameters.items() if role not in own}
    shaped = {NEIGHBOUR: _NEIGHBOUR_ROLES} if rollers.full_complement else _ELEMENTS_OF_SHAPES
    others = {element: _without(getattr(case.forces, element), roles) for element, roles in (_LINES | shaped).items()}
    forces = case.forces.model_copy(update={**{rib: ForceElement() for rib in RIBS}, **others})
    depth = case.depth.model_copy(update={"cage": not rollers.full_complement})
    changed = {"forces": forces, "bearing": bearing, "bodies": bodies, "models": models, "parameters": parameters}
    return case.model_copy(update={**changed, "depth": depth, "elastic": Elastic(cage=case.elastic.cage), "fit": None})


def _without(given: ForceElement, roles: Iterable[str]) -> ForceElement:
    """Return what a case says of other roles.

    The laws of these roles are not those of balls.
    """
    models = given.models.model_copy(update=dict.fromkeys(roles))
    return ForceElement(models=models, parameters={k: v for k, v in given.parameters.items() if k not in roles})


def with_ribs(balls: Case, case: Case) -> Case:
    """Return the case with ribs' laws at raceways.

    It is the case of :func:`as_balls`; the laws are those that a case gives to ribs.
    """
    ribs = {element: getattr(case.forces, rib) for element, rib in zip(_ELEMENTS, RIBS, strict=True)}
    return balls.model_copy(update={"forces": balls.forces.model_copy(update=ribs)})


def with_rollers(
    model: BearingModel,
    case: Case,
    rollers: RollerBearing,
    title: str,
    assumptions: tuple[str, ...],
    sizes: tuple[ResolvedValue, ...],
    points: Mapping[str, Mapping[str, ChosenLaw]],
    law: Callable[[str, str], Law],
) -> BearingModel:
    """Return the model with rollers for balls.

    They take the place of its balls.

    Parameters
    ----------
    model : BearingModel
        Of :func:`as_balls`.
    case : Case
        As it is written: its laws of line contacts take the place of the defaults.
    rollers, title, assumptions, sizes
        Of :func:`rollers_of`.
    points : mapping
        Laws of the points at ribs, by element and role.
    law : callable
        Returns a law from role and name.

    Raises
    ------
    CaseError
        For a law of point contacts, or parameters that a law does not have.
    """

    def chosen(element: str, role: str, default: str) -> ChosenLaw:
        own = getattr(case.forces, element)
        under = f"forces.{element}." if role in own.parameters or getattr(own.models, role) else ""
        name = getattr(own.models, role) or (None if element == NEIGHBOUR else getattr(case.models, role)) or default
        general = {} if element == NEIGHBOUR or name == "none" else case.parameters.get(role, {})
        written = {**general, **own.parameters.get(role, {})}
        ledger = Ledger(place=lambda path: under + path)
        found = law_of_rollers(law, role, name, ledger)
        values = written_parameters(found, role, written, ledger) if found is not None else None
        ledger.check(case.name)
        assert found is not None  # else a problem says why
        assert values is not None
        origins = {key: "case" if key in written else "default" for key in found.parameters.model_fields}
        return ChosenLaw(found, values, origins)

    laws = dict(model.laws)
    for ring in sorted({_ELEMENTS.index(f"ball_{rib.ring}") for rib in rollers.ribs}):
        element = tuple(RIBS)[ring]
        found = points[element]
        own = {"supply": _with_constants(found["supply"], rollers), "asperity_load": _of_ribs(found["asperity_load"])}
        laws[element] = {**found, **own}
    for element in _ELEMENTS:
        lines = {role: chosen(element, role, name) for role, name in DEFAULT_LINE_MODELS.items()}
        supply = _with_constants(laws[element]["supply"], rollers)
        laws[element] = {**laws[element], **lines, "supply": supply}
    drag = chosen("fluid_drag", "fluid_drag", DEFAULT_SHAPE_MODELS["fluid_drag"])
    laws["fluid_drag"] = {"fluid_drag": _with_constants(drag, rollers)}
    contact, name = (
        (NEIGHBOUR, _NEIGHBOURS) if rollers.full_complement else ("ball_cage", DEFAULT_SHAPE_MODELS["cage_contact"])
    )
    laws[contact] = {"cage_contact": chosen(contact, "cage_contact", name)}
    values, told = _of_laws(model, laws, case)
    if rollers.limiting_speed is not None:
        speed = ("bearing.limiting_speed", rollers.limiting_speed, "rotational_speed")
        values = (*values, ResolvedValue(*speed, "catalogue", "", "published"))
    return replace(
        model,
        laws=laws,
        geometry=replace(model.geometry, ribs=_ribs(rollers)),
        title=title,
        rollers=rollers if model.mounting is None else with_clearance(rollers, model.geometry.clearance),
        elastic={**waves_of_rings(rollers), **model.elastic},
        assumptions=tuple(dict.fromkeys((*told, *assumptions))),
        values=(*sizes, *values),
    )


def _of_laws(
    model: BearingModel, laws: Mapping[str, Mapping[str, ChosenLaw]], case: Case
) -> tuple[tuple[ResolvedValue, ...], tuple[str, ...]]:
    """Return the model's values with rollers' laws.

    Values and assumptions; grooves of balls are left out.
    """
    ledger, changed = Ledger(), set()
    for element, role in ((e, r) for e, roles in laws.items() for r in roles):
        if laws[element][role] is not model.laws.get(element, {}).get(role):
            changed |= {f"forces.{element}.{kind}.{role}" for kind in ("models", "parameters")}
            asked = getattr(case.forces, element)
            if element not in RIBS or {role} & {*asked.parameters, *asked.models.model_fields_set}:
                general = () if element in (*RIBS, NEIGHBOUR) else (case.models,)
                given = any(getattr(models, role, None) is not None for models in (asked.models, *general))
                record_law(ledger, element, role, laws[element][role], "given" if given else "default")
    for value in model.values:
        is_own = value.path not in _OF_BALLS and ".".join(value.path.split(".")[:4]) not in changed
        if is_own and not is_of_grooves(value.path):
            ledger.values.append(value)
    before, now = law_sentences(model.laws), law_sentences(laws)
    for sentence in (*model.assumptions, *now):
        if (sentence in now or sentence not in before) and not is_of_grooves(sentence):
            ledger.assume(sentence)
    return tuple(ledger.values), tuple(ledger.assumptions)


def facing(model: BearingModel, rollers: RollerBearing, side: int) -> BearingModel:
    """Return a model with thrust on one side.

    Its rollers take thrust on the shaft along x, or against x where `side` is -1.
    """
    turned = replace(rollers, faces=side)
    return replace(model, rollers=turned, geometry=replace(model.geometry, ribs=_ribs(turned)))


def _ribs(rollers: RollerBearing) -> str:
    return " ".join(f"{rib.ring}{_SIDES[rollers.faces * rib.end]}" for rib in rollers.ribs)


def with_clearance(rollers: RollerBearing, clearance: float) -> RollerBearing:
    """Return rollers with another radial clearance [m].

    The clearance of tapered rollers counts across the raceway.
    """
    return replace(rollers, clearance=clearance * math.cos(rollers.contact_angle))


def _of_ribs(law: ChosenLaw) -> ChosenLaw:
    """Return a law of asperities for ribs.

    It has the constants of ribs, where it has them and the case does not.
    """
    names = [name for name in ("B", "C") if law.origins.get(name) == "default"]
    if law.model.name != DEFAULT_ROLLER_MODELS["asperity_load"] or not names:
        return law
    values = {name: value for name, value in zip(("B", "C"), RIB_ASPERITIES, strict=True) if name in names}
    origins = {**law.origins, **dict.fromkeys(values, "Wingertszahn et al. 2023, Lubricants 11, 369: ribs")}
    return replace(law, parameters=law.parameters.model_copy(update=values), origins=origins)


def _with_constants(law: ChosenLaw, rollers: RollerBearing) -> ChosenLaw:
    """Return a law with K_L and K_Z.

    SKF's geometry constants of these rollers, where it has them.
    """
    known = dict(zip(("k_l", "k_z"), SKF_CONSTANTS[skf_kind(rollers)], strict=True))
    values = {name: value for name, value in known.items() if law.origins.get(name) == "default"}
    if not values:
        return law
    origin = "SKF, Rolling bearings (2018), Friction: constant of these rollers"
    parameters = law.parameters.model_copy(update=values)
    return replace(law, parameters=parameters, origins={**law.origins, **dict.fromkeys(values, origin)})
