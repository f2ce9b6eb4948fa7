"""Find temperatures of one bearing under its losses."""

from __future__ import annotations

from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

from lambda_core.analysis.rotor.api import machine_of
from lambda_core.case.case_io import is_machine
from lambda_core.model.checking import model_of, resolve

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

    from lambda_core.analysis.thermal.report import SteadyTemperatures, TemperaturesOverTime
    from lambda_core.case.case_io import Source
    from lambda_core.model.bearing_model import BearingModel
    from lambda_core.model.machine_model import MachineModel
    from lambda_core.model.roller_case import RollerModel
    from lambda_core.results.reader import Result


def steady_temperatures(
    source: Source | BearingModel,
    overrides: Iterable[str] = (),
    announce: Callable[[str], None] | None = None,
) -> tuple[SteadyTemperatures, Callable[[], BearingModel]]:
    """Find the steady temperatures of one bearing.

    See :func:`~.api.thermal`; also return its model there.
    """
    from lambda_core.analysis.thermal.feedback import BearingLoop
    from lambda_core.analysis.thermal.operating import at_temperatures, of_run
    from lambda_core.analysis.thermal.report import steady_of

    run = run_of(source)
    if run is not None:
        from lambda_core.case.case_io import parse_case

        loop, found = of_run(run, resolve(parse_case(run.case_toml, str(run.path))), announce)
        origin = f"averages of {run.path}"
    else:
        model = model_of(source, overrides)
        loop = BearingLoop(model, _section(model), announce)
        found, origin = loop.steady(), "quasi-static point"
    return steady_of(loop, found, origin), partial(at_temperatures, loop, found, partial(resolve, is_static=True))


def temperatures_over_time(
    source: Source | BearingModel,
    duration: float,
    overrides: Iterable[str] = (),
    announce: Callable[[str], None] | None = None,
) -> TemperaturesOverTime:
    """Follow the temperatures of one bearing; see :func:`lambda_core.api.warm_up`."""
    from lambda_core.analysis.thermal.feedback import BearingLoop
    from lambda_core.analysis.thermal.report import course_of
    from lambda_core.analysis.thermal.transient import warm_up

    model = model_of(source, overrides)
    loop = BearingLoop(model, _section(model), announce)
    return course_of(loop, warm_up(loop, duration))


def resolved(
    source: Source | BearingModel | MachineModel, overrides: Iterable[str] = ()
) -> BearingModel | MachineModel:
    """Return the model of a case before temperatures are computed."""
    if is_machine(source):
        return machine_of(source, overrides)  # type: ignore[arg-type]
    return model_of(source, overrides)  # type: ignore[arg-type]


def ready(
    source: Source | BearingModel | MachineModel,
    overrides: Iterable[str] = (),
    announce: Callable[[str], None] | None = None,
) -> BearingModel | MachineModel:
    """Return the model of a bearing or a machine.

    It has its own temperatures where the case wants them computed.
    """
    if is_machine(source):
        from lambda_core.analysis.thermal.machine_temperatures import ready_machine_of

        return ready_machine_of(source, overrides, announce)  # type: ignore[arg-type]
    return ready_model(source, overrides, announce)  # type: ignore[arg-type]


def ready_model(
    source: Source | BearingModel,
    overrides: Iterable[str] = (),
    announce: Callable[[str], None] | None = None,
    *,
    is_static: bool = False,
) -> BearingModel:
    """Return the resolved model of a case.

    It has its own temperatures where the case wants them computed.

    With `is_static` it is for an equilibrium, which needs no end in time.

    Raises
    ------
    CaseError, SolverError
        With a sentence about the case, or about why there are no steady temperatures.
    """
    model = model_of(source, overrides, is_static=is_static)
    if model.thermal is None:
        return model
    from lambda_core.analysis.thermal.operating import at_own_temperatures

    return at_own_temperatures(model, partial(resolve, is_static=is_static), announce)


def ready_rollers(
    source: Source | BearingModel | MachineModel,
    overrides: Iterable[str] = (),
    announce: Callable[[str], None] | None = None,
) -> tuple[RollerModel, BearingModel | None] | None:
    """Return the roller bearing of a case.

    It has its own temperatures where the case wants them computed; then also return its model with what was found.
    None where the source is no case of one.

    Raises
    ------
    CaseError, SolverError
        With a sentence about the case, or about why there are no steady temperatures.
    """
    from lambda_core.case.case_io import load_case, parse_case
    from lambda_core.model.bearing_model import BearingModel
    from lambda_core.model.roller_case import roller_model

    if isinstance(source, BearingModel):
        return None
    rollers = roller_model(source, overrides)  # type: ignore[arg-type]
    if rollers is None or load_case(source, overrides).operation.temperatures != "computed":  # type: ignore[arg-type]
        return None if rollers is None else (rollers, None)
    warm = ready_model(source, overrides, announce, is_static=True)  # type: ignore[arg-type]
    rollers = roller_model(parse_case(warm.case_toml, warm.name))
    assert rollers is not None
    return rollers, warm


def run_of(source: object) -> Result | None:
    """Return the run of this result file.

    Any other file gives None.
    """
    from lambda_core.results.reader import Result

    is_file = isinstance(source, str | Path) and Path(source).suffix == ".h5" and Path(source).is_file()
    return Result(Path(str(source))) if is_file else None


def _section(model: BearingModel) -> Any:
    from lambda_core.case.case_io import parse_case

    return model.thermal or parse_case(model.case_toml, model.name).thermal
