"""Solve a bearing at temperatures from its own losses.

It does so for operation.temperatures = "computed".
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from lambda_core.analysis.thermal.feedback import BearingLoop, Steady
from lambda_core.analysis.thermal.found_temperatures import FoundTemperatures
from lambda_core.analysis.thermal.losses import Announce
from lambda_core.case.case import Case
from lambda_core.case.case_io import parse_case
from lambda_core.domain.channels import LOSSES
from lambda_core.model.bearing_model import BearingModel
from lambda_core.model.settings.resolve_thermal import network_assumptions
from lambda_core.results.convergence import window
from lambda_core.results.reader import Result

_ZERO_CELSIUS = 273.15
_PARTS = ("inner_ring", "outer_ring", "balls", "shaft", "housing")


def at_own_temperatures(
    model: BearingModel, resolve: Callable[[Case], BearingModel], announce: Announce = None
) -> BearingModel:
    """Return the model at computed steady temperatures.

    Its thermal network gives them; a model with given temperatures stays as it is.

    The case that the returned model carries has these temperatures written in, so that a result needs no search when
    it goes on or is looked at.

    Parameters
    ----------
    model : BearingModel
        Resolved.
    resolve : callable
        Freezes a case into a model.
    announce : callable, optional
        Called with a sentence before something is compiled, and with the temperatures found.

    Raises
    ------
    SolverError
        When there are no steady temperatures; a runaway is named with the gain that caused it.
    """
    if model.thermal is None:
        return model
    loop = BearingLoop(model, model.thermal, announce)
    found = loop.steady()
    sentence = _sentence(loop, found)
    if announce is not None:
        announce(sentence)
    return at_temperatures(loop, found, resolve, sentence)


def at_temperatures(
    loop: BearingLoop, found: Steady, resolve: Callable[[Case], BearingModel], sentence: str = ""
) -> BearingModel:
    """Return the model of a loop at found temperatures.

    Its case says so in a sentence.
    """
    case = _with_temperatures(parse_case(loop.model.case_toml, loop.model.name), loop, found, sentence)
    return replace(resolve(case), found_temperatures=FoundTemperatures(loop, found))


def _with_temperatures(case: Case, loop: BearingLoop, found: Steady, sentence: str) -> Case:
    at = loop.nodes.named(found.temperatures)
    parts = {part: _degrees(at[part]) for part in _PARTS if part in at}
    return case.with_(
        assumptions=[*case.assumptions, *network_assumptions(case.thermal), sentence],
        lubricant={"temperature": _degrees(found.points[0].inlet)},
        bearing={"temperatures": parts},
        operation={"temperatures": None},
    )


def _degrees(temperature: float) -> str:
    return f"{temperature - _ZERO_CELSIUS:.4f} degC"


def _sentence(loop: BearingLoop, found: Steady) -> str:
    at = loop.nodes.named(found.temperatures)
    shown = ", ".join(
        f"{name.replace('_', ' ')} {at[name] - _ZERO_CELSIUS:.1f}" for name in (*_PARTS, "oil") if name in at
    )
    return f"temperatures found by the thermal network ({loop.thermal.conductances}): {shown} degC"


def of_run(result: Result, model: BearingModel, announce: Announce = None) -> tuple[BearingLoop, Steady]:
    """Return the steady temperatures of a run.

    They follow from its averaged losses, including the cage.

    Conductances are those of the quasi-static point at the temperatures that the run was made with; the gain of the
    loop is that of the quasi-static point too.

    Parameters
    ----------
    result : Result
        A run.
    model : BearingModel
        Its case, resolved.
    """
    loop = BearingLoop(model, parse_case(result.case_toml, str(result.path)).thermal, announce)
    point = loop.losses.at(model.oil.temperature, model.geometry.clearance)
    losses = averaged_losses(result, model)
    measured = point.with_losses(losses)
    temperatures, network = loop.answer((measured,), loop.first_guess())
    seen = np.array([point.inlet, point.clearance])
    slopes = loop.slopes(seen, (point,), temperatures)
    return loop, Steady(temperatures, (measured,), network, loop.gain(*slopes), 1, *slopes)


def averaged_losses(result: Result, model: BearingModel) -> dict[str, float]:
    """Return a bearing's average losses by mechanism in a run.

    They are in W.
    """
    chosen = window(model.solver, result.revolutions(), result.integrals()[-1]).interval
    time = chosen.change("time")
    return {name: chosen.change(f"loss.{name}") / time for name in LOSSES}
