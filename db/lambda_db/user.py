"""Open and write the user's own database.

It uses WAL, a busy timeout for several writers, and versions by PRAGMA user_version.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from tempfile import TemporaryDirectory

from sqlalchemy import Connection, Engine
from sqlalchemy.exc import DatabaseError

from lambda_core.domain.errors import CatalogueError, Problem
from lambda_db.connecting import file_uri
from lambda_db.engine import sqlite_engine
from lambda_db.models import Base
from lambda_db.seal import ChangedError, check_seal, create_seal, differences, renew_seal
from lambda_db.seed_tables import VIEWED
from lambda_db.soundness import ADVICE, UNREADABLE, DamagedError, check_sound, is_damage, is_denied, reason_of


def _renew(connection: Connection, name: str, *, always: bool = False) -> None:
    """Make a table again with today's columns and constraints.

    It keeps its rows. With `always` its constraints have changed alone.
    """
    table = Base.metadata.tables[name]
    found = [row[1] for row in connection.exec_driver_sql(f"PRAGMA table_info({name})")]
    if len(found) == len(table.columns) and not always:  # an earlier step has made it
        return
    columns = ", ".join(found)
    connection.exec_driver_sql(f"ALTER TABLE {name} RENAME TO before_{name}")
    table.create(connection)
    connection.exec_driver_sql(f"INSERT INTO {name} ({columns}) SELECT {columns} FROM before_{name}")
    connection.exec_driver_sql(f"DROP TABLE before_{name}")


def _with_measured(connection: Connection) -> None:
    """Let values be measured ones."""
    for name in ("bearing", "roller_design", "cage", "lubricant_property", "lubricant_parameter"):
        _renew(connection, name, always=True)


def _with_seal(connection: Connection) -> None:
    _renew(connection, "bearing")  # what is sealed are the columns and tables of today
    Base.metadata.tables["roller_design"].create(connection, checkfirst=True)
    create_seal(connection)


def _with_rollers(connection: Connection) -> None:
    Base.metadata.tables["roller_design"].create(connection, checkfirst=True)
    renew_seal(connection)


# Steps from version n to n + 1; the newest schema is Base.metadata itself.
MIGRATIONS: dict[int, Callable[[Connection], None]] = {
    1: lambda connection: Base.metadata.tables["suffix"].create(connection),
    2: _with_seal,
    3: lambda connection: _renew(connection, "bearing"),
    4: lambda connection: _renew(connection, "bearing"),
    5: _with_rollers,
    6: lambda connection: _renew(connection, "roller_design"),
    7: _with_measured,
}
SCHEMA_VERSION = 8


@contextmanager
def changing(path: Path) -> Iterator[Connection]:
    """Change the user's database in one transaction.

    It is made or brought up to date before, and sealed at its end.

    Raises
    ------
    CatalogueError
        If the file is damaged, changed by somebody else, read-only or of a newer version.
    """
    engine = open_user_database(path)
    try:
        with engine.begin() as connection:
            check_seal(connection, "main")  # again: others may have changed it since it was opened
            yield connection
            renew_seal(connection)
    except ChangedError as error:
        raise CatalogueError(str(path), [Problem("", f"cannot be written: {error}")]) from error
    except UNREADABLE as error:
        raise unwritable(path, error) from error
    finally:
        engine.dispose()


def accept(path: Path) -> list[str]:
    """Seal the user's database as it is now.

    However it was changed; return which rows differ from the seal before.

    Raises
    ------
    CatalogueError
        If there is none, or the file is damaged, read-only or of a newer version.
    """
    if not path.is_file():
        raise CatalogueError(str(path), [Problem("", "there is no user catalogue yet: db add or db import creates it")])
    engine = open_user_database(path, changed=True)
    try:
        with engine.begin() as connection:
            found = differences(connection, "main")
            renew_seal(connection)
    except UNREADABLE as error:
        raise unwritable(path, error) from error
    finally:
        engine.dispose()
    return found


def open_user_database(path: Path, *, changed: bool = False) -> Engine:
    """Open the user's database for writing.

    Create or migrate it; with `changed` also open one that others changed.

    Raises
    ------
    CatalogueError
        If the file is damaged, changed by somebody else, read-only or of a newer version.
    """
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        if not path.exists():
            _create(path)
        engine = sqlite_engine(file_uri(path, "rwc"), "BEGIN IMMEDIATE", pragmas=("journal_mode = WAL",))
        with engine.begin() as connection:
            _bring_up_to_date(connection, path, changed=changed)
    except OSError as error:
        raise CatalogueError(str(path), [Problem("", f"cannot be created: {error.strerror}")]) from error
    except DamagedError as error:
        raise _damaged(path, str(error)) from error
    except ChangedError as error:
        raise CatalogueError(str(path), [Problem("", f"cannot be written: {error}")]) from error
    except UNREADABLE as error:
        raise unwritable(path, error) from error
    return engine


def _create(path: Path) -> None:
    """Put a complete empty catalogue in place.

    A file of no length is then never one that is being made.
    """
    with TemporaryDirectory(prefix=".catalogue-", dir=path.parent) as folder:
        made = Path(folder) / path.name
        engine = sqlite_engine(file_uri(made, "rwc"), "BEGIN IMMEDIATE", pragmas=("journal_mode = WAL",))
        with engine.begin() as connection:
            _bring_up_to_date(connection, made, changed=False)
        engine.dispose()
        try:
            os.link(made, path)
        except FileExistsError:  # another process was quicker
            pass
        except OSError:  # a file system without links
            os.replace(made, path)


def _damaged(path: Path, reason: str) -> CatalogueError:
    return CatalogueError(str(path), [Problem("", f"cannot be written: the file is damaged ({reason}); {ADVICE}")])


def unwritable(path: Path, error: DatabaseError | UnicodeDecodeError) -> CatalogueError:
    """Say why the user's database takes no rows."""
    reason = reason_of(error)
    if is_denied(error):
        reason = "the file or its folder is read-only; make it writable or set LAMBDA_BEARING_DATA to another folder"
    elif is_damage(error):
        return _damaged(path, reason)
    return CatalogueError(str(path), [Problem("", f"cannot be written: {reason}")])


def _bring_up_to_date(connection: Connection, path: Path, *, changed: bool) -> None:
    found = connection.exec_driver_sql("PRAGMA user_version").scalar_one()
    if found > SCHEMA_VERSION:
        message = f"was written by a newer version of this program (schema {found}, this one reads {SCHEMA_VERSION})"
        raise CatalogueError(str(path), [Problem("", message)])
    if found == 0:
        Base.metadata.create_all(connection)
        create_seal(connection)
    else:
        for version in range(found, SCHEMA_VERSION):
            MIGRATIONS[version](connection)
        check_sound(connection, "main", VIEWED)
        if not changed:
            check_seal(connection, "main")
    connection.exec_driver_sql(f"PRAGMA user_version = {SCHEMA_VERSION}")


def migrate(path: Path) -> None:
    """Bring an older database up to date.

    It does so before the database is read; the reader reports anything else.
    """
    try:
        engine = sqlite_engine(file_uri(path, "ro"))
        with engine.connect() as connection:
            found = connection.exec_driver_sql("PRAGMA user_version").scalar_one()
        engine.dispose()
        if 0 < found < SCHEMA_VERSION:
            open_user_database(path).dispose()
    except (*UNREADABLE, CatalogueError):
        return
