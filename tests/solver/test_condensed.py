"""Test the Schur complement of several bearings."""

from __future__ import annotations

import os
import subprocess
import sys

# As plain Python: these functions exist inside their compiled callers only.
PLAIN = """
import numpy as np

from lambda_core.solver.integrator.condensed import condense, solve_condensed
from lambda_core.solver.arrays.factors import make_condensed
from lambda_core.solver.arrays.own_bodies import Reach

NONE, TABLE = np.zeros(0, dtype=np.int64), np.zeros((0, 0), dtype=np.int64)


def reach(positions, middles, ends, speeds, among):
    own = (positions, np.array(middles), np.array(ends), speeds, among)
    return Reach(NONE, NONE, NONE, TABLE, TABLE, NONE, TABLE, TABLE, *own)


# Three bodies: rates of positions have entries at their own body alone, rates of speeds everywhere.
rng = np.random.default_rng(0)
positions, middles, ends, body, begin = [], [], [], [], 0
for number, (p, v) in enumerate(((5, 5), (3, 4), (6, 5))):
    positions += range(begin, begin + p)
    middles += [begin + p] * p
    ends += [begin + p + v] * p
    body += [number] * (p + v)
    begin += p + v
n, at, body = begin, np.array(positions), np.array(body)
speeds = np.setdiff1d(np.arange(n), at)[::-1].copy()
among = np.full(n, -1)
among[speeds] = np.arange(speeds.size)
matrix = np.eye(n) + 0.3 * rng.normal(size=(n, n))
matrix[speeds[:, None], at] *= 1e3  # stiffness times a step squared
own = np.eye(n)[at] + 1e-3 * rng.normal(size=(at.size, n))
matrix[at] = np.where(body[at][:, None] == body[None, :], own, 0.0)
matrix[at[0], at[1] : ends[0] - 1] = 0.0  # a translation: one speed
m, factors, where = matrix.copy(), make_condensed(at.size, speeds.size), reach(at, middles, ends, speeds, among)
assert factors.packed.size == 16 > speeds.size
for _ in range(2):  # nothing is left behind
    m[:, :] = matrix
    assert condense(m, where, factors) == 1
    assert np.any(factors.pivots != np.arange(speeds.size))
for _ in range(2):  # factors are left as they were
    given = rng.normal(size=n)
    found, exact = given.copy(), np.linalg.solve(matrix, given)
    solve_condensed(m, where, factors, found)
    off = np.abs(found - exact).max() / np.abs(exact).max()
    assert off < 1e-10, off

# A position that nothing holds, and speeds that do not differ.
where = reach(np.array([0]), [1], [2], np.array([1]), np.array([-1, 0]))
for matrix in ([[0.0, 1.0], [1.0, 1.0]], [[1.0, 1.0], [1.0, 1.0]]):
    assert condense(np.array(matrix), where, make_condensed(1, 1)) == 0
"""


def test_positions_and_speeds() -> None:
    """Compare condensed and dense solutions to 1e-10.

    A singular matrix is found.
    """
    done = subprocess.run(
        [sys.executable, "-W", "ignore", "-c", PLAIN],
        env=os.environ | {"NUMBA_DISABLE_JIT": "1"},
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr
