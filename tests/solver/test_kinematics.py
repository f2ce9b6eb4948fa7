"""Test contact identification and velocities, derived a second time.

Vectors in space and moving points, no ball frame.
"""

from __future__ import annotations

import math

import numpy as np
import pytest

from lambda_core.formulas.hertz import ball_raceway_radii
from lambda_core.solver.arrays import bundle as L
from lambda_core.solver.drivers.contact_grid import unit_grid

from .support import (
    ALL_FREE,
    NO_FIELD,
    FloatArray,
    Machine,
    State,
    angular_velocity,
    axis_of,
    ball_centre,
    inertial,
    jostle,
    machine,
    rolling,
)

MODEL = (
    "bearing.clearance=10 um",
    *ALL_FREE,
    *NO_FIELD,
    "models.cage_contact=none",
    "models.damping=none",
    "bodies.inner_ring.spin=free",
)


def moved(state: State, j: int, ring: int, h: float) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Return ball and ring after a time.

    Ball centre, ring centre and ring axis a time h later, moving as rigid bodies do.
    """
    ball, body = state.balls[j], state.shared[ring]
    centre = ball_centre(ball) + h * inertial(ball[L.BPSI], ball[3:6])
    omega, axis = angular_velocity(body), axis_of(body)
    later = axis + h * np.cross(omega, axis) + 0.5 * h * h * np.cross(omega, np.cross(omega, axis))
    return centre, body[:3] + h * body[6:9], later / np.linalg.norm(later)


def identify(
    m: Machine, ring: int, centre: FloatArray, origin: FloatArray, axis: FloatArray
) -> tuple[float, FloatArray, FloatArray]:
    """Return a sphere's contact in a torus.

    Penetration, normal from ball to ring and rolling direction.

    The nearest point of the circle of groove centres lies along the way to the ball's centre, less its axial part.
    """
    away = centre - origin
    across = away - (away @ axis) * axis
    nearest = origin + float(m.constant("groove_circle")[ring]) * across / np.linalg.norm(across)
    gap = centre - nearest
    penetration = np.linalg.norm(gap) + float(m.constant("ball_radius")) - float(m.constant("groove_radius")[ring])
    rolling_direction = np.cross(axis, across)
    return float(penetration), gap / np.linalg.norm(gap), rolling_direction / np.linalg.norm(rolling_direction)


def expected(m: Machine, state: State, j: int, ring: int) -> dict[str, float] | None:
    """Return what the contact's channels should be; None without contact."""
    ball, body = state.balls[j], state.shared[ring]
    centre, origin, axis = moved(state, j, ring, 0.0)
    penetration, normal, along = identify(m, ring, centre, origin, axis)
    if penetration <= 0.0:
        return None

    def point(h: float) -> FloatArray:
        place, middle, a = moved(state, j, ring, h)
        depth, n, _ = identify(m, ring, place, middle, a)
        return np.array(place + (float(m.constant("ball_radius")) - 0.5 * depth) * n)

    h = 1e-7
    contact, travel = point(0.0), (point(h) - point(-h)) / (2.0 * h)
    psi = ball[L.BPSI]
    spin, ring_spin = inertial(psi, ball[6:9]), angular_velocity(body)
    of_ball = inertial(psi, ball[3:6]) + np.cross(spin, contact - centre)
    of_ring = body[6:9] + np.cross(ring_spin, contact - origin)
    side = -1.0 if ring == 0 else 1.0
    outwards = centre - origin - ((centre - origin) @ axis) * axis
    return {
        "contact_angle": math.atan2(
            side * float(normal @ axis), side * float(normal @ outwards) / np.linalg.norm(outwards)
        ),
        "slip": float((of_ball - of_ring) @ along),
        "entrainment": float((0.5 * (of_ball + of_ring) - travel) @ along),
        "spin_velocity": float((spin - ring_spin) @ normal),
    }


SCALES = {"contact_angle": 1.0, "slip": 5.0, "entrainment": 5.0, "spin_velocity": 500.0}


@pytest.mark.parametrize("seed", range(6))
def test_sphere_in_torus(seed: int) -> None:
    """Compare contacts with differences of moving points.

    Displaced, tilted and moving rings: angles and velocities of every contact.
    """
    m = machine(*MODEL)
    state = jostle(m, rolling(m, 150.0), np.random.default_rng(seed), shift=1.5)
    channels = m.observe(m.vector(state))
    contacts = 0
    for j in range(m.count):
        for ring in range(2):
            wanted = expected(m, state, j, ring)
            assert (wanted is not None) == (channels["load"][j, ring] > 0.0)
            if wanted is None:
                continue
            contacts += 1
            for name, value in wanted.items():
                assert channels[name][j, ring] == pytest.approx(value, abs=1e-7 * SCALES[name]), (name, j, ring)
    assert contacts >= 6


def angular_contact(m: Machine, inner: float, depth: float = 5e-6) -> tuple[State, float, float]:
    """Return rolling balls in angular contact.

    They roll truly at both raceways and do not spin on the outer one.

    Also the contact angle [rad] and gamma' = D/d_m at the contacts' centres. Outer ring at rest, no slip, rolling axis
    pitched by beta with tan(beta) = sin(alpha)/(cos(alpha) + gamma') (outer raceway control: Harris and Kotzalas,
    Rolling Bearing Analysis, 5th ed., vol. 2, ch. 2).
    """
    grooves, radii = m.constant("groove_circle"), m.constant("groove_radius")
    reach = radii - float(m.constant("ball_radius")) + depth
    alpha = math.acos((grooves[0] - grooves[1]) / (reach[0] + reach[1]))
    r, arm = float(grooves[0] - reach[0] * math.cos(alpha)), float(m.constant("ball_radius")) - 0.5 * depth
    ratio = arm / r
    gamma = ratio * math.cos(alpha)
    orbit = 0.5 * inner * (1.0 - gamma)
    beta = math.atan2(math.sin(alpha), math.cos(alpha) + ratio)
    roll = orbit * (1.0 + gamma) / (ratio * math.cos(alpha - beta))
    state = m.at_rest()
    state.balls[:, L.BR], state.balls[:, L.BVT] = r, orbit * r
    state.balls[:, L.BWX], state.balls[:, L.BWR] = orbit - roll * math.cos(beta), roll * math.sin(beta)
    state.shared[0, L.SX], state.shared[1, L.SX] = reach[0] * math.sin(alpha), -reach[1] * math.sin(alpha)
    state.shared[0, L.SSIGMA] = inner
    return state, alpha, ratio


def test_angular_contact_after_harris() -> None:
    """Compare kinematics with Harris.

    Contact angle, no slip, entrainment (d_m/4)(1 - gamma^2) omega_i, spin to roll of the inner raceway.
    """
    m = machine(*MODEL, "bearing.clearance=60 um")
    inner = 300.0
    state, alpha, ratio = angular_contact(m, inner)
    assert 0.2 < alpha < 0.6
    channels = m.observe(m.vector(state))
    gamma, r = ratio * math.cos(alpha), float(state.balls[0, L.BR])
    assert channels["contact_angle"] == pytest.approx(np.full((m.count, 2), alpha), abs=1e-12)
    assert channels["slip"] == pytest.approx(np.zeros((m.count, 2)), abs=1e-12 * inner)
    speed = 0.5 * r * (1.0 - gamma**2) * inner
    assert channels["entrainment"] == pytest.approx(np.full((m.count, 2), [speed, -speed]), rel=1e-12)
    beta = math.atan2(math.sin(alpha), math.cos(alpha) + ratio)
    rolling_speed = 0.5 * inner * (1.0 - gamma) * (1.0 + gamma) / ratio / (1.0 - gamma)
    spin_to_roll = (1.0 - gamma) * math.tan(alpha - beta) + ratio * math.sin(alpha)
    assert channels["spin_velocity"][:, 1] == pytest.approx(np.zeros(m.count), abs=1e-12 * inner)
    assert np.abs(channels["spin_velocity"][:, 0]) == pytest.approx(spin_to_roll * rolling_speed, rel=1e-12)


def test_gyroscopic_moment() -> None:
    """Compare M = I omega_orbit omega_R sin(beta).

    The torque that turns a ball's axis with its orbit, about the tangent.

    Harris and Kotzalas, Rolling Bearing Analysis, 5th ed., vol. 2, eq. 2.70: what a ball's angular acceleration lacks
    when nothing touches it.
    """
    m = machine(*MODEL, "bearing.clearance=200 um")
    state = m.at_rest()
    orbit, spin, beta = 60.0, 500.0, 0.3
    state.balls[:, L.BVT] = orbit * state.balls[:, L.BR]
    state.balls[:, L.BWX], state.balls[:, L.BWR] = -spin * math.cos(beta), spin * math.sin(beta)
    found = m.evaluate(m.vector(state))
    assert np.all(found.ball_forces == 0.0)
    rates = found.dydt[: L.NB * m.count].reshape(m.count, L.NB)
    assert rates[:, L.BWT] == pytest.approx(np.full(m.count, -orbit * spin * math.sin(beta)), rel=1e-12)
    assert rates[:, L.BWX] == pytest.approx(np.zeros(m.count), abs=1e-9)
    assert rates[:, L.BVR] == pytest.approx(orbit**2 * state.balls[:, L.BR], rel=1e-12)  # centrifugal


@pytest.mark.parametrize(("strips", "rows"), [(3, 1), (15, 1), (31, 1), (11, 7), (40, 21)])
def test_unit_grid(strips: int, rows: int) -> None:
    """Integrate area pi and load 2 pi/3 exactly.

    The unit ellipse; second moments to second order.
    """
    grid = unit_grid(strips, rows)
    place, along, pressure, area = grid[:4]
    cells = strips * rows
    assert grid.shape[0] == 6
    assert np.all(area[:cells] > 0.0)
    assert np.all(area[cells:] == 0.0)  # fills whole vectors
    assert np.sum(area) == pytest.approx(math.pi, rel=1e-12)
    assert np.sum(area * pressure) == pytest.approx(2.0 * math.pi / 3.0, rel=1e-12)
    for moment in (place, along, place * along):
        assert np.sum(area * moment) == pytest.approx(0.0, abs=1e-12)
    assert np.all(place**2 + along**2 <= 1.0)
    assert np.all((pressure > 0.0) & (pressure <= 1.0))
    if strips > 10:
        assert np.sum(area * place**2) == pytest.approx(math.pi / 4.0, rel=2.0 / strips**1.5)


@pytest.mark.parametrize("inner", [True, False])
def test_contact_radii(inner: bool) -> None:
    """Compare curvatures of ball and raceway.

    From the surfaces themselves, 6208 at 15.09 degrees.

    Along rolling a raceway is curved by the distance of the contact from the shaft's axis along the normal (Meusnier).
    """
    ball, pitch, groove, angle = 11.91e-3, 60e-3, (6.19e-3 if inner else 6.31e-3), math.radians(15.09)
    along, across = ball_raceway_radii(ball, pitch, groove, angle, inner=inner)
    to_axis = 0.5 * pitch / math.cos(angle) + (-0.5 if inner else 0.5) * ball  # along the normal
    race = 1.0 / to_axis if inner else -1.0 / to_axis
    assert 1.0 / along == pytest.approx(2.0 / ball + race, rel=1e-12)
    assert 1.0 / across == pytest.approx(2.0 / ball - 1.0 / groove, rel=1e-12)
