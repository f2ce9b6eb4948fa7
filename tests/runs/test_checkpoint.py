"""Test interrupted runs.

Whatever ended them and whenever, the continuation is the run that was never interrupted.
"""

from __future__ import annotations

import json
import os
import random
import signal
import subprocess
import sys
import time
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

import h5py
import numpy as np
import pytest
from fake_engine import FAKE_RUN, FakeEngine, MakeProvenance, Truth

from lambda_core.domain.errors import UsageError
from lambda_core.results import file_format as layout
from lambda_core.results.checkpoint import Checkpoint, Position, latest
from lambda_core.results.opening import ResultError
from lambda_core.results.reader import Result
from lambda_core.results.run_status import Rows, Status, process_identity
from lambda_core.runs.loop import resume, run

if TYPE_CHECKING:
    from warm import Started, Warm

SLOW = Truth(noise=0.5, slowness=2e-4)
DURATION = 0.35
WANTED = {"truth": {"noise": 0.5, "slowness": 2e-4}, "solver": {"duration": DURATION}, "checkpoint_interval": 0.01}
# The same run, long enough in wall time to be met halfway.
SLOWER = {**WANTED, "truth": {"noise": 0.5, "slowness": 2e-3}}


def growing(path: Path) -> dict[str, np.ndarray]:
    """Return everything that a run appends to."""
    result = Result(path)
    found = {channel.name: result[channel.name] for channel in result.channels}
    return found | {layout.INTEGRALS_GROUP: result.integrals(), layout.REVOLUTIONS_GROUP: result.revolutions()}


def same(path: Path, reference: dict[str, np.ndarray]) -> None:
    found = growing(path)
    assert set(found) == set(reference)
    for name, values in reference.items():
        assert found[name].tobytes() == values.tobytes(), name


@pytest.fixture(scope="module")
def undisturbed(resolved, tmp_path_factory: pytest.TempPathFactory) -> dict[str, np.ndarray]:
    from lambda_core.results.provenance import Provenance

    model = replace(resolved, solver=replace(resolved.solver, duration=DURATION))
    path = tmp_path_factory.mktemp("undisturbed") / "r.h5"
    run(FakeEngine(replace(SLOW, slowness=0.0)), Provenance.alone(model, {}), path)
    return growing(path)


def start(warm: Warm, verb: str, path: Path, wanted: dict[str, object] = WANTED) -> Started:
    """Start a run and wait.

    In its own process, until it is about to integrate.
    """
    process = warm.start(FAKE_RUN, verb, str(path), json.dumps(wanted))
    assert process.stdout.readline() == "ready\n"
    return process


def under_way(path: Path, process: Started) -> None:
    """Wait for a run's first samples.

    By then it listens to signals.
    """
    while not path.exists() or Result(path).status().rows.samples < 2:
        assert process.poll() is None, process.communicate()
        time.sleep(0.01)


def kill_and_resume(warm: Warm, path: Path, delays: list[float], reference: dict[str, np.ndarray]) -> None:
    """Kill a run and its continuations.

    After the given times, then let one finish.
    """
    verb = "run"
    for delay in delays:
        process = start(warm, verb, path)
        time.sleep(delay)
        process.kill()
        process.communicate()
        if path.exists():  # from its first moment on it is readable
            verb = "resume"
            if Result(path).status().state == "finished":
                break
    if verb == "run" or Result(path).status().state != "finished":
        process = start(warm, verb, path)
        _, errors = process.communicate()
        assert process.returncode == 0, errors
    same(path, reference)
    assert Result(path).status().state == "finished"


@pytest.mark.full
def test_kill_at_random_moments(warm: Warm, tmp_path: Path, undisturbed: dict[str, np.ndarray]) -> None:
    chance = random.Random(0)
    kill_and_resume(warm, tmp_path / "r.h5", [chance.uniform(0.0, 0.35) for _ in range(4)], undisturbed)


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(100, 125))
def test_kill_a_hundred_times(seed: int, warm: Warm, tmp_path: Path, undisturbed: dict[str, np.ndarray]) -> None:
    chance = random.Random(seed)
    kill_and_resume(warm, tmp_path / "r.h5", [chance.uniform(0.0, 0.35) for _ in range(4)], undisturbed)


def test_a_killed_run_is_readable_and_not_alive(warm: Warm, tmp_path: Path) -> None:
    path = tmp_path / "r.h5"
    process = start(warm, "run", path, SLOWER)
    under_way(path, process)
    assert Result(path).status().alive()
    with pytest.raises(ResultError, match=f"still being written by process {process.pid}"):
        resume(FakeEngine(), None, path)  # type: ignore[arg-type]  # refused before it is looked at
    process.kill()
    process.communicate()
    result = Result(path)
    status = result.status()
    assert not status.alive()
    assert status.state == "running"
    rows = status.rows
    assert 0 < rows.samples == len(result["load"])
    assert result["time"] == pytest.approx(np.arange(rows.samples) * FakeEngine().sample_interval)
    assert result.summary().reasons[0] == "the run has not reached its end"


@pytest.mark.skipif(not Path("/proc/self/stat").exists(), reason="the states of processes stand in /proc")
def test_a_writer_that_was_killed_is_not_alive_before_its_parent_has_waited_for_it() -> None:
    """Treat a killed writer as dead before its parent waits.

    The first process of the system waits for orphans, in a container perhaps never.
    """
    process = subprocess.Popen([sys.executable, "-c", "input()"], stdin=subprocess.PIPE)
    status = Status(process=process_identity(process.pid))
    assert status.alive()
    process.kill()
    os.waitid(os.P_PID, process.pid, os.WEXITED | os.WNOWAIT)  # it has ended, and is left as it is
    assert not status.alive()
    assert process.wait() == -signal.SIGKILL
    process.communicate()


@pytest.mark.parametrize("number", [signal.SIGINT, pytest.param(signal.SIGTERM, marks=pytest.mark.full)])
def test_ctrl_c_keeps_a_readable_result_that_continues(
    number: int, warm: Warm, tmp_path: Path, undisturbed: dict[str, np.ndarray]
) -> None:
    path = tmp_path / "r.h5"
    process = start(warm, "run", path, {**SLOWER, "checkpoint_interval": 1e9})
    under_way(path, process)
    os.kill(process.pid, number)
    _, errors = process.communicate()
    assert process.returncode == 0, errors
    result = Result(path)
    assert result.status().state == "interrupted"
    assert "stopped by" in result.summary().reasons[0]
    with h5py.File(path) as file:  # closed and compressed like any finished result
        assert file["load"].compression == "gzip"
    process = start(warm, "resume", path)
    _, errors = process.communicate()
    assert process.returncode == 0, errors
    same(path, undisturbed)


def test_longer_durations_continue_a_finished_run(
    provenance: MakeProvenance, tmp_path: Path, undisturbed: dict[str, np.ndarray]
) -> None:
    path = tmp_path / "r.h5"
    truth = replace(SLOW, slowness=0.0)
    run(FakeEngine(truth), provenance(duration=0.2 * DURATION), path)
    for share in (0.283, 0.503, 0.777, 1.0):
        short = Result(path).status()
        resume(FakeEngine(truth), provenance(duration=share * DURATION), path)
        long = Result(path).status()
        assert long.wall > short.wall
        assert long.statistics["steps"] > short.statistics["steps"]
    same(path, undisturbed)


def test_copies_of_killed_processes_are_swept_away(provenance: MakeProvenance, tmp_path: Path) -> None:
    process = subprocess.Popen([sys.executable, "-c", ""])
    process.wait()
    dead, living = tmp_path / f".r.h5.{process.pid}", tmp_path / f".r.h5.{os.getppid()}"
    other = tmp_path / f".r.h5.old.{process.pid}"
    for path in (dead, living, other):
        path.write_bytes(b"")
    run(FakeEngine(), provenance(duration=0.01), tmp_path / "r.h5")
    assert not dead.exists()
    assert living.exists()


def test_nothing_left_to_do_is_said(provenance: MakeProvenance, tmp_path: Path) -> None:
    path = tmp_path / "r.h5"
    for solver in ({"duration": 0.05}, {}):
        run(FakeEngine(), provenance(**solver), path, overwrite=True)
        before = path.read_bytes()
        with pytest.raises(UsageError, match="nothing is left to do"):
            resume(FakeEngine(), provenance(**solver), path)
        assert path.read_bytes() == before


@pytest.mark.full
def test_a_run_that_converges_after_its_continuation_stops_where_it_would_have(
    provenance: MakeProvenance, tmp_path: Path
) -> None:
    complete = run(FakeEngine(Truth(noise=0.5)), provenance(), tmp_path / "whole.h5")
    path = tmp_path / "r.h5"
    run(FakeEngine(Truth(noise=0.5)), provenance(max_duration=0.21), path)
    resumed = resume(FakeEngine(Truth(noise=0.5)), provenance(), path)
    same(path, growing(complete.path))
    assert resumed.summary().friction_torque_Nmm == complete.summary().friction_torque_Nmm
    assert resumed.summary().converged


def test_statistics_go_on_counting(provenance: MakeProvenance, tmp_path: Path) -> None:
    complete = run(FakeEngine(), provenance(duration=0.06), tmp_path / "whole.h5").status().statistics
    path = tmp_path / "r.h5"
    run(FakeEngine(), provenance(duration=0.03), path)
    assert resume(FakeEngine(), provenance(duration=0.06), path).status().statistics == complete


def checkpoint(sequence: int) -> bytes:
    state = {"y": np.arange(5.0) + sequence, "history": np.ones((3, 4))}
    return Checkpoint(Position(sequence, Rows(7, 3, 1), 1.5, {"steps": 9.0}), state).to_bytes()


def test_the_newer_complete_slot_counts() -> None:
    found = latest([checkpoint(4), checkpoint(3)])
    assert found is not None
    assert found.position == Position(4, Rows(7, 3, 1), 1.5, {"steps": 9.0})
    assert (found.state["y"] == np.arange(5.0) + 4).all()
    assert found.state["history"].shape == (3, 4)


@pytest.mark.parametrize("cut", [0, 10, 28, 100, -1])
def test_a_torn_slot_is_passed_over(cut: int) -> None:
    """Skip a slot that a dying process left.

    The process was writing it over an older one.
    """
    new, old = checkpoint(6), checkpoint(4)
    torn = new[:cut] + old[cut:]
    if cut == -1:
        torn = new[:-1] + bytes([new[-1] ^ 1])
    found = latest([torn, checkpoint(5)])
    assert found is not None
    assert found.position.sequence == 5
    assert latest([b"", b""]) is None
