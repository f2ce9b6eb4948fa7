"""Take one bearing out of a machine with its load."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING

import numpy as np

from lambda_core.case.case_io import refuse_bearing
from lambda_core.domain.elements import POSE
from lambda_core.domain.errors import UsageError, unknown_name
from lambda_core.elements.roller.roller_friction import OilState
from lambda_core.model.bearing_model import BearingModel, DofState, TimeFunction
from lambda_core.model.laws.roller_dielectric import dielectric_of_model
from lambda_core.model.laws.roller_laws import friction_of_model
from lambda_core.model.roller_case import RollerModel, friction_parameters

if TYPE_CHECKING:
    from lambda_core.laws.context import Oil
    from lambda_core.model.machine_model import MachineModel
    from lambda_core.results.reader import Result
    from lambda_core.solver.drivers.machine_statics import MachineState
    from lambda_core.solver.drivers.roller_reaction import RollerReaction


def bearing_number(model: BearingModel | MachineModel, name: str | None) -> int:
    """Return the place of a bearing in a model.

    A model with one bearing needs no name.

    Raises
    ------
    UsageError
        When a name is needed, or there is no bearing of that name.
    """
    names = list(model.bearing_models)
    if names == [""]:
        refuse_bearing(name)
        return 0
    return number_among(names, name, model.name)


def number_among(names: Sequence[str], name: str | None, case: str) -> int:
    """Return the place of a bearing's name among all.

    An only bearing needs no name. The errors are those of :func:`bearing_number`.
    """
    if name is None and len(names) > 1:
        raise UsageError(f"{case} has {len(names)} bearings; choose one with --bearing ({', '.join(names)})")
    if name is not None and name not in names:
        raise UsageError(unknown_name("bearing", name, names))
    return 0 if name is None else names.index(name)


def bearing_alone(
    model: BearingModel | MachineModel, name: str | None, announce: Callable[[str], None] | None = None
) -> BearingModel:
    """Return one bearing of a machine alone.

    It has the constant load and the misalignment of t = 0.

    Its inner ring is free along x, y and z and carries the load; its tilts are held where shaft and housing hold them,
    as is x of cylindrical rollers. A bearing that is alone already is returned as it is.
    """
    from lambda_core.analysis.static_point import static_point

    return list(static_point(model, announce).bearings.values())[bearing_number(model, name)].alone


def bearing_of_run(result: Result) -> BearingModel:
    """Return the model of a result's bearing.

    The case in the result's file gives it.

    Of a machine it is alone under the load that it carries at the start, see :func:`bearing_alone`.

    Raises
    ------
    CaseError, SolverError
        When the case does not resolve any more, or the machine has no equilibrium.
    """
    from lambda_core.case.case_io import toml_tables
    from lambda_core.model.api import check

    model = check(toml_tables(result.case_toml, str(result.path)))
    return bearing_alone(model, result.of_bearing().bearing if result.is_machine else None)


def alone_under_load(machine: MachineModel, state: MachineState, number: int) -> BearingModel:
    """Return one bearing of a solved machine as :func:`bearing_alone` does."""
    mounted, reaction, pose = machine.bearings[number], state.reactions[number], state.pose(machine, number)
    model, body = mounted.model, mounted.model.inner_ring
    # cylinders need no thrust, and where nothing presses their ribs nothing else holds the ring along the shaft
    stays = model.rollers is not None and model.rollers.contact_angle == 0.0
    free = dict.fromkeys(POSE[stays:3], DofState("free"))
    held = {
        axis: DofState("prescribed", TimeFunction.constant(float(value)))
        for axis, value in zip(POSE, pose, strict=True)
        if axis not in free
    }
    # what the shaft puts on the ring is all that it carries: its own weight is among the shaft's
    force = tuple(
        TimeFunction.constant(-float(carried) - body.mass * pull)
        for carried, pull in zip(reaction[:3], model.gravity, strict=True)
    )
    inner = dataclasses.replace(body, force=force, dofs={**body.dofs, **free, **held})  # type: ignore[arg-type]
    outer = dataclasses.replace(
        model.outer_ring, dofs={**model.outer_ring.dofs, **dict.fromkeys(POSE, DofState("locked"))}
    )
    note = "load and misalignment are those of the machine's equilibrium at t = 0, constant"
    return dataclasses.replace(
        model, name=f"{machine.name}-{mounted.name}", title=f"{model.title}, {mounted.name} of {machine.name}",
        inner_ring=inner, outer_ring=outer, links={}, assumptions=(*model.assumptions, note),
    )  # fmt: skip


def taken_out(ring: RollerReaction) -> RollerModel:
    """Return a roller bearing of a machine alone.

    It has the load that it carries at the last pose of its rings.

    Its tilts are those of the pose; so is its place in directions without a load that holds it.
    """
    model, bearing, motion, state = ring.model, ring.rollers, ring.motion, ring.state
    oil = _oil_state(ring.oil)
    given = dataclasses.replace(
        friction_parameters(bearing, model.roughness, model.lubrication, model.oil_level), **friction_of_model(model)
    )
    loads = np.array([*state.loads[:3], 0.0, 0.0])  # tilts are held
    along, across = bearing.contact_angle == 0.0 or loads[0] <= 0.0, state.carried[0] == 0.0
    return RollerModel(
        name=model.name, title=model.title, bearing=bearing, loads=loads,
        held=(bool(along), across, across, True, True), displacement=state.ring,
        speeds=(motion.inner, motion.outer), oil=oil, friction=given, lubricant=ring.oil.name,
        base_type=ring.oil.base_type, lubrication=model.lubrication, temperature=ring.oil.temperature,
        slices=state.inner.shape[1], contamination=model.contamination, assumptions=model.assumptions,
        dielectric=dielectric_of_model(model, ring.frame, ring.oil),
    )  # fmt: skip


def _oil_state(oil: Oil) -> OilState:
    return OilState(oil.viscosity, oil.density, oil.alpha_p, oil.beta, oil.thermal_conductivity)


def at_speed(model: BearingModel, speed: float) -> BearingModel:
    """Return a bearing at another constant speed [rad/s].

    The inner ring turns at it.
    """
    spin = dataclasses.replace(model.inner_ring.dofs["spin"], motion=TimeFunction.constant(speed))
    inner = dataclasses.replace(model.inner_ring, dofs={**model.inner_ring.dofs, "spin": spin})
    return dataclasses.replace(model, inner_ring=inner)
