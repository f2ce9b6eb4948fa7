"""Open SQLite connections with transactions under SQLAlchemy's control."""

from __future__ import annotations

import sqlite3
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any, Literal

from sqlalchemy import Connection, Engine, create_engine, event
from sqlalchemy.dialects import registry
from sqlalchemy.dialects.sqlite.pysqlite import SQLiteDialect_pysqlite
from sqlalchemy.pool import StaticPool
from sqlalchemy.util import LRUCache

from lambda_db.connecting import connect

# Statements as text, for all connections of this process: writing them takes as long as asking, and a catalogue is
# opened for every check of a case.
WRITTEN: LRUCache[Any, Any] = LRUCache(500)


class Dialect(SQLiteDialect_pysqlite):
    """SQLite dialect of all connections.

    A statement that was compiled for one of them is good for all.
    """

    supports_statement_cache = True

    def __eq__(self, other: object) -> bool:
        return type(self) is type(other)

    def __hash__(self) -> int:
        return hash(type(self))


registry.register("sqlite.lambda", __name__, "Dialect")


def sqlite_engine(
    uri: str, begin: Literal["", "BEGIN", "BEGIN IMMEDIATE"] = "", *, pragmas: tuple[str, ...] = ()
) -> Engine:
    """Return an engine over one connection to `uri`.

    Parameters
    ----------
    begin : str
        What starts a transaction: nothing (each statement is independent, so that a long-lived reader sees what
        others have written), BEGIN, or BEGIN IMMEDIATE, which takes the write lock at once: a transaction that
        reads first cannot wait for another writer. The sqlite3 module's own handling, which starts no transaction
        for SAVEPOINT, is switched off.
    pragmas : tuple of str
        Run when the connection is made.
    """

    engine = engine_over(lambda: connect(uri, pragmas))
    if begin:

        @event.listens_for(engine, "begin")
        def start(connection: Connection) -> None:
            connection.exec_driver_sql(begin)

    return engine


def engine_over(connect: Callable[[], sqlite3.Connection]) -> Engine:
    """Return an engine over the one connection that `connect` returns."""
    return create_engine(
        "sqlite+lambda://", creator=connect, poolclass=StaticPool, execution_options={"compiled_cache": WRITTEN}
    )


@contextmanager
def at_one_moment(connection: Connection) -> Iterator[None]:
    """Read a consistent state of the database.

    Others may write meanwhile.

    Parameters
    ----------
    connection : Connection
        Of an engine whose statements are transactions of their own.
    """
    connection.exec_driver_sql("BEGIN")
    try:
        yield
    finally:
        connection.rollback()  # harmless where SQLite has ended the transaction after an error
