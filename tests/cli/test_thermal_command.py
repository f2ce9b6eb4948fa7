"""Test output, exit codes and pictures of `thermal`."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from lambda_cli.main import main

CASE = """
name = "runaway"
[bearing]
designation = "6208"
maker = "SKF"
clearance = "5 um"
[lubricant]
name = "FVA3A"
temperature = "40 degC"
[loads]
radial = "500 N"
[operation]
speed = "{speed} rpm"
[depth]
cage = false
[thermal]
conductances = "none"
limit = "150 degC"
nodes.oil.temperature = "60 degC"
links.shaft = {{between = ["inner_ring", "ambient"], conductance = "0.2 W/K"}}
links.housing = {{between = ["outer_ring", "ambient"], conductance = "20 W/K"}}
links.inside = {{between = ["inner_ring", "oil"], conductance = "0.1 W/K"}}
links.outside = {{between = ["outer_ring", "balls"], conductance = "5 W/K"}}
"""


def written(folder: Path, speed: float) -> str:
    path = folder / "runaway.toml"
    path.write_text(CASE.format(speed=speed))
    return str(path)


def test_steady_temperatures_as_text_and_as_json(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    case = written(tmp_path, 2000)
    assert main(["thermal", case, "-q", "--draw", str(tmp_path)]) == 0
    said = capsys.readouterr()
    assert "inner ring" in said.out
    assert "loop gain" in said.out
    assert {path.suffix for path in tmp_path.glob("runaway-heat.*")} == {".svg", ".png"}
    assert main(["thermal", case, "-q", "--json"]) == 0
    data = json.loads(capsys.readouterr().out)
    assert data["kind"] == "steady"
    assert data["temperatures_degC"]["oil"] == pytest.approx(60.0)
    assert abs(data["energy_residual"]) < 1e-9


def test_a_runaway_is_a_failure_of_the_solver(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["thermal", written(tmp_path, 9000), "-q"]) == 4
    said = capsys.readouterr()
    assert "thermal runaway through the clearance" in said.err
    assert said.out == ""


@pytest.mark.full
def test_a_warm_up_that_runs_away_is_a_partial_result(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["thermal", written(tmp_path, 9000), "-q", "--transient", "1 h", "--json"]) == 5
    said = capsys.readouterr()
    data = json.loads(said.out)
    assert data["ended"] == "limit"
    assert data["temperatures_degC"]["inner_ring"][-1] == pytest.approx(150.0, abs=0.01)
    assert "thermal.limit = 150 degC" in said.err


@pytest.mark.parametrize(
    ("time", "said"), [("1", "has no unit"), ("1 K", "not a unit of time"), ("-1 s", "more than 0 s, not -1 s")]
)
def test_a_wrong_time_is_a_usage_error(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], time: str, said: str
) -> None:
    assert main(["thermal", written(tmp_path, 2000), "--transient", time]) == 2
    assert said in capsys.readouterr().err
