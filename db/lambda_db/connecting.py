"""Open SQLite files and read rows from them."""

from __future__ import annotations

import sqlite3
from pathlib import Path
from types import SimpleNamespace
from typing import Any, Literal
from urllib.parse import quote

BUSY_TIMEOUT_S = 15.0


def file_uri(path: Path, mode: Literal["ro", "rw", "rwc", "immutable"]) -> str:
    """Return the SQLite URI of a file."""
    query = "immutable=1" if mode == "immutable" else f"mode={mode}"
    return f"file:{quote(str(path.resolve()))}?{query}"


def connect(uri: str, pragmas: tuple[str, ...] = ()) -> sqlite3.Connection:
    """Open a connection that starts no transaction by itself.

    Parameters
    ----------
    pragmas : tuple of str
        Run when the connection is made.
    """
    connection = sqlite3.connect(
        uri, uri=True, timeout=BUSY_TIMEOUT_S, isolation_level=None, check_same_thread=False, cached_statements=256
    )
    for pragma in pragmas:
        connection.execute(f"PRAGMA {pragma}")
    return connection


def select_rows(connection: sqlite3.Connection, statement: str, *values: object) -> list[Any]:
    """Return the rows of a query.

    Each has its columns as attributes, as the classes of the tables have them.
    """
    cursor = connection.execute(statement, values)
    names = [described[0] for described in cursor.description]
    return [SimpleNamespace(**dict(zip(names, cells, strict=True))) for cells in cursor]
