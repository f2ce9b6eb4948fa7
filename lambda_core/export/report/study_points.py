"""Tabulate the points of a study with their model bands."""

from __future__ import annotations

import re
from typing import Any

from lambda_core.domain.number_text import hours_alone
from lambda_core.domain.unit_systems import SI, UnitSystem
from lambda_core.export.report.key_tables import Table, rounded, written
from lambda_core.views.table import Column, StudyTable

_ROWS = 1000  # of the table
_BAND = "90 % model band"
_GROUPS = re.compile(r"(?<=\d) (?=\d)")  # between digits of one number, which a narrow column must not break


def study_points(table: StudyTable, units: UnitSystem = SI) -> Table:
    """Return parameters, results and bands, point by point."""
    columns = [*table.parameters, *(c for c in table.responses if not c.is_part)]
    head = [text for c in columns for text in (_head(c, units), *((_BAND,) if c.band else ()))]
    rows = []
    for index, row in enumerate(table.rows()[:_ROWS]):
        cells = [text for c in columns for text in _cells(c, index, row[c.name], units)]
        rows.append((str(row["point"]), *cells, f"{row['state']}: {row['reason']}" if row["reason"] else row["state"]))
    left = f" (the first {_ROWS} of {len(table)})" if len(table) > _ROWS else ""
    return Table(f"points{left}", ("point", *head, "state"), tuple(rows))


def study_bands(found: Any) -> tuple[Table, ...]:
    """Return the bands of the case and their causes.

    It is empty where the study did not compute them.
    """
    if found is None:
        return ()
    return (Table("how far the model may be off", (_BAND,), tuple((text,) for text in found.shares())),)


def _head(column: Column, units: UnitSystem) -> str:
    return f"{column.label} [{units.unit(column.unit)}]" if column.unit else column.label


def _cells(column: Column, row: int, value: Any, units: UnitSystem) -> tuple[str, ...]:
    """Write a number of a point and its band.

    It writes a life as a life, and numbers without a band to four digits.
    """
    if not isinstance(value, float):
        plain = written(value)
    else:
        plain = hours_alone(value) if column.unit == "h" else rounded(units.value(value, column.unit), 4)
    if not column.band:
        return (plain,)
    return column.text(row, units) or plain, _GROUPS.sub("\u00a0", column.band_text(row, units))
