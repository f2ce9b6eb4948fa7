"""Find temperatures of bearings under their losses."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, cast

from lambda_core.case.case_io import toml_tables
from lambda_core.domain.elements import POSE
from lambda_core.domain.errors import UsageError
from lambda_core.domain.lists import listed
from lambda_core.model.api import check

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

    from lambda_core.analysis.thermal.feedback import Loop, Steady
    from lambda_core.case.case_io import Source
    from lambda_core.domain.errors import CaseError
    from lambda_core.model.bearing_model import BearingModel
    from lambda_core.model.machine_model import MachineModel
    from lambda_core.model.roller_case import RollerModel
    from lambda_core.results.reader import Result

_AT_REST = {f"bodies.inner_ring.{name}" for name in POSE}  # what is locked takes any load there


def loop_of(
    source: Source | BearingModel | MachineModel,
    overrides: Iterable[str] = (),
    announce: Callable[[str], None] | None = None,
) -> Loop:
    """Return the loop that computes all temperatures of a case."""
    from lambda_core.analysis.thermal.machine_temperatures import MachineLoop, without_temperatures
    from lambda_core.analysis.thermal.operating import BearingLoop
    from lambda_core.model.machine_model import MachineModel

    model = resolved(source, overrides)
    if isinstance(model, MachineModel):
        return MachineLoop(without_temperatures(model), announce)
    return BearingLoop(model, model.thermal or model.case.thermal, announce)


def of_run(result: Result, announce: Callable[[str], None] | None = None) -> tuple[Loop, Steady]:
    """Return the loop of a run and its steady temperatures.

    They follow from its averaged losses, including the cage.

    Conductances are those of the quasi-static point at the temperatures that the run was made with; the gain of the
    loop is that of the quasi-static point at the temperatures found.
    """
    from lambda_core.analysis.thermal.feedback import Steady

    model = resolved(toml_tables(result.case_toml, str(result.path)))
    loop = loop_of(model, (), announce)
    runs = zip(result.bearings.values(), model.bearing_models.values(), strict=True)
    losses = [_averaged_losses(one, own) for one, own in runs]
    measured = tuple(point.with_losses(own) for point, own in zip(loop.points_of(model), losses, strict=True))
    temperatures, network = loop.answer(measured, loop.first_guess())
    seen = loop.seen(temperatures)
    slopes = loop.slopes(seen, loop.solved(seen), temperatures)
    return loop, Steady(temperatures, measured, network, loop.gain(*slopes), 1, *slopes)


def _averaged_losses(result: Result, model: BearingModel) -> dict[str, float]:
    """Return a bearing's average losses in a run [W]."""
    from lambda_core.domain.channels import LOSSES
    from lambda_core.results.convergence import window

    chosen = window(model.solver, result.revolutions(), result.integrals()[-1]).interval
    time = chosen.change("time")
    return {name: chosen.change(f"loss.{name}") / time for name in LOSSES}


def resolved(
    source: Source | BearingModel | MachineModel, overrides: Iterable[str] = (), *, is_static: bool = False
) -> BearingModel | MachineModel:
    """Return the model of a case before temperatures are computed.

    UsageError for overrides of a resolved model.
    """
    from lambda_core.model.bearing_model import BearingModel
    from lambda_core.model.machine_model import MachineModel

    if not isinstance(source, BearingModel | MachineModel):
        return check(source, overrides, is_static=is_static)
    if listed(overrides, "overrides"):
        raise UsageError("a resolved model takes no overrides: change the case and resolve it")
    return source


def ready(
    source: Source | BearingModel | MachineModel,
    overrides: Iterable[str] = (),
    announce: Callable[[str], None] | None = None,
    *,
    is_static: bool = False,
) -> BearingModel | MachineModel:
    """Return the model of a bearing or a machine.

    It has its own temperatures where the case wants them computed. Its case has them written in, so that a result
    needs no search when it goes on or is looked at.

    With `is_static` it is for an equilibrium, which needs no end in time.

    Raises
    ------
    UsageError
        For overrides of a resolved model.
    CaseError, SolverError
        With a sentence about the case, or about why there are no steady temperatures: a runaway is named with the gain
        that caused it.
    """
    model = resolved(source, overrides, is_static=is_static)
    if not model.awaits_temperatures:
        return model
    loop = loop_of(model, (), announce)
    found = loop.steady()
    sentence = loop.sentence(found)
    if announce is not None:
        announce(sentence)
    return loop.model_at(found, sentence, is_static=is_static)


def ready_model(
    source: Source | BearingModel,
    overrides: Iterable[str] = (),
    announce: Callable[[str], None] | None = None,
    *,
    is_static: bool = False,
) -> BearingModel:
    """Return the model of one bearing; see :func:`ready`."""
    return cast("BearingModel", ready(source, overrides, announce, is_static=is_static))


def ready_machine_of(
    source: Source | MachineModel, overrides: Iterable[str] = (), announce: Callable[[str], None] | None = None
) -> MachineModel:
    """Return the model of a machine; see :func:`ready`."""
    return cast("MachineModel", ready(source, overrides, announce))


def ready_rollers(
    source: Source | BearingModel | MachineModel,
    overrides: Iterable[str] = (),
    announce: Callable[[str], None] | None = None,
    *,
    refused: CaseError | None = None,
) -> tuple[RollerModel, BearingModel | None] | None:
    """Return the roller bearing of a case.

    It has its own temperatures where the case wants them computed; then also return its model with what was found.
    None where the source is no case of one, or a resolved model, or where what is `refused` in motion is so at rest.

    Raises
    ------
    CaseError, SolverError
        With a sentence about the case, or about why there are no steady temperatures.
    """
    from lambda_core.case.case_io import bearing_case
    from lambda_core.model.roller_case import roller_model, rollers_at_rest

    if refused is not None and any(problem.where not in _AT_REST for problem in refused.problems):
        return None
    rollers = roller_model(source, overrides)  # type: ignore[arg-type]
    if rollers is None or bearing_case(source, overrides).operation.temperatures != "computed":  # type: ignore[arg-type]
        return None if rollers is None else (rollers, None)
    warm = ready_model(source, overrides, announce, is_static=True)  # type: ignore[arg-type]
    return rollers_at_rest(warm), warm


def run_of(source: object) -> Result | None:
    """Return the run of this result file.

    Any other file gives None.
    """
    from lambda_core.results.reader import Result

    is_file = isinstance(source, str | Path) and Path(source).suffix == ".h5" and Path(source).is_file()
    return Result(Path(str(source))) if is_file else None
