"""Check the options that a host may change."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from lambda_core.domain.errors import CaseError, UsageError
from lambda_core.domain.units import UNITS, parse

if TYPE_CHECKING:
    from lambda_core.case.case import Case
    from lambda_core.case.machine import MachineCase

_NUMBER = re.compile(r"\s*[+-]?[\d.]+(e[+-]?\d+)?\s*", re.IGNORECASE)
_SI = {"temperature": "K"}


@dataclass(frozen=True)
class Varied:
    """One option.

    Attributes
    ----------
    path : str
        As in a case: "lubricant.temperature".
    quantity : str
        Key of :data:`lambda_core.domain.units.UNITS`; "" for a plain number.
    lowest, start, highest : float
        SI; the start is what the case says.
    """

    path: str
    quantity: str
    lowest: float
    start: float
    highest: float

    @property
    def unit(self) -> str:
        """The SI unit."""
        if not self.quantity:
            return "1"
        return _SI.get(self.quantity) or next(unit for unit, one in UNITS[self.quantity].items() if one == 1.0)

    @property
    def is_temperature(self) -> bool:
        """True for a temperature.

        A host computes it while the bearing turns.
        """
        return self.quantity == "temperature"

    def change(self, value: float) -> str:
        """Return the change that sets the value.

        It changes a case.
        """
        return f"{self.path}={value!r} {self.unit}" if self.quantity else f"{self.path}={value!r}"


def varied(texts: Iterable[str], case: Case | MachineCase) -> tuple[Varied, ...]:
    """Read ``path=low..high`` with the case's own value as the start.

    Raises
    ------
    UsageError
        When a text is not of that form, there is no such option, the case does not say it, or says a value beyond the
        limits.
    """
    written = case.written()
    found = tuple(_read(text, written, case) for text in texts)
    paths = [each.path for each in found]
    if twice := sorted({path for path in paths if paths.count(path) > 1}):
        raise UsageError(f"{twice[0]} is varied twice: give it one range")
    return found


def _read(text: str, written: Mapping[str, Any], case: Case | MachineCase) -> Varied:
    path, equals, span = text.partition("=")
    low, dots, high = span.partition("..")
    path, low, high = path.strip(), low.strip(), high.strip()
    if not (path and equals and low and dots and high):
        raise UsageError(f'"{text}": write path=low..high, for example "lubricant.temperature=20 degC..100 degC"')
    said: Any = written
    for part in path.split("."):
        said = said.get(part) if isinstance(said, Mapping) else None
    if _NUMBER.fullmatch(low):  # "20..100 degC"
        low = f"{low} {_NUMBER.sub('', high, count=1)}".strip()
    if said is None:
        _check_known(path, low, case)
    if said is None or isinstance(said, Mapping | list | bool):
        raise UsageError(f"--vary {path}: the case has no start value; add --set {path}=...")
    quantity = _quantity(path, str(low))
    if not (quantity or _NUMBER.fullmatch(str(said))):
        unit = _NUMBER.sub("", str(said), count=1).strip()
        raise UsageError(
            f"--vary {path}: the limits have no unit; the case has {said}; write {path}={low}..{high} {unit}"
        )
    lowest, highest, start = (_value(path, each, quantity) for each in (low, high, said))
    if not lowest < highest:
        raise UsageError(f"--vary {path}: the first limit ({low}) must be below the second ({high})")
    if not lowest <= start <= highest:
        raise UsageError(f"--vary {path}: the value of the case, {said}, is not between {low} and {high}")
    return Varied(path, quantity, lowest, start, highest)


def _check_known(path: str, value: str, case: Case | MachineCase) -> None:
    """Refuse an option that no case has.

    Also refuse a value that no case has. The error is a UsageError.
    """
    from lambda_core.case.case_io import apply_overrides

    try:
        apply_overrides(case, [f"{path}={value}"])
    except CaseError as error:
        for problem in error.problems:
            if f"{path}.".startswith(f"{problem.where}."):
                raise UsageError(f"--vary {path}: {problem.where} {problem.message}") from None


def _quantity(path: str, text: str) -> str:
    if _NUMBER.fullmatch(text):
        return ""
    for quantity in UNITS:  # where two have a unit in common it means the same in both
        try:
            parse(text, quantity)
        except ValueError:
            continue
        return quantity
    raise UsageError(f'--vary {path}: "{text}" is not a number with a unit')


def _value(path: str, said: object, quantity: str) -> float:
    try:
        return parse(said, quantity) if quantity else float(str(said))
    except ValueError as error:
        raise UsageError(f"{path} cannot vary: {error}") from None
