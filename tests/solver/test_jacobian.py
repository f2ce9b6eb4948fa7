"""Test the block-arrow Jacobian against differences."""

from __future__ import annotations

import numpy as np
import pytest

from lambda_core.solver.arrays import bundle as L

from .support import ALL_FREE, FloatArray, Machine, jostle, rolling
from .test_power import MODELS, machine, random_state


def differences(m: Machine, y: FloatArray) -> FloatArray:
    """Return d(dy/dt)/dy by differences.

    Central, of fourth order, steps 1e-5 of the states' scales.
    """
    dense = np.zeros((y.size, y.size))
    for i in range(y.size):
        step = np.zeros(y.size)
        step[i] = 1e-5 * m.context.scale[i]

        def at(k: float, step: FloatArray = step) -> FloatArray:
            return m.evaluate(y + k * step, want=0).dydt

        dense[:, i] = (8.0 * (at(1.0) - at(-1.0)) - (at(2.0) - at(-2.0))) / (12.0 * step[i])
    return dense


def scaled(m: Machine, matrix: FloatArray) -> FloatArray:
    """Return the scaled matrix.

    In units of the states' scales: all entries are rates [1/s].
    """
    s = m.context.scale
    return np.array(matrix * s[None, :] / s[:, None])


def neighbours(m: Machine) -> np.ndarray:
    """Mark the entries that couple balls.

    Only balls without a cage touch each other.
    """
    of = np.repeat(np.arange(m.count), L.NB)
    mark = np.zeros((m.context.size, m.context.size), dtype=bool)
    mark[: of.size, : of.size] = of[:, None] != of[None, :]
    return mark


@pytest.mark.parametrize(("mode", "seed"), [("rolling", 0), ("sliding", 1)])
@pytest.mark.parametrize("name", MODELS)
def test_jacobian(name: str, mode: str, seed: int) -> None:
    """Compare the Jacobian with differences.

    It leaves out how slip changes the thermal film factor, and the smaller component of entrainment (tangent.py).

    Both reach the columns of the axial velocity and of spins and cost below 1 % of the largest entry of a row (in mixed
    friction 5 %, on steep waves 2 %); the entire matrix is within 0.03 % (0.2 %). Newton needs two to three steps.
    """
    m = machine(*MODELS[name])
    y = random_state(m, seed, mode)
    exact, ours = scaled(m, differences(m, y)), scaled(m, m.jacobian(y))
    if m.model.depth.cage:
        assert np.all(exact[neighbours(m)] == 0.0)
    complete, row = {"thin film": (2e-3, 0.05), "wavy raceways": (3e-4, 0.02)}.get(name, (3e-4, 0.01))
    assert np.linalg.norm(ours - exact) < complete * np.linalg.norm(exact)
    largest = np.abs(exact).max(axis=1, keepdims=True)
    assert np.all(np.abs(ours - exact) < row * largest + 1e-3)


@pytest.mark.parametrize("seed", range(3))
def test_without_friction_nothing_is_left_out(seed: int) -> None:
    """Compare a frictionless Jacobian to 0.3 %.

    Frames, kinematics, Hertz, damping, Coriolis and gyroscopic terms alone: one-sided differences.
    """
    m = machine(*MODELS["every body free"], "models.cage_contact=none")
    y = random_state(m, seed, "rolling")
    with m.frictionless():
        exact, ours = scaled(m, differences(m, y)), scaled(m, m.jacobian(y))
    largest = np.abs(exact).max(axis=1, keepdims=True)
    assert np.all(np.abs(ours - exact) < 3e-3 * largest + 1e-3)


def test_balls_that_touch_nothing_have_their_weight_and_inertia() -> None:
    """Compare terms of balls without a contact.

    No stiffness hides the small ones: gravity, Coriolis and gyroscopic terms.
    """
    m = machine("bearing.clearance=200 um", *ALL_FREE, "models.cage_contact=none", "models.fluid_drag=none")
    y = m.vector(jostle(m, rolling(m, 150.0), np.random.default_rng(0)))
    assert not np.any(m.evaluate(y).ball_forces[:, 3:])
    exact, ours = scaled(m, differences(m, y)), scaled(m, m.jacobian(y))
    of_balls = slice(0, m.count * L.NB)
    largest = np.abs(exact[of_balls]).max(axis=1, keepdims=True)
    assert np.all(np.abs(ours - exact)[of_balls] < 1e-4 * largest + 1e-6)
