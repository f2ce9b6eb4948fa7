"""Store the points of a study in SQLite.

Only the process that directs the study writes it; others may read at any time.
"""

from __future__ import annotations

import json
import sqlite3
from collections.abc import Iterator, Sequence
from contextlib import closing, contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from lambda_core.domain.errors import UsageError
from lambda_core.results.run_status import Status, this_process
from lambda_core.studies.definition import Study, validate_study
from lambda_core.studies.design import Coordinate, Point
from lambda_core.studies.job import Outcome
from lambda_core.studies.scheduler import Counts
from lambda_core.views.table import Column, PointState, StudyTable

FILE = "manifest.sqlite"
VERSION = 1
BANDS = "bands"  # entry of the ends of model bands over the values, JSON: by response, for each point
_SCHEMA = """
CREATE TABLE meta (name TEXT PRIMARY KEY, value TEXT NOT NULL) STRICT;
CREATE TABLE columns (
    place INTEGER PRIMARY KEY, kind TEXT NOT NULL, name TEXT NOT NULL, unit TEXT NOT NULL, meaning TEXT NOT NULL
) STRICT;
CREATE TABLE points (
    number INTEGER PRIMARY KEY,  -- from 0
    changes TEXT NOT NULL,       -- path=value, JSON
    coordinates TEXT NOT NULL,   -- entries of the table, JSON
    state TEXT NOT NULL DEFAULT 'pending',
    reason TEXT NOT NULL DEFAULT '',
    hash TEXT NOT NULL DEFAULT '',
    responses TEXT NOT NULL DEFAULT '{}',
    file TEXT NOT NULL DEFAULT '',
    seconds REAL NOT NULL DEFAULT 0.0
) STRICT;
"""


@dataclass(frozen=True)
class Heading:
    """Name, unit and meaning of one column."""

    kind: str  # "parameter" or "response"
    name: str
    unit: str
    meaning: str


@contextmanager
def readable(folder: Path) -> Iterator[None]:
    """Treat read errors as a damaged manifest.

    The block reads the manifest of a study and nothing else.

    Raises
    ------
    UsageError
        For a manifest that is damaged, with what to do.
    """
    try:
        yield
    except (sqlite3.DatabaseError, ValueError, TypeError, KeyError, IndexError) as error:
        words = "a text in it is no UTF-8" if isinstance(error, UnicodeDecodeError) else " ".join(str(error).split())
        raise UsageError(
            f"{folder / FILE} is damaged ({words}); start the study again in another folder: lambda-bearing study run "
            f"{folder / 'study.toml'} --out {folder}-2"
        ) from None


@contextmanager
def _writable(target: str, advice: str = "") -> Iterator[None]:
    """Refuse to write where there is no room; UsageError."""
    try:
        yield
    except (OSError, sqlite3.OperationalError) as error:
        why = getattr(error, "strerror", None) or error
        raise UsageError(f"cannot write {target}: {why}{advice}") from None


def _claim(path: Path) -> None:
    """Make an empty manifest; of two processes one succeeds."""
    try:
        path.open("x").close()
    except FileExistsError:
        raise UsageError(
            f"{path.parent} already holds a study: go on with it (lambda-bearing study resume {path.parent}), or name "
            "another folder with --out"
        ) from None


class Manifest:
    """Access to the manifest of one study.

    Parameters
    ----------
    folder : pathlib.Path
        The study's folder.

    Raises
    ------
    UsageError
        When the folder holds no study, or that of another version of the program.
    """

    def __init__(self, folder: Path, *, write: bool = False) -> None:
        self.folder, self.path = folder, folder / FILE
        if not self.path.is_file():
            what = "does not exist" if not folder.exists() else "holds no study"
            raise UsageError(f"{folder} {what}; start one with: lambda-bearing study run STUDY.toml")
        mode = "rw" if write else "ro"
        self._database = sqlite3.connect(f"{self.path.resolve().as_uri()}?mode={mode}", uri=True, timeout=30.0)
        with readable(folder):
            found = self._database.execute("PRAGMA integrity_check(1)").fetchone()[0]
            if found != "ok":
                raise sqlite3.DatabaseError(found)
            version = self.meta("version")
        if version != str(VERSION):
            raise UsageError(f"{self.path} has version {version}; this program reads version {VERSION}")

    @staticmethod
    def create(
        folder: Path, study: Study, study_toml: str, case_toml: str, title: str, headings: Sequence[Heading]
    ) -> Manifest:
        """Start the manifest of a study.

        It is in `folder`, which is made if needed and must not hold a manifest yet.
        """
        path, target = folder / FILE, f"the study into {folder}"
        with _writable(target):
            folder.mkdir(parents=True, exist_ok=True)
            _claim(path)
        values = {
            "version": str(VERSION),
            "study": json.dumps(study.model_dump(mode="json", exclude_unset=True)),
            "case_toml": case_toml,
            "title": title,
        }
        columns = [(h.kind, h.name, h.unit, h.meaning) for h in headings]
        try:
            with _writable(target):
                (folder / "study.toml").write_text(study_toml, encoding="utf-8")
                (folder / "case.toml").write_text(case_toml, encoding="utf-8")
                with closing(sqlite3.connect(path)) as database, database:
                    database.executescript(_SCHEMA)
                    database.executemany("INSERT INTO meta VALUES (?, ?)", values.items())
                    database.executemany("INSERT INTO columns (kind, name, unit, meaning) VALUES (?, ?, ?, ?)", columns)
        except UsageError:
            path.unlink(missing_ok=True)  # a part of a manifest would be taken for a study
            raise
        return Manifest(folder, write=True)

    # -- what it says --

    def meta(self, name: str) -> str:
        """Return one entry about the study.

        "" when there is none.
        """
        row = self._database.execute("SELECT value FROM meta WHERE name = ?", (name,)).fetchone()
        return str(row[0]) if row else ""

    @property
    def study(self) -> Study:
        """The definition that the study was started with."""
        return validate_study(json.loads(self.meta("study")), str(self.path))

    @property
    def case_toml(self) -> str:
        """The case that the points start from."""
        return self.meta("case_toml")

    def headings(self) -> list[Heading]:
        """Return the columns of the table."""
        return [
            Heading(*row)
            for row in self._database.execute("SELECT kind, name, unit, meaning FROM columns ORDER BY place")
        ]

    def counts(self) -> Counts:
        """Return how many points are in which state."""
        found = dict(self._database.execute("SELECT state, count(*) FROM points GROUP BY state").fetchall())
        states = {state: int(found.get(state, 0)) for state in ("done", "partial", "failed", "pending")}
        return Counts(sum(states.values()), **states)

    def seconds(self) -> float:
        """Return the time that workers have spent on points [s]."""
        return float(self._database.execute("SELECT total(seconds) FROM points").fetchone()[0])

    def failures(self, most: int = 20) -> list[tuple[int, str]]:
        """Return numbers and reasons of unsuccessful points.

        Numbers from 1, of failed and partial points, and of those that others are at work on.
        """
        rows = self._database.execute(
            "SELECT number + 1, reason FROM points WHERE reason != '' ORDER BY number LIMIT ?", (most,)
        )
        return [(int(number), str(reason)) for number, reason in rows]

    def pending(self, retry: bool = False) -> list[tuple[int, tuple[str, ...]]]:
        """Return numbers and changes of open points.

        With `retry` they include failed points.
        """
        states = "('pending', 'failed')" if retry else "('pending')"
        rows = self._database.execute(f"SELECT number, changes FROM points WHERE state IN {states} ORDER BY number")
        return [(int(number), tuple(json.loads(changes))) for number, changes in rows]

    def done(self) -> list[tuple[int, tuple[str, ...], tuple[float | str, ...]]]:
        """Return numbers, changes and coordinates of the points with results."""
        rows = self._database.execute(
            "SELECT number, changes, coordinates FROM points WHERE state IN ('done', 'partial') ORDER BY number"
        )
        return [(int(number), tuple(json.loads(c)), tuple(json.loads(places))) for number, c, places in rows]

    def table(self) -> StudyTable:
        """Return everything as one table."""
        study, headings = self.study, self.headings()
        rows = self._database.execute(
            "SELECT coordinates, state, reason, responses, file FROM points ORDER BY number"
        ).fetchall()
        entries = [json.loads(row[0]) for row in rows]
        answers = [json.loads(row[3]) for row in rows]
        names = [h for h in headings if h.kind == "parameter"]
        parameters = tuple(
            Column(h.name, h.unit, h.meaning, tuple(entry[place] for entry in entries)) for place, h in enumerate(names)
        )
        bands = json.loads(self.meta(BANDS) or "{}")
        responses = tuple(
            _response(h, [answer.get(h.name) for answer in answers], bands.get(h.name, []))
            for h in headings
            if h.kind == "response"
        )
        states: list[PointState] = [row[1] for row in rows]
        return StudyTable(
            study.name, self.meta("title"), study.mode, study.design.kind, parameters, responses,
            tuple(states), tuple(row[2] for row in rows), tuple(row[4] for row in rows),
        )  # fmt: skip

    # -- what the director writes --

    def add(self, points: Sequence[Point]) -> int:
        """Append points; returns the number of the first."""
        first = int(self._database.execute("SELECT count(*) FROM points").fetchone()[0])
        rows = [(first + i, json.dumps(p.changes), json.dumps(p.coordinates)) for i, p in enumerate(points)]
        with self._writing():
            self._database.executemany("INSERT INTO points (number, changes, coordinates) VALUES (?, ?, ?)", rows)
        return first

    def verify(self) -> None:
        """Read everything once; errors as :func:`readable` takes them."""
        for table in ("meta", "columns", "points"):
            for _ in self._database.execute(f"SELECT * FROM {table}"):
                pass
        self.table()
        self.pending(retry=True)
        for name in ("wall", "efficiency"):
            float(self.meta(name) or 0.0)
        json.loads(self.meta("director") or "{}")

    def find(self, point: Point) -> dict[str, Any] | None:
        """Return the point with the same changes.

        Number, state and responses, None when there is none.
        """
        row = self._database.execute(
            "SELECT number, state, responses FROM points WHERE changes = ?", (json.dumps(point.changes),)
        ).fetchone()
        return {"number": row[0], "state": row[1], "responses": json.loads(row[2])} if row else None

    def keep(self, outcomes: Sequence[Outcome]) -> None:
        """Write what became of points, in one transaction."""
        rows = [
            (o.state, o.reason, o.hash, json.dumps(dict(o.values)), o.file, o.seconds, o.number)
            for o in outcomes
            if o.state != "stopped"
        ]
        with self._writing():
            self._database.executemany(
                "UPDATE points SET state = ?, reason = ?, hash = ?, responses = ?, file = ?, seconds = seconds + ? "
                "WHERE number = ?",
                rows,
            )

    def write_meta(self, name: str, value: str) -> None:
        """Set one entry about the complete study."""
        with self._writing():
            self._database.execute("INSERT OR REPLACE INTO meta VALUES (?, ?)", (name, value))

    @contextmanager
    def _writing(self) -> Iterator[None]:
        """Write in one transaction, or say why not."""
        advice = f"; make room, then go on with: lambda-bearing study resume {self.folder}"
        with _writable(str(self.path), advice), self._database:
            yield

    @contextmanager
    def directed(self) -> Iterator[None]:
        """Mark the study as directed by this process.

        UsageError while another one does.
        """
        owner = json.loads(self.meta("director") or "{}")
        if owner and owner != this_process() and Status(process=owner).alive():
            raise UsageError(f"{self.folder} is being worked on by process {owner['pid']}: wait until it ends")
        self.write_meta("director", json.dumps(this_process()))
        try:
            yield
        finally:
            self.write_meta("director", "{}")

    def close(self) -> None:
        """Close the file."""
        self._database.close()


def _response(heading: Heading, values: Sequence[float | None], shares: Sequence[Sequence[float]]) -> Column:
    """Return a column of results.

    `shares` are the ends of its model bands over the values.
    """
    band = tuple(
        None if value is None or index >= len(shares) else (value * shares[index][0], value * shares[index][1])
        for index, value in enumerate(values)
    )
    return Column(heading.name, heading.unit, heading.meaning, tuple(values), band if shares else ())


def parameter_headings(coordinates: Sequence[Coordinate]) -> list[Heading]:
    """Return the columns of the parameters."""
    return [
        Heading("parameter", c.parameter.path, c.scale.unit if c.scale is not None else "", c.parameter.label)
        for c in coordinates
    ]
