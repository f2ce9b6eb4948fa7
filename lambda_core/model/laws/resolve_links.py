"""Resolve force elements between bodies."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, TypeVar

from lambda_core.domain.elements import BODIES, BodyName
from lambda_core.domain.errors import unknown_name
from lambda_core.model.bearing_model import ELEMENT_PREFIX, ChosenLaw, Link, Marker
from lambda_core.model.laws.given_parameters import law_by_name
from lambda_core.model.ledger import Ledger

if TYPE_CHECKING:
    from lambda_core.case.case import Case
    from lambda_core.case.machine_parts import Connection
    from lambda_core.case.motion import BetweenBodies
    from lambda_core.model.laws.resolve_laws import ModelSource

ROLE = "force_element"
GROUND = "ground"
_CENTRE = (0.0, 0.0, 0.0)
_BODIES: dict[str, BodyName] = {**{name: name for name in BODIES}, "shaft": "inner_ring"}  # that carry markers
ByLaw = TypeVar("ByLaw", "BetweenBodies", "Connection")
Ends = TypeVar("Ends")
End = tuple[BodyName | None, tuple[float, float, float]]


def resolve_links(
    case: Case, registry: ModelSource, ledger: Ledger
) -> tuple[dict[str, Link], dict[str, dict[str, ChosenLaw]]]:
    """Return the force elements and their laws.

    The keys are their names in the model. They are complete unless there are problems.
    """

    def ends(where: str, element: BetweenBodies) -> Link | None:
        first, second = (
            _end(case, element.first, f"{where}.first", ledger),
            _end(case, element.second, f"{where}.second", ledger),
        )
        if first is None or second is None:
            return None
        if second[0] is None:
            ledger.problem(f"{where}.second", "the ground cannot move: write it as `first`, the body as `second`")
            return None
        if first[0] == second[0]:
            ledger.problem(f"{where}.second", f"both ends are on one body, {second[0]}")
        return Link(first[0], first[1], second[0], second[1])

    return by_laws("elements", case.elements, ends, registry, ledger)


def by_laws(
    table: str,
    elements: Mapping[str, ByLaw],
    ends: Callable[[str, ByLaw], Ends | None],
    registry: ModelSource,
    ledger: Ledger,
) -> tuple[dict[str, Ends], dict[str, dict[str, ChosenLaw]]]:
    """Return the ends of force elements, and their laws.

    Those without ends or a law are left out; the ledger takes why.

    Parameters
    ----------
    table : str
        Table of the case that has the elements by name.
    ends : callable
        Returns the ends of an element at a path of the case.
    """
    found: dict[str, Ends] = {}
    laws: dict[str, dict[str, ChosenLaw]] = {}
    for name, element in elements.items():
        where = f"{table}.{name}"
        own = ends(where, element)
        law = law_by_name(ROLE, element.law, element.parameters, where, registry, ledger)
        if own is not None and law is not None:
            found[name] = own
            laws[f"{ELEMENT_PREFIX}{name}"] = {ROLE: law}
    return found, laws


def resolve_markers(case: Case, ledger: Ledger) -> dict[str, Marker]:
    """Return the named points of a bearing.

    Problems are noted.
    """
    found = {}
    for name, marker in case.markers.items():
        body = _BODIES.get(marker.body)
        if body is None:
            ledger.problem(f"markers.{name}.body", unknown_name("body", marker.body, _BODIES))
            continue
        for axis in ("about_x", "about_y", "about_z"):
            if getattr(marker, axis):
                ledger.problem(f"markers.{name}.{axis}", "has no effect in the case of one bearing: leave it out")
        found[name] = Marker(body, marker.point)
    return found


def _end(case: Case, name: str, where: str, ledger: Ledger) -> End | None:
    """Return the body and place of a name.

    The result is None after a problem, which the ledger takes.
    """
    if name in case.markers and name in (GROUND, *BODIES):
        ledger.problem(where, f'"{name}" is a marker and also a reserved name: rename the marker')
        return None
    if name == GROUND:
        return None, _CENTRE
    place = _CENTRE
    body = next((each for each in BODIES if each == name), None)
    if body is None and name in case.markers:
        marker = case.markers[name]
        if marker.body not in _BODIES:
            return None  # the marker's own problem says so
        body, place = _BODIES[marker.body], marker.point
    if body is None:
        ledger.problem(where, unknown_name("body or marker", name, [GROUND, *BODIES, *case.markers]))
        return None
    if body == "cage" and not case.depth.cage:
        ledger.problem(where, "there is no cage: depth.cage is false")
        return None
    return body, place
