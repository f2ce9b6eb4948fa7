"""Test stiffness and damping of bearings against the Jacobian."""

from __future__ import annotations

import tomllib

import numpy as np
import pytest

from lambda_core.analysis.rotor.vibration import bearing_damping, damped, housed_damping, modes_at, supported
from lambda_core.model.machine_model import MachineModel
from lambda_core.model.machine_templates import shaft_text
from lambda_core.model.resolve_machine import resolve_machine
from lambda_core.solver.arrays import bundle as L
from lambda_core.solver.core import core
from lambda_core.solver.drivers.damping import damping_matrix
from lambda_core.solver.drivers.dynamics import initial_state
from lambda_core.solver.drivers.equilibrium import Equilibrium
from lambda_core.solver.drivers.machine_statics import MachineState, solve_machine
from lambda_core.solver.drivers.modes import dense
from lambda_core.solver.drivers.stiffness import freed, stiffness_at

Solved = tuple[MachineModel, MachineState, list[Equilibrium]]


@pytest.fixture(scope="module")
def solved() -> Solved:
    """Return the gearbox shaft and its equilibria.

    Its right bearing is on springs; friction is included.
    """
    case = tomllib.loads(shaft_text("geared-shaft", "box"))
    case["bearings"]["right"]["support"] = {"x": "free", "y": "50 N/um", "z": "80 N/um"}
    model = resolve_machine(case)
    state = solve_machine(model)
    return model, state, [ring.equilibrium() for ring in state.rings]


def test_a_ring_that_vibrates(solved: Solved) -> None:
    """Compare a heavy ring's frequency and damping.

    200 times as heavy, free along y or z: the complete Jacobian's frequency to 2 %, damping to 4 %.

    Its eigenvalue near sqrt(k/m), all balls moving, against k and c of the matrices at that frequency.
    """
    _, _, (found, _) = solved
    context = freed(found.context)
    balls = found.state[: L.NB * 9]
    mass = 200.0 * context.model.inner_ring.mass
    context.bundle.bodies["mass"][0] = mass
    shared = found.context.bundle.shared.copy()
    shared[found.context.bundle.active] = found.context.shared_part(initial_state(found))
    kept = found.state[found.state.size - found.context.bundle.states.size :]
    y = np.concatenate([balls, shared[context.bundle.active], kept])
    assert core().evaluate(0.0, y, context.bundle, np.zeros(y.size), np.zeros(L.power_count(context.bundle)), 0) == 1
    assert core().jacobian(0.0, y, context.bundle, context.blocks) == 1
    matrix = dense(context.blocks)
    stiffness = stiffness_at(found.context, freed(found.context), found.state, found.displacement)
    moving_balls = [i for i in range(9 * L.NB) if i % L.NB != L.BPSI]
    for axis, place, rate in ((1, L.SY, L.SVY), (2, L.SZ, L.SVZ)):
        moves = [*moving_balls, *(9 * L.NB + int(context.blocks.index[k]) for k in (place, rate))]
        values, vectors = np.linalg.eig(matrix[np.ix_(moves, moves)])
        guess = np.sqrt(stiffness[axis, axis] / mass)
        near = np.flatnonzero((values.imag > 0.9 * guess) & (values.imag < 1.1 * guess))
        root = values[near[np.argmax(np.abs(vectors[-1, near]))]]
        c = damping_matrix(found, float(root.imag))[axis, axis]
        assert root.imag == pytest.approx(guess, rel=0.02)
        assert -root.real == pytest.approx(0.5 * c / mass, rel=0.04)


def test_contacts_damp_by_their_time_constant(solved: Solved) -> None:
    """Compare c with tau k of every contact.

    Without friction to speak of, c over k of the bearing lies near tau (10 us).
    """
    model, state, equilibria = solved
    found = bearing_damping(model, equilibria)
    assert found.shape == (2, 6, 6)
    for own, stiffness in zip(found, state.stiffness, strict=True):
        for axis in (1, 2):
            assert 5e-6 < own[axis, axis] / stiffness[axis, axis] < 1.5e-5
        assert 0.0 < own[3, 3] < 1e-2  # N m s: friction torque that grows with the speed


def test_housing_in_series(solved: Solved) -> None:
    """Compare bearing and housing in series.

    The dynamic stiffness is that of both; modes damped by it are stable.
    """
    model, state, equilibria = solved
    own = bearing_damping(model, equilibria)
    housed = housed_damping(model, state, own)
    assert housed[0] == pytest.approx(own[0], rel=1e-9, abs=1e-12)  # in a rigid seat
    moves = [0, 1, 2]
    z = state.stiffness[1].astype(complex)
    z += 1j * model.speed * np.delete(np.delete(own[1], 3, 0), 3, 1)
    through = z[np.ix_(moves, moves)] + np.diag([0.0, 50e6, 80e6])
    series = z - z[:, moves] @ np.linalg.solve(through, z[moves])
    assert np.delete(np.delete(housed[1], 3, 0), 3, 1) == pytest.approx(series.imag / model.speed, rel=1e-6, abs=1e-9)
    assert housed[1, 1, 1] < own[1, 1, 1]
    stiffness, damping = supported(model, state), damped(model, state, own)
    for quiet, one in zip(
        modes_at(model, stiffness, model.speed), modes_at(model, stiffness, model.speed, damping), strict=True
    ):
        assert one.frequency == pytest.approx(quiet.frequency, rel=5e-3)
        assert quiet.damping == pytest.approx(0.0, abs=1e-6)
        assert -1e-6 < one.damping < 0.2
