"""Test studies of a machine.

Parameters anywhere in its case, responses of the machine and of each bearing.
"""

from __future__ import annotations

from pathlib import Path

import pytest

from lambda_core import api


@pytest.fixture
def box(tmp_path: Path) -> Path:
    return api.init_case("box", path=tmp_path / "box.toml", template="geared-shaft")


@pytest.mark.full
def test_a_study_of_a_machine_says_what_its_points_say(box: Path, tmp_path: Path) -> None:
    """Compare responses at two gear powers.

    Every response equals the number of the equilibrium, of modes or of compare at that power.
    """
    names = [
        "system_life_h", "max_deflection_um", "first_critical_speed_rpm", "power_loss_W", "left.radial_load_N",
        "right.reference_life_h", "right.friction_torque_Nmm", "left.min_film_parameter",
        "left.friction_breakdown_Nmm", "left.skf/friction/total", "left.stiffness_N_per_um.x",
    ]  # fmt: skip
    study = {
        "name": "power", "case": str(box), "responses": names,
        "parameters": [{"path": "gears.wheel.power", "values": ["5 kW", "15 kW"]}],
    }  # fmt: skip
    status = api.study_run(study, tmp_path / "power", executor="here")
    assert (status.done, status.points) == (2, 2), status.reasons
    table = api.study_table(tmp_path / "power")
    assert "left.stiffness_N_per_um.x" in [one.name for one in table.responses if not one.is_part]  # printed
    first, second = table.rows()
    at = api.quasistatic(box, ["gears.wheel.power=5 kW"])
    assert first["system_life_h"] == pytest.approx(at.system_life_h, rel=1e-9)
    assert first["left.radial_load_N"] == pytest.approx(at.bearing("left").radial_load_N, rel=1e-9)
    assert first["right.reference_life_h"] == pytest.approx(at.bearing("right").rating.reference_life_h)
    assert first["right.friction_torque_Nmm"] == pytest.approx(at.bearing("right").friction_torque_Nmm, rel=1e-9)
    assert first["power_loss_W"] == pytest.approx(sum(one.power_loss_W for one in at.bearings.values()), rel=1e-9)
    assert first["left.stiffness_N_per_um.x"] == pytest.approx(1e-6 * at.bearing("left").stiffness[0][0], rel=1e-9)
    parts = [value for name, value in first.items() if name.startswith("left.friction_breakdown_Nmm.")]
    assert sum(parts) == pytest.approx(at.bearing("left").friction_torque_Nmm, rel=1e-9)
    modes = api.modes(box, ["gears.wheel.power=5 kW"])
    assert first["first_critical_speed_rpm"] == pytest.approx(modes.critical_speeds[0].speed_rpm, rel=1e-9)
    skf = api.compare(box, ["gears.wheel.power=5 kW"], methods=["skf"], bearing="left")
    assert first["left.skf/friction/total"] == pytest.approx(skf.value("skf", "friction", "total"), rel=1e-9)
    assert second["system_life_h"] < first["system_life_h"]
    assert api.study_resume(tmp_path / "power", executor="here").done == 2


@pytest.mark.full
@pytest.mark.parametrize("mode", ["quasi-static", "dynamic"])
def test_a_life_has_one_name_for_a_bearing_alone_and_in_a_machine(box: Path, mode: str, tmp_path: Path) -> None:
    """Give the life one name everywhere.

    `reference_rating_life_h` of a machine was `rating.reference_life_h` of a bearing.
    """
    asked = ["reference_life_h", "basic_life_h", "static_safety"]
    for case, before in (("6208-axial-700", ""), (str(box), "left.")):
        study = {
            "name": "life", "case": case, "mode": mode, "responses": [before + name for name in asked],
            "parameters": [{"path": "operation.speed", "values": ["1500 rpm"]}],
            "set": {"solver.duration": "0.2 ms"},
        }  # fmt: skip
        folder = tmp_path / f"of{before}"
        api.study_run(study, folder, executor="here")
        (row,) = api.study_table(folder).rows()
        at = api.quasistatic(case, ["operation.speed=1500 rpm"])
        rating = (at.bearing("left") if before else at).rating
        assert {name: row[before + name] for name in asked} == {
            name: pytest.approx(getattr(rating, name)) for name in asked
        }


def test_mistakes_of_a_study_of_a_machine_are_named(box: Path) -> None:
    study = {"name": "wrong", "case": str(box), "parameters": [{"path": "gears.wheel.power", "values": ["5 kW"]}]}
    with pytest.raises(
        api.CaseError, match=r'"lef.radial_load_N" is not a known response; nearest: left.radial_load_N'
    ):
        api.study_check({**study, "responses": ["lef.radial_load_N"]})
    with pytest.raises(api.CaseError, match=r'name the bearing that is meant, "left.skf/friction/total"'):
        api.study_check({**study, "responses": ["skf/friction/total"]})
    with pytest.raises(api.CaseError, match=r"gears\.wheel\.pover"):
        api.study_check({**study, "parameters": [{"path": "gears.wheel.pover", "values": ["5 kW"]}]})
    with pytest.raises(api.CaseError, match=r"bearings\.left\.position"):
        api.study_check({**study, "set": {"bearings.left.position": "300 mm"}})


@pytest.mark.full
def test_runs_of_a_machine_are_points(box: Path, tmp_path: Path) -> None:
    """Store one run and one file per point.

    Responses are the numbers of its summary, of the machine and of a bearing.
    """
    from lambda_core.studies.responses import responses_in

    names = [name for name, one in responses_in(("left", "right")).items() if one.dynamic is not None]
    study = {
        "name": "runs", "case": str(box), "mode": "dynamic", "responses": names,
        "set": {"solver.duration": "2 ms"},
        "parameters": [{"path": "discs.wheel.unbalance", "values": ["0 g mm", "50 g mm"]}],
    }  # fmt: skip
    estimate = api.study_check(study)
    assert 0.0 < estimate.seconds_per_point < 10.0
    assert estimate.disk_bytes > 0.0
    status = api.study_run(study, tmp_path / "runs", executor="here")
    assert (status.partial, status.failed) == (2, 0), status.reasons
    first, second = api.study_table(tmp_path / "runs").rows()
    summary = api.result(tmp_path / "runs" / first["file"]).summary()
    assert first["friction_torque_Nmm"] == summary.friction_torque_Nmm
    assert first["system_life_h"] == summary.system_life_h
    assert first["right.max_pressure_GPa"] == summary.bearings["right"].max_pressure_GPa
    assert first["left.min_film_um"] == summary.bearings["left"].min_film_um
    assert first["left.max_load_N"] != second["left.max_load_N"]
