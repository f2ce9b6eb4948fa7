"""Test the bearing at rest and running, without time.

Angles, loads, deflection and speeds against known values.
"""

from __future__ import annotations

import math

import numpy as np
import pytest

from lambda_core import api
from lambda_core.formulas.kinematics import cage_speed
from lambda_core.solver.drivers.dynamics import BearingEngine
from lambda_core.solver.drivers.equilibrium import Equilibrium, solve
from lambda_core.solver.records import CONTACT_CHANNELS

from .published import Published

SYMMETRIC = ("gravity.z=0 m/s2", "models.fluid_drag=none")  # nothing tells the balls apart
# Exact Hertz and the balance of forces of Jones 1960, evaluated apart from the program for the bearing of
# Syla et al. 2026, Table 6.
STATIC = {700: (13.59, 330.9), 1300: (15.09, 554.7), 2000: (16.33, 790.3)}
RUNNING = {700: (13.66, 13.55), 1300: (15.14, 15.06), 2000: (16.37, 16.31)}
SOURCE = "force balance of one ball with exact Hertz constants (Jones 1960)"


def channel(equilibrium: Equilibrium, name: str) -> np.ndarray:
    """Return a contact channel, (Z, 2)."""
    return equilibrium.contacts[:, :, CONTACT_CHANNELS.index(name)]


def check_equal(values: np.ndarray) -> None:
    """Check that all balls are alike.

    The bearing is axially loaded.
    """
    assert np.ptp(values, axis=0) == pytest.approx(np.zeros(2), abs=1e-9 * np.abs(values).max())


@pytest.mark.parametrize("load", STATIC)
def test_static_angles_and_loads(load: int) -> None:
    equilibrium = solve(api.check(f"6208-axial-{load}", (*SYMMETRIC, "operation.speed=0 rpm", "solver.duration=1 s")))
    angles, loads = np.degrees(channel(equilibrium, "contact_angle")), channel(equilibrium, "load")
    check_equal(angles)
    check_equal(loads)
    for ring in range(2):
        Published(STATIC[load][0], SOURCE, "specification", rel=0.005).check(float(angles[0, ring]))
        Published(STATIC[load][1], SOURCE, "specification", rel=0.005).check(float(loads[0, ring]))
    assert np.sum(loads[:, 0] * np.sin(np.radians(angles[:, 0]))) == pytest.approx(load, rel=1e-9)


@pytest.mark.parametrize("load", RUNNING)
def test_running_angles(load: int) -> None:
    """Lower the outer angle, raise the inner one.

    Centrifugal force does both at 2750 1/min.
    """
    equilibrium = solve(api.check(f"6208-axial-{load}", SYMMETRIC))
    angles = np.degrees(channel(equilibrium, "contact_angle"))
    check_equal(angles)
    for ring in range(2):
        Published(RUNNING[load][ring], SOURCE, "specification", abs=0.1).check(float(angles[0, ring]))
    assert angles[0, 0] > angles[0, 1]


def test_radial_deflection() -> None:
    """Compare displacement with clearance and elastic approach.

    6208, 2 kN, 14 um clearance, 2750 1/min: the ring sinks by half the clearance and the approach.
    """
    equilibrium = solve(api.check("6208-axial-700", ("loads.axial=0 N", "loads.radial=2 kN")))
    deflection = math.hypot(*equilibrium.displacement[1:3]) * 1e6
    Published(28.5, "ball loads after ISO/TS 16281 with exact Hertz constants", "specification", rel=0.01).check(
        deflection
    )


@pytest.mark.parametrize("outer", [0.0, -200.0, 120.0])
def test_epicyclic_speed_in_the_limit_of_small_contacts(outer: float) -> None:
    """Reach Harris's orbital speed as contacts shrink.

    Balls roll without any resistance.

    A contact of finite width rolls truly in two bands only (Heathcote), which makes the balls faster by an amount
    proportional to the square of its width, a^2 ~ Q^(2/3): 4.64 times for ten times the load.
    """
    deviations = []
    for load in (2000, 200, 20):
        overrides = (
            *SYMMETRIC, "models.rolling_resistance=none", "models.elastic_hysteresis=none", f"loads.axial={load} N",
            "models.asperity_load=none",
            "operation.speed=300 rpm",
        )  # fmt: skip
        if outer:
            overrides += ("bodies.outer_ring.spin.mode=prescribed", f"bodies.outer_ring.spin.motion={outer} rpm")
        model = api.check("6208-axial-700", overrides)
        equilibrium = solve(model)
        g, inner_speed, outer_speed = model.geometry, 300.0 * math.pi / 30.0, outer * math.pi / 30.0
        angle = float(np.mean(channel(equilibrium, "contact_angle")))
        epicyclic = cage_speed(inner_speed, outer_speed, g.ball_diameter * math.cos(angle) / g.pitch_diameter)
        deviations.append((equilibrium.orbit - epicyclic) / abs(inner_speed - outer_speed))
    source = "Harris and Kotzalas, Rolling Bearing Analysis, 5th ed., vol. 1, ch. 10"
    Published(0.0, source, "creep of a contact of finite width, 20 N", abs=5e-5).check(deviations[2])
    assert deviations[0] / deviations[1] == pytest.approx(10.0 ** (2.0 / 3.0), rel=0.05)
    assert deviations[0] < 6e-4


@pytest.mark.parametrize("cage", ["true", "false"])
def test_the_dynamics_keep_the_epicyclic_speed(cage: str) -> None:
    """Keep the light-load speed over half a turn.

    Cage and balls turn with half a turn of the inner ring.
    """
    overrides = (
        *SYMMETRIC, "models.rolling_resistance=none", "models.elastic_hysteresis=none", "loads.axial=20 N",
        "operation.speed=300 rpm", f"depth.cage={cage}",
    )  # fmt: skip
    model = api.check("6208-axial-700", overrides)
    engine = BearingEngine(model)
    assert engine.advance(0.1).ok
    integrals, g = engine.integrals(), model.geometry
    angle = float(np.mean(engine.samples()["contact_angle"][-1]))
    epicyclic = 0.5 * (1.0 - g.ball_diameter * math.cos(angle) / g.pitch_diameter)
    assert integrals["inner_angle"] > 0.99 * math.pi
    Published(epicyclic, "Harris and Kotzalas, ch. 10", "creep of a contact of finite width", rel=2e-4).check(
        integrals["cage_angle"] / integrals["inner_angle"]
    )
