"""Answer questions about temperatures of bearings and machines."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from lambda_core.case.case_io import is_machine
from lambda_core.domain.blas_threads import one_blas_thread
from lambda_core.domain.errors import UsageError
from lambda_core.domain.lists import listed
from lambda_core.results.answer import answers

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

    from lambda_core.analysis.thermal.feedback import Steady
    from lambda_core.analysis.thermal.machine_temperatures import MachineLoop
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
    from lambda_core.analysis.thermal.temperatures import run_of, steady_temperatures

    if is_machine(source):
        loop = _loop(source, overrides, announce)
        return _of_machine(loop, loop.steady(), "quasi-static point", band=band)

    run = run_of(source)
    if run is not None and listed(overrides, "overrides"):
        raise UsageError("the losses of a run accept no overrides: change its case and run it again")
    if run is not None and run.is_machine:
        from lambda_core.analysis.thermal.machine_temperatures import of_run

        return _of_machine(*of_run(run, announce), f"averages of {run.path}", band=band)
    answer, warm = steady_temperatures(source, overrides, announce)  # type: ignore[arg-type]
    return answer.with_band(temperature_band(warm())) if band else answer


def _of_machine(loop: MachineLoop, found: Steady, origin: str, *, band: bool) -> SteadyTemperatures:
    from lambda_core.analysis.band.model_band import temperature_band
    from lambda_core.analysis.thermal.machine_temperatures import machine_at_temperatures
    from lambda_core.analysis.thermal.report import steady_of

    answer = steady_of(loop, found, origin)
    return answer.with_band(temperature_band(machine_at_temperatures(loop, found))) if band else answer


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
    if is_machine(source):
        from lambda_core.analysis.thermal.report import course_of
        from lambda_core.analysis.thermal.transient import warm_up_machine

        loop = _loop(source, overrides, announce)
        return course_of(loop, warm_up_machine(loop, duration))
    from lambda_core.analysis.thermal.temperatures import temperatures_over_time

    return temperatures_over_time(source, duration, overrides, announce)  # type: ignore[arg-type]


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


def _loop(source: Any, overrides: Iterable[str], announce: Callable[[str], None] | None) -> MachineLoop:
    from lambda_core.analysis.rotor.api import machine_of
    from lambda_core.analysis.thermal.machine_temperatures import MachineLoop, without_temperatures

    return MachineLoop(without_temperatures(machine_of(source, overrides)), announce)
