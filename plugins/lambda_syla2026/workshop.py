"""Many models worked on side by side, each once: what is found is kept on disk and not done again.

A job is a case, changes to it and a kind of reading. Its numbers stand in a file named by the hash of the
resolved model; a run's own result file lies beside. Both belong to the code of the solver, whose hash names
their folder: after a change of the physics everything is computed anew.
"""

from __future__ import annotations

import json
import os
import time
from collections.abc import Callable, Sequence
from concurrent.futures import Future, as_completed
from dataclasses import asdict, dataclass, field, replace
from functools import lru_cache
from importlib.resources import files
from pathlib import Path
from types import TracebackType

from lambda_core.batch.job import Task, point_hash, resolve_point, work
from lambda_core.batch.pool import Pool, pool
from lambda_core.batch.scheduler import StudyProgress
from lambda_core.domain.errors import LambdaError, SolverError, UsageError
from lambda_core.results.reader import Result
from lambda_syla2026.readings import DYNAMIC, STATIC, Numbers

_DIGITS = 20  # of the hash in names of files
READ_ONCE = {"stability"}  # hundreds of runs: their files go once their numbers are kept
ANCHOR = "anchor"  # no built-in case: each point names its own bearing
_FORMAT = 3  # of the kept numbers; raised when a reading changes its meaning
Report = Callable[[StudyProgress], None]


@dataclass(frozen=True)
class Job:
    """What is to be read of which model."""

    case: str  # name of a built-in case, or ANCHOR
    changes: tuple[str, ...]  # path=value
    kind: str  # of readings.STATIC or readings.DYNAMIC


@dataclass(frozen=True)
class Answer:
    """What a job has found.

    `state` is "done", "partial" (a run that has not converged) or "failed"; the reason says why. `processor_s` is the
    time of the processor that it took when it was computed; `fresh` says that it was computed by this call.
    """

    state: str
    reason: str
    hash: str
    numbers: Numbers
    file: str = ""
    processor_s: float = 0.0
    fresh: bool = False

    def __getitem__(self, name: str) -> float:
        """Return one number; SolverError where there is none."""
        value = self.numbers.get(name)
        if value is None:
            raise SolverError(f"no {name}: {self.reason or 'not found'}")
        return value


def do(job: Job, folder: str) -> Answer:
    """Do one job in `folder`, or read what was found before."""
    started = time.process_time()
    try:
        model = resolve_point(case_text(job.case), job.changes)
        hash_ = point_hash(model)
        kept = Path(folder) / "points" / f"{hash_[:_DIGITS]}-{job.kind.replace(' ', '-')}-{_FORMAT}.json"
        if kept.exists():
            return Answer(**json.loads(kept.read_text(encoding="utf-8")))
        dynamic = job.kind in DYNAMIC
        answer = _run(job, hash_, folder) if dynamic else Answer("done", "", hash_, STATIC[job.kind](model))
    except LambdaError as error:
        return Answer("failed", str(error), "", {})
    answer = replace(answer, processor_s=time.process_time() - started)
    if answer.state == "failed":
        return answer
    read = job.kind in READ_ONCE
    _keep(kept, replace(answer, file="") if read else answer)
    if read:
        (Path(folder) / answer.file).unlink()
    return replace(answer, fresh=True)


@lru_cache(maxsize=16)
def case_text(name: str) -> str:
    """Return a built-in case as a file of its own, or the one that any bearing is put into."""
    from lambda_core.case.case_io import load_case
    from lambda_core.case.case_writer import standalone_toml

    if name == ANCHOR:
        return files(__package__).joinpath(f"{ANCHOR}.toml").read_text(encoding="utf-8")
    return standalone_toml(load_case(name))


def _run(job: Job, hash_: str, folder: str) -> Answer:
    outcome = work(Task(0, case_text(job.case), job.changes, "dynamic", (), folder))
    if outcome.state in ("failed", "stopped"):
        return Answer("failed", outcome.reason, hash_, {})
    numbers = DYNAMIC[job.kind](Result(Path(folder) / outcome.file))
    return Answer(outcome.state, outcome.reason, hash_, numbers, outcome.file)


def _keep(path: Path, answer: Answer) -> None:
    """Write an answer whole or not at all."""
    path.parent.mkdir(parents=True, exist_ok=True)
    part = path.with_suffix(f".{os.getpid()}")
    part.write_text(json.dumps(asdict(answer), allow_nan=False), encoding="utf-8")
    part.replace(path)


@dataclass
class Workshop:
    """Workers and the folder that keeps what they find.

    Parameters
    ----------
    folder : pathlib.Path
        Of the reproduction; made if needed.
    workers : int
        Processes.
    report : callable, optional
        Called with the progress.
    """

    folder: Path
    workers: int
    report: Report | None = None
    failures: list[str] = field(default_factory=list)
    answers: dict[Job, Answer] = field(default_factory=dict)  # everything that was asked for
    _pool: Pool | None = None
    _total: int = 0
    _done: int = 0
    _started: float = field(default_factory=time.monotonic)

    def __post_init__(self) -> None:
        from lambda_core.laws.kernels import sources_key
        from lambda_core.solver.code_files import physics_sources

        key = sources_key(*physics_sources())
        self._work = self.folder / "work" / key[:12]
        try:
            self._work.mkdir(parents=True, exist_ok=True)
        except OSError as error:
            raise UsageError(f"cannot write into {self.folder}: {error.strerror}") from None

    def __enter__(self) -> Workshop:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        if self._pool is not None:
            self._pool.close(stop=kind is not None)

    def all(self, jobs: Sequence[Job]) -> list[Answer]:
        """Do jobs side by side and return their answers in order; equal jobs are done once."""
        known = dict.fromkeys(jobs)
        if self._pool is None:
            self._pool = pool("processes", self.workers)
            self._executor = self._pool.open()
        self._total += len(known)
        futures: dict[Future[Answer], Job] = {self._executor.submit(do, job, str(self._work)): job for job in known}
        found: dict[Job, Answer] = {}
        for future in as_completed(futures):
            job, answer = futures[future], future.result()
            found[job] = answer
            self._done += 1
            if answer.state != "done":
                self.failures.append(f"{job.case} {job.kind}: {answer.state}: {answer.reason}")
            self._say()
        self.answers |= found
        return [found[job] for job in jobs]

    def _say(self) -> None:
        if self.report is None:
            return
        wall = time.monotonic() - self._started
        left = (self._total - self._done) * wall / self._done
        percent = 100.0 * self._done / self._total
        self.report(
            StudyProgress(points=self._total, done=self._done, failed=0, percent=percent, wall_s=wall, left_s=left)
        )
