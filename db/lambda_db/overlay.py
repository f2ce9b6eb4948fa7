"""Put the user's rows in front of the built-in ones.

It uses ATTACH and temporary views with the names of the tables.

SQLite looks for a name among the temporary objects first, so every query written for the tables reads the
overlaid rows without knowing it.
"""

from __future__ import annotations

import logging
from pathlib import Path

from sqlalchemy import Connection

from lambda_db.connecting import file_uri
from lambda_db.engine import at_one_moment
from lambda_db.models import Base
from lambda_db.seal import ChangedError, check_seal
from lambda_db.seed_tables import CHILDREN, VIEWED
from lambda_db.soundness import ADVICE, UNREADABLE, DamagedError, check_sound, is_damage, is_denied, reason_of

log = logging.getLogger("lambda_db")


def _same(columns: dict[str, str], theirs: str) -> str:
    return " AND ".join(f"{theirs}.{p} = m.{c} COLLATE NOCASE" for p, c in columns.items())


def view_statement(table: str) -> str:
    """Return the statement of one view.

    The user's rows, then those built-in rows that no user row replaces.
    """
    definition = Base.metadata.tables[table]
    # Names of SQLite ignore case, attributes of rows do not: one changed letter in the user's file renames a column.
    columns = ", ".join(f"{column.name} AS {column.name}" for column in definition.columns)
    if table in CHILDREN:
        parent, link, group = CHILDREN[table]
        hidden = [f"SELECT 1 FROM user.{parent} u WHERE {_same(link, 'u')}"]
        hidden.append(f"SELECT 1 FROM user.{table} u WHERE {_same({c: c for c in group}, 'u')}")
    else:
        keys = {column.name: column.name for column in definition.primary_key.columns}
        hidden = [f"SELECT 1 FROM user.{table} u WHERE {_same(keys, 'u')}"]
    conditions = " AND ".join(f"NOT EXISTS ({statement})" for statement in hidden)
    return (
        f"CREATE TEMP VIEW {table} AS SELECT {columns} FROM user.{table} "
        f"UNION ALL SELECT {columns} FROM main.{table} AS m WHERE {conditions}"
    )


_told: set[tuple[Path, str]] = set()


def attach_user(connection: Connection, path: Path, schema_version: int) -> bool:
    """Overlay the user's database.

    A damaged, changed or unreadable one is reported and left out.

    Returns
    -------
    bool
        Whether the rows are overlaid.
    """
    trouble = ""
    for mode in ("ro", "immutable"):  # a file in a read-only folder has no room for SQLite's shared memory file
        try:
            connection.exec_driver_sql("ATTACH DATABASE ? AS user", (file_uri(path, mode),))
            try:
                with at_one_moment(connection):  # rows and seal of two moments differ where others write
                    _check(connection, path, schema_version)
                for table in VIEWED:
                    connection.exec_driver_sql(view_statement(table))
            except (*UNREADABLE, VersionMismatch, DamagedError, ChangedError):
                detach_user(connection)
                raise
        except (VersionMismatch, ChangedError) as error:
            trouble = str(error)
            break
        except DamagedError as error:
            trouble = f"it is damaged: {error}; {ADVICE}"
            break
        except UNREADABLE as error:
            trouble = f"{reason_of(error)}; {ADVICE}" if is_damage(error) else reason_of(error)
            if not is_denied(error):  # read as immutable, rows that another process has just written are missing
                break
        else:
            return True
    if (path, trouble) not in _told:  # a command opens the catalogue several times
        _told.add((path, trouble))
        log.warning("your own catalogue %s cannot be read (%s); only the built-in catalogue is used", path, trouble)
    return False


def _check(connection: Connection, path: Path, schema_version: int) -> None:
    """Raise what keeps the attached database from being used."""
    found = connection.exec_driver_sql("PRAGMA user.user_version").scalar_one()
    if path.stat().st_size == 0:
        raise DamagedError("it is empty")
    if found != schema_version:
        raise VersionMismatch(_other_version(found, schema_version))
    check_sound(connection, "user", VIEWED)
    check_seal(connection, "user")


def detach_user(connection: Connection) -> None:
    """Take the overlay away."""
    for table in VIEWED:
        connection.exec_driver_sql(f"DROP VIEW IF EXISTS temp.{table}")
    connection.exec_driver_sql("DETACH DATABASE user")


class VersionMismatch(Exception):
    """The user's database has another schema version than this program."""


def _other_version(found: int, expected: int) -> str:
    newer = "a newer" if found > expected else "an older"
    return f"written by {newer} version of this program: schema {found}, expected {expected}"
