"""Test sections of the rings.

Grooves where the balls touch, high and low shoulders, arcs that meet, a sphere.
"""

from __future__ import annotations

import math
from typing import Any

import pytest

from lambda_core import api
from lambda_core.elements.ball.geometry import Geometry
from lambda_core.elements.ball.raceways import raceways, row_places
from lambda_core.model.geometry.ring_profile import profiles


def geometry(name: str) -> Geometry:
    case: dict[str, Any] = {
        "name": "profile", "bearing": {"designation": name}, "loads": {"axial": "1 kN"},
        "lubricant": {"name": "FVA3", "temperature": "60 degC"}, "operation": {"speed": "100 rpm"},
    }  # fmt: skip
    return api.check(case).geometry


@pytest.mark.parametrize("name", ["SKF 6308", "7208BE", "QJ208", "3208A", "1208E"])
def test_rings_touch_the_balls_where_their_grooves_do(name: str) -> None:
    """Keep rings within the clearance of the balls.

    A ball on its pitch circle clears each ring by the clearance at most; no ring reaches into it (1 nm).
    """
    g = geometry(name)
    rings, radius = profiles(g), 0.5 * g.ball_diameter
    for place in row_places(g):
        gaps: dict[int, list[float]] = {0: [], 1: []}
        for step in range(-400, 401):
            x = step / 401.0 * radius
            for ring, profile in enumerate(rings):
                away = abs(profile(place + x) - 0.5 * g.pitch_diameter)
                gaps[ring].append(math.hypot(x, away) - radius)
        for found in gaps.values():
            assert -1e-9 < min(found) < 0.26 * g.clearance + 1e-7
    # the profile is the groove where a raceway's contact lies
    for way in raceways(g):
        sign = -1.0 if way.ring == 0 else 1.0
        angle = way.thrust * sign * g.resting_angle
        x = way.axial_offset + way.groove_radius * math.sin(angle)
        assert rings[way.ring](x) == pytest.approx(way.groove_circle + sign * way.groove_radius * math.cos(angle))


def test_shoulders() -> None:
    """Compare shoulder heights of three kinds.

    Radial contact has two high ones, angular contact one; back to back the outer ring has the middle one.
    """
    deep, angular, rows = (geometry(name) for name in ("SKF 6308", "7208BE", "3208A"))
    inner, outer = profiles(deep)
    edge = 0.499 * deep.width
    assert inner(edge) == inner(-edge) == 0.5 * deep.shoulder_diameter_inner
    inner, outer = profiles(angular)
    edge = 0.499 * angular.width
    assert (inner(-edge), inner(edge)) == (0.5 * angular.shoulder_diameter_inner, 0.5 * angular.race_diameter_inner)
    assert (outer(-edge), outer(edge)) == (0.5 * angular.race_diameter_outer, 0.5 * angular.shoulder_diameter_outer)
    inner, outer = profiles(rows)
    edge = 0.499 * rows.width
    assert inner(edge) == inner(-edge) == 0.5 * rows.shoulder_diameter_inner
    assert outer(edge) == outer(-edge) == 0.5 * rows.race_diameter_outer
    assert outer(0.0) < 0.5 * rows.race_diameter_outer


def test_a_sphere_ends_at_the_faces() -> None:
    g = geometry("1208E")
    outer = profiles(g)[1]
    assert 2.0 * outer(0.0) == g.race_diameter_outer
    assert 2.0 * outer(0.5 * g.width) == pytest.approx(g.shoulder_diameter_outer)
