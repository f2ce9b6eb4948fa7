"""SQLite connections: one way to open them, with transactions that SQLAlchemy controls."""

from __future__ import annotations

import sqlite3
from pathlib import Path
from typing import Literal
from urllib.parse import quote

from sqlalchemy import Connection, Engine, create_engine, event
from sqlalchemy.pool import StaticPool

BUSY_TIMEOUT_S = 15.0


def file_uri(path: Path, mode: Literal["ro", "rw", "rwc", "immutable"]) -> str:
    """SQLite URI of a file."""
    query = "immutable=1" if mode == "immutable" else f"mode={mode}"
    return f"file:{quote(str(path.resolve()))}?{query}"


def sqlite_engine(
    uri: str, begin: Literal["", "BEGIN", "BEGIN IMMEDIATE"] = "", *, pragmas: tuple[str, ...] = ()
) -> Engine:
    """Return an engine over one connection to `uri`.

    Parameters
    ----------
    begin : str
        What starts a transaction: nothing (each statement stands for itself, so that a long-lived reader sees what
        others have written), BEGIN, or BEGIN IMMEDIATE, which takes the write lock at once: a transaction that
        reads first cannot wait for another writer. The sqlite3 module's own handling, which starts no transaction
        for SAVEPOINT, is switched off.
    pragmas : tuple of str
        Run when the connection is made.
    """

    def connect() -> sqlite3.Connection:
        connection = sqlite3.connect(
            uri, uri=True, timeout=BUSY_TIMEOUT_S, isolation_level=None, check_same_thread=False, cached_statements=256
        )
        for pragma in pragmas:
            connection.execute(f"PRAGMA {pragma}")
        return connection

    engine = create_engine("sqlite://", creator=connect, poolclass=StaticPool)
    if begin:

        @event.listens_for(engine, "begin")
        def start(connection: Connection) -> None:
            connection.exec_driver_sql(begin)

    return engine
