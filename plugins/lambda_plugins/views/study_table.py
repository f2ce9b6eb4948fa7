"""Select axes, responses and groups from a study table."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from pydantic import Field as Declared

from lambda_core.plugins import (
    Axis,
    Column,
    NotApplicable,
    Options,
    StudyTable,
)

BREAKDOWN = "friction_breakdown_Nmm."


STEADINESS = "cage_speed_deviation"  # the response that the stability map judges unless told otherwise


class Which(Options):
    """Response to show."""

    response: str = Declared("", description="name of a response; empty: every one")


class Along(Options):
    """Along which parameter a view goes."""

    x: str = Declared("", description="parameter of the first axis; empty: the first numeric one, else the first")


class Curves(Along, Which):
    """Curves to show."""


class Surface(Curves):
    """Surfaces to show."""

    y: str = Declared("", description="parameter of the second axis; empty: the next numeric one")


class Threshold(Surface):
    """Measure and limit of the stability map."""

    response: str = Declared(STEADINESS, description="name of the response that is judged")
    limit: float = Declared(0.2, description="largest value that counts as stable")


def source_line(table: StudyTable) -> str:
    """Return the line below the title.

    The study, its kind and the number of its points.
    """
    done = sum(state in ("done", "partial") for state in table.states)
    return f"{table.title}   {table.mode}, {table.design}, {done} of {len(table)} points"


def positions(column: Column) -> NDArray[np.float64]:
    """Return the positions of a column's values.

    Each text has its own position on the axis.
    """
    if column.numeric:
        return column.numbers()
    places = {text: float(place) for place, text in enumerate(_texts(column))}
    return np.array([places[str(value)] for value in column.values])


def _texts(column: Column) -> tuple[str, ...]:
    return tuple(dict.fromkeys(map(str, column.values)))


def axis_of(column: Column) -> Axis:
    """Return the axis of a column.

    Values that rise by factors get a logarithmic scale.
    """
    if not column.numeric:
        return Axis(column.label, column.unit, categories=_texts(column))
    values = column.numbers()
    values = np.unique(values[np.isfinite(values)])
    log = values.size > 3 and values[0] > 0.0 and np.ptp(np.diff(np.log(values))) < 0.1 * np.diff(np.log(values)).mean()
    return Axis(column.label, column.unit, log=bool(log))


def varied(table: StudyTable) -> list[Column]:
    """Return the parameters that take more than one value."""
    return [column for column in table.parameters if len(set(column.values)) > 1]


def numeric_parameters(table: StudyTable) -> list[Column]:
    """Return the numeric parameters that take more than one value."""
    return [column for column in varied(table) if column.numeric]


def responses(table: StudyTable, name: str) -> list[Column]:
    """Return one response or all that can be shown."""
    if name:
        return [table.response(name)]
    found = [
        c for c in table.responses if c.numeric and not c.name.startswith(BREAKDOWN) and np.isfinite(c.numbers()).any()
    ]
    if not found:
        raise NotApplicable("no point of this study has a result yet")
    return found


def rows_by_label(table: StudyTable, x: Column) -> dict[str, list[int]]:
    """Return rows that share all parameters but `x`.

    They are sorted by a label of these parameters.
    """
    others = [column for column in varied(table) if column.name != x.name]
    found: dict[str, list[int]] = {}
    for row in range(len(table)):
        label = ", ".join(cell(column, row) for column in others)
        found.setdefault(label, []).append(row)
    return found


def cell(column: Column, row: int) -> str:
    """Return one value of a column for a label."""
    value = column.values[row]
    if isinstance(value, str) or value is None:
        return str(value)
    return f"{column.label} {value:.4g} {column.unit}".strip()
