"""Test run, resume, show and quasistatic in real processes."""

from __future__ import annotations

import json
import os
import signal
import time
from pathlib import Path
from types import SimpleNamespace
from typing import TYPE_CHECKING

import numpy as np
import pytest
from lambda_cli.main import main
from warm import PROGRAM

from lambda_core import api
from lambda_core.domain.errors import UsageError

if TYPE_CHECKING:
    from warm import Started, Warm

CASE = "6208-axial-700"
SHORT = ["--band", "none", "--duration", "5 ms"]


@pytest.fixture(autouse=True)
def in_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    return tmp_path


def growing(path: str | Path) -> dict[str, np.ndarray]:
    result = api.result(path)
    found = {channel.name: result[channel.name] for channel in result.channels}
    return found | {"integrals": result.integrals(), "revolutions": result.revolutions()}


def same(one: dict[str, np.ndarray], other: dict[str, np.ndarray]) -> None:
    assert one.keys() == other.keys()
    for name, values in one.items():
        assert values.tobytes() == other[name].tobytes(), name


def wait_for_samples(path: Path, process: Started) -> None:
    """Wait until a run has put something on disk."""
    while not path.exists() or api.result(path).status().rows.samples < 2:
        assert process.poll() is None, process.communicate()
        time.sleep(0.02)


def test_a_short_run_says_why_it_is_not_converged(capsys: pytest.CaptureFixture[str], in_folder: Path) -> None:
    assert main(["run", CASE, *SHORT]) == 5
    out, err = capsys.readouterr()
    for word in ("friction torque", "inner   sliding", "outer   sliding", "cage speed", "energy residual", "assumed"):
        assert word in out
    assert "NOT CONVERGED" in out
    assert f"result           {CASE}.h5" in out
    assert "6208 (Syla2026)" in err  # the headline is talk
    assert "equilibrium: 9 balls loaded" in err
    assert "not converged: 0 whole cage revolutions were averaged, at least 4 are needed" in err
    assert "\x1b" not in err + out  # no terminal: no colours, no bar
    assert (in_folder / f"{CASE}.h5").exists()


def test_json_is_one_object_on_stdout_and_quiet_is_quiet(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["run", CASE, *SHORT, "--json", "--quiet"]) == 5
    out, err = capsys.readouterr()
    data = json.loads(out)
    assert data["interface"] == 1
    assert data["converged"] is False
    assert len(data["bearings"]["bearing"]["contacts"]) == 18
    assert data["friction_torque_Nmm"] > 0.0
    assert err.startswith("not converged: ")
    assert err.count("\n") == 1


def test_show_says_what_run_said(capsys: pytest.CaptureFixture[str]) -> None:
    main(["run", CASE, *SHORT, "--json", "--quiet"])
    said = json.loads(capsys.readouterr().out)
    assert main(["show", f"{CASE}.h5", "--json"]) == 0
    assert json.loads(capsys.readouterr().out) == said
    assert main(["show", f"{CASE}.h5"]) == 0
    assert capsys.readouterr().out.startswith("6208 (Syla2026)")
    assert main(["show", f"{CASE}.h5", "--assumptions"]) == 0
    assert capsys.readouterr().out.splitlines() == said["assumptions"]


def test_progress_as_json_is_one_object_per_line(capsys: pytest.CaptureFixture[str]) -> None:
    main(["run", CASE, "--duration", "30 ms", "--band", "none", "--progress", "json"])
    lines = capsys.readouterr().err.splitlines()
    events = [json.loads(line) for line in lines if line.startswith("{")]
    assert [line for line in lines if not line.startswith("{")] == [lines[-1]]  # the reason at the end
    assert {event["event"] for event in events} == {"message", "progress"}
    last = [event for event in events if event["event"] == "progress"][-1]
    assert last["percent"] == 100.0
    assert last["time_s"] == pytest.approx(0.03, rel=0.02)
    assert len(last["inner_loads_N"]) == 9
    assert sum(last["inner_loads_N"]) > 0.0


@pytest.mark.full
@pytest.mark.parametrize("colour", [True, False])
def test_a_terminal_shows_a_bar_with_the_time_left(colour: bool, warm: Warm) -> None:
    """Show the bar in a pseudo-terminal.

    NO_COLOR keeps the movement and removes the colours.
    """
    pty = pytest.importorskip("pty")
    terminal, end = pty.openpty()
    environment = {**os.environ, "TERM": "xterm", "COLUMNS": "100"} | ({} if colour else {"NO_COLOR": "1"})
    process = warm.start(PROGRAM, "run", CASE, "--duration", "30 ms", "--band", "none", env=environment, stderr=end)
    os.close(end)
    seen = b""
    while True:
        try:
            part = os.read(terminal, 65536)
        except OSError:  # the other end is closed
            break
        if not part:
            break
        seen += part
    os.close(terminal)
    out, _ = process.communicate()
    text = seen.decode()
    assert process.returncode == 5
    assert "running" in text
    assert "left" in text
    assert "cage rev" in text
    assert ("\x1b[38;5;" in text or "\x1b[38;2;" in text or "\x1b[3" in text) is colour
    assert "6208 (Syla2026)" in text
    assert "\x1b" not in out


def test_results_are_numbered_and_never_overwritten(capsys: pytest.CaptureFixture[str], in_folder: Path) -> None:
    for _ in range(2):
        main(["run", CASE, *SHORT, "--quiet"])
    assert sorted(path.name for path in in_folder.iterdir()) == [f"{CASE}-2.h5", f"{CASE}.h5"]
    before = (in_folder / f"{CASE}.h5").read_bytes()
    capsys.readouterr()
    assert main(["run", CASE, *SHORT, "--out", f"{CASE}.h5"]) == 2
    assert "exists: choose another name" in capsys.readouterr().err
    assert (in_folder / f"{CASE}.h5").read_bytes() == before
    assert main(["run", CASE, *SHORT, "--out", f"{CASE}.h5", "--force", "--quiet"]) == 5
    assert (in_folder / f"{CASE}.h5").read_bytes() != before


@pytest.mark.parametrize(
    ("arguments", "code", "message"),
    [
        (["run", "6391-cp10"], 2, "6319-cp10"),
        (["run", CASE, "--duration", "5"], 3, "solver.duration"),
        (["run", CASE, "--duration", "5,0 ms"], 3, "write a decimal point"),
        (["run", CASE, "--set", "loads.radial=16 kNm"], 3, "loads.radial"),
        (["run", CASE, "--set", "lods.radial=16 kN"], 3, "lods"),
        (["run", CASE, "--out", "no/such/folder.h5"], 2, "does not exist"),
        (["run", CASE, "--out", "/proc/r.h5"], 2, "cannot write /proc/r.h5"),
        (["run", CASE, "--out", "."], 2, "is a folder"),
        (["run", CASE, "--progress", "dots"], 2, "dots"),
        (["show", "no.h5"], 2, "no.h5 does not exist: name a file that lambda-bearing run has written"),
        (["resume", "no.h5"], 2, "no.h5 does not exist"),
        (["quasistatic", CASE, "--set", "bearing.designation=6391"], 3, "6391"),
    ],
)
def test_mistakes_get_one_message_and_leave_nothing(
    arguments: list[str], code: int, message: str, capsys: pytest.CaptureFixture[str], in_folder: Path
) -> None:
    assert main(arguments) == code
    out, err = capsys.readouterr()
    assert message in err
    assert "Traceback" not in err
    assert out == ""
    assert list(in_folder.iterdir()) == []


def test_a_damaged_result_is_said(capsys: pytest.CaptureFixture[str], in_folder: Path) -> None:
    main(["run", CASE, *SHORT, "--quiet"])
    path = in_folder / f"{CASE}.h5"
    path.write_bytes(path.read_bytes()[:100_000])
    capsys.readouterr()
    for command in ("show", "resume"):
        assert main([command, str(path)]) == 2
        out, err = capsys.readouterr()
        assert f"{CASE}.h5" in err
        assert out == ""
    (in_folder / "case.h5").write_text('name = "x"\n')
    assert main(["show", "case.h5"]) == 2
    assert "is not a result file" in capsys.readouterr().err


@pytest.mark.full
def test_a_longer_duration_goes_on_bit_for_bit(capsys: pytest.CaptureFixture[str]) -> None:
    main(["run", CASE, "--duration", "12 ms", "--band", "none", "--out", "whole.h5", "--quiet"])
    main(["run", CASE, *SHORT, "--out", "part.h5", "--quiet"])
    assert main(["resume", "part.h5", "--duration", "12 ms", "--quiet"]) == 5
    same(growing("part.h5"), growing("whole.h5"))
    assert main(["resume", "part.h5", "--quiet"]) == 2
    assert "nothing is left to do" in capsys.readouterr().err


@pytest.mark.full
def test_a_limit_of_wall_time_holds_for_one_start(capsys: pytest.CaptureFixture[str]) -> None:
    """Resume a run that a time limit stopped.

    It goes on without the limit or with a new one, and equals an undisturbed run.
    """
    main(["run", CASE, "--duration", "12 ms", "--band", "none", "--out", "whole.h5", "--quiet"])
    options = ["--duration", "12 ms", "--max-wall", "1 us", "--out", "part.h5", "--quiet"]
    assert main(["run", CASE, *options]) == 5
    assert "the limit of wall time was reached at t = 0.00" in capsys.readouterr().err
    assert main(["resume", "part.h5", "--max-wall", "1 us", "--quiet"]) == 5
    assert api.result("part.h5").status().state == "stopped"
    assert 0.0 < api.result("part.h5")["time"][-1] < 0.011
    assert main(["resume", "part.h5", "--quiet"]) == 5  # 12 ms are not converged
    assert api.result("part.h5").status().state == "finished"
    same(growing("part.h5"), growing("whole.h5"))


@pytest.mark.parametrize("command", ["run", "resume"])
def test_limits_of_the_command_line_reach_the_run(command: str, monkeypatch: pytest.MonkeyPatch) -> None:
    asked: list[object] = []

    def note(*given: object, **_: object) -> None:
        asked.extend(given)
        raise UsageError("noted")

    for name in ("check", "resume"):
        monkeypatch.setattr(api, name, note)
    monkeypatch.setattr(api, "result", lambda _: SimpleNamespace(headline=""))
    assert main([command, CASE, "--duration", "12 ms", "--max-wall", "1 min", "--quiet"]) == 2
    assert asked[1] == ["solver.duration=12 ms", "solver.max_wall=1 min"]


def test_resume_refuses_what_would_be_another_run(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    main(["run", CASE, *SHORT, "--out", "r.h5", "--quiet"])
    from lambda_core.runs import launch

    with pytest.raises(UsageError, match=r"resolves to other values: .*solver\.tolerance"):
        api.resume("r.h5", ["solver.tolerance=1e-4", "solver.duration=10 ms"])
    monkeypatch.setattr(launch, "physics_key", lambda: "another")
    with pytest.raises(UsageError, match="the code has changed since: core"):
        api.resume("r.h5", ["solver.duration=10 ms"])


@pytest.mark.full
@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGKILL])
def test_an_interrupted_run_is_readable_and_goes_on_bit_for_bit(number: int, warm: Warm, in_folder: Path) -> None:
    """Interrupt a long run, then continue it by 5 ms.

    The run has a process of its own.
    """
    path = in_folder / "part.h5"
    options = ("--duration", "5 s", "--set", "output.checkpoint_interval=0.05 s", "--out", str(path))
    process = warm.start(PROGRAM, "run", CASE, *options)
    wait_for_samples(path, process)
    os.kill(process.pid, number)
    out, err = process.communicate()
    summary = api.summary(path)
    if number == signal.SIGINT:
        assert process.returncode == 130, err
        assert summary.state == "interrupted"
        assert "friction torque" in out
        assert "continue with: lambda-bearing resume" in err
    end = f"{summary.simulated_s + 0.005:.4f} s"
    assert main(["resume", str(path), "--duration", end, "--quiet"]) == 5
    assert main(["run", CASE, "--duration", end, "--band", "none", "--out", "whole.h5", "--quiet"]) == 5
    same(growing(path), growing("whole.h5"))


def test_quasistatic_prints_the_same_numbers_as_its_json(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["quasistatic", CASE, "--json", "--quiet"]) == 0
    data = json.loads(capsys.readouterr().out)["bearings"]["bearing"]
    assert data["loaded_elements"] == 9
    # 700 N over nine balls at about 13.66 degrees: 700/(9 sin 13.66) = 329 N
    loads = [contact["load_N"] for contact in data["contacts"] if contact["ring"] == "inner"]
    assert np.mean(loads) == pytest.approx(329.3, rel=0.01)
    assert sum(data["friction_breakdown_Nmm"].values()) == pytest.approx(data["friction_torque_Nmm"])
    assert main(["quasistatic", CASE, "--band", "none"]) == 0
    out = capsys.readouterr().out
    assert f"Q_max {data['max_load_N']:.0f} N" in out
    assert f"{data['friction_torque_Nmm']:.1f} N mm" in out
    assert len([line for line in out.splitlines() if " inner  " in line]) >= 9


def test_an_equilibrium_at_rest_needs_no_end_in_time(capsys: pytest.CaptureFixture[str]) -> None:
    resting = ["--set", "operation.speed=0 rpm"]
    assert main(["quasistatic", CASE, *resting, "--json", "--quiet"]) == 0
    found = json.loads(capsys.readouterr().out)["bearings"]["bearing"]
    assert found["max_load_N"] > 100.0
    assert found["friction_torque_Nmm"] is None
    assert main(["run", CASE, *resting]) == 3  # a run does
    assert "solver.duration" in capsys.readouterr().err
