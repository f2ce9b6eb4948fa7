"""Solve the rows of a fit."""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from concurrent.futures import BrokenExecutor, Future, as_completed
from dataclasses import dataclass, replace
from functools import lru_cache
from typing import TYPE_CHECKING, NamedTuple

from pydantic import BaseModel, ConfigDict

from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.blas_threads import one_blas_thread
from lambda_core.domain.errors import LambdaError, SolverError
from lambda_core.domain.log_sentences import SOLVER, gathered

if TYPE_CHECKING:
    from lambda_core.analysis.band.graded import Graded
    from lambda_core.fitting.subjects import Subject
    from lambda_core.studies.pool import Processes

FEW = 48  # rows for which no process is started: starting takes as long as ten of them
_CHUNK = 16  # rows that a process solves between two reports
_USUAL_PASSES = 8.0  # over all rows by a parameter: slopes and values of two or three rounds
_TELL_AFTER = 0.2  # [s]


class FitProgress(BaseModel):
    """Progress of a fit.

    ``--progress=json`` prints it as one JSON line each.
    """

    model_config = ConfigDict(frozen=True, extra="forbid")

    solved: int  # operating points, of every set of values that was tried
    error_pct: float | None  # of the best values so far
    percent: float | None  # of the points that a fit takes as a rule; None where it takes more
    wall_s: float
    left_s: float | None  # by that rule; None where it does not hold


class Solved(NamedTuple):
    """Quantities at an operating point.

    `values` has the shape (positions of the balls, names); `doubts` are sentences of the solver.
    """

    values: FloatArray
    doubts: tuple[str, ...] = ()


class Asked(NamedTuple):
    """Operating point with the quantities asked for."""

    changes: tuple[str, ...]
    names: tuple[str, ...]


@dataclass(frozen=True)
class _Chunk:
    """Rows with one set of parameters, picklable."""

    case_toml: str
    bearing: str | None
    guests: bytes
    parameters: tuple[tuple[Graded, float], ...]
    asked: tuple[Asked, ...]
    one: bool


class Rows:
    """Predictions of a subject at many operating points.

    A process keeps the rows that it has solved once: it finds them again from their equilibria.

    Parameters
    ----------
    subject : Subject
        What is solved.
    workers : int
        Processes; 1 for this one.
    """

    def __init__(self, subject: Subject, workers: int = 1) -> None:
        self._subject, self._workers = subject, workers
        self._pools: list[Processes] = []
        self._owners: dict[tuple[str, ...], int] = {}
        self.heard: Callable[[int], None] = lambda count: None

    def solve(
        self, parameters: Sequence[tuple[Graded, float]], asked: Sequence[Asked], *, one: bool
    ) -> list[Solved | LambdaError]:
        """Return predictions or errors, row by row.

        In this process it ends with the first mistake of the case; rows without a solution are no mistakes.
        """
        if self._workers > 1 and len(asked) > FEW:
            try:
                return self._spread(parameters, asked, one=one)
            except BrokenExecutor:  # a process was killed: what it did is done here
                self._workers = 1
                self.close()
            except BaseException:
                self.close()
                raise
        found: list[Solved | LambdaError] = []
        for row in asked:
            found.append(_row(self._subject, parameters, row, one=one))
            if isinstance(found[-1], LambdaError) and not isinstance(found[-1], SolverError):
                return found
            self.heard(1)
        return found

    def close(self) -> None:
        """End the processes."""
        pools, self._pools = self._pools, []
        for pool in pools:
            pool.close(stop=True)

    def _spread(
        self, parameters: Sequence[tuple[Graded, float]], asked: Sequence[Asked], *, one: bool
    ) -> list[Solved | LambdaError]:
        from lambda_core.discovery.api import guests
        from lambda_core.studies.pool import Processes

        if not self._pools:
            # one pool for each process: a row goes to the one that has solved it before
            self._pools = [Processes(1) for _ in range(self._workers)]
            self._executors = [pool.open() for pool in self._pools]
        shares: list[list[int]] = [[] for _ in self._pools]
        for number, row in enumerate(asked):
            shares[self._owners.setdefault(row.changes, len(self._owners) % self._workers)].append(number)
        plain = tuple((replace(graded, models=()), number) for graded, number in parameters)
        found: list[Solved | LambdaError | None] = [None] * len(asked)
        running: dict[Future[list[Solved | LambdaError]], list[int]] = {}
        text, bearing, plugins = self._subject.case_toml, self._subject.bearing, guests()
        for executor, share in zip(self._executors, shares, strict=True):
            for begin in range(0, len(share), _CHUNK):
                part = share[begin : begin + _CHUNK]
                rows = tuple(asked[number] for number in part)
                running[executor.submit(_solved, _Chunk(text, bearing, plugins, plain, rows, one))] = part
        for future in as_completed(running):
            for number, answer in zip(running[future], future.result(), strict=True):
                found[number] = answer
            self.heard(len(running[future]))
        return [answer for answer in found if answer is not None]


class Watch:
    """Estimates the time left of a fit.

    A fit ends when its values settle, and nobody knows when: the estimate is what fits take as a rule. A fit that takes
    longer has none.

    Parameters
    ----------
    rows, parameters : int
        Of the fit.
    tell : callable
        Takes the progress.
    """

    def __init__(self, rows: int, parameters: int, tell: Callable[[FitProgress], None]) -> None:
        self._usual = rows * (1.0 + _USUAL_PASSES * parameters)
        self._rows, self._tell, self._begin = rows, tell, time.monotonic()
        self._solved, self._first, self._told = 0, 0.0, 0.0
        self.error_pct: float | None = None

    def heard(self, count: int) -> None:
        """Take points that were solved."""
        self._solved += count
        wall, is_usual = time.monotonic() - self._begin, self._solved < self._usual
        if self._solved <= self._rows:
            self._first = wall
        if wall - self._told < _TELL_AFTER:
            return
        self._told = wall
        # the first pass over all rows takes longer than those that begin from it
        later = self._solved - self._rows
        left = (wall - self._first) / later * (self._usual - self._solved) if later > 0 and is_usual else None
        self._tell(
            FitProgress(
                solved=self._solved,
                error_pct=self.error_pct,
                percent=100.0 * self._solved / self._usual if is_usual else None,
                wall_s=wall,
                left_s=left,
            )
        )


@one_blas_thread()
def _solved(chunk: _Chunk) -> list[Solved | LambdaError]:
    """Solve rows in a worker process.

    An error stands in the place of its row.
    """
    subject = _subject(chunk.case_toml, chunk.bearing, chunk.guests)
    return [_row(subject, chunk.parameters, row, one=chunk.one) for row in chunk.asked]


def _row(
    subject: Subject, parameters: Sequence[tuple[Graded, float]], row: Asked, *, one: bool
) -> Solved | LambdaError:
    """Solve one row; an error stands in its place."""
    with gathered(SOLVER) as doubts:
        try:
            values = subject.solved(row.changes, parameters, row.names, one=one)
        except LambdaError as error:
            return error
    return Solved(values, tuple(dict.fromkeys(doubts)))


@lru_cache(maxsize=1)
def _subject(case_toml: str, bearing: str | None, guests: bytes) -> Subject:
    """Return the subject of this process."""
    from lambda_core.case.case_io import toml_tables
    from lambda_core.discovery.api import as_guests_of
    from lambda_core.fitting.subjects import subject_of

    as_guests_of(guests)
    return subject_of(toml_tables(case_toml, "the case of the fit"), bearing=bearing)
