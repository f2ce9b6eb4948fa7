"""Keep a digest of every row of the user's catalogue.

The program renews it with each of its changes.

SQLite keeps no checksums: a text or number that a failing disk has changed reads as well as the one before, and so does
one that a person has changed with another tool. Neither is used until somebody has said that it is right.
"""

from __future__ import annotations

from collections import Counter
from hashlib import blake2b

from sqlalchemy import Connection

from lambda_core.domain.printable import printable
from lambda_db.models import Base
from lambda_db.seed_tables import VIEWED

_DIGEST = 16  # [byte]
_NAMED = 3  # rows that a sentence names
# Columns younger than the seal: a row that has nothing in them keeps the digest that it had before.
_ADDED = {
    "bearing": (
        *("kind", "contact_angle_deg", "angle_source", "angle_grade"),
        *("row_distance_mm", "row_distance_source", "row_distance_grade", "row_distance_status"),
    ),
    "roller_design": ("limiting_speed_rpm",),
    "lubricant_parameter": ("status",),
}
ACCEPT = "lambda-bearing db accept"


class ChangedError(Exception):
    """Rows differ from what the program wrote."""

    def __init__(self, differences: list[str]) -> None:
        rest = len(differences) - _NAMED
        named = ", ".join(differences[:_NAMED]) + (f" and {rest} more" if rest > 0 else "")
        super().__init__(f"it was changed, but not by this program: {named}; if that is right: {ACCEPT}")


def create_seal(connection: Connection) -> None:
    """Create the table of digests and seal all rows."""
    connection.exec_driver_sql('CREATE TABLE seal ("row" TEXT NOT NULL, digest TEXT NOT NULL)')
    renew_seal(connection)


def renew_seal(connection: Connection) -> None:
    """Write the digests of the present rows.

    The transaction that has changed them also writes these.
    """
    connection.exec_driver_sql("DELETE FROM seal")
    for pair in _digests(connection, "main").elements():
        connection.exec_driver_sql("INSERT INTO seal VALUES (?, ?)", pair)


def differences(connection: Connection, schema: str) -> list[str]:
    """Return the rows changed by others, and how.

    They are compared with what the program wrote.

    Parameters
    ----------
    connection : Connection
        In a transaction: rows and seal are read by several statements.
    schema : str
        "main", or the name under which the database is attached.
    """
    written = Counter((str(row), str(digest)) for row, digest in _rows(connection, schema, "seal", '"row", digest'))
    found = _digests(connection, schema)
    lost = {row for row, _ in written - found}
    new = {row for row, _ in found - written}
    told = [f"{row} is changed" for row in sorted(lost & new)]
    told += [f"{row} is gone" for row in sorted(lost - new)]
    told += [f"{row} is new" for row in sorted(new - lost)]
    return [printable(text) for text in told]


def check_seal(connection: Connection, schema: str) -> None:
    """Refuse a database that others changed.

    Raise ChangedError when its rows are not those that the program wrote.
    """
    if found := differences(connection, schema):
        raise ChangedError(found)


def _digests(connection: Connection, schema: str) -> Counter[tuple[str, str]]:
    found: Counter[tuple[str, str]] = Counter()
    for table in VIEWED:
        definition = Base.metadata.tables[table]
        names = [column.name for column in definition.columns]
        keys = [names.index(column.name) for column in definition.primary_key.columns]
        for row in _rows(connection, schema, table, ", ".join(names)):
            name = " ".join([table, *(str(row[key]) for key in keys)])
            added = _ADDED.get(table, ())
            named = zip(names, row, strict=True)
            sealed = [cell if c not in added else (c, cell) for c, cell in named if cell is not None or c not in added]
            found[name, blake2b(repr((table, *sealed)).encode(), digest_size=_DIGEST).hexdigest()] += 1
    return found


def _rows(connection: Connection, schema: str, table: str, columns: str) -> list[tuple[object, ...]]:
    return [tuple(row) for row in connection.exec_driver_sql(f"SELECT {columns} FROM {schema}.{table}")]
