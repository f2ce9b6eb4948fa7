"""Test pictures of a machine at its operating point."""

from __future__ import annotations

import tomllib
from pathlib import Path

import pytest
from lambda_cli.main import main

from lambda_core import api
from lambda_core.analysis.rotor.machine_modes import MachineModes
from lambda_core.model.machine_templates import shaft_text
from lambda_core.plugins import NotApplicable


def test_gears_and_the_running_speed_are_drawn() -> None:
    model = api.check(tomllib.loads(shaft_text("geared-shaft", "box")))
    assert isinstance(model, api.MachineModel)
    found, modes = api.quasistatic(model), api.modes(model)
    assert isinstance(modes, MachineModes)
    drawn = {view.view: view for view in api.machine_pictures(found, modes)}
    names = [series.name for series in drawn["shaft"].panels[0].series]
    assert "gears" in names
    (mark,) = drawn["whirl"].panels[0].marks
    assert mark.label == "running speed"
    assert mark.value == pytest.approx(3000.0)


def test_one_bearing_is_drawn_with_its_load(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    asked = ["quasistatic", "6208-axial-1300", "--set", "loads.radial=500 N", "--draw", str(tmp_path), "--band", "none"]
    assert main([*asked, "-q"]) == 0
    assert {path.name.removeprefix("6208-axial-1300-") for path in tmp_path.iterdir()} == {
        f"{view}.{kind}" for view in ("bearing", "element-loads") for kind in ("svg", "png")
    }
    capsys.readouterr()
    found = api.quasistatic("6208-axial-1300", ["loads.radial=500 N"])
    (drawn, _) = api.machine_pictures(found)
    side, front = (panel.arrows for panel in drawn.panels)
    assert side is not None
    assert front is not None
    assert (side.u[0], side.v[0]) == pytest.approx((1300.0, -500.0), rel=0.005)
    assert float(front.v.sum()) == pytest.approx(-500.0, rel=0.005)
    assert "inner ring moves x 156" in drawn.notes[1]


def test_one_bearing_shows_no_shaft() -> None:
    with pytest.raises(NotApplicable, match="one bearing without a shaft"):
        api.quasistatic("6208-axial-1300").plot("shaft")


def test_an_equilibrium_read_from_data_draws_no_sizes() -> None:
    found = api.quasistatic("6208-axial-1300")
    with pytest.raises(api.UsageError, match="solve its case again"):
        api.machine_pictures(type(found).model_validate(found.model_dump()))


def test_rollers_are_drawn_in_their_bearing() -> None:
    case = {
        "name": "nu", "bearing": {"designation": "SKF NU 208 ECP"}, "loads": {"radial": "5 kN"},
        "operation": {"speed": "3000 rpm"}, "lubricant": {"name": "FVA3", "temperature": "70 degC"},
    }  # fmt: skip
    drawn = api.machine_pictures(api.quasistatic(case, ["gravity.z=0 m/s2"]))[0]
    assert [series.name for series in drawn.panels[0].series] == ["outer ring", "inner ring", "rollers"]
    arrows = drawn.panels[0].arrows
    assert arrows is not None
    assert float(arrows.v[0]) == pytest.approx(-5000.0, rel=1e-6)


def test_both_kinds_of_equilibrium_name_their_bearings_alike() -> None:
    alone, machine = (
        api.quasistatic("6208-axial-1300"),
        api.quasistatic(tomllib.loads(shaft_text("geared-shaft", "box"))),
    )
    assert list(alone.bearings) == ["bearing"]
    assert list(machine.bearings) == ["left", "right"]
    for found in (alone, machine):
        for name, one in found.bearings.items():
            assert found.bearing(name) is one
            assert len(one.ring_displacement_um) == 3
    with pytest.raises(api.UsageError, match="left"):
        machine.bearing("lef")
    drawn = machine.plot("bearing")
    assert len(drawn.axes) == 4
