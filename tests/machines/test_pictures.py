"""Test pictures of a machine at its operating point."""

from __future__ import annotations

import tomllib

import pytest

from lambda_core import api
from lambda_core.analysis.rotor.machine_modes import MachineModes
from lambda_core.model.machine_templates import geared_shaft


def test_gears_and_the_running_speed_are_drawn() -> None:
    model = api.check(tomllib.loads(geared_shaft("box")))
    assert isinstance(model, api.MachineModel)
    found, modes = api.quasistatic(model), api.modes(model)
    assert isinstance(modes, MachineModes)
    drawn = {view.view: view for view in api.machine_pictures(model, equilibrium=found, modes=modes)}  # type: ignore[arg-type]
    names = [series.name for series in drawn["shaft"].panels[0].series]
    assert "gears" in names
    marks = drawn["whirl"].panels[0].marks
    assert [(mark.label, mark.value) for mark in marks] == [("running speed", pytest.approx(3000.0))]
