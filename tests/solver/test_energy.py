"""Test energy over time.

What the integrator loses, what a whole run cannot account for.
"""

from __future__ import annotations

import numpy as np
import pytest

from lambda_core import api
from lambda_core.solver.arrays import bundle as L
from lambda_core.solver.drivers.dynamics import BearingEngine

from .support import integrate, machine
from .test_power import HARMONIC_OUTER_RING


def test_a_ball_without_friction_keeps_its_energy() -> None:
    """Keep the energy of nine frictionless balls.

    They orbit in the outer groove, pressed by centrifugal force, and oscillate across and along it.

    BDF of order 2 takes pi (omega h)^3 of the energy of an oscillation per period: 0.16 % in 48 periods of 280 steps.
    Bound: 0.4 % of the energy of vibration, 4e-8 of all energy. Angular momentum is not touched by it.
    """
    m = machine(
        "bearing.clearance=200 um", "depth.cage=false", "models.damping=none", "models.fluid_drag=none",
        "gravity.z=0 m/s2", "loads.radial=0 N",
    )  # fmt: skip
    start = m.at_rest()
    start.balls[:, L.BX] = np.linspace(-30e-6, 30e-6, m.count)
    start.balls[:, L.BR] += 54e-6  # touches at 50 um; stands still at 55 um
    start.balls[:, L.BVT] = 120.0 * start.balls[:, L.BR]
    with m.frictionless():
        motion = integrate(m, m.vector(start), 0.012, 1e-6, samples=800)
    radial = motion.ball(4)[:, L.BVR]
    periods = 0.5 * np.count_nonzero(np.diff(np.sign(radial)))
    assert periods > 40.0
    energies = np.array([m.stored(y) for y in motion.states[::50]])
    mass = m.constant("ball_mass")
    vibration = sum(0.5 * mass * np.max(motion.ball(j)[:, L.BVR] ** 2) for j in range(m.count))
    assert vibration > 5e-4
    assert np.ptp(energies) < 0.004 * vibration
    assert np.ptp(energies) < 4e-8 * energies[0]
    for j in range(m.count):
        ball = motion.ball(j)
        assert np.ptp(ball[:, L.BR] * ball[:, L.BVT]) < 1e-8 * ball[0, L.BR] * ball[0, L.BVT]
        assert abs(ball[:, L.BX]).max() < 1.01 * max(abs(start.balls[j, L.BX]), 1e-6)


def residual(duration: float, *overrides: str, case: str = "6319-cp10-3000") -> float:
    """Return (input - losses - stored)/|input| of a run."""
    engine = BearingEngine(api.check(case, overrides))
    done = engine.advance(duration)
    assert done.ok, done.message
    integrals = engine.integrals()
    lost = sum(value for name, value in integrals.items() if name.startswith(("loss.", "support")))
    assert integrals["input_abs"] > 0.0
    return (integrals["input"] - lost - integrals["stored"]) / integrals["input_abs"]


TURN = 0.0502  # of the cage of the 6319 at 3000 1/min [s]


@pytest.mark.parametrize("cage", ["true", "false"])
@pytest.mark.parametrize("case", ["6319-cp10-3000", "6208-axial-700"])
def test_residual_at_default_tolerance(case: str, cage: str) -> None:
    """Bound the residual by 1e-3 of the input.

    Over two turns of the cage, start included.
    """
    assert abs(residual(2.0 * TURN, f"depth.cage={cage}", case=case)) < 1e-3


@pytest.mark.parametrize("case", ["6319-cp10-3000", "6208-axial-700"])
def test_residual_at_tight_tolerance(case: str) -> None:
    assert abs(residual(0.5 * TURN, "depth.cage=false", "solver.tolerance=1e-6", case=case)) < 1e-5


def test_residual_falls_with_the_tolerance() -> None:
    tolerances = ("1e-2", "1e-4", "1e-6")
    coarse, fine, finest = (
        abs(residual(0.3 * TURN, "depth.cage=false", f"solver.tolerance={tolerance}")) for tolerance in tolerances
    )
    assert coarse < 1e-3
    assert fine < min(0.1 * coarse, 1e-4)
    assert finest < 1e-5


def test_residual_with_a_shaken_outer_ring() -> None:
    """Count work of prescribed motions as input."""
    assert abs(residual(0.3 * TURN, "solver.tolerance=1e-5", "depth.cage=false", *HARMONIC_OUTER_RING)) < 1e-4
