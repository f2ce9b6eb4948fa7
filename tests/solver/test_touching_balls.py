"""Test balls that touch each other without a cage."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from lambda_core.solver.arrays import bundle as L
from lambda_core.solver.arrays.jacobian_blocks import AFTER, BEFORE
from lambda_core.solver.drivers.modes import dense

from .support import FloatArray, Machine, jostle, machine, rolling
from .test_jacobian import differences, scaled

_GAMMA = 1e-5  # [s]


def touching(m: Machine, pairs: tuple[int, ...], seed: int = 0) -> FloatArray:
    """Return a state of touching balls.

    Each named ball is pressed by a micrometre onto the one after it.
    """
    state = jostle(m, rolling(m, 100.0), np.random.default_rng(seed), shift=0.1, motion=1e-3)
    d, z = m.model.geometry.ball_diameter, m.count
    state.balls[:, L.BX] = 0.0
    for j in pairs:
        one, other = state.balls[j], state.balls[(j + 1) % z]
        a, b = one[L.BR], other[L.BR]
        apart = np.arccos((a * a + b * b - (d - 1e-6) ** 2) / (2.0 * a * b))
        other[L.BPSI] = one[L.BPSI] + apart
    return m.vector(state)


@pytest.mark.parametrize("pairs", [(3, 4), (8,)])
def test_slopes_of_touching_balls_are_those_of_differences(pairs: tuple[int, ...]) -> None:
    m = machine("depth.cage=false")
    y = touching(m, pairs)
    exact, ours = scaled(m, differences(m, y)), scaled(m, m.jacobian(y))
    of = np.repeat(np.arange(m.count), L.NB)
    neighbour = np.zeros_like(exact, dtype=bool)
    neighbour[: of.size, : of.size] = of[:, None] != of[None, :]
    coupled = {(int(of[i]), int(of[k])) for i, k in zip(*np.nonzero(exact * neighbour), strict=True)}
    assert coupled == {p for j in pairs for p in ((j, (j + 1) % m.count), ((j + 1) % m.count, j))}
    largest = np.abs(exact).max(axis=1, keepdims=True)
    assert np.all(np.abs(ours - exact)[neighbour] < np.broadcast_to(0.01 * largest + 1e-3, exact.shape)[neighbour])
    assert np.linalg.norm((ours - exact)[neighbour]) < 3e-3 * np.linalg.norm(exact[neighbour])


# Runs in a process without Numba's compiler, which would take longer over the elimination than all of this file: the
# functions are the plain ones, and runs of bearings without a cage go through the compiled ones.
PLAIN = """
import sys
import numpy as np
from lambda_core.solver.integrator.arrow import arrow_factor, arrow_solve
from lambda_core.solver.arrays.factors import make_factors
from lambda_core.solver.arrays.jacobian_blocks import Blocks
from lambda_core.solver.arrays.own_bodies import Reach

given = np.load(sys.argv[1])
reach = Reach(*(given[f"reach.{name}"] for name in Reach._fields))
blocks = Blocks(**{name: reach if name == "reach" else given[name] for name in Blocks._fields})
factors = make_factors(reach, blocks.d.shape[0], blocks.cross.shape[0], 9, np.zeros((0, 2), dtype=np.int64))
for cross, right in zip(given["crosses"], given["rights"]):
    blocks.cross[:] = cross
    assert arrow_factor(blocks, 1.0, float(given["gamma"]), factors) == 1
    arrow_solve(blocks, factors, right)
    print(*(float(x).hex() for x in right))
"""
CHAINS = [(), (0,), (2, 3, 4), (7, 8), (0, 1, 3, 8), tuple(range(8)), tuple(range(9))]


def test_chains_of_balls_are_solved_as_one_matrix(tmp_path: Path) -> None:
    """Compare chains of balls with one matrix.

    Random couplings of a size with the balls' own blocks; a ring of all balls is cut where its numbers begin.
    """
    m, rng = machine("depth.cage=false", "bodies.inner_ring.y=free"), np.random.default_rng(1)
    m.jacobian(touching(m, ()))
    blocks = m.context.blocks
    assert not blocks.cross.any()
    crosses, rights, wanted = [], [], []
    for joined in CHAINS:
        blocks.cross[:] = 0.0
        for j in joined:
            for ball, side in ((j, AFTER), ((j + 1) % m.count, BEFORE)):
                blocks.cross[ball, side, 3:] = (
                    rng.uniform(-1.0, 1.0, (6, L.NB)) * 0.3 * np.abs(blocks.a[ball, 3:]).max(axis=0)
                )
        complete = dense(blocks)
        if len(joined) == m.count:
            last = L.NB * (m.count - 1)
            complete[: L.NB, last : last + L.NB] = complete[last : last + L.NB, : L.NB] = 0.0
        wanted.append(rng.uniform(-1.0, 1.0, complete.shape[0]))
        crosses.append(blocks.cross.copy())
        rights.append((np.eye(complete.shape[0]) - _GAMMA * complete) @ wanted[-1])
    arrays = {name: value for name, value in blocks._asdict().items() if name != "reach"}
    arrays |= {f"reach.{name}": value for name, value in blocks.reach._asdict().items()}
    np.savez(tmp_path / "given.npz", crosses=crosses, rights=rights, gamma=_GAMMA, **arrays)
    done = subprocess.run(
        [sys.executable, "-W", "ignore", "-c", PLAIN, str(tmp_path / "given.npz")],
        env=os.environ | {"NUMBA_DISABLE_JIT": "1"},
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    found = [[float.fromhex(word) for word in line.split()] for line in done.stdout.splitlines()]
    for joined, one, expected in zip(CHAINS, found, wanted, strict=True):
        assert one == pytest.approx(list(expected), rel=1e-8, abs=1e-8), joined
