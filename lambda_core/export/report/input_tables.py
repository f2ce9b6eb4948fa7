"""Make the tables of a report's inputs."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING

from lambda_core.domain.unit_systems import SI, UnitSystem
from lambda_core.domain.units import show
from lambda_core.export.report.key_tables import Table, written
from lambda_core.model.checks.placed_values import placed_values

if TYPE_CHECKING:
    from lambda_core.model.bearing_model import ResolvedValue

# Sections of a case whose entries are parts: materials.inner, forces.ball_inner ...
_IN_PARTS = ("materials", "forces", "bodies")


def given_values(bearings: Mapping[str, Sequence[ResolvedValue]], units: UnitSystem = SI) -> Table:
    """Return the values of case and bearings.

    Parameters of laws are left out.

    Parameters
    ----------
    bearings : mapping of str to sequence of ResolvedValue
        By name; one without a machine has the name "".
    """
    shown = {
        name: [one for one in values if one.status == "given" or one.path.startswith(("bearing.", "lubricant."))]
        for name, values in bearings.items()
    }
    rows = tuple((value.path, units.sentence(_shown(value)), value.source) for value in placed_values(shown))
    return Table("", ("", "value", "source"), rows)


def value_tables(bearings: Mapping[str, Sequence[ResolvedValue]], units: UnitSystem = SI) -> tuple[Table, ...]:
    """Return the resolved values with their sources.

    Each section of the case has a table, and so has each bearing of a machine for what is its own.

    What parts of a section share (the material of rings and balls, the laws of both raceways) stands there once.
    """
    sections: dict[tuple[str, bool], dict[tuple[str, ...], list[str]]] = {}
    for value in placed_values(bearings):
        place, name = _section(value.path)
        part = ""
        if place[1]:
            part, _, name = name.partition(".")
        shown = units.sentence(_shown(value))
        row = (name or place[0].removesuffix("s"), shown, value.status, value.source, value.grade)
        sections.setdefault(place, {}).setdefault(row, []).append(part.replace("_", " "))
    head = ("", "value", "status", "source", "grade")
    return tuple(
        Table(
            section, ("", "of", *head[1:]), tuple((row[0], ", ".join(parts), *row[1:]) for row, parts in rows.items())
        )
        if is_in_parts
        else Table(section, head, tuple(rows))
        for (section, is_in_parts), rows in sections.items()
    )


def _section(path: str) -> tuple[tuple[str, bool], str]:
    """Return the section of a value and its place there.

    The section has a name, ``bearings.left.forces`` for one bearing of a machine, and entries that are parts or not.
    """
    section, _, name = path.partition(".")
    bearing = ""
    if section == "bearings":
        bearing, _, name = name.partition(".")
        first, _, rest = name.partition(".")
        section, name = (first, rest) if first in _IN_PARTS else ("", name)
    return (".".join(filter(None, ("bearings" if bearing else "", bearing, section))), section in _IN_PARTS), name


def _shown(value: ResolvedValue) -> str:
    if value.quantity and isinstance(value.value, float):
        return show(value.value, value.quantity, 6)
    return written(value.value)


def law_table(bearings: Mapping[str, Sequence[Mapping[str, str]]]) -> Table:
    """Return every law with its elements and parameters.

    The force elements are those that use the law, with the bearing where only some bearings of a machine do.
    """
    found: dict[tuple[str, str, str, str], dict[str, list[str]]] = {}
    for bearing, laws in bearings.items():
        for row in laws:
            users = found.setdefault((row["role"], row["model"], row["parameters"], row["distribution"]), {})
            users.setdefault(row["element"], []).append(bearing)
    rows = []
    for (role, name, parameters, distribution), users in found.items():
        values = ", ".join(f"{key} {written(value)}" for key, value in json.loads(parameters).items())
        shown = [
            element.replace("_", " ") + (f" ({', '.join(names)})" if len(names) < len(bearings) else "")
            for element, names in users.items()
        ]
        rows.append((role, name, ", ".join(shown), values, distribution))
    return Table("laws", ("role", "law", "force elements", "parameters (SI)", "package"), tuple(rows))
