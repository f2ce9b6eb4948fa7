"""Draw a shaft in its bearings and its deflection.

It is to scale, with two pixels per character.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from rich.text import Text
from textual.color import Color

if TYPE_CHECKING:
    from lambda_core.api import MachineEquilibrium, MachineModel, MountedBearing

_DOTS = ((0x01, 0x08), (0x02, 0x10), (0x04, 0x20), (0x40, 0x80))  # of a braille sign: four down, two across
_HALF = 1.4  # a half section is drawn where a whole one would be that much smaller
_ROOMY = 15  # lines from which on the bend has an axis of its own
_PARTS = (0.125, 0.375, 0.625, 0.875)  # places along a pixel, for smooth edges
_LINE = 0.5  # half the width of a contact line in pixels
_BALL = 1.9  # radius in pixels from which on a ball is drawn as a circle
_FACE = 0.12  # width of a gear over its pitch diameter, which the case does not say
_DISC = 0.5  # height of a disc beyond the largest radius of the shaft, which the case does not say either


@dataclass
class Canvas:
    """Pixels, braille dots and letters of one picture.

    Attributes
    ----------
    width, height : int
        In characters.
    """

    width: int
    height: int
    _pixels: dict[tuple[int, int], str] = field(default_factory=dict)
    _dots: dict[tuple[int, int], tuple[int, str]] = field(default_factory=dict)
    _letters: dict[tuple[int, int], tuple[str, str]] = field(default_factory=dict)

    def box(self, left: float, right: float, top: float, bottom: float, colour: str) -> None:
        """Fill a box given in pixels.

        A box thinner than a pixel has one.
        """
        first, last = round(left), max(round(left) + 1, round(right))
        high, low = round(top), max(round(top) + 1, round(bottom))
        for row in range(max(0, high), min(2 * self.height, low)):
            for column in range(max(0, first), min(self.width, last)):
                self._pixels[row, column] = colour

    def ball(self, x: float, y: float, radius: float, colours: tuple[str, str, str], angle: float | None) -> None:
        """Draw a ball with its contact line.

        It is given in pixels, with a smooth edge.

        Parameters
        ----------
        colours : tuple of str
            Around the ball, of the ball, of the contact line.
        angle : float or None
            Of the contact line against the radial direction [rad]; None draws none.
        """
        around, inside, line = map(Color.parse, colours)
        along = None if angle is None else (math.sin(angle), math.cos(angle))
        for row in range(max(0, int(y - radius)), min(2 * self.height, int(y + radius) + 1)):
            for column in range(max(0, int(x - radius)), min(self.width, int(x + radius) + 1)):
                points = [(column + i - x, row + j - y) for i in _PARTS for j in _PARTS]
                share = sum(dx * dx + dy * dy < radius**2 for dx, dy in points) / len(points)
                colour = around.blend(inside, share)
                if along is not None and share == 1.0:
                    near = sum(abs(dx * along[1] - dy * along[0]) < _LINE for dx, dy in points) / len(points)
                    colour = colour.blend(line, near)
                if share:
                    self._pixels[row, column] = colour.hex

    def dot(self, across: int, down: int, colour: str) -> None:
        """Set a braille dot.

        A character has two across and four down.
        """
        cell = (down // 4, across // 2)
        if 0 <= cell[0] < self.height and 0 <= cell[1] < self.width:
            self._dots[cell] = (self._dots.get(cell, (0, ""))[0] | _DOTS[down % 4][across % 2], colour)

    def is_free(self, line: int, column: int, length: int) -> bool:
        """Tell whether a place has no letter.

        The place next to it must have none, either.
        """
        return all((line, at) not in self._letters for at in range(column - 1, column + length + 1))

    def words(self, line: int, column: int, text: str, colour: str) -> None:
        """Write over everything."""
        for offset, letter in enumerate(text):
            if 0 <= column + offset < self.width:
                self._letters[line, column + offset] = (letter, colour)

    def text(self, background: str) -> Text:
        """Return the picture."""
        text = Text(no_wrap=True)
        for line in range(self.height):
            for column in range(self.width):
                above, below = (self._pixels.get((2 * line + half, column), background) for half in (0, 1))
                if (line, column) in self._letters:
                    letter, colour = self._letters[line, column]
                    text.append(letter, style=f"{colour} on {above if above != background else below}")
                elif (line, column) in self._dots and above == below == background:
                    sign, colour = self._dots[line, column]
                    text.append(chr(0x2800 + sign), style=colour)
                else:
                    text.append("▀", style=f"{above} on {below}") if above != below else text.append(
                        " ", style=f"on {above}"
                    )
            text.append("\n" if line < self.height - 1 else "")
        return text


@dataclass(frozen=True)
class _Scale:
    """Scale of the canvas in pixels."""

    left: float
    axis: float  # row of the axis
    unit: float  # metres per pixel

    def x(self, place: float) -> float:
        return self.left + place / self.unit

    def rows(self, inner: float, outer: float, *, below: bool) -> tuple[float, float]:
        """Return top and bottom between two radii.

        They lie above the axis or below it.
        """
        near, far = inner / self.unit, outer / self.unit
        return (self.axis + near, self.axis + far) if below else (self.axis - far, self.axis - near)


def drawn_machine(
    model: MachineModel, report: MachineEquilibrium | None, width: int, height: int, colours: Mapping[str, str]
) -> Text:
    """Draw a machine to scale.

    Sections, bearings, bodies, gears, discs and loads, names around them, and the deflection below.

    Parameters
    ----------
    report : MachineEquilibrium, optional
        Of this shaft; without one the bend is left out.
    width, height : int
        Room in characters; a character is taken as twice as high as wide.
    colours : mapping
        Variables of the theme.
    """
    canvas = Canvas(width, height)
    bend = 0 if report is None else (2 if height < _ROOMY else max(4, height // 4))
    lines = max(2, height - 2 - bend)  # of the drawing, between the names above and those below
    radius, length = _largest(model), model.outline[-1][1]
    across = length / max(8, width - 2)
    is_half = 2.0 * radius / (2 * lines) > _HALF * across
    lines -= 0 if is_half else lines % 2  # the axis lies between two lines
    unit = max(across, (radius if is_half else 2.0 * radius) / (2 * lines))
    axis = 2.0 * (1 + lines) if is_half else 2.0 + lines
    scale = _Scale(round(0.5 * (width - length / unit)), axis, unit)
    sides = (False,) if is_half else (False, True)
    _bodies(canvas, model, scale, sides, colours)
    _rotor(canvas, model, scale, sides, colours)
    for bearing in model.bearings:
        _bearing(canvas, bearing, scale, sides, colours)
    for column in range(round(scale.x(0.0)) - 1, round(scale.x(length)) + 1):
        if column % 4:
            canvas.words(int(axis) // 2 - 1, column, "▁", colours["border-blurred"])
    _names_above(canvas, model, scale, colours)
    _names_below(canvas, model, report, scale, 1 + lines, colours)
    if report is not None:
        _bend(canvas, report, scale, height - bend, bend, colours)
    return canvas.text(colours["background"])


def _largest(model: MachineModel) -> float:
    """Return the largest radius of what is drawn [m]."""
    shaft = 0.5 * max(diameter for _, _, diameter, _ in model.outline)
    found = [0.5 * max(body.extent[1:]) for body in model.bodies]
    found += [shaft * (1.0 + _DISC * bool(model.discs)), *(0.5 * diameter for *_, diameter in model.wheels)]
    return max(*found, *(0.5 * bearing.model.geometry.outside_diameter for bearing in model.bearings))


def _bodies(
    canvas: Canvas, model: MachineModel, scale: _Scale, sides: tuple[bool, ...], colours: Mapping[str, str]
) -> None:
    """Draw the other bodies that have a shape.

    It goes from the outer rings in them outwards.
    """
    for number, body in enumerate(model.bodies, start=1):
        length, *across = body.extent
        rings = [0.5 * b.model.geometry.outside_diameter for b in model.bearings if b.carrier == number]
        inner, outer = max(rings, default=0.0), 0.5 * max(across)
        if length and outer > inner:
            for below in sides:
                left, right = (scale.x(body.centre[0] + sign * 0.5 * length) for sign in (-1.0, 1.0))
                canvas.box(left, right, *scale.rows(inner, outer, below=below), colours["surface"])


def _rotor(
    canvas: Canvas, model: MachineModel, scale: _Scale, sides: tuple[bool, ...], colours: Mapping[str, str]
) -> None:
    """Draw gears and discs behind the sections of the shaft."""
    tall = 0.5 * max(diameter for _, _, diameter, _ in model.outline)
    for below in sides:
        for _, place, diameter in model.wheels:
            half = max(0.5 * _FACE * diameter, scale.unit)
            canvas.box(scale.x(place - half), scale.x(place + half),
                       *scale.rows(0.0, 0.5 * diameter, below=below), colours["primary"])  # fmt: skip
        for _, place in model.discs:
            at = scale.x(place)
            canvas.box(at - 0.5, at + 0.5, *scale.rows(0.0, (1.0 + _DISC) * tall, below=below), colours["success"])
        for begin, end, diameter, bore in model.outline:
            top, bottom = scale.rows(0.5 * bore, 0.5 * diameter, below=below)
            canvas.box(scale.x(begin), scale.x(end), top, bottom, colours["secondary"])


def _bearing(
    canvas: Canvas, bearing: MountedBearing, scale: _Scale, sides: tuple[bool, ...], colours: Mapping[str, str]
) -> None:
    """Draw rings, and a ball between them.

    The contact line of an angular contact bearing shows O and X.
    """
    g, middle = bearing.model.geometry, scale.x(bearing.position)
    left, right = (scale.x(bearing.position + sign * 0.5 * g.width) for sign in (-1.0, 1.0))
    for below in sides:
        canvas.box(
            left, right, *scale.rows(0.5 * g.bore_diameter, 0.5 * g.outside_diameter, below=below), colours["accent"]
        )
        centre = scale.rows(0.5 * g.pitch_diameter, 0.5 * g.pitch_diameter, below=below)[0]
        size = 0.5 * g.ball_diameter / scale.unit
        leans = -1.0 if (bearing.takes > 0) != below else 1.0  # as ╱ does, or as ╲
        if size >= _BALL:
            angle = leans * bearing.nominal_angle if bearing.nominal_angle and bearing.takes else None
            paint = (colours["accent"], colours["background"], colours["foreground"])
            canvas.ball(middle, centre, size, paint, angle)
        else:
            sign = ("╱" if leans < 0.0 else "╲") if bearing.takes and bearing.nominal_angle else "●"
            canvas.words(int(centre) // 2, int(middle), sign, colours["background"])


def _names_above(canvas: Canvas, model: MachineModel, scale: _Scale, colours: Mapping[str, str]) -> None:
    """Name gears, discs, loads and bodies.

    They stand over the drawing; a load has its direction.
    """
    bodies = [(f"[{body.name}]", body.centre[0]) for body in model.bodies]
    for name, place in (*model.load_places, *model.discs, *bodies):
        is_load, label = any(name == one for one, _ in model.load_places), name
        if is_load:
            rows = model.body.rows(place)
            label = f"{name} {_way(*model.loads[rows.start : rows.start + 3])}".rstrip()
        colour = colours["primary" if is_load else "success"]
        _label(canvas, 0, scale.x(place), label, colour, moves=(name, place) in bodies)


def _label(canvas: Canvas, line: int, middle: float, label: str, colour: str, *, moves: bool) -> None:
    """Write a name around a place.

    If it moves, it takes the next free place to the right; without room nothing is written.
    """
    most = max(0, canvas.width - len(label))
    column = min(max(0, round(middle - 0.5 * len(label))), most)
    while moves and column < most and not canvas.is_free(line, column, len(label)):
        column += 1
    if canvas.is_free(line, column, len(label)):
        canvas.words(line, column, label, colour)


def _names_below(
    canvas: Canvas,
    model: MachineModel,
    report: MachineEquilibrium | None,
    scale: _Scale,
    line: int,
    colours: Mapping[str, str],
) -> None:
    """Name bearings and springs below.

    They have their axial constraint and the direction of their force on the shaft.
    """
    forces = {name: bearing.force_N for name, bearing in report.bearings.items()} if report is not None else {}
    for bearing in model.bearings:
        label = f"{_held(bearing)} {_way(*forces.get(bearing.name, (0.0, 0.0, 0.0)))}".rstrip()
        column = round(scale.x(bearing.position) - 0.5 * len(label))
        column = min(max(0, column), max(0, canvas.width - len(label)))
        while not canvas.is_free(line, column, len(label)) and column + len(label) < canvas.width:
            column += 1
        canvas.words(line, column, label, colours["accent"])
    for spring in model.springs:
        _label(canvas, line, scale.x(spring.place.point[0]), f"⌇{spring.name}", colours["warning"], moves=True)


def _held(bearing: MountedBearing) -> str:
    """Write a bearing's name with its constraints.

    Stops are on the sides that hold the shaft; one that floats has waves.
    """
    if bearing.takes:
        return f"{bearing.name}⊣" if bearing.takes > 0 else f"⊢{bearing.name}"
    stiffness = bearing.seating.stiffness[0]
    if stiffness == 0.0:
        return f"~{bearing.name}~"
    return f"⊢{bearing.name}⊣" if bearing.is_locked_along else f"≷{bearing.name}≷"


def _way(x: float, y: float, z: float) -> str:
    """Draw the larger parts of a force.

    They point along the shaft, up or down, into the picture (y) or out of it.
    """
    largest = max(abs(x), abs(y), abs(z))
    signs = (("→", "←", x), ("⊗", "⊙", y), ("↑", "↓", z))
    return "".join(pos if part > 0.0 else neg for pos, neg, part in signs if abs(part) > max(0.25 * largest, 1e-9))


def _bend(
    canvas: Canvas, report: MachineEquilibrium, scale: _Scale, first: int, lines: int, colours: Mapping[str, str]
) -> None:
    """Draw the deflection under the shaft.

    It is vertical and horizontal, with its largest value.
    """
    places = [1e-3 * place for place in report.positions_mm]
    curves = (("primary", [d[2] for d in report.deflection_um]), ("warning", [d[1] for d in report.deflection_um]))
    top = max([0.0, *(max(values) for _, values in curves)])
    low = min([0.0, *(min(values) for _, values in curves)])
    high = (top - low) or 1.0
    dots = 4 * lines - 1

    def down(value: float) -> int:
        return 4 * first + round((top - value) / high * dots)

    begin, end = 2.0 * scale.x(places[0]), 2.0 * scale.x(places[-1])
    for across in range(round(begin), round(end) + 1, 3):
        canvas.dot(across, down(0.0), colours["border-blurred"])
    for name, values in curves:
        for across in range(round(begin), round(end) + 1):
            place = (across - begin) / max(end - begin, 1e-9) * places[-1]
            canvas.dot(across, down(_between(place, places, values)), colours[name])
    for line, (words, (name, values)) in enumerate(zip("zy", curves, strict=True)):
        room = round(begin) // 2 - 1
        label = f"{words} {min(values):.3g}..{max(values):.3g} um"
        if len(label) > room:
            label = f"{words} {max(values, key=abs):.3g} um"
        canvas.words(first + line, 0, label, colours[name])


def _between(place: float, places: list[float], values: list[float]) -> float:
    """Return the value at a place.

    It is linear between its neighbours.
    """
    for left, right, a, b in zip(places, places[1:], values, values[1:], strict=False):
        if place <= right and right > left:
            return a + (b - a) * (place - left) / (right - left)
    return values[-1]
