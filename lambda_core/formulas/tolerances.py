"""Tabulate limits of size of ISO 286 and ISO 492.

The tables hold classes of shafts and housings, and normal tolerances of bearings, 3 to 500 mm.

Deviations in metres from the nominal size. The tables hold ISO 286-1's standard tolerances and fundamental
deviations in micrometres; holes K to P follow the standard's rule ES = -ei + Delta, Delta = IT_n - IT_(n-1).
"""

from __future__ import annotations

import re
from bisect import bisect_left
from dataclasses import dataclass

from lambda_core.domain.errors import nearest

_UM = 1e-6

# Upper ends of the diameter steps [mm]; the first step starts above 0.
_STEPS = (3, 6, 10, 18, 30, 50, 80, 120, 180, 250, 315, 400, 500)
# ISO 286-1, table 1 [um]
_IT = {
    4: (3, 4, 4, 5, 6, 7, 8, 10, 12, 14, 16, 18, 20),
    5: (4, 5, 6, 8, 9, 11, 13, 15, 18, 20, 23, 25, 27),
    6: (6, 8, 9, 11, 13, 16, 19, 22, 25, 29, 32, 36, 40),
    7: (10, 12, 15, 18, 21, 25, 30, 35, 40, 46, 52, 57, 63),
    8: (14, 18, 22, 27, 33, 39, 46, 54, 63, 72, 81, 89, 97),
}
# ISO 286-1, tables 4 and 5: fundamental deviations of shafts [um]: upper for f, g, h; lower for j to p
_SHAFT = {
    "f": (-6, -10, -13, -16, -20, -25, -30, -36, -43, -50, -56, -62, -68),
    "g": (-2, -4, -5, -6, -7, -9, -10, -12, -14, -15, -17, -18, -20),
    "h": (0,) * 13,
    "j": (-2, -2, -2, -3, -4, -5, -7, -9, -11, -13, -16, -18, -20),
    "k": (0, 1, 1, 1, 2, 2, 2, 3, 3, 4, 4, 4, 5),
    "m": (2, 4, 6, 7, 8, 9, 11, 13, 15, 17, 20, 21, 23),
    "n": (4, 8, 10, 12, 15, 17, 20, 23, 27, 31, 34, 37, 40),
    "p": (6, 12, 15, 18, 22, 26, 32, 37, 43, 50, 56, 62, 68),
}
_HOLE_J = {
    6: (2, 5, 5, 6, 8, 10, 13, 16, 18, 22, 25, 29, 33),
    7: (4, 6, 8, 10, 12, 14, 18, 22, 26, 30, 36, 39, 43),
}
SHAFT_CLASSES = tuple(
    f"{letter}{grade}"
    for letter, grades in (
        ("f", (5, 6, 7)),
        ("g", (5, 6, 7)),
        ("h", (5, 6, 7, 8)),
        ("j", (5, 6)),
        ("js", (5, 6, 7)),
        ("k", (5, 6, 7)),
        ("m", (5, 6, 7)),
        ("n", (5, 6, 7)),
        ("p", (5, 6, 7)),
    )
    for grade in grades
)
HOUSING_CLASSES = tuple(
    f"{letter}{grade}"
    for letter, grades in (
        ("F", (6, 7, 8)),
        ("G", (6, 7)),
        ("H", (5, 6, 7, 8)),
        ("J", (6, 7)),
        ("JS", (5, 6, 7)),
        ("K", (6, 7)),
        ("M", (6, 7)),
        ("N", (6, 7)),
        ("P", (6, 7)),
    )
    for grade in grades
)
# ISO 492, normal class, radial bearings: upper deviation 0, lower deviation [um] up to a diameter [mm]
_BORE = (
    (18, -8),
    (30, -10),
    (50, -12),
    (80, -15),
    (120, -20),
    (180, -25),
    (250, -30),
    (315, -35),
    (400, -40),
    (500, -45),
)
_OUTSIDE = (
    (18, -8),
    (30, -9),
    (50, -11),
    (80, -13),
    (120, -15),
    (150, -18),
    (180, -25),
    (250, -30),
    (315, -35),
    (400, -40),
    (500, -45),
    (630, -50),
)


@dataclass(frozen=True)
class Limits:
    """A tolerated quantity: its limits [m]."""

    minimum: float
    maximum: float

    def __post_init__(self) -> None:
        if self.minimum > self.maximum:
            raise ValueError(f"limits are in the wrong order: {self.minimum:g} above {self.maximum:g}")

    @property
    def middle(self) -> float:
        """Middle of the two limits [m]."""
        return 0.5 * (self.minimum + self.maximum)


def _step(diameter: float) -> int:
    size = round(diameter * 1e3, 9)
    if not 0.0 < size <= _STEPS[-1]:
        raise ValueError(f"ISO 286 classes are tabulated up to {_STEPS[-1]} mm, not for {size:g} mm")
    return bisect_left(_STEPS, size)


def _split(tolerance_class: str, known: tuple[str, ...], what: str) -> tuple[str, int]:
    if tolerance_class not in known:
        close = nearest(tolerance_class, known)
        hint = f"; nearest: {', '.join(close)}" if close else ""
        raise ValueError(f'"{tolerance_class}" is not a known {what} class{hint} (known: {", ".join(known)})')
    match = re.fullmatch(r"([A-Za-z]+)(\d+)", tolerance_class)
    assert match is not None
    return match[1], int(match[2])


def shaft_deviations(diameter: float, tolerance_class: str) -> Limits:
    """Return the limit deviations of a shaft [m].

    They are (ei, es) of a shaft of `diameter` [m], for example ``"k5"`` (ISO 286-1).

    Raises
    ------
    ValueError
        For an unknown class (with the nearest) or a diameter outside the table.
    """
    letter, grade = _split(tolerance_class, SHAFT_CLASSES, "shaft")
    step = _step(diameter)
    width = _IT[grade][step]
    if letter == "js":
        return Limits(-0.5 * width * _UM, 0.5 * width * _UM)
    deviation = _SHAFT[letter][step]
    lower = deviation - width if letter in "fgh" else deviation
    return Limits(lower * _UM, (lower + width) * _UM)


def housing_deviations(diameter: float, tolerance_class: str) -> Limits:
    """Return the limit deviations of a housing [m].

    They are (EI, ES) of a bore of `diameter` [m], for example ``"H7"`` (ISO 286-1).

    Raises
    ------
    ValueError
        For an unknown class (with the nearest) or a diameter outside the table.
    """
    letter, grade = _split(tolerance_class, HOUSING_CLASSES, "housing")
    step = _step(diameter)
    width = _IT[grade][step]
    if letter == "JS":
        return Limits(-0.5 * width * _UM, 0.5 * width * _UM)
    if letter in "FGH":
        lower = -_SHAFT[letter.lower()][step]
        return Limits(lower * _UM, (lower + width) * _UM)
    upper = _HOLE_J[grade][step] if letter == "J" else _upper_of_tight_hole(letter, grade, step)
    return Limits((upper - width) * _UM, upper * _UM)


def _upper_of_tight_hole(letter: str, grade: int, step: int) -> int:
    """Return ES of holes K to P [um].

    It is -ei + IT_n - IT_(n-1), and -ei up to 3 mm; M6 of 250 to 315 mm is -9 by exception.
    """
    if letter == "M" and grade == 6 and _STEPS[step] == 315:
        return -9
    delta = 0 if step == 0 else _IT[grade][step] - _IT[grade - 1][step]
    return delta - _SHAFT[letter.lower()][step]


def _normal_class(diameter: float, table: tuple[tuple[int, int], ...], what: str) -> Limits:
    size = round(diameter * 1e3, 9)
    for limit, lower in table:
        if 0.0 < size <= limit:
            return Limits(lower * _UM, 0.0)
    raise ValueError(
        f"the normal tolerance of a bearing's {what} is tabulated up to {table[-1][0]} mm, not for {size:g} mm"
    )


def bore_deviations(bore_diameter: float) -> Limits:
    """Return the limit deviations of a bore [m].

    A bearing's mean bore, ISO 492 normal class.
    """
    return _normal_class(bore_diameter, _BORE, "bore")


def outside_deviations(outside_diameter: float) -> Limits:
    """Return the deviations of an outside diameter [m].

    Limits of a bearing's mean outside diameter, ISO 492 normal class.
    """
    return _normal_class(outside_diameter, _OUTSIDE, "outside diameter")
