"""Sketch axes and signs in braille dots."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping

from rich.text import Text

WIDTH, HEIGHT = 40, 15  # of the sketch in characters
_CENTRE = (34, 30)  # in dots: two across and four down per character
_BALLS = 9
_DOTS = ((0x01, 0x08), (0x02, 0x10), (0x04, 0x20), (0x40, 0x80))

SIGNS = (
    "A positive speed turns y towards z. Axial loads act along +x, radial ones at their azimuth (270° = down). "
    "The contact angle is positive when the ball pushes the outer ring towards +x."
)
MORE_SIGNS = (
    "Tilt y, z are rotations about y, z; spin is the rotation of a body about its own axis. Clearance is the radial "
    "internal clearance, a diametral measure. A friction torque is the dissipated power over the relative speed of "
    "the rings."
)

Dot = tuple[float, float]


class _Canvas:
    """Coloured characters of a drawing.

    Dots are collected into braille signs.
    """

    def __init__(self) -> None:
        self._signs: dict[tuple[int, int], int] = {}
        self._colours: dict[tuple[int, int], str] = {}
        self._letters: dict[tuple[int, int], str] = {}

    def dots(self, places: Iterable[Dot], colour: str) -> None:
        """Set dots from the centre.

        y is to the right and z up.
        """
        for y, z in places:
            across, down = round(_CENTRE[0] + y), round(_CENTRE[1] - z)
            cell = (down // 4, across // 2)
            self._signs[cell] = self._signs.get(cell, 0) | _DOTS[down % 4][across % 2]
            self._colours[cell] = colour

    def words(self, line: int, column: int, text: str, colour: str) -> None:
        """Write over the dots."""
        for offset, letter in enumerate(text):
            self._letters[line, column + offset] = letter
            self._colours[line, column + offset] = colour

    def text(self) -> Text:
        """Return what is drawn."""
        text = Text(no_wrap=True)
        for line in range(HEIGHT):
            for column in range(WIDTH):
                cell = (line, column)
                sign = chr(0x2800 + self._signs[cell]) if cell in self._signs else " "
                text.append(self._letters.get(cell, sign), style=self._colours.get(cell, ""))
            text.append("\n")
        return text


def axes_sketch(colours: Mapping[str, str]) -> Text:
    """Draw rings, balls, axes and azimuth.

    It also draws the positive sense of rotation.

    Parameters
    ----------
    colours : mapping
        Variables of the theme.
    """
    canvas = _Canvas()
    ring, ball, axis = colours["secondary"], colours["accent"], colours["primary"]
    for radius in (8.0, 12.5, 20.5, 25.0):
        canvas.dots(_arc(0.0, 0.0, radius), ring)
    for number in range(_BALLS):
        angle = 2.0 * math.pi * number / _BALLS - 0.5 * math.pi
        canvas.dots(_arc(16.5 * math.cos(angle), 16.5 * math.sin(angle), 3.4), ball)
    canvas.dots(((0.0, float(z)) for z in range(3, 28, 2)), axis)
    canvas.dots(((float(y), 0.0) for y in range(3, 34, 2)), axis)
    canvas.dots(_arc(0.0, 0.0, 30.0, 25.0, 60.0), ball)
    canvas.words(0, 17, "z  90° up", axis)
    canvas.words(7, 16, "x⊙", axis)
    canvas.words(7, 35, "y  0°", axis)
    canvas.words(1, 24, "◀ speed > 0", ball)
    canvas.words(14, 13, "270° down", axis)
    canvas.words(11, 32, "x to you", axis)
    canvas.words(13, 32, "g ↓", ring)
    return canvas.text()


def _arc(y: float, z: float, radius: float, first: float = 0.0, last: float = 360.0) -> Iterable[Dot]:
    """Return dots of a circle or arc.

    The arc is between two angles in degrees.
    """
    steps = max(8, round(4.0 * radius * (last - first) / 360.0 * math.pi / 2.0))
    for step in range(steps + 1):
        angle = math.radians(first + (last - first) * step / steps)
        yield y + radius * math.cos(angle), z + radius * math.sin(angle)
