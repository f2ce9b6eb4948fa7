"""Build the core database from the seeds.

It is built at first use, named by the hash of seeds and schema, and put in place in one step.
"""

from __future__ import annotations

import logging
import os
import sqlite3
import tempfile
from collections.abc import Iterable
from contextlib import suppress
from pathlib import Path

from sqlalchemy import Connection, delete, insert, select
from sqlalchemy.exc import IntegrityError

from lambda_core.domain.errors import CatalogueError, Problem
from lambda_db.built import BUILT_IN, built_name, digest_of
from lambda_db.connecting import connect, file_uri
from lambda_db.engine import engine_over, sqlite_engine
from lambda_db.models import Base
from lambda_db.paths import cache_folder
from lambda_db.records import Row, describe, key_columns, parse_row, table_of
from lambda_db.seed_files import Record, read_path
from lambda_db.seed_tables import CHILDREN, SEED_TABLES

log = logging.getLogger("lambda_db")
_KEPT = 8  # built databases in the cache


def constraint_sentence(error: IntegrityError) -> str:
    """Turn a constraint failure of SQLite into a sentence.

    The table's CHECK carries the sentence.
    """
    message = str(error.orig)
    name = message.rsplit(": ", 1)[-1].strip()
    for table in Base.metadata.tables.values():
        for constraint in table.constraints:
            if constraint.name == name and "CHECK" in message:
                return f"{constraint.info['sentence']} ({name})"
    if "UNIQUE" in message or "PRIMARY KEY" in message:
        return "a row with this key exists already"
    return message


def insert_row(connection: Connection, table: str, row: Row) -> str | None:
    """Insert one row.

    Return the reason if the database refuses it, None if it is in.
    """
    savepoint = connection.begin_nested()
    try:
        connection.execute(insert(table_of(table)), row)
    except IntegrityError as error:
        savepoint.rollback()
        return constraint_sentence(error)
    savepoint.commit()
    return None


def _replace_lower_layer(connection: Connection, table: str, rows: list[Row]) -> None:
    """Remove the rows that a plugin's rows replace.

    They have the same key; the children of a parent go with it.
    """
    keys = CHILDREN[table][2] if table in CHILDREN else tuple(key_columns(table))
    target = table_of(table)
    for key in {tuple(row[column] for column in keys) for row in rows}:
        condition = [target.c[column] == value for column, value in zip(keys, key, strict=True)]
        connection.execute(delete(target).where(*condition))
    for child, (parent, link, _) in CHILDREN.items():
        if parent == table:
            below = Base.metadata.tables[child]
            for row in rows:
                connection.execute(delete(below).where(*(below.c[c] == row[p] for p, c in link.items())))


def load(connection: Connection, records: Iterable[Record], layer: str) -> None:
    """Insert every record of one layer, all or nothing.

    Raises
    ------
    CatalogueError
        With every bad row and its reason.
    """
    problems: list[Problem] = []
    by_table: dict[str, list[tuple[str, Row]]] = {name: [] for name in SEED_TABLES}
    source = ""
    for path, place, table, cells in records:
        source = str(path.parent)
        row, reasons = parse_row(table, cells)
        if "layer" in table_of(table).c:
            row["layer"] = layer
        problems += [Problem(f"{path.name} {place}", reason) for reason in reasons]
        if not reasons:
            by_table[table].append((f"{path.name} {place}", row))
    for table, placed in by_table.items():
        if layer != "core" and placed:
            _replace_lower_layer(connection, table, [row for _, row in placed])
        if placed:
            problems += _insert_all(connection, table, placed)
    if problems:
        raise CatalogueError(source, problems)


def _insert_all(connection: Connection, table: str, placed: list[tuple[str, Row]]) -> list[Problem]:
    """Insert the rows at once.

    If the database refuses, insert them one by one to learn which and why.
    """
    savepoint = connection.begin_nested()
    try:
        connection.execute(insert(table_of(table)), [row for _, row in placed])
    except IntegrityError:
        savepoint.rollback()
        reasons = ((place, row, insert_row(connection, table, row)) for place, row in placed)
        return [Problem(place, f"{describe(table, row)}: {reason}") for place, row, reason in reasons if reason]
    savepoint.commit()
    return []


def fill(connection: Connection, plugin_folders: list[Path]) -> None:
    """Create the tables and read the seeds.

    A plugin's rows come before the built-in ones.

    Raises
    ------
    CatalogueError
        With every bad row of the first folder that has any; the registry then leaves that plugin's folder out.
    """
    Base.metadata.create_all(connection)
    load(connection, read_path(BUILT_IN), "core")
    for folder in plugin_folders:
        load(connection, read_path(folder), "plugin")
    derive_candidates(connection)


def derive_candidates(connection: Connection) -> None:
    """Rank designs for bearings with unpublished geometry.

    The inner geometry is what they estimate.
    """
    from lambda_db.estimate import candidate_rows

    bearings = connection.execute(select(table_of("bearing"))).mappings().all()
    rows = [candidate for bearing in bearings for candidate in candidate_rows(dict(bearing))]
    if rows:
        connection.execute(insert(Base.metadata.tables["candidate"]), rows)


def build_file(folder: Path, name: str, plugin_folders: list[Path]) -> Path:
    """Build the database and move it into its place.

    Its name has its digest, so a reader never sees half of it.
    """
    folder.mkdir(parents=True, exist_ok=True)
    handle, path = tempfile.mkstemp(prefix=name, suffix=".tmp", dir=folder)
    os.close(handle)
    temporary = Path(path)
    try:
        engine = sqlite_engine(file_uri(temporary, "rw"), "BEGIN")
        with engine.begin() as connection:
            fill(connection, plugin_folders)
        engine.dispose()
        target = folder / f"{name}-{digest_of(temporary)}.sqlite"
        try:
            os.replace(temporary, target)
        except PermissionError:  # Windows replaces no open file: another process reads the same content there
            if not target.is_file():
                raise
        _prune(folder)
    finally:
        temporary.unlink(missing_ok=True)
    return target


def _prune(folder: Path) -> None:
    """Keep the databases built last.

    Other versions of the program build theirs again when they need it.
    """
    built = sorted(folder.glob("catalogue-*.sqlite"), key=lambda path: path.stat().st_mtime, reverse=True)
    for path in built[_KEPT:]:
        with suppress(OSError):  # in use on a system that locks open files
            path.unlink()


def in_memory(plugin_folders: list[Path]) -> sqlite3.Connection:
    """Build the database in memory.

    A machine whose cache folder is not writable needs it.
    """
    made = connect("file::memory:")
    with engine_over(lambda: made).begin() as connection:
        fill(connection, plugin_folders)
    return made


def core_database(plugin_folders: list[Path]) -> Path | None:
    """Build the core database, which is missing or damaged.

    Returns None if the cache folder cannot be written; the caller then builds in memory.
    """
    folder = cache_folder()
    try:
        return build_file(folder, built_name(plugin_folders), plugin_folders)
    except (OSError, sqlite3.OperationalError) as error:
        log.warning("the catalogue cannot be kept in %s (%s); building it in memory", folder, error)
        return None
