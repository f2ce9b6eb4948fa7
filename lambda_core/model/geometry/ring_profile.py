"""Compute the profile of the rings under the balls."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import fields
from typing import Any

from lambda_core.domain.elements import INNER, OUTER
from lambda_core.elements.ball.geometry import Geometry
from lambda_core.elements.ball.raceways import Raceway, raceways, row_places


def geometry_of(known: dict[str, Any]) -> Geometry:
    """Return the geometry of a result.

    Old results have fewer fields.
    """
    return Geometry(**{field.name: known[field.name] for field in fields(Geometry) if field.name in known})


def ring_profile(geometry: Geometry, ring: int) -> Callable[[float], float]:
    """Return the profile of a ring's surface [m].

    It is the distance from its axis over the place along the shaft.

    Parameters
    ----------
    ring : int
        raceways.INNER or raceways.OUTER. A single row angular contact bearing is shown for a thrust of the shaft to +x.
    """
    g, places = geometry, row_places(geometry)
    by_row = [[way for way in raceways(g) if way.ring == ring and way.row == row] for row in range(g.rows)]
    toward = -1.0 if ring == INNER else 1.0  # from the ball to the ring
    high, bottom = (
        (0.5 * g.shoulder_diameter_inner, 0.5 * g.race_diameter_inner)
        if ring == INNER
        else (0.5 * g.shoulder_diameter_outer, 0.5 * g.race_diameter_outer)
    )

    def surface(way: Raceway, x: float) -> float:
        """Return the groove's surface.

        It lies far beyond the ball where the groove does not reach.
        """
        square = way.groove_radius**2 - (x - way.axial_offset) ** 2
        return way.groove_circle + toward * math.sqrt(square) if square > 0.0 else -toward * math.inf

    def profile(x: float) -> float:
        row = min(range(len(places)), key=lambda i: abs(x - places[i]))
        thrust = by_row[row][0].thrust or 1
        low = (x - places[row]) * thrust * toward < 0.0
        land = bottom if low and g.kind.one_sided else high
        # A Gothic arch ends at the arc that is nearer to the ball; the grooves of both rows are cut into one ring.
        cut = [toward * min(toward * surface(way, x) for way in arcs) for arcs in by_row]
        return toward * max(toward * land, *(toward * depth for depth in cut))

    return profile


def profiles(geometry: Geometry) -> tuple[Callable[[float], float], Callable[[float], float]]:
    """Return the profiles of the inner and the outer ring."""
    return ring_profile(geometry, INNER), ring_profile(geometry, OUTER)
