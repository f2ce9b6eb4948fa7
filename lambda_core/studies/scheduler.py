"""Give jobs to workers and keep their results.

Studies, the reproduction of experiments and the builder's runs all go through it. They differ in what a task is and
does, where outcomes are kept (:class:`Store`), and where tasks are worked on (:mod:`.pool`).
"""

from __future__ import annotations

import time
from collections import deque
from collections.abc import Callable, Iterable, Sequence
from concurrent.futures import FIRST_COMPLETED, CancelledError, Executor, Future, wait
from concurrent.futures.process import BrokenProcessPool
from dataclasses import dataclass
from typing import Generic, Protocol, TypeVar

from pydantic import BaseModel, ConfigDict

from lambda_core.studies.pool import Pool

_KEEP_AFTER = 0.5  # wall time between transactions [s]
_TRIES = 2  # tries of a task, alone, after a worker died on it


class StudyProgress(BaseModel):
    """Progress of a study.

    ``--progress=json`` prints it as one JSON line each.
    """

    model_config = ConfigDict(frozen=True, extra="forbid")

    points: int  # all of the study
    done: int  # with a result, partial ones included
    failed: int
    percent: float
    wall_s: float
    left_s: float | None


Report = Callable[[StudyProgress], None]


@dataclass(frozen=True)
class Counts:
    """Number of points in each state."""

    total: int
    done: int
    partial: int
    failed: int
    pending: int


class Stated(Protocol):
    """Result of a task.

    It is not done where the state is ``stopped``: somebody asked for an end; or ``pending``: it has to wait.
    """

    @property
    def state(self) -> str:
        """State of the task."""


Task_ = TypeVar("Task_")
Outcome_ = TypeVar("Outcome_", bound=Stated)
_Kept = TypeVar("_Kept", contravariant=True)


class Store(Protocol[_Kept]):
    """Store of outcomes."""

    def keep(self, outcomes: Sequence[_Kept]) -> None:
        """Write what became of tasks."""

    def counts(self) -> Counts:
        """Return how far it is."""


class Director(Generic[Task_, Outcome_]):
    """Director of tasks on a pool.

    Outcomes go into the store as they come.

    A worker that dies takes no task with it: what was handed out is done again. Tasks that were in work
    when a process died are tried once more one at a time, so that the one that kills its worker is found, and
    is the only one that fails.

    Parameters
    ----------
    store : Store
        Takes the outcomes.
    pool : Pool
        Where the tasks are worked on.
    work : callable
        Does a task and returns its outcome; for other processes it must be a function of a module.
    lost : callable
        ``lost(task, reason)``: the outcome of a task whose worker died.
    report : callable, optional
        Called with the progress when outcomes were kept.
    keep_after : float
        Wall time between two times of keeping [s].
    """

    def __init__(
        self,
        store: Store[Outcome_],
        pool: Pool,
        work: Callable[[Task_], Outcome_],
        lost: Callable[[Task_, str], Outcome_],
        report: Report | None = None,
        *,
        keep_after: float = _KEEP_AFTER,
    ) -> None:
        self._store, self._pool, self._work, self._lost, self._report = store, pool, work, lost, report
        self._keep_after = keep_after
        self._executor: Executor | None = None
        self._waiting: deque[Task_] = deque()
        self._running: dict[Future[Outcome_], Task_] = {}
        self._fresh: list[Outcome_] = []
        self._kept = self._started = time.monotonic()
        self._finished = 0
        self._stopped = False

    def run(self, tasks: Iterable[Task_]) -> bool:
        """Do all tasks.

        Return False when somebody asked one of them to stop.
        """
        self._stopped = False
        self.add(tasks)
        try:
            while self._waiting or self._running:
                self.step(_KEEP_AFTER)
                if self._stopped:
                    return False
        finally:
            self._keep(now=True)
        return True

    def one(self, task: Task_) -> Outcome_:
        """Do one task and return its outcome.

        Searches need the outcome before they go on.
        """
        try:
            outcome = self._submit(task).result()
        except BrokenProcessPool:
            outcome = self._again(task)
        self._take(outcome)
        self._keep(now=True)
        return outcome

    def add(self, tasks: Iterable[Task_]) -> None:
        """Put tasks behind those that wait."""
        self._waiting.extend(tasks)

    def hand_out(self, task: Task_) -> None:
        """Hand a task to the workers before all that wait."""
        self._running[self._submit(task)] = task

    def step(self, patience: float = 0.0) -> bool:
        """Submit tasks and take results.

        It submits as many as the workers have room for, and takes results within a time.

        Parameters
        ----------
        patience : float
            How long to wait for the first outcome [s].

        Returns
        -------
        bool
            Whether anything has changed.
        """
        changed = False
        while self._waiting and len(self._running) < self._pool.room:
            self.hand_out(self._waiting.popleft())
            changed = True
        self._pool.watch()
        ready, _ = wait(self._running, timeout=patience, return_when=FIRST_COMPLETED)
        broken = False
        for future in ready:
            try:
                outcome = future.result()
            except (BrokenProcessPool, CancelledError):
                broken = True
                continue
            except Exception as error:  # the executor gave up: dask after several lost workers
                outcome = self._lost(self._running[future], f"{type(error).__name__}: {error}")
            del self._running[future]
            self._take(outcome)
        if broken:
            self._alone()
        self._keep()
        return changed or bool(ready)

    def _submit(self, task: Task_) -> Future[Outcome_]:
        if self._executor is None:
            self._executor = self._pool.open()
        try:
            return self._executor.submit(self._work, task)
        except BrokenProcessPool:
            self._executor = self._pool.open()
            return self._executor.submit(self._work, task)

    def _alone(self) -> None:
        """Do tasks one at a time.

        They were submitted when the workers died: only the guilty one breaks them again.
        """
        tasks = list(self._running.values())
        self._running.clear()
        for task in tasks:
            self._take(self._again(task))
            self._keep()

    def _again(self, task: Task_) -> Outcome_:
        for _ in range(_TRIES):
            try:
                return self._submit(task).result()
            except BrokenProcessPool:
                self._executor = None
        return self._lost(task, "the worker process died on this point (killed, or out of memory)")

    def _take(self, outcome: Outcome_) -> None:
        self._fresh.append(outcome)
        is_stopped = outcome.state == "stopped"
        self._finished += not is_stopped and outcome.state != "pending"
        self._stopped = self._stopped or is_stopped

    def _keep(self, *, now: bool = False) -> None:
        """Keep outcomes every half second with progress."""
        clock = time.monotonic()
        if not now and (clock - self._kept < self._keep_after or not (self._fresh or self._report)):
            return
        self._kept = clock
        if self._fresh:
            self._store.keep(self._fresh)
            self._fresh = []
        if self._report is not None:
            self._report(self._progress(clock - self._started))

    def _progress(self, wall: float) -> StudyProgress:
        counts = self._store.counts()
        left = counts.pending * wall / self._finished if self._finished else None
        return StudyProgress(
            points=counts.total,
            done=counts.done + counts.partial,
            failed=counts.failed,
            percent=100.0 * (counts.total - counts.pending) / max(counts.total, 1),
            wall_s=wall,
            left_s=left,
        )
