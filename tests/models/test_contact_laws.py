"""Test normal contact, damping, film and its thermal factor.

Limits, scaling, smoothness.
"""

from __future__ import annotations

import dataclasses
import math
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from lambda_core.discovery.manager import registry
from lambda_core.domain.plugin_errors import PluginError
from lambda_core.formulas.hertz import hertz_contact
from lambda_core.laws.par import make_par
from lambda_core.laws.probe import trial_context
from lambda_core.testing import assert_increasing, assert_limit, evaluate

CONTACT = trial_context("ball_inner")
RADII: dict[str, Any] = {"R_x": CONTACT.radius_x, "R_y": CONTACT.radius_y, "E_eff": CONTACT.e_eff}
HERTZ = ["hamrock-brewe", "hertz-exact"]


@pytest.mark.parametrize("name", HERTZ)
class TestNormalContact:
    def test_no_load_without_penetration(self, name: str) -> None:
        for delta in (0.0, -1e-6):
            assert np.all(evaluate(f"normal_contact/{name}", delta=delta, **RADII) == 0.0)

    @pytest.mark.parametrize("delta", [1e-300, 1e-30, 1e-12, 1e-3])
    def test_finite_and_positive_at_first_touch_and_deep(self, name: str, delta: float) -> None:
        out = evaluate(f"normal_contact/{name}", delta=delta, **RADII)
        assert np.all(np.isfinite(out))
        assert out[3] > 0.0

    def test_powers_of_penetration(self, name: str) -> None:
        one = evaluate(f"normal_contact/{name}", delta=1e-6, **RADII)
        four = evaluate(f"normal_contact/{name}", delta=4e-6, **RADII)
        assert four / one == pytest.approx([8.0, 2.0, 2.0, 2.0], rel=1e-12)

    def test_pressure_carries_the_load(self, name: str) -> None:
        load, a, b, p = evaluate(f"normal_contact/{name}", delta=5e-6, **RADII)
        assert p == pytest.approx(1.5 * load / (math.pi * a * b), rel=1e-12)

    def test_axes_follow_the_radii(self, name: str) -> None:
        wide = evaluate(f"normal_contact/{name}", delta=5e-6, R_x=5e-3, R_y=0.1, E_eff=2.3e11)
        tall = evaluate(f"normal_contact/{name}", delta=5e-6, R_x=0.1, R_y=5e-3, E_eff=2.3e11)
        assert wide[1] > wide[2]
        assert tall == pytest.approx(wide[[0, 2, 1, 3]], rel=1e-12)

    def test_smooth_through_the_circle(self, name: str) -> None:
        below, at, above = (
            evaluate(f"normal_contact/{name}", delta=5e-6, R_x=5e-3, R_y=5e-3 * ratio, E_eff=2.3e11)
            for ratio in (1.0 - 1e-7, 1.0, 1.0 + 1e-7)
        )
        assert below == pytest.approx(at, rel=1e-6)
        assert above == pytest.approx(at, rel=1e-6)


@settings(max_examples=40, deadline=None)
@given(st.floats(0.0, math.log(1.9e4)), st.floats(1e-8, 5e-5))
def test_exact_model_is_exact_for_every_ratio(log_ratio: float, delta: float) -> None:
    """Compare with Carlson's integrals to 1e-7.

    This is the error of the Chebyshev series.
    """
    R_x, R_y = 5e-3, 5e-3 * math.exp(log_ratio)
    load, a, b, p = evaluate("normal_contact/hertz-exact", delta=delta, R_x=R_x, R_y=R_y, E_eff=2.3e11)
    exact = hertz_contact(load, R_x, R_y, 2.3e11)
    assert [delta, a, b, p] == pytest.approx([exact.approach, exact.semi_a, exact.semi_b, exact.p_max], rel=1e-7)


def test_exact_model_refuses_a_line_contact() -> None:
    with pytest.raises(AssertionError, match="line-contact law"):
        evaluate("normal_contact/hertz-exact", delta=1e-6, R_x=1e-3, R_y=50.0, E_eff=2.3e11)


class TestDamping:
    def test_starts_at_zero_and_is_full_at_full_penetration(self) -> None:
        given = {"load": 1e9, "delta_dot": 0.1, "parameters": {"coefficient": "3000 N s/m"}}
        assert_limit("damping/cubic", "delta", 0.0, 0.0, **given)
        assert_limit("damping/cubic", "delta", 1e-6, 150.0, **given)
        assert_limit("damping/cubic", "delta", 2e-6, 300.0, **given)
        assert_limit("damping/cubic", "delta", 9e-6, 300.0, **given)

    def test_contact_never_pulls(self) -> None:
        given = {"delta": 5e-6, "parameters": {"coefficient": "3000 N s/m"}}
        assert evaluate("damping/cubic", delta_dot=-1.0, load=100.0, **given)[0] == -100.0
        assert evaluate("damping/cubic", delta_dot=-0.01, load=100.0, **given)[0] == pytest.approx(-30.0)

    def test_coefficient_from_the_stiffness_at_the_mean_load(self) -> None:
        """Compare with the slope of the exact contact.

        2 % for the fit of Hamrock and Brewe.
        """
        law = registry().model("damping", "cubic")
        d_max, _ = make_par(law, law.parameters(), CONTACT)
        low, high = (hertz_contact(CONTACT.mean_load * f, *list(RADII.values())) for f in (0.999, 1.001))
        slope = 0.002 * CONTACT.mean_load / (high.approach - low.approach)
        assert d_max == pytest.approx(1e-5 * slope, rel=0.02)

    def test_says_what_is_missing(self) -> None:
        law = registry().model("damping", "cubic")
        with pytest.raises(PluginError, match="finite"):
            make_par(law, law.parameters(), dataclasses.replace(CONTACT, e_eff=math.nan))


FILM: dict[str, Any] = RADII | {"cos2": 1.0, "load": 500.0, "u_mean": 4.0, "eta0": 0.1, "alpha_p": 2e-8}


@pytest.mark.parametrize("name", ["chittenden", "hamrock-dowson"])
class TestFilm:
    def test_exponents(self, name: str) -> None:
        def ratio(**change: float) -> Any:
            label = f"film_thickness/{name}"
            return np.log(evaluate(label, **(FILM | change)) / evaluate(label, **FILM)) / math.log(2.0)

        speed, load, alpha = {
            "chittenden": ([0.68, 0.68], [-0.073, -0.073], [0.49, 0.49]),
            "hamrock-dowson": ([0.67, 0.68], [-0.067, -0.073], [0.53, 0.49]),
        }[name]
        assert ratio(u_mean=8.0) == pytest.approx(speed, abs=1e-4)
        assert ratio(eta0=0.2) == pytest.approx(speed, abs=1e-4)
        assert ratio(load=1000.0) == pytest.approx(load, abs=1e-4)
        assert ratio(alpha_p=4e-8) == pytest.approx(alpha, abs=1e-4)

    def test_minimum_is_below_the_centre(self, name: str) -> None:
        central, minimum = evaluate(f"film_thickness/{name}", **FILM)
        assert 0.0 < minimum < central

    @pytest.mark.parametrize("change", [{"u_mean": 0.0}, {"load": 0.0}, {"alpha_p": 0.0}, {"u_mean": 0.0, "load": 0.0}])
    def test_goes_to_a_floor(self, name: str, change: dict[str, float]) -> None:
        central, minimum = evaluate(f"film_thickness/{name}", **(FILM | change))
        assert 1e-9 <= minimum <= central < 5e-6

    def test_floors_do_not_touch_a_running_film(self, name: str) -> None:
        floors = {"speed_floor": "1e-6 mm/s", "load_floor": "1e-6 N", "film_floor": "1e-9 nm"}
        with_floors = evaluate(f"film_thickness/{name}", **(FILM | {"u_mean": 1.0, "load": 100.0}))
        without = evaluate(f"film_thickness/{name}", floors, **(FILM | {"u_mean": 1.0, "load": 100.0}))
        assert with_floors == pytest.approx(without, rel=1e-4)

    def test_never_falls_with_speed(self, name: str) -> None:
        rest = {key: value for key, value in FILM.items() if key != "u_mean"}
        assert_increasing(f"film_thickness/{name}", "u_mean", np.geomspace(1e-6, 50.0, 30), **rest)


def test_film_along_the_other_axis_is_that_of_the_turned_contact() -> None:
    turned = evaluate("film_thickness/chittenden", **(FILM | {"cos2": 0.0}))
    swapped = evaluate("film_thickness/chittenden", **(FILM | {"R_x": RADII["R_y"], "R_y": RADII["R_x"]}))
    assert turned == pytest.approx(swapped, rel=1e-9)


HEAT: dict[str, Any] = {
    "u_mean": 10.0,
    "u_slide": 0.1,
    "p_max": 1.5e9,
    "E_eff": 2.3e11,
    "eta0": 0.1,
    "beta": 0.05,
    "k_oil": 0.135,
}


@pytest.mark.parametrize("name", ["murch-wilson", "zhu-cheng"])
class TestThermalFactor:
    def test_one_at_rest_and_falling_with_speed(self, name: str) -> None:
        label = f"thermal_correction/{name}"
        assert evaluate(label, **(HEAT | {"u_mean": 0.0}))[0] == 1.0
        factors = [evaluate(label, **(HEAT | {"u_mean": u}))[0] for u in np.geomspace(0.01, 100.0, 20)]
        assert np.all(np.diff(factors) < 1e-15)
        assert 0.0 < factors[-1] < 0.2

    def test_negative_beta_gives_no_thickening(self, name: str) -> None:
        assert evaluate(f"thermal_correction/{name}", **(HEAT | {"beta": -0.01}))[0] == 1.0


def test_sliding_thins_the_film_of_zhu_and_cheng_only() -> None:
    slow, fast = HEAT, HEAT | {"u_slide": 10.0}
    assert evaluate("thermal_correction/zhu-cheng", **fast) < evaluate("thermal_correction/zhu-cheng", **slow)
    assert evaluate("thermal_correction/murch-wilson", **fast) == evaluate("thermal_correction/murch-wilson", **slow)
