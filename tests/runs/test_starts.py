"""Test where runs start."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest

from lambda_core import api
from lambda_core.results.quasistatic import quasistatic_of
from lambda_core.runs.beginning import rolling_warnings
from lambda_core.solver.drivers.equilibrium import solve

CASE = {
    "name": "rollers",
    "bearing": {"designation": "SKF 32208"},
    "lubricant": {"name": "FVA3", "temperature": "70 degC"},
    "loads": {"radial": "3 kN", "axial": "2 kN"},
    "operation": {"speed": "3000 rpm"},
    "solver": {"duration": "0.1 ms"},
}


def test_a_case_a_model_an_estimate_and_a_run_give_the_same_numbers(tmp_path: Path) -> None:
    """Compare answers about a tapered bearing.

    The model, behind reports, and the estimate had those of friction between rings; lives of a run left thrust out and
    had their rollers at other places.
    """
    model = api.check(CASE)
    answer = api.quasistatic(CASE)
    assert api.quasistatic(model).to_dict() == answer.to_dict()
    assert api.estimate(CASE).equilibrium.to_dict() == answer.to_dict()
    summary = api.run(CASE, out=tmp_path / "rollers.h5").summary()
    assert summary.rating == answer.rating
    assert summary.equilibrium.loaded_elements == answer.loaded_elements
    assert summary.equilibrium.max_load_N == pytest.approx(answer.max_load_N, rel=1e-3)
    assert summary.equilibrium.max_pressure_GPa == pytest.approx(answer.max_pressure_GPa, rel=1e-3)


def test_a_run_begins_in_rolling_where_no_steady_motion_is_found(tmp_path: Path) -> None:
    """Run needle rollers in cold oil.

    The search cannot bring them to a steady motion. A machine ran there; a bearing alone was refused, with the
    advice to run it.
    """
    case = CASE | {
        "bearing": {"designation": "NA 4905"},
        "lubricant": {"name": "cylinder-oil-lvi", "temperature": "-9 degC"},
        "loads": {"radial": "329 N"},
        "operation": {"speed": "24 rpm"},
    }
    summary = api.run(case, out=tmp_path / "rollers.h5").summary()
    assert sum("no steady motion of the rollers was found" in warning for warning in summary.warnings) == 1
    assert summary.state == "finished"


def test_balls_without_a_steady_motion_have_no_friction_torque() -> None:
    """Print no torque of balls that only roll."""
    found = solve(api.check("6208-axial-1300"))
    answer = quasistatic_of(replace(found, converged=False))
    assert quasistatic_of(found).friction_torque_Nmm is not None
    assert answer.friction_torque_Nmm is None
    assert answer.power_loss_W is None
    assert "the balls have no steady motion at this load: no friction torque" in answer.warnings
    assert "friction torque  unknown: no steady motion was found" in answer.text()
    assert rolling_warnings(found) == ()
