"""Take times as minima over repeats."""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass

CLOCKS: dict[str, Callable[[], float]] = {"wall": time.perf_counter, "cpu": time.thread_time}
_clock = CLOCKS["wall"]


def use_clock(name: str) -> None:
    """Choose the clock of single-threaded measurements.

    "wall", or "cpu", the processor time of the thread.

    On a machine that others use, processor time leaves out the time spent waiting for a core; slowdowns by shared
    caches and frequency stay in it. On a quiet machine the two agree.
    """
    global _clock
    _clock = CLOCKS[name]


def now() -> float:
    """Return the reading of the chosen clock [s]."""
    return _clock()


@dataclass(frozen=True)
class Effort:
    """Extent of the measurements."""

    quick: bool

    @property
    def repeats(self) -> int:
        """Return how often the same work is timed."""
        return 2 if self.quick else 3

    def pick(self, quick: int, full: int) -> int:
        """Return one of two amounts."""
        return quick if self.quick else full


def best(work: Callable[[], object], repeats: int) -> float:
    """Return the shortest time of `work` [s]."""
    found = []
    for _ in range(repeats):
        start = now()
        work()
        found.append(now() - start)
    return min(found)


def per_call(loop: Callable[[int], object], seconds: float = 4e-3, repeats: int = 9) -> float:
    """Return the shortest mean time of one call [s].

    Parameters
    ----------
    loop : callable
        Takes a number of calls and makes them, without Python in between.
    seconds : float
        About how long one repeat takes.
    """
    count = 4
    while True:
        start = now()
        loop(count)
        spent = now() - start
        if spent > 0.3 * seconds or count > 10_000_000:
            break
        count *= 4
    count = max(1, int(count * seconds / max(spent, 1e-9)))
    return best(lambda: loop(count), repeats) / count


def sum_of_minima(repeats: Sequence[Sequence[float]]) -> float:
    """Return the time of pieces of work [s].

    Of each piece its shortest repeat, added up.

    Where the repeats do exactly the same, as a deterministic integration does, a disturbance of one piece in one
    repeat is left out without throwing the rest of that repeat away.
    """
    total: float = sum(min(pieces) for pieces in zip(*repeats, strict=True))
    return total
