"""The bearing's cross-section to scale, in colour: two pixels per character cell."""

from __future__ import annotations

from typing import TYPE_CHECKING

from lambda_db.drawing import Section
from rich.text import Text
from textual.widgets import Static

if TYPE_CHECKING:
    from lambda_core.physics.model import BearingModel, Geometry


class Sketch(Static):
    """The upper half-section of the bearing of the case."""

    DEFAULT_CSS = """
    Sketch { width: 1fr; padding: 0 1; }
    """

    def __init__(self) -> None:
        super().__init__(id="sketch")
        self._section: Section | None = None

    def show_model(self, model: BearingModel | None) -> None:
        """Take the geometry of a resolved case; one with mistakes leaves the last."""
        if model is not None:
            self._section = section_of_geometry(model.geometry)
            self._draw()

    def on_resize(self) -> None:
        """Draw for the new size."""
        self._draw()

    def _draw(self) -> None:
        if self._section is None or self.size.height < 6:
            self.update("")
            return
        colours = self.app.theme_variables
        self.update(drawn(self._section, min(self.size.height - 2, 22), self.size.width - 2, colours))


def section_of_geometry(geometry: Geometry) -> Section:
    """Return the section of a resolved bearing."""
    g = geometry
    return Section(
        bore=1e3 * g.bore_diameter,
        outside=1e3 * g.outside_diameter,
        width=1e3 * g.width,
        chamfer=0.0,
        pitch=1e3 * g.pitch_diameter,
        ball=1e3 * g.ball_diameter,
        race_inner=1e3 * g.race_diameter_inner,
        race_outer=1e3 * g.race_diameter_outer,
        groove_inner=1e3 * g.groove_radius_inner,
        groove_outer=1e3 * g.groove_radius_outer,
        shoulder_inner=1e3 * g.shoulder_diameter_inner,
        shoulder_outer=1e3 * g.shoulder_diameter_outer,
    )


def drawn(section: Section, height: int, width: int, colours: dict[str, str]) -> Text:
    """Draw a section with its diameters at the side.

    Parameters
    ----------
    height, width : int
        Room in characters; a cell is taken as twice as high as wide.
    colours : dict
        Variables of the theme.
    """
    high = 0.5 * (section.outside - section.bore)
    rows = 2 * height
    while rows > 8 and section.width / high * rows > width - 17:
        rows -= 2
    step = high / rows
    columns = max(4, round(section.width / step))
    paint = {"█": colours["secondary"], "░": colours["accent"]}
    marks = {
        0: f"D {section.outside:g} mm",
        _row(section.race_outer, section, rows): f"⌀ {section.race_outer:.2f}",
        _row(section.pitch, section, rows): f"pitch {section.pitch:.2f}",
        _row(section.race_inner, section, rows): f"⌀ {section.race_inner:.2f}",
        rows // 2 - 1: f"d {section.bore:g} mm",
    }
    text = Text(no_wrap=True)
    for line in range(rows // 2):
        for column in range(columns):
            x = (column + 0.5) / columns * section.width - 0.5 * section.width
            top, bottom = (
                paint.get(section.cell(x, 0.5 * section.outside - (2 * line + half + 0.5) * step), "")
                for half in (0, 1)
            )
            if top and bottom:
                text.append("▀", style=f"{top} on {bottom}")
            elif top or bottom:
                text.append("▀" if top else "▄", style=top or bottom)
            else:
                text.append(" ")
        text.append(f"  {marks.get(line, '')}\n", style="dim")
    text.append(f"B {section.width:g} mm".center(columns), style="dim")
    return text


def _row(diameter: float, section: Section, rows: int) -> int:
    share = (section.outside - diameter) / (section.outside - section.bore)
    return min(rows // 2 - 2, max(1, int(share * rows / 2)))
