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


@pytest.mark.parametrize("axis", ["rolling", "across", "normal"])
def test_a_ball_that_turns_about_its_contact_has_its_slopes(axis: str) -> None:
    """Compare the slope along a turn about a contact's centre.

    The ball touches the outer raceway alone and rolls, so that no other slope hides those with relative rotation: its
    turn leaves the slip at the centre unchanged, and it has no entrainment across.
    """
    m = machine("bearing.clearance=200 um", "models.cage_contact=none", "models.fluid_drag=none")
    g, state, angle, depth = m.model.geometry, rolling(m, 150.0), 0.1, 8e-6
    reach = g.groove_radius_outer - 0.5 * g.ball_diameter + depth
    state.balls[:, L.BX] = reach * np.sin(angle)
    state.balls[:, L.BR] = float(m.constant("groove_circle")[1]) + reach * np.cos(angle)
    state.balls[:, [L.BWX, L.BVT]] *= [1.02, 1.001]
    state.balls[:, L.BWR] += 3.0
    y, normal, along = m.vector(state), np.array([np.sin(angle), np.cos(angle), 0.0]), np.array([0.0, 0.0, 1.0])
    turn = {"rolling": along, "across": np.cross(normal, along), "normal": normal}[axis]
    way = np.zeros(y.size)
    way[L.BVX : L.BVX + 6] = [*-(0.5 * g.ball_diameter - 0.5 * depth) * np.cross(turn, normal), *turn]
    exact = (m.evaluate(y + 1e-4 * way, want=0).dydt - m.evaluate(y - 1e-4 * way, want=0).dydt) / 2e-4
    ours = m.jacobian(y) @ way
    assert m.evaluate(y).ball_forces[0, 1] < -100.0
    for rates in (slice(L.BVX, L.BVX + 3), slice(L.BVX + 3, L.BVX + 6)):
        assert ours[rates] == pytest.approx(exact[rates], abs=1e-3 * np.abs(exact[rates]).max())
