"""Draw a cross-section of a bearing as text.

A terminal cell counts as twice as high as wide.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property

from lambda_core.catalogue.protocol import BearingRow, RollerRow, Value
from lambda_core.elements.ball.geometry import Geometry
from lambda_core.elements.ball.kinds import kinds
from lambda_core.elements.ball.raceways import row_places
from lambda_core.model.geometry.resolve_geometry import with_clearance
from lambda_core.model.geometry.ring_profile import profiles
from lambda_db.roller_drawing import AIR, BALL, RING, RollerSection, section_of_rollers

# Shoulder height over ball diameter where no shoulder is printed: D_1 - d_1 = 1.21 D_w (lambda_db.derive)
_SHOULDER = 0.25 * (2.0 - 1.21)
_CELL_ASPECT = 2.0
Profile = Callable[[float], float]


@dataclass(frozen=True)
class Section:
    """Half-section of a bearing in mm.

    It counts x from the middle of the width and r from the axis.
    """

    geometry: Geometry
    chamfer: float = 0.0  # [mm]

    @cached_property
    def bore(self) -> float:
        """Bore [mm]."""
        return _mm(self.geometry.bore_diameter)

    @cached_property
    def outside(self) -> float:
        """Outside diameter [mm]."""
        return _mm(self.geometry.outside_diameter)

    @cached_property
    def width(self) -> float:
        """Width [mm]."""
        return _mm(self.geometry.width)

    @cached_property
    def pitch(self) -> float:
        """Pitch diameter [mm]."""
        return _mm(self.geometry.pitch_diameter)

    @cached_property
    def element(self) -> float:
        """Ball diameter [mm]."""
        return _mm(self.geometry.ball_diameter)

    @property
    def angle(self) -> float:
        """Contact angle without load [rad]."""
        return self.geometry.contact_angle or self.geometry.resting_angle

    @property
    def clearance(self) -> float:
        """Radial clearance [m]."""
        return self.geometry.clearance

    @cached_property
    def race_inner(self) -> float:
        """Diameter of the inner raceway at its bottom [mm]."""
        return _mm(self.geometry.race_diameter_inner)

    @cached_property
    def race_outer(self) -> float:
        """Diameter of the outer raceway at its bottom [mm].

        A sphere has its own diameter.
        """
        return _mm(self.geometry.race_diameter_outer)

    def cell(self, x: float, r: float) -> str:
        """Return what fills the point."""
        if any((x - place) ** 2 + (r - 0.5 * self.pitch) ** 2 <= 0.25 * self.element**2 for place in self._places):
            return BALL
        if self._chamfered(x, r):
            return AIR
        inner, outer = self._profiles
        return RING if r <= 1e3 * inner(1e-3 * x) or r >= 1e3 * outer(1e-3 * x) else AIR

    def is_contact_line(self, x: float, r: float, half: float) -> bool:
        """Tell whether a point is on the contact line.

        The line joins the contacts of a ball; the point lies within `half` of it [mm].
        """
        angle = self.angle
        if not angle:
            return False
        for place in self._places:
            is_back_to_back = self.geometry.arrangement == "O"
            leans = -1.0 if len(self._places) == 1 or (place < 0.0) == is_back_to_back else 1.0
            away = (x - place) * math.cos(angle) + leans * (r - 0.5 * self.pitch) * math.sin(angle)
            if abs(x - place) <= 0.5 * self.element and abs(away) < half:
                return True
        return False

    @cached_property
    def _places(self) -> tuple[float, ...]:
        return tuple(1e3 * place for place in row_places(self.geometry))

    @cached_property
    def _profiles(self) -> tuple[Profile, Profile]:
        return profiles(self.geometry)

    def _chamfered(self, x: float, r: float) -> bool:
        axial = abs(x) - (0.5 * self.width - self.chamfer)
        radial = max(0.5 * self.bore + self.chamfer - r, r - (0.5 * self.outside - self.chamfer))
        return axial > 0.0 and radial > 0.0 and axial * axial + radial * radial > self.chamfer**2


AnySection = Section | RollerSection


def _mm(length: float) -> float:
    return float(f"{1e3 * length:.12g}")


def section_of(row: BearingRow) -> Section | None:
    """Return the section of a bearing without clearance.

    None where the catalogue has no inner geometry.

    Four-point contact is drawn with one groove: its shims follow from a clearance.
    """
    kind = kinds()[row.kind]
    ball, pitch, inner, outer = (
        _value(row.ball_diameter), _value(row.pitch_diameter), _value(row.groove_radius_inner),
        _value(row.groove_radius_outer, 1.0 if kind.on_sphere else math.nan),
    )  # fmt: skip
    if any(math.isnan(value) for value in (ball, pitch, inner, outer)):
        return None
    race_inner, race_outer = (
        _value(row.race_diameter_inner, pitch - ball),
        _value(row.race_diameter_outer, pitch + ball),
    )
    heights = kind.shoulders.heights if kind.shoulders else {"inner": _SHOULDER, "outer": _SHOULDER}
    angle, apart = _value(row.contact_angle, 0.0), _value(row.row_distance, 0.0)
    geometry = Geometry(
        ball_count=round(_value(row.ball_count)),
        ball_diameter=ball,
        pitch_diameter=pitch,
        race_diameter_inner=race_inner,
        race_diameter_outer=race_outer,
        groove_radius_inner=inner,
        groove_radius_outer=outer,
        shoulder_diameter_inner=_value(row.shoulder_diameter_inner, race_inner + 2.0 * heights["inner"] * ball),
        shoulder_diameter_outer=_value(
            row.shoulder_diameter_outer, race_outer - 2.0 * heights.get("outer", 0.0) * ball
        ),
        clearance=0.0,
        bore_diameter=row.bore_diameter.value,
        outside_diameter=row.outside_diameter.value,
        width=row.width.value,
        series=row.series,
        contact_angle=0.0 if kind.arcs == 2 else angle,
        resting_angle=angle if kind.rows == 2 else 0.0,
        rows=kind.rows,
        row_distance=apart,
        arrangement=kind.arrangement,
    )
    if kind.with_clearance is not None:
        geometry = with_clearance(geometry, 0.0)
    if kind.outer_shoulder is not None:
        geometry = replace(geometry, shoulder_diameter_outer=kind.outer_shoulder(geometry))
    return Section(geometry, 1e3 * _value(row.chamfer, 0.0))


def _value(known: Value | None, otherwise: float = math.nan) -> float:
    return otherwise if known is None else known.value


def cross_section(row: BearingRow | RollerRow, height: int = 17) -> str:
    """Draw the upper half-section with its diameters at the side.

    Parameters
    ----------
    row : BearingRow or RollerRow
        One of balls needs ball, pitch and groove radii; shoulders that are not printed are drawn at
        D_1 - d_1 = 1.21 D_w, those of angular contact high on the loaded side and down to the raceway on the other.
    height : int
        Lines for the radial height of the section.

    Returns
    -------
    str
        Lines of text; a sentence where the inner geometry is not known.
    """
    section = section_of_rollers(row) if isinstance(row, RollerRow) else section_of(row)
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
    element = "roller" if isinstance(row, RollerRow) else "ball"
    marks = {
        0: f"D  {section.outside:g} mm",
        _line(section.race_outer, section, height): f"raceway {section.race_outer:.6g} mm",
        _line(section.pitch, section, height): f"pitch {section.pitch:.6g} mm, {element} {section.element:.6g} mm",
        _line(section.race_inner, section, height): f"raceway {section.race_inner:.6g} mm",
        height - 1: f"d  {section.bore:g} mm",
    }
    drawn = [f"{line}  {marks[i]}" if i in marks else line.rstrip() for i, line in enumerate(lines)]
    return "\n".join([*drawn, f"B  {section.width:g} mm".center(columns).rstrip()])


def _line(diameter: float, section: AnySection, height: int) -> int:
    high = 0.5 * (section.outside - section.bore)
    return min(height - 2, max(1, int((0.5 * (section.outside - diameter)) / high * height)))
