"""Implement the catalogue of the core over SQLite.

It combines built-in, plugin and user rows.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from pathlib import Path
from typing import Any, Literal

from sqlalchemy import Connection, Engine, func, select, tuple_
from sqlalchemy.orm import Session

from lambda_core.catalogue.designation import without_suffixes
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
from lambda_db import build, rows
from lambda_db.engine import file_uri, sqlite_engine
from lambda_db.models import (
    Alias,
    Bearing,
    Cage,
    Candidate,
    Clearance,
    Lubricant,
    LubricantParameter,
    LubricantProperty,
    Material,
    Source,
)
from lambda_db.models import (
    Suffix as SuffixRow,
)
from lambda_db.overlay import attach_user, detach_user
from lambda_db.paths import user_database
from lambda_db.roller_design import RollerDesign
from lambda_db.search import bearing_query
from lambda_db.shadows import shadows

Kind = Literal["bearing", "lubricant", "material", "cage", "clearance_class"]
_NAMED: dict[str, type[Lubricant] | type[Material] | type[Cage]] = {
    "lubricant": Lubricant,
    "material": Material,
    "cage": Cage,
}


def open_catalogue(seed_folders: Sequence[Any] = ()) -> SqlCatalogue:
    """Open the catalogue: build the core database at first use, overlay the user's own.

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
            raise _error(str(folder), "a plugin brings catalogue rows in it, but it is not a folder")
    path = build.core_database(folders)
    engine = build.in_memory(folders) if path is None else sqlite_engine(file_uri(path, "ro"))
    return SqlCatalogue(engine, tuple(folders))


def _error(where: str, message: str) -> CatalogueError:
    return CatalogueError("catalogue", [Problem(where, message)])


class SqlCatalogue:
    """Catalogue over one read-only connection; implements :class:`lambda_core.catalogue.protocol.Catalogue`."""

    def __init__(self, engine: Engine, plugin_folders: tuple[Path, ...] = ()) -> None:
        self._engine = engine
        self._plugin_folders = plugin_folders
        self._connection: Connection = engine.connect()
        self._overlaid = False
        self.refresh()

    def refresh(self) -> None:
        """Overlay the user's database if it has appeared, and read the sources again."""
        from lambda_db.user import SCHEMA_VERSION, migrate

        path = user_database()
        if self._overlaid:
            detach_user(self._connection)
            self._overlaid = False
        if path.exists():
            migrate(path)
            self._overlaid = attach_user(self._connection, path, SCHEMA_VERSION)
        with self._session() as session:
            self._sources = {source.key: source.title for source in session.scalars(select(Source))}

    def _session(self) -> Session:
        return Session(self._connection, autoflush=False, expire_on_commit=False)

    @property
    def connection(self) -> Connection:
        """The reading connection, for the parts of this package that need whole tables."""
        return self._connection

    @property
    def has_user_rows(self) -> bool:
        """Whether the user's own database is overlaid."""
        return self._overlaid

    def bearing(self, designation: str, maker: str | None = None) -> BearingRow:
        """Return one bearing by designation and maker (case ignored).

        Raises
        ------
        CatalogueError
            Unknown designation (with the nearest), unknown maker, or several makers and none given.
        """
        wanted = " ".join(designation.split())
        with self._session() as session:
            query = select(Bearing).where(Bearing.designation.collate("NOCASE") == wanted).order_by(Bearing.maker)
            found = list(session.scalars(query))
            if not found:
                rollers = list(session.scalars(select(RollerDesign.designation)))
                names = self._names_of(session, maker) or [*self.names("bearing"), *rollers]
                raise _error("designation", unknown_name("bearing", designation, names))
            makers = ", ".join(row.maker for row in found)
            if maker is not None:
                found = [row for row in found if row.maker.casefold() == maker.strip().casefold()]
                if not found:
                    close = nearest(wanted, self._names_of(session, maker))
                    said = f'"{maker}" is not a maker of {wanted} in the catalogue; makers: {makers}'
                    raise _error("maker", f"{said}; {maker} has {', '.join(close)}" if close else said)
            if len(found) > 1:
                several = f'"{wanted}" is in the catalogue from several makers; choose one: {makers}'
                raise _error("maker", f'{several} (as in "{found[0].maker} {wanted}")')
            return self._bearing_rows(session, found)[0]

    def _names_of(self, session: Session, maker: str | None) -> list[str]:
        """Return the designations of one maker (case ignored); none of a maker that the catalogue does not know."""
        if maker is None:
            return []
        query = select(Bearing.designation).where(Bearing.maker.collate("NOCASE") == maker.strip())
        return list(session.scalars(query))

    def _bearing_rows(self, session: Session, found: Sequence[Bearing]) -> list[BearingRow]:
        keys = [(row.designation, row.maker) for row in found]
        query = select(Candidate).where(tuple_(Candidate.designation, Candidate.maker).in_(keys))
        candidates: dict[tuple[str, str], list[Candidate]] = {}
        for candidate in session.scalars(query.order_by(Candidate.rank)) if keys else ():
            candidates.setdefault((candidate.designation, candidate.maker), []).append(candidate)
        return [rows.bearing_row(row, candidates.get((row.designation, row.maker), ()), self._sources) for row in found]

    def bearings(self, text: str = "", limit: int = 50) -> list[BearingRow]:
        """Return the bearings that match `text` (:mod:`lambda_db.search`), best first."""
        plain = without_suffixes(text, self.names("bearing"), self.suffixes())
        with self._session() as session:
            return self._bearing_rows(session, list(session.scalars(bearing_query(plain, limit))))

    def rollers(self) -> list[RollerRow]:
        """Return every roller bearing, by designation and maker."""
        query = select(RollerDesign).order_by(RollerDesign.designation, RollerDesign.maker)
        with self._session() as session:
            return [rows.roller_row(row, self._sources) for row in session.scalars(query)]

    def _named_row(self, session: Session, kind: str, name: str) -> Any:
        """Return a row by name or alias, case ignored."""
        model = _NAMED[kind]
        wanted = " ".join(name.split())
        row = session.scalar(select(model).where(model.name.collate("NOCASE") == wanted))
        if row is None:
            alias = select(Alias.name).where(Alias.kind == kind, Alias.alias.collate("NOCASE") == wanted)
            target = session.scalar(alias)
            row = session.scalar(select(model).where(model.name.collate("NOCASE") == target)) if target else None
        if row is None:
            aliases = session.scalars(select(Alias.alias).where(Alias.kind == kind))
            raise _error(kind, unknown_name(kind, name, self._names_or_nearest_alias(name, self.names(kind), aliases)))  # type: ignore[arg-type]
        return row

    @staticmethod
    def _names_or_nearest_alias(name: str, names: list[str], aliases: Any) -> list[str]:
        """Offer aliases only if no proper name is near: they are many and long."""
        spelled = list(aliases)
        return names if nearest(name, names) or not nearest(name, spelled) else spelled

    def lubricant(self, name: str) -> LubricantRow:
        """Return one lubricant by its name or an alias (case ignored)."""
        with self._session() as session:
            return self._lubricant_rows(session, [self._named_row(session, "lubricant", name)])[0]

    def _lubricant_rows(self, session: Session, found: Sequence[Lubricant]) -> list[LubricantRow]:
        names = [row.name for row in found]
        properties = select(LubricantProperty).where(LubricantProperty.lubricant.collate("NOCASE").in_(names))
        parameters = select(LubricantParameter).where(LubricantParameter.lubricant.collate("NOCASE").in_(names))
        by_name: dict[str, tuple[list[LubricantProperty], list[LubricantParameter]]] = {
            name.casefold(): ([], []) for name in names
        }
        for prop in session.scalars(properties):
            by_name[prop.lubricant.casefold()][0].append(prop)
        for parameter in session.scalars(parameters):
            by_name[parameter.lubricant.casefold()][1].append(parameter)
        return [rows.lubricant_row(row, *by_name[row.name.casefold()], self._sources) for row in found]

    def lubricants(self, text: str = "", limit: int = 50) -> list[LubricantRow]:
        """Return the lubricants whose name, alias, base stock or note holds every word of `text`."""
        with self._session() as session:
            query = select(Lubricant).order_by(Lubricant.name)
            for word in text.split():
                aliases = select(Alias.name).where(
                    Alias.kind == "lubricant", Alias.alias.contains(word, autoescape=True)
                )
                query = query.where(
                    Lubricant.name.contains(word, autoescape=True)
                    | Lubricant.base_type.contains(word, autoescape=True)
                    | Lubricant.note.contains(word, autoescape=True)
                    | Lubricant.name.in_(aliases)
                )
            return self._lubricant_rows(session, list(session.scalars(query.limit(limit))))

    def material(self, name: str) -> MaterialRow:
        """Return one material by its name or an alias."""
        with self._session() as session:
            return rows.material_row(self._named_row(session, "material", name), self._sources)

    def cage(self, name: str) -> CageRow:
        """Return one cage type by its name, suffix alias or another alias."""
        with self._session() as session:
            return rows.cage_row(self._named_row(session, "cage", name), self._sources)

    def clearance(self, bore_diameter: float, clearance_class: str) -> ClearanceRow:
        """Return the limits for a bore [m] and a class; bores on a boundary belong to the smaller range."""
        bore = round(bore_diameter * 1e3, 9)
        with self._session() as session:
            of_class = select(Clearance).where(Clearance.clearance_class.collate("NOCASE") == clearance_class.strip())
            row = session.scalar(of_class.where(Clearance.bore_over_mm < bore, Clearance.bore_to_mm >= bore))
            if row is not None:
                return rows.clearance_row(row, self._sources)
            span = session.execute(
                select(func.min(Clearance.bore_over_mm), func.max(Clearance.bore_to_mm)).where(of_class.whereclause)  # type: ignore[arg-type]
            ).one()
        if span[0] is None:
            names = self.names("clearance_class")
            raise _error("clearance_class", unknown_name("clearance class", clearance_class, names))
        raise _error(
            "bore_diameter",
            f"class {clearance_class} is tabulated over {span[0]:g} to {span[1]:g} mm, not for {bore:g} mm",
        )

    def suffixes(self) -> tuple[Suffix, ...]:
        """Return every suffix that may stand behind a designation, sorted.

        Raises
        ------
        CatalogueError
            When the pattern of a row is no regular expression.
        """
        with self._session() as session:
            found = tuple(rows.suffix(row) for row in session.scalars(select(SuffixRow).order_by(SuffixRow.written)))
        for suffix in found:
            try:
                re.compile(suffix.pattern)
            except re.error as error:
                raise _error("suffix", f'"{suffix.written}": the pattern is no regular expression: {error}') from None
        return found

    def names(self, kind: Kind) -> list[str]:
        """Return every valid name of one kind, sorted."""
        column = {
            "bearing": Bearing.designation,
            "lubricant": Lubricant.name,
            "material": Material.name,
            "cage": Cage.name,
            "clearance_class": Clearance.clearance_class,
        }[kind]
        with self._session() as session:
            return list(session.scalars(select(column).distinct().order_by(column)))

    def shadows(self) -> tuple[Shadow, ...]:
        """Return the rows of plugins that stand in front of others."""
        return shadows(self._plugin_folders)

    def close(self) -> None:
        """Release the files behind the catalogue."""
        self._connection.close()
        self._engine.dispose()
