"""SQLite connections: one way to open them, with transactions that SQLAlchemy controls."""

from __future__ import annotations

import sqlite3
from pathlib import Path
from urllib.parse import quote

from sqlalchemy import Connection, Engine, create_engine, event
from sqlalchemy.pool import StaticPool

BUSY_TIMEOUT_S = 15.0


def file_uri(path: Path, mode: str) -> str:
    """SQLite URI of a file; `mode` is ``ro``, ``rw``, ``rwc`` or ``immutable``."""
    query = "immutable=1" if mode == "immutable" else f"mode={mode}"
    return f"file:{quote(str(path.resolve()))}?{query}"


def sqlite_engine(uri: str, *, immediate: bool = False) -> Engine:
    """Return an engine over one connection to `uri` (``:memory:`` included).

    The sqlite3 module's own transaction handling starts no transaction for SAVEPOINT; it is switched off and
    BEGIN is sent when SQLAlchemy begins. `immediate` takes the write lock at once: a transaction that reads first
    cannot wait for another writer.
    """

    def connect() -> sqlite3.Connection:
        return sqlite3.connect(
            uri, uri=True, timeout=BUSY_TIMEOUT_S, isolation_level=None, check_same_thread=False, cached_statements=256
        )

    engine = create_engine("sqlite://", creator=connect, poolclass=StaticPool)

    @event.listens_for(engine, "begin")
    def begin(connection: Connection) -> None:
        connection.exec_driver_sql("BEGIN IMMEDIATE" if immediate else "BEGIN")

    return engine
