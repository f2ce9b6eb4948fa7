"""Test traction, contact temperature, mixed friction, rolling resistance, hysteresis.

Limits, signs, scaling.
"""

from __future__ import annotations

import dataclasses
import math
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from pydantic import ValidationError

from lambda_core.discovery.manager import registry
from lambda_core.laws.probe import trial_context
from lambda_core.testing import assert_increasing, assert_limit, evaluate

CELL: dict[str, Any] = {"T": 330.0, "ln_eta": math.log(10.0), "h": 1e-6}
TRACTION = ["ree-eyring", "bair-winer", "newtonian"]


@pytest.mark.parametrize("name", TRACTION)
class TestTraction:
    def test_newtonian_at_small_slip(self, name: str) -> None:
        tau = evaluate(f"traction/{name}", slip=1e-6, p=1e9, **CELL)
        assert tau[0] == pytest.approx(10.0 * 1e-6 / 1e-6, rel=1e-4)

    def test_limited_by_a_share_of_the_pressure(self, name: str) -> None:
        p = np.array([0.0, 1e6, 1e9, 3e9])
        tau = evaluate(f"traction/{name}", {"limit_ratio": 0.05}, slip=10.0, p=p, **(CELL | {"ln_eta": 50.0}))
        assert tau == pytest.approx(0.05 * p, abs=1e-3)

    def test_never_falls_with_slip_and_starts_at_zero(self, name: str) -> None:
        slip = np.concatenate([[0.0], np.geomspace(1e-9, 10.0, 400)])
        tau = evaluate(f"traction/{name}", slip=slip, p=1e9, **CELL)
        assert tau[0] == 0.0
        assert np.all(np.diff(tau) >= 0.0)

    @pytest.mark.parametrize("ln_eta", [-18.0, 27.6, 300.0])
    @pytest.mark.parametrize("h", [0.0, 1e-9, 1e-4])
    def test_finite_at_the_ends(self, name: str, ln_eta: float, h: float) -> None:
        slip, p = np.meshgrid([0.0, 1e-12, 1.0, 100.0], [0.0, 1.0, 5e9])
        tau = evaluate(f"traction/{name}", slip=slip.ravel(), p=p.ravel(), T=300.0, ln_eta=ln_eta, h=h)
        assert np.all(np.isfinite(tau))
        assert np.all(tau >= 0.0)
        assert np.all(tau <= 0.065 * p.ravel() + 1e-3)

    def test_slope_is_continuous_in_slip(self, name: str) -> None:
        largest = []
        for step in (4e-3, 1e-3):
            tau = evaluate(f"traction/{name}", slip=np.arange(0.0, 20.0, step), p=1e9, **CELL)
            largest.append(np.max(np.abs(np.diff(tau, 2))))
        assert largest[1] < largest[0] / 10.0


@settings(max_examples=50, deadline=None)
@given(st.floats(-5.0, 20.0), st.floats(1e-6, 10.0), st.floats(2.0, 10.0))
def test_eyring_is_its_closed_form_below_the_limit(ln_eta: float, slip: float, tau_e: float) -> None:
    given = {"tau_eyring": f"{tau_e} MPa", "limit_ratio": 0.3}
    tau = evaluate("traction/ree-eyring", given, slip=slip, p=4e9, T=300.0, ln_eta=ln_eta, h=1e-6)
    expected = 1e6 * tau_e * math.asinh(math.exp(ln_eta) * slip / 1e-6 / (1e6 * tau_e))
    assert tau[0] == pytest.approx(expected, rel=1e-12)


def test_bair_winer_solves_its_own_equation() -> None:
    """Solve the law back from its stress.

    gamma_dot = -(tau_L/eta) ln(1 - tau/tau_L).
    """
    slip = np.geomspace(1e-4, 10.0, 30)
    tau = evaluate("traction/bair-winer", slip=slip, p=1e9, **CELL)
    limit = 0.065e9
    assert -limit / 10.0 * np.log1p(-tau / limit) == pytest.approx(slip / 1e-6, rel=1e-6)


HEAT: dict[str, Any] = {"T_in": 330.0, "u_mean": 8.0, "h": 1e-6, "semi_b": 2e-4}


class TestShearHeating:
    def test_film_and_flash_add_up(self) -> None:
        """Add up temperatures of film and flash.

        Equal bodies: q h/(12 lambda) + 0.376 q sqrt(2 b/(u k rho c)), at high Peclet number.
        """
        context = trial_context("ball_inner")
        steel, oil = context.ball, context.oil
        tau, slip = 50e6, 0.4
        rise = evaluate("contact_temperature/shear-heating", tau=tau, slip=slip, **HEAT)[0] - 330.0
        q = tau * slip
        film = q * 1e-6 / (12.0 * oil.thermal_conductivity)
        band = 2.0 * 2e-4 / (8.0 * steel.thermal_conductivity * steel.density * steel.specific_heat)
        assert rise == pytest.approx(film + 0.3761 * q * math.sqrt(band), rel=1e-4)

    def test_heat_is_shared_by_conduction_through_the_film(self) -> None:
        """Compare a conducting with an insulating film.

        Perfect conduction makes both surfaces equal; insulation splits the heat in halves.
        """
        steel = trial_context("ball_inner")
        ceramic = dataclasses.replace(
            steel.ball, density=3200.0, thermal_conductivity=25.0, specific_heat=720.0, name="Si3N4"
        )
        given = {"tau": 50e6, "slip": 0.4}
        label = "contact_temperature/shear-heating"

        def rise(h: float, ball: Any, ring: Any) -> float:
            context = dataclasses.replace(steel, ball=ball, partner=ring)
            film = 50e6 * 0.4 * h / (12.0 * steel.oil.thermal_conductivity)
            return float(evaluate(label, context=context, **given, **(HEAT | {"h": h}))[0]) - 330.0 - film

        both_steel, both_ceramic = (rise(1e-6, m, m) for m in (steel.ball, ceramic))
        thin, thick = rise(1e-10, ceramic, steel.ball), rise(1e-3, ceramic, steel.ball)
        assert thin == pytest.approx(1.0 / (0.5 / both_steel + 0.5 / both_ceramic), rel=1e-3)
        assert thick == pytest.approx(0.5 * (both_steel + both_ceramic), rel=1e-3)

    def test_linear_in_the_heat_and_the_same_from_both_sides(self) -> None:
        label = "contact_temperature/shear-heating"
        one, two = evaluate(label, tau=np.array([1e7, 2e7]), slip=0.1, **HEAT) - 330.0
        assert two == pytest.approx(2.0 * one)

    @pytest.mark.parametrize(
        "change", [{"u_mean": 0.0}, {"h": 0.0}, {"semi_b": 0.0}, {"u_mean": 1e-9, "semi_b": 1e-12}]
    )
    def test_finite_at_rest_and_without_contact(self, change: dict[str, float]) -> None:
        T = evaluate("contact_temperature/shear-heating", tau=1e8, slip=1e-3, **(HEAT | change))
        assert np.isfinite(T[0])
        assert T[0] >= 330.0

    def test_slower_surfaces_run_hotter(self) -> None:
        T = [
            evaluate("contact_temperature/shear-heating", tau=1e7, slip=0.1, **(HEAT | {"u_mean": u}))[0]
            for u in (0, 1, 10)
        ]
        assert T[0] > T[1] > T[2]


def test_isothermal_keeps_the_inlet_temperature() -> None:
    assert np.all(evaluate("contact_temperature/isothermal", tau=np.full(3, 1e8), slip=1.0, **HEAT) == 330.0)


class TestMixedFriction:
    def test_load_share_runs_from_one_to_zero(self) -> None:
        label = "asperity_load/zhou-hoeprich"
        assert evaluate(label, Lambda=0.0)[0] == 1.0
        assert evaluate(label, Lambda=-1.0)[0] == 1.0
        assert evaluate(label, {"B": 2.0, "C": 1.0}, Lambda=1.0)[0] == pytest.approx(math.exp(-2.0))
        assert evaluate(label, Lambda=1e3)[0] < 1e-100
        assert evaluate("asperity_load/none", Lambda=0.0)[0] == 0.0

    def test_cubic_friction_passes_its_corners(self) -> None:
        slip = np.array([0.0, 0.005, 0.01, 0.055, 0.1, 5.0])
        d = 0.75  # (v + v_s)/(2 v_s) at half of v_s
        rising = -0.12 + 2.0 * 0.12 * d * d * (3.0 - 2.0 * d)
        mu = evaluate("boundary_friction/cubic", slip=slip, p=1e9, u_mean=1.0)
        assert mu == pytest.approx([0.0, rising, 0.12, 0.105, 0.09, 0.09])

    def test_cubic_friction_has_no_kink(self) -> None:
        slip = np.arange(0.0, 0.2, 1e-6)
        slope = np.diff(evaluate("boundary_friction/cubic", slip=slip, p=1e9, u_mean=1.0)) / 1e-6
        assert np.max(np.abs(np.diff(slope))) < 0.01 * np.max(np.abs(slope))

    def test_corners_in_the_wrong_order_are_refused(self) -> None:
        law = registry().model("boundary_friction", "cubic")
        with pytest.raises(ValidationError, match=r"v_d .* must be above v_s"):
            law.parameters.model_validate({"v_s": "0.2 m/s"})

    def test_coulomb(self) -> None:
        label = "boundary_friction/coulomb-regularised"
        assert evaluate(label, slip=0.0, p=1e9, u_mean=1.0)[0] == 0.0
        assert evaluate(label, slip=0.01, p=1e9, u_mean=1.0)[0] == pytest.approx(0.1 / math.sqrt(2.0))
        assert evaluate(label, slip=10.0, p=1e9, u_mean=1.0)[0] == pytest.approx(0.1, rel=1e-6)


ROLLING: dict[str, Any] = {
    "u_mean": 4.0,
    "load": 500.0,
    "semi_a": 1.2e-3,
    "semi_b": 1.3e-4,
    "R_x": 4.8e-3,
    "R_y": 0.157,
    "E_eff": 2.31e11,
    "eta0": 0.1,
    "alpha_p": 2e-8,
    "beta": 0.05,
    "k_oil": 0.135,
}


@pytest.mark.parametrize("name", ["biboulet-houpert", "goksem-hargreaves"])
class TestRollingResistance:
    @pytest.mark.parametrize("change", [{"u_mean": 0.0}, {"load": 0.0}, {"semi_a": 0.0}])
    def test_vanishes_at_rest_and_without_contact(self, name: str, change: dict[str, float]) -> None:
        assert evaluate(f"rolling_resistance/{name}", **(ROLLING | change))[0] == 0.0

    def test_linear_in_the_speed_at_first(self, name: str) -> None:
        one, two = (evaluate(f"rolling_resistance/{name}", **(ROLLING | {"u_mean": u}))[0] for u in (1e-6, 2e-6))
        assert two == pytest.approx(2.0 * one, rel=1e-5)

    @pytest.mark.parametrize(
        "change",
        [
            {"load": 1e-9, "semi_a": 1e-7, "semi_b": 1e-8},
            {"load": 1e6},
            {"u_mean": 200.0},
            {"eta0": 100.0},
            {"alpha_p": 0.0},
        ],
    )
    def test_finite_at_the_ends(self, name: str, change: dict[str, float]) -> None:
        force = evaluate(f"rolling_resistance/{name}", **(ROLLING | change))[0]
        assert math.isfinite(force)
        assert force >= 0.0

    def test_isothermal_without_coefficient(self, name: str) -> None:
        label, fast = f"rolling_resistance/{name}", ROLLING | {"u_mean": 20.0}
        hot = evaluate(label, **fast)[0]
        cold = evaluate(label, {"thermal_coefficient": 0.0}, **fast)[0]
        L = 0.1 * 0.05 * 20.0**2 / 0.135
        assert hot / cold == pytest.approx(1.0 / (1.0 + 0.29 * L**0.78), rel=1e-6)

    def test_grows_with_speed_without_heating(self, name: str) -> None:
        rest = {key: value for key, value in ROLLING.items() if key != "u_mean"}
        assert_increasing(
            f"rolling_resistance/{name}",
            "u_mean",
            np.geomspace(1e-6, 100.0, 40),
            parameters={"thermal_coefficient": 0.0},
            **rest,
        )


def test_strips_sum_up_to_the_integral_over_the_ellipse() -> None:
    """Compare eight points with adaptive quadrature.

    The strip formula of Biboulet-Houpert; 1.2e-3 for the rule.
    """
    from scipy.integrate import quad

    E, R_x, a = ROLLING["E_eff"], ROLLING["R_x"], ROLLING["semi_a"]
    for load, u in ((500.0, 4.0), (5.0, 20.0), (5000.0, 0.05)):
        U2 = 2.0 * 0.1 * u / (E * R_x)

        def strip(s: float, load: float = load, U2: float = U2) -> float:
            W = 0.75 * load / a * (1.0 - s * s) / (E * R_x)
            M = W / math.sqrt(U2)
            return 1.4 * E * R_x * math.sqrt(U2 * W) / (0.985 * (1.0 + (0.966 * math.sqrt(M)) ** 10) ** 0.1)

        expected = 2.0 * a * quad(strip, 0.0, 1.0, epsabs=0.0, epsrel=1e-9, limit=200)[0]
        given = ROLLING | {"load": load, "u_mean": u, "beta": 0.0}
        assert evaluate("rolling_resistance/biboulet-houpert", **given)[0] == pytest.approx(expected, rel=1.2e-3)


SOLID: dict[str, Any] = {"semi_a": 1.2e-3, "semi_b": 1.3e-4, "R_x": 4.8e-3, "R_y": 0.157, "R_ball": 6e-3}


class TestHysteresis:
    def test_loss_factor(self) -> None:
        found = evaluate("elastic_hysteresis/loss-factor", {"loss_factor": 0.02}, load=500.0, **SOLID)
        assert found[0] == pytest.approx(3.0 / 16.0 * 0.02 * 500.0 * 1.3e-4)

    def test_houpert(self) -> None:
        k = 0.157 / 4.8e-3
        expected = 7.4826e-7 * 6e-3**0.33 * 500.0**1.33 * (1.0 - 3.519e-3 * (k - 1.0) ** 0.8063)
        assert evaluate("elastic_hysteresis/houpert", load=500.0, **SOLID)[0] == pytest.approx(expected)

    def test_scheuermann_has_no_default(self) -> None:
        given = {"coefficient": 2e-6, "exponent": 1.5}
        assert evaluate("elastic_hysteresis/scheuermann", given, load=100.0, **SOLID)[0] == pytest.approx(2e-3)
        law = registry().model("elastic_hysteresis", "scheuermann")
        with pytest.raises(ValidationError, match="Field required"):
            law.parameters()

    @pytest.mark.parametrize("name", ["loss-factor", "houpert", "none"])
    def test_vanishes_without_load(self, name: str) -> None:
        assert_limit(f"elastic_hysteresis/{name}", "load", 0.0, 0.0, **SOLID)

    def test_extreme_conformity_does_not_drive(self) -> None:
        assert evaluate("elastic_hysteresis/houpert", load=500.0, **(SOLID | {"R_y": 50.0}))[0] >= 0.0
        assert evaluate("elastic_hysteresis/houpert", load=500.0, **(SOLID | {"R_y": 1e-3}))[0] > 0.0
