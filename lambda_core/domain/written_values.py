"""Read values of parameters in study files.

What a study varies goes into the case as text, exactly as a person would write it. So arithmetic on
ranges is done in the unit that the file uses, and whether that unit suits the option is for the case to say.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass

from lambda_core.domain.units import UNITS, from_si, misread, parse, units_of

DIGITS = 10  # significant digits of computed values: equal in every process, and read back the same
_NUMBER = re.compile(r"\s*([+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)\s*(.*?)\s*")
Value = bool | int | float | str


@dataclass(frozen=True)
class Scale:
    """Common scale of one parameter's values.

    All are read as numbers in one unit.
    """

    unit: str  # "" for plain numbers

    def text(self, number: float) -> str:
        """Return a number as it is written into a case."""
        digits = f"{number:.{DIGITS}g}"
        return f"{digits} {self.unit}" if self.unit else digits


def quantities(text: str) -> set[str]:
    """Return the possible quantities of `text`.

    `text` is a value with a unit.
    """
    found = set()
    for quantity in UNITS:
        try:
            parse(text, quantity)
        except ValueError:
            continue
        found.add(quantity)
    return found


def scale_of(values: Sequence[Value]) -> tuple[Scale, tuple[float, ...]] | None:
    """Return the values in their common unit.

    Return the unit, too; None when they are names.

    The unit is that of the first value; others are converted.

    Raises
    ------
    ValueError
        When numbers have units that do not go together, or only some have a unit.
    """
    if any(isinstance(value, bool) for value in values):
        return None
    if not any(isinstance(value, str) for value in values):
        return Scale(""), tuple(float(value) for value in values)
    matches = [_NUMBER.fullmatch(value) if isinstance(value, str) else None for value in values]
    known = [quantities(value) if isinstance(value, str) else set() for value in values]
    mistakes = [misread(value) if isinstance(value, str) else "" for value in values]
    if not any(known) and not any(mistakes):
        return None  # names
    for value, found, match, mistake in zip(values, known, matches, mistakes, strict=True):
        if not found and (mistake or match is None or not match[2]):
            raise ValueError(mistake or f'"{value}"{_mistake(str(value))}')
    common = set.intersection(*known)
    if not common:
        odd = next(value for value, found in zip(values, known, strict=True) if not found & known[0] or not known[0])
        raise ValueError(f'"{values[0]}" and "{odd}" have no unit in common')
    quantity, first = sorted(common)[0], matches[0]
    assert first is not None
    unit = first[2]
    numbers = []
    for value, match in zip(values, matches, strict=True):
        assert match is not None
        if match[2] == unit:
            numbers.append(float(match[1]))
        else:
            numbers.append(from_si(parse(value, quantity), quantity, _known_unit(unit, quantity)))
    return Scale(unit), tuple(numbers)


def _mistake(text: str) -> str:
    """Explain why a value is no number.

    It has no unit, although others have.
    """
    if text.strip().lower().lstrip("+-").startswith(("nan", "inf")):
        return " is not a finite number"
    return " has no unit, others have" if _NUMBER.fullmatch(text) else " is not a number with a unit, others are"


def _known_unit(unit: str, quantity: str) -> str:
    """Return the known spelling of a unit.

    The table of units has it.
    """
    one = parse(f"1 {unit}", quantity)
    return next(name for name in units_of(quantity) if parse(f"1 {name}", quantity) == one)


def written(value: Value) -> str:
    """Return a list's value as a case has it."""
    if isinstance(value, bool):
        return str(value).lower()
    return value if isinstance(value, str) else f"{value:.{DIGITS}g}" if isinstance(value, float) else str(value)
