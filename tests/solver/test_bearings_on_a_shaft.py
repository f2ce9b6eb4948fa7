"""Test the tables beyond one bearing.

Two bearings and six on one shaft, made by hand (benchmarks.shaft).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import pytest

from benchmarks.shaft import SHAFT, on_a_shaft, together
from lambda_core.domain.arrays import FloatArray
from lambda_core.solver.arrays import bundle as L
from lambda_core.solver.core import core
from lambda_core.solver.drivers.solver_context import SolverContext

from .support import Machine, dense, integrate, integrate_tables
from .test_power import MODELS, machine, random_state


@dataclass(frozen=True)
class Shaft:
    """Equal bearings on one shaft.

    Their inner rings are one body, their planes at some places along its axis [m].
    """

    single: Machine
    places: tuple[float, ...]
    context: SolverContext

    @property
    def balls(self) -> int:
        return len(self.places) * self.single.count

    def states(self, *each: FloatArray) -> FloatArray:
        """Return the state from single bearings.

        Theirs, brought to their places.
        """
        moved = [self._at(state, place) for state, place in zip(each, self.places, strict=True)]
        return together(self.single.context, moved)

    def _at(self, state: FloatArray, place: float) -> FloatArray:
        moved, n = state.copy(), L.NB * self.single.count
        moved[: n : L.NB] += place
        for body in (1, 2):
            moved[n + np.flatnonzero(self.single.active == L.NS * body)] += place
        return moved

    def evaluate(self, y: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Return dy/dt and all forces.

        On the balls (all, 6) and on the bodies (all, 6).
        """
        dydt, bundle = np.full(y.size, np.nan), self.context.bundle
        assert core().evaluate(0.0, y, bundle, dydt, np.zeros(L.power_count(bundle)), 1) == 1
        forces = (bundle.ball_wrenches, bundle.body_wrenches)
        balls, bodies = (each.view(np.float64).reshape(-1, 6).copy() for each in forces)
        return dydt, balls, bodies


def shaft(single: Machine, places: Sequence[float]) -> Shaft:
    """Lay a bearing at each place."""
    return Shaft(single, tuple(places), on_a_shaft(single.context, places))


@pytest.mark.parametrize("name", ["default", "ring-guided cage", "no cage", "other laws"])
@pytest.mark.parametrize("count", [2, 6])
def test_each_bearing_is_loaded_as_if_it_were_alone(name: str, count: int) -> None:
    m = machine(*MODELS[name])
    several, y = shaft(m, [0.0] * count), random_state(m, 3, "sliding")
    alone = m.evaluate(y)
    dydt, balls, bodies = several.evaluate(several.states(*[y] * count))
    assert bodies[SHAFT] == pytest.approx(count * alone.body_forces[0], rel=1e-12, abs=1e-9)
    for i in range(count):
        assert np.array_equal(balls[i * m.count : (i + 1) * m.count], alone.ball_forces)
        assert np.array_equal(bodies[1 + 2 * i : 3 + 2 * i], alone.body_forces[1:])
    assert np.array_equal(dydt[: L.NB * m.count], alone.dydt[: L.NB * m.count])


def test_third_law_across_two_bearings_apart() -> None:
    """Cancel forces and moments on balls and bodies.

    The moments refer to one point.
    """
    m = machine(*MODELS["every body free"], "models.fluid_drag=none", "gravity.z=0 m/s2")
    two = shaft(m, (-0.05, 0.05))
    y = two.states(random_state(m, 1, "rolling"), random_state(m, 2, "sliding"))
    _, balls, bodies = two.evaluate(y)
    states = y[: L.NB * two.balls].reshape(-1, L.NB)
    c, s = np.cos(states[:, L.BPSI]), np.sin(states[:, L.BPSI])
    force = np.array([balls[:, 0], balls[:, 1] * c - balls[:, 2] * s, balls[:, 1] * s + balls[:, 2] * c]).T
    assert np.abs(force).max() > 100.0
    assert np.abs(force.sum(axis=0) + bodies[:, :3].sum(axis=0)).max() < 1e-9 * np.abs(force).sum()


@pytest.mark.parametrize("places", [(0.0, 0.0), (-0.02, 0.02), (-0.2, -0.1, -0.05, 0.05, 0.1, 0.2)], ids=len)
def test_the_jacobian_of_several_bearings(places: tuple[float, ...]) -> None:
    """Compare the Jacobian with differences to 0.3 %.

    Without friction no term is left out, as for one bearing (test_jacobian).
    """
    m = machine(*MODELS["every body free"], "models.cage_contact=none")
    several = shaft(m, places)
    bundle, blocks, scale = several.context.bundle, several.context.blocks, several.context.scale
    y = several.states(*(random_state(m, 4 + i, "rolling") for i in range(len(places))))
    bundle.system[0]["friction_on"] = 0
    several.evaluate(y)
    assert core().jacobian(0.0, y, bundle, blocks) == 1
    exact = np.zeros((y.size, y.size))
    for i in range(y.size):
        step = np.zeros(y.size)
        step[i] = 1e-5 * scale[i]
        slopes = [several.evaluate(y + k * step)[0] for k in (1.0, -1.0, 2.0, -2.0)]
        exact[:, i] = (8.0 * (slopes[0] - slopes[1]) - (slopes[2] - slopes[3])) / (12.0 * step[i])
    ours, exact = (matrix * scale[None, :] / scale[:, None] for matrix in (dense(blocks), exact))
    # A ball that only a film touches has rates of 10 1/s, others of thousands.
    assert np.all(np.abs(ours - exact) < 3e-3 * np.abs(exact).max(axis=1, keepdims=True) + 0.1)


def test_renewed_balls_change_no_more_than_their_part_of_the_jacobian() -> None:
    """Renew the blocks of one bearing at an unchanged state.

    The matrix is the same to rounding: what the bearing gave before is taken away first.
    """
    m = machine(*MODELS["default"])
    several = shaft(m, [0.0, 30e-3])
    y, blocks = several.states(random_state(m, 4, "sliding"), random_state(m, 5, "sliding")), several.context.blocks
    several.evaluate(y)
    assert core().jacobian(0.0, y, several.context.bundle, blocks) == 1
    before = dense(blocks).copy()
    blocks.due[:] = 0
    blocks.due[: m.count] = 1
    assert core().jacobian(0.0, y, several.context.bundle, blocks) == 1
    assert dense(blocks) == pytest.approx(before, rel=1e-9, abs=1e-9 * np.abs(before).max())


def test_the_blocks_of_a_ball_hold_its_own_bodies_alone() -> None:
    """Compare the memory of six bearings and one.

    It is six times as much; only the matrix of the shared states grows faster.
    """
    m = machine(*MODELS["default"])
    one, six = m.context.blocks, shaft(m, [0.0] * 6).context.blocks
    for name in ("a", "b", "c", "parts"):
        assert getattr(six, name).size == 6 * getattr(one, name).size
    assert six.reach.bodies.tolist() == [[SHAFT, 1 + 2 * i, 2 + 2 * i] for i in range(6)]
    assert set(six.reach.width) == {one.d.shape[0]}
    taken = np.unique(np.concatenate(list(six.reach.columns)))
    assert np.array_equal(taken, np.arange(six.d.shape[0]))


@pytest.mark.parametrize("count", [2, 6])
def test_bearings_side_by_side_move_as_one_does(count: int) -> None:
    """Compare balls of parallel bearings with one.

    The shaft has their mass and their load together; to the tolerance.
    """
    m = machine(*MODELS["default"])
    several, y, tolerance, end, n = shaft(m, [0.0] * count), random_state(m, 0, "rolling"), 1e-4, 2e-4, L.NB * m.count
    alone = integrate(m, y, end, tolerance, 1).states[-1, :n]
    tables, start = several.context, several.states(*[y] * count)
    moved = integrate_tables(tables, start, end, tolerance, 1).states[-1]
    for i in range(count):
        assert np.abs((moved[n * i : n * (i + 1)] - alone) / m.context.scale[:n]).max() < 20.0 * tolerance
