"""Compute the positions of the raceways of a bearing.

Each ring has one or two arcs for every row of balls.

Every arc is a groove whose centres lie on a circle about the ring's axis. With r its radius, D the ball's diameter and
alpha_s the resting angle, at which a ball touches without clearance while the rings are centred, its circle is shifted
along the axis by (r - D/2) sin(alpha_s) away from where it is touched, and lies (r - D/2)(1 - cos(alpha_s)) nearer to
the pitch circle than that of a groove that is touched at its bottom. Of four-point contact alpha_s is the angle of the
shims that its arcs are ground with (Harris and Kotzalas 2006, ch. 2: P_d = S_d + 2 A (1 - cos(alpha_s))).

The outer raceway of a self-aligning bearing is a sphere about the bearing's centre: one groove with its centres in a
point, for both rows, so that a ring that tilts about that point changes nothing.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import lru_cache

from lambda_core.domain.channels import RINGS
from lambda_core.domain.elements import INNER, OUTER, RACEWAYS, RIBS
from lambda_core.elements.ball.geometry import Geometry

_ENDS = {"+x": 1, "-x": -1}


@dataclass(frozen=True)
class Raceway:
    """One groove that one row of balls runs in."""

    ring: int  # INNER, OUTER
    element: str  # force element of its contacts, "ball_inner", "ball_outer", "rib_inner", "rib_outer"
    row: int
    thrust: int  # +1, -1: it takes a thrust of the shaft to +x, -x; 0: both
    groove_radius: float  # [m]
    groove_circle: float  # radius of the circle of groove centres [m]
    axial_offset: float  # of that circle's plane from the ring's centre [m]
    end: int = 0  # of a rib: the end of the roller that touches it, +1 towards +x, -1

    @property
    def name(self) -> str:
        """Name of the arc in texts.

        "outer +x" takes a thrust of the shaft to +x.
        """
        side = self.end or self.thrust
        return f"{('inner', 'outer')[self.ring]}{' rib' if self.end else ''}{('', ' +x', ' -x')[side]}"


def row_places(geometry: Geometry) -> tuple[float, ...]:
    """Return the axial places of the rows' balls [m]."""
    return (0.0,) if geometry.rows == 1 else (-0.5 * geometry.row_distance, 0.5 * geometry.row_distance)


@lru_cache(maxsize=64)  # asked a dozen times for one set of tables
def raceways(geometry: Geometry) -> tuple[Raceway, ...]:
    """Return the raceways row by row.

    The inner ring's of each row come before the outer ring's; ribs of rollers follow.
    """
    found = tuple(
        _raceway(geometry, row, place, ring, thrust)
        for row, place in enumerate(row_places(geometry))
        for ring in (INNER, OUTER)
        for thrust in geometry.kind.thrusts(geometry, row)
    )
    return found + tuple(
        Raceway(RINGS.index(name[:5]), tuple(RIBS)[RINGS.index(name[:5])], 0, 0, math.inf, 0.0, 0.0, _ENDS[name[5:]])
        for name in geometry.ribs.split()
    )


def raceways_of_a_ball(geometry: Geometry) -> tuple[Raceway, ...]:
    """Return the raceways of one ball.

    They have the order of its contacts; the row is the first one.
    """
    return tuple(raceway for raceway in raceways(geometry) if raceway.row == 0)


def _raceway(g: Geometry, row: int, place: float, ring: int, thrust: int) -> Raceway:
    radius = (g.groove_radius_inner, g.groove_radius_outer)[ring]
    element = tuple(RACEWAYS)[ring]
    if ring == OUTER and g.kind.on_sphere:
        return Raceway(ring, element, row, thrust, radius, 0.0, 0.0)
    beyond = radius - 0.5 * g.ball_diameter  # of the groove's centre over the ball's
    nearer = beyond * (1.0 - math.cos(g.resting_angle))
    if ring == INNER:
        circle = 0.5 * g.race_diameter_inner + radius - nearer
    else:
        circle = 0.5 * g.race_diameter_outer - radius + nearer
    # A thrust of the shaft to +x presses the balls on the outer ring towards +x and on the inner one towards -x.
    offset = place + thrust * (1.0 if ring == INNER else -1.0) * beyond * math.sin(g.resting_angle)
    return Raceway(ring, element, row, thrust, radius, circle, offset)
