"""Temperatures: what a bearing's own losses make of them, steady and over time."""

from __future__ import annotations

from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

from lambda_core.domain.blas_threads import one_blas_thread
from lambda_core.domain.errors import UsageError
from lambda_core.system.checking import model_of, resolve

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Mapping

    from lambda_core.case.case import Case
    from lambda_core.system.bearing import BearingModel
    from lambda_core.thermal.report import SteadyTemperatures, TemperaturesOverTime
    from lambda_core.views.chart import ViewData


@one_blas_thread()
def thermal(
    source: str | Path | Mapping[str, Any] | Case | BearingModel,
    overrides: Iterable[str] = (),
    *,
    announce: Callable[[str], None] | None = None,
) -> SteadyTemperatures:
    """Find the steady temperatures of a bearing and its surroundings under its own losses.

    Parameters
    ----------
    source : str, Path, mapping, Case or BearingModel
        A case as for :func:`check`: the losses are those of its quasi-static point at t = 0, without a cage, which
        follows the temperatures. Or the result file of a run: the losses are its averages, the cage's among them.
    overrides : iterable of str
        Changes ``path=value`` of a case.
    announce : callable, optional
        Called with a sentence before something is compiled.

    Returns
    -------
    SteadyTemperatures
        Temperatures, heat flows, the gain of the torque-temperature loop.

    Raises
    ------
    UsageError
        For overrides of a run, whose losses are what they are.
    CaseError
        With every mistake of the case.
    SolverError
        When there are no steady temperatures: a runaway is named with the gain that caused it.
    """
    from lambda_core.thermal.feedback import BearingLoop
    from lambda_core.thermal.operating import of_run
    from lambda_core.thermal.report import steady_of

    if _is_result(source):
        from lambda_core.case.case_io import parse_case
        from lambda_core.results.reader import Result

        if list(overrides):
            raise UsageError("the losses of a run take no overrides: they are those of its case")
        run = Result(Path(str(source)))
        loop, found = of_run(run, resolve(parse_case(run.case_toml, str(run.path))), announce)
        return steady_of(loop, found, f"averages of {run.path}")
    model = model_of(source, overrides)
    loop = BearingLoop(model, _section(model), announce)
    return steady_of(loop, loop.steady())


@one_blas_thread()
def warm_up(
    source: str | Path | Mapping[str, Any] | Case | BearingModel,
    duration: float,
    overrides: Iterable[str] = (),
    *,
    announce: Callable[[str], None] | None = None,
) -> TemperaturesOverTime:
    """Follow the temperatures of a bearing from the start of its case, at the operation of t = 0.

    Parameters
    ----------
    source, overrides
        As for :func:`check`, or a resolved model.
    duration : float
        How long [s].
    announce : callable, optional
        Called with a sentence before something is compiled.

    Returns
    -------
    TemperaturesOverTime
        Also where a temperature passed ``thermal.limit``: then it ends there and says why.

    Raises
    ------
    UsageError
        When `duration` is not above zero.
    CaseError
        With every mistake of the case; a further node without a heat capacity is one.
    SolverError
        When a point on the way has no equilibrium, with the time reached.
    """
    from lambda_core.thermal.feedback import BearingLoop
    from lambda_core.thermal.report import course_of
    from lambda_core.thermal.transient import warm_up as integrate

    if not duration > 0.0:
        raise UsageError(f"a warm-up takes more than 0 s, not {duration:g} s")
    model = model_of(source, overrides)
    loop = BearingLoop(model, _section(model), announce)
    return course_of(loop, integrate(loop, duration))


def thermal_pictures(found: SteadyTemperatures | TemperaturesOverTime) -> list[ViewData]:
    """Return what there is to see of temperatures: over time, or where the heat goes.

    Parameters
    ----------
    found : SteadyTemperatures or TemperaturesOverTime
        From :func:`thermal` or :func:`warm_up`.

    Returns
    -------
    list of ViewData
        For :func:`draw`.
    """
    from lambda_core.thermal.charts import pictures

    return pictures(found)


def ready_model(
    source: str | Path | Mapping[str, Any] | Case | BearingModel,
    overrides: Iterable[str] = (),
    announce: Callable[[str], None] | None = None,
    *,
    is_static: bool = False,
) -> BearingModel:
    """Return the resolved model of a case as it runs: at its own temperatures, where it wants them computed.

    With `is_static` it is for an equilibrium, which needs no end in time.

    Raises
    ------
    CaseError, SolverError
        With a sentence about the case, or about why there are no steady temperatures.
    """
    model = model_of(source, overrides, is_static=is_static)
    if model.thermal is None:
        return model
    from lambda_core.thermal.operating import at_own_temperatures

    return at_own_temperatures(model, partial(resolve, is_static=is_static), announce)


def _is_result(source: object) -> bool:
    return isinstance(source, str | Path) and Path(source).suffix == ".h5" and Path(source).is_file()


def _section(model: BearingModel) -> Any:
    from lambda_core.case.case_io import parse_case

    return model.thermal or parse_case(model.case_toml, model.name).thermal
