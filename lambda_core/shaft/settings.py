"""Settings of the integrator of a whole: one integration of all bearings, for averages or for vibrations."""

from __future__ import annotations

from dataclasses import replace

from lambda_core.case.shaft import ShaftCase
from lambda_core.shaft.model import MountedBearing, ShaftModel
from lambda_core.system.ledger import Ledger
from lambda_core.system.resolve_solver import (
    cage_period,
    end_in_sight,
    excited_faster,
    resolution,
    settings,
    surface_of_its_own,
)
from lambda_core.system.time_functions import highest_frequency, peak


def excitation(model: ShaftModel) -> float:
    """Return the highest frequency at which the shaft is loaded or led [Hz]; 0 where it is not."""
    return highest_frequency(*model.led, *(function for _, function in model.varying))


def with_settings(case: ShaftCase, model: ShaftModel, ledger: Ledger) -> ShaftModel:
    """Return the whole with bearings that are all followed alike: vibrations where one of them asks for that.

    Parameters
    ----------
    case : ShaftCase
        What the engineer wrote.
    model : ShaftModel
        Whose bearings were resolved each by itself.
    ledger : Ledger
        Takes what was chosen, and what stands against it.
    """
    given, frequency, speed = case.solver, excitation(model), peak(model.speed_over_time)
    why = _rough(model.bearings) or excited_faster(frequency, speed).replace("bearing", "shaft")
    resolve = resolution(given, frequency, why, ledger, is_silent=False)
    turns = [cage_period(mounted.model.geometry, speed) for mounted in model.bearings]
    unheard = Ledger()  # each bearing's own resolution has said it
    found = [settings(given, turn, frequency, resolve, unheard) for turn in turns]
    slowest = max(found, key=lambda one: one.max_duration)
    end_in_sight(given, None, slowest.duration or slowest.max_duration, max(turns), ledger)
    bearings = tuple(
        replace(mounted, model=replace(mounted.model, solver=solver))
        for mounted, solver in zip(model.bearings, found, strict=True)
    )
    return replace(model, bearings=bearings, assumptions=tuple(ledger.assumptions))


def _rough(bearings: tuple[MountedBearing, ...]) -> str:
    """Return which raceway is not nominal, in words, or nothing."""
    for mounted in bearings:
        found = surface_of_its_own(mounted.model.laws)
        if found:
            return f"{mounted.name}: {found}"
    return ""
