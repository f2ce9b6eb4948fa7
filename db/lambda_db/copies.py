"""Make user rows as copies of other rows.

Changed values get the new source, the others keep theirs.
"""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from lambda_core.domain.errors import CatalogueError, Problem
from lambda_db.catalogue import SqlCatalogue
from lambda_db.records import columns_of
from lambda_db.rows import BEARING_GROUPS
from lambda_db.seed_files import Record
from lambda_db.transfer import ImportReport, import_rows, rows_of

_PLACE = Path("copy")


def copy_bearing(
    catalogue: SqlCatalogue,
    original: tuple[str, str],
    changes: Mapping[str, object],
    *,
    source: str,
    grade: str,
) -> ImportReport:
    """Write a changed bearing into the user's database.

    Parameters
    ----------
    original : (designation, maker)
    changes : mapping
        Column, with or without its unit (``ball_diameter`` or ``ball_diameter_mm``), to value; None empties it.
    source, grade : str
        Where the changed values come from, and how good they are.

    Raises
    ------
    CatalogueError
        When the original is not there, or the new row is impossible.
    """
    cells = _row(catalogue, "bearing", {"designation": original[0], "maker": original[1]})
    for name, value in changes.items():
        column = next((c for c in cells if c == name or (c.startswith(f"{name}_") and _is_value(c))), name)
        if cells.get(column) == value:
            continue
        cells[column] = value
        group = next((g for g, columns in BEARING_GROUPS.items() if column in columns), None)
        if group is not None:
            cells |= {f"{group}_source": source, f"{group}_grade": grade}
            if f"{group}_status" in cells:
                cells[f"{group}_status"] = "published"
    return import_rows(catalogue, [(_PLACE, "", "bearing", cells)], replace=True)


def copy_lubricant(
    catalogue: SqlCatalogue,
    original: str,
    name: str,
    properties: Mapping[str, object],
    parameters: Mapping[tuple[str, str, str], object],
    *,
    source: str,
    grade: str,
    note: str = "",
) -> ImportReport:
    """Write a changed lubricant into the user's database.

    Parameters
    ----------
    properties : mapping
        Name of a property to its number, in the unit that the original has.
    parameters : mapping
        (role, model, name) to the number, in the unit that the original has.
    """
    head = _row(catalogue, "lubricant", {"name": original}) | {"name": name, "note": note}
    records: list[Record] = [(_PLACE, "", "lubricant", head)]
    for table, keys, changed in (
        ("lubricant_property", ("name",), {(key,): value for key, value in properties.items()}),
        ("lubricant_parameter", ("role", "model", "name"), dict(parameters)),
    ):
        for row in rows_of(catalogue, table):
            if row["lubricant"] != original:
                continue
            cells: dict[str, Any] = {k: v for k, v in row.items() if k != "layer"} | {"lubricant": name}
            key = tuple(row[k] for k in keys)
            if key in changed and changed[key] != row["value"]:
                cells |= {"value": changed[key], "source": source, "grade": grade}
                if "status" in cells:
                    cells["status"] = "published"
            records.append((_PLACE, "", table, cells))
    return import_rows(catalogue, records, replace=True)


def _row(catalogue: SqlCatalogue, table: str, key: Mapping[str, str]) -> dict[str, Any]:
    for row in rows_of(catalogue, table):
        if all(str(row[column]).casefold() == value.casefold() for column, value in key.items()):
            return {column: cell for column, cell in row.items() if column != "layer"}
    raise CatalogueError("catalogue", [Problem(table, f"{' '.join(key.values())} is not in the catalogue")])


def _is_value(column: str) -> bool:
    return column in columns_of("bearing") and not column.endswith(("_source", "_grade", "_status"))
