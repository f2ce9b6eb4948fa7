"""Test workers in processes of their own.

Equal numbers everywhere, killed workers and killed studies lose nothing.
"""

from __future__ import annotations

import os
import random
import resource
import signal
import subprocess
import sys
import time
from collections.abc import Callable
from concurrent.futures import Executor
from functools import partial
from pathlib import Path
from typing import Any

import pytest
from studies import MAP, RUNS, Inline
from warm import PROGRAM, Warm

from lambda_core import api
from lambda_core.domain.errors import UsageError
from lambda_core.studies.pool import Processes
from lambda_core.studies.scheduler import Director
from lambda_core.studies.store import Manifest

Write = Callable[..., Path]


def numbers(folder: Path) -> list[dict[str, Any]]:
    """Return a study table's invariant content.

    It must not depend on how the table was computed.
    """
    return api.study_table(folder).rows()


def differences(found: list[dict[str, Any]], expected: list[dict[str, Any]]) -> list[str]:
    """Return every difference of two tables.

    So a failure reports more than their inequality.
    """
    if len(found) != len(expected):
        return [f"{len(found)} rows in place of {len(expected)}"]
    return [
        f"row {row}, {name}: {one.get(name)} in place of {other.get(name)}"
        for row, (one, other) in enumerate(zip(found, expected, strict=True))
        for name in {**one, **other}
        if one.get(name) != other.get(name)
    ]


def in_this_process(folder: Path, text: str) -> list[dict[str, Any]]:
    """Return a study's table, computed here.

    One point after the other in this process.
    """
    path = folder.with_suffix(".toml")
    path.write_text(text, encoding="utf-8")
    api.study_run(path, folder, executor=Inline())
    return numbers(folder)


@pytest.fixture(scope="module")
def map_table(tmp_path_factory: pytest.TempPathFactory) -> list[dict[str, Any]]:
    return in_this_process(tmp_path_factory.mktemp("reference") / "map", MAP)


@pytest.fixture(scope="module")
def runs_table(tmp_path_factory: pytest.TempPathFactory) -> list[dict[str, Any]]:
    text = RUNS.format(duration="0.02 s", speeds=2, loads=2)
    return in_this_process(tmp_path_factory.mktemp("reference") / "runs", text)


@pytest.mark.full
def test_processes_give_the_same_table(write: Write, tmp_path: Path, map_table: list[dict[str, Any]]) -> None:
    reports = []
    status = api.study_run(write(MAP), tmp_path / "map", workers=2, progress=reports.append)
    assert status.done == 6
    assert numbers(tmp_path / "map") == map_table
    assert status.parallel_efficiency is not None
    assert 0.0 < status.parallel_efficiency <= 1.05
    assert reports[-1].done == 6


@pytest.mark.slow
def test_a_dask_cluster_gives_the_same_table(write: Write, tmp_path: Path, map_table: list[dict[str, Any]]) -> None:
    pytest.importorskip("distributed")
    status = api.study_run(write(MAP), tmp_path / "map", executor="dask", workers=2)
    assert status.done == 6
    assert numbers(tmp_path / "map") == map_table


def test_a_scheduler_that_does_not_answer_is_named(
    write: Write, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    pytest.importorskip("distributed")
    monkeypatch.setattr("lambda_core.studies.pool._PATIENCE", 2.0)
    path = write(MAP.replace("points = 3", "points = 2"))
    with pytest.raises(UsageError, match="no dask scheduler answers at"):
        api.study_run(path, tmp_path / "map", executor="tcp://127.0.0.1:9")
    with pytest.raises(UsageError, match='"slurm" is not a place to work; there are: processes, here, dask'):
        api.study_run(path, tmp_path / "other", executor="slurm")


Start = Callable[..., Any]


@pytest.fixture
def start(warm: Warm) -> Start:
    """Start a study command in a session.

    It can be killed with everything that it started.
    """

    def started(verb: str, what: Path, *options: str) -> Any:
        return warm.start(f"import os; os.setsid(); {PROGRAM}", "study", verb, str(what), "--quiet", *options)

    return started


def wait_for(condition: Callable[[], bool], seconds: float = 400.0) -> None:
    end = time.monotonic() + seconds
    while not condition():
        assert time.monotonic() < end, "it did not happen"
        time.sleep(0.05)


def files(folder: Path) -> int:
    return len(list((folder / "runs").glob("[!.]*.h5"))) if (folder / "runs").is_dir() else 0


def is_under_way(folder: Path) -> bool:
    """Tell whether a run has samples.

    By then it listens to signals.
    """
    return any(api.result(path).status().rows.samples > 1 for path in (folder / "runs").glob("[!.]*.h5"))


def _further(folder: Path, runs: int, study: Any) -> bool:
    return files(folder) > runs or study.poll() is not None


def killed_and_resumed(
    start: Start, path: Path, folder: Path, kills: int, seed: int, last: Executor | None = None
) -> None:
    """Kill a study repeatedly and resume.

    At random moments, everything that belongs to it at once.
    """
    chance = random.Random(seed)
    study = start("run", path, "--out", str(folder), "--workers", "2", "--band", "none")
    for kill in range(kills):
        wait_for(partial(_further, folder, kill, study))
        time.sleep(chance.uniform(0.0, 0.4))
        os.killpg(study.pid, signal.SIGKILL)
        study.wait()
        if kill < kills - 1:
            study = start("resume", folder, "--workers", "2")
    api.study_resume(folder, workers=2, executor=last or "processes")


@pytest.mark.full
def test_a_killed_study_goes_on_to_the_same_table(
    start: Start, write: Write, tmp_path: Path, runs_table: list[dict[str, Any]]
) -> None:
    folder = tmp_path / "killed"
    killed_and_resumed(start, write(RUNS.format(duration="0.02 s", speeds=2, loads=2)), folder, 1, 1, last=Inline())
    assert differences(numbers(folder), runs_table) == []


@pytest.mark.slow
def test_24_runs_killed_three_times_end_with_the_same_table(
    start: Start, write: Write, tmp_path: Path, inline: Executor
) -> None:
    path = write(RUNS.format(duration="0.05 s", speeds=4, loads=6))
    api.study_run(path, tmp_path / "undisturbed", executor=inline)
    killed_and_resumed(start, path, tmp_path / "killed", 3, seed=24)
    assert numbers(tmp_path / "killed") == numbers(tmp_path / "undisturbed")
    assert len(numbers(tmp_path / "killed")) == 24


def children(pid: int) -> list[int]:
    """Return the workers of a process that directs a study."""
    found = []
    for entry in Path("/proc").glob("[0-9]*"):
        try:
            status = (entry / "stat").read_text().rpartition(")")[2].split()
            command = (entry / "cmdline").read_bytes()
        except OSError:
            continue
        if int(status[1]) == pid and b"spawn_main" in command:
            found.append(int(entry.name))
    return found


@pytest.mark.full
@pytest.mark.skipif(not Path("/proc/self/stat").exists(), reason="looks for workers in /proc")
def test_a_lost_worker_loses_no_point(
    start: Start, write: Write, tmp_path: Path, runs_table: list[dict[str, Any]]
) -> None:
    folder = tmp_path / "lost"
    path = write(RUNS.format(duration="0.02 s", speeds=2, loads=2))
    study = start("run", path, "--out", str(folder), "--workers", "1", "--band", "none")
    try:
        wait_for(lambda: files(folder) > 0 or study.poll() is not None)
        (worker,) = children(study.pid)
        os.kill(worker, signal.SIGKILL)
        assert study.wait(timeout=600) is not None
    finally:
        if study.poll() is None:
            os.killpg(study.pid, signal.SIGKILL)
    assert differences(numbers(folder), runs_table) == []
    assert study.returncode == 5  # runs of 20 ms have not converged, and the exit code says so


@pytest.mark.full
@pytest.mark.skipif(not Path("/proc/self/stat").exists(), reason="looks for workers in /proc")
def test_workers_do_not_outlive_their_director(start: Start, write: Write, tmp_path: Path) -> None:
    folder = tmp_path / "orphans"
    path = write(RUNS.format(duration="5 s", speeds=2, loads=1).replace("points = 1", "points = 2"))
    study = start("run", path, "--out", str(folder), "--workers", "1")
    wait_for(lambda: files(folder) > 0 or study.poll() is not None)
    workers = children(study.pid)
    assert workers
    os.kill(study.pid, signal.SIGKILL)  # the director alone
    study.wait()
    wait_for(lambda: not any(Path(f"/proc/{pid}").exists() for pid in workers))
    assert api.study_status(folder).pending == 4


@pytest.mark.full
def test_ctrl_c_stops_the_runs_in_hand_and_begins_no_other(start: Start, write: Write, tmp_path: Path) -> None:
    folder = tmp_path / "stopped"
    text = RUNS.format(duration="5 s", speeds=2, loads=2)
    study = start("run", write(text), "--out", str(folder), "--workers", "1")
    wait_for(lambda: files(folder) > 0 or study.poll() is not None)
    wait_for(lambda: is_under_way(folder) or study.poll() is not None)
    os.kill(study.pid, signal.SIGINT)
    assert study.wait(timeout=600) == 130
    assert api.study_status(folder).pending == 4
    assert files(folder) == 1  # tasks that waited behind it were not begun
    (path,) = (folder / "runs").glob("[!.]*.h5")
    assert api.result(path).status().state == "interrupted"


@pytest.mark.slow
def test_a_lost_dask_worker_loses_no_point(write: Write, tmp_path: Path, runs_table: list[dict[str, Any]]) -> None:
    distributed: Any = pytest.importorskip("distributed")
    path = write(RUNS.format(duration="0.02 s", speeds=2, loads=2))
    folder = tmp_path / "dask"
    with (
        distributed.LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None) as cluster,
        distributed.Client(cluster) as client,
    ):
        import threading

        def murder() -> None:
            wait_for(lambda: files(folder) > 0)
            pids = client.run(os.getpid)
            os.kill(next(iter(pids.values())), signal.SIGKILL)

        thread = threading.Thread(target=murder)
        thread.start()
        api.study_run(path, folder, executor=cluster.scheduler_address, workers=2)
        thread.join()
    assert differences(numbers(folder), runs_table) == []


def deadly(task: Any) -> Any:
    """Stand in for a deadly point.

    Its worker always dies.
    """
    from lambda_core.studies.job import Outcome

    if task.number == 2:
        os.kill(os.getpid(), signal.SIGKILL)
    return Outcome(task.number, "done", "", "", {"friction_torque_Nmm": float(task.number)}, "", 0.0)


@pytest.mark.full
def test_a_point_that_kills_its_worker_fails_alone(write: Write, tmp_path: Path, inline: Executor) -> None:
    from lambda_core.studies.job import Outcome, Task, lost

    folder = tmp_path / "deadly"
    api.study_run(write(MAP), folder, executor=inline)
    manifest = Manifest(folder, write=True)
    staff = Processes(2)
    tasks = [Task(number, "", (), "quasi-static", (), "") for number in range(6)]
    try:
        assert Director[Task, Outcome](manifest, staff, deadly, lost).run(tasks)
    finally:
        staff.close(stop=True)
        manifest.close()
    table = api.study_table(folder)
    assert table.states == ("done", "done", "failed", "done", "done", "done")
    assert "the worker process died on this point" in table.reasons[2]
    torque = table.response("friction_torque_Nmm").values
    assert [torque[i] for i in (0, 1, 3, 4, 5)] == [0.0, 1.0, 3.0, 4.0, 5.0]


@pytest.mark.clock
@pytest.mark.slow
def test_a_map_of_500_points_within_30_seconds_on_two_cores(tmp_path: Path) -> None:
    """Time a compiled map from the command line.

    The start of the program and of the workers is included.

    On a machine with more to do than it has cores, the processor time of all processes stands for the wall time.
    """
    path = Path(__file__).parents[2] / "lambda_core" / "studies" / "examples" / "friction-map.toml"
    api.study_check(path)  # compiled beforehand, as by `lambda-bearing warmup`
    begin, before = time.perf_counter(), resource.getrusage(resource.RUSAGE_CHILDREN)
    command = [sys.executable, "-m", "lambda_cli", "study", "run", str(path), "--quiet", "--workers", "2"]
    done = subprocess.run([*command, "--out", str(tmp_path / "map")], capture_output=True, check=False)
    assert done.returncode == 0
    seconds, after = time.perf_counter() - begin, resource.getrusage(resource.RUSAGE_CHILDREN)
    if os.getloadavg()[0] > (os.cpu_count() or 1):
        seconds = 0.5 * (after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime)
    status = api.study_status(tmp_path / "map")
    assert (status.points, status.done) == (500, 500)
    assert seconds < 30.0
