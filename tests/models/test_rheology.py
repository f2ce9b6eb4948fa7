"""Test laws of viscosity and density, permittivity.

Monotonic, capped, smooth, and units.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from lambda_plugins.generic_oils import TwoPointOil, kinematic_viscosity
from pydantic import ValidationError

from lambda_core.discovery.manager import registry
from lambda_core.domain.plugin_errors import PluginError
from lambda_core.laws.par import make_par
from lambda_core.laws.probe import trial_context
from lambda_core.testing import evaluate

from ..literature.oils import BODE_PERMITTIVITY, REQUIRED, VG100  # noqa: TID252

LAWS = ["rheology/vogel-dicke", "rheology/bode", "rheology/roelands", "rheology/barus-limited"]
CAP = math.log(1e12)


@pytest.mark.parametrize("label", LAWS)
class TestEveryLaw:
    def test_finite_and_bounded_everywhere(self, label: str) -> None:
        p, T = np.meshgrid(np.linspace(-1e8, 1e10, 60), np.linspace(100.0, 1500.0, 60))
        ln_eta, rho = evaluate(label, REQUIRED[label], p=p.ravel(), T=T.ravel())
        assert np.all(np.isfinite(ln_eta))
        assert np.all((ln_eta >= -18.0) & (ln_eta <= CAP + 1e-12))
        assert np.all((rho > 500.0) & (rho < 2000.0))

    def test_stiffens_with_pressure_and_thins_with_temperature(self, label: str) -> None:
        p = np.linspace(0.0, 4e9, 400)
        for T in (253.15, 313.15, 373.15, 473.15):
            ln_eta, rho = evaluate(label, REQUIRED[label], p=p, T=T)
            assert np.all(np.diff(ln_eta) >= 0.0)
            assert np.all(np.diff(rho) > 0.0)
        T = np.linspace(253.15, 473.15, 200)
        for pressure in (0.0, 1e8, 5e8):
            ln_eta, rho = evaluate(label, REQUIRED[label], p=pressure, T=T)
            assert np.all(np.diff(ln_eta) < 0.0)
            assert np.all(np.diff(rho) < 0.0)

    def test_no_kinks(self, label: str) -> None:
        """Compare second differences at a fourth of the step.

        1/16 is left where the slope is continuous, 1/4 at a kink.
        """
        largest = []
        for step in (4e4, 1e4):
            ln_eta, _ = evaluate(label, REQUIRED[label], p=np.arange(0.0, 4e9, step), T=313.15)
            largest.append(np.max(np.abs(np.diff(ln_eta, 2))))
        assert largest[1] < largest[0] / 10.0

    def test_temperature_is_held_at_the_ends(self, label: str) -> None:
        ln_eta, rho = evaluate(label, REQUIRED[label], p=1e8, T=np.array([573.15, 900.0, 223.15, 150.0]))
        assert ln_eta[0] == ln_eta[1]
        assert rho[0] == rho[1]
        assert ln_eta[2] == pytest.approx(ln_eta[3])


def test_cap_is_reached_by_the_published_bode_oil_before_its_pole() -> None:
    ln_eta, _ = evaluate("rheology/bode", REQUIRED["rheology/bode"], p=np.array([2.2e9, 2.35e9, 4e9]), T=313.15)
    assert ln_eta == pytest.approx([CAP, CAP, CAP])


@settings(max_examples=60, deadline=None)
@given(st.floats(5.0, 700.0), st.floats(2.5, 4.2), st.floats(236.0, 570.0))
def test_polynomial_follows_walther(nu_40: float, slope: float, T: float) -> None:
    """Compare the polynomial with Walther to 1e-5.

    Of the viscosity; the slope is 3.3..3.9 for mineral oils, down to 2.7 for polyglycols.
    """
    level = math.log10(math.log10(nu_40 + 0.7)) - slope * math.log10(373.15 / 313.15)
    nu_100 = 10.0 ** (10.0**level) - 0.7
    given = {"kinematic_viscosity_40": f"{nu_40} mm2/s", "kinematic_viscosity_100": f"{nu_100} mm2/s"}
    oil = TwoPointOil.model_validate(VG100 | given)
    eta = float(kinematic_viscosity(oil, np.array(T))) * (885.0 - 0.57 * (T - 288.15))
    ln_eta, _ = evaluate("rheology/barus-limited", oil.model_dump(mode="json"), p=0.0, T=T)
    assert ln_eta[0] == pytest.approx(min(max(math.log(eta), -18.0), CAP), abs=1e-5)


def test_roelands_is_its_closed_form() -> None:
    T, p = 343.15, np.linspace(0.0, 1.2e9, 7)
    oil = TwoPointOil.model_validate(VG100)
    eta_40 = 1e-4 * (885.0 - 0.57 * 25.0)
    eta = float(kinematic_viscosity(oil, np.array(T))) * (885.0 - 0.57 * 55.0)
    Z = math.log1p(18.78e-9 * 2e8 / (math.log(eta_40) + 9.67)) / math.log1p(5.1e-9 * 2e8)
    expected = math.log(eta) + (math.log(eta) + 9.67) * ((1.0 + 5.1e-9 * p) ** Z - 1.0)
    ln_eta, _ = evaluate("rheology/roelands", VG100, p=p, T=T)
    assert ln_eta == pytest.approx(expected, abs=2e-5)


@pytest.mark.parametrize(
    ("name", "more", "span"),
    [("barus-limited", {}, 1e4), ("roelands", {}, 2e8), ("roelands", {"alpha_span": "0 MPa"}, 1e4)],
)
def test_pressure_viscosity_coefficient_is_the_given_one(name: str, more: dict[str, Any], span: float) -> None:
    ln_eta, _ = evaluate(f"rheology/{name}", VG100 | more, p=np.array([0.0, span]), T=313.15)
    assert np.diff(ln_eta)[0] / span == pytest.approx(18.78e-9, rel=1e-4)


def test_barus_exponent_is_limited() -> None:
    ambient, _ = evaluate("rheology/barus-limited", VG100, p=0.0, T=313.15)
    deep, _ = evaluate("rheology/barus-limited", VG100 | {"exponent_limit": 10.0}, p=3e9, T=313.15)
    assert deep[0] - ambient[0] == pytest.approx(10.0)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"kinematic_viscosity_100": "120 mm2/s"}, "below"),
        ({"kinematic_viscosity_40": 100.0}, "has no unit"),
        ({"density_15": "885"}, "has no unit"),
        ({"alpha_q": "1 1/GPa"}, "Extra inputs"),
    ],
)
def test_bad_oil_is_refused_in_words(change: dict[str, Any], message: str) -> None:
    with pytest.raises(ValidationError, match=message):
        TwoPointOil.model_validate(VG100 | change)


def test_impossible_constants_are_refused_in_words() -> None:
    context = trial_context("ball_inner")
    roelands, bode = registry().model("rheology", "roelands"), registry().model("rheology", "bode")
    with pytest.raises(PluginError, match="Roelands' Z"):
        make_par(roelands, roelands.parameters.model_validate(VG100 | {"alpha_p": "90 1/GPa"}), context)
    with pytest.raises(PluginError, match="positive density"):
        make_par(bode, bode.parameters.model_validate(REQUIRED["rheology/bode"] | {"a2": 1000.0}), context)


def test_permittivity_grows_with_pressure_and_does_not_depend_on_the_rheology_next_to_it() -> None:
    p = np.linspace(0.0, 2e9, 50)
    light = evaluate("permittivity/bode", BODE_PERMITTIVITY, p=p, T=313.15, rho=800.0)
    heavy = evaluate("permittivity/bode", BODE_PERMITTIVITY, p=p, T=313.15, rho=1100.0)
    assert np.all(np.diff(light) > 0.0)
    assert np.array_equal(light, heavy)


def test_constant_permittivity() -> None:
    found = evaluate("permittivity/constant", {"eps_r": 3.2}, p=np.array([0.0, 2e9]), T=350.0, rho=900.0)
    assert np.array_equal(found, [3.2, 3.2])
