"""Test that signals and time limits are obeyed."""

from __future__ import annotations

import contextlib
import json
import os
import signal
import subprocess
import sys
import time
import tomllib
from collections.abc import Callable, Mapping
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

import h5py
import numpy as np
import pytest
from lambda_cli import main as command
from lambda_cli import start
from lambda_cli.interrupt import second_signal_ends
from trust.answering import time_of
from warm import PROGRAM

from lambda_core import api
from lambda_core.discovery.apart import check_apart
from lambda_core.discovery.manager import registry
from lambda_core.domain.errors import CaseError, SolverError
from lambda_core.results import file_format
from lambda_core.runs import launch

if TYPE_CHECKING:
    from warm import Started, Warm

CASE = "6208-axial-700"
# One record of this takes minutes: 1/40 of a cage turn of four hours.
SLOW = ("operation.speed=0.01 rpm",)
PATIENCE = 120.0  # with the slowest machine [s]
Program = Callable[..., "subprocess.Popen[str]"]


def wait_for_life(path: Path, process: Started) -> None:
    """Wait until the process writes its result."""
    while process.poll() is None:
        if path.exists() and api.result(path).status().alive():
            return
        time.sleep(0.05)
    pytest.fail(process.communicate()[1])


def wait_for_standstill(path: Path, process: Started) -> None:
    """Wait for a standstill.

    The process works for a second of the processor without a new sample: it is in a law for good.
    """
    samples, begun = -1, 0.0
    while process.poll() is None and time_of(process.pid) - begun < 1.0:
        time.sleep(0.05)
        if api.result(path).status().rows.samples != samples:
            samples, begun = api.result(path).status().rows.samples, time_of(process.pid)


def changes(*overrides: str) -> list[str]:
    return [word for override in overrides for word in ("--set", override)]


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM, signal.SIGHUP])
def test_c2_4_a_signal_is_answered_within_a_record(number: int, warm: Warm, tmp_path: Path) -> None:
    path = tmp_path / "r.h5"
    process = warm.start(PROGRAM, "run", CASE, *changes(*SLOW), "--out", str(path), "--json")
    wait_for_life(path, process)
    os.kill(process.pid, number)
    ended(process)  # a record would take longer
    out, err = process.communicate()
    assert process.returncode == 130, err
    summary = json.loads(out)
    assert summary["state"] == "interrupted"
    assert "continue with: lambda-bearing resume" in err


def ended(process: Started) -> None:
    """Wait for the end or kill.

    A process that does not end is killed.
    """
    code = process.wait(PATIENCE)
    if code is None:
        process.kill()
    assert code is not None, process.communicate()


def children(pid: int) -> list[int]:
    """Return a process's running children."""
    found = Path(f"/proc/{pid}/task/{pid}/children").read_text(encoding="ascii").split()
    return [int(child) for child in found]


def is_alive(pid: int) -> bool:
    """Tell whether a process runs.

    Nobody waits for one that lost its parent, where nothing reaps.
    """
    try:
        return Path(f"/proc/{pid}/stat").read_text(encoding="ascii").rpartition(")")[2].split()[0] != "Z"
    except OSError:
        return False


@pytest.mark.full
@pytest.mark.skipif(not Path("/proc/self/task").is_dir(), reason="who started whom is read from /proc")
@pytest.mark.parametrize("number", [signal.SIGTERM, signal.SIGKILL])
def test_c2_4_what_compiles_ends_with_its_parent(number: int, program: Program, tmp_path: Path) -> None:
    process = program("quasistatic", CASE, env={"LAMBDA_BEARING_CACHE": str(tmp_path / "cache")})
    while process.poll() is None and not (compilers := children(process.pid)):
        time.sleep(0.02)
    process.send_signal(number)
    _, err = process.communicate(timeout=PATIENCE)
    assert "Traceback" not in err
    end = time.monotonic() + PATIENCE
    while any(is_alive(pid) for pid in compilers) and time.monotonic() < end:
        time.sleep(0.05)
    assert not [pid for pid in compilers if is_alive(pid)]


def test_c2_4_a_limit_of_wall_time_holds_within_a_record_and_the_run_goes_on(tmp_path: Path) -> None:
    path = tmp_path / "r.h5"
    result = api.run(CASE, [*SLOW, "solver.max_wall=0.2 s"], out=path)
    assert result.status().state == "stopped"
    # 1/40 of a cage turn of 1/(0.4 x 0.01 rpm)
    assert 0.0 < result.summary().simulated_s < 60.0 / (0.4 * 0.01) / 40.0


def test_b10_the_limit_of_wall_time_includes_the_preparation(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Count the preparation in the time limit.

    Equilibrium and compiling came on top of it.
    """
    clock, late, prepared = time.perf_counter, [0.0], launch.prepared

    def slowly(*arguments: Any, **options: Any) -> Any:
        late[0] += 1000.0
        return prepared(*arguments, **options)

    monkeypatch.setattr(time, "perf_counter", lambda: clock() + late[0])
    monkeypatch.setattr(launch, "prepared", slowly)
    path = tmp_path / "r.h5"
    result = api.run(CASE, ["solver.duration=20 ms", "solver.max_wall=900 s"], out=path)
    assert result.status().state == "stopped"
    assert result.status().wall < 900.0  # what the steps took
    assert api.resume(path, ["solver.max_wall=900 s"]).status().state == "stopped"
    assert api.resume(path).status().state == "finished"


def test_the_limit_of_wall_time_ends_a_search_for_the_start(tmp_path: Path) -> None:
    """Give up where needles find no steady motion.

    The search went on for minutes past a limit of four seconds.
    """
    case = {
        "name": "cold", "bearing": {"designation": "SKF NA 4905"}, "loads": {"radial": "7959.79 N"},
        "lubricant": {"name": "FVA3", "temperature": "24.9517 degC"}, "operation": {"speed": "1127.87 rpm"},
        "solver": {"max_wall": "10 ms"},
    }  # fmt: skip
    with pytest.raises(SolverError, match=r"cold: the search for the equilibrium did not end .* \(solver\.max_wall\)"):
        api.run(case, out=tmp_path / "r.h5")
    assert not list(tmp_path.iterdir())


def test_d1_samples_closer_than_the_longest_step_over_the_buffer_are_written(tmp_path: Path) -> None:
    changes = ["operation.speed=10 rpm", "output.interval=50 us", "solver.duration=1 ms"]
    result = api.run(CASE, changes, out=tmp_path / "r.h5")
    assert result.status().state == "finished"
    np.testing.assert_allclose(result["time"][:21], 50e-6 * np.arange(21), rtol=1e-12)


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ("output.interval=1e-30 s", "output.interval"),
        ("output.interval=1e-9 s", "output.interval"),
        ("solver.max_step=1e-15 s", "solver.max_step"),
        ("operation.speed=1e-9 rpm", "solver.max_duration"),
    ],
)
def test_c2_4_what_would_never_end_is_refused(change: str, words: str) -> None:
    with pytest.raises(CaseError, match=words):
        api.check(CASE, [change])


@pytest.mark.full
def test_a4_a_second_signal_ends_a_law_that_never_returns(
    warm: Warm, misbehaving: Mapping[str, str], tmp_path: Path
) -> None:
    path = tmp_path / "r.h5"
    lurking = ("--set", "models.fluid_drag=lurking")
    process = warm.start(PROGRAM, "run", CASE, *lurking, "--out", str(path), env=misbehaving)
    wait_for_life(path, process)
    wait_for_standstill(path, process)
    os.kill(process.pid, signal.SIGINT)
    assert process.wait(2.0) is None  # Python does not hear it
    os.kill(process.pid, signal.SIGINT)
    ended(process)
    _, err = process.communicate()
    assert process.returncode == 130
    assert "what was written is kept" in err
    result = api.result(path)
    assert result.status().state == "running"
    assert not result.status().alive()
    assert result.checkpoint() is not None


@pytest.mark.full
def test_a4_a_law_that_never_returns_does_not_keep_the_others_from_being_checked(
    misbehaving: Mapping[str, str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("PYTHONPATH", misbehaving["PYTHONPATH"])
    monkeypatch.syspath_prepend(misbehaving["PYTHONPATH"].split(":")[0])
    registry.cache_clear()
    try:
        cards = list(check_apart(registry(), ["damping"], limit=10.0))
    finally:
        registry.cache_clear()
    found = {card.name: card for card in cards}
    assert found["cubic"].ok
    assert found["none"].ok
    assert "did not come to an end within 10 s" in found["endless"].faults[0]


def test_c1_packing_a_long_result_is_not_for_whoever_waits(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Stop before a long result is packed.

    Asked to stop while it closes, a finished run keeps its result as it is, complete and not packed.
    """
    plain = file_format._copy_dataset

    def asked(
        name: str, item: object, target: object, rows: object, compress: bool, stop: Callable[[], bool]
    ) -> object:
        if compress and name == "bearings/bearing/load":
            signal.raise_signal(signal.SIGINT)
        return plain(name, item, target, rows, compress, stop)

    monkeypatch.setattr(file_format, "_copy_dataset", asked)
    path = tmp_path / "r.h5"
    result = api.run(CASE, ["solver.duration=1 ms"], out=path)
    assert result.status().state == "finished"
    assert len(result["load"]) == len(result["time"]) > 0
    assert [file.name for file in tmp_path.iterdir()] == ["r.h5"]
    with h5py.File(path) as file:
        assert file["load"].compression is None


def test_c2_4_what_was_stopped_is_packed_for_half_a_second_at_most(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(file_format, "PACKING", 0.0)
    path = tmp_path / "r.h5"
    assert api.run(CASE, [*SLOW, "solver.max_wall=0.05 s"], out=path).status().state == "stopped"
    with h5py.File(path) as file:
        assert file["load"].compression is None
    assert len(api.result(path)["load"]) > 0


@pytest.mark.parametrize("moment", ["import", "begin"])
def test_ctrl_c_while_the_program_starts_ends_in_one_line(
    moment: str, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """End an early Ctrl+C in one line.

    It printed the traceback of the import, or of the thread that waits for signals.
    """

    def interrupted(*_: object) -> int:
        raise KeyboardInterrupt

    class Interrupted:
        def __getattr__(self, name: str) -> Any:
            return interrupted() if moment == "import" else interrupted

    monkeypatch.setitem(sys.modules, "lambda_cli.main", Interrupted())  # type: ignore[arg-type]
    assert start.main() == 130
    assert capsys.readouterr().err == "interrupted\n"
    script = tomllib.loads((Path(__file__).parents[2] / "pyproject.toml").read_text(encoding="utf-8"))
    assert script["project"]["scripts"]["lambda-bearing"] == "lambda_cli.start:main"


def test_c2_4_an_interruption_that_a_destructor_drops_is_heard_again() -> None:
    """Repeat an interruption that a destructor dropped.

    A report whose Ctrl+C came while a figure was destroyed went on to its end.
    """

    class Deaf:
        def __del__(self) -> None:
            raise KeyboardInterrupt

    def work() -> None:
        with second_signal_ends(130):
            Deaf()
            for _ in range(1000):  # Python hears between two instructions of its own
                time.sleep(0.01)

    before = signal.signal(signal.SIGINT, signal.default_int_handler)  # in the background of a shell it is ignored
    try:
        with pytest.raises(KeyboardInterrupt):
            work()
    finally:
        signal.signal(signal.SIGINT, before)


def test_an_interruption_that_a_library_turns_into_its_error_is_no_bug(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """Answer Ctrl+C as such.

    It came while compiled code read its arguments, which made a TypeError of it, and the command reported a bug.
    """

    def work(*, is_hit: bool = True, **options: object) -> None:
        with contextlib.suppress(KeyboardInterrupt):
            if is_hit:
                os.kill(os.getpid(), signal.SIGINT)
                time.sleep(1.0)
        raise TypeError("missing 1 required positional argument")

    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    try:
        monkeypatch.setattr(command, "application", work)
        assert command.main([]) == 130
        assert capsys.readouterr().err == "interrupted\n"
        monkeypatch.setattr(command, "application", partial(work, is_hit=False))
        assert command.main([]) == 1
    finally:
        signal.signal(signal.SIGINT, before)


@pytest.mark.parametrize("number", [signal.SIGTERM, signal.SIGHUP])
def test_every_command_hears_a_request_to_terminate_as_ctrl_c(
    number: int, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """Answer requests of other programs and a closed terminal.

    Commands other than runs were killed: a fit lost its best values and left a warning of Python's about semaphores.
    """

    def work(*, answer: int = 0, **options: object) -> int:
        os.kill(os.getpid(), number)
        time.sleep(0.2)
        return answer

    monkeypatch.setattr(command, "application", work)
    before = signal.signal(number, signal.SIG_DFL)
    try:
        assert command.main([]) == 130
        assert capsys.readouterr().err == "interrupted\n"
        assert signal.getsignal(number) == signal.SIG_DFL
        signal.signal(number, signal.SIG_IGN)  # as nohup does
        monkeypatch.setattr(command, "application", partial(work, answer=7))
        assert command.main([]) == 7
    finally:
        signal.signal(number, before)
