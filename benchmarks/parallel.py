"""Measure parallel processes and the efficiency of studies."""

from __future__ import annotations

import multiprocessing
import os
import queue
import tempfile
import time
import tomllib
from pathlib import Path
from typing import Any

from benchmarks.cases import MIDDLE
from benchmarks.tables import Cell, Section, Table, Target
from benchmarks.timing import Effort
from lambda_core import api
from lambda_core.studies.study_files import example_texts

PROCESSES = (1, 2, 4)
_TURNS = 1.0  # of the cage
_PATIENCE = 120.0  # wall time [s]
_WORKERS = 2  # that the targets are for
_MUST, _GOAL = 30.0, 0.85  # wall time of the map [s]; parallel efficiency


def _worker(barrier: Any, results: Any, rounds: int) -> None:
    """Integrate the same case repeatedly.

    `rounds` times, starting each together with the others.
    """
    from benchmarks.passage import Horizon, passage
    from lambda_core.solver.drivers.equilibrium import solve

    model = MIDDLE.model()
    start = solve(model)
    for number in range(rounds):
        barrier.wait()
        began = time.perf_counter()
        passage(model, start, Horizon(0.0, _TURNS))
        results.put((number, time.perf_counter() - began))


def together(count: int, rounds: int) -> float:
    """Return the wall time of parallel processes [s].

    `count` processes do the same; the best of `rounds`.
    """
    context = multiprocessing.get_context("spawn")
    barrier, results = context.Barrier(count), context.Queue()
    workers = [context.Process(target=_worker, args=(barrier, results, rounds)) for _ in range(count)]
    for worker in workers:
        worker.start()
    try:
        found: list[tuple[int, float]] = [results.get(timeout=_PATIENCE) for _ in range(count * rounds)]
    except queue.Empty:
        raise RuntimeError(f"{count} processes have not answered within {_PATIENCE:g} s") from None
    finally:
        for worker in workers:
            worker.join(1.0)
            worker.terminate()
    return min(max(seconds for number, seconds in found if number == wanted) for wanted in range(rounds))


def friction_map(points: int) -> dict[str, Any]:
    """Return the shipped friction map with `points` speeds."""
    study = tomllib.loads(example_texts()["friction-map"])
    study["parameters"][0]["points"] = points
    return study


def runs(count: int) -> dict[str, Any]:
    """Return a study of `count` runs, a cage revolution each."""
    return {
        "name": "runs",
        "case": "6319-cp10-1500",
        "mode": "dynamic",
        "set": {"solver.duration": "0.1 s"},
        "parameters": [{"path": "loads.radial", "range": ["10 kN", "22 kN"], "points": count}],
    }


def study_time(study: dict[str, Any], workers: int) -> tuple[float, float]:
    """Return a study's wall time [s] and occupation.

    Start of the workers included; the share in which they had a point.
    """
    with tempfile.TemporaryDirectory() as folder:
        began = time.perf_counter()
        status = api.study_run(study, Path(folder) / "study", workers=workers)
        seconds = time.perf_counter() - began
    if status.pending or status.failed:
        raise RuntimeError(f"{status.failed} points failed, {status.pending} are left: {status.reasons}")
    return seconds, status.parallel_efficiency or 0.0


def studies(effort: Effort) -> tuple[Table, tuple[Target, ...]]:
    """Time whole studies on one and on several workers."""
    rows: list[tuple[Cell, ...]] = []
    targets: list[Target] = []
    for name, study, points in (
        ("friction map, quasi-static", friction_map(effort.pick(5, 25)), effort.pick(100, 500)),
        ("runs of one cage revolution", runs(effort.pick(8, 24)), effort.pick(8, 24)),
    ):
        api.study_check(study)  # compiles
        alone = 0.0
        for count in (1, _WORKERS, 4):
            if count > (os.cpu_count() or 1):
                continue
            seconds, busy = study_time(study, count)
            alone = alone or seconds
            rows.append((name, points, count, seconds, points / seconds, alone / count / seconds, busy))
            if count == _WORKERS:
                targets.append(Target(f"{name}: efficiency on 2 workers", "", busy, goal=_GOAL, at_least=True))
                if points == 500:
                    targets.append(Target("500 points of a friction map on 2 workers", "s", seconds, must=_MUST))
    table = Table(
        "Studies",
        ("study", "points", "workers", "wall s", "points per s", "one worker's time over all", "workers busy"),
        tuple(rows),
        (
            "Wall time with the start of the workers; everything was compiled. Efficiency: time that workers spend "
            "on points over wall time times workers.",
        ),
    )
    return table, tuple(targets)


def measure(effort: Effort) -> Section:
    """Compare serial and parallel work.

    One process with several, then studies on one worker with studies on several.
    """
    rows: list[tuple[Cell, ...]] = []
    alone = 0.0
    for count in PROCESSES:
        if count > (os.cpu_count() or 1):
            continue
        seconds = together(count, effort.repeats)
        alone = alone or seconds
        rows.append((count, 1e3 * seconds, count * alone / seconds, alone / seconds))
    table = Table(
        f"Parallel processes, {MIDDLE.name}",
        ("processes", "until all are done ms", "times the work of one", "efficiency"),
        tuple(rows),
        ("Wall time, the best of several rounds; load by other users lowers the efficiency.",),
    )
    found, targets = studies(effort)
    return Section("parallel", (table, found), targets)
