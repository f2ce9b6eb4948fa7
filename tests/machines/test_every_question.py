"""Test that machines answer every question of one bearing.

Rows are the features that single bearings had and shafts lacked before both became one program. A step is a command and
what its output contains, or a function of the folder for what only Python can ask.
"""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from lambda_cli.main import main

import lambda_core as lb
from lambda_core import api

# What they compute has files of its own: tests/thermal/test_machine_network.py, tests/studies/test_machine_study.py,
# tests/runs/test_crosscheck.py, tests/electric/test_machine_electric.py, tests/machines/test_machine_questions.py, ...
pytestmark = pytest.mark.full
RUN = (
    "solver.duration=3 ms", "output.checkpoint_interval=1 ms", "electric.seed=1", "bearings.left.depth.strips=7",
    "bearings.right.depth.strips=7", "output.interval=0.1 ms", 'connections.seal.at="160 mm"',
    'connections.seal.z="1 N/um"',
)  # fmt: skip
WATCHER = '''
"""Observe losses; report the time."""
from lambda_core.plugins import Channel, Event, NoParameters, Observer, hookimpl

LOSS = Channel("loss_sum", (), "W", "sum of the losses")


def losses(samples, parameters, model):
    return {"loss_sum": samples["loss"].sum(axis=1)}


def late(samples, parameters, model):
    return samples["time"] > 0.31e-3


@hookimpl
def lambda_observers(register):
    register(Observer("losses", "sum of losses", (LOSS,), losses, "own work", NoParameters, observer_api=1))


@hookimpl
def lambda_events(register):
    register(Event("late", "it is late", late, "own work", NoParameters, event_api=1))
'''
SPECTRUM = "time [min];operation.speed [rpm];gears.wheel.power [kW]\n30;1500;20\n90;3000;10\n"
POWER = '[[parameters]]\npath = "gears.wheel.power"\nrange = ["5 kW", "15 kW"]\n'
SPEED = '[[parameters]]\npath = "operation.speed"\nrange = ["1500 rpm", "3000 rpm"]\n'
STUDIES = {
    "grid": f'responses = ["system_life_h"]\n{POWER}points = 2\n',
    "sample": f'responses = ["system_life_h"]\n{POWER}{SPEED}[design]\nkind = "latin-hypercube"\nsamples = 2\n',
    "sobol": f'responses = ["system_life_h"]\n{POWER}[design]\nkind = "saltelli"\nsamples = 2\n',
    "best": f'responses = ["left.friction_torque_Nmm"]\n{POWER}[design]\nkind = "optimise"\nsamples = 2\n'
            '[optimise]\nminimise = "left.friction_torque_Nmm"\nevaluations = 5\n',
    "runs": f'mode = "dynamic"\nresponses = ["friction_torque_Nmm"]\n[set]\n"solver.duration" = "0.3 ms"\n{POWER}'
            "points = 2\n",
}  # fmt: skip
DAY = 'name = "day"\ncase = "box.toml"\nspectrum = "loads.csv"\n'
SHORT = 5  # exit code of a run that ends before it has converged
Step = tuple[list[str], str] | Callable[[Path], None]


def in_motion(name: str, *more: str) -> list[str]:
    """Return the command of a short run.

    Into a file of its own.
    """
    return [
        "run",
        "box.toml",
        "--set",
        "solver.duration=0.5 ms",
        *more,
        "--out",
        f"{name}.h5",
        "--band",
        "none",
        "--json",
        "-q",
    ]


def watched(folder: Path) -> None:
    """Check observers, events and force elements.

    Observers are channels: an event ends the run at its sample; the record follows its options. The brake of the shaft
    takes c omega^2.
    """
    found = api.result(folder / "watched.h5")
    turning = 3000.0 * np.pi / 30.0
    assert found.summary().elements["brake"].power_W == pytest.approx(-1e-3 * turning**2, rel=1e-3)
    for one in found.bearings.values():
        assert one["time"][-1] == pytest.approx(0.35e-3)
        assert np.diff(one["time"]) == pytest.approx(5e-5, rel=1e-9)
        assert one["loss_sum"] == pytest.approx(one["loss"].sum(axis=1))


def lives(folder: Path) -> None:
    """Check lives and catalogue torques in results."""
    summary = api.result(folder / "box.h5").summary()
    assert summary.system_life_h
    for one in summary.bearings.values():
        assert one.rating is not None
        assert one.rating.reference_life_h
        assert one.rating.skf_torque_Nmm
        assert one.rating.schaeffler_torque_Nmm
        assert one.verdict is not None
    still = api.quasistatic(api.case(folder / "box.toml", RUN))
    for name, one in summary.bearings.items():
        assert one.rating.basic_life_h == pytest.approx(still.bearing(name).rating.basic_life_h, rel=1e-9)
        assert one.rating.static_safety == pytest.approx(still.bearing(name).rating.static_safety, rel=1e-9)


def notebook(folder: Path) -> None:
    """Check answers in a notebook.

    A result, its summary and an equilibrium show, draw and tabulate themselves, and answer for a changed case.
    """
    found, summary = api.result(folder / "box.h5"), api.result(folder / "box.h5").summary()
    assert "box" in repr(found)
    assert "box" in repr(summary)
    assert "<pre>" in found._repr_html_()
    assert "<pre>" in summary._repr_html_()
    assert found.bearings["left"].plot("load-distribution").axes
    machine = lb.Machine.from_case(folder / "box.toml")
    still = machine.quasistatic()
    assert "left" in repr(still)
    assert len(still.plot().axes) > 1
    stronger = still.with_(gears={"wheel": {"power": "30 kW"}})
    assert stronger.system_life_h < still.system_life_h
    assert stronger == machine.with_(gears={"wheel": {"power": "30 kW"}}).quasistatic()
    other = found.with_(operation={"speed": "2900 rpm"}, out=folder / "slower.h5")
    assert other.summary().speed_rpm == pytest.approx(2900.0)
    pytest.importorskip("xarray")
    assert summary.to_xarray()["friction_torque_Nmm"].dims == ("bearing",)
    assert found.bearings["left"].to_xarray()["film_central"].units == "m"
    table = still.to_xarray()
    assert table["radial_load_N"].dims == ("bearing",)
    assert table["radial_load_N"].sel(bearing="left") == still.bearing("left").radial_load_N
    assert table["deflection_um"].shape == (len(still.positions_mm), 3)


def compared_with_run(folder: Path) -> None:
    """Compare one bearing with its simulation.

    A result of a machine was refused. A result of another case is refused with the bearing whose values differ.
    """
    asked: dict[str, Any] = {"bearing": "left", "methods": ["skf"], "result": folder / "box.h5"}
    found = api.compare(folder / "box.toml", RUN, **asked)
    run = api.result(folder / "box.h5").summary().bearings["left"]
    assert found.value("simulation", "friction", "total") == run.friction_torque_Nmm
    with pytest.raises(api.UsageError, match=r"is of another case: right\.geometry\.clearance"):
        api.compare(folder / "box.toml", [*RUN, "bearings.right.clearance=11 um"], **asked)


def live_circuit(folder: Path) -> None:
    """Check the circuit of a motion.

    Every row has a checksum; the run goes on from its checkpoint.
    """
    found = api.result(folder / "box.h5")
    assert all(one.currents is not None for one in found.summary().bearings.values())
    kept = found.checkpoint()
    assert kept is not None
    assert kept.position.sums


def stored_case(folder: Path) -> None:
    """Check the case stored in the result.

    Run again, it gives the same numbers bit for bit.
    """
    found = api.result(folder / "box.h5")
    (folder / "again.toml").write_text(found.case_toml, encoding="utf-8")
    again = api.run(folder / "again.toml", out=folder / "again.h5")
    for name in found.bearing_names:
        for channel in ("load", "body_position", "ball_azimuth", "film_central"):
            assert np.array_equal(found.bearings[name][channel], again.bearings[name][channel]), channel


def coupled(folder: Path) -> None:
    """Check a coupled gear.

    Another program pushes it step by step.
    """
    stepping = api.iterate(folder / "box.toml", ["solver.duration=0.5 ms"])
    stepping.give("gears.wheel.force_z", -500.0)
    assert set(stepping.step_to(1e-4).bearings) == {"left", "right"}


def table_of_python(folder: Path) -> None:
    """Check a study from Python.

    It has a row for every point, with the numbers of the equilibrium.
    """
    machine = lb.Machine.from_case(folder / "box.toml")
    asked = ["system_life_h", "left.force_N.z", "right.misalignment_mrad.y"]
    weak, strong = machine.study({"gears.wheel.power": ["5 kW", "15 kW"]}, asks=asked, executor="here").rows()
    found = machine.quasistatic()
    assert weak["system_life_h"] > strong["system_life_h"]
    assert strong["left.force_N.z"] == pytest.approx(found.bearing("left").force_N[2], rel=1e-6)
    assert strong["right.misalignment_mrad.y"] == pytest.approx(found.bearing("right").misalignment_mrad[0], rel=1e-4)


def study(name: str) -> tuple[list[str], str]:
    """Return the command that runs a study."""
    return ["study", "run", f"{name}.toml", "--executor", "here", "--band", "none", "--json", "-q"], '"done"'


LEFT, CIRCUIT = ["--bearing", "left"], ["--set", "electric.duration=2 ms"]
ROWS: dict[str, list[Step]] = {
    "run, quasistatic, check, modes": [
        (["check", "box.toml", "--json"], "bearings"),
        (in_motion("short"), '"friction_torque_Nmm"'),
        (["quasistatic", "box.toml", "--json", "-q"], "system_life_h"),
        (["modes", "box.toml", "--json", "-q"], "critical_speeds"),
    ],
    "study": [study("grid"), table_of_python],
    "study of runs, samples, sensitivity, search": [study("runs"), study("sample"), study("sobol"), study("best")],
    "stribeck": [(["stribeck", "box.toml", *LEFT, "--speed", "100 rpm", "--speed", "1000 rpm", "--json"],
                  "torque_Nmm")],
    "thermal": [
        (["thermal", "box.toml", "--json", "-q"], "temperatures_degC"),
        (["thermal", "box.h5", "--json", "-q"], "temperatures_degC"),
    ],
    "run at its own temperatures": [
        (in_motion("warm", "--set", 'operation.temperatures="computed"'), '"friction_torque_Nmm"')
    ],
    "electric": [
        (["electric", "box.toml", *CIRCUIT, "--json", "-q"], "right"),
        (["electric", "box.h5", "--json", "-q"], "left"),
        (["electric-map", "box.toml", *LEFT, "--points", "1x1", "--executor", "here", *CIRCUIT, "--json", "-q"],
         "points"),
    ],
    "duty": [(["duty", "day.toml", "--json", "-q"], "system_life_h")],
    "cross-check": [
        (["cross-check", "box.toml", "--duration", "0.2 ms", "--json", "-q"], "agree"),
        (["cross-check", "box.toml", "--bearing", "right", "--duration", "0.2 ms", "--json", "-q"], "agree"),
    ],
    "compare": [(["compare", "box.toml", "--bearing", "right", "--json", "-q"], "methods"),
                compared_with_run,
                (["view", "box.h5", "catalogues", *LEFT, "--format", "png"], ".png")],
    "export fmu, iterate": [coupled, (["export", "fmu", "box.toml", "--processor", "native", "-q"], "box.fmu")],
    "estimate": [(["estimate", "box.toml", "--json", "-q"], "processor_s")],
    "observers, events, force elements, depth, output": [
        (in_motion("watched", "--plugin", "watcher.py", "--set", "observers.losses={}",
                   "--set", 'events.late={action="stop"}', "--set", "output.interval=0.05 ms",
                   "--set", 'connections.brake={at="160 mm", law="bushing", '
                            'parameters={spin_damping="0.001 N m s/rad"}}'), "friction"),
        watched,
    ],
    "lives and catalogue torques of a run": [lives, (["show", "box.h5"], "rating life")],
    "view, animate, report, cite": [
        (["view", "box.h5", "load-distribution", *LEFT, "--format", "png"], ".png"),
        (["animate", "box.h5", *LEFT, "--frames", "2", "--turns", "0.1"], ".gif"),
        (["report", "box.h5"], ".html"),
        (["cite", "box.h5"], "SKF"),
    ],
    "show": [
        (["show", "box.h5", "--json"], '"discharges_per_s"'),
        (["show", "box.h5", "--bearing", "right"], "cage speed"),
        (["show", "box.h5", "--assumptions"], "film"),
        (["show", "box.h5", "box.h5"], "left: smallest film under load"),
    ],
    "units": [
        (["show", "box.h5", "--units", "us"], "lbf in"),
        (["quasistatic", "box.toml", "--units", "us", "--band", "none", "-q"], "lbf in"),
        (["modes", "box.toml", "--units", "us", "-q"], "lbf/in"),
    ],
    "notebook": [notebook],
    "live circuit, checksums, checkpoints": [
        live_circuit,
        stored_case,
        (["resume", "box.h5", "--duration", "3.5 ms", "--json", "-q"], '"finished"'),
    ],
}  # fmt: skip
ABOUT_ONE = ("stribeck", "compare", "electric-map")


@pytest.fixture(scope="session")
def box_run(once: Callable[[str, Callable[[Path], object]], Path]) -> Path:
    """Run a shaft in two bearings.

    With the circuit, a seal, finer contacts and an own interval of samples.
    """

    def fill(folder: Path) -> None:
        case = api.init_case("box", template="geared-shaft", path=folder / "box.toml")
        api.run(case, RUN, out=folder / "box.h5")

    return once("every-question-of-a-machine", fill)


@pytest.fixture
def box(box_run: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Work in a folder with examples.

    Case, run, studies, duty cycle and plugin.
    """
    for name in ("box.toml", "box.h5"):
        (tmp_path / name).write_bytes((box_run / name).read_bytes())
    for name, text in STUDIES.items():
        (tmp_path / f"{name}.toml").write_text(f'name = "{name}"\ncase = "box.toml"\n{text}')
    (tmp_path / "day.toml").write_text(DAY)
    (tmp_path / "loads.csv").write_text(SPECTRUM)
    (tmp_path / "watcher.py").write_text(WATCHER)
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.mark.parametrize("row", ROWS)
def test_a_machine_of_two_bearings(row: str, box: Path, capsys: pytest.CaptureFixture[str]) -> None:
    if row == "cross-check":
        pytest.importorskip("sksundae")
    for step in ROWS[row]:
        if callable(step):
            step(box)
            continue
        arguments, contained = step
        capsys.readouterr()
        moves = arguments[0] in ("run", "resume") or "runs.toml" in arguments
        assert main(arguments) == (SHORT if moves else 0), arguments
        printed = capsys.readouterr().out
        assert contained in printed, arguments
        if "--json" in arguments:
            json.loads(printed)


@pytest.mark.parametrize("question", ABOUT_ONE)
def test_a_question_about_one_bearing_names_those_there_are(
    question: str, box: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Name the bearings when `--bearing` is wrong or missing.

    The same holds where there is only one.
    """
    commands: list[Any] = [step[0] for steps in ROWS.values() for step in steps if not callable(step)]
    arguments = next(command for command in commands if command[0] == question)
    at = arguments.index("--bearing")
    capsys.readouterr()
    assert main([*arguments[:at], *arguments[at + 2 :]]) == 2
    assert "--bearing (left, right)" in capsys.readouterr().err
    assert main([*arguments[: at + 1], "rigth", *arguments[at + 2 :]]) == 2
    assert '"rigth" is not a known bearing; nearest: right' in capsys.readouterr().err
    single = ["6208-axial-1300" if part == "box.toml" else part for part in arguments]
    assert main(single) == 2
    assert "one bearing: leave out --bearing" in capsys.readouterr().err
