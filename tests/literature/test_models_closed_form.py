"""Test laws whose constants nobody has published.

Numbers of the formulas in print, and what follows exactly.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

from lambda_core.domain.roles import ROLES
from lambda_core.formulas.hertz import hertz_contact
from lambda_core.laws.probe import trial_context
from lambda_core.testing import evaluate

from .published import Published
from .statics import STEEL

EXACT = "rounding"


def test_cubic_damping() -> None:
    """Compare damping with Syla et al. 2026, eq. 12-13.

    Half of d_max at half of delta_max; work of a slow approach d_max v delta_max/2.
    """
    options = {"coefficient": "2000 N s/m", "full_penetration": "4 um"}
    source = "Teutsch 2005 as Syla et al. 2026, eq. 12-13"

    def coefficient(delta: float) -> float:
        return float(evaluate("damping/cubic", options, delta=delta, delta_dot=0.01, load=1e6)[0]) / 0.01

    for delta, share in ((0.0, 0.0), (1e-6, 0.15625), (2e-6, 0.5), (3e-6, 0.84375), (4e-6, 1.0), (1e-5, 1.0)):
        Published(2000.0 * share, source, EXACT, rel=1e-12).check(coefficient(delta))
    steps = (np.arange(400) + 0.5) * 1e-8
    work = sum(coefficient(delta) for delta in steps) * 1e-8
    assert work == pytest.approx(2000.0 * 0.5 * 4e-6, rel=1e-5)


def test_a_blow_rebounds_as_hunt_and_crossley_say() -> None:
    """Compare the rebound with Hunt and Crossley.

    A mass of 0.1 kg on k delta^1.5, struck at 0.1 and 0.2 m/s; terms of second order in alpha v are neglected.
    """
    mass, stiffness, options = 0.1, 1e10, {"alpha": 0.1}
    for speed in (0.1, 0.2):
        delta, velocity, step = 0.0, speed, 5e-7
        while delta >= 0.0:
            load = stiffness * delta**1.5
            damped = float(evaluate("damping/hunt-crossley", options, delta=delta, delta_dot=velocity, load=load)[0])
            velocity -= step * (load + damped) / mass
            delta += step * velocity
        lost = 1.0 + velocity / speed
        Published(0.1 * speed, "Hunt and Crossley 1975, e = 1 - alpha v", "second order", rel=0.03).check(lost)


def test_damping_by_default_is_a_time_times_the_slope_of_hertz() -> None:
    """Compare damping with the slope of Hertz.

    dQ/d(delta) = (3/2) Q/delta of any Hertzian contact; 4 % for the fit of Hamrock and Brewe.
    """
    context = trial_context("ball_inner")
    contact = hertz_contact(context.mean_load, context.radius_x, context.radius_y, context.e_eff)
    found = evaluate("damping/cubic", {"time_constant": "10 us"}, context, delta=1e-3, delta_dot=1.0, load=1e9)[0]
    expected = 10e-6 * 1.5 * context.mean_load / contact.approach
    Published(expected, "Hertz 1881, slope of the exponent 3/2", "fit of the integrals", rel=0.04).check(found)


# L, S, p_0/E': factor by hand from the printed fit.
ZHU_CHENG = [
    (1.0, 0.0, 0.004, 0.780874),
    (1.0, 0.1, 0.004, 0.738122),
    (10.0, 0.0, 0.002, 0.482211),
    (0.1, 0.5, 0.004, 0.882811),
]


@pytest.mark.parametrize(("L", "S", "stress", "factor"), ZHU_CHENG)
def test_zhu_and_chengs_factor(L: float, S: float, stress: float, factor: float) -> None:
    """Compare with Zhu and Cheng's formula.

    [1 - 13.2 (p_0/E') L^0.42]/[1 + 0.213 (1 + 2.23 S^0.83) L^0.64].
    """
    u_mean = math.sqrt(L * 0.1 / (0.1 * 0.05))
    given = {"u_mean": u_mean, "u_slide": S * u_mean, "p_max": stress * STEEL, "E_eff": STEEL}
    found = evaluate("thermal_correction/zhu-cheng", **given, eta0=0.1, beta=0.05, k_oil=0.1)[0]
    Published(factor, "Gupta, Cheng, Zhu et al. 1992, by hand", "digits", rel=2e-5).check(found)


# eta gamma_dot/tau_L: tau/tau_L. Bair and Winer 1979, their dimensionless flow curve 1 - exp(-x).
FLOW_CURVE = [(0.01, 0.0099502), (0.1, 0.0951626), (1.0, 0.6321206), (3.0, 0.9502129), (10.0, 0.9999546)]


@pytest.mark.parametrize(("rate", "stress"), FLOW_CURVE)
def test_bair_and_winers_flow_curve(rate: float, stress: float) -> None:
    eta, film, p = 50.0, 0.4e-6, 1.2e9
    limit = 0.065 * p
    given = {"p": p, "T": 330.0, "ln_eta": math.log(eta), "h": film}
    tau = evaluate("traction/bair-winer", {"limit_ratio": 0.065}, slip=rate * limit * film / eta, **given)[0]
    Published(stress, "Bair and Winer 1979", "digits", rel=1e-5).check(float(tau) / limit)


def test_newtonian_film_is_couette_flow() -> None:
    """Compare with tau = eta v/h.

    Up to 0.9 of the limiting stress; the limit itself is far beyond.
    """
    given = {"p": 1e9, "T": 330.0, "ln_eta": math.log(2.0), "h": 0.5e-6}
    tau = evaluate("traction/newtonian", {"limit_ratio": 0.05}, slip=np.array([0.0, 1e-3, 10.0, 1e3]), **given)
    assert tau == pytest.approx([0.0, 4e3, 40e6, 50e6], rel=1e-12)


def test_isothermal_film_has_the_inlets_temperature() -> None:
    given = {"u_mean": 10.0, "h": 1e-7, "semi_b": 1e-4, "tau": 1e8, "slip": 5.0}
    assert evaluate("contact_temperature/isothermal", T_in=341.5, **given)[0] == 341.5


@pytest.mark.parametrize(("coefficient", "exponent"), [(2.3e-7, 1.4), (1e-6, 1.0)])
def test_scheuermanns_power(coefficient: float, exponent: float) -> None:
    """Compare M = c_r Q^e_r at two loads.

    1 N and 1 kN (Wingertszahn et al. 2023, eq. 19, which prints no constants).
    """
    solid = {"semi_a": 1e-3, "semi_b": 1e-4, "R_x": 5e-3, "R_y": 0.1, "R_ball": 6e-3}
    options = {"coefficient": coefficient, "exponent": exponent}
    for load in (1.0, 1000.0):
        found = evaluate("elastic_hysteresis/scheuermann", options, load=load, **solid)[0]
        assert found == pytest.approx(coefficient * 10.0 ** (exponent * math.log10(load)), rel=1e-12)


# Slip over v_s or, from 1 on, place between v_s and v_d: coefficient by hand from the printed cubic.
TEUTSCH = [(0.0, 0.0), (0.005, 0.0825), (0.01, 0.12), (0.055, 0.105), (0.1, 0.09), (5.0, 0.09)]


@pytest.mark.parametrize(("slip", "mu"), TEUTSCH)
def test_teutschs_cubic_coefficient(slip: float, mu: float) -> None:
    """Compare friction with Teutsch's polynomial.

    mu = h + a d^2 (3 - 2 d). mu_s 0.12 at 0.01 m/s and mu_d 0.09 at 0.1 m/s: 11/16 mu_s at v_s/2.
    """
    found = evaluate("boundary_friction/cubic", slip=slip, p=1e9, u_mean=1.0)[0]
    Published(mu, "Wingertszahn et al. 2023, Lubricants 11, 369, eq. 21", EXACT, rel=1e-12).check(float(found))


@pytest.mark.parametrize(("ratio", "share"), [(0.0, 0.0), (1.0, 0.70710678), (3.0, 0.9486833), (1e3, 0.9999995)])
def test_regularised_coulomb_friction(ratio: float, share: float) -> None:
    found = evaluate(
        "boundary_friction/coulomb-regularised", {"mu": 0.1, "v_0": "10 mm/s"}, slip=0.01 * ratio, p=1e9, u_mean=1.0
    )
    assert found[0] == pytest.approx(0.1 * share, rel=1e-7)


# Where a body that flies off along this direction touches, measured from the place where it is free.
GUIDES = {
    "spherical-pocket": ("ball_cage", (0.6, 0.0, 0.8)),
    "cylindrical-pocket": ("ball_cage", (0.6, 0.0, 0.8)),
    "land-guidance": ("cage_outer", (0.0, 0.6, 0.8)),
    "ball-ball": ("ball_ball", (-0.6, 0.0, -0.8)),
}


@pytest.mark.parametrize("name", GUIDES)
def test_a_blow_against_a_guide_lasts_half_a_period(name: str) -> None:
    """Compare the blow with pi sqrt(m/k).

    A mass on a spring of 5e6 N/m leaves as fast as it came; leapfrog, 4000 steps per blow.
    """
    element, direction = GUIDES[name]
    context, n = trial_context(element), np.array(direction)
    mass, stiffness, speed = 0.01, 5e6, 0.3
    options = {"damping": "0 N s/m", "onset": "1e-4 um", "mu_s": 0.0, "mu_d": 0.0}
    play = {"ball-ball": -context.ball_diameter, "land-guidance": 0.5 * context.land_clearance}
    start = play.get(name, 0.5 * context.pocket_clearance) * n
    rest: Any = np.zeros(3)

    def force(x: float) -> float:
        out = evaluate(f"cage_contact/{name}", options, context, r=start + x * n, v_rel=rest, omega_rel=rest, eta0=0.03)
        return float(out[:3] @ n)

    period = math.pi * math.sqrt(mass / stiffness)
    x, v, time, step = 0.0, speed, 0.0, period / 1000.0
    while x >= 0.0:
        v += 0.5 * step * force(x) / mass
        x += step * v
        v += 0.5 * step * force(x) / mass
        time += step
    Published(period, "mass on a spring", "leapfrog, onset", rel=3e-3).check(time)
    assert v == pytest.approx(-speed, rel=1e-3)


def test_constant_permittivity_is_what_was_given() -> None:
    eps = evaluate("permittivity/constant", {"eps_r": 2.31}, p=np.array([0.0, 3e9]), T=350.0, rho=900.0)
    assert list(eps) == [2.31, 2.31]


def test_bushing_is_hooke_and_newton_along_each_axis() -> None:
    """Compare force and moment exactly, axis by axis.

    F = F_0 - k r - c v and M = -k_t phi - c_t omega.
    """
    options = {
        "stiffness_x": "2 N/um", "stiffness_y": "3 N/um", "damping_z": "40 N s/m", "preload_x": "5 N",
        "tilt_stiffness": "6 N m/mrad", "tilt_damping": "0.7 N m s/rad", "spin_damping": "0.01 N m s/rad",
    }  # fmt: skip
    found = evaluate(
        "force_element/bushing", options, t=3.0, place=[1e-6, 2e-6, 3e-6], tilt=[0.0, 1e-3, -2e-3],
        v_rel=[1.0, 2.0, 3.0], omega_rel=[10.0, 20.0, 30.0],
    )  # fmt: skip
    expected = [5.0 - 2.0, -6.0, -120.0, -0.1, -6.0 - 14.0, 12.0 - 21.0]
    np.testing.assert_allclose(found, expected, rtol=1e-12)


SOLID = {"semi_a": 1e-3, "semi_b": 1e-4, "R_x": 5e-3, "R_y": 0.1}
OIL = {"E_eff": STEEL, "eta0": 0.1, "alpha_p": 2e-8, "beta": 0.05, "k_oil": 0.13}
NOTHING: dict[str, dict[str, Any]] = {
    "damping/none": {"delta": 1e-5, "delta_dot": 0.4, "load": 900.0},
    "rolling_resistance/none": {"u_mean": 9.0, "load": 900.0, **SOLID, **OIL},
    "elastic_hysteresis/none": {"load": 900.0, **SOLID, "R_ball": 6e-3},
    "asperity_load/none": {"Lambda": 0.2},
    "cage_contact/none": {"r": [1e-3, 0.0, 0.0], "v_rel": [1.0, 0.0, 0.0], "omega_rel": [9.0, 0.0, 0.0], "eta0": 0.1},
    "fluid_drag/none": {"v_orbit": 9.0, "omega_spin": 900.0, "azimuth": -1.5, "nu": 1e-4, "rho": 870.0},
    "surface/none": {"azimuth": 0.7, "contact_angle": 0.3},
    "contact_state/none": dict.fromkeys(
        [argument.name for argument in ROLES["contact_state"].arguments if argument.kind == "f"], 1.0
    ),
}


@pytest.mark.parametrize("label", NOTHING)
def test_none_is_nothing(label: str) -> None:
    assert not evaluate(label, **NOTHING[label]).any()


def test_no_thermal_correction_leaves_the_film() -> None:
    given = {"u_mean": 30.0, "u_slide": 3.0, "p_max": 2e9, "E_eff": STEEL, "eta0": 0.1, "beta": 0.05, "k_oil": 0.13}
    assert evaluate("thermal_correction/none", **given)[0] == 1.0


def test_zeros_of_a_chirp() -> None:
    """Compare the turns of a linear sweep.

    From f_0 to f_1 in T it has turned f_0 t + (f_1 - f_0) t^2/(2 T) times; after it, f_1 per second.
    """
    sweep = {"start": "20 Hz", "end": "80 Hz", "duration": "2 s"}
    for turns in (0.0, 0.5, 7.0, 63.5, 100.0):
        t = (math.sqrt(20.0**2 + 2.0 * 30.0 * turns) - 20.0) / 30.0
        value, rate, _ = evaluate("time_function/chirp", sweep, t=t)
        assert abs(value) < 1e-11
        assert rate == pytest.approx(math.cos(2.0 * math.pi * turns) * 2.0 * math.pi * (20.0 + 30.0 * t))
    value, rate, bend = evaluate("time_function/chirp", sweep, t=2.0 + 0.25 / 80.0)
    assert value == pytest.approx(1.0)
    assert bend == pytest.approx(-((2.0 * math.pi * 80.0) ** 2))
    assert abs(rate) < 1e-9
