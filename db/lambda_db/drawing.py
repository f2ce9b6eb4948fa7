"""A bearing's cross-section as text, to scale: a terminal cell is taken as twice as high as wide."""

from __future__ import annotations

from dataclasses import dataclass

from lambda_core.catalogue.protocol import BearingRow
from lambda_core.system.resolve_shoulders import FOUR_POINT_SHOULDERS, HIGH_SHOULDERS

RING, BALL, AIR = "█", "░", " "
# Shoulder height over ball diameter where no shoulder is printed: D_1 - d_1 = 1.21 D_w (lambda_db.derive)
_SHOULDER = 0.25 * (2.0 - 1.21)
_CELL_ASPECT = 2.0


@dataclass(frozen=True)
class Section:
    """Half-section in mm: x from the middle of the width, r from the axis."""

    bore: float
    outside: float
    width: float
    chamfer: float
    pitch: float
    ball: float
    race_inner: float
    race_outer: float
    groove_inner: float
    groove_outer: float
    shoulder_inner: float
    shoulder_outer: float
    angle: float = 0.0  # contact angle; above zero the inner ring's right and the outer ring's left shoulder are low

    def cell(self, x: float, r: float) -> str:
        """Return what fills the point."""
        if x * x + (r - 0.5 * self.pitch) ** 2 <= 0.25 * self.ball**2:
            return BALL
        if self._chamfered(x, r):
            return AIR
        inner_centre = 0.5 * self.race_inner + self.groove_inner
        if r <= 0.5 * (self.race_inner if self.angle and x > 0.0 else self.shoulder_inner):
            return RING if x * x + (r - inner_centre) ** 2 > self.groove_inner**2 else AIR
        outer_centre = 0.5 * self.race_outer - self.groove_outer
        if r >= 0.5 * (self.race_outer if self.angle and x < 0.0 else self.shoulder_outer):
            return RING if x * x + (r - outer_centre) ** 2 > self.groove_outer**2 else AIR
        return AIR

    def _chamfered(self, x: float, r: float) -> bool:
        axial = abs(x) - (0.5 * self.width - self.chamfer)
        radial = max(0.5 * self.bore + self.chamfer - r, r - (0.5 * self.outside - self.chamfer))
        return axial > 0.0 and radial > 0.0 and axial * axial + radial * radial > self.chamfer**2


def section_of(row: BearingRow) -> Section | None:
    needed = (row.ball_diameter, row.pitch_diameter, row.groove_radius_inner, row.groove_radius_outer)
    if any(value is None for value in needed):
        return None
    ball, pitch, groove_inner, groove_outer = (1e3 * value.value for value in needed if value is not None)

    def known(name: str, otherwise: float) -> float:
        value = getattr(row, name)
        return otherwise if value is None else float(1e3 * value.value)

    race_inner, race_outer = known("race_diameter_inner", pitch - ball), known("race_diameter_outer", pitch + ball)
    angle = row.contact_angle.value if row.contact_angle is not None and row.kind == "angular contact" else 0.0
    heights = HIGH_SHOULDERS if angle else {"inner": _SHOULDER, "outer": _SHOULDER}
    if row.kind == "four-point":
        heights = FOUR_POINT_SHOULDERS
    return Section(
        bore=1e3 * row.bore_diameter.value,
        outside=1e3 * row.outside_diameter.value,
        width=1e3 * row.width.value,
        chamfer=known("chamfer", 0.0),
        pitch=pitch,
        ball=ball,
        race_inner=race_inner,
        race_outer=race_outer,
        groove_inner=groove_inner,
        groove_outer=groove_outer,
        shoulder_inner=known("shoulder_diameter_inner", race_inner + 2.0 * heights["inner"] * ball),
        shoulder_outer=known("shoulder_diameter_outer", race_outer - 2.0 * heights["outer"] * ball),
        angle=angle,
    )


def cross_section(row: BearingRow, height: int = 17) -> str:
    """Draw the upper half-section with its diameters at the side.

    Parameters
    ----------
    row : BearingRow
        Needs ball, pitch and groove radii; shoulders that are not printed are drawn at D_1 - d_1 = 1.21 D_w, those
        of angular contact high on the loaded side and down to the raceway on the other.
    height : int
        Lines for the radial height of the section.

    Returns
    -------
    str
        Lines of text; a sentence where the inner geometry is not known.
    """
    section = section_of(row)
    if section is None:
        return "inner geometry not known: no cross-section"
    high = 0.5 * (section.outside - section.bore)
    step_r = high / height
    columns = max(3, round(section.width / step_r * _CELL_ASPECT))
    step_x = section.width / columns
    lines = []
    for i in range(height):
        r = 0.5 * section.outside - (i + 0.5) * step_r
        cells = "".join(section.cell((j + 0.5) * step_x - 0.5 * section.width, r) for j in range(columns))
        lines.append(cells)
    marks = {
        0: f"D  {section.outside:g} mm",
        _line(section.race_outer, section, height): f"raceway {section.race_outer:.6g} mm",
        _line(section.pitch, section, height): f"pitch {section.pitch:.6g} mm, ball {section.ball:.6g} mm",
        _line(section.race_inner, section, height): f"raceway {section.race_inner:.6g} mm",
        height - 1: f"d  {section.bore:g} mm",
    }
    drawn = [f"{line}  {marks[i]}" if i in marks else line.rstrip() for i, line in enumerate(lines)]
    return "\n".join([*drawn, f"B  {section.width:g} mm".center(columns).rstrip()])


def _line(diameter: float, section: Section, height: int) -> int:
    high = 0.5 * (section.outside - section.bore)
    return min(height - 2, max(1, int((0.5 * (section.outside - diameter)) / high * height)))
