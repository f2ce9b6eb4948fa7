"""Test that metal contacts are shorted in all answers."""

from __future__ import annotations

import math

import pytest

from lambda_core import api
from lambda_core.domain.channels import SHORTED
from lambda_core.solver.drivers.equilibrium import solve
from lambda_core.solver.records import CONTACT_CHANNELS

CAPACITANCE, LAMBDA = (CONTACT_CHANNELS.index(name) for name in ("capacitance", "film_parameter"))


@pytest.mark.parametrize("law", ["zhou-hoeprich", "spikes-olver"])
def test_a_slow_bearing_is_shorted_without_time_too(law: str) -> None:
    """Compare Lambda at 1 and 2750 1/min.

    At 1 1/min asperities carry nearly all of the load; at 2750 1/min Lambda is 9 and every contact insulates.
    """
    for speed, shorted in (("1 rpm", True), ("2750 rpm", False)):
        found = solve(api.check("6208-axial-700", (f"operation.speed={speed}", f"models.asperity_load={law}")))
        assert bool((found.contacts[:, :, LAMBDA] < SHORTED).all()) is shorted
        assert bool((found.contacts[:, :, CAPACITANCE] == math.inf).all()) is shorted


def test_the_limit_is_one_percent_of_the_load_on_asperities() -> None:
    """Compare psi(2.03) with 1 %.

    Zhou and Hoeprich 1991 with B = 2.32 and C = 0.97.
    """
    assert math.exp(-2.32 * SHORTED**0.97) == pytest.approx(0.01, rel=0.01)


def test_without_asperities_nothing_is_shorted() -> None:
    found = solve(api.check("6208-axial-700", ("operation.speed=10 rpm", "models.asperity_load=none")))
    assert (found.contacts[:, :, LAMBDA] < SHORTED).all()
    assert (found.contacts[:, :, CAPACITANCE] < math.inf).all()
