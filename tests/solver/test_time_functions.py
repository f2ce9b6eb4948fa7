"""Test loads and motions over time in compiled code."""

from __future__ import annotations

import math
from collections.abc import Callable
from itertools import pairwise

import numpy as np
import pytest
from scipy.interpolate import CubicHermiteSpline, CubicSpline, PPoly

from lambda_core import api
from lambda_core.model.checking import check_bearing
from lambda_core.solver.arrays import bundle as L

from .support import CASE, FloatArray, Machine, machine, time_function

TIMES = np.linspace(-1e-3, 25e-3, 53)  # before, within and after all of the functions below
POINTS = [(0.0, 1.0), (4e-3, 3.0), (9e-3, -2.0), (15e-3, 0.5), (17e-3, 2.0), (20e-3, 2.5)]  # s, kN


def table(section: str, **how: str) -> Machine:
    signal = {"kind": "table", "points": [[f"{t!r} s", f"{v!r} kN"] for t, v in POINTS], **how}
    return Machine(check_bearing(api.case(CASE).with_(loads={section: signal})))


def values(m: Machine, kind: str, body: int, component: int) -> FloatArray:
    """Return value and derivatives at TIMES, (n, 3)."""
    return np.array([time_function(m, kind, body, component, float(t)) for t in TIMES])


def test_ramp() -> None:
    m = machine(
        "loads.axial.kind=ramp", "loads.axial.start=1 kN", "loads.axial.end=5 kN", "loads.axial.start_time=2 ms",
        "loads.axial.end_time=12 ms",
    )  # fmt: skip
    found = values(m, "force", 0, 0)
    assert found[:, 0] == pytest.approx(np.interp(TIMES, [2e-3, 12e-3], [1e3, 5e3]))
    inside = (TIMES > 2e-3) & (TIMES < 12e-3)
    assert found[:, 1] == pytest.approx(np.where(inside, 4e5, 0.0))


def test_sum_of_a_constant_and_a_harmonic() -> None:
    case = api.case(CASE).with_(
        loads={
            "axial": {
                "kind": "sum",
                "terms": ["2 kN", {"kind": "harmonic", "amplitude": "300 N", "frequency": "120 Hz", "phase": "25 deg"}],
            }
        }
    )
    found, w, phase = values(Machine(check_bearing(case)), "force", 0, 0), 2.0 * math.pi * 120.0, math.radians(25.0)
    assert found[:, 0] == pytest.approx(2000.0 + 300.0 * np.sin(w * TIMES + phase))
    assert found[:, 1] == pytest.approx(300.0 * w * np.cos(w * TIMES + phase))
    assert found[:, 2] == pytest.approx(-300.0 * w * w * np.sin(w * TIMES + phase))


def monotone(times: FloatArray, level: FloatArray) -> PPoly[np.float64]:
    """Return the monotone cubics.

    With the slopes of Fritsch and Butland 1984, 0 at both ends, written from the paper.
    """
    gap, slope = np.diff(times), np.diff(level) / np.diff(times)
    inner = []
    for (h0, h1), (s0, s1) in zip(pairwise(gap), pairwise(slope), strict=True):
        share = (h0 + 2.0 * h1) / (3.0 * (h0 + h1))
        inner.append(s0 * s1 / (share * s1 + (1.0 - share) * s0) if s0 * s1 > 0.0 else 0.0)
    return CubicHermiteSpline(times, level, [0.0, *inner, 0.0])


def clamped(times: FloatArray, level: FloatArray) -> PPoly[np.float64]:
    return CubicSpline(times, level, bc_type="clamped")


@pytest.mark.parametrize(
    ("how", "curve"),
    [({}, monotone), ({"interpolation": "monotone"}, monotone), ({"interpolation": "spline"}, clamped)],
)
def test_a_table_is_joined_as_it_says_and_held_outside(
    how: dict[str, str], curve: Callable[[FloatArray, FloatArray], PPoly[np.float64]]
) -> None:
    found = values(table("axial", **how), "force", 0, 0)
    times, level = (np.array(column) for column in zip(*POINTS, strict=True))
    spline = curve(times, 1e3 * level)
    held = np.clip(TIMES, times[0], times[-1])
    inside = (held == TIMES) & (times[0] < TIMES) & (times[-1] > TIMES)
    assert found[:, 0] == pytest.approx(spline(held), abs=1e-9)
    for order in (1, 2):
        largest = np.abs(spline(TIMES[inside], order)).max()
        assert found[inside, order] == pytest.approx(spline(TIMES[inside], order), abs=1e-12 * largest)
        assert np.all(found[~inside, order] == 0.0)
    at_points = [time_function(table("axial", **how), "force", 0, 0, t)[0] for t, _ in POINTS]
    assert at_points == pytest.approx([1e3 * v for _, v in POINTS])


def test_every_load_reaches_its_own_body_and_axis() -> None:
    m = machine(
        "loads.radial=0 N", "bodies.outer_ring.x=free", "bodies.outer_ring.y=free", "bodies.outer_ring.z=free",
        "bodies.outer_ring.tilt_y=free", "bodies.outer_ring.tilt_z=free",
        *(f"loads.{body}.{name}={10 * b + i + 1} {unit}"
          for b, body in enumerate(("inner_ring", "outer_ring", "cage"))
          for i, (name, unit) in enumerate((("force_x", "N"), ("force_y", "N"), ("force_z", "N"),
                                            ("moment_y", "N m"), ("moment_z", "N m")))),
    )  # fmt: skip
    for b in range(3):
        forces = [time_function(m, "force", b, i, 0.0)[0] for i in range(3)]
        moments = [time_function(m, "moment", b, i, 0.0)[0] for i in range(3)]
        assert forces == pytest.approx([10 * b + 1, 10 * b + 2, 10 * b + 3])
        assert moments == pytest.approx([0.0, 10 * b + 4, 10 * b + 5])


# Position, velocity and sign; turning about y leans the axis to -z, about z to +y.
DOFS = {
    "x": (L.SX, L.SVX, 1.0),
    "y": (L.SY, L.SVY, 1.0),
    "z": (L.SZ, L.SVZ, 1.0),
    "tilt_y": (L.SAZ, L.SWY, -1.0),
    "tilt_z": (L.SAY, L.SWZ, 1.0),
}


@pytest.mark.parametrize("dof", DOFS)
def test_a_prescribed_body_moves_as_told(dof: str) -> None:
    """Compare position, velocity and axis.

    Velocities are the derivatives of the positions.
    """
    amplitude = "0.2 mrad" if "tilt" in dof else "7 um"
    size, w = (2e-4 if "tilt" in dof else 7e-6), 2.0 * math.pi * 300.0
    m = machine(
        *(f"bodies.outer_ring.{dof}.{what}" for what in (
            "mode=prescribed", "motion.kind=harmonic", f"motion.amplitude={amplitude}", "motion.frequency=300 Hz"))
    )  # fmt: skip
    y = m.vector(m.at_rest())
    for t in (0.0, 4e-4, 1.3e-3):
        ring = m.shared_state(y, t)[1]
        wanted, speed = size * math.sin(w * t), size * w * math.cos(w * t)
        place, velocity, sign = DOFS[dof]
        assert sign * ring[place] == pytest.approx(wanted, abs=1e-15)
        assert ring[velocity] == pytest.approx(speed, abs=1e-12)
        others = np.delete(ring, [place, velocity])
        assert np.all(others == 0.0)


def test_a_ramped_speed_accelerates_the_ring() -> None:
    m = machine(
        "operation.speed.kind=ramp", "operation.speed.start=300 rpm", "operation.speed.end=900 rpm",
        "operation.speed.end_time=10 ms",
    )  # fmt: skip
    y = m.vector(m.at_rest())
    for t, speed in ((0.0, 300.0), (5e-3, 600.0), (20e-3, 900.0)):
        assert m.shared_state(y, t)[0, L.SSIGMA] == pytest.approx(speed * math.pi / 30.0)
    drive = m.evaluate(y, 5e-3).drive_power
    polar = m.model.inner_ring.polar_inertia
    # nothing but inertia resists: all balls stand in the middle of their play
    assert drive == pytest.approx(polar * (600.0 * math.pi / 30.0 / 10e-3) * 600.0 * math.pi / 30.0, rel=1e-9)
