"""Check that a database can be read completely.

The check covers pages, constraints and texts.
"""

from __future__ import annotations

from sqlalchemy import Connection
from sqlalchemy.exc import DatabaseError

from lambda_core.domain.printable import printable
from lambda_db.models import Base

# A damaged text also comes back inside SQLite's own messages, and then Python cannot even decode those.
UNREADABLE = (DatabaseError, UnicodeDecodeError)
ADVICE = "move it away and import your rows again"


class DamagedError(Exception):
    """A database whose rows cannot be trusted."""


def check_sound(connection: Connection, schema: str, tables: tuple[str, ...]) -> None:
    """Read a database once to check it.

    Its pages and constraints by SQLite's own check, then every column.

    Parameters
    ----------
    schema : str
        "main", or the name under which it is attached.
    tables : tuple of str
        Whose rows are read; there must be each of them.

    Raises
    ------
    DamagedError
        With SQLite's words for what is wrong.
    """
    try:
        found = connection.exec_driver_sql(f"PRAGMA {schema}.integrity_check(1)").scalar_one()
        for table in tables if found == "ok" else ():
            columns = ", ".join(f"{table}.{column.name}" for column in Base.metadata.tables[table].columns)
            for _ in connection.exec_driver_sql(f"SELECT {columns} FROM {schema}.{table}"):
                pass
    except UNREADABLE as error:
        found = reason_of(error)
    if found != "ok":
        raise DamagedError(printable(" ".join(found.split())))


def reason_of(error: DatabaseError | UnicodeDecodeError) -> str:
    """Return what SQLite says."""
    return "texts in it are no UTF-8" if isinstance(error, UnicodeDecodeError) else printable(str(error.orig))


def is_damage(error: DatabaseError | UnicodeDecodeError) -> bool:
    """Tell damage from what passes: a lock, a missing right."""
    reason = reason_of(error)
    return isinstance(error, UnicodeDecodeError) or "malformed" in reason or "not a database" in reason


def is_denied(error: DatabaseError | UnicodeDecodeError) -> bool:
    """Tell whether the folder denies writing.

    SQLite must write in it what several processes share.
    """
    reason = reason_of(error)
    return "unable to open" in reason or "readonly" in reason
