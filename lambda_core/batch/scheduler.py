"""The director of a study: hands points to workers, keeps what they bring, survives what happens to them."""

from __future__ import annotations

import time
from collections import deque
from collections.abc import Callable, Iterable
from concurrent.futures import FIRST_COMPLETED, CancelledError, Executor, Future, wait
from concurrent.futures.process import BrokenProcessPool

from pydantic import BaseModel, ConfigDict

from lambda_core.batch.job import Outcome, Task, work
from lambda_core.batch.pool import Pool
from lambda_core.batch.store import Manifest

_KEEP_AFTER = 0.5  # wall time between transactions [s]
_AHEAD = 3  # tasks per worker that are handed out
_TRIES = 2  # tries of a point, alone, after a worker died on it


class StudyProgress(BaseModel):
    """Where a study stands; one JSON line each with ``--progress=json``."""

    model_config = ConfigDict(frozen=True, extra="forbid")

    points: int  # all of the study
    done: int  # with a result, partial ones included
    failed: int
    percent: float
    wall_s: float
    left_s: float | None


Report = Callable[[StudyProgress], None]


class Director:
    """Works through tasks on a pool; outcomes go into the manifest as they come.

    A worker that dies takes no point with it: what was handed out is done again. Points that were in work
    when a process died are tried once more one at a time, so that the one that kills its worker is found, and
    is the only one that fails.
    """

    def __init__(self, manifest: Manifest, pool: Pool, report: Report | None = None) -> None:
        self._manifest, self._pool, self._report = manifest, pool, report
        self._executor: Executor | None = None
        self._fresh: list[Outcome] = []
        self._kept = self._started = time.monotonic()
        self._finished = 0

    def run(self, tasks: Iterable[Task]) -> bool:
        """Do all tasks; returns False when somebody asked a run to stop."""
        waiting = deque(tasks)
        running: dict[Future[Outcome], Task] = {}
        stopped = False
        counts = self._manifest.counts()
        self._total, self._before = counts.total, counts
        try:
            while waiting or running:
                while waiting and len(running) < _AHEAD * self._pool.workers:
                    task = waiting.popleft()
                    running[self._submit(task)] = task
                ready, _ = wait(running, timeout=_KEEP_AFTER, return_when=FIRST_COMPLETED)
                lost: list[Task] = []
                for future in ready:
                    task = running.pop(future)
                    try:
                        outcome = future.result()
                    except (BrokenProcessPool, CancelledError):
                        lost.append(task)
                        continue
                    except Exception as error:  # the executor gave up: dask after several lost workers
                        outcome = _lost(task, f"{type(error).__name__}: {error}")
                    stopped = stopped or outcome.state == "stopped"
                    self._take(outcome)
                if lost:
                    lost += running.values()
                    running.clear()
                    self._alone(sorted(lost, key=lambda task: task.number))
                self._keep()
                if stopped:
                    return False
        finally:
            self._keep(now=True)
        return True

    def one(self, task: Task) -> Outcome:
        """Do one task and return its outcome; for searches that need it before they go on."""
        self._total, self._before = self._manifest.counts().total, self._manifest.counts()
        try:
            outcome = self._submit(task).result()
        except BrokenProcessPool:
            outcome = self._again(task)
        self._take(outcome)
        self._keep(now=True)
        return outcome

    def _submit(self, task: Task) -> Future[Outcome]:
        if self._executor is None:
            self._executor = self._pool.open()
        try:
            return self._executor.submit(work, task)
        except BrokenProcessPool:
            self._executor = self._pool.open()
            return self._executor.submit(work, task)

    def _alone(self, tasks: list[Task]) -> None:
        """Do tasks one at a time after the workers died: only the guilty one breaks them again."""
        for task in tasks:
            self._take(self._again(task))
            self._keep()

    def _again(self, task: Task) -> Outcome:
        for _ in range(_TRIES):
            try:
                return self._submit(task).result()
            except BrokenProcessPool:
                self._executor = None
        return _lost(task, "the worker process died on this point (killed, or out of memory)")

    def _take(self, outcome: Outcome) -> None:
        self._fresh.append(outcome)
        self._finished += outcome.state != "stopped"

    def _keep(self, *, now: bool = False) -> None:
        """Write outcomes every half second, and say how far it is."""
        clock = time.monotonic()
        if not now and clock - self._kept < _KEEP_AFTER:
            return
        self._kept = clock
        if self._fresh:
            self._manifest.keep(self._fresh)
            self._fresh = []
        if self._report is not None:
            self._report(self._progress(clock - self._started))

    def _progress(self, wall: float) -> StudyProgress:
        counts = self._manifest.counts()
        left = counts.pending * wall / self._finished if self._finished else None
        return StudyProgress(
            points=counts.total,
            done=counts.done + counts.partial,
            failed=counts.failed,
            percent=100.0 * (counts.total - counts.pending) / max(counts.total, 1),
            wall_s=wall,
            left_s=left,
        )


def _lost(task: Task, reason: str) -> Outcome:
    return Outcome(task.number, "failed", reason, "", {}, "", 0.0)
