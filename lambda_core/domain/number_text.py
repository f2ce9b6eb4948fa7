"""Format numbers for readers."""

from __future__ import annotations

import math
from collections.abc import Sequence

NONE = "-"  # stands where there is no number
_LEAST_BAND = 1e-2  # of a number: no model knows more than four digits of it
_LEAST_SWING = 1e-3  # of a mean: a smaller swing does not round it
_NOTHING = 5e-5  # of any unit of the interface: smaller numbers are zeros of the computation
LONG_LIFE = 1e6  # beyond, a rating life says no more than that [h]


def number(value: float | None, digits: int = 1) -> str:
    """Write a number with `digits` decimals.

    It has groups of three; a dash for none.
    """
    if value is None or not math.isfinite(value):
        return NONE
    return f"{round(value, digits) + 0.0:,.{digits}f}".replace(",", " ")  # + 0.0 turns -0.0 into 0.0


def digits(value: float | None, count: int = 4) -> str:
    """Write a number with some significant digits."""
    return NONE if value is None else f"{0.0 if abs(value) < _NOTHING else value:.{count}g}"


def counted(count: int, thing: str) -> str:
    """Write a count with its noun.

    The plural ends with s.
    """
    return f"{count} {thing}{'' if count == 1 else 's'}"


def percent(value: float) -> str:
    """Write a percentage to two digits without an exponent."""
    short = float(f"{value:.2g}")
    return f"{short:g} %" if abs(short) < 1000.0 else f"{number(short, 0)} %"


def hours(life: float) -> str:
    """Write a rating life to two digits.

    Its scatter is a decade.
    """
    return f"{number(float(f'{life:.2g}'), 0)} h" if life < LONG_LIFE else f"above {number(LONG_LIFE, 0)} h"


def hours_alone(life: float | None) -> str:
    """Write a rating life without its unit.

    The head of the column has the unit; a dash for none.
    """
    return NONE if life is None else hours(life).removesuffix(" h")


def plus_minus(value: float | None, half_width: float | None) -> str:
    """Write a mean with its confidence.

    It has two digits of the latter.
    """
    if value is None or half_width is None or half_width <= 0.0:
        return number(value)
    digits = max(0, 1 - math.floor(math.log10(half_width)))
    return f"{number(value, digits)} ± {number(half_width, digits)}"


def swinging(mean: float, swing: float) -> str:
    """Write a mean with its swing.

    Both have the decimals that two digits of the swing need. A swing below a thousandth of the mean does not round it.
    """
    if swing >= max(_LEAST_SWING * abs(mean), _NOTHING):
        return plus_minus(mean, swing)
    return f"{digits(mean)} ± {digits(swing, 2)}"


def interval(values: Sequence[float], digits: int) -> str:
    """Write a smallest and a largest number as 0.51..0.74."""
    if not values:
        return NONE
    return f"{number(values[0], digits)}..{number(values[1], digits)}"


def digits_of_band(half_width: float, value: float) -> int:
    """Return the meaningful decimals of a number.

    Its band leaves two digits of the half-width, four in all.
    """
    if not half_width > 0.0 or not math.isfinite(half_width):
        return 3
    return 1 - math.floor(math.log10(max(half_width, _LEAST_BAND * abs(value))))


def rounded(value: float, half_width: float) -> str:
    """Write a number to its meaningful digits.

    Its band decides them.
    """
    digits = digits_of_band(half_width, value)
    return number(round(value, digits), max(digits, 0))
