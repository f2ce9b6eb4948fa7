"""Couple a bearing or a machine to another program."""

from __future__ import annotations

import dataclasses
from typing import Literal

import numpy as np

from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.elements import DOFS, SPIN
from lambda_core.domain.errors import UsageError, unknown_name
from lambda_core.model.bearing_model import BearingModel, Body, DofState, TimeFunction
from lambda_core.model.machine_model import MachineModel
from lambda_core.solver.drivers.compiled_laws import Announce, derive_oils
from lambda_core.solver.drivers.dynamics import CAPACITY, BearingEngine
from lambda_core.solver.drivers.equilibrium import Equilibrium, solve
from lambda_core.solver.drivers.machine_motion import MachineEngine, changed_start, machine_start
from lambda_core.solver.drivers.solver_context import assemble

Coupling = Literal["force", "motion"]
COUPLINGS: tuple[Coupling, ...] = ("force", "motion")
RINGS = ("inner_ring", "outer_ring")
# A step that another program asks for ends with a sentence after so many iterations, and so many more for each second
# of the way that is behind it. The integrator takes some 2e5 a second, 1e7 where vibrations are followed (steps of
# 1 us, with their stages): ten times that is no motion of a bearing. The first number is for a load that jumps.
MOST_ITERATIONS = 5_000
MOST_ITERATIONS_PER_SECOND = 1e8
_POSE = tuple(dof for dof in DOFS if dof != SPIN)
_TURNED_BY = {"tilt_y": "moment_y", "tilt_z": "moment_z"}


def given_names(model: BearingModel, couple: Coupling) -> tuple[str, ...]:
    """Return the names of what another program gives.

    With ``force`` the loads on the inner ring where it is free; with ``motion`` the poses of both rings. In both the
    spin of the inner ring where it is prescribed and constant: a case that changes its speed keeps doing so.
    """
    if couple == "motion":
        names = [f"{ring}.{dof}" for ring in RINGS for dof in _POSE]
    else:
        free = [dof for dof in _POSE if model.inner_ring.dofs[dof].mode == "free"]
        names = [f"inner_ring.{_TURNED_BY.get(dof, f'force_{dof}')}" for dof in free]
    spin = model.inner_ring.dofs[SPIN]
    if spin.mode == "prescribed" and all(term.kind == "constant" for term in spin.motion.terms):
        names.append(f"inner_ring.{SPIN}")
    return tuple(names)


def check_known(couple: str) -> None:
    """Refuse a coupling that there is none of; UsageError."""
    if couple not in COUPLINGS:
        raise UsageError(unknown_name("coupling", couple, COUPLINGS))


def check_coupling(model: BearingModel | MachineModel, couple: Coupling) -> None:
    """Refuse what another program cannot lead; UsageError."""
    check_known(couple)
    if couple == "force":
        return
    if isinstance(model, MachineModel):
        raise UsageError(
            f"{model.name}: a machine moves its rings itself, another program gives it loads and speed: "
            "couple by force, or export one of its bearings alone"
        )
    if model.links:
        raise UsageError(
            f"{model.name}: its force elements between bodies hold rings that another program is to move: "
            "leave out [elements], or couple by force"
        )


def coupled_engine(
    model: BearingModel | MachineModel, couple: Coupling, announce: Announce = None, capacity: int = CAPACITY
) -> BearingEngine | MachineEngine:
    """Return the dynamics that take external inputs.

    Raises
    ------
    UsageError
        When the model cannot be coupled so.
    SolverError
        When there is no equilibrium.
    """
    check_coupling(model, couple)
    if isinstance(model, MachineModel):
        return MachineEngine(machine_start(model, announce, is_given=True), announce, capacity=capacity)
    model, found = _start(model, couple, announce)
    return BearingEngine(model, announce, found, given=given_names(model, couple), capacity=capacity)


def alike(
    engine: BearingEngine | MachineEngine, model: BearingModel | MachineModel, capacity: int
) -> BearingEngine | MachineEngine:
    """Return an engine of another model, otherwise alike.

    It has the state and the contact frames that the first began with.
    """
    if isinstance(engine, MachineEngine):
        assert isinstance(model, MachineModel)
        return MachineEngine(changed_start(engine.start, model), capacity=capacity)
    assert isinstance(model, BearingModel)
    begun, given = engine.begun, engine.inputs.names
    own, kernels, frame = begun.context.model, begun.context.kernels, begun.context.frame
    if set(given) >= {f"{ring}.{dof}" for ring in RINGS for dof in _POSE}:  # the other program holds the rings there
        inner = dataclasses.replace(model.inner_ring, dofs=own.inner_ring.dofs)
        outer = dataclasses.replace(model.outer_ring, dofs=own.outer_ring.dofs)
        model = dataclasses.replace(model, inner_ring=inner, outer_ring=outer)
    context = assemble(model, kernels, frame, derive_oils(model, kernels, frame))
    return BearingEngine(model, None, dataclasses.replace(begun, context=context), given=given, capacity=capacity)


def _start(model: BearingModel, couple: Coupling, announce: Announce) -> tuple[BearingModel, Equilibrium]:
    """Return the coupled model and its equilibrium.

    Its motion starts from the equilibrium.

    With ``motion`` both rings are held where the loads of the case have brought them.
    """
    found = solve(model, announce=announce, strict=False)
    if couple == "force":
        return model, found
    poses = _poses(found)
    held = dataclasses.replace(
        model, inner_ring=_held(model.inner_ring, poses[0]), outer_ring=_held(model.outer_ring, poses[1])
    )
    return held, solve(held, found.context.kernels, announce, strict=False)


def _poses(found: Equilibrium) -> FloatArray:
    """Return both rings' poses in an equilibrium.

    They have x, y, z, tilt_y, tilt_z and shape (2, 5) [m, rad].
    """
    rings = found.context.bundle.bodies_now[:2]
    return np.column_stack([rings["position"], -rings["tilt"][:, 1], rings["tilt"][:, 0]])


def _held(body: Body, pose: FloatArray) -> Body:
    """Return a body that is held at a pose."""
    held = {dof: DofState("prescribed", TimeFunction.constant(float(v))) for dof, v in zip(_POSE, pose, strict=True)}
    return dataclasses.replace(body, dofs={**body.dofs, **held})
