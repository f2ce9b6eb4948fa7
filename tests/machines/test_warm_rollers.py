"""Test friction and temperatures of rollers that shafts tilt."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from lambda_core import api
from lambda_core.analysis.thermal.machine_temperatures import MachineLoop, without_temperatures
from lambda_core.solver.drivers.machine_statics import solve_machine

MOTOR: dict[str, Any] = {
    "name": "motor",
    "operation": {"speed": "3000 rpm"},
    "lubricant": {"name": "FVA3", "temperature": "70 degC"},
    "shaft": {"sections": [{"length": "280 mm", "diameter": "40 mm"}]},
    "bearings": {
        "drive": {"designation": "SKF NU 208 ECP", "at": "20 mm"},
        "other": {"designation": "SKF 6308", "at": "260 mm"},
    },
    "loads": {"belt": {"at": "5 mm", "force_z": "-3 kN"}},
}


@pytest.mark.full
def test_friction_of_tilted_rollers_changes_smoothly_with_the_clearance() -> None:
    """Change the clearance by single micrometres.

    Each moves the load zone, and the loss by a per cent or two; no place is without a loss.
    """
    machine = api.check(MOTOR)
    assert isinstance(machine, api.MachineModel)
    loop = MachineLoop(without_temperatures(machine))
    losses = []
    for clearance in np.array([35.5, 36.5, 37.5, 38.5]) * 1e-6:
        state = solve_machine(loop.there(np.array([343.15, 343.15, clearance, 13e-6, 0.0, 0.0])))
        found = state.rings[0].equilibrium()
        assert found.converged, clearance
        losses.append(float(found.losses.sum()))
    assert np.abs(np.diff(losses) / losses[0]).max() < 0.03
    assert np.ptp(np.diff(losses)) < 0.01 * losses[0]


@pytest.mark.full
def test_a_shaft_in_rollers_and_balls_has_temperatures() -> None:
    found = api.thermal(MOTOR)
    assert abs(found.energy_residual) < 1e-9
    losses = {name: sum(one.losses_W.values()) for name, one in found.bearings.items()}
    assert losses["drive"] > 3.0 * losses["other"] > 0.0
    assert found.power_loss_W == pytest.approx(sum(losses.values()), rel=1e-6)
