"""Test ratings, lives and axial limits of roller bearings.

Limits, joints and consistency.
"""

from __future__ import annotations

import functools
import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from lambda_core.elements.roller.axial_limit import axial_limit
from lambda_core.elements.roller.roller_life import (
    lamina_equivalent_loads,
    lamina_life,
    modified_lamina_life,
    roller_basic_life,
    stress_riser,
)
from lambda_core.elements.roller.roller_ratings import (
    lamina_ratings,
    roller_dynamic_factor,
    roller_dynamic_rating,
    roller_equivalent_load,
    roller_fatigue_load_limit,
    roller_static_load,
    roller_static_rating,
)
from lambda_core.formulas.life import RADIAL_ROLLER, life_modification_factor

RATING, GAMMA = 60e3, 0.17
roller_factor = functools.partial(life_modification_factor, numbers=RADIAL_ROLLER)
RATINGS = lamina_ratings(RATING, 15, GAMMA, 30)
LOADS = np.outer(np.maximum(np.cos(2.0 * math.pi * np.arange(15) / 15), 0.0), np.full(30, 50.0))


def test_ratings_grow_with_rows_and_rollers() -> None:
    one = roller_dynamic_rating(15, 11e-3, 12e-3, 65e-3)
    assert roller_dynamic_rating(15, 11e-3, 12e-3, 65e-3, rows=2) == pytest.approx(one * 2.0 ** (7.0 / 9.0))
    assert roller_dynamic_rating(30, 11e-3, 12e-3, 65e-3) == pytest.approx(one * 2.0**0.75)
    static = roller_static_rating(15, 11e-3, 12e-3, 65e-3)
    assert roller_static_rating(15, 11e-3, 12e-3, 65e-3, rows=2) == pytest.approx(2.0 * static)


@pytest.mark.parametrize("gamma", [-0.1, 0.0, 1.0])
def test_impossible_geometry_is_refused(gamma: float) -> None:
    with pytest.raises(ValueError, match="between 0 and 1"):
        roller_dynamic_factor(gamma)


def test_the_fatigue_limit_joins_at_100_mm() -> None:
    assert roller_fatigue_load_limit(82e3, 0.1) == pytest.approx(10e3)
    assert roller_fatigue_load_limit(82e3, 0.1000001) == pytest.approx(10e3, rel=1e-6)
    assert roller_fatigue_load_limit(82e3, 0.2) == pytest.approx(10e3 * 0.5**0.3)


@pytest.mark.parametrize("rows", [1, 2])
@given(degrees=st.floats(8.0, 30.0))
def test_the_branches_of_the_equivalent_load_join(rows: int, degrees: float) -> None:
    angle = math.radians(degrees)
    limit = 1.5 * math.tan(angle)
    below, above = (roller_equivalent_load(1e3, share * limit * 1e3, angle, rows) for share in (0.9999, 1.0001))
    assert above.load == pytest.approx(below.load, rel=2e-3)  # 0.67 (1 + 1.5) = 1.675 for 1 + 0.45 * 1.5
    assert above.radial_factor < below.radial_factor


def test_loads_of_cylindrical_bearings_are_radial() -> None:
    assert roller_equivalent_load(1e3, 0.0).load == 1e3
    assert roller_static_load(1e3, 0.0) == 1e3
    with pytest.raises(ValueError, match="compare it with the ribs"):
        roller_equivalent_load(1e3, 100.0)


def test_static_loads_of_two_rows_double() -> None:
    one, two = (roller_static_load(1e3, 5e3, 0.25, rows) for rows in (1, 2))
    assert two == pytest.approx(2.0 * one)
    assert roller_static_load(1e3, 100.0, 0.25) == 1e3


@pytest.mark.parametrize("count", [30, 31, 40])
def test_the_stress_riser_is_even_and_one_in_the_middle(count: int) -> None:
    riser = stress_riser(count)
    assert riser == pytest.approx(riser[::-1])
    assert riser[0] == pytest.approx(1.0 - 0.01 / math.log(1.985 / 2.0))
    assert riser[count // 2] == pytest.approx(1.0, abs=0.004)
    assert np.all(np.diff(riser[: count // 2]) < 0.0)


@given(factor=st.floats(0.1, 10.0))
def test_life_falls_with_the_fourth_power(factor: float) -> None:
    life, loaded = (lamina_life(scale * LOADS, RATINGS, RATING).life for scale in (1.0, factor))
    assert loaded == pytest.approx(life * factor**-4.0)


def test_the_fixed_ring_lives_with_the_steeper_mean() -> None:
    inner, outer = (lamina_life(LOADS, RATINGS, RATING, inner_rotates=turns) for turns in (True, False))
    assert np.all(inner.inner < outer.inner)
    assert np.all(inner.outer > outer.outer)


def test_the_equivalent_load_has_the_life() -> None:
    found = lamina_life(LOADS, RATINGS, RATING)
    assert roller_basic_life(RATING, found.equivalent_load) == pytest.approx(found.life)
    assert roller_basic_life(RATING, 0.0) == math.inf


def test_unloaded_laminae_do_no_damage() -> None:
    ends = LOADS.copy()
    ends[:, :5] = 0.0
    found = lamina_life(ends, RATINGS, RATING)
    assert found.damage[:5].tolist() == [0.0] * 5
    assert found.life > lamina_life(LOADS, RATINGS, RATING).life
    assert lamina_life(np.zeros((15, 30)), RATINGS, RATING).life == math.inf


def test_even_laminae_share_one_equivalent_load() -> None:
    # all alike, half the raceway loaded: the equivalent load of each is the radial load (J_r integrals for 15 rollers)
    found = lamina_life(LOADS, RATINGS, RATING, riser=1.0)
    radial = float(np.sum(np.cos(2.0 * math.pi * np.arange(15) / 15)[:, None] * LOADS))
    assert lamina_equivalent_loads(found, RATING) == pytest.approx(np.full(30, radial), rel=0.02)


def test_the_modified_life_of_even_laminae_has_one_factor() -> None:
    found = lamina_life(LOADS, RATINGS, RATING, riser=1.0)
    factor = roller_factor(2.0, 0.5, 8e3, float(lamina_equivalent_loads(found, RATING)[0]))
    assert modified_lamina_life(found, RATING, 2.0, 0.5, 8e3) == pytest.approx(factor * found.life)


@pytest.mark.parametrize("kappa", [0.4, 1.0])
def test_the_life_factor_is_continuous(kappa: float) -> None:
    # the standard's branches join within its printed digits
    below, above = (roller_factor(kappa * scale, 0.5, 8e3, 5e3) for scale in (1.0 - 1e-9, 1.0))
    assert above == pytest.approx(below, rel=0.003)


@given(kappa=st.floats(0.11, 4.0), share=st.floats(0.01, 5.0))
def test_the_life_factor_grows_with_film_and_limit(kappa: float, share: float) -> None:
    here = roller_factor(kappa, 1.0, share, 1.0)
    assert 0.1 <= here <= 50.0
    assert roller_factor(1.2 * kappa, 1.0, share, 1.0) >= here * 0.997
    assert roller_factor(kappa, 1.0, 1.1 * share, 1.0) >= here
    assert roller_factor(8.0, 1.0, share, 1.0) == roller_factor(4.0, 1.0, share, 1.0)


def test_the_life_factor_begins_at_one_tenth() -> None:
    # the printed digits make the film term -5e-5 there: the factor falls with the fatigue limit, but by 1e-4 only
    assert roller_factor(0.1, 1.0, 5.0, 1.0) == pytest.approx(0.1, rel=1.1e-3)


def test_the_life_factor_refuses_a_lean_film() -> None:
    with pytest.raises(ValueError, match=r"0\.1 and more"):
        roller_factor(0.05, 0.5, 8e3, 5e3)
    assert roller_factor(1.0, 0.5, 8e3, 0.0) == 50.0


NJ_208 = {"bore": 40e-3, "outside": 80e-3, "width": 18e-3, "static_rating": 53e3, "light_series": True}


def test_the_axial_limit_falls_with_speed_and_radial_load() -> None:
    slow, fast = (axial_limit(5e3, speed, **NJ_208) for speed in (100.0, 300.0))
    assert slow.thermal > fast.thermal
    assert axial_limit(10e3, 100.0, **NJ_208).thermal < slow.thermal
    assert axial_limit(5e3, 100.0, oil=False, **NJ_208).thermal < slow.thermal
    assert axial_limit(5e3, 100.0, complement="full", **NJ_208).thermal < slow.thermal
    assert slow.mechanical == fast.mechanical


def test_without_radial_load_rollers_are_not_guided() -> None:
    assert axial_limit(0.0, 100.0, **NJ_208).continuous == 0.0


def test_heat_can_leave_nothing_for_the_axial_load() -> None:
    assert axial_limit(50e3, 2000.0, **NJ_208).thermal == 0.0
    with pytest.raises(ValueError, match="must not be zero"):
        axial_limit(1e3, 0.0, **NJ_208)
