"""Suppress errors that only follow from other errors."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import Any

from lambda_core.case.machine import STAND_IN
from lambda_core.case.salvage import related
from lambda_core.domain.errors import Problem

_REFERENCES = ("at", "outer", "to", "body")  # options of parts that name a marker or a body
_REFERRED = ("markers", "bodies", "bearings")


def is_shape_known(found: Iterable[Problem]) -> bool:
    """Tell whether the shaft's pieces are known.

    They are those of the file, not a stand-in for them.
    """
    return not any(related(problem.where, f"shaft.{name}") for problem in found for name in ("sections", "reduced"))


def independent(found: Sequence[Problem], later: Iterable[Problem], tables: Mapping[str, Any]) -> list[Problem]:
    """Return the independent problems of a later stage.

    They do not follow from those that were found before.

    A later stage sees the case without what was wrong. What it says of that, of a stand-in, or of parts that refer to
    something wrong is no mistake of their own.

    Parameters
    ----------
    found : sequence of Problem
        Of the tables and of single bearings.
    later : iterable of Problem
        Of the machine.
    tables : mapping
        As they stand in the file.
    """
    wrong = _wrong_names(found, tables)
    return [
        problem
        for problem in later
        if not any(related(problem.where, known.where) for known in found)
        and problem.where.split(".")[:2] != ["bearings", STAND_IN]
        and not _references(tables, problem.where.split(".")) & wrong
    ]


def _wrong_names(found: Sequence[Problem], tables: Mapping[str, Any]) -> set[str]:
    """Return the names with something wrong.

    They are names of markers, bodies and bearings, and of markers on such bodies.
    """
    places = [problem.where.split(".") for problem in found]
    wrong = {place[1] for place in places if place[0] in _REFERRED and len(place) > 1}
    for table in _REFERRED:
        if [table] in places:  # all of it
            parts = tables.get(table)
            wrong |= set(parts) if isinstance(parts, Mapping) else set()
    markers = tables.get("markers")
    names = list(markers) if isinstance(markers, Mapping) else []
    return wrong | {name for name in names if _references(tables, ["markers", name]) & wrong}


def _references(tables: Mapping[str, Any], place: Sequence[str]) -> set[str]:
    """Return the names that a part refers to.

    The part is at a place.
    """
    part: Any = tables
    for key in place[:2]:
        part = part.get(key) if isinstance(part, Mapping) else None
    return {str(part[key]) for key in _REFERENCES if key in part} if isinstance(part, Mapping) else set()
