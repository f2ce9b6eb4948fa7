"""Compare kinematics with fault orders and rigid-body mechanics."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.optimize import root

from lambda_core.formulas.kinematics import (
    ball_speed,
    cage_speed,
    diameter_ratio,
    entrainment_speed,
    frequency_orders,
)

from .published import Published
from .reference import numerical_gyroscopic_moment, raceway_motion

# Case Western Reserve University, Bearing Data Center, bearing information: multipliers of the running speed.
# Geometry in inches there: 6205 ball 0.3126, pitch 1.537; 6203 ball 0.2656, pitch 1.122.
CWRU = {
    "6205-2RS JEM": (9, 0.3126, 1.537, {"inner_pass": 5.4152, "outer_pass": 3.5848, "cage": 0.39828}, 4.7135),
    "6203-2RS JEM": (8, 0.2656, 1.122, {"inner_pass": 4.9469, "outer_pass": 3.0530, "cage": 0.3817}, 3.9874),
}


@pytest.mark.parametrize("bearing", CWRU)
def test_fault_orders_of_the_data_centre(bearing: str) -> None:
    count, ball, pitch, orders, ball_defect = CWRU[bearing]
    computed = frequency_orders(count, ball, pitch)
    source, reason = f"CWRU Bearing Data Center, {bearing}", "four digits of ball and pitch diameter"
    for name, value in orders.items():
        Published(value, source, reason, rel=2e-4).check(getattr(computed, name))
    Published(ball_defect, source, reason, rel=2e-4).check(computed.ball_defect)


def test_fault_orders_of_the_paderborn_bearing() -> None:
    # Paderborn University, KAt data centre: 6203 with 8 balls of 6.75 mm on 28.55 mm: BPFO 3.05, BPFI 4.95
    orders = frequency_orders(8, 6.75, 28.55)
    source, reason = "Paderborn University, KAt data centre, 6203", "three printed digits"
    Published(3.05, source, reason, abs=0.006).check(orders.outer_pass)
    Published(4.95, source, reason, abs=0.006).check(orders.inner_pass)


@given(st.integers(5, 20), st.floats(0.05, 0.4), st.floats(0.0, 0.7))
def test_ball_passes_add_up(count: int, ratio: float, angle: float) -> None:
    """Compare BPFO + BPFI with Z exactly.

    Every ball meets both rings, and BPFO = Z FTF.
    """
    orders = frequency_orders(count, ratio, 1.0, angle)
    assert orders.outer_pass + orders.inner_pass == pytest.approx(count)
    assert orders.outer_pass == pytest.approx(count * orders.cage)


@given(
    st.floats(-500.0, 500.0),
    st.floats(-500.0, 500.0),
    st.floats(0.05, 0.35),
    st.floats(0.0, 0.7),
)
def test_rolling_without_sliding(inner: float, outer: float, ratio: float, angle: float) -> None:
    """Compare velocities by cross products.

    The speeds make both contacts stick; no bearing formula is used.
    """
    pitch, ball = 0.06, 0.06 * ratio
    gamma = diameter_ratio(ball, pitch, angle)
    orbit = cage_speed(inner, outer, gamma)
    spin = ball_speed(inner, outer, ball, pitch, angle)
    axis = np.array([math.cos(angle), 0.0, -math.sin(angle)])  # square to the line through both contacts
    for side in (True, False):
        ball_velocity, ring_velocity, _ = raceway_motion(
            inner_speed=inner,
            outer_speed=outer,
            orbit_speed=orbit,
            ball_spin=spin * axis,
            ball_diameter=ball,
            pitch_diameter=pitch,
            contact_angle=angle,
            inner=side,
        )
        scale = max(abs(inner), abs(outer), 1.0) * pitch
        assert ball_velocity / scale == pytest.approx(ring_velocity / scale, abs=1e-12)
        mean = 0.5 * float(np.linalg.norm(ball_velocity + ring_velocity))
        assert mean / scale == pytest.approx(entrainment_speed(inner, outer, ball, pitch, angle) / scale, abs=1e-12)


def test_outer_raceway_control() -> None:
    """Stop the spin at the outer ring.

    The pitch angle is tan(beta) = sin(alpha)/(cos(alpha) + D_w/d_m).

    Jones 1959; Harris and Kotzalas, vol. 2, ch. 2. The rest follows here by vectors from that angle alone, with the
    orbit and spin found from rolling without sliding at the middle of both contacts.
    """
    ball, pitch, alpha, inner_speed = 12.7e-3, 65e-3, math.radians(25.0), 300.0
    beta = math.atan2(math.sin(alpha), math.cos(alpha) + ball / pitch)
    direction = np.array([math.cos(beta), 0.0, -math.sin(beta)])

    def slip(unknowns: np.ndarray) -> np.ndarray:
        orbit, spin = unknowns
        motion = [
            raceway_motion(
                inner_speed=inner_speed,
                orbit_speed=float(orbit),
                ball_spin=float(spin) * direction,
                ball_diameter=ball,
                pitch_diameter=pitch,
                contact_angle=alpha,
                inner=side,
            )
            for side in (True, False)
        ]
        return np.array([ball_v[1] - ring_v[1] for ball_v, ring_v, _ in motion])

    orbit, spin = root(slip, [120.0, -700.0], tol=1e-13).x
    assert orbit == pytest.approx(cage_speed(inner_speed, 0.0, diameter_ratio(ball, pitch, alpha)), rel=1e-9)

    def spin_to_roll(side: bool) -> float:
        _, _, relative = raceway_motion(
            inner_speed=inner_speed,
            orbit_speed=float(orbit),
            ball_spin=float(spin) * direction,
            ball_diameter=ball,
            pitch_diameter=pitch,
            contact_angle=alpha,
            inner=side,
        )
        normal = np.array([math.sin(alpha), 0.0, math.cos(alpha)])
        rolling_axis = np.array([math.cos(alpha), 0.0, -math.sin(alpha)])
        return abs(float(relative @ normal) / float(relative @ rolling_axis))

    assert spin_to_roll(False) == pytest.approx(0.0, abs=1e-12)
    # (omega_s/omega_roll)_i = (1 - gamma) tan(alpha - beta) + gamma tan(alpha), gamma = D_w cos(alpha)/d_m
    gamma = ball / pitch * math.cos(alpha)
    classical = (1.0 - gamma) * math.tan(alpha - beta) + gamma * math.tan(alpha)
    assert spin_to_roll(True) == pytest.approx(classical, rel=1e-9)


def test_gyroscopic_moment() -> None:
    """Differentiate the angular momentum in time.

    I omega_spin omega_orbit sin(beta), tangential.
    """
    inertia, spin, orbit, pitch = 2.3e-7, 800.0, 120.0, math.radians(17.0)
    moment = numerical_gyroscopic_moment(inertia, spin, orbit, pitch)
    assert float(np.linalg.norm(moment)) == pytest.approx(inertia * spin * orbit * math.sin(pitch), rel=1e-6)
    assert abs(float(moment[0])) < 1e-12
    assert abs(float(moment[2])) < 1e-9


@pytest.mark.parametrize(
    ("coefficient", "exact"),
    [
        # Harris and Kotzalas, vol. 1, ch. 10: F_c = 2.26e-11 D^3 n_m^2 d_m (N, mm, 1/min, steel balls)
        (2.26e-11, math.pi / 12.0 * 7860e-12 * (math.pi / 30.0) ** 2),
        # M_g = 4.47e-12 D^5 n_R n_m sin(beta) (N mm)
        (4.47e-12, math.pi / 60.0 * 7860e-12 * (math.pi / 30.0) ** 2),
    ],
)
def test_harris_coefficients_of_ball_inertia(coefficient: float, exact: float) -> None:
    reason = "density of steel between 7800 and 7880 kg/m3, three printed digits"
    Published(coefficient, "Harris and Kotzalas, ch. 10", reason, rel=0.012).check(exact)
