"""Take loads and motions from another program.

A signal is named like the option of a case that it stands for: ``inner_ring.force_z``, ``outer_ring.tilt_y``,
``inner_ring.spin``. From the moment at which it is given it goes on with the derivatives that were given with it, until
it is given anew.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Sequence
from typing import Any, Literal

import numpy as np

from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.elements import BODIES, DOFS, SPIN
from lambda_core.domain.errors import UsageError, unknown_name
from lambda_core.model.bearing_model import BearingModel, Body, DofState, TimeFunction
from lambda_core.model.laws.time_functions import initial
from lambda_core.model.machine_model import MachineModel
from lambda_core.solver import records as R
from lambda_core.solver.drivers.equilibrium import Equilibrium, solve
from lambda_core.solver.drivers.solver_context import SolverContext
from lambda_core.solver.drivers.time_tables import FORCE, MOMENT, MOTION, PER_BODY

Coupling = Literal["force", "motion"]
COUPLINGS: tuple[Coupling, ...] = ("force", "motion")
RINGS = ("inner_ring", "outer_ring")
# A step that another program asks for ends with a sentence after so many iterations, and so many more for each second
# of the way that is behind it. The integrator takes some 2e5 a second, 1e7 where vibrations are followed (steps of
# 1 us, with their stages): ten times that is no motion of a bearing. The first number is for a load that jumps.
MOST_ITERATIONS = 5_000
MOST_ITERATIONS_PER_SECOND = 1e8
_POSE = tuple(dof for dof in DOFS if dof != SPIN)
_MOTIONS = {f"{body}.{dof}": PER_BODY * b + MOTION + d for b, body in enumerate(BODIES) for d, dof in enumerate(DOFS)}
_LOADS = {
    f"{body}.{kind}_{axis}": PER_BODY * b + first + a
    for b, body in enumerate(BODIES)
    for kind, first in (("force", FORCE), ("moment", MOMENT))
    for a, axis in enumerate("xyz")
}
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


def make_room(context: SolverContext, names: Sequence[str]) -> Any:
    """Add external signals to loads and motions.

    The loads and motions are those of a context.

    A given load adds to those of the case and is 0 at first; a given motion takes the place of the case's and
    begins at its value at t = 0.

    Returns
    -------
    records.TERM[:]
        One row per name, a view of what compiled code reads.
    """
    rows, terms = np.zeros(len(names), R.TERM), context.bundle.terms
    rows["signal"], rows["kind"] = [(_MOTIONS | _LOADS)[name] for name in names], R.GIVEN
    for row, name in zip(rows, names, strict=True):
        if name in _MOTIONS:
            body, dof = name.split(".")
            row["value"] = initial(getattr(context.model, body).dofs[dof].motion)
    replaced = np.isin(terms["signal"], [_MOTIONS[name] for name in names if name in _MOTIONS])
    context.bundle = context.bundle._replace(terms=np.concatenate([terms[~replaced], rows]))
    return context.bundle.terms[terms.size - np.count_nonzero(replaced) :]


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


def start(model: BearingModel, couple: Coupling, announce: Any = None) -> tuple[BearingModel, Equilibrium]:
    """Return the coupled model and its equilibrium.

    Its motion starts from the equilibrium.

    With ``motion`` both rings are held where the loads of the case have brought them.

    Raises
    ------
    UsageError
        When the model cannot be coupled so.
    SolverError
        When there is no equilibrium.
    """
    check_coupling(model, couple)
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
