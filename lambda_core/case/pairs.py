"""Read tables of two columns from cases or CSV files.

Loads, speeds, motions and voltages over time and temperatures along a shaft are such tables. The first column rises.
Before the first pair and behind the last one a value stays what it is there.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path

from lambda_core.domain.csv_rows import csv_rows
from lambda_core.domain.files import read_text
from lambda_core.domain.units import parse

Points = tuple[tuple[float, float], ...]
_MOST, _LARGEST = 100_000, 16 * 2**20  # pairs, byte of a file
_HEADER = re.compile(r"^\s*(.*?)\s*\[\s*(.*?)\s*\]\s*$")


@dataclass(frozen=True)
class Pairs:
    """Pairs of a table in SI, and where each stands."""

    points: Points
    name: str  # of the table, for people
    word: str  # "line" of a file, "entry" of a case
    numbers: Sequence[int]

    def where(self, index: int) -> str:
        """Name the place of a pair."""
        return f"{self.name} {self.word} {self.numbers[index]}"


def given_pairs(points: Sequence[tuple[float, float]] | None, file: str | None, quantity: str, folder: Path) -> Pairs:
    """Return the pairs of a case or its file.

    Parameters
    ----------
    points : sequence of (float, float), optional
        Time [s] and value [SI].
    file : str, optional
        Name of a CSV file, relative to `folder`; one of both is given.
    quantity : str
        Of the values.

    Raises
    ------
    ValueError
        With a sentence that names the entry or the line.
    """
    if (points is None) == (file is None):
        raise ValueError("give either `points` or `file`")
    if points is None:
        return read_pairs(folder / str(file), quantity)
    if len(points) > _MOST:
        raise ValueError(f"{len(points)} points, at most {_MOST}")
    return rising(Pairs(tuple(points), '"points"', "entry", range(1, len(points) + 1)), "times")


def rising(pairs: Pairs, what: str) -> Pairs:
    """Return pairs whose first column rises.

    ValueError with the first that does not.
    """
    for index, ((before, _), (after, _)) in enumerate(pairwise(pairs.points), 1):
        if after <= before:
            raise ValueError(f"{pairs.where(index)}: the {what} must increase")
    return pairs


def read_pairs(path: Path, quantity: str) -> Pairs:
    """Read a CSV file of time and value.

    The header names both columns with their units in brackets.

    Raises
    ------
    ValueError
        With a sentence that names the file and the line.
    """
    try:
        rows, mistakes = csv_rows(read_text(path, _LARGEST))
    except (OSError, UnicodeDecodeError) as error:
        reason = error.strerror if isinstance(error, OSError) else "is not UTF-8 text"
        raise ValueError(f'cannot read "{path}": {reason}') from None
    if mistakes:
        raise ValueError(f'"{path}" line {mistakes[0][0]} {mistakes[0][1]}')
    headers = [_HEADER.match(cell) for cell in rows[0][1]] if rows else []
    if len(headers) != 2 or headers[0] is None or headers[1] is None:
        raise ValueError(f'"{path}": the first line must name both columns with units, like "time [s],value [N]"')
    units = (headers[0][2], headers[1][2])
    if len(rows) > _MOST + 1:
        raise ValueError(f'"{path}" has {len(rows) - 1} points: at most {_MOST}')
    found = []
    for line, cells in rows[1:]:
        if len(cells) != 2:
            raise ValueError(f'"{path}" line {line}: expected two columns, found {len(cells)}')
        try:
            found.append((parse(f"{cells[0]} {units[0]}", "time"), parse(f"{cells[1]} {units[1]}", quantity)))
        except ValueError as error:
            raise ValueError(f'"{path}" line {line}: {error}') from None
    return rising(Pairs(tuple(found), f'"{path}"', "line", [line for line, _ in rows[1:]]), "times")
