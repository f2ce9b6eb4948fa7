"""Answer questions about temperatures of bearings and machines."""

from __future__ import annotations

from typing import TYPE_CHECKING

from lambda_core.domain.blas_threads import one_blas_thread
from lambda_core.domain.errors import UsageError
from lambda_core.domain.lists import listed
from lambda_core.results.answer import answers

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

    from lambda_core.analysis.thermal.report import SteadyTemperatures, TemperaturesOverTime
    from lambda_core.case.case_io import Source
    from lambda_core.model.bearing_model import BearingModel
    from lambda_core.model.machine_model import MachineModel
    from lambda_core.views.chart import ViewData


@answers
@one_blas_thread()
def thermal(
    source: Source | BearingModel | MachineModel,
    overrides: Iterable[str] = (),
    *,
    band: bool = False,
    announce: Callable[[str], None] | None = None,
) -> SteadyTemperatures:
    """Compute the steady temperatures of a bearing or machine.

    Parameters
    ----------
    source : str, Path, mapping, Case, MachineCase, BearingModel or MachineModel
        A case as for :func:`check`: the losses are those of its quasi-static point at t = 0, without a cage, which
        follows the temperatures. Or the result file of a run: the losses are its averages, the cage's among them.
    overrides : iterable of str
        Changes ``path=value`` of a case.
    band : bool
        Also compute the 90 % model band of each temperature, from ranges and published alternatives of conductances and
        from what laws and parameters do to the losses. Of first order, with the loop of temperature and loss.
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
    from lambda_core.analysis.band.model_band import temperature_band
    from lambda_core.analysis.thermal.report import steady_of
    from lambda_core.analysis.thermal.temperatures import loop_of, of_run, run_of

    run = run_of(source)
    if run is not None:
        if listed(overrides, "overrides"):
            raise UsageError("the losses of a run accept no overrides: change its case and run it again")
        (loop, found), origin = of_run(run, announce), f"averages of {run.path}"
    else:
        loop, origin = loop_of(source, overrides, announce), "quasi-static point"
        found = loop.steady()
    answer = steady_of(loop, found, origin)
    return answer.with_band(temperature_band(loop.model_at(found))) if band else answer


@answers
@one_blas_thread()
def warm_up(
    source: Source | BearingModel | MachineModel,
    duration: float,
    overrides: Iterable[str] = (),
    *,
    announce: Callable[[str], None] | None = None,
) -> TemperaturesOverTime:
    """Compute temperatures over time from the start.

    The machine operates throughout as the case says for t = 0.

    Parameters
    ----------
    source, overrides
        As for :func:`thermal`, but for results.
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
    if not duration > 0.0:
        raise UsageError(f"a warm-up takes more than 0 s, not {duration:g} s")
    from lambda_core.analysis.thermal import transient
    from lambda_core.analysis.thermal.report import course_of
    from lambda_core.analysis.thermal.temperatures import loop_of

    loop = loop_of(source, overrides, announce)
    return course_of(loop, transient.warm_up(loop, duration))


def thermal_pictures(found: SteadyTemperatures | TemperaturesOverTime) -> list[ViewData]:
    """Draw temperatures over time, or where the heat goes.

    Parameters
    ----------
    found : SteadyTemperatures or TemperaturesOverTime
        From :func:`thermal` or :func:`warm_up`.

    Returns
    -------
    list of ViewData
        For :func:`draw`.
    """
    from lambda_core.analysis.thermal.charts import pictures

    return pictures(found)
