"""Describe the half-section of a roller bearing."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property

from lambda_core.catalogue.protocol import RollerRow
from lambda_core.elements.roller.rib import TaperedAngles, tapered_angles
from lambda_core.elements.roller.roller_bearing import RIBS, RollerBearing

RING, BALL, AIR = "█", "░", " "  # what fills a point; balls and rollers look alike
_CONE_RIB = 1.0 / 3.0  # height of a tapered bearing's rib over the large end, where none is given


@dataclass(frozen=True)
class RollerSection:
    """Half-section of a roller bearing in mm.

    It counts x from the middle of the width and r from the axis. The large end of tapered rollers is at negative x.
    """

    kind: str
    bore: float
    outside: float
    width: float
    pitch: float
    element: float  # mean diameter of the rollers
    length: float
    angle: float = 0.0  # of the outer raceway [rad]
    rib: float = 0.0  # height of the ribs
    clearance: float = 0.0  # [m]

    @cached_property
    def _angles(self) -> TaperedAngles:
        if not self.angle:
            return TaperedAngles(0.0, 0.0)
        return tapered_angles(self.element, self.pitch, self.angle)

    @property
    def race_inner(self) -> float:
        """Diameter of the inner raceway in the middle [mm]."""
        return 2.0 * self._raceway(0.0, -1.0)

    @property
    def race_outer(self) -> float:
        """Diameter of the outer raceway in the middle [mm]."""
        return 2.0 * self._raceway(0.0, 1.0)

    def cell(self, x: float, r: float) -> str:
        """Return what fills the point."""
        axis, half = self._angles.roller, self._angles.half
        along = -x * math.cos(axis) + (r - 0.5 * self.pitch) * math.sin(axis)  # towards the large end
        across = x * math.sin(axis) + (r - 0.5 * self.pitch) * math.cos(axis)
        if abs(along) <= 0.5 * self.length and abs(across) <= 0.5 * self.element + along * math.tan(half):
            return BALL
        end = 0 if abs(along) <= 0.5 * self.length else (-1 if along > 0.0 else 1)
        raised = {ring: self._rib_height for ring, side in RIBS[self.kind] if side == end}
        inner = self._raceway(x, -1.0) + raised.get("inner", 0.0)
        outer = self._raceway(x, 1.0) - raised.get("outer", 0.0)
        return RING if 0.5 * self.bore <= r <= inner or outer <= r <= 0.5 * self.outside else AIR

    def is_contact_line(self, x: float, r: float, half: float) -> bool:
        """Tell that no contact line is drawn."""
        return False

    @property
    def _rib_height(self) -> float:
        large = self.element + self.length * math.tan(self._angles.half)
        return self.rib or _CONE_RIB * large

    def _raceway(self, x: float, side: float) -> float:
        """Return a raceway's radius at x; -1: inner."""
        axis, half = self._angles.roller, self._angles.half
        middle = 0.5 * side * self.element / math.cos(half)
        place, radius = middle * math.sin(axis), 0.5 * self.pitch + middle * math.cos(axis)
        return radius - math.tan(axis + side * half) * (x - place)


def section_of_rollers(bearing: RollerBearing | RollerRow) -> RollerSection:
    """Return the section of a resolved bearing or row."""
    if isinstance(bearing, RollerBearing):
        lengths = (bearing.bore, bearing.outside, bearing.width, bearing.pitch_diameter, bearing.diameter)
        length, rib, angle, clearance = bearing.length, bearing.rib_height, bearing.contact_angle, bearing.clearance
    else:
        of_row = (bearing.bore_diameter, bearing.outside_diameter, bearing.width, bearing.pitch_diameter)
        lengths = (*(value.value for value in of_row), bearing.roller_diameter.value)  # type: ignore[assignment]
        length, clearance = bearing.roller_length.value, 0.0
        rib, angle = (0.0 if value is None else value.value for value in (bearing.rib_height, bearing.contact_angle))
    bore, outside, width, pitch, element, along = (float(f"{1e3 * value:.12g}") for value in (*lengths, length))
    return RollerSection(bearing.kind, bore, outside, width, pitch, element, along, angle, 1e3 * rib, clearance)
