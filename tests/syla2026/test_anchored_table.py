"""Test the anchored set on Table 4.

Recovered temperatures, what speaks for them, the range of its loss factor.
"""

from __future__ import annotations

import math

import numpy as np
import pytest
from lambda_syla2026 import anchored_table as T
from lambda_syla2026 import parameters as P
from lambda_syla2026.job_runner import Job, JobResult
from lambda_syla2026.published import LOADS, POINTS, TABLE_4

from lambda_core import api


class Bath:
    """Runner with known temperatures.

    Its SKF torque is the printed row where the oil has the temperatures below.
    """

    TRUE = (63.0, 60.0, 69.0, 64.0, 65.0, 70.0)

    def all(self, jobs: list[Job]) -> list[JobResult]:
        return [JobResult("done", "", "", self.numbers(job)) for job in jobs]

    def numbers(self, job: Job) -> dict[str, float | None]:
        i = next(i for i, point in enumerate(POINTS) if point.case == job.case)
        heat = float(next(c for c in job.changes if c.startswith(T.HEAT)).partition("=")[2].split()[0])
        assert "parameters.fluid_drag.edition=2018" in job.changes
        assert not any(c.startswith("parameters.fluid_drag.v_m") for c in job.changes)
        torque = TABLE_4["SKF"][i] * math.exp(-0.015 * (heat - self.TRUE[i]))
        # Half of it slides with a coefficient that has some boundary friction in it.
        return {"rolling": 0.4 * torque, "drag": 0.1 * torque, "sliding": 0.6 * torque, "sliding coefficient": 0.06}


def test_temperatures_are_those_of_the_printed_skf_row() -> None:
    found = T.recovered(Bath())  # type: ignore[arg-type]
    assert found == pytest.approx(Bath.TRUE, abs=1e-6)


def test_a_row_that_is_a_plane_over_ours_leaves_nothing() -> None:
    plane = np.array([0.8 * point.speed**0.07 * LOADS[point.load] ** -0.1 for point in POINTS])
    assert T.plane_residual(plane) < 1e-9
    bent = plane * np.exp(0.01 * np.array([1.0, -2.0, 1.0, 1.0, -2.0, 1.0]))
    # The bend lies across the plane but for its part along ln n.
    assert 0.5 < T.plane_residual(bent) < 2.1


def test_the_loss_factor_is_sampled_over_its_own_range() -> None:
    low, high = P.entry(T.LOSS).range
    assert float(T._loss(low)) == pytest.approx(T.LOSS_RANGE[0])
    assert float(T._loss(high)) == pytest.approx(T.LOSS_RANGE[1])
    value = next(value for path, value, _ in P.anchored_set() if path == T.LOSS)
    assert T.LOSS_RANGE[0] <= float(str(value)) <= T.LOSS_RANGE[1]


def test_raceways_over_a_bath_are_a_case_of_their_own() -> None:
    """Hold the oil at the bath's temperature.

    Rings and balls find theirs; laws are those of the anchored set.
    """
    model = api.check(POINTS[0].case, P.changes(T._over_bath(63.8)))
    assert model.laws == api.check(POINTS[0].case, P.changes(P.anchored())).laws
    assert model.thermal is not None
    assert model.thermal.nodes["oil"].temperature == pytest.approx(63.8 + 273.15)
