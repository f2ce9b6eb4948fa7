"""Resolve the integrator settings of a machine."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

from lambda_core.case.machine import MachineCase
from lambda_core.domain.elements import POSE, SPIN
from lambda_core.model.bodies.loads import LOADS
from lambda_core.model.laws.time_functions import highest_frequency, peak, time_function
from lambda_core.model.ledger import Ledger
from lambda_core.model.machine_model import MachineModel, MountedBearing
from lambda_core.model.settings.resolve_solver import (
    cage_period,
    end_in_sight,
    excited_faster,
    resolution,
    say_cut,
    settings,
    surface_of_its_own,
)


def changing(case: MachineCase) -> list[tuple[str, Any]]:
    """Return the path and value of time functions.

    Everything that loads or moves the shaft, with its value or course.
    """
    found: list[tuple[str, Any]] = [
        ("operation.speed", case.operation.speed),
        ("operation.torque", case.operation.torque),
    ]
    for key, load in case.loads.items():
        found += [(f"loads.{key}.{name}", getattr(load, name)) for name in LOADS]
    found += [(f"shaft.support.{dof}.motion", getattr(case.shaft.support, dof).motion) for dof in POSE]
    for key, bearing in case.bearings.items():
        found += [(f"bearings.{key}.support.{dof}.motion", getattr(bearing.support, dof).motion) for dof in POSE]
    for key, rigid in case.bodies.items():
        found += [(f"bodies.{key}.support.{dof}.motion", getattr(rigid.support, dof).motion) for dof in POSE]
    return found


def refuse_settings(case: MachineCase, ledger: Ledger) -> None:
    """Note impossible settings.

    Whatever the shaft and its bearings are.
    """
    given = case.solver
    resolution(given, _excitation(case), "", ledger, is_silent=True)
    end = given.duration or given.max_duration
    if end is not None:  # turns of the cage end a run of their own accord
        end_in_sight(given, None, end, math.inf, ledger)


def with_settings(case: MachineCase, model: MachineModel, ledger: Ledger) -> MachineModel:
    """Return the machine with equal settings.

    All bearings resolve vibrations where one of them asks for that.

    Parameters
    ----------
    case : MachineCase
        What the engineer wrote, without mistakes.
    model : MachineModel
        Whose bearings were resolved each by itself.
    ledger : Ledger
        Takes what was chosen.
    """
    given, frequency, speed = case.solver, _excitation(case), peak(model.speed_over_time)
    rough, said = _rough(model.bearings), Ledger()
    why = rough or excited_faster("shaft", frequency, speed)
    resolve = resolution(given, frequency, why, said, is_silent=False)
    turns = [cage_period(mounted.model.geometry, speed, _outer_speed(mounted)) for mounted in model.bearings]
    found = [settings(given, turn, frequency, resolve, said) for turn in turns]
    say_cut(given, min(one.max_step for one in found), said)
    for sentence in said.assumptions:
        ledger.assume(f"in motion {sentence}")
    if rough:
        ledger.assume(f"the equilibrium has nominal raceways ({rough})")
    bearings = tuple(
        replace(mounted, model=replace(mounted.model, solver=solver))
        for mounted, solver in zip(model.bearings, found, strict=True)
    )
    return replace(model, bearings=bearings, assumptions=tuple(ledger.assumptions))


def _outer_speed(mounted: MountedBearing) -> float:
    """Return the highest planned speed of an outer ring [rad/s]."""
    return peak(mounted.model.outer_ring.dofs[SPIN].motion)


def _excitation(case: MachineCase) -> float:
    """Return the highest excitation frequency [Hz].

    It is that of loads and motions, or 0 where there is none.
    """
    signals = [signal for _, signal in changing(case)]
    for bearing in case.bearings.values():
        signals.append(bearing.outer_ring.spin.motion)
        signals += [getattr(bearing.cage, dof).motion for dof in (*POSE, SPIN)]
    return highest_frequency(*map(time_function, signals))


def _rough(bearings: tuple[MountedBearing, ...]) -> str:
    """Return which raceway is not nominal, in words, or nothing."""
    for mounted in bearings:
        found = surface_of_its_own(mounted.model.laws)
        if found:
            return f"{mounted.name}: {found}"
    return ""
