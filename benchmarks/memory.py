"""Measure the memory of a long run."""

from __future__ import annotations

import multiprocessing
import resource
import sys
import tempfile
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path

import numpy as np

from benchmarks.cases import DEFAULT
from benchmarks.tables import Section, Table, Target
from benchmarks.timing import Effort

_MIB = 2.0**20


def resident() -> float:
    """Return the memory of this process [MiB].

    Where the system does not tell, its peak.
    """
    status = Path("/proc/self/statm")
    if status.exists():
        return int(status.read_text().split()[1]) * resource.getpagesize() / _MIB
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    return peak / (_MIB if sys.platform == "darwin" else 1024.0)


def follow(duration: float) -> tuple[list[float], list[float], float]:
    """Run the default case and record memory.

    Return simulated times [s], memory [MiB] at them, and the size of the file [MiB].
    """
    from lambda_core import api
    from lambda_core.runs.progress import Progress

    times: list[float] = []
    held: list[float] = []

    def note(progress: Progress) -> None:
        times.append(progress.time_s)
        held.append(resident())

    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "long.h5"
        api.run(DEFAULT, (f"solver.duration={duration} s",), out=path, progress=note)
        return times, held, path.stat().st_size / _MIB


def measure(effort: Effort) -> Section:
    """Follow a run in a process of its own."""
    duration = float(effort.pick(20, 60))
    with ProcessPoolExecutor(1, mp_context=multiprocessing.get_context("spawn")) as pool:
        times, held, size = pool.submit(follow, duration).result()
    half = len(times) // 2
    growth = float(np.polyfit(times[half:], held[half:], 1)[0]) if len(times) >= 8 else float("nan")
    table = Table(
        f"Memory of a run of {duration:g} s, {DEFAULT}",
        ("at the start MiB", "half-way MiB", "at the end MiB", "growth in the second half MiB/s", "file MiB/s"),
        ((held[0], held[half], held[-1], growth, size / duration),),
        ("Resident memory of the process; growth and file per simulated second.",),
    )
    target = Target("growth of memory per simulated second", "MiB", growth, 1.0)
    return Section("memory", (table,), (target,))
