"""Remove rows from the user's own database.

Built-in rows and those of plugins stay.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path

from sqlalchemy import ColumnElement, Connection, delete, func, select

from lambda_core.domain.errors import CatalogueError, Problem, UsageError, unknown_name
from lambda_db.catalogue import SqlCatalogue
from lambda_db.models import Base
from lambda_db.paths import user_database
from lambda_db.records import Row, describe, key_columns, parse_key, same_key, table_of
from lambda_db.seed_tables import CHILDREN, SEED_TABLES
from lambda_db.user import changing


@dataclass
class RemovalReport:
    """Report of a removal.

    Rows per table, and whether another row of the same key shows again.
    """

    path: Path
    row: str  # table and key, for people
    removed: dict[str, int] = field(default_factory=dict)
    uncovered: bool = False  # a built-in row or a plugin's of the same key is in use again


def remove_row(catalogue: SqlCatalogue, table: str, cells: Mapping[str, object]) -> RemovalReport:
    """Remove one row of the user and dependent rows.

    Dependent rows are candidates of a bearing and constants of an oil.

    Parameters
    ----------
    catalogue : SqlCatalogue
        Shows the catalogue without the row afterwards.
    table : str
        Seed table.
    cells : mapping
        Its key, or a part of it that only one own row has: ``{"designation": "6208", "maker": "FAG"}``.

    Raises
    ------
    UsageError
        For an unknown table, or a column that is not of its key.
    CatalogueError
        When no own row, or several, match; when the row is built in; when other own rows need it; or when the
        database cannot be written.
    """
    if table not in SEED_TABLES:
        raise UsageError(unknown_name("catalogue table", table, SEED_TABLES))
    key, problems = parse_key(table, cells)
    if problems:
        raise UsageError("; ".join(problems))
    path = user_database()
    if not path.exists():
        raise _refused(_why_none(catalogue, table, key))
    with changing(path) as connection:
        report = _remove(connection, catalogue, table, key, path)
    catalogue.refresh()
    return report


def _refused(message: str) -> CatalogueError:
    return CatalogueError("remove", [Problem("", message)])


def _remove(connection: Connection, catalogue: SqlCatalogue, table: str, key: Row, path: Path) -> RemovalReport:
    target = table_of(table)
    own = [dict(row) for row in connection.execute(select(target).where(*_match(table, key))).mappings()]
    if not own:
        raise _refused(_why_none(catalogue, table, key))
    if len(own) > 1:
        named = "; ".join(describe(table, row) for row in own)
        raise _refused(f"{len(own)} of your rows match ({named}): give {', '.join(key_columns(table))}")
    (row,) = own
    report = RemovalReport(path, describe(table, row), uncovered=_is_built_in(catalogue, table, row))
    if table == "material" and not report.uncovered:
        _check_cages(connection, row["name"])
    report.removed[table] = connection.execute(delete(target).where(*same_key(table, row))).rowcount
    for child, (parent, link, _) in CHILDREN.items():
        if parent == table:
            columns = Base.metadata.tables[child].c
            same = (columns[theirs].collate("NOCASE") == row[ours] for ours, theirs in link.items())
            count = connection.execute(delete(Base.metadata.tables[child]).where(*same)).rowcount
            if count:
                report.removed[child] = count
    return report


def _match(table: str, key: Row) -> list[ColumnElement[bool]]:
    columns = table_of(table).c
    return [
        columns[name].collate("NOCASE") == value if isinstance(value, str) else columns[name] == value
        for name, value in key.items()
    ]


def _is_built_in(catalogue: SqlCatalogue, table: str, key: Row) -> bool:
    """Tell whether built-in or plugin rows have this key."""
    target = table_of(table).to_metadata(Base.metadata.__class__(), schema="main")
    names = [name for name in key_columns(table) if name in key]
    same = [
        target.c[name].collate("NOCASE") == key[name] if isinstance(key[name], str) else target.c[name] == key[name]
        for name in names
    ]
    return bool(catalogue.connection.execute(select(func.count()).select_from(target).where(*same)).scalar_one())


def _why_none(catalogue: SqlCatalogue, table: str, key: Row) -> str:
    named = f"{table} {' '.join(str(value) for value in key.values())}"
    if _is_built_in(catalogue, table, key):
        return (
            f"{named} is built in, or a plugin's, and cannot be removed; "
            "a row of your own with the same key takes its place (db add)"
        )
    return f"you have no row {named}; your rows: lambda-bearing db export mine.toml --mine"


def _check_cages(connection: Connection, material: str) -> None:
    cage = table_of("cage")
    cages = list(connection.scalars(select(cage.c.name).where(cage.c.material.collate("NOCASE") == material)))
    if cages:
        raise _refused(f"your cage {', '.join(cages)} is made of {material}: remove or change it first")
