"""Test the numbers that an engineer asks for first.

The same as those of the comparison, in the result and its text.
"""

from __future__ import annotations

import pytest

from lambda_core import api
from lambda_core.analysis.rating.engineering import rating_of
from lambda_core.discovery.manager import registry
from lambda_core.results.rating import Rating
from lambda_core.results.run_text import summary_text
from lambda_core.results.text import hours, rating_lines
from lambda_core.solver.drivers.equilibrium import solve

CASE = {
    "name": "motor",
    "bearing": {"designation": "6308 C3", "maker": "SKF"},
    "lubricant": {"name": "FVA3A", "temperature": "70 degC"},
    "loads": {"radial": "2.5 kN", "axial": "0.5 kN"},
    "operation": {"speed": "6000 rpm"},
}
LOCKED = {"bodies": {"inner_ring": {"tilt_y": "locked", "tilt_z": "locked"}}}


@pytest.fixture(scope="module")
def ratings() -> tuple[Rating, Rating]:
    """Return the messages for both tilts.

    With the tilt free and with the tilt locked.
    """
    free, locked = (solve(api.check({**CASE, **more})) for more in ({}, LOCKED))
    return rating_of(free, registry().methods), rating_of(locked, registry().methods)


def test_a_tilted_ring_lives_shorter_and_the_catalogue_does_not_know(ratings: tuple[Rating, Rating]) -> None:
    free, locked = ratings
    assert free.reference_life_h is not None
    assert locked.reference_life_h is not None
    # 4 mrad load more balls, and these harder: the sum of Q^3 decides (ISO/TS 16281, eq. 24-29).
    assert 1.4 < locked.reference_life_h / free.reference_life_h < 1.7
    assert free.basic_life_h == pytest.approx(locked.basic_life_h, rel=1e-2)
    other = api.compare({**CASE, **LOCKED})
    life = other.value("iso-ts-16281", "life", "reference rating life, hours")
    assert locked.reference_life_h == pytest.approx(life, rel=1e-9)
    assert locked.skf_torque_Nmm == pytest.approx(other.value("skf", "friction", "total"), rel=1e-9)


def test_static_safety_is_that_of_the_loads(ratings: tuple[Rating, Rating]) -> None:
    """Compare static safety by hand.

    P_0 = max(0.6 F_r + 0.5 F_a, F_r) = 2.5 kN and a little weight; C_0 = 24 kN (SKF).
    """
    assert ratings[0].static_safety == pytest.approx(24.0 / 2.5, rel=2e-3)
    assert ratings[0].notes == []


def test_a_method_that_is_not_installed_leaves_a_gap() -> None:
    methods = {name: method for name, method in registry().methods.items() if name != "skf"}
    found = rating_of(solve(api.check({**CASE, **LOCKED})), methods)
    assert found.skf_torque_Nmm is None
    assert found.schaeffler_torque_Nmm is not None
    assert not any("SKF" in text for text in rating_lines(found))


def test_lives_are_written_to_two_digits() -> None:
    assert hours(8053.0) == "8 100 h"
    assert hours(3.2e7) == "above 1 000 000 h"


def test_a_run_says_it_first(combined_run: api.Result) -> None:
    summary = combined_run.summary()
    assert summary.rating is not None
    assert summary.power_loss_W is not None
    assert summary.friction_torque_Nmm is not None
    rpm = combined_run["body_spin"][-1, 0]
    assert summary.power_loss_W == pytest.approx(1e-3 * summary.friction_torque_Nmm * rpm, rel=1e-3)
    text = summary_text(summary)
    lines = text.splitlines()
    first = "\n".join(lines[:14])
    for head in ("power loss", "catalogues", "rating life", "safety", "film"):
        assert f"\n{head}" in first
    assert sum("assum" in text for text in lines) <= 2
    assert max(map(len, summary.text(80).splitlines())) <= 80


def test_the_answer_says_why_skf_lies_above_others_under_combined_load(ratings: tuple[Rating, Rating]) -> None:
    """Name the step of SKF's sliding torque.

    It begins with an axial load, which a pure radial load does not have.
    """
    locked, _ = ratings
    without = locked.skf_torque_without_step_Nmm
    assert locked.skf_torque_Nmm is not None
    assert without is not None
    assert without < 0.95 * locked.skf_torque_Nmm
    assert "without its step where an axial load begins" in "\n".join(rating_lines(locked))
    pure = locked.model_copy(update={"skf_torque_without_step_Nmm": None})
    assert "step" not in "\n".join(rating_lines(pure))
