"""Test pockets and lands.

Clearance, direction, dissipation, the slip that friction opposes, invariance.
"""

from __future__ import annotations

import dataclasses
import math
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

from lambda_core.discovery.manager import registry
from lambda_core.domain.plugin_errors import PluginError
from lambda_core.laws.par import make_par
from lambda_core.laws.probe import trial_context
from lambda_core.testing import evaluate

ZERO = np.zeros(3)
POCKET = trial_context("ball_cage")
C = 0.5 * POCKET.pocket_clearance
R_BALL = 0.5 * POCKET.ball_diameter
vectors = st.lists(st.floats(-1.0, 1.0), min_size=3, max_size=3).map(np.array)


def contact(name: str, r: Any, v: Any = ZERO, omega: Any = ZERO, element: str = "ball_cage", **options: Any) -> Any:
    context = options.pop("context", trial_context(element))
    if name.endswith("pocket"):
        options.setdefault("film_width", 0.0)
    out = evaluate(f"cage_contact/{name}", options or None, context, r=r, v_rel=v, omega_rel=omega, eta0=0.1)
    return out[:3], out[3:]


@pytest.mark.parametrize("name", ["spherical-pocket", "cylindrical-pocket", "land-guidance"])
def test_nothing_within_the_clearance(name: str) -> None:
    element = "cage_outer" if name == "land-guidance" else "ball_cage"
    context = trial_context(element)
    play = 0.5 * (context.land_clearance if name == "land-guidance" else context.pocket_clearance)
    for r in (ZERO, np.array([0.0, 0.0, 0.999 * play]), np.array([0.0, 0.6 * play, 0.6 * play])):
        force, point = contact(name, r, np.ones(3), np.ones(3), element)
        assert np.all(force == 0.0)
        assert np.all(point == 0.0)


@settings(max_examples=40, deadline=None)
@given(vectors, st.floats(1e-8, 1e-4))
def test_spherical_pocket_pushes_towards_its_centre(direction: NDArray[np.float64], depth: float) -> None:
    if np.linalg.norm(direction) < 0.1:
        return
    n = direction / np.linalg.norm(direction)
    force, point = contact("spherical-pocket", (C + depth) * n)
    spring = 0.5 * depth**2 / 0.5e-6 if depth < 0.5e-6 else depth - 0.25e-6
    assert force == pytest.approx(-5e6 * spring * n, rel=1e-6, abs=1e-12)
    assert point == pytest.approx((C + depth + R_BALL) * n)


def test_cylindrical_pocket_is_free_along_the_radius() -> None:
    force, _ = contact("cylindrical-pocket", np.array([0.0, 10.0 * C, 0.0]))
    assert np.all(force == 0.0)
    force, _ = contact("cylindrical-pocket", np.array([0.0, 10.0 * C, C + 5e-6]))
    assert force[1] == 0.0
    assert force[2] < 0.0


@pytest.mark.parametrize(("element", "side"), [("cage_outer", 1.0), ("cage_inner", -1.0)])
def test_land_touches_on_the_side_of_the_ring_that_guides(element: str, side: float) -> None:
    """Push the cage back from both rings.

    Its motion touches the outer ring's land ahead, the inner ring's behind.
    """
    context = trial_context(element)
    r = np.array([1e-4, 0.0, 0.5 * context.land_clearance + 3e-6])
    force, point = contact("land-guidance", r, element=element)
    assert force[2] < 0.0
    assert force[:2] == pytest.approx([0.0, 0.0])
    assert point[2] - r[2] == pytest.approx(side * 0.5 * context.land_diameter)
    assert point[0] == r[0]


@pytest.mark.parametrize("name", ["spherical-pocket", "cylindrical-pocket", "land-guidance"])
@settings(max_examples=40, deadline=None)
@given(v=vectors, omega=vectors, closing=st.floats(-1.0, 1.0))
def test_never_pulls_and_never_drives(name: str, v: Any, omega: Any, closing: float) -> None:
    """Find no positive power and no attraction.

    Normal damping and friction together never drive, and the normal force never pulls.
    """
    element = "cage_inner" if name == "land-guidance" else "ball_cage"
    context = trial_context(element)
    play = 0.5 * (context.land_clearance if name == "land-guidance" else context.pocket_clearance)
    n = np.array([0.0, 0.0, 1.0])
    r = (play + 1.5e-6) * n
    v = v + closing * n
    elastic, _ = contact(name, r, element=element)
    oil = {} if name == "land-guidance" else {"film_width": 0.2}
    force, point = contact(name, r, v, 500.0 * omega, element, **oil)
    assert force @ n <= 0.0
    slip = v + np.cross(500.0 * omega, point - r)
    assert (force - elastic) @ slip <= 1e-9


def test_friction_is_mu_times_the_normal_force_against_the_slip() -> None:
    r, v, omega = np.array([0.0, 0.0, C + 4e-6]), np.array([0.3, 0.0, 0.0]), np.array([0.0, 150.0, 20.0])
    force, point = contact("spherical-pocket", r, v, omega)
    slip = v + np.cross(omega, point - r)
    assert slip[2] == pytest.approx(0.0)
    speed = math.hypot(*slip)
    assert speed > 0.5
    assert force[:2] == pytest.approx(0.05 * force[2] * slip[:2] / speed, rel=1e-9)


def test_damping_sets_in_gradually_and_only_resists() -> None:
    n = np.array([0.0, 0.0, 1.0])
    still, fast, away = (contact("spherical-pocket", (C + 5e-6) * n, v * n)[0][2] for v in (0.0, 0.1, -0.1))
    assert fast - still == pytest.approx(-50.0 * 0.1)
    assert away - still == pytest.approx(50.0 * 0.1)
    grazing, touching = (contact("spherical-pocket", (C + 1e-9) * n, v * n)[0][2] for v in (0.0, 0.1))
    assert abs(touching - grazing) < 1e-5 * 50.0 * 0.1
    assert contact("spherical-pocket", (C + 1e-6) * n, -10.0 * n)[0][2] == 0.0


def test_force_and_slope_are_continuous_at_first_touch() -> None:
    depth = np.array([-1e-12, 0.0, 1e-12, 1e-10])
    forces = [contact("spherical-pocket", np.array([0.0, 0.0, C + d]))[0][2] for d in depth]
    assert forces[0] == forces[1] == 0.0
    assert abs(forces[3] / depth[3]) < 1e-3 * 5e6


@settings(max_examples=30, deadline=None)
@given(vectors, vectors, vectors, st.floats(-math.pi, math.pi))
def test_spherical_pocket_turns_with_its_frame(r: Any, v: Any, omega: Any, angle: float) -> None:
    c, s = math.cos(angle), math.sin(angle)
    turn = np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])
    force, point = contact("spherical-pocket", 3.0 * C * r, v, 100.0 * omega)
    turned_force, turned_point = contact("spherical-pocket", turn @ (3.0 * C * r), turn @ v, 100.0 * turn @ omega)
    assert turned_force == pytest.approx(turn @ force, rel=1e-8, abs=1e-6)
    assert turned_point == pytest.approx(turn @ point, rel=1e-8, abs=1e-12)


def test_no_play_and_no_offset_is_no_contact() -> None:
    context = dataclasses.replace(POCKET, pocket_clearance=0.0)
    force, _ = contact("spherical-pocket", ZERO, np.ones(3), context=context)
    assert np.all(force == 0.0)


@pytest.mark.parametrize(
    ("name", "missing", "message"),
    [
        ("spherical-pocket", "pocket_clearance", "pocket clearance"),
        ("land-guidance", "land_clearance", "not guided by a ring"),
        ("land-guidance", "land_diameter", "not guided by a ring"),
    ],
)
def test_says_what_the_cage_lacks(name: str, missing: str, message: str) -> None:
    law = registry().model("cage_contact", name)
    context = dataclasses.replace(trial_context("cage_inner"), **{missing: math.nan})
    with pytest.raises(PluginError, match=message):
        make_par(law, law.parameters(), context)


@pytest.mark.parametrize("apart", [1.2, 1.0])
def test_balls_apart_do_not_feel_each_other(apart: float) -> None:
    force, point = contact("ball-ball", np.array([0.0, apart * 2.0 * R_BALL, 0.0]), np.ones(3), np.ones(3))
    assert np.all(force == 0.0)
    assert np.all(point == 0.0)


@settings(max_examples=40, deadline=None)
@given(vectors, vectors, vectors, st.floats(1e-7, 1e-5))
def test_two_balls_push_each_other_apart(direction: Any, v: Any, omega: Any, depth: float) -> None:
    """Push along the line of centres, halfway.

    Damping and friction never drive.
    """
    if np.linalg.norm(direction) < 0.1:
        return
    n = direction / np.linalg.norm(direction)
    r = (2.0 * R_BALL - depth) * n
    spring = 0.5 * depth**2 / 0.5e-6 if depth < 0.5e-6 else depth - 0.25e-6
    elastic, point = contact("ball-ball", r)
    assert elastic == pytest.approx(5e6 * spring * n, rel=1e-6, abs=1e-9)
    assert point == pytest.approx(0.5 * r, abs=0.6 * depth)
    force, point = contact("ball-ball", r, v, 500.0 * omega)
    assert force @ n >= 0.0
    assert (force - elastic) @ (v + np.cross(500.0 * omega, point - r)) <= 1e-9
