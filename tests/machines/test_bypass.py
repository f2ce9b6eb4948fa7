"""Test bearings that rest while another one iterates.

What stands, what is renewed in parts, what it changes of a result.
"""

from __future__ import annotations

import numpy as np
import pytest

from lambda_core.domain.arrays import FloatArray
from lambda_core.model.resolve_machine import resolve_machine
from lambda_core.solver import records as R
from lambda_core.solver.arrays import bundle as L
from lambda_core.solver.core import core
from lambda_core.solver.drivers.machine_motion import MachineEngine, machine_engine
from lambda_core.solver.motion.bearing_sums import AGAIN

from .test_motion import tables

END = 0.015  # [s]


@pytest.fixture(scope="module")
def engine() -> MachineEngine:
    """Return the gearbox shaft in motion.

    The 6206 sets the steps, the 6208 rests between them.
    """
    found = machine_engine(resolve_machine(tables()))
    assert found.advance(END).ok
    return found


def test_what_a_resting_bearing_did_last_stands(engine: MachineEngine) -> None:
    """Keep the last forces of a resting bearing.

    Where only balls of the other one move, forces and powers are the bits of a complete evaluation.
    """
    bundle, y, t = engine.context.bundle, engine._memory.y.copy(), engine.time
    one, other = (bearing.span for bearing in engine.bearings)
    moved = y.copy()
    balls = moved[L.NB * other.first_ball : L.NB * (other.first_ball + other.balls)].view(R.BALL)
    balls["x"] += 1e-7
    balls["spin"] *= 1.0 + 1e-6

    def evaluate(state: FloatArray, want: int, into: FloatArray, powers: FloatArray) -> None:
        assert core().evaluate(t, state, bundle, into, powers, want) == 1

    expected, expected_powers = np.zeros(y.size), np.zeros(L.power_count(bundle))
    evaluate(moved, 1, expected, expected_powers)
    found, powers = np.zeros(y.size), np.zeros(L.power_count(bundle))
    evaluate(y, 1, found, powers)
    assert not np.array_equal(found, expected)
    bundle.bypassed[:] = [1, 0]
    evaluate(moved, AGAIN, found, powers)
    assert np.array_equal(found, expected)
    assert np.array_equal(powers, expected_powers)
    bundle.bypassed[:] = [0, 1]  # what moved is left out
    evaluate(y, AGAIN, found, powers)
    assert np.array_equal(found, expected)
    assert one.first_ball == 0


def test_a_jacobian_in_parts_is_the_complete_one(engine: MachineEngine) -> None:
    """Compare a partly renewed Jacobian.

    The blocks of one ball are renewed: at the same state, and after this ball has moved.
    """
    bundle, blocks, y, t = engine.context.bundle, engine.context.blocks, engine._memory.y.copy(), engine.time
    dydt, powers = np.zeros(y.size), np.zeros(L.power_count(bundle))

    def jacobian(state: FloatArray, balls: list[int]) -> FloatArray:
        assert core().evaluate(t, state, bundle, dydt, powers, 1) == 1
        blocks.due[:] = 0
        blocks.due[balls] = 1
        assert core().jacobian(t, state, bundle, blocks) == 1
        found: FloatArray = blocks.d.copy()
        return found

    everywhere = list(range(blocks.due.size))
    complete, size = jacobian(y, everywhere), np.abs(blocks.d).max()
    assert np.abs(jacobian(y, [3]) - complete).max() < 1e-12 * size
    moved = y.copy()
    moved[3 * L.NB] += 1e-7
    changed = jacobian(moved, [3])
    assert np.abs(changed - complete).max() > 0.0
    assert np.abs(changed - jacobian(moved, everywhere)).max() < 1e-9 * size


def test_factors_of_single_balls_are_those_of_the_complete_row() -> None:
    """Compare factors of single balls with complete rows.

    After partial renewals inverses belong to their blocks, and a row's part of the Schur complement is the sum.
    """
    engine = machine_engine(resolve_machine(tables()))
    assert engine.advance(END).ok
    assert engine.statistics()["ball_jacobians"] > 20.0
    factors, blocks = engine.context.factors, engine.context.blocks
    for r, row in enumerate(engine.context.bundle.rows):
        balls = range(int(row["first_ball"]), int(row["first_ball"] + row["balls"]))
        n, gamma = int(blocks.reach.width[r]), float(factors.gamma[r])
        share = np.zeros((n, n))
        for j in balls:
            assert blocks.newer[j] == 0
            complete = np.eye(L.NB) - gamma * blocks.a[j]
            assert np.abs(factors.inverse[j].T @ complete - np.eye(L.NB)).max() < 1e-7
            across = factors.inverse[j].T @ (-gamma * blocks.b[j][:, :n])
            assert np.allclose(factors.across[j, :n].T, across, rtol=1e-7, atol=1e-9 * np.abs(across).max())
            share += gamma * blocks.c[j, :n] @ across
        assert np.abs(factors.own[r, :n, :n] - share).max() < 1e-9 * np.abs(share).max()


def test_energy_is_balanced_as_well_as_without_it(engine: MachineEngine) -> None:
    """Compare the motion with every bearing evaluated.

    The balance closes, and residuals of the iterations are as small.
    """
    awake = machine_engine(resolve_machine(tables()))
    context = awake.context
    context.bundle.rows["bearing"], context.bundle.bodies["bearing"] = 0, 0
    context.bundle = context.bundle._replace(
        bypassed=np.zeros(1, dtype=np.int64), bearing_powers=np.zeros(1, R.RUNNING)
    )
    awake._handle = context.handle(awake._memory)
    assert awake.advance(END).ok
    counted = engine.statistics()
    assert awake.statistics()["bypasses"] == 0
    assert counted["bypasses"] > 0.1 * counted["newton_iterations"]
    left, ends = [], []
    for found in (engine, awake):
        one = found.integrals()[0]
        losses = sum(value for name, value in one.items() if name.startswith(("loss.", "support")))
        left.append(abs(one["input"] - losses - one["stored"]) / one["input_abs"])
        ends.append(found.statistics()["iteration_work"] / one["input_abs"])
    assert max(left) < 1e-4
    assert ends[0] < 2.0 * ends[1]
