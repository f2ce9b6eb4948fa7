"""Test motion without contacts, where the answer is known.

Free flight, torque-free spinning tops.
"""

from __future__ import annotations

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from lambda_core.solver.arrays import bundle as L

from .support import (
    ALL_FREE,
    FloatArray,
    angular_velocity,
    axis_of,
    ball_centre,
    inertial,
    integrate,
    machine,
)

EMPTY = (
    "bearing.clearance=600 um", "depth.cage=true", "models.cage_contact=none", "models.fluid_drag=none",
    "loads.radial=0 N", *ALL_FREE,
)  # fmt: skip


def test_balls_fly_on_parabolas() -> None:
    """Compare flying balls with parabolas.

    Oblique gravity, orbital and other velocities: a parabola and a constant spin in the inertial frame.
    """
    m = machine(*EMPTY, "gravity.x=7 m/s2", "gravity.y=-20 m/s2", "gravity.z=-30 m/s2")
    rng = np.random.default_rng(5)
    start = m.at_rest()
    start.balls[:, 3:6] = rng.uniform(-0.03, 0.03, (m.count, 3)) + np.array([0.0, 0.0, 1.5])
    start.balls[:, 6:] = rng.uniform(-200.0, 200.0, (m.count, 3))
    motion = integrate(m, m.vector(start), 1.5e-3, 1e-8, samples=10)
    gravity = np.array([7.0, -20.0, -30.0])
    for j in range(m.count):
        x0, psi0 = ball_centre(start.balls[j]), start.balls[j, L.BPSI]
        v0, w0 = inertial(psi0, start.balls[j, 3:6]), inertial(psi0, start.balls[j, 6:])
        for t, ball in zip(motion.times, motion.ball(j), strict=True):
            psi = ball[L.BPSI]
            assert ball_centre(ball) == pytest.approx(x0 + v0 * t + 0.5 * gravity * t**2, abs=1e-9)
            assert inertial(psi, ball[3:6]) == pytest.approx(v0 + gravity * t, abs=1e-6)
            assert inertial(psi, ball[6:]) == pytest.approx(w0, abs=1e-3)
    assert np.all(m.observe(motion.states[-1])["load"] == 0.0)
    assert np.ptp(motion.ball(0)[:, L.BPSI]) > 0.02


def attitude(body: FloatArray) -> FloatArray:
    """Return the body's axes as columns.

    The least rotation that takes x to its axis, then its spin angle.
    """
    a = axis_of(body)
    v = np.cross([1.0, 0.0, 0.0], a)
    angle = np.arctan2(np.linalg.norm(v), a[0])
    swing = Rotation.from_rotvec(angle * v / (np.linalg.norm(v) + 1e-300))
    return np.array((swing * Rotation.from_rotvec([body[L.STHETA], 0.0, 0.0])).as_matrix())


@pytest.mark.parametrize(("b", "tilt"), [(0, 0.001), (2, 0.6)], ids=["inner ring", "cage"])
def test_a_spinning_body_left_alone_precesses(b: int, tilt: float) -> None:
    """Compare precession with Euler's equations.

    A symmetric top: omega = H/I_t + (1 - I_p/I_t) sigma a; its axis goes round H at |H|/I_t.

    The attitude is exp([H/I_t] t) exp([(1 - I_p/I_t) sigma a_0] t): it also checks that the spin angle is counted from
    the frame of least rotation, whatever the way of the axis (holonomy). Goldstein, Classical Mechanics, section 5.6.
    """
    m = machine(*EMPTY, "gravity.z=0 m/s2", "bodies.inner_ring.spin=free")
    it, ip = m.constant("transverse_inertia")[b], m.constant("polar_inertia")[b]
    start = m.at_rest()
    body = start.shared[b]
    body[L.SAY], body[L.SAZ] = tilt, -0.5 * tilt
    body[L.SWY], body[L.SWZ], body[L.SSIGMA], body[L.STHETA] = 300.0 * tilt, 100.0 * tilt, 300.0, 0.4
    duration = 0.03
    motion = integrate(m, m.vector(start), duration, 1e-7, samples=20)
    a0, w0, first = axis_of(body), angular_velocity(body), Rotation.from_matrix(attitude(body))
    momentum = it * (w0 - 300.0 * a0) + ip * 300.0 * a0
    for t, y in zip(motion.times, motion.states, strict=True):
        now = m.state(y).shared[b]
        turned = Rotation.from_rotvec(momentum / it * t) * Rotation.from_rotvec((1.0 - ip / it) * 300.0 * a0 * t)
        assert now[L.SSIGMA] == pytest.approx(300.0, rel=1e-9)
        error = Rotation.from_matrix(attitude(now)).inv() * (turned * first)
        assert error.magnitude() < 2e-5
    assert np.linalg.norm(momentum) / it * duration > 3.0  # about half a turn of the axis or more
