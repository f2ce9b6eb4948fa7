"""Solve many models in parallel, each once.

Results are kept on disk.

A job is a case, changes to it and a kind of reading. Its numbers stand in a file named by the hash of the
resolved model; a run's own result file lies in the same folder. Both belong to the code of the solver, whose hash names
their folder: after a change of the physics everything is computed anew. Jobs go through the director that works
through studies, too.
"""

from __future__ import annotations

import math
import time
from collections.abc import Sequence
from dataclasses import asdict, dataclass, field, replace
from functools import lru_cache
from importlib.resources import files
from pathlib import Path
from types import TracebackType

from lambda_core.domain.errors import LambdaError, UsageError
from lambda_core.model.resolve import model_hash
from lambda_core.results.reader import Result
from lambda_core.studies.job import Task, resolve_point, work
from lambda_core.studies.memo import Memo
from lambda_core.studies.pool import Processes
from lambda_core.studies.scheduler import Counts, Director, Report
from lambda_syla2026.readings import DYNAMIC, STATIC, Numbers

_DIGITS = 20  # of the hash in names of files
READ_ONCE = {"stability"}  # hundreds of runs: their files go once their numbers are kept
ANCHOR = "anchor"  # no built-in case: each point names its own bearing
_FORMAT = 3  # of the kept numbers; raised when a reading changes its meaning


@dataclass(frozen=True)
class Job:
    """Reading of one model."""

    case: str  # name of a built-in case, or ANCHOR
    changes: tuple[str, ...]  # path=value
    kind: str  # of readings.STATIC or readings.DYNAMIC


@dataclass(frozen=True)
class JobResult:
    """Result of a job.

    `state` is "done", "partial" (a run that has not converged), "failed", "stopped" (somebody asked the run to) or
    "pending" (another process is at work on it); the reason says why. `processor_s` is the time of the processor that
    it took when it was computed; `fresh` says that it was computed by this call.
    """

    state: str
    reason: str
    hash: str
    numbers: Numbers
    file: str = ""
    processor_s: float = 0.0
    fresh: bool = False

    def __getitem__(self, name: str) -> float:
        """Return one number.

        NaN where the job has failed or the reading has none.
        """
        value = None if self.state == "failed" else self.numbers[name]
        return math.nan if value is None else value


@dataclass(frozen=True)
class Assignment:
    """Job and the folder of its results."""

    job: Job
    folder: str


@dataclass(frozen=True)
class Found:
    """Outcome of a job."""

    job: Job
    answer: JobResult

    @property
    def state(self) -> str:
        """The state of the answer."""
        return self.answer.state


def do(assigned: Assignment) -> Found:
    """Do one job, or read what was found before."""
    return Found(assigned.job, _answer(assigned.job, assigned.folder))


def lost(assigned: Assignment, reason: str) -> Found:
    """Return the message about a job whose worker died."""
    return Found(assigned.job, JobResult("failed", reason, "", {}))


def _answer(job: Job, folder: str) -> JobResult:
    started, memo = time.process_time(), Memo(Path(folder) / "points")
    try:
        model = resolve_point(case_text(job.case), job.changes)
        hash_ = model_hash(model)
        name = f"{hash_[:_DIGITS]}-{job.kind.replace(' ', '-')}-{_FORMAT}"
        kept = memo.find(name)
        if kept is not None:
            return JobResult(**kept)
        dynamic = job.kind in DYNAMIC
        answer = _run(job, hash_, folder) if dynamic else JobResult("done", "", hash_, STATIC[job.kind](model))
    except LambdaError as error:
        return JobResult("failed", str(error), "", {})
    answer = replace(answer, processor_s=time.process_time() - started)
    if answer.state not in ("done", "partial"):
        return answer
    read = job.kind in READ_ONCE
    memo.keep(name, asdict(replace(answer, file="") if read else answer))
    if read:
        (Path(folder) / answer.file).unlink()
    return replace(answer, fresh=True)


@lru_cache(maxsize=16)
def case_text(name: str) -> str:
    """Return a built-in case as a file.

    It may also be the case that any bearing is put into.
    """
    from lambda_core.case.case_io import bearing_case
    from lambda_core.case.case_writer import standalone_toml

    if name == ANCHOR:
        return files(__package__).joinpath(f"{ANCHOR}.toml").read_text(encoding="utf-8")
    return standalone_toml(bearing_case(name))


def _run(job: Job, hash_: str, folder: str) -> JobResult:
    outcome = work(Task(0, case_text(job.case), job.changes, "dynamic", (), folder))
    if outcome.state not in ("done", "partial"):
        return JobResult(outcome.state, outcome.reason, hash_, {})
    numbers = DYNAMIC[job.kind](Result(Path(folder) / outcome.file))
    return JobResult(outcome.state, outcome.reason, hash_, numbers, outcome.file)


@dataclass
class JobRunner:
    """Workers and the folder of their results.

    The folder is the store of their director.

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
    failures: list[str] = field(default_factory=list)  # what is not converged, and what has no result
    lost: list[str] = field(default_factory=list)  # of these, what has no result
    answers: dict[Job, JobResult] = field(default_factory=dict)  # everything that was asked for
    _asked: set[Job] = field(default_factory=set)

    def __post_init__(self) -> None:
        from lambda_core.solver.code_files import physics_key

        self._work = self.folder / "work" / physics_key()[:12]
        try:
            self._work.mkdir(parents=True, exist_ok=True)
        except OSError as error:
            raise UsageError(f"cannot write into {self.folder}: {error.strerror}") from None
        self._pool = Processes(self.workers)
        self._director = Director[Assignment, Found](self, self._pool, do, lost, self.report, keep_after=0.0)

    def __enter__(self) -> JobRunner:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._pool.close(stop=kind is not None)

    def all(self, jobs: Sequence[Job]) -> list[JobResult]:
        """Do jobs in parallel and return their answers.

        The answers come in order; equal jobs are done once.

        Raises
        ------
        KeyboardInterrupt
            When somebody asked a run to stop; what was found is kept.
        """
        known = dict.fromkeys(jobs)
        self._asked |= known.keys()
        if not self._director.run(Assignment(job, str(self._work)) for job in known if job not in self.answers):
            raise KeyboardInterrupt
        for job in known:
            answer = self.answers[job]
            if answer.state != "done":
                self.failures.append(f"{job.case} {job.kind}: {answer.state}: {answer.reason}")
            if answer.state == "failed":
                self.lost.append(self.failures[-1])
        return [self.answers[job] for job in jobs]

    def keep(self, outcomes: Sequence[Found]) -> None:
        """Take in what jobs have found."""
        self.answers |= {found.job: found.answer for found in outcomes}

    def counts(self) -> Counts:
        """Return how many jobs are in which state."""
        states = [answer.state for answer in self.answers.values()]
        done, partial, failed = (states.count(name) for name in ("done", "partial", "failed"))
        return Counts(len(self._asked), done, partial, failed, len(self._asked) - done - partial - failed)
