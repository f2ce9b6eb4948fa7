"""Provide the public API for shafts in motion."""

from __future__ import annotations

import math
from pathlib import Path
from typing import TYPE_CHECKING

from lambda_core.domain.blas_threads import one_blas_thread

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

    from lambda_core.case.case_io import Source
    from lambda_core.run.progress import Progress
    from lambda_core.run.whole_run import Ends
    from lambda_core.shaft.whole_summary import WholeSummary
    from lambda_core.system.machine import Machine
    from lambda_core.views.chart import ViewData


@one_blas_thread()
def shaft_run(
    source: Source | Machine,
    overrides: Iterable[str] = (),
    *,
    out: str | Path | None = None,
    force: bool = False,
    duration: float | None = None,
    max_wall: float | None = None,
    progress: Callable[[Progress], None] | None = None,
    announce: Callable[[str], None] | None = None,
) -> WholeSummary:
    """Simulate a shaft in its bearings into a folder: one result of the shaft and one for every bearing.

    Parameters
    ----------
    source, overrides
        As for :func:`shaft`.
    out : path-like, optional
        The folder; by default the case's name with ``-run``, numbered where that is taken.
    force : bool
        Overwrite what a run left in `out`.
    duration : float, optional
        Simulated time [s]; by default the case's, or until the friction torque of every bearing is known to 1 % (95 %
        confidence).
    max_wall : float, optional
        Stop after this wall time [s]; by default the case's.
    progress, announce : callable, optional
        Called some ten times a second; with a sentence before what takes a while.

    Returns
    -------
    WholeSummary
        Also of a run that ended early or is not converged: it says so and why.

    Raises
    ------
    CaseError, UsageError, SolverError, PartialResultError
        With a sentence about the case, the folder, the solver (the folder keeps what there is) or the disk.
    """
    from lambda_core.run.whole_run import launch_whole
    from lambda_core.shaft.whole_summary import summarise_whole
    from lambda_core.system.machine import Machine
    from lambda_core.system.resolve_machine import check_shaft

    model = source if isinstance(source, Machine) else check_shaft(source, overrides)
    ends = _ends(model, duration, max_wall or model.solver.max_wall)
    folder = None if out is None else Path(out)
    return summarise_whole(launch_whole(model, folder, ends, force=force, report=progress, announce=announce))


@one_blas_thread()
def shaft_resume(
    folder: str | Path,
    *,
    duration: float | None = None,
    max_wall: float | None = None,
    progress: Callable[[Progress], None] | None = None,
    announce: Callable[[str], None] | None = None,
) -> WholeSummary:
    """Go on with the run of a shaft, bit for bit as if it had not been interrupted.

    Parameters
    ----------
    folder : path-like
        Of a run that was interrupted, killed, or is to be longer.
    duration, max_wall, progress, announce
        As for :func:`shaft_run`.

    Returns
    -------
    WholeSummary

    Raises
    ------
    UsageError
        When there is no run, nothing is left to do, or the case or the code has changed.
    """
    from lambda_core.case.case_io import toml_tables
    from lambda_core.run.whole_run import resume_whole
    from lambda_core.shaft.whole_file import WholeFile
    from lambda_core.shaft.whole_summary import summarise_whole
    from lambda_core.system.resolve_machine import check_shaft

    model = check_shaft(toml_tables(WholeFile(folder).case_toml, str(folder)))
    ends = _ends(model, duration, max_wall or math.inf)
    return summarise_whole(resume_whole(Path(folder), model, ends, report=progress, announce=announce))


def _ends(model: Machine, duration: float | None, max_wall: float) -> Ends:
    """Return when a run ends [s]; UsageError where it has no end, or none that a machine reaches."""
    from lambda_core.domain.errors import UsageError
    from lambda_core.domain.units import show
    from lambda_core.run.whole_run import Ends
    from lambda_core.system.resolve_solver import MOST_TIME

    asked = duration or model.solver.duration
    end = asked or max(bearing.model.solver.max_duration for bearing in model.bearings)
    if not end:
        raise UsageError("where nothing turns a run needs a duration: --duration, or solver.duration in the file")
    if end > MOST_TIME:
        slow = "" if asked else ", 30 turns of a cage; give --duration"
        raise UsageError(f"a duration of {show(end, 'time', 3)}{slow}: at most {show(MOST_TIME, 'time')} are simulated")
    return Ends(asked, max_wall)


def shaft_result(folder: str | Path) -> WholeSummary:
    """Return the summary of the run of a shaft: finished, still growing, or left behind.

    Parameters
    ----------
    folder : path-like
        Of the run.

    Returns
    -------
    WholeSummary

    Raises
    ------
    UsageError
        When there is no run, or it holds no samples yet.
    """
    from lambda_core.shaft.whole_file import WholeFile
    from lambda_core.shaft.whole_summary import summarise_whole

    return summarise_whole(WholeFile(folder))


def shaft_motion_pictures(folder: str | Path) -> list[ViewData]:
    """Return what there is to see of the run of a shaft: orbits, reactions over time.

    Parameters
    ----------
    folder : path-like
        Of the run.

    Returns
    -------
    list of ViewData
    """
    from lambda_core.shaft.whole_charts import motion_pictures
    from lambda_core.shaft.whole_file import WholeFile

    return motion_pictures(WholeFile(folder))


def is_shaft_run(path: str | Path) -> bool:
    """Tell whether a path is the folder of a shaft's run.

    Parameters
    ----------
    path : path-like

    Returns
    -------
    bool
    """
    from lambda_core.shaft.whole_file import is_whole

    return is_whole(path)
