"""Several runs at once: what a core still yields when its neighbours work too."""

from __future__ import annotations

import multiprocessing
import os
import queue
import time
from typing import Any

from benchmarks.cases import MIDDLE
from benchmarks.tables import Cell, Section, Table
from benchmarks.timing import Effort

PROCESSES = (1, 2, 4)
_TURNS = 1.0  # of the cage
_PATIENCE = 120.0  # wall time [s]


def _worker(barrier: Any, results: Any, rounds: int) -> None:
    """Integrate the same case `rounds` times, starting each together with the others."""
    from benchmarks.passage import Horizon, passage
    from lambda_core.physics.equilibrium import solve

    model = MIDDLE.model()
    start = solve(model)
    for number in range(rounds):
        barrier.wait()
        began = time.perf_counter()
        passage(model, start, Horizon(0.0, _TURNS))
        results.put((number, time.perf_counter() - began))


def together(count: int, rounds: int) -> float:
    """Return the wall time until `count` processes have all done the same [s], the best of `rounds`."""
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


def measure(effort: Effort) -> Section:
    """Compare one process with several."""
    rows: list[tuple[Cell, ...]] = []
    alone = 0.0
    for count in PROCESSES:
        if count > (os.cpu_count() or 1):
            continue
        seconds = together(count, effort.repeats)
        alone = alone or seconds
        rows.append((count, 1e3 * seconds, count * alone / seconds, alone / seconds))
    table = Table(
        f"Processes side by side, {MIDDLE.name}",
        ("processes", "until all are done ms", "times the work of one", "efficiency"),
        tuple(rows),
        ("Wall time, the best of several rounds; other users of the machine count against it.",),
    )
    return Section("parallel", (table,))
