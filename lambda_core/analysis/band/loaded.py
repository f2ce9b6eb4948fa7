"""Take bearings out of a model with their loads."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, NamedTuple

from lambda_core.model.bearing_model import BearingModel
from lambda_core.model.roller_case import rollers_at_rest
from lambda_core.solver.drivers.roller_reaction import RollerReaction

if TYPE_CHECKING:
    from lambda_core.model.machine_model import MachineModel
    from lambda_core.model.roller_case import RollerModel
    from lambda_core.solver.drivers.machine_statics import MachineState


class LoadedBearing(NamedTuple):
    """A bearing with its load in a model.

    Attributes
    ----------
    model : BearingModel
        With the ranges of its laws; that of balls has the load.
    rollers : RollerModel or None
        Its rollers under the load.
    """

    model: BearingModel
    rollers: RollerModel | None


def loaded_bearings(
    model: BearingModel | MachineModel, announce: Callable[[str], None] | None = None
) -> dict[str, LoadedBearing]:
    """Return each bearing of a model with its load.

    The keys are names. The loads of a bearing alone stand in its case; those of a machine's bearings follow from its
    equilibrium.
    """
    if isinstance(model, BearingModel):
        return {"": LoadedBearing(model, None if model.rollers is None else rollers_at_rest(model))}
    from lambda_core.solver.drivers.machine_statics import solve_machine

    return loaded_in(model, solve_machine(model, announce))


def loaded_in(machine: MachineModel, state: MachineState) -> dict[str, LoadedBearing]:
    """Return each bearing of a solved machine with its load."""
    from lambda_core.analysis.rotor.bearing_alone import alone_under_load
    from lambda_core.analysis.rotor.rollers_on_shaft import taken_out

    return {
        mounted.name: LoadedBearing(mounted.model, taken_out(ring))
        if isinstance(ring, RollerReaction)
        else LoadedBearing(alone_under_load(machine, state, i), None)
        for i, (mounted, ring) in enumerate(zip(machine.bearings, state.rings, strict=True))
    }
