"""Test the warning about paths that do not converge."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from lambda_core.solver import records as R
from lambda_core.solver.arrays import bundle as L
from lambda_core.solver.drivers.ball_paths import follow_paths
from lambda_core.solver.drivers.viscosity_continuation import StaticReport


def nine() -> Any:
    """Return a context of nine balls.

    The iteration reads it; one row.
    """
    geometry = SimpleNamespace(kind=SimpleNamespace(on_sphere=False), rows=1)
    tables = SimpleNamespace(
        rows=np.array([(L.NB,)], dtype=[("size", int)]), system=np.array([(9 * L.NB,)], dtype=[("tail", int)])
    )
    return SimpleNamespace(
        model=SimpleNamespace(geometry=geometry, rollers=None), bundle=tables, driven=np.zeros(9, dtype=np.int64)
    )


def start() -> Any:
    state = np.zeros(L.NB * 9)
    balls = state.view(R.BALL)
    balls["radius"], balls["velocity"][:, 2] = 0.03, 10.0
    balls["azimuth"] = 2.0 * np.pi * np.arange(9) / 9
    balls["x"] = 1e-5 * np.cos(balls["azimuth"])
    return state


@pytest.mark.parametrize("swing", [True, False], ids=["never settles", "settles"])
def test_an_iteration_that_does_not_settle_says_so(swing: bool, caplog: pytest.LogCaptureFixture) -> None:
    given = nine()
    sign = [1.0]

    def solve(state: Any, driven: Any) -> StaticReport:
        if swing:  # each equilibrium has the opposite path of the one before
            sign[0] = -sign[0]
            balls = state.view(R.BALL)
            balls["x"] = sign[0] * 1e-5 * np.cos(balls["azimuth"])
        return np.zeros(1, dtype=[("orbit", float)])

    follow_paths(given, start(), np.zeros(1, dtype=[("orbit", float)]), solve, lambda state: given.driven)
    told = [record.getMessage() for record in caplog.records]
    assert bool(told) == swing
    assert all("deviate from their paths by" in text for text in told)
