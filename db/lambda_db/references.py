"""List the references of rows to other tables.

These are lubricants of properties, materials of cages and targets of aliases.
"""

from __future__ import annotations

from dataclasses import dataclass

from sqlalchemy import Connection

from lambda_core.domain.errors import unknown_name
from lambda_db.records import Row

# table -> (column, table that it names)
_NAMES: dict[str, tuple[str, str]] = {
    "lubricant_property": ("lubricant", "lubricant"),
    "lubricant_parameter": ("lubricant", "lubricant"),
    "cage": ("material", "material"),
}


@dataclass
class Known:
    """Names that rows may refer to, by table."""

    names: dict[str, set[str]]

    def add(self, table: str, row: Row) -> None:
        """Remember a row that has been accepted."""
        if table in self.names:
            self.names[table].add(row["name"])

    def has(self, table: str, name: str) -> bool:
        """Tell whether a name is known (case ignored)."""
        folded = name.casefold()
        return any(folded == known.casefold() for known in self.names[table])


def known_names(connection: Connection) -> Known:
    """Collect the names of every table that others refer to."""
    tables = ("lubricant", "material", "cage")
    names = {t: set(connection.exec_driver_sql(f"SELECT name FROM {t}").scalars()) for t in tables}
    return Known(names)


def reference_problems(table: str, row: Row, known: Known) -> list[str]:
    """Say which names of a row stand nowhere."""
    if table in _NAMES:
        column, target = _NAMES[table]
        if not known.has(target, row[column]):
            return [unknown_name(target, row[column], known.names[target])]
    # an alias may come before the row it names; `db check` reports those left open
    return []
