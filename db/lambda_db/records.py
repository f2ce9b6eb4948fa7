"""Convert cells of a file to rows of a table.

It checks types, units and required columns, and gives a reason for every problem.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

from sqlalchemy import Column, ColumnElement, Float, Integer, Table, Text

from lambda_core.domain.errors import nearest
from lambda_core.domain.units import UNITS, from_si, parse
from lambda_db.seed_tables import SEED_TABLES
from lambda_db.units import PROPERTIES, bare_name, column_unit, to_si

Row = dict[str, Any]


def table_of(name: str) -> Table:
    """Return the SQLAlchemy table behind a seed table's name."""
    table = SEED_TABLES[name].__table__
    assert isinstance(table, Table)
    return table


def columns_of(name: str) -> list[str]:
    """Return the columns of a file in order.

    The layer is left out, because the catalogue decides it.
    """
    return [column.name for column in table_of(name).columns if column.name != "layer"]


def key_columns(name: str) -> list[str]:
    """Return the columns of the natural key."""
    return [column.name for column in table_of(name).primary_key.columns]


def same_key(name: str, row: Mapping[str, Any]) -> list[ColumnElement[bool]]:
    """Return the conditions for the same key.

    Texts ignore case.
    """
    key = table_of(name).primary_key.columns
    return [
        (column.collate("NOCASE") if isinstance(column.type, Text) else column) == row[column.name] for column in key
    ]


def describe(name: str, row: Mapping[str, Any]) -> str:
    """Name a row for people: its table and key."""
    return f"{name} {' '.join(str(row.get(column) or '?') for column in key_columns(name))}"


def _number(column: Column[Any], cell: object) -> float:
    """Read a cell as the column's number.

    The cell is a bare number, or a unit string of the column's quantity.
    """
    unit = column_unit(column.name)
    if isinstance(cell, bool) or not isinstance(cell, int | float | str):
        raise ValueError(f"{cell!r} is not a number")
    text = str(cell).strip()
    try:
        value = float(text)
    except ValueError:
        if unit is None:
            raise ValueError(f'"{text}" is not a number') from None
        quantity, name = unit
        si = parse(text, quantity)  # names the allowed units, refuses a decimal comma
        written = text.rsplit(maxsplit=1)[-1] == name
        value = float(text.split()[0]) if written and len(text.split()) == 2 else from_si(si, quantity, name)
    if not math.isfinite(value):
        raise ValueError(f'"{text}" is not a finite number')
    return value


def _cell(column: Column[Any], cell: object) -> Any:
    if cell is None or str(cell).strip() == "":
        if column.nullable:
            return None
        default = getattr(column.server_default, "arg", None)
        if default is None:
            raise ValueError("a value is required")
        return str(default)
    if isinstance(column.type, Integer):
        value = _number(column, cell)
        if value != int(value):
            raise ValueError(f"{cell} is not a whole number")
        return int(value)
    if isinstance(column.type, Float):
        return _number(column, cell)
    return str(cell).strip()


def parse_row(name: str, cells: Mapping[str, object]) -> tuple[Row, list[str]]:
    """Turn cells into a row of table `name`.

    Returns
    -------
    row : dict
        Typed values of every column but the layer.
    problems : list of str
        Why the row cannot be taken; empty if it can, as far as one cell at a time tells.
    """
    table = table_of(name)
    row: Row = {}
    cells, problems = _by_column(name, cells)
    for column in table.columns:
        if column.name == "layer":
            continue
        try:
            row[column.name] = _cell(column, cells.get(column.name))
        except ValueError as error:
            problems.append(f"{column.name}: {error}")
    if not problems:
        problems += _unit_problems(name, row)
    return row, problems


def parse_key(name: str, cells: Mapping[str, object]) -> tuple[Row, list[str]]:
    """Parse the key of table `name`, or its part.

    The second value reports an error.
    """
    table, keys = table_of(name), key_columns(name)
    found, problems = _by_column(name, cells)
    row: Row = {}
    for column, cell in found.items():
        if column not in keys:
            problems.append(f"{column} is not of the key of {name}: {', '.join(keys)}")
            continue
        try:
            row[column] = _cell(table.c[column], cell)
        except ValueError as error:
            problems.append(f"{column}: {error}")
    if not row and not problems:
        problems.append(f"name the {name}: {'=... '.join(keys)}=...")
    return row, problems


def _by_column(name: str, cells: Mapping[str, object]) -> tuple[dict[str, object], list[str]]:
    """Match keys to columns.

    ``bore_diameter = "40 mm"`` means ``bore_diameter_mm = 40.0``.
    """
    known = columns_of(name)
    short = {bare_name(column): column for column in known if column_unit(column)}
    found: dict[str, object] = {}
    problems: list[str] = []
    for key, cell in cells.items():
        column = key if key in known else short.get(key)
        if column is None:
            close = nearest(str(key), [*known, *short])
            hint = f"; nearest: {', '.join(close)}" if close else f"; known: {', '.join(known)}"
            problems.append(f'"{key}" is not a column of {name}{hint}')
        elif column in found:
            problems.append(f"{column} is given twice")
            continue
        elif column != key and not isinstance(cell, str):
            problems.append(f'{key}: {cell} has no unit: write {column} = {cell} or {key} = "{cell} {_unit(column)}"')
        elif column != key and str(cell).strip().replace(".", "", 1).isdigit():
            problems.append(f'{key}: "{cell}" has no unit: write "{cell} {_unit(column)}"')
        if column is not None:
            found[column] = cell  # a column without its unit is not missing, too
    return found, problems


def _unit(column: str) -> str:
    unit = column_unit(column)
    return unit[1] if unit else ""


def _unit_problems(name: str, row: Row) -> list[str]:
    """Check the unit of a property or parameter.

    For lubricants it compares the unit with the meaning of the name.
    """
    if name not in ("lubricant_property", "lubricant_parameter"):
        return []
    quantity = PROPERTIES.get(row["name"]) if name == "lubricant_property" else None
    if name == "lubricant_parameter":
        # laws name their own constants; those that a property shares keep the property's quantity
        quantity = "pressure_viscosity" if row["name"] == "alpha_p" else PROPERTIES.get(row["name"])
    if quantity and row["unit"] and row["unit"] not in UNITS[quantity]:
        return [f'{row["name"]}: "{row["unit"]}" is not a unit of {quantity}; allowed: {", ".join(UNITS[quantity])}']
    try:
        to_si(row["value"], row["unit"], quantity)
    except ValueError as error:
        return [f"{row['name']}: {error}"]
    return []
