"""Test a bearing of a machine by itself.

The same balls under the same load as in the machine.
"""

from __future__ import annotations

import tomllib

import numpy as np
import pytest

from lambda_core import api
from lambda_core.analysis.rotor.bearing_alone import alone_under_load, at_speed, bearing_alone
from lambda_core.model.machine_templates import shaft_text
from lambda_core.solver.drivers.equilibrium import solve
from lambda_core.solver.drivers.machine_statics import solve_machine


@pytest.mark.parametrize("number", [0, 1])
def test_a_bearing_alone_is_that_of_the_machine(number: int) -> None:
    """Compare a bearing alone with its machine.

    It is free under the load where the machine holds it: loads to 2 N of 236, friction and position to 2 %.
    """
    machine = api.check(tomllib.loads(shaft_text("geared-shaft", "box")))
    state = solve_machine(machine)
    held = state.rings[number].equilibrium()
    free = solve(alone_under_load(machine, state, number))
    assert np.abs(free.contacts[:, :, 0] - held.contacts[:, :, 0]).max() < 2.0  # friction of balls carries a part
    assert free.losses.sum() == pytest.approx(held.losses.sum(), rel=0.02)
    pose = state.pose(machine, number)
    assert free.displacement[1:3] == pytest.approx(pose[1:3].tolist(), abs=0.1e-6)
    assert free.displacement[3:] == pytest.approx(pose[3:].tolist(), rel=1e-9)


def test_a_bearing_alone_turns_at_another_speed() -> None:
    """Compare the Stribeck curve at the machine's speed.

    The torque is that of its equilibrium, over ball positions.
    """
    tables = tomllib.loads(shaft_text("geared-shaft", "box"))
    curve = api.stribeck(tables, bearing="left", speeds_rpm=[1500.0, 3000.0])
    torque = api.quasistatic(tables).bearing("left").friction_torque_Nmm
    assert curve.torque_Nmm[1] == pytest.approx(torque, rel=0.02)
    assert curve.torque_Nmm[0] < 0.9 * curve.torque_Nmm[1]
    machine = api.check(tables)
    assert at_speed(machine.bearings[0].model, 7.0).inner_ring.dofs["spin"].motion.terms[0].values == (7.0,)


def test_a_bearing_taken_out_keeps_its_surroundings() -> None:
    """Warm the air around a bearing taken out.

    Every part warms by less than the air: warmer oil is thinner and makes less heat.
    """
    found = []
    for ambient in ("20 degC", "50 degC"):
        machine = api.check(tomllib.loads(shaft_text("geared-shaft", "box")) | {"thermal": {"ambient": ambient}})
        found.append(api.thermal(bearing_alone(machine, "left")).temperatures_degC)
    warmer = [found[1][part] - found[0][part] for part in found[0] if part != "ambient"]
    assert all(10.0 < difference < 30.0 for difference in warmer), warmer
