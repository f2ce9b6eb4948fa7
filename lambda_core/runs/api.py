"""Solve, run, resume and cross-check a case."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Literal

from lambda_core.analysis.thermal.temperatures import ready, resolved
from lambda_core.domain.blas_threads import one_blas_thread
from lambda_core.domain.errors import CaseError
from lambda_core.model.api import check
from lambda_core.results.answer import answers
from lambda_core.runs.rerun import rerun
from lambda_core.runs.stored import result

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

    from lambda_core.analysis.rotor.machine_equilibrium import MachineEquilibrium
    from lambda_core.case.case_io import Source
    from lambda_core.model.bearing_model import BearingModel
    from lambda_core.model.machine_model import MachineModel
    from lambda_core.results.quasistatic import QuasiStatic
    from lambda_core.results.reader import Result
    from lambda_core.runs.crosscheck import CrossCheck
    from lambda_core.runs.estimate import Estimate
    from lambda_core.runs.progress import Progress
    from lambda_core.runs.stepping import Stepping
    from lambda_core.runs.warmup import Warmup


@answers
@one_blas_thread()
def quasistatic(
    source: Source | BearingModel | MachineModel,
    overrides: Iterable[str] = (),
    *,
    bearing: str | None = None,
    band: bool = False,
    announce: Callable[[str], None] | None = None,
) -> QuasiStatic | MachineEquilibrium:
    """Solve the quasi-static equilibrium at t = 0.

    It contains loads, angles, films and friction, without time and cage. Of a machine it is that of its elastic shaft
    in its bearings, with housing, preload and gear forces.

    Parameters
    ----------
    source, overrides
        As for :func:`check`, or a resolved model.
    bearing : str, optional
        One of a machine: the answer is about it alone, with the load of every ball.
    band : bool
        Also compute the 90 % model band, see :func:`model_band`; it costs 0.5 s for most bearings, up to 4 s for some.
    announce : callable, optional
        Called with a sentence before something is compiled.

    Returns
    -------
    QuasiStatic or MachineEquilibrium
        Of one bearing with balls or rollers, or of a machine of several; numbers in the units of their names.

    Raises
    ------
    UsageError
        For a bearing that the machine does not have, or a name where there is one bearing without a machine.
    CaseError, SolverError
        With a sentence about the case, or about why there is no equilibrium.
    """
    from lambda_core.analysis.rotor.bearing_alone import bearing_number
    from lambda_core.analysis.static_point import static_point
    from lambda_core.analysis.thermal.temperatures import ready_rollers
    from lambda_core.results.roller_quasistatic import roller_quasistatic
    from lambda_core.runs.law_blame import naming_laws

    try:
        model = ready(source, overrides, announce, is_static=True)
    except CaseError as refused:  # rollers are at rest also under loads with which they do not run
        if bearing is not None or (rollers := ready_rollers(source, overrides, announce, refused=refused)) is None:
            raise
        return roller_quasistatic(rollers[0])
    if bearing is not None:
        bearing_number(model, bearing)  # before anything is solved
    with naming_laws(*model.bearing_models.values()):
        point = static_point(model, announce)
        found = point.summary
        if band:
            from lambda_core.analysis.band.model_band import bands_or_reason

            found = found.with_bands(bands_or_reason(point).bearings)
    return found if bearing is None else found.of_bearing(bearing)


@answers
@one_blas_thread()
def estimate(
    source: Source | BearingModel | MachineModel,
    overrides: Iterable[str] = (),
    *,
    announce: Callable[[str], None] | None = None,
) -> Estimate:
    """Estimate equilibrium, life and processor time of a run.

    Parameters
    ----------
    source, overrides
        As for :func:`check`, or a resolved model.
    announce : callable, optional
        Called with a sentence before something is compiled.

    Returns
    -------
    Estimate
        Of one bearing, or of a machine of several. Numbers that there are none of are None.

    Raises
    ------
    CaseError, SolverError
        With a sentence about the case, or about why there is no equilibrium.
    """
    from lambda_core.runs.estimate import estimate as ask

    return ask(ready(source, overrides, announce), announce)


@one_blas_thread()
def run(
    source: Source | BearingModel | MachineModel,
    overrides: Iterable[str] = (),
    *,
    out: str | Path | None = None,
    overwrite: bool = False,
    band: bool = False,
    progress: Callable[[Progress], None] | None = None,
    announce: Callable[[str], None] | None = None,
) -> Result:
    """Simulate a bearing or a machine into a result file.

    Parameters
    ----------
    source, overrides
        As for :func:`check`, or a resolved model.
    out : path-like, optional
        The result file; by default the case's name with ``.h5``, numbered where that is taken.
    overwrite : bool
        Overwrite `out`.
    band : bool
        Also compute the 90 % model band, see :func:`model_band`; it costs 0.5 s for most bearings, up to 4 s for some.
    progress : callable, optional
        Called some ten times a second.
    announce : callable, optional
        Called with a sentence before something is compiled, and with the equilibrium found.

    Returns
    -------
    Result
        Also of a run that ended early or is not converged: its summary says so and why.

    Raises
    ------
    CaseError, SolverError, PartialResultError
        With a sentence about the case, the solver (the file keeps what there is) or the disk.
    """
    from lambda_core.runs.launch import launch

    path, model = None if out is None else Path(out), ready(source, overrides, announce)
    found = launch(model, path, overwrite=overwrite, band=band, report=progress, announce=announce)
    return found.rerun_by(rerun)


@one_blas_thread()
def iterate(
    source: Source | BearingModel | MachineModel,
    overrides: Iterable[str] = (),
    *,
    interval: float | None = None,
    exact: bool = False,
    couple: Literal["force", "motion"] = "force",
    announce: Callable[[str], None] | None = None,
) -> Stepping:
    """Simulate step by step: ``for step in iterate(case)``.

    For programs that look at every step, or that give the loads on the inner ring or the motion of both rings:
    co-simulation. To a machine they give loads at its markers, loads and gears, and the speed of its shaft.

    Parameters
    ----------
    source, overrides
        As for :func:`check`, or a resolved model.
    interval : float, optional
        Time between steps [s]; default: that of the samples of a run. No step of the integrator is longer.
    exact : bool
        Steps end at the multiples of `interval`, not with the first step of the integrator past them.
    couple : "force" or "motion"
        What comes from outside: loads on the inner ring, or the poses of both rings.
    announce : callable, optional
        Called with a sentence before something is compiled.

    Returns
    -------
    Stepping
        An iterator of steps; ends at ``solver.duration``, or at ``solver.max_duration``.

    Raises
    ------
    CaseError, SolverError, UsageError
        With a sentence about the case, the solver or `interval`.
    """
    from lambda_core.runs.stepping import Stepping
    from lambda_core.solver.drivers.coupling import check_coupling

    model = resolved(source, overrides)
    check_coupling(model, couple)  # temperatures are not worth finding for a case that cannot be coupled so
    return Stepping(ready(model, announce=announce), interval, announce, exact=exact, couple=couple)


@one_blas_thread()
def resume(
    path: str | Path,
    overrides: Iterable[str] = (),
    *,
    progress: Callable[[Progress], None] | None = None,
    announce: Callable[[str], None] | None = None,
) -> Result:
    """Resume an interrupted run, bit for bit.

    A limit of wall time holds for one start: the run goes on without the one that it began with.

    Parameters
    ----------
    path : path-like
        Result file of a run that was interrupted, killed, or is to be longer.
    overrides : iterable of str
        ``solver.duration=...``, ``solver.max_duration=...`` or ``solver.max_wall=...``; anything else
        would be another run.
    progress, announce
        As for :func:`run`.

    Returns
    -------
    Result
        As from :func:`run`.

    Raises
    ------
    CaseError
        When its laws or data are not here any more, with the packages and files that had them.
    UsageError
        When the file is no result, nothing is left to do, or the case or the code has changed.
    """
    from lambda_core.domain.errors import Problem
    from lambda_core.domain.installed import OWN, project_of
    from lambda_core.runs.launch import relaunch

    found = result(path)
    try:
        model = _stored_model(found, overrides)
    except CaseError as error:
        others = [name for name in found.plugins if project_of(name) != OWN]
        if not others:
            raise
        raise CaseError(
            error.source, [*error.problems, Problem("", f"its laws came from {', '.join(others)}")]
        ) from None
    return relaunch(found.path, model, report=progress, announce=announce).rerun_by(rerun)


def _stored_model(found: Result, overrides: Iterable[str]) -> BearingModel | MachineModel:
    """Return the model of the case in a result.

    It has no limit of wall time, though the run may have begun with one.
    """
    from lambda_core.case.case_io import toml_tables

    tables = toml_tables(found.case_toml, str(found.path))
    if "solver" in tables:
        tables["solver"].pop("max_wall", None)
    return check(tables, overrides)


@answers
@one_blas_thread()
def cross_check(
    source: Source | BearingModel | MachineModel,
    overrides: Iterable[str] = (),
    *,
    free_cage: bool = False,
    bearing: str | None = None,
    announce: Callable[[str], None] | None = None,
) -> CrossCheck:
    """Integrate a case also with SUNDIALS CVODE and compare.

    It needs the extra ``sundials``.

    Parameters
    ----------
    source, overrides
        As for :func:`check`, or a resolved model.
    free_cage : bool
        Leave cages free and compare mean powers; otherwise they follow their kinematic paths, where single
        trajectories can be compared.
    bearing : str, optional
        One of a machine: alone, under the constant load that it carries there at t = 0; default: the machine, all
        bearings moving with its shaft.
    announce : callable, optional
        Called with a sentence before something is compiled.

    Returns
    -------
    CrossCheck
        Dissipated powers, how far the states are apart, and whether the two agree.

    Raises
    ------
    UsageError
        When scikit-sundae is not installed.
    CaseError, SolverError
        With a sentence about the case, or about which integrator could not go on.
    """
    from lambda_core.runs.crosscheck import cross_check as ask

    model = ready(source, overrides, announce)
    if bearing is not None:
        from lambda_core.analysis.rotor.bearing_alone import bearing_alone

        model = bearing_alone(model, bearing, announce)
    return ask(model, free_cage=free_cage, announce=announce)


def warmup(*, announce: Callable[[str], None] | None = None) -> Warmup:
    """Compile the solver and all laws before a run.

    Parameters
    ----------
    announce : callable, optional
        Called with a sentence before something is compiled.

    Returns
    -------
    Warmup
        What was compiled now, what was there, and the laws that cannot be compiled.
    """
    from lambda_core.discovery.api import registry
    from lambda_core.runs.warmup import warmup as compile_all

    return compile_all(registry(), announce)
