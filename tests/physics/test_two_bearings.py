"""The tables beyond one bearing: two bearings on one shaft, five bodies, two rows, four raceways, made by hand.

A case describes one bearing; compiled code works on tables of any length. Here the tables of one bearing are laid
twice, side by side on one inner body.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import pytest

from lambda_core.domain.arrays import FloatArray
from lambda_core.solver import layout as L
from lambda_core.solver import records as R
from lambda_core.solver.entry import core
from lambda_core.solver.integrator.blocks import make_blocks

from .support import Machine, integrate, integrate_tables
from .test_power import MODELS, machine, random_state

SHAFT, SECOND = 0, 2  # the body that both bearings share, and by how much the other bodies of the second come later
_SIGNALS = 12  # of a body


@dataclass(frozen=True)
class Pair:
    """Two equal bearings whose inner rings are one body, their planes at -distance and +distance of its centre."""

    single: Machine
    bundle: L.Bundle

    @property
    def balls(self) -> int:
        return 2 * self.single.count

    @property
    def scale(self) -> FloatArray:
        """The scales of the states; those of a body from the free states of the single bearing's bodies together."""
        n, own = L.NB * self.single.count, self.single.assembly.scale
        body = np.ones(L.NS)
        body[self.single.active % L.NS] = own[n:]
        return np.concatenate([own[:n], own[:n], np.tile(body, 5)[self.bundle.active]])

    def states(self, first: FloatArray, second: FloatArray) -> FloatArray:
        """Return the state of the pair from those of single bearings; the shaft's is the first one's."""
        z, m = self.single.count, self.single
        shared = np.zeros((5, L.NS))
        shared[:3] = m.state(first).shared
        shared[3:] = m.state(second).shared[1:]
        tail = shared.ravel()[self.bundle.active]
        return np.concatenate([first[: L.NB * z], second[: L.NB * z], tail])

    def evaluate(self, y: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Return dy/dt, the forces on the balls (2 Z, 6) and on the bodies (5, 6)."""
        dydt = np.full(y.size, np.nan)
        assert core().evaluate(0.0, y, self.bundle, dydt, np.zeros(L.power_count(self.bundle)), 1) == 1
        forces = (self.bundle.ball_wrenches, self.bundle.body_wrenches)
        balls, bodies = (each.view(np.float64).reshape(-1, 6).copy() for each in forces)
        return dydt, balls, bodies


def _moved(body: int) -> int:
    """Return the number of a body of the second bearing."""
    return body if body == SHAFT else body + SECOND


def pair(single: Machine, distance: float = 0.0) -> Pair:
    """Lay the tables of a bearing twice; the shaft's own inertia, loads and supports are doubled."""
    old, z = single.assembly.bundle, single.count
    bodies = np.concatenate([old.bodies, old.bodies[1:]])
    for name in ("mass", "transverse_inertia", "polar_inertia", "unbalance", "stiffness", "damping"):
        bodies[name][SHAFT] *= 2.0
    rows, raceways = np.tile(old.rows, 2), np.tile(old.raceways, 2)
    rows["first_ball"], rows["first_raceway"] = (0, z), (0, 2)
    rows["cage"][1] = _moved(int(rows["cage"][1]))
    raceways["number"] = range(4)
    raceways["body"][2:] = [_moved(int(body)) for body in old.raceways["body"]]
    raceways["axial_offset"][[0, 2]] = -distance, distance
    lands = np.tile(old.lands, 2)
    for name in ("cage", "ring"):
        lands[name][old.lands.size :] = [_moved(int(body)) for body in old.lands[name]]
    system = old.system.copy()
    system["balls"] = 2 * z
    others = old.terms[old.terms["signal"] >= _SIGNALS].copy()
    others["signal"] += _SIGNALS * SECOND
    terms = np.concatenate([old.terms, others])
    doubled = (terms["signal"] >= 6) & (terms["signal"] < _SIGNALS)  # forces and moments on the shaft
    for name in ("value", "before", "after", "amplitude"):
        terms[name][doubled] *= 2.0
    active = np.concatenate([old.active, old.active[old.active >= L.NS] + L.NS * SECOND])
    inputs, now, rates = np.zeros(5, R.INPUTS), np.zeros(5, R.BODY_STATE), np.zeros(5, R.BODY_STATE)
    return Pair(
        single,
        old._replace(
            system=system, bodies=bodies, rows=rows, raceways=raceways, lands=lands, terms=terms, active=active,
            inputs=inputs, signals=inputs.view(R.SIGNAL), scratch=np.zeros(1, R.SCRATCH), shared=now.view(np.float64),
            bodies_now=now, shared_rates=rates.view(np.float64), body_rates=rates,
            body_wrenches=np.zeros(5, R.WRENCH), ball_wrenches=np.zeros(2 * z, R.WRENCH),
        ),
    )  # fmt: skip


@pytest.mark.parametrize("name", ["default", "ring-guided cage", "no cage", "other laws"])
def test_each_bearing_is_loaded_as_if_it_were_alone(name: str) -> None:
    m = machine(*MODELS[name])
    two, y = pair(m), random_state(m, 3, "sliding")
    alone = m.evaluate(y)
    dydt, balls, bodies = two.evaluate(two.states(y, y))
    assert np.array_equal(balls[: m.count], alone.ball_forces)
    assert np.array_equal(balls[m.count :], alone.ball_forces)
    assert bodies[SHAFT] == pytest.approx(2.0 * alone.body_forces[0], rel=1e-12, abs=1e-9)
    assert np.array_equal(bodies[3:], alone.body_forces[1:])
    assert np.array_equal(dydt[: L.NB * m.count], alone.dydt[: L.NB * m.count])


def test_third_law_across_two_bearings_apart() -> None:
    """The forces on all balls and bodies cancel, and so do their moments about one point."""
    m = machine(*MODELS["every body free"], "models.fluid_drag=none", "gravity.z=0 m/s2")
    distance = 0.05
    two = pair(m, distance)
    first, second = random_state(m, 1, "rolling"), random_state(m, 2, "sliding")
    for state, sign in ((first, -1.0), (second, 1.0)):
        state[: L.NB * m.count : L.NB] += sign * distance
    y = two.states(first, second)
    for body, sign in ((1, -1.0), (2, -1.0), (3, 1.0), (4, 1.0)):
        y[L.NB * 2 * m.count + np.flatnonzero(two.bundle.active == L.NS * body)] += sign * distance
    _, balls, bodies = two.evaluate(y)
    states = y[: L.NB * 2 * m.count].reshape(-1, L.NB)
    c, s = np.cos(states[:, L.BPSI]), np.sin(states[:, L.BPSI])
    force = np.array([balls[:, 0], balls[:, 1] * c - balls[:, 2] * s, balls[:, 1] * s + balls[:, 2] * c]).T
    assert np.abs(force).max() > 100.0
    assert np.abs(force.sum(axis=0) + bodies[:, :3].sum(axis=0)).max() < 1e-9 * np.abs(force).sum()


@pytest.mark.parametrize("distance", [0.0, 0.02])
def test_the_jacobian_of_two_bearings(distance: float) -> None:
    """Without friction nothing is left out: differences to 0.3 %, as for one bearing (test_jacobian)."""
    m = machine(*MODELS["every body free"], "models.cage_contact=none")
    two, z = pair(m, distance), 2 * m.count
    bundle = two.bundle
    first, second = random_state(m, 4, "rolling"), random_state(m, 5, "rolling")
    for state, sign in ((first, -1.0), (second, 1.0)):
        state[: L.NB * m.count : L.NB] += sign * distance
    y = two.states(first, second)
    for body, sign in ((1, -1.0), (3, 1.0)):
        y[L.NB * z + np.flatnonzero(bundle.active == L.NS * body)] += sign * distance
    scale = two.scale
    bundle.system[0]["friction_on"] = 0
    blocks = make_blocks(z, 5, bundle.active)
    two.evaluate(y)
    assert core().jacobian(0.0, y, bundle, blocks) == 1
    exact = np.zeros((y.size, y.size))
    for i in range(y.size):
        step = np.zeros(y.size)
        step[i] = 1e-5 * scale[i]
        slopes = [two.evaluate(y + k * step)[0] for k in (1.0, -1.0, 2.0, -2.0)]
        exact[:, i] = (8.0 * (slopes[0] - slopes[1]) - (slopes[2] - slopes[3])) / (12.0 * step[i])
    ours = np.zeros_like(exact)
    tail = slice(L.NB * z, None)
    for j in range(z):
        own = slice(L.NB * j, L.NB * (j + 1))
        ours[own, own], ours[own, tail], ours[tail, own] = blocks.a[j], blocks.b[j], blocks.c[j]
    ours[tail, tail] = blocks.d
    ours, exact = (matrix * scale[None, :] / scale[:, None] for matrix in (ours, exact))
    assert np.all(np.abs(ours - exact) < 3e-3 * np.abs(exact).max(axis=1, keepdims=True) + 1e-3)


def test_two_bearings_side_by_side_move_as_one_does() -> None:
    """With a shaft of twice the mass under twice the load, every body moves as in one bearing, to the tolerance."""
    m = machine(*MODELS["default"])
    two, y, tolerance, end, n = pair(m), random_state(m, 0, "rolling"), 1e-4, 2e-4, L.NB * m.count
    alone = integrate(m, y, end, tolerance, 1).states[-1, :n]
    blocks = make_blocks(two.balls, 5, two.bundle.active)
    together = integrate_tables(two.bundle, blocks, two.scale, two.states(y, y), end, tolerance, 1).states[-1]
    for half in (together[:n], together[n : 2 * n]):
        assert np.abs((half - alone) / m.assembly.scale[:n]).max() < 20.0 * tolerance
