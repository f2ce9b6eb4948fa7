"""Define the unit systems of printed numbers.

Files, JSON and everything inside stay as they are; only what is printed or drawn is put into other units.
"""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from dataclasses import dataclass, field

from lambda_core.domain.errors import UsageError, unknown_name
from lambda_core.domain.number_text import interval, number, plus_minus
from lambda_core.domain.units import FOOT, HORSEPOWER, INCH, POUND, POUND_FORCE, PSI

# unit of the program -> unit that is shown, size of the first in the second, what is added
_US: dict[str, tuple[str, float, float]] = {
    "mm": ("in", 1e-3 / INCH, 0.0),
    "um": ("uin", 1.0 / INCH, 0.0),
    "m/s": ("ft/s", 1.0 / FOOT, 0.0),
    "N": ("lbf", 1.0 / POUND_FORCE, 0.0),
    "kN": ("lbf", 1e3 / POUND_FORCE, 0.0),
    "N m": ("lbf in", 1.0 / (POUND_FORCE * INCH), 0.0),
    "N mm": ("lbf in", 1e-3 / (POUND_FORCE * INCH), 0.0),
    "N m/mrad": ("lbf in/mrad", 1.0 / (POUND_FORCE * INCH), 0.0),
    "N/um": ("lbf/in", 1e6 * INCH / POUND_FORCE, 0.0),
    "N s/m": ("lbf s/in", INCH / POUND_FORCE, 0.0),
    "N m s/rad": ("lbf in s/rad", 1.0 / (POUND_FORCE * INCH), 0.0),
    "MPa": ("ksi", 1e3 / PSI, 0.0),
    "GPa": ("ksi", 1e6 / PSI, 0.0),
    "kg": ("lb", 1.0 / POUND, 0.0),
    "g": ("lb", 1e-3 / POUND, 0.0),
    "W": ("hp", 1.0 / HORSEPOWER, 0.0),
    "kW": ("hp", 1e3 / HORSEPOWER, 0.0),
    "mm2/s": ("cSt", 1.0, 0.0),
    "degC": ("degF", 1.8, 32.0),
}
_NUMBER = r"[+-]?\d[\d ]*\d(?:\.\d+)?|[+-]?\d(?:\.\d+)?"
_JOINED = r" to |\.\.| ± "  # what stands between two numbers of one unit


@dataclass(frozen=True)
class UnitSystem:
    """One way to show numbers.

    Parameters
    ----------
    name : str
        ``si`` or ``us``.
    shown : mapping
        Unit of the program to the unit shown, the factor and what is added.
    """

    name: str
    shown: Mapping[str, tuple[str, float, float]] = field(default_factory=dict)

    def unit(self, unit: str) -> str:
        """Return the displayed unit of a number in `unit`."""
        return self.shown.get(unit, (unit,))[0]

    def scale(self, unit: str) -> tuple[float, float]:
        """Return factor and offset of a number in `unit`.

        The number is multiplied first.
        """
        _, factor, offset = self.shown.get(unit, (unit, 1.0, 0.0))
        return factor, offset

    def value(self, value: float, unit: str) -> float:
        """Return a number in `unit` in displayed units."""
        factor, offset = self.scale(unit)
        return value * factor + offset

    def number(self, value: float | None, unit: str, digits: int = 1) -> str:
        """Write a number in `unit` without it.

        It is about as fine as `digits` decimals of it; a dash stands for none.
        """
        return number(None if value is None else self.value(value, unit), self._digits(unit, digits))

    def text(self, value: float | None, unit: str, digits: int = 1) -> str:
        """Write a number with its unit."""
        return f"{self.number(value, unit, digits)} {self.unit(unit)}"

    def interval(self, values: list[float], unit: str, digits: int) -> str:
        """Write a smallest and a largest number, with the unit."""
        return f"{interval([self.value(v, unit) for v in values], self._digits(unit, digits))} {self.unit(unit)}"

    def plus_minus(self, value: float | None, half_width: float | None, unit: str) -> str:
        """Write a mean with its confidence and unit."""
        factor, _ = self.scale(unit)
        mean = None if value is None else self.value(value, unit)
        if value is not None and not half_width:
            return self.text(value, unit)
        return f"{plus_minus(mean, None if half_width is None else factor * half_width)} {self.unit(unit)}"

    def sentence(self, text: str) -> str:
        """Return a sentence with its numbers in other units.

        Only numbers with a unit change: "2.5 kN", "15 to 33 um".
        """
        if not self.shown:
            return text
        units = "|".join(map(re.escape, sorted(self.shown, key=len, reverse=True)))
        found = re.compile(rf"(?<![\w.])({_NUMBER})(?:({_JOINED})({_NUMBER}))? ({units})(?![\w/]| (?:m|mm|s|K)\b)")
        return found.sub(self._converted, text)

    def _converted(self, match: re.Match[str]) -> str:
        first, joint, second, unit = match.groups()
        slope = UnitSystem(self.name, {unit: (self.unit(unit), self.shown[unit][1], 0.0)})
        half_width = (slope if joint == " ± " else self)._plain(second, unit) if second else ""
        return f"{self._plain(first, unit)}{joint or ''}{half_width} {self.unit(unit)}"

    def _plain(self, written: str, unit: str) -> str:
        """Convert a written number.

        It keeps its number of digits, at least three.
        """
        plain = written.replace(" ", "")
        digits = max(3, len(plain.lstrip("+-").replace(".", "").lstrip("0")))
        value = self.value(float(plain), unit)
        shown = f"{value:.{digits}g}"
        return f"{float(shown):.0f}" if "e" in shown and abs(value) >= 1.0 else shown

    def _digits(self, unit: str, digits: int) -> int:
        factor, _ = self.scale(unit)
        return max(0, digits - round(math.log10(factor)))


SI = UnitSystem("si")
US = UnitSystem("us", _US)
SYSTEMS = {system.name: system for system in (SI, US)}


def unit_system(name: str) -> UnitSystem:
    """Return a system of units by name.

    Raises
    ------
    UsageError
        When there is none of that name.
    """
    if name not in SYSTEMS:
        raise UsageError(unknown_name("system of units", name, SYSTEMS))
    return SYSTEMS[name]
