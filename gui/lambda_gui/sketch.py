"""Draw the bearing or the shaft to scale."""

from __future__ import annotations

import math
from functools import lru_cache
from typing import TYPE_CHECKING, Any

from lambda_db.drawing import AnySection, Section
from lambda_db.roller_drawing import AIR, BALL, RING, section_of_rollers
from rich.text import Text
from textual.color import Color
from textual.widgets import Static

from lambda_gui.axes import SIGNS, axes_sketch
from lambda_gui.machine_drawing import drawn_machine

if TYPE_CHECKING:
    from lambda_core.api import Geometry, MachineEquilibrium, MachineModel
    from lambda_gui.checking import Check
    from lambda_gui.nodes import Node

_LINE = 0.6  # half the width of a contact line in pixels
_POINTS = 4  # along each side of a pixel, for smooth edges
_WITH_AXES = ("motion", "operation", "loads", "boundary", "gravity", "markers")
_NOTHING = "the shaft is drawn here as soon as it has a piece, a bearing, a speed and an oil"
_MARKS = 17  # columns for the diameters next to a section


class Sketch(Static):
    """Upper half-section of the bearing, or shaft.

    Axes and signs for forms about loads and motion.

    With mistakes in the case the last drawing stays.
    """

    DEFAULT_CSS = """
    Sketch { width: 1fr; padding: 0 1; }
    """

    def __init__(self) -> None:
        super().__init__(id="sketch")
        self._section: AnySection | None = None
        self._machine: MachineModel | None = None
        self._equilibrium: MachineEquilibrium | None = None
        self._is_about_axes = False

    def show_check(self, check: Check) -> None:
        """Take a resolved case.

        The equilibrium of the case before does not belong to it.
        """
        if check.alone is not None:
            rollers = check.alone.rollers
            self._section = section_of_rollers(rollers) if rollers else section_of_geometry(check.alone.geometry)
        elif check.machine is not None:
            self._machine, self._equilibrium = check.machine, None
        self.draw()

    def show_estimate(self, estimate: Any) -> None:
        """Take the equilibrium of a machine.

        The drawing shows the deflection of its shaft.
        """
        if self._machine is not None and estimate is not None:
            self._equilibrium = estimate.equilibrium
            self.draw()

    def show_node(self, node: Node) -> None:
        """Take the node whose form is shown."""
        is_about_axes = node.key.split(".")[0] in _WITH_AXES
        if is_about_axes != self._is_about_axes:
            self._is_about_axes = is_about_axes
            self.draw()

    def on_resize(self) -> None:
        """Draw for the new size."""
        self.draw()

    def draw(self) -> None:
        """Draw section, shaft or axes.

        The drawing has the colours of the theme.
        """
        colours, width, height = self.app.theme_variables, self.size.width - 2, self.size.height
        if height < 5 or width < 16:  # a narrow screen has no room for it
            return
        if self._machine is not None:
            self.update(drawn_machine(self._machine, self._equilibrium, width, height, colours))
        elif self.screen.has_class("-drawing-below"):
            self.update(Text(_NOTHING, style="dim"))
        elif self._is_about_axes:
            self.update(axes_sketch(colours).append(f"\n{SIGNS}", style="dim"))
        elif self._section is not None:
            clearance = 1e6 * self._section.clearance
            self.update(drawn(self._section, min(height - 2, 22), width, colours, clearance))


def section_of_geometry(geometry: Geometry) -> Section:
    """Return the section of a resolved bearing."""
    return Section(geometry)


def drawn(
    section: AnySection, height: int, width: int, colours: dict[str, str], clearance: float | None = None
) -> Text:
    """Draw a section with its dimensions.

    Contact line, and diameters, clearance and angle at the side; edges are smooth.

    Parameters
    ----------
    height, width : int
        Room in characters; a cell is taken as twice as high as wide.
    colours : dict
        Variables of the theme.
    clearance : float, optional
        Radial clearance [um]; too small to be seen to scale.
    """
    high = 0.5 * (section.outside - section.bore)
    rows = 2 * height
    while rows > 8 and section.width / high * rows > width - _MARKS:
        rows -= 2
    columns = max(4, round(section.width / high * rows))
    pixels = _pixels(
        section, rows, columns, *(colours[name] for name in ("background", "secondary", "accent", "foreground"))
    )
    marks = {
        0: f"D {section.outside:g} mm",
        _row(section.race_outer, section, rows): f"⌀ {section.race_outer:.2f}",
        _row(section.pitch, section, rows): f"pitch {section.pitch:.2f}",
        _row(section.race_inner, section, rows): f"⌀ {section.race_inner:.2f}",
        rows // 2 - 1: f"d {section.bore:g} mm",
    }
    angle = math.degrees(section.angle)
    told = [f"clearance {clearance:.3g} um"] if clearance is not None else []
    told += [f"angle {angle:.3g}°"] if angle else []
    for line in range(1, rows // 2 - 1):
        if told and line not in marks:
            marks[line] = told.pop(0)
    text = Text(no_wrap=True)
    for line in range(rows // 2):
        for top, bottom in zip(pixels[2 * line], pixels[2 * line + 1], strict=True):
            text.append("▀", style=f"{top} on {bottom}")
        text.append(f"  {marks.get(line, '')}\n", style="dim")
    text.append(f"B {section.width:g} mm".center(columns), style="dim")
    return text


@lru_cache(maxsize=32)
def _pixels(section: AnySection, rows: int, columns: int, air: str, ring: str, ball: str, line: str) -> list[list[str]]:
    """Return the colour of each pixel.

    It is the mean over points in it.
    """
    colours = {AIR: Color.parse(air), RING: Color.parse(ring), BALL: Color.parse(ball)}
    high = 0.5 * (section.outside - section.bore)
    inside = [(n + 0.5) / _POINTS for n in range(_POINTS)]

    def at(x: float, r: float) -> Color:
        what = section.cell(x, r)
        is_line = what == BALL and section.is_contact_line(x, r, _LINE * high / rows)
        return Color.parse(line) if is_line else colours[what]

    def colour(row: int, column: int) -> str:
        found = [
            at(((column + x) / columns - 0.5) * section.width, 0.5 * section.outside - (row + y) / rows * high)
            for x in inside
            for y in inside
        ]
        red, green, blue = (sum(parts) // len(found) for parts in zip(*(c.rgb for c in found), strict=True))
        return f"#{red:02x}{green:02x}{blue:02x}"

    return [[colour(row, column) for column in range(columns)] for row in range(rows)]


def _row(diameter: float, section: AnySection, rows: int) -> int:
    share = (section.outside - diameter) / (section.outside - section.bore)
    return min(rows // 2 - 2, max(1, int(share * rows / 2)))
