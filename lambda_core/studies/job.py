"""Compute one point of a study in a worker.

A task is plain data; kernels, catalogue and base case are kept by the process for the next task.
"""

from __future__ import annotations

import logging
import multiprocessing
import time
from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal, cast

from lambda_core.domain.blas_threads import one_blas_thread
from lambda_core.domain.errors import LambdaError
from lambda_core.domain.plugin_errors import failures_so_far

if TYPE_CHECKING:
    from lambda_core.analysis.static_point import StaticPoint
    from lambda_core.catalogue.protocol import Catalogue
    from lambda_core.model.bearing_model import BearingModel
    from lambda_core.model.machine_model import MachineModel
    from lambda_core.results.reader import Result
    from lambda_core.solver.drivers.compiled_laws import Announce, Kernels
    from lambda_core.solver.drivers.machine_statics import SharedKernels

RUNS = "runs"
State = Literal["done", "partial", "failed", "stopped", "pending"]
log = logging.getLogger("lambda_core")
# Of a worker process: the request went to the run that it had in hand; tasks that wait behind it are not begun.
_asked_to_stop = False
_HASH_DIGITS = 20  # of the hash in the name of a result file
_PATIENCE = 10.0  # with another process that writes the result of a point [s]
_LOOK_AFTER = 0.05  # [s]


@dataclass(frozen=True)
class Task:
    """Inputs of one point, picklable."""

    number: int
    case_toml: str
    changes: tuple[str, ...]
    mode: Literal["quasi-static", "dynamic"]
    responses: tuple[str, ...]
    folder: str  # of the study, on a file system that all workers see (dynamic)
    guests: bytes = b""  # plugin files and laws of the director that no package installs


@dataclass(frozen=True)
class Outcome:
    """Outcome of a point.

    `state` is ``done``; ``partial``: a run whose averages have not converged, or a point at which a method of a plugin
    failed; ``failed``: with the reason; ``stopped``: somebody asked the run to stop, it goes on next time;
    ``pending``: another process is at work on it, it is done next time.
    """

    number: int
    state: State
    reason: str
    hash: str
    values: Mapping[str, float | None]
    file: str
    seconds: float


@one_blas_thread()
def work(task: Task) -> Outcome:
    """Do one task.

    It never raises for an error of the point.
    """
    global _asked_to_stop
    start = time.perf_counter()
    hash_, state, reason, values, file = "", "failed", "", {}, ""
    if _asked_to_stop:
        return Outcome(task.number, "stopped", "the worker was asked to stop", "", {}, "", 0.0)
    from lambda_core.analysis.thermal.temperatures import ready
    from lambda_core.model.resolve import model_hash

    failed = len(failures_so_far())
    try:
        _be_ready(task.guests)
        model = point_model(task.case_toml, task.changes)
        hash_ = model_hash(model)
        model = ready(model)
        if task.mode == "quasi-static":
            state, values = "done", static_values(model, task.responses)
        else:
            file = f"{RUNS}/{hash_[:_HASH_DIGITS]}.h5"
            state, reason, values = _dynamic(model, Path(task.folder) / file, task.responses)
    except LambdaError as error:
        reason = str(error)
    except Exception as error:  # a bug, or a law that breaks in a way nobody foresaw: the other points go on
        reason = f"unexpected {type(error).__name__}: {' '.join(str(error).split())}"
    if state == "done" and (told := failures_so_far()[failed:]):
        state, reason = "partial", "; ".join(dict.fromkeys(told))  # of a plugin; what others answered is kept
    _asked_to_stop = state == "stopped" and multiprocessing.parent_process() is not None
    return Outcome(task.number, state, reason, hash_, values, file, time.perf_counter() - start)  # type: ignore[arg-type]


@lru_cache(maxsize=1)
def _be_ready(guests: bytes) -> None:
    """Take the plugins of the director, once."""
    from lambda_core.discovery.api import as_guests_of

    as_guests_of(guests)


def lost(task: Task, reason: str) -> Outcome:
    """Return the outcome of a task whose worker died."""
    return Outcome(task.number, "failed", reason, "", {}, "", 0.0)


def point_model(case_toml: str, changes: tuple[str, ...], *, is_static: bool = False) -> BearingModel | MachineModel:
    """Return the model of one point.

    The model is one of a bearing or a machine. All problems make one CaseError. With `is_static` it is for an
    equilibrium, which needs no end in time.
    """
    from lambda_core.model.api import check

    return check(_tables(case_toml), changes, catalogue=_catalogue(), is_static=is_static)


def resolve_point(case_toml: str, changes: tuple[str, ...], *, is_static: bool = False) -> BearingModel:
    """Return a point of a one-bearing case as :func:`point_model`."""
    return cast("BearingModel", point_model(case_toml, changes, is_static=is_static))


@lru_cache(maxsize=4)
def _tables(case_toml: str) -> dict[str, Any]:
    from lambda_core.case.case_io import toml_tables

    return toml_tables(case_toml, "the case of the study")


@lru_cache(maxsize=1)
def _catalogue() -> Catalogue:
    from lambda_core.discovery.api import registry

    return registry().catalogue()


@lru_cache(maxsize=1)
def shared_kernels() -> SharedKernels:
    """Return the compiled laws of this process.

    Equal choices of laws are compiled only once.
    """
    from lambda_core.solver.drivers.machine_statics import SharedKernels

    return SharedKernels()


def kernels_of(model: BearingModel) -> Kernels:
    """Return the compiled laws of a bearing in this process."""
    return shared_kernels().of(model)


def solved_point(model: BearingModel | MachineModel, announce: Announce = None) -> StaticPoint:
    """Return the operating point of a model.

    It uses the compiled laws of this process.
    """
    from lambda_core.analysis.static_point import static_point

    return static_point(model, announce, shared_kernels())


def static_values(model: BearingModel | MachineModel, names: tuple[str, ...]) -> dict[str, float | None]:
    """Return the responses of a quasi-static point.

    Raises
    ------
    SolverError
        When there is no solution.
    """
    return values_of(solved_point(model), model, names)


def values_of(
    point: StaticPoint, model: BearingModel | MachineModel, names: tuple[str, ...]
) -> dict[str, float | None]:
    """Return the responses of a solved point.

    UsageError for a row of a comparison method that does not exist.
    """
    from lambda_core.studies.method_columns import method_columns
    from lambda_core.studies.responses import evaluate, responses_of

    rows = {name: value for name, (value, _, _) in method_columns(point, names).items()}
    return evaluate(names, point, rows, responses_of(model))


def _dynamic(
    model: BearingModel | MachineModel, path: Path, names: tuple[str, ...]
) -> tuple[State, str, dict[str, float | None]]:
    """Run a point and read its responses.

    It goes on with an existing part of the run.
    """
    from lambda_core.results.opening import BeingWrittenError
    from lambda_core.studies.points import DynamicPoint
    from lambda_core.studies.responses import evaluate, method_rows_among, responses_of

    try:
        result = _run(model, path)
    except BeingWrittenError as error:
        return "pending", str(error), {}
    status = result.status()
    if status.state == "interrupted":
        return "stopped", status.message, {}
    summary = result.summary()
    known = responses_of(model)
    rows = method_rows_among(names, known)
    methods = static_values(model, rows) if rows else {}
    values = evaluate(names, DynamicPoint(result, summary), methods, known)
    return ("done", "", values) if summary.converged else ("partial", "; ".join(summary.reasons), values)


def _run(model: BearingModel | MachineModel, path: Path) -> Result:
    from lambda_core.results.opening import BeingWrittenError, ResultError
    from lambda_core.results.reader import Result
    from lambda_core.runs.launch import launch, relaunch
    from lambda_core.runs.loop import NothingLeftError

    path.parent.mkdir(parents=True, exist_ok=True)
    if path.exists():
        try:
            before = _left_by_others(Result(path))
            if before.status().state in ("finished", "stopped"):
                return before
            if before.status().state != "failed":
                return relaunch(path, model)
        except NothingLeftError:  # another process has brought it to its end since
            return Result(path)
        except BeingWrittenError:
            raise
        except ResultError:  # damaged, or of another program: begun anew
            pass
    return launch(model, path, overwrite=True)


def _left_by_others(result: Result) -> Result:
    """Return a result that no process writes.

    A worker outlives its director for a moment.
    """
    from lambda_core.results.opening import BeingWrittenError

    end = time.monotonic() + _PATIENCE
    is_told = False
    while (status := result.status()).alive():
        writing = BeingWrittenError(result.path, status.process["pid"])
        if time.monotonic() >= end:
            raise writing
        if not is_told:
            log.warning("%s: waiting up to %g s for it to end", writing, _PATIENCE)
            is_told = True
        time.sleep(_LOOK_AFTER)
    return result
