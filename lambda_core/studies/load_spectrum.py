"""Read a load spectrum from a CSV file.

The first line names the columns: ``time [s]``, options of the case with their units (``gears.wheel.power [kW]``,
``operation.speed [rpm]``, ``loads.belt.force_z [N]``), and perhaps ``name``. An empty cell leaves the option as the
case has it. Cells are separated as :mod:`lambda_core.domain.csv_rows` says.
"""

from __future__ import annotations

import math
import re
from dataclasses import dataclass
from pathlib import Path

from lambda_core.domain.csv_rows import csv_rows
from lambda_core.domain.errors import CaseError, Problem, UsageError
from lambda_core.domain.files import read_text
from lambda_core.domain.units import parse

_COLUMN = re.compile(r"\s*([^\[\]]+?)\s*(?:\[\s*([^\[\]]*?)\s*\])?\s*")
_MOST_PROBLEMS = 20
TIME, NAME = "time", "name"


@dataclass(frozen=True)
class SpectrumLine:
    """One line of a load spectrum."""

    number: int  # of the line in the file
    name: str
    time: float  # [s]
    changes: dict[str, str]


@dataclass(frozen=True)
class _Column:
    path: str
    unit: str


def read_spectrum(path: Path) -> list[SpectrumLine]:
    """Return the lines of a load spectrum.

    Raises
    ------
    UsageError
        When the file cannot be read.
    CaseError
        With every mistake and the line that it stands in.
    """
    try:
        rows, mistakes = csv_rows(read_text(path))
    except UnicodeDecodeError:
        raise CaseError(path.name, [Problem("", "is not a text file in UTF-8")]) from None
    except OSError as error:
        raise UsageError(f'cannot read the load spectrum "{path}": {error.strerror}') from None
    if len(rows) < 2 and not mistakes:
        raise CaseError(path.name, [Problem("", "needs a line that names the columns, and one line per phase")])
    found = [Problem(f"line {number}", why) for number, why in mistakes]
    columns = _columns(*rows[0], found) if rows and not found else []
    read = [_line(number, cells, columns, found) for number, cells in rows[1:]] if columns else []
    if found:
        more = [Problem("", f"and {len(found) - _MOST_PROBLEMS} more mistakes")] if len(found) > _MOST_PROBLEMS else []
        raise CaseError(path.name, [*found[:_MOST_PROBLEMS], *more])
    return [line for line in read if line is not None]


def _columns(number: int, cells: list[str], found: list[Problem]) -> list[_Column]:
    """Return the meanings of the columns.

    Mistakes come into `found`, and nothing is returned.
    """
    where = f"line {number}"
    matches = [_COLUMN.fullmatch(cell) for cell in cells]
    if not all(matches):
        found.append(Problem(where, 'name every column by an option and its unit, like "operation.speed [rpm]"'))
        return []
    columns = [_Column(match[1], match[2] or "") for match in matches if match is not None]
    paths = [column.path for column in columns]
    found += [Problem(where, f"names {path} twice") for path in dict.fromkeys(paths) if paths.count(path) > 1]
    if TIME not in paths:
        found.append(Problem(where, 'needs a column "time [s]": how long each phase lasts in one cycle'))
    elif not next(column.unit for column in columns if column.path == TIME):
        found.append(Problem(where, 'the column time needs a unit, like "time [s]"'))
    return [] if found else columns


def _line(number: int, cells: list[str], columns: list[_Column], found: list[Problem]) -> SpectrumLine | None:
    """Return one phase.

    None where the line has mistakes, which come into `found`.
    """
    before = len(found)
    if len(cells) != len(columns):
        found.append(Problem(f"line {number}", f"has {len(cells)} cells, and there are {len(columns)} columns"))
        return None
    name, time, changes = f"line {number}", math.nan, {}
    for column, cell in zip(columns, cells, strict=True):
        where = f"line {number}, {column.path}"
        if column.path == NAME:
            name = cell or name
        elif column.path == TIME:
            time = _time(cell, column.unit, where, found)
        elif cell:
            if column.unit and not _is_number(cell):
                found.append(Problem(where, f'"{cell}" is not a finite number'))
            changes[column.path] = f"{cell} {column.unit}".rstrip()
    return None if len(found) > before else SpectrumLine(number, name, time, changes)


def _time(cell: str, unit: str, where: str, found: list[Problem]) -> float:
    """Return how long a phase lasts [s]."""
    try:
        value = parse(f"{cell} {unit}", TIME)
    except ValueError as error:
        found.append(Problem(where, str(error)))
        return math.nan
    if not value > 0.0:
        found.append(Problem(where, f'"{cell}" must be greater than 0'))
    return value


def _is_number(cell: str) -> bool:
    try:
        return math.isfinite(float(cell))
    except ValueError:
        return False
