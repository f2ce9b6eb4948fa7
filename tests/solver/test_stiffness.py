"""Test the stiffness matrix against differences and Hertz."""

from __future__ import annotations

import dataclasses

import numpy as np
import pytest

from lambda_core import api
from lambda_core.domain.arrays import FloatArray
from lambda_core.model.bearing_model import DofState, TimeFunction
from lambda_core.solver.arrays import bundle as L
from lambda_core.solver.core import core
from lambda_core.solver.drivers.equilibrium import Equilibrium, continue_static, solve
from lambda_core.solver.drivers.solver_context import assemble
from lambda_core.solver.drivers.stiffness import stiffness_matrix

NAMES = ("x", "y", "z", "tilt_y", "tilt_z")
# Of the diagonal: the contacts stiffen over the steps, and the Jacobian takes differences over 10 nm.
ATOL = 5e-4
STEPS = (2e-8, 2e-8, 2e-8, 3e-7, 3e-7)  # [m, rad]: well inside the contacts' compression


def load_at(found: Equilibrium, displacement: FloatArray) -> FloatArray:
    """Return force and moment at a displacement.

    They hold the inner ring at `displacement`, balls re-solved without friction.
    """
    model = found.context.model
    dofs = dict(model.inner_ring.dofs)
    for name, value in zip(NAMES, displacement, strict=True):
        dofs[name] = DofState("prescribed", TimeFunction.constant(float(value)))
    held = dataclasses.replace(model, inner_ring=dataclasses.replace(model.inner_ring, dofs=dofs))
    context = assemble(held, found.context.kernels, found.context.frame, found.context.oils)
    count = model.geometry.ball_count
    state = np.zeros(context.size)
    state[: L.NB * count] = found.state[: L.NB * count]
    continue_static(core(), context, state, friction=False)
    bundle = context.bundle
    bundle.system[0]["friction_on"], bundle.system[0]["guides_on"] = 0, 0
    assert core().evaluate(0.0, state, bundle, np.zeros(state.size), np.zeros(L.power_count(bundle)), 1) == 1
    felt: FloatArray = np.delete(bundle.body_wrenches.view(np.float64)[:6], 3)
    return -felt


def without_friction(found: Equilibrium) -> Equilibrium:
    """Return the equilibrium of normal forces.

    Differences and matrix are of the same state there.
    """
    continue_static(core(), found.context, found.state, friction=False)
    ring = found.context.bundle.bodies_now[0]
    (x, y, z), (ay, az) = ring.position.tolist(), ring.tilt.tolist()
    return dataclasses.replace(found, displacement=(x, y, z, -az, ay))


@pytest.mark.parametrize(
    ("case", "changes"),
    [
        ("6208-axial-1300", ()),
        ("6319-cp10-1500", ("loads.axial=5 kN",)),
        ("6319-cp10-1500", ("loads.axial=5 kN", "elastic.outer_ring.housing_stiffness=100 N/um")),
        ("6319-cp10-1500", ("loads.axial=5 kN", "bodies.inner_ring.tilt_y=locked", "bodies.inner_ring.tilt_z=locked")),
    ],
)
def test_matrix_is_the_difference_quotient_of_the_loads(case: str, changes: tuple[str, ...]) -> None:
    found = without_friction(solve(api.check(case, changes)))
    matrix = np.array(stiffness_matrix(found))
    differences = np.zeros((5, 5))
    for i, step in enumerate(STEPS):
        move = np.zeros(5)
        move[i] = step
        at = np.array(found.displacement)
        differences[:, i] = (load_at(found, at + move) - load_at(found, at - move)) / (2.0 * step)
    scale = np.sqrt(np.outer(np.diag(matrix), np.diag(matrix)))
    np.testing.assert_allclose(matrix / scale, differences / scale, atol=ATOL)
    assert np.all(np.linalg.eigvalsh(matrix) > 0.0)


def test_radial_stiffness_grows_like_hertz() -> None:
    """Compare stiffness with F^(1/3).

    Without clearance all displacements are proportional to F^(2/3).
    """
    changes = ("bearing.clearance=0 um", "gravity.z=0 m/s2", "operation.speed=10 rpm")
    light, heavy = (
        stiffness_matrix(solve(api.check("6319-cp10-500", (*changes, f"loads.radial={load}")), strict=False))[2][2]
        for load in ("10 kN", "20 kN")
    )
    # The contacts' radii follow the load a little (R_x is frozen at the mean angle, here 0): exact to 1e-3.
    assert heavy / light == pytest.approx(2.0 ** (1.0 / 3.0), rel=2e-3)


def test_locked_ring_has_the_stiffness_of_the_free_one() -> None:
    free = stiffness_matrix(solve(api.check("6319-cp10-1500")))
    locked = stiffness_matrix(solve(api.check("6319-cp10-1500", ("bodies.inner_ring.x=locked",))))
    np.testing.assert_allclose(locked, free, rtol=1e-3, atol=1e3)
