"""Test a machine from its file to numbers and pictures."""

from __future__ import annotations

import csv
import json
import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from lambda_cli.main import main

from lambda_core import api
from lambda_core.domain.unit_systems import unit_system
from lambda_core.export.stiffness import stiffness_text

WRONG = """
name = "wrong"
[[shaft.sections]]
length = "100 mm"
diameter = "30 mm"
bore = "31 mm"
[bearings.left]
designation = "SKF 6206"
clearence = "10 um"
[bearings.right]
designation = "SKF 62066"
at = "90 mm"
preload = "5 um"
support.y = "stiff"
[gears.wheel]
at = "50 mm"
pitch_diameter = "80 mm"
role = "driver"
mesh = "90 deg"
power = "5 kW"
[lubricant]
name = "FVA33"
temperature = "60 degC"
[operation]
speed = "3000 rpm"
"""


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return a folder with the case that init writes."""
    found = tmp_path_factory.mktemp("shaft")
    assert main(["init", "box", "--template", "geared-shaft", "--out", str(found / "box.toml")]) == 0
    return found


def test_from_init_to_numbers(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Compare JSON, pictures and both exports.

    They come from one solution; the equilibrium holds about the left end to 1e-6.
    """
    case, stiffness = str(folder / "box.toml"), folder / "k.json"
    capsys.readouterr()
    arguments = ["--json", "--quiet", "--draw", str(folder / "pictures")]
    assert main(["modes", case, *arguments, "--stiffness", str(stiffness)]) == 0
    modes = json.loads(capsys.readouterr().out)
    assert main(["quasistatic", case, "--band", "none", *arguments]) == 0
    found = json.loads(capsys.readouterr().out)
    left, right = found["bearings"].values()
    machine = api.check(case)
    wheel = machine.gears["wheel"]
    weight = 9.80665 * (found["shaft_mass_kg"] + sum(one.model.inner_ring.mass for one in machine.bearings))
    total = np.array(left["force_N"]) + right["force_N"] + wheel.force - [0.0, 0.0, weight]
    assert np.abs(total).max() < 1e-6 * 1000.0
    assert found["drive_torque_Nm"] == pytest.approx(-wheel.moment[0], rel=1e-9)
    assert left["axial_load_N"] == pytest.approx(wheel.force[0], rel=1e-6)
    assert 0.0 < left["friction_torque_Nmm"] < 500.0
    assert left["rating"]["basic_life_h"] > 1e4 < found["system_life_h"]
    ends = [moment for moment, place in zip(found["bending_moment_Nm"], found["cut_positions_mm"], strict=True)
            if place in (found["positions_mm"][0], found["positions_mm"][-1])]  # fmt: skip
    assert np.abs(ends).max() < 1e-6
    assert [speed["speed_rpm"] for speed in modes["critical_speeds"]] == sorted(
        speed["speed_rpm"] for speed in modes["critical_speeds"]
    )
    written = json.loads(stiffness.read_text())
    assert written["bearings"][0]["stiffness"] == left["stiffness"]
    assert np.array(left["stiffness"]).shape == (6, 6)
    names = sorted(path.name for path in (folder / "pictures").iterdir())
    assert names == ["box-shaft.png", "box-shaft.svg", "box-whirl.png", "box-whirl.svg"]
    report = api.MachineEquilibrium.model_validate(found)
    whirl = api.MachineModes.model_validate(modes)
    rows = list(csv.reader(api.write_stiffness(whirl, folder / "k.csv").read_text().splitlines()))
    assert len(rows) == 1 + 2 * 36
    assert float(rows[1][4]) == left["stiffness"][0][0]
    numbered = {"damping": [[float(10 * i + j) for j in range(6)] for i in range(6)]}
    skew = whirl.model_copy(
        update={"bearings": {name: one.model_copy(update=numbered) for name, one in whirl.bearings.items()}}
    )
    second = csv.DictReader(stiffness_text(skew, "csv").splitlines())
    assert next(row["damping"] for row in second if row["column"] == "y") == "1.0"
    assert "1/min elliptic   7 more beyond 10 times the speed" in whirl.text(80)
    assert f"{len(whirl.critical_speeds) - 1} more beyond 10 times the speed" in " ".join(whirl.text().split())
    assert "Q_max 236 N" in report.text(80)
    with pytest.raises(api.UsageError, match=r"\.json or \.csv"):
        api.write_stiffness(whirl, folder / "k.txt")
    vectors = {
        "force on shaft": lambda one: one.force_N,
        "inner ring": lambda one: one.displacement_um,
        "stiffness": lambda one: [1e-6 * one.stiffness[row][row] for row in range(3)],
        "moment about": lambda one: one.moment_Nm,
    }
    for name, one in report.bearings.items():
        page = report.of_bearing(name).text(80).splitlines()
        for head, vector in vectors.items():
            said = next(line for line in page if line.startswith(head))
            values = re.findall(r"(?<=[xyz] )-?[\d.]+", said.removeprefix(head))[: len(vector(one))]
            assert list(map(float, values)) == pytest.approx(vector(one), rel=6e-3, abs=6e-3), said
    check_text(whirl, {"damping x N s/m": lambda one: [one.damping[row][row] for row in range(3)]})
    assert re.search(r"^radial load +113\.7. lbf$", report.text(80, unit_system("us")), re.MULTILINE)


def check_text(report: Any, vectors: dict[str, Callable[[Any], list[float]]]) -> None:
    """Check the directions in the table.

    Of every vector: rows of y and z are below that of x.
    """
    lines = report.text(80).splitlines()
    for head, vector in vectors.items():
        first = next(number for number, line in enumerate(lines) if line.startswith(head))
        expected = zip(*(vector(one) for one in report.bearings.values()), strict=True)
        for offset, values in enumerate(expected):
            said = [float(text) for text in lines[first + offset].split()[-len(values) :]]
            assert said == pytest.approx(list(values), rel=6e-3, abs=5e-5), lines[first + offset]


def test_a_missing_designation_names_the_section_of_that_bearing(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["check", str(folder / "box.toml"), "--set", "bearings.middle.at=60 mm"]) == 3
    assert "or write the geometry in [bearings.middle.geometry]" in capsys.readouterr().err


@pytest.mark.full  # one picture of each kind: tests/machines/test_pictures.py
def test_pictures_and_report_of_a_short_run(
    folder: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    """Draw every picture of a bearing's report.

    A machine leaves out the views of one bearing.
    """
    monkeypatch.chdir(folder)
    assert (
        main(["run", "box.toml", "--set", "solver.duration=1 ms", "--out", "short.h5", "--band", "none", "--quiet"])
        == 5
    )
    capsys.readouterr()
    assert main(["view", "short.h5", "--out", "drawn", "--format", "svg"]) == 0
    said = capsys.readouterr()
    assert "short-orbit.svg" in said.out
    assert "fails" not in said.err
    assert main(["view", "short.h5", "catalogues", "--out", "drawn"]) == 2
    assert "--bearing left" in capsys.readouterr().err
    assert main(["report", "short.h5", "--bearing", "left"]) == 0


@pytest.mark.parametrize("target", ["k.txt", "/nowhere/k.json", "/proc/k.csv"])
def test_a_stiffness_that_cannot_be_written_is_said_before_solving(
    folder: Path, target: str, capsys: pytest.CaptureFixture[str]
) -> None:
    capsys.readouterr()
    assert main(["modes", str(folder / "box.toml"), "--quiet", "--stiffness", target]) == 2
    said = capsys.readouterr()
    assert said.out == ""
    assert target in said.err


def test_every_mistake_at_once(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (folder / "wrong.toml").write_text(WRONG)
    assert main(["check", str(folder / "wrong.toml")]) == 3
    said = capsys.readouterr().err
    for place, hint in (
        ("shaft.sections.0", "bore must be smaller"),
        ("bearings.left.clearence", "nearest: clearance"),
        ("bearings.left.at", "is required"),
        ("bearings.right.designation", "62066"),
        ("bearings.right.support.y", '"locked" or "free"'),
        ("gears.wheel.role", '"driving" or "driven"'),
        ("lubricant.name", "FVA3"),
    ):
        assert any(line.split()[0] == place and hint in line for line in said.splitlines()[1:]), (place, said)


def test_results_of_the_machine_alone(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Refuse three wrong questions about a machine.

    A place off the shaft, two bearings in one, a power at rest.
    """
    changes = ["gears.wheel.at=300 mm", "bearings.right.at=21 mm", "operation.speed=0 rpm"]
    arguments = [part for change in changes for part in ("--set", change)]
    assert main(["check", str(folder / "box.toml"), *arguments]) == 3
    said = capsys.readouterr().err
    assert "gears.wheel.at" in said
    assert "0 mm to 170 mm" in said
    assert 'is also that of "left"' in said
    assert "needs a speed" in said


def test_a_bearing_has_the_cage_of_its_own_case(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Read a cage from its bearing's table.

    `[bodies.cage]` is for the case of one bearing; mistakes have their path.
    """
    case, said = str(folder / "box.toml"), "bearings.right.cage"
    changes = ['bearings.left.cage.type="brass-machined"', "bearings.left.cage.mass=0.2 kg"]
    assert main(["check", case, *(part for change in changes for part in ("--set", change))]) == 0
    left, right = (bearing.model for bearing in api.check(case, changes).bearings)
    assert left.cage_body.mass == 0.2
    assert left.cage_body.mass > 2.0 * right.cage_body.mass
    assert left.cage.type == "brass-machined"
    capsys.readouterr()
    assert main(["check", case, "--set", f"{said}.type=paper", "--set", "bearings.left.cage.x=stuck"]) == 3
    lines = capsys.readouterr().err.splitlines()
    assert any(line.split()[0] == f"{said}.type" and "paper" in line for line in lines[1:]), lines
    assert any(line.split()[0] == "bearings.left.cage.x" for line in lines[1:]), lines


def test_a_machine_is_not_one_bearing(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Refuse questions about the other kind with advice."""
    assert main(["init", "other", "--template", "geared-shaft", "--bearing", "SKF 6208"]) == 2
    assert "two bearings" in capsys.readouterr().err
    assert main(["init", "box", "--template", "geared-shaft", "--out", str(folder / "box.toml")]) == 2
    assert main(["quasistatic", str(folder / "none.toml")]) == 2


def test_a_machine_is_described_as_one_bearing_is(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Use the same fields in checks and before runs."""
    both = api.describe(api.check(folder / "box.toml")), api.describe(api.check("6208-axial-1300"))
    shared = {"version", "valid", "name", "title", "headline", "warnings", "assumptions"}
    assert all(shared < set(one.model_dump()) for one in both)
    assert both[0].headline[0] == "box: 6208 + 6206"
    capsys.readouterr()
    assert main(["run", str(folder / "box.toml"), "--duration", "0.1 ms", "--out", str(folder / "said.h5")]) == 5
    assert both[0].headline[1] in capsys.readouterr().err
    assert api.result(folder / "said.h5").headline.splitlines() == both[0].headline


def test_check_says_what_the_shaft_is(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    capsys.readouterr()
    assert main(["check", str(folder / "box.toml"), "--json"]) == 0
    found = json.loads(capsys.readouterr().out)
    assert found["bearings"] == {"left": "6208 (SKF)", "right": "6206 (SKF)"}
    assert "gear wheel" in api.describe(api.check(folder / "box.toml")).text()
