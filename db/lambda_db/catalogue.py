"""Implement the catalogue of the core over SQLite.

It combines built-in, plugin and user rows. A row is read through Python's own sqlite3; SQLAlchemy, which takes as long
to import as all the rest of a command, is loaded for searches, changes, and where there are user rows.
"""

from __future__ import annotations

import re
import sqlite3
from collections.abc import Sequence
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

from lambda_core.catalogue.designation import without_suffixes
from lambda_core.catalogue.other_kinds import other_kind
from lambda_core.catalogue.protocol import (
    BearingRow,
    CageRow,
    ClearanceRow,
    LubricantRow,
    MaterialRow,
    RollerRow,
    Shadow,
)
from lambda_core.catalogue.suffixes import Suffix
from lambda_core.domain.errors import CatalogueError, Problem, nearest, unknown_name
from lambda_db import rows
from lambda_db.built import find_built
from lambda_db.connecting import connect, file_uri, select_rows
from lambda_db.paths import user_database

if TYPE_CHECKING:
    from sqlalchemy import Connection

    from lambda_db.models import Bearing, Candidate, Lubricant, LubricantParameter, LubricantProperty

Kind = Literal["bearing", "lubricant", "material", "cage", "clearance_class"]
_NAMES: dict[Kind, tuple[str, str]] = {  # table and column
    "bearing": ("bearing", "designation"),
    "lubricant": ("lubricant", "name"),
    "material": ("material", "name"),
    "cage": ("cage", "name"),
    "clearance_class": ("clearance", "clearance_class"),
}


# Rows of rollers by the content of the database: every check of a case asks whether its bearing is one of them.
_rollers: dict[str, tuple[RollerRow, ...]] = {}


def open_catalogue(seed_folders: Sequence[Any] = ()) -> SqlCatalogue:
    """Open the catalogue with the user's own rows.

    Builds the core database at first use.

    Parameters
    ----------
    seed_folders : sequence of path-like
        Folders of seed files that plugins bring.

    Raises
    ------
    CatalogueError
        When a folder holds rows that cannot be taken, with every one and the reason.
    """
    folders = [Path(folder) for folder in seed_folders]
    for folder in folders:
        if not folder.is_dir():
            raise _error(
                str(folder), "is not a folder, but a plugin names it for its catalogue rows: correct the plugin"
            )
    return SqlCatalogue(*_connection_to(folders), tuple(folders))


def _connection_to(folders: list[Path]) -> tuple[sqlite3.Connection, str]:
    """Return a connection to the core database.

    Build the database where it is missing. Also return the file's name, which has the hash of its content.
    """
    path = find_built(folders)
    if path is None:
        from lambda_db import build

        path = build.core_database(folders)
        if path is None:
            return build.in_memory(folders), ""
    return connect(file_uri(path, "ro")), path.name


def _error(where: str, message: str) -> CatalogueError:
    return CatalogueError("catalogue", [Problem(where, message)])


def _places(one: str, values: Sequence[object]) -> str:
    """Return what stands for values in a statement."""
    return ", ".join([one] * len(values))


class SqlCatalogue:
    """Catalogue over one read-only connection; implements :class:`lambda_core.catalogue.protocol.Catalogue`."""

    def __init__(self, connection: sqlite3.Connection, content: str, plugin_folders: tuple[Path, ...] = ()) -> None:
        self._file, self._content = connection, content
        self._plugin_folders = plugin_folders
        self._overlaid = False
        self.refresh()

    def refresh(self) -> None:
        """Overlay a new user database and read sources again."""
        path = user_database()
        if self._overlaid or path.exists():
            from lambda_db.overlay import attach_user, detach_user
            from lambda_db.user import SCHEMA_VERSION, migrate

            if self._overlaid:
                detach_user(self.connection)
                self._overlaid = False
            if path.exists():
                migrate(path)
                self._overlaid = attach_user(self.connection, path, SCHEMA_VERSION)
        self._sources = {source.key: source.title for source in self._rows("SELECT key, title FROM source")}

    def _rows(self, statement: str, *values: object) -> list[Any]:
        return select_rows(self._file, statement, *values)

    def _found(self, query: Any) -> list[Any]:
        """Return what a query of SQLAlchemy finds."""
        from sqlalchemy.orm import Session

        with Session(self.connection, autoflush=False, expire_on_commit=False) as session:
            return list(session.scalars(query))

    @cached_property
    def connection(self) -> Connection:
        """Same connection for SQLAlchemy.

        Parts of this package that need whole tables use it.
        """
        from lambda_db.engine import engine_over

        return engine_over(lambda: self._file).connect()

    @property
    def has_user_rows(self) -> bool:
        """Presence of the user's own database."""
        return self._overlaid

    def bearing(self, designation: str, maker: str | None = None) -> BearingRow:
        """Return one bearing by designation and maker (case ignored).

        Raises
        ------
        CatalogueError
            Unknown designation (with the nearest), unknown maker, or several makers and none given.
        """
        wanted = " ".join(designation.split())
        found = self._rows("SELECT * FROM bearing WHERE designation = ? COLLATE NOCASE ORDER BY maker", wanted)
        if not found:
            rollers = [row.designation for row in self._rows("SELECT designation FROM roller_design")]
            names = self._names_of(maker) or [*self.names("bearing"), *rollers]
            if not nearest(designation, names):  # a maker and suffixes that are not here hide a number that is
                numbers = re.findall(r"\d{3,}", wanted)
                names = [name for name in names if any(number in name for number in numbers)] or names
            raise _error("designation", other_kind(designation) or unknown_name("bearing", designation, names))
        makers = ", ".join(row.maker for row in found)
        if maker is not None:
            found = [row for row in found if row.maker.casefold() == maker.strip().casefold()]
            if not found:
                close = nearest(wanted, self._names_of(maker))
                said = f'"{maker}" is not a maker of {wanted} in the catalogue; makers: {makers}'
                raise _error("maker", f"{said}; {maker} has {', '.join(close)}" if close else said)
        if len(found) > 1:
            several = f'"{wanted}" is in the catalogue from several makers; choose one: {makers}'
            raise _error("maker", f'{several} (as in "{found[0].maker} {wanted}")')
        return self._bearing_rows(found)[0]

    def _names_of(self, maker: str | None) -> list[str]:
        """Return the designations of one maker.

        Case is ignored; none of a maker that the catalogue does not know.
        """
        if maker is None:
            return []
        query = "SELECT designation FROM {} WHERE maker = ? COLLATE NOCASE"
        tables = ("bearing", "roller_design")
        return [row.designation for table in tables for row in self._rows(query.format(table), maker.strip())]

    def _bearing_rows(self, found: Sequence[Bearing]) -> list[BearingRow]:
        keys = [(row.designation, row.maker) for row in found]
        of_these = f"WHERE (designation, maker) IN (VALUES {_places('(?, ?)', keys)})"
        candidates: dict[tuple[str, str], list[Candidate]] = {}
        values = [word for key in keys for word in key]
        for candidate in self._rows(f"SELECT * FROM candidate {of_these} ORDER BY rank", *values) if keys else ():
            candidates.setdefault((candidate.designation, candidate.maker), []).append(candidate)
        return [rows.bearing_row(row, candidates.get((row.designation, row.maker), ()), self._sources) for row in found]

    def bearings(self, text: str = "", limit: int = 50) -> list[BearingRow]:
        """Return the bearings that match `text` (:mod:`lambda_db.search`), best first."""
        from lambda_db.search import bearing_query

        plain = without_suffixes(text, self.names("bearing"), self.suffixes())
        return self._bearing_rows(self._found(bearing_query(plain, limit)))

    def rollers(self) -> list[RollerRow]:
        """Return every roller bearing, by designation and maker."""
        if self._content in _rollers and not self._overlaid:
            return list(_rollers[self._content])
        found = self._rows("SELECT * FROM roller_design ORDER BY designation, maker")
        made = [rows.roller_row(row, self._sources) for row in found]
        if self._content and not self._overlaid:
            _rollers[self._content] = tuple(made)
        return made

    def _named_row(self, kind: Literal["lubricant", "material", "cage"], name: str) -> Any:
        """Return a row by name or alias, case ignored."""
        by_name = f"SELECT * FROM {kind} WHERE name = ? COLLATE NOCASE"
        wanted = " ".join(name.split())
        found = self._rows(by_name, wanted)
        if not found:
            by_alias = "SELECT name FROM alias WHERE kind = ? AND alias = ? COLLATE NOCASE"
            found = [row for alias in self._rows(by_alias, kind, wanted)[:1] for row in self._rows(by_name, alias.name)]
        if not found:
            aliases = [row.alias for row in self._rows("SELECT alias FROM alias WHERE kind = ?", kind)]
            raise _error(kind, unknown_name(kind, name, self._names_or_nearest_alias(name, self.names(kind), aliases)))
        return found[0]

    @staticmethod
    def _names_or_nearest_alias(name: str, names: list[str], aliases: list[str]) -> list[str]:
        """Offer aliases only if no proper name is near.

        They are many and long.
        """
        return names if nearest(name, names) or not nearest(name, aliases) else aliases

    def lubricant(self, name: str) -> LubricantRow:
        """Return one lubricant by name or alias.

        Case is ignored.
        """
        return self._lubricant_rows([self._named_row("lubricant", name)])[0]

    def _lubricant_rows(self, found: Sequence[Lubricant]) -> list[LubricantRow]:
        names = [row.name for row in found]
        of_these = f"WHERE lubricant COLLATE NOCASE IN ({_places('?', names)})"
        by_name: dict[str, tuple[list[LubricantProperty], list[LubricantParameter]]] = {
            name.casefold(): ([], []) for name in names
        }
        for prop in self._rows(f"SELECT * FROM lubricant_property {of_these}", *names):
            by_name[prop.lubricant.casefold()][0].append(prop)
        for parameter in self._rows(f"SELECT * FROM lubricant_parameter {of_these}", *names):
            by_name[parameter.lubricant.casefold()][1].append(parameter)
        return [rows.lubricant_row(row, *by_name[row.name.casefold()], self._sources) for row in found]

    def lubricants(self, text: str = "", limit: int = 50) -> list[LubricantRow]:
        """Return the lubricants that match `text`.

        Their name, alias, base stock or note holds every word.
        """
        from lambda_db.search import lubricant_query

        return self._lubricant_rows(self._found(lubricant_query(text, limit)))

    def material(self, name: str) -> MaterialRow:
        """Return one material by its name or an alias."""
        return rows.material_row(self._named_row("material", name), self._sources)

    def cage(self, name: str) -> CageRow:
        """Return one cage type by name or alias.

        A suffix is an alias, too.
        """
        return rows.cage_row(self._named_row("cage", name), self._sources)

    def clearance(self, bore_diameter: float, clearance_class: str) -> ClearanceRow:
        """Return the clearance limits for bore [m] and class.

        Bores on a boundary belong to the smaller range.
        """
        bore, of_class = round(bore_diameter * 1e3, 9), "FROM clearance WHERE clearance_class = ? COLLATE NOCASE"
        wanted = clearance_class.strip()
        found = self._rows(f"SELECT * {of_class} AND bore_over_mm < ? AND bore_to_mm >= ?", wanted, bore, bore)
        if found:
            return rows.clearance_row(found[0], self._sources)
        (span,) = self._rows(f"SELECT min(bore_over_mm) AS start, max(bore_to_mm) AS stop {of_class}", wanted)
        if span.start is None:
            names = self.names("clearance_class")
            raise _error("clearance_class", unknown_name("clearance class", clearance_class, names))
        raise _error(
            "bore_diameter",
            f"class {clearance_class} is tabulated over {span.start:g} to {span.stop:g} mm, not for {bore:g} mm",
        )

    def suffixes(self) -> tuple[Suffix, ...]:
        """Return every suffix that may stand behind a designation, sorted.

        Raises
        ------
        CatalogueError
            When the pattern of a row is no regular expression.
        """
        found = tuple(rows.suffix(row) for row in self._rows("SELECT * FROM suffix ORDER BY written"))
        for suffix in found:
            try:
                re.compile(suffix.pattern)
            except re.error as error:
                raise _error("suffix", f'"{suffix.written}": the pattern is no regular expression: {error}') from None
        return found

    def names(self, kind: Kind) -> list[str]:
        """Return every valid name of one kind, sorted."""
        table, column = _NAMES[kind]
        return [name for (name,) in self._file.execute(f"SELECT DISTINCT {column} FROM {table} ORDER BY {column}")]

    def shadows(self) -> tuple[Shadow, ...]:
        """Return the plugin rows that replace others."""
        if not self._plugin_folders:
            return ()
        from lambda_db.shadows import shadows

        return shadows(self._plugin_folders)

    def close(self) -> None:
        """Release the files behind the catalogue."""
        if "connection" in vars(self):
            self.connection.close()
            self.connection.engine.dispose()
        self._file.close()
