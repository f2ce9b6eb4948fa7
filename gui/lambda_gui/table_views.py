"""Define tables of results and of study points."""

from __future__ import annotations

import textwrap
from typing import TYPE_CHECKING

from rich.table import Table
from rich.text import Text

from lambda_core.domain.number_text import NONE, number
from lambda_core.domain.unit_systems import SI, UnitSystem

if TYPE_CHECKING:
    from rich.console import RenderableType

    from lambda_core.api import SideBySide, StudyStatus
    from lambda_core.views.table import StudyTable

_POINTS = 200  # of a study that are listed
_NUMBER, _STATE, _NAME, _HEAD = 11, 9, 11, 30  # columns of a number, of a state, of names, of what stands before
_LARGE = 1e4  # numbers above are rounded to three digits


def differences_view(found: SideBySide, width: int, units: UnitSystem = SI) -> list[RenderableType]:
    """Return the differences of several results.

    They cover their cases and their key numbers, with a column for each.

    Parameters
    ----------
    width : int
        Columns that there are.
    """
    inputs = _side_by_side("what differs", found.names, width)
    for row in found.inputs:
        inputs.add_row(
            Text(row.option), *(Text(NONE if value is None else units.sentence(value)) for value in row.values)
        )
    if not found.inputs:
        inputs.add_row("nothing: the same inputs", *[""] * len(found.names))
    numbers = _side_by_side("numbers", found.names, width)
    for entry in found.numbers:
        if any(value is not None for value in entry.values):
            name = f"{entry.name} [{units.unit(entry.unit)}]" if entry.unit else entry.name
            numbers.add_row(
                Text(name), *(NONE if v is None else _short(units.value(v, entry.unit)) for v in entry.values)
            )
    return [inputs, Text(), numbers]


def _side_by_side(head: str, names: list[str], width: int) -> Table:
    """Return a table of results.

    A column for each result, as wide as its name where there is room.
    """
    room = max(_NAME, (width - _HEAD) // len(names) - 1)
    table = Table(box=None, pad_edge=False, header_style="bold", padding=(0, 1, 0, 0))
    wide = [min(room, max(_NAME, len(name))) for name in names]
    table.add_column(head, width=max(_NAME, min(_HEAD + 10, width - sum(wide) - len(wide) - 1)), overflow="fold")
    for name, columns in zip(names, wide, strict=True):
        words = textwrap.wrap(name, columns) or [name]  # rich would cut a name anywhere
        table.add_column(Text("\n".join(words)), width=columns, justify="right", overflow="fold")
    return table


def study_view(status: StudyStatus, points: StudyTable, width: int, units: UnitSystem = SI) -> list[RenderableType]:
    """Return a study's state and first points.

    Numbers for which there is no room are named.

    Parameters
    ----------
    width : int
        Columns that there are.
    """
    columns = [*points.parameters, *(c for c in points.responses if not c.is_part)]
    shown = columns[: max(2, (width - _STATE) // _NUMBER)]
    table = Table(box=None, pad_edge=False, header_style="bold", padding=(0, 1, 0, 0))
    for column in shown:
        name = column.label.rpartition("/")[0].replace("/", " ") or column.label
        table.add_column(
            Text(f"{name} {units.unit(column.unit)}".strip()), justify="right", width=_NUMBER - 1, overflow="fold"
        )
    table.add_column("state", width=_STATE - 1)
    rows = points.rows()
    for row in rows[:_POINTS]:
        table.add_row(*(Text(_cell(row[column.name], column.unit, units)) for column in shown), row["state"])
    left = [column.name for column in columns[len(shown) :]]
    notes = [f"{len(rows) - _POINTS} points more"] if len(rows) > _POINTS else []
    notes += [f"also asked: {', '.join(left)}"] if left else []
    return [Text(status.text(), style="dim"), Text(), table, Text("\n".join(notes), style="dim")]


def _cell(value: float | str | None, unit: str, units: UnitSystem) -> str:
    if value is None:
        return NONE
    return units.sentence(value) if isinstance(value, str) else _short(units.value(value, unit))


def _short(value: float) -> str:
    return f"{value:.4g}" if abs(value) < _LARGE else number(float(f"{value:.3g}"), 0)
