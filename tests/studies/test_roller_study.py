"""Test studies of bearings with rollers."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from lambda_core import api

MOTOR = Path(__file__).parents[2] / "examples" / "roller-shafts" / "motor.toml"


def _row(case: Any, path: str, value: str, names: list[str], folder: Path) -> dict[str, Any]:
    study = {"name": "one", "case": case, "responses": names, "parameters": [{"path": path, "values": [value]}]}
    status = api.study_run(study, folder, executor="here")
    assert status.done == 1, status.reasons
    (found,) = api.study_table(folder).rows()
    return dict(found)


def test_a_study_has_the_torque_of_the_quasi_static_page(tmp_path: Path) -> None:
    """Average over the positions of the rollers in both.

    With one roller lowest, the torque of this NU 208 is 11 % below the mean over a pitch.
    """
    case = str(api.init_case("nu", bearing="SKF NU 208 ECP", path=tmp_path / "nu.toml"))
    names = ["friction_torque_Nmm", "friction_breakdown_Nmm", "power_loss_W", "max_pressure_GPa", "max_load_N"]
    row = _row(case, "loads.radial", "3 kN", names, tmp_path / "one")
    still = api.quasistatic(case, ["loads.radial=3 kN"])
    for name in ("friction_torque_Nmm", "power_loss_W", "max_pressure_GPa", "max_load_N"):
        assert row[name] == pytest.approx(getattr(still, name), rel=1e-12)
    parts = {name: value for name, value in row.items() if name.startswith("friction_breakdown_Nmm.")}
    assert "friction_breakdown_Nmm.rib" in parts
    assert sum(parts.values()) == pytest.approx(row["friction_torque_Nmm"], rel=1e-12)


def test_the_bearings_of_a_shaft_add_up_to_its_torque(tmp_path: Path) -> None:
    names = ["friction_torque_Nmm", "power_loss_W", "fan.friction_torque_Nmm", "belt.friction_torque_Nmm"]
    row = _row(str(MOTOR), "operation.speed", "1500 rpm", names, tmp_path / "motor")
    added = row["fan.friction_torque_Nmm"] + row["belt.friction_torque_Nmm"]
    assert row["friction_torque_Nmm"] == pytest.approx(added, rel=1e-9)
    assert row["power_loss_W"] == pytest.approx(row["friction_torque_Nmm"] * 1.5e3 * 3.141592653589793 / 3e4, rel=1e-6)


def test_a_duty_cycle_of_rollers_has_their_mean_load(tmp_path: Path) -> None:
    """Add damages with the exponent 10/3 by hand."""
    case = str(api.init_case("nu", bearing="SKF NU 208 ECP", path=tmp_path / "nu.toml"))
    phases = [
        {"name": "half", "time": "1 h", "changes": {"loads.radial": "5 kN"}},
        {"name": "full", "time": "1 h", "changes": {"loads.radial": "10 kN"}},
    ]
    found = api.duty({"name": "two", "case": case, "phases": phases})
    loads = [one.equivalent_load_N for one in found.phases]
    mean = (0.5 * (loads[0] ** (10 / 3) + loads[1] ** (10 / 3))) ** 0.3
    assert found.mean_load_N == pytest.approx(mean, rel=1e-9)
    speed = found.phases[0].speed_rpm
    assert found.basic_life_h == pytest.approx((62e3 / mean) ** (10 / 3) * 1e6 / (60 * speed), rel=1e-6)


def test_the_life_of_a_shaft_has_the_slopes_of_balls_and_rollers() -> None:
    found = api.quasistatic(MOTOR)
    lives = {name: one.rating.reference_life_h for name, one in found.bearings.items()}
    shares = {name: found.system_life_h / life for name, life in lives.items()}
    assert shares["fan"] ** (10 / 9) + shares["belt"] ** (9 / 8) == pytest.approx(1.0, rel=1e-6)
