"""Import and export rows.

CSV and TOML; a round trip is exact.
"""

from __future__ import annotations

import csv
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from sqlalchemy import Connection, delete, insert, select

from lambda_core.domain.errors import CatalogueError, Problem, UsageError, unknown_name
from lambda_core.domain.files import check_target
from lambda_core.domain.printable import cell_text
from lambda_db.build import insert_row
from lambda_db.catalogue import SqlCatalogue
from lambda_db.engine import at_one_moment
from lambda_db.estimate import candidate_rows, completed
from lambda_db.models import Base
from lambda_db.paths import user_database
from lambda_db.records import Row, columns_of, describe, parse_row, same_key, table_of
from lambda_db.references import Known, known_names, reference_problems
from lambda_db.seed_files import Record, read_path
from lambda_db.seed_tables import CHILDREN, SEED_TABLES
from lambda_db.user import changing


@dataclass
class ImportReport:
    """Report of an import.

    It counts rows added and replaced per table, and lists those refused with place and reason.
    """

    path: Path
    added: dict[str, int] = field(default_factory=dict)
    replaced: dict[str, int] = field(default_factory=dict)
    refused: list[Problem] = field(default_factory=list)


class _RollBack(Exception):
    """Leaves the transaction without a row written."""


def import_rows(
    catalogue: SqlCatalogue,
    records: Iterable[Record],
    *,
    keep_good: bool = False,
    replace: bool = False,
) -> ImportReport:
    """Write rows into the user's database.

    Parameters
    ----------
    catalogue : SqlCatalogue
        Whose built-in rows the new ones may refer to; it shows the new rows afterwards.
    records : iterable
        From :func:`lambda_db.seed_files.read_path`.
    keep_good : bool
        Keep the good rows although others are refused; otherwise one bad row rolls everything back.
    replace : bool
        Let a row take the place of the user's row with the same key; otherwise that is refused.

    Raises
    ------
    CatalogueError
        With every refused row and its reason, when nothing was written; or when the database takes no rows.
    """
    path = user_database()
    report = ImportReport(path)
    try:
        with changing(path) as connection:
            _write(connection, records, known_names(catalogue.connection), report, replace)
            if report.refused and not keep_good:
                raise _RollBack
    except _RollBack:
        good = sum(report.added.values()) + sum(report.replaced.values())
        rest = [Problem("", f"nothing was written; --keep-good takes the {good} good rows")] if good else []
        raise CatalogueError("import", [*report.refused, *rest]) from None
    catalogue.refresh()
    return report


def _write(
    connection: Connection, records: Iterable[Record], known: Known, report: ImportReport, replace: bool
) -> None:
    """Check and insert record by record, parents before children."""
    parsed: dict[str, list[tuple[str, Row]]] = {name: [] for name in SEED_TABLES}
    for path, place, table, cells in records:
        where = f"{path.name} {place}".strip()
        row, reasons = parse_row(table, cells)
        report.refused += [Problem(where, reason) for reason in reasons]
        if not reasons:
            parsed[table].append((where, row))
    for table, placed in parsed.items():
        for where, row in placed:
            reasons = reference_problems(table, row, known)
            if not reasons:
                reason = _put(connection, table, row, report, replace)
                reasons = [reason] if reason else []
            if not reasons:
                known.add(table, row)
            report.refused += [Problem(where, f"{describe(table, row)}: {reason}") for reason in reasons]


def _put(connection: Connection, table: str, row: Row, report: ImportReport, replace: bool) -> str | None:
    """Insert one row, or return the reason against it.

    If asked, it precedes the user's own row of the same key.
    """
    target = table_of(table)
    if "layer" in target.c:
        row = row | {"layer": "user"}
    same = same_key(table, row)
    exists = connection.execute(select(target).where(*same)).first() is not None
    if exists and not replace:
        return "you have a row with this key already; --replace puts the new one in its place"
    savepoint = connection.begin_nested()
    if exists:
        connection.execute(delete(target).where(*same))
    reason = insert_row(connection, table, row)
    if reason is None and table == "bearing":
        reason = _put_geometry(connection, row)
    if reason is not None:
        savepoint.rollback()
        return reason
    savepoint.commit()
    counts = report.replaced if exists else report.added
    counts[table] = counts.get(table, 0) + 1
    return None


def _put_geometry(connection: Connection, row: Row) -> str | None:
    """Estimate missing geometry and write its candidates.

    The row itself has passed all checks by now.
    """
    bearing, candidate = table_of("bearing"), Base.metadata.tables["candidate"]
    link = CHILDREN["candidate"][1]
    connection.execute(delete(candidate).where(*(candidate.c[c].collate("NOCASE") == row[p] for p, c in link.items())))
    complete = completed(row)
    if complete is not row:
        connection.execute(delete(bearing).where(*same_key("bearing", row)))
        reason = insert_row(connection, "bearing", complete)
        if reason is not None:
            return f"its estimated inner geometry is impossible: {reason}"
    rows = candidate_rows(complete)
    if rows:
        connection.execute(insert(candidate), rows)
    return None


def import_path(
    catalogue: SqlCatalogue, path: Path, table: str | None = None, *, keep_good: bool = False, replace: bool = False
) -> ImportReport:
    """Import a CSV file, a TOML file or a folder.

    A CSV file is one table: its name, or `table`.
    """
    if not path.exists():
        raise UsageError(f"{path} does not exist")
    return import_rows(catalogue, read_path(path, table), keep_good=keep_good, replace=replace)


def add_row(catalogue: SqlCatalogue, table: str, cells: Mapping[str, object], *, replace: bool = False) -> ImportReport:
    """Add one row.

    ``source``, ``grade`` and ``status`` apply to every group of values that is given.
    """
    if table not in SEED_TABLES:
        raise UsageError(unknown_name("catalogue table", table, SEED_TABLES))
    return import_rows(catalogue, [(Path("row"), "", table, _with_provenance(table, cells))], replace=replace)


def _with_provenance(table: str, cells: Mapping[str, object]) -> dict[str, object]:
    from lambda_db.rows import BEARING_GROUPS
    from lambda_db.units import bare_name

    spread = dict(cells)
    if table != "bearing":
        return spread
    common = {name: spread.pop(name) for name in ("source", "grade", "status") if name in spread}
    for group, columns in BEARING_GROUPS.items():
        if any(column in spread or bare_name(column) in spread for column in columns):
            for name, value in common.items():
                if f"{group}_{name}" in columns_of("bearing"):
                    spread.setdefault(f"{group}_{name}", value)
    return spread


def rows_of(catalogue: SqlCatalogue, table: str, *, mine: bool = False) -> list[Row]:
    """Return all rows of a table by key.

    They are all visible rows, or the user's own.
    """
    if mine and not catalogue.has_user_rows:
        return []
    target = table_of(table)
    columns = ", ".join(columns_of(table))
    place = f"user.{table}" if mine else table
    order = ", ".join(column.name for column in target.primary_key.columns)
    statement = f"SELECT {columns} FROM {place} ORDER BY {order}"
    return [dict(row) for row in catalogue.connection.exec_driver_sql(statement).mappings()]


def export_rows(catalogue: SqlCatalogue, path: Path, tables: list[str], *, mine: bool = False) -> dict[str, int]:
    """Write tables to a file or folder.

    A CSV file (one table), a TOML file, or a folder of CSV files; return the number of rows.

    Raises
    ------
    UsageError
        For an unknown table, several tables into one CSV file, or a file that cannot be written.
    CatalogueError
        When the user's own rows are asked for and cannot be read.
    """
    for table in tables:
        if table not in SEED_TABLES:
            raise UsageError(unknown_name("catalogue table", table, SEED_TABLES))
    if path.suffix:
        check_target(path)
    if mine and not catalogue.has_user_rows and user_database().exists() and user_database().stat().st_size:
        raise CatalogueError(str(user_database()), [Problem("", "cannot be read: nothing is exported")])
    with at_one_moment(catalogue.connection):  # a row without the one it names could not be imported again
        content = {table: rows_of(catalogue, table, mine=mine) for table in tables}
    try:
        if path.suffix == ".toml":
            _write_toml(path, content)
        elif path.suffix == ".csv":
            if len(content) != 1:
                raise UsageError(f"{path}: a CSV file holds one table: name it with --table, or export to a folder")
            _write_csv(path, *next(iter(content.items())))
        elif path.suffix:
            raise UsageError(f"{path}: export to a .csv file, a .toml file or a folder")
        else:
            path.mkdir(parents=True, exist_ok=True)
            for table, rows in content.items():
                _write_csv(path / f"{table}.csv", table, rows)
    except OSError as error:
        raise UsageError(f"{path} cannot be written: {error.strerror}") from error
    return {table: len(rows) for table, rows in content.items()}


def _write_csv(path: Path, table: str, rows: list[Row]) -> None:
    with path.open("w", newline="", encoding="utf-8") as stream:
        writer = csv.writer(stream, lineterminator="\n")
        writer.writerow(columns_of(table))
        writer.writerows(["" if cell is None else cell_text(_text(cell)) for cell in row.values()] for row in rows)


def _text(cell: Any) -> str:
    return repr(cell) if isinstance(cell, float) else str(cell)  # repr of a float reads back as the same float


def _write_toml(path: Path, content: dict[str, list[Row]]) -> None:
    import tomlkit

    document = {
        table: [{name: cell for name, cell in row.items() if cell is not None} for row in rows]
        for table, rows in content.items()
        if rows
    }
    path.write_text(tomlkit.dumps(document), encoding="utf-8")
