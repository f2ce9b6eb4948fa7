"""Test the speed that cage slip is measured against.

Zero slip where nothing slips, at any speed and contact angle.
"""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest

from lambda_core import api
from lambda_core.formulas.kinematics import rolling_ratio
from lambda_core.solver.arrays import bundle as L
from lambda_core.solver.drivers.equilibrium import Equilibrium, solve
from lambda_core.solver.records import CONTACT_CHANNELS

from .published import Published

BALLS, BALL, PITCH = 15, 20.6375e-3, 155e-3
CASE = {
    "name": "fast",
    "bearing": {
        "contact_angle": "24 deg",
        "geometry": {
            "ball_count": BALLS, "ball_diameter": "20.6375 mm", "pitch_diameter": "155 mm", "conformity_inner": 0.54,
            "conformity_outer": 0.52, "bore_diameter": "120 mm", "outside_diameter": "190 mm", "width": "35 mm",
            "series": "70",
        },
    },
    "lubricant": {"name": "FVA3", "temperature": "100 degC"},
    "loads": {"axial": "22.24 kN"},
    "operation": {"speed": "25000 rpm"},
    "bodies": {"cage": {"type": "brass-machined"}},
    "gravity": {"z": "0 m/s2"},
    "models": {"fluid_drag": "none"},
}  # fmt: skip


def reference(found: Equilibrium) -> float:
    """Return the reference of the solution's balls."""
    load, angle = (found.contacts[..., CONTACT_CHANNELS.index(name)] for name in ("load", "contact_angle"))
    balls = found.state[: L.NB * BALLS].reshape(BALLS, L.NB)
    orbit = balls[:, L.BVT] / balls[:, L.BR]
    return rolling_ratio(load, angle, balls[:, L.BR], balls[:, L.BWX : L.BWX + 3], orbit, BALL)


@pytest.mark.parametrize(("rpm", "allowed"), [(1000, 5e-4), (10000, 2e-3), (25000, 6e-3)])
@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_balls_of_a_fast_bearing_without_drag_do_not_slip(rpm: int, allowed: float, sign: float) -> None:
    """Find no slip at 25 000 1/min under thrust.

    22.24 kN on 15 balls of 20.6 mm, angles of 34 and 12 degrees.

    One mean angle takes 7 % of slip for it. What is left is the creep of contacts that spin.
    """
    found = solve(api.check(CASE, [f"operation.speed={sign * rpm} rpm"]))
    angles = found.contacts[0, :, CONTACT_CHANNELS.index("contact_angle")]
    mean = 0.5 * (1.0 - BALL * math.cos(float(angles.mean())) / PITCH)
    ratio = found.orbit / (sign * rpm * math.pi / 30.0)
    Published(ratio, "quasi-static solution without drag", "creep of contacts that spin", rel=allowed).check(
        reference(found)
    )
    if rpm == 25000:
        assert abs(ratio / mean - 1.0) > 0.05


@pytest.mark.parametrize("lean", [-0.2, 0.0, 0.3])
def test_the_reference_is_that_of_contacts_that_roll(lean: float) -> None:
    """Compare the ratio with contacts that roll.

    The spin of a ball makes both contacts roll, by cross products: the slip of both vanishes at the ratio.
    """
    angles, radius = (0.59, 0.21), 0.0775
    inner, outer = radius - 0.5 * BALL * math.cos(angles[0]), radius + 0.5 * BALL * math.cos(angles[1])
    spin = np.array([-math.cos(lean), math.sin(lean), 0.0])
    ratio = rolling_ratio(np.ones((1, 2)), np.array([angles]), np.array([radius]), np.array([spin]), np.zeros(1), BALL)
    speed = 0.5 * BALL * math.cos(angles[1] - lean)  # of the ball's surface past the outer raceway
    orbit = speed / outer
    ring = orbit + 0.5 * BALL * math.cos(angles[0] - lean) / inner
    assert ratio == pytest.approx(orbit / ring, rel=1e-12)


def test_the_reference_of_a_ring_to_the_side_is_that_of_contacts_that_roll() -> None:
    """Turn the inner ring about its own centre."""
    angle, radius, near, rise = 0.3, 0.0775, 60e-6, (120e-6, 90e-6)
    inner, outer = (0.5 * BALL - height for height in rise)
    speed = outer * math.cos(angle)  # past the outer raceway, of a ball that turns at 1 rad/s about an axis like x
    orbit = speed / (radius + outer * math.cos(angle))
    ring = orbit * (radius - inner * math.cos(angle)) + inner * math.cos(angle)  # speed of the inner raceway
    turns = ring / (radius - inner * math.cos(angle) - near)
    ratio = rolling_ratio(
        np.ones((1, 2)), np.full((1, 2), angle), np.array([radius]), np.array([[-1.0, 0.0, 0.0]]), np.zeros(1), BALL,
        approach=np.array([near]), rise=np.array([rise]),
    )  # fmt: skip
    assert ratio == pytest.approx(orbit / turns, rel=1e-12)


@pytest.mark.parametrize(
    ("designation", "radial", "axial"),
    [("SKF 6208", "8 kN", "0 N"), ("SKF 6208", "0 N", "5 kN"), ("SKF NU 208", "20 kN", "0 N")],
)
def test_a_run_starts_without_slip(designation: str, radial: str, axial: str, tmp_path: Path) -> None:
    """Find no slip in equilibria without drag.

    The slip was -0.28, -0.26 and 0.21 %: the inner ring turned about the bearing's axis, and balls rolled on the bottom
    of their grooves.
    """
    case = {
        "name": "start", "bearing": {"designation": designation}, "operation": {"speed": "1000 rpm"},
        "lubricant": {"name": "FVA3", "temperature": "60 degC"}, "loads": {"radial": radial, "axial": axial},
        "models": {"fluid_drag": "none"}, "gravity": {"z": "0 m/s2"},
    }  # fmt: skip
    found = api.run(case, ["solver.duration=20 us"], out=tmp_path / "start.h5").summary()
    assert found.cage_speed_over_epicyclic == pytest.approx(1.0, abs=6e-4)


def test_with_equal_angles_the_reference_is_harris() -> None:
    """Compare with Harris and Kotzalas 2006, eq. 10.12.

    (1 - D_w cos(a)/d_m)/2, whatever the lean of the axis.
    """
    for lean in (0.0, 0.4):
        spin = np.array([[-math.cos(lean), math.sin(lean), 0.0]])
        ratio = rolling_ratio(np.ones((1, 2)), np.full((1, 2), 0.4), np.array([0.5 * PITCH]), spin, np.zeros(1), BALL)
        assert ratio == pytest.approx(0.5 * (1.0 - BALL * math.cos(0.4) / PITCH), rel=1e-12)


def test_without_load_there_is_no_reference() -> None:
    nothing = np.zeros((1, 2))
    assert math.isnan(rolling_ratio(nothing, nothing, np.array([0.07]), np.zeros((1, 3)), np.zeros(1), BALL))


def test_a_ball_between_the_raceways_takes_no_part() -> None:
    """Average without a ball that touches nothing.

    Its contact angles may be those of opposite points, between which there is no speed of rolling.
    """
    load, angle = np.array([[100.0, 100.0], [0.0, 0.0]]), np.array([[0.3, 0.3], [-math.pi, 0.0]])
    radius, spin = np.full(2, 0.5 * PITCH), np.array([[-60.0, 0.0, 0.0], [-400.0, 0.0, 0.0]])
    with np.errstate(all="raise"):
        both = rolling_ratio(load, angle, radius, spin, np.zeros(2), BALL)
    assert both == rolling_ratio(load[:1], angle[:1], radius[:1], spin[:1], np.zeros(1), BALL)
