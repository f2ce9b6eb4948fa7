"""Read measured operating points from a CSV file."""

from __future__ import annotations

import hashlib
import math
import re
from collections.abc import Container
from dataclasses import dataclass, field, replace
from pathlib import Path

import numpy as np

from lambda_core.analysis.band.quantities import COMMON_ERROR, ERROR, LABEL, OPERATING_POINTS, Condition, Vocabulary
from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.csv_rows import csv_rows
from lambda_core.domain.errors import CaseError, Problem, UsageError, nearest
from lambda_core.domain.files import read_text
from lambda_core.domain.units import from_si, misread, parse, units_of

_LARGEST = 16 * 2**20  # [byte] of a file
_HEADER = re.compile(r"^\s*(.*?)\s*(?:\[\s*(.*?)\s*\])?\s*$")
_ROUND = re.compile(r"^(.*?)\s*\(([^()]*)\)$")  # a unit in round brackets
_LISTED = 16  # most names that an error lists
_LONGEST, _BEGIN = 80, 20  # characters of a number, and of the part of it that an error shows
_SMALL, _BIG = 1e-15, 1e15  # sizes of numbers but 0, in their units: far beyond, squares overflow
_UTF_16 = (b"\xff\xfe", b"\xfe\xff")  # how such a file begins
_SHARE = "%"  # unit of an error as a share of the value
_OF_CONDITIONS = ("condition error", "common error")  # kinds of columns
_OF_VALUES = ("error", "share", "value common error", "value common share")


@dataclass(frozen=True)
class Measurements:
    """Measured operating points.

    Attributes
    ----------
    name, sha256 : str
        Name of the file and hash of its content.
    lines : tuple of int
        Line of the file in which each point stands.
    labels : tuple of str
        Names of the points, empty where there are none.
    conditions : dict of str to float64[:]
        Operating conditions in SI.
    set_by : dict of str to Condition
        What each of them sets.
    condition_errors : dict of str to float64[:]
        Standard deviations of what each point has of its own, in SI; absent where they are exact.
    common_errors : dict of str to float64[:]
        Standard deviations of the error of a condition that all points have in common, in SI.
    measured : dict of str to float64[:]
        Measured quantities in the units of the vocabulary; NaN where one was not measured.
    errors : dict of str to float64[:]
        Standard deviations in the same units.
    shares : dict of str to float64[:]
        Standard deviations given as shares of the value.
    common_of_values, common_shares : dict of str to float64[:]
        Standard deviations of the error that all values of a quantity have in common, likewise.
    """

    name: str
    sha256: str
    lines: tuple[int, ...]
    labels: tuple[str, ...]
    conditions: dict[str, FloatArray]
    set_by: dict[str, Condition]
    condition_errors: dict[str, FloatArray] = field(default_factory=dict)
    common_errors: dict[str, FloatArray] = field(default_factory=dict)
    measured: dict[str, FloatArray] = field(default_factory=dict)
    errors: dict[str, FloatArray] = field(default_factory=dict)
    shares: dict[str, FloatArray] = field(default_factory=dict)
    common_of_values: dict[str, FloatArray] = field(default_factory=dict)
    common_shares: dict[str, FloatArray] = field(default_factory=dict)

    def __len__(self) -> int:
        return len(self.lines)

    @property
    def count(self) -> int:
        """Number of measured values."""
        return sum(int(np.isfinite(values).sum()) for values in self.measured.values())

    @property
    def uncertain(self) -> dict[str, FloatArray]:
        """Conditions that have errors, with a size of them."""
        return self.common_errors | self.condition_errors

    @property
    def in_common(self) -> str:
        """Name of what has a common error, or ""."""
        return next(iter([*self.common_errors, *self.common_of_values, *self.common_shares]), "")

    def deviations(self, name: str) -> FloatArray | None:
        """Return the standard deviations of a quantity's values.

        They contain the common error; None where the file gives no errors.
        """
        found = [errors[name] for errors in (self.errors, self.common_of_values) if name in errors]
        sizes = np.abs(self.measured[name])
        found += [shares[name] * sizes for shares in (self.shares, self.common_shares) if name in shares]
        return np.sqrt(np.sum(np.square(found), axis=0)) if found else None

    def without(self, rows: Container[int]) -> Measurements:
        """Return the same without some points."""
        kept = [row for row in range(len(self)) if row not in rows]

        def part(columns: dict[str, FloatArray]) -> dict[str, FloatArray]:
            return {name: column[kept] for name, column in columns.items()}

        return replace(
            self,
            lines=tuple(self.lines[row] for row in kept),
            labels=tuple(self.labels[row] for row in kept),
            conditions=part(self.conditions),
            condition_errors=part(self.condition_errors),
            common_errors=part(self.common_errors),
            measured=part(self.measured),
            errors=part(self.errors),
            shares=part(self.shares),
            common_of_values=part(self.common_of_values),
            common_shares=part(self.common_shares),
        )

    def equal_lines(self) -> list[tuple[int, ...]]:
        """Return the lines of points that agree in every column."""
        groups = (
            self.conditions, self.condition_errors, self.common_errors, self.measured, self.errors, self.shares,
            self.common_of_values, self.common_shares,
        )  # fmt: skip
        columns = [column.tolist() for group in groups for column in group.values()]
        found: dict[tuple[object, ...], list[int]] = {}
        for row, line in enumerate(self.lines):
            numbers = (None if math.isnan(column[row]) else column[row] for column in columns)
            found.setdefault((self.labels[row], *numbers), []).append(line)
        return [tuple(lines) for lines in found.values() if len(lines) > 1]


@dataclass(frozen=True)
class _Column:
    """One column with name and unit.

    It holds a condition or a quantity.
    """

    kind: str  # "condition", "measured", "label", or one of _OF_CONDITIONS and _OF_VALUES
    name: str
    unit: str
    quantity: str
    header: str
    condition: Condition | None = None


def read_measurements(path: str | Path, words: Vocabulary = OPERATING_POINTS) -> Measurements:
    """Read measured operating points.

    The first line names the columns with their units, for example ``speed [1/min]``. A column whose name ends in
    ``error`` holds standard deviations, in a unit or in %. Lines that start with # are comments.

    Parameters
    ----------
    path : path-like
        CSV file in UTF-8.
    words : Vocabulary
        Names of columns; by default those of operating points of a bearing.

    Raises
    ------
    UsageError
        When there is no such file.
    CaseError
        With every mistake of the file, its line and column, and what to write instead.
    """
    file = Path(path)
    try:
        text = read_text(file, _LARGEST)
    except UnicodeDecodeError as error:
        line = error.object.count(b"\n", 0, error.start) + 1
        what = "is text in UTF-16" if error.object[:2] in _UTF_16 else "has a character that is not UTF-8"
        raise CaseError(file.name, [Problem(f"line {line}", f"{what}: save the file as CSV in UTF-8")]) from None
    except OSError as error:
        raise UsageError(f'cannot read "{file}": {error.strerror}') from None
    return parse_measurements(text, file.name, words)


def parse_measurements(text: str, name: str, words: Vocabulary = OPERATING_POINTS) -> Measurements:
    """Read measured operating points from text; CaseError with every mistake."""
    rows, mistakes = csv_rows(text)
    problems = [Problem(f"line {line}", why) for line, why in mistakes]
    if problems or not rows:
        raise CaseError(name, problems or [Problem("line 1", f"is empty: write a header, for example {words.example}")])
    (head, header), *body = rows
    columns = _columns(head, header, problems, words)
    if not body:
        problems.append(Problem(f"line {head}", "no measured point follows the header"))
    if len(body) > words.most:
        problems.append(Problem(f"line {body[words.most][0]}", f"has more than {words.most} points: average them"))
    if problems:
        raise CaseError(name, problems)
    table = [_values(line, cells, columns, problems, words) for line, cells in body]
    if problems:
        raise CaseError(name, problems)
    return _measurements(name, text, [line for line, _ in body], columns, table, problems)


def _columns(line: int, header: list[str], problems: list[Problem], words: Vocabulary) -> list[_Column]:
    """Return what the columns hold."""
    found: list[_Column] = []
    for number, text in enumerate(header, 1):
        where = f"line {line}, column {number}"
        column = _column(text, where, problems, words)
        if column is None:
            continue
        if any((column.kind, column.name) == (other.kind, other.name) for other in found):
            problems.append(Problem(where, f'"{column.name}" appears twice: remove or rename one of the columns'))
        elif same := next((other for other in found if _sets_the_same(column, other)), None):
            problems.append(Problem(where, f'"{column.name}" sets what "{same.name}" sets: keep one of them'))
        found.append(column)
    if problems:
        return found
    names = {(column.kind, column.name) for column in found}
    if not any(kind == "measured" for kind, _ in names):
        listed = ", ".join(words.measured)
        problems.append(Problem(f"line {line}", f"has no measured quantity: add a column named {listed}"))
    for column in found:
        owner = "measured" if column.kind in _OF_VALUES else "condition"
        if column.kind in (*_OF_VALUES, *_OF_CONDITIONS) and (owner, column.name) not in names:
            problems.append(Problem(f"line {line}", f'"{column.header}" has no column "{column.name}" it belongs to'))
    for end, kinds in ((ERROR, _OF_VALUES[:2]), (COMMON_ERROR, _OF_VALUES[2:])):
        one, other = ({name for kind, name in names if kind == own} for own in kinds)
        problems += [
            Problem(f"line {line}", f'"{name}{end}" has two columns: keep one') for name in sorted(one & other)
        ]
    return found


def _sets_the_same(one: _Column, other: _Column) -> bool:
    """Tell whether two columns set one option."""
    if one.condition is None or other.condition is None or one.kind != other.kind:
        return False
    return one.condition.path == other.condition.path != ""


def _column(text: str, where: str, problems: list[Problem], vocabulary: Vocabulary) -> _Column | None:
    """Return what one column holds, None after a mistake."""
    measured = vocabulary.measured
    match = _HEADER.match(text)
    written, unit = (match[1], match[2]) if match else ("", None)
    words = written.casefold()
    if not words:
        problems.append(Problem(where, "has no name: name the column, or remove its commas from every line"))
        return None
    if words == LABEL:
        return _Column("label", LABEL, "", "", text)
    end = next((end for end in (COMMON_ERROR, ERROR) if words.endswith(end)), "")
    is_error, is_common, name = bool(end), end == COMMON_ERROR, words.removesuffix(end)
    condition = vocabulary.condition(name, unit or "")
    if condition is None and "." in name:  # the path of an option; names in it may have capitals
        name = written[: len(written) - len(end)]
        condition = vocabulary.condition(name, unit or "")
    if condition is None and name not in measured:
        known = [*vocabulary.conditions, *measured]
        close = nearest(name, known)
        names = f"nearest: {', '.join(close)}" if close else f"allowed: {', '.join(known[:_LISTED])}"
        if plain := _ROUND.match(written):
            names = f'write the unit in square brackets: "{plain[1]} [{plain[2]}]"'
        shown = text if len(text) <= _LONGEST else f"{text[:_BEGIN]}..."
        if why := vocabulary.why_not(name):
            problems.append(Problem(where, f'"{shown}": {why}'))
            return None
        problems.append(Problem(where, f'"{shown}" is not a known column; {names}'))
        return None
    if condition is not None:
        quantity = condition.error_quantity if is_error else condition.quantity
    else:
        quantity = measured[name].error_quantity if is_error else measured[name].quantity
    units = units_of(quantity)
    if unit is None:
        first = next(iter(units))
        problems.append(
            Problem(where, f'"{text}" has no unit: write "{words} [{first}]" (allowed: {", ".join(units)})')
        )
        return None
    if unit == _SHARE and is_error and condition is None:
        if quantity != measured[name].quantity:
            problems.append(
                Problem(where, f'"{text}": the error of a temperature must have a unit: write "{words} [K]"')
            )
            return None
        return _Column(_OF_VALUES[1 + 2 * is_common], name, unit, "", text)
    try:
        parse(f"1 {unit}", quantity)
    except ValueError as error:
        problems.append(Problem(where, f'"{text}": {str(error).split(": ", 1)[-1]}'))
        return None
    of_values, of_conditions = _OF_VALUES[2 * is_common], _OF_CONDITIONS[is_common]
    kinds = ("measured", of_values) if condition is None else ("condition", of_conditions)
    return _Column(kinds[is_error], name, unit, quantity, text, condition)


def _values(
    line: int, cells: list[str], columns: list[_Column], problems: list[Problem], words: Vocabulary
) -> list[float | str]:
    """Return the values of one line."""
    if len(cells) != len(columns):
        comma = (
            "; write decimal points, not commas" if len(cells) > len(columns) else "; leave a cell empty between commas"
        )
        problems.append(Problem(f"line {line}", f"has {len(cells)} cells, the header {len(columns)}{comma}"))
        return []
    missing = {
        column.name for cell, column in zip(cells, columns, strict=True) if column.kind == "measured" and not cell
    }
    return [
        math.nan
        if not cell and column.kind in _OF_VALUES and column.name in missing
        else _value(f"line {line}, column {n}", cell, column, problems, words)
        for n, (cell, column) in enumerate(zip(cells, columns, strict=True), 1)
    ]


def _value(where: str, cell: str, column: _Column, problems: list[Problem], words: Vocabulary) -> float | str:
    """Return one value in its unit.

    A condition in SI, a measured quantity in the unit in which it is fitted.
    """
    if column.kind == "label":
        return cell
    if not cell:
        if column.kind != "measured":
            problems.append(Problem(where, f'"{column.header}" is empty: write a number or remove the line'))
        return math.nan
    try:
        if len(cell) > _LONGEST:
            raise ValueError(f'"{cell[:_BEGIN]}..." has {len(cell)} characters: a number has at most {_LONGEST}')
        if mistake := misread(cell):
            raise ValueError(mistake)
        if "_" in cell:  # Python's own separator of digits
            raise ValueError("could not convert")
        number = float(cell)
        if not math.isfinite(number):
            raise ValueError(f'"{cell}" is not a finite number')
        if number and not _SMALL <= abs(number) <= _BIG:
            raise ValueError(f'"{cell}": a number other than 0 lies between {_SMALL:g} and {_BIG:g} in size')
        if column.kind in (*_OF_VALUES, *_OF_CONDITIONS) and number <= 0.0:
            raise ValueError(f'"{cell}": an error must be above zero')
        if column.kind == "measured" and number < 0.0 and not _may_be_negative(column, words):
            raise ValueError(f'"{cell}": must be 0 or above, whatever the sense of rotation')
        if column.quantity == "":
            return number / 100.0
        value = parse(f"{cell} {column.unit}", column.quantity)
    except ValueError as error:
        message = str(error)
        if message.startswith("could not convert"):
            message = f'"{cell}" is not a number: write it without quotes, units or words'
        problems.append(Problem(where, f"{column.header}: {message}"))
        return math.nan
    if column.condition is not None:
        return value
    known = words.measured[column.name]
    return from_si(value, column.quantity, known.unit if column.kind == "measured" else known.error_unit)


def _may_be_negative(column: _Column, words: Vocabulary) -> bool:
    return column.quantity == "temperature" or words.measured[column.name].is_signed


def _measurements(
    name: str,
    text: str,
    lines: list[int],
    columns: list[_Column],
    table: list[list[float | str]],
    problems: list[Problem],
) -> Measurements:
    """Put the columns together."""
    labels = tuple("" for _ in lines)
    groups: dict[str, dict[str, FloatArray]] = {
        kind: {} for kind in ("condition", *_OF_CONDITIONS, "measured", *_OF_VALUES)
    }
    for index, column in enumerate(columns):
        cells = [row[index] for row in table]
        if column.kind == "label":
            labels = tuple(str(cell) for cell in cells)
        else:
            groups[column.kind][column.name] = np.array(cells, dtype=np.float64)
    known = np.isfinite(np.column_stack(list(groups["measured"].values()))).sum(axis=1).tolist()
    problems += [
        Problem(f"line {line}", "has no measured value: fill one in or remove the line")
        for line, count in zip(lines, known, strict=True)
        if not count
    ]
    if problems:
        raise CaseError(name, problems)
    return Measurements(
        name,
        hashlib.sha256(text.encode()).hexdigest(),
        tuple(lines),
        labels,
        groups["condition"],
        {column.name: column.condition for column in columns if column.kind == "condition" and column.condition},
        groups["condition error"],
        groups["common error"],
        groups["measured"],
        *(groups[kind] for kind in _OF_VALUES),
    )
