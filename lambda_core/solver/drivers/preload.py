"""Compute the preload force of a shaft and its lift-off."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from lambda_core.domain.elements import POSE
from lambda_core.domain.errors import SolverError
from lambda_core.model.geometry.axial_play import axial_play
from lambda_core.model.machine_model import MachineModel, MountedBearing
from lambda_core.solver.drivers.machine_statics import MachineState, SharedKernels, solve_machine
from lambda_core.solver.drivers.roller_reaction import RollerReaction


@dataclass(frozen=True)
class Preload:
    """Of a bearing that takes thrust from one side.

    Attributes
    ----------
    force : float
        Thrust on it without loads and weight, as mounted, warm and turning [N].
    lift_off : float or None
        Thrust on a rigid shaft that brings the opposite bearing back to its first contact [N]; None without exactly one
        opposite bearing, both without springs, and a preload.
    """

    force: float
    lift_off: float | None


def first_contact(bearing: MountedBearing) -> float:
    """Return the place of first contact [m].

    The inner ring moves against the middle of the outer one, in operation.
    """
    return bearing.takes * axial_play(bearing.model, bearing.model.geometry.clearance) if bearing.takes else 0.0


def preloads(model: MachineModel, kernels: SharedKernels | None = None) -> dict[str, Preload]:
    """Return the preload of each one-sided bearing.

    It takes thrust from one side.

    The machine is solved once more without loads and weight. For a pair on a rigid shaft, the approaches of both sum to
    that of the preload: where one is back at its first contact the other carries the approach of both, and the
    outside thrust is the sum of their reactions (Harris and Kotzalas 2006, ch. 9, on axial preload).

    Returns
    -------
    dict of str to Preload
        Empty where nothing takes thrust from one side, or where nothing holds the shaft without its loads.
    """
    sided = [index for index, bearing in enumerate(model.bearings) if bearing.takes]
    if not sided:
        return {}
    without = np.zeros_like(model.loads)
    alone = replace(model, loads=without, weight=without, gravity=(0.0, 0.0, 0.0), part_loads={})
    try:
        state = solve_machine(alone, None, kernels)
    except SolverError:
        return {}
    return {
        alone.bearings[index].name: Preload(abs(float(state.reactions[index, 0])), _lift_off(alone, state, index))
        for index in sided
    }


def _lift_off(model: MachineModel, state: MachineState, index: int) -> float | None:
    """Return the thrust of first contact.

    The thrust on `index` at which its opposite is back at first contact.
    """
    bearing = model.bearings[index]
    opposite = [i for i, other in enumerate(model.bearings) if other.takes == -bearing.takes]
    same = [other for other in model.bearings if other.takes == bearing.takes]
    if len(opposite) != 1 or len(same) != 1 or any(other.seating.force for other in model.bearings):
        return None
    others = [(one, ring) for one, ring in zip(model.bearings, state.rings, strict=True) if not one.takes]
    if any(one.is_locked_along and (not isinstance(ring, RollerReaction) or ring.holds_along) for one, ring in others):
        return None  # a third bearing carries a share
    gained = [
        model.bearings[i].takes * (state.pose(model, i)[0] - first_contact(model.bearings[i]))
        for i in (index, opposite[0])
    ]
    if min(gained) <= 0.0:
        return None
    at = {index: first_contact(bearing) + bearing.takes * sum(gained)}
    at[opposite[0]] = first_contact(model.bearings[opposite[0]])
    thrust = 0.0
    for i, place in at.items():
        thrust += float(state.rings[i].reaction([place, *([0.0] * (len(POSE) - 1))])[0])
    return abs(thrust)
