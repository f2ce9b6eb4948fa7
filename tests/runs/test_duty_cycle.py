"""Test duty cycles.

Damages of the phases add up to a life, their losses to a mean.
"""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest
from lambda_cli.main import main

from lambda_core import api
from lambda_core.domain.errors import CaseError, UsageError
from lambda_core.studies.duty_cycle import DutyCycle, PhaseResult, _added, _mean_load

LIGHT = {"loads.radial": "3 kN", "operation.speed": "3000 rpm"}


def cycle(*phases: dict[str, Any]) -> dict[str, Any]:
    return {"name": "day", "case": "6208-axial-700", "phases": list(phases)}


@pytest.fixture(scope="module")
def day() -> DutyCycle:
    """Return a duty of two quarters.

    One under a load of its own, one at rest.
    """
    return api.duty(
        cycle(
            {"name": "as it is", "time": "12 h"},
            {"name": "loaded", "time": "6 h", "changes": LIGHT},
            {"name": "rest", "time": "6 h", "changes": {"operation.speed": "0 rpm"}},
        )
    )


def test_each_phase_is_the_equilibrium_of_its_case(day: DutyCycle) -> None:
    loaded = day.phases[1]
    alone = api.quasistatic("6208-axial-700", [f"{path}={value}" for path, value in LIGHT.items()])
    compared = api.compare("6208-axial-700", [f"{path}={value}" for path, value in LIGHT.items()])
    assert loaded.share == 0.25
    assert loaded.friction_torque_Nmm == pytest.approx(alone.friction_torque_Nmm, rel=1e-9)
    assert loaded.basic_life_h == pytest.approx(compared.value("iso-281", "life", "basic rating life, hours"), rel=1e-9)
    assert loaded.power_loss_W == pytest.approx(
        1e-3 * (loaded.friction_torque_Nmm or 0.0) * loaded.speed_rpm * 3.141592653589793 / 30.0, rel=1e-9
    )


def test_a_phase_has_the_numbers_and_warnings_of_its_equilibrium() -> None:
    heavy = {"loads.radial": "30 kN"}
    found = api.duty(cycle({"name": "heavy", "time": "1 h", "changes": heavy})).phases[0]
    alone = api.quasistatic("6208-axial-700", ["loads.radial=30 kN"])
    assert (found.friction_torque_Nmm, found.power_loss_W) == (alone.friction_torque_Nmm, alone.power_loss_W)
    assert found.warnings == alone.warnings
    assert any("GPa" in warning for warning in found.warnings)


def test_a_phase_of_rollers_has_the_numbers_of_their_operating_point(tmp_path: Path) -> None:
    """Compare a phase with the answer about its case.

    Its torque was that of the equilibrium that a run starts from: 11 % less.
    """
    path = api.init_case("belt", path=tmp_path / "belt.toml", bearing="NU 208 ECP", changes=["loads.radial=3 kN"])
    alone = api.quasistatic(path)
    (phase,) = api.duty({"name": "day", "case": str(path), "phases": [{"name": "belt", "time": "1 h"}]}).phases
    assert (phase.friction_torque_Nmm, phase.power_loss_W) == (alone.friction_torque_Nmm, alone.power_loss_W)
    assert alone.rating is not None
    assert phase.reference_life_h == alone.rating.reference_life_h


def test_damages_add(day: DutyCycle) -> None:
    first, second, rest = day.phases
    assert first.reference_life_h is not None
    assert second.reference_life_h is not None
    damage = 0.5 / first.reference_life_h + 0.25 / second.reference_life_h
    assert day.reference_life_h == pytest.approx(1.0 / damage, rel=1e-12)
    assert (rest.damage, rest.power_loss_W, rest.friction_torque_Nmm) == (0.0, 0.0, None)
    assert sum(phase.damage or 0.0 for phase in day.phases) == pytest.approx(1.0, rel=1e-12)
    assert day.mean_power_loss_W == pytest.approx(0.5 * first.power_loss_W + 0.25 * second.power_loss_W)
    joule = 12.0 * 3600.0 * first.power_loss_W + 6.0 * 3600.0 * second.power_loss_W
    assert day.energy_loss_kJ == pytest.approx(1e-3 * joule, rel=1e-12)
    assert day.energy_loss_kWh_per_year == pytest.approx(joule / 3.6e6 * 365.25, rel=1e-12)
    assert f"{day.energy_loss_kWh_per_year:.1f} kWh in a year" in day.text()
    assert day.mean_speed_rpm == pytest.approx(0.5 * first.speed_rpm + 0.25 * 3000.0)


def phase(share: float, speed: float, load: float, exponent: float) -> PhaseResult:
    """Return a phase of a duty cycle.

    Bearing with C = 10 kN by L = (C/P)^p.
    """
    life = 1e6 * (10e3 / load) ** exponent / (60.0 * speed) if speed else None
    return PhaseResult(
        name="", share=share, speed_rpm=speed, equivalent_load_N=load, basic_life_h=life, reference_life_h=None,
        damage=None, friction_torque_Nmm=None, power_loss_W=0.0, energy_loss_kJ=0.0, warnings=[],
    )  # fmt: skip


@pytest.mark.parametrize("exponent", [3.0, 10.0 / 3.0])
def test_the_mean_load_has_the_life_of_the_sum(exponent: float) -> None:
    """Compare SKF's mean load with Miner's rule.

    For L = (C/P)^p, p = 3 of balls and 10/3 of rollers, both give one life.
    """
    rows = ((0.3, 500.0, 4000.0), (0.5, 1500.0, 1000.0), (0.2, 0.0, 9000.0))
    phases = [phase(*row, exponent) for row in rows]
    speed = 0.3 * 500.0 + 0.5 * 1500.0
    mean = _mean_load(phases, speed, exponent)
    assert mean is not None
    assert _added(phases, "basic_life_h") == pytest.approx(1e6 * (10e3 / mean) ** exponent / (60.0 * speed), rel=1e-12)


def test_mistakes_are_told_at_their_place(tmp_path: Path) -> None:
    with pytest.raises(CaseError, match=r"phases\.0\.time") as caught:
        api.duty(cycle({"name": "a", "time": "0 h"}, {"time": "1 h"}))
    assert [problem.where for problem in caught.value.problems] == ["phases.0.time", "phases.1.name"]
    with pytest.raises(CaseError, match=r'phase "b", loads\.radail') as caught:
        api.duty(cycle({"name": "b", "time": "1 h", "changes": {"loads.radail": "1 N"}}))
    assert "nearest: radial" in caught.value.problems[0].message
    with pytest.raises(UsageError, match="is not a file: give a TOML file"):
        api.duty(tmp_path / "none.toml")
    (tmp_path / "loads.csv").write_text("time [h],loads.radial [kN]\n1,3\n")
    with pytest.raises(UsageError, match=r'is a load spectrum, not a duty cycle: .* spectrum = "loads.csv"'):
        api.duty(tmp_path / "loads.csv")
    (tmp_path / "case.toml").write_text('name = "case"\n[bearing]\ndesignation = "6208"\n')
    with pytest.raises(CaseError, match="is a case, not a duty cycle"):
        api.duty(tmp_path / "case.toml")
    (tmp_path / "bad.toml").write_text("name = day\n")
    with pytest.raises(CaseError, match="line 1"):
        api.duty(tmp_path / "bad.toml")


def test_the_command_reads_a_case_next_to_the_file(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "own.toml").write_text(_OWN)
    file = tmp_path / "day.toml"
    file.write_text('name = "day"\ncase = "own.toml"\n[[phases]]\nname = "all day"\ntime = "8 h"\n')
    monkeypatch.chdir(tmp_path.parent)
    assert main(["duty", str(file), "--json", "-q"]) == 0
    found = json.loads(capsys.readouterr().out)
    assert (found["case"], found["bearings"]["bearing"]["phases"][0]["damage"]) == ("own", 1.0)
    assert found["system_life_h"] == found["bearings"]["bearing"]["reference_life_h"]
    assert main(["duty", str(file), "-q", "--units", "us"]) == 0
    shown = capsys.readouterr().out
    assert "P lbf" in shown
    assert "together" in shown


_OWN = """\
name = "own"
[bearing]
designation = "6308 C3"
maker = "SKF"
[lubricant]
name = "FVA3A"
temperature = "60 degC"
[loads]
radial = "2 kN"
[operation]
speed = "1500 rpm"
"""
