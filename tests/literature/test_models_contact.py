"""Test contacts, films and thermal factors against the literature."""

from __future__ import annotations

import math

import numpy as np
import pytest

from lambda_core.testing import evaluate

from .published import Published
from .statics import B6208, STEEL

ANGLE = math.radians(15.09)
SYLA = "6208 inner ring of Syla et al. 2026, Table 6, at 15.09 deg under 554.7 N, by exact elliptic integrals"

EXACT = [
    Published(554.7, SYLA, "rounding of the printed penetration 6.721 um", rel=2e-4),
    Published(1238.7e-6, SYLA, "printed digits", rel=1e-4),
    Published(132.7e-6, SYLA, "printed digits", rel=5e-4),
    Published(1.6107e9, SYLA, "printed digits", rel=1e-4),
]


def test_exact_hertz_of_the_6208() -> None:
    R_x, R_y = B6208.radii(True, ANGLE)
    out = evaluate("normal_contact/hertz-exact", delta=6.721e-6, R_x=R_x, R_y=R_y, E_eff=STEEL)
    for expected, found in zip(EXACT, out, strict=True):
        expected.check(found)


# Harris and Kotzalas, Rolling Bearing Analysis, 5th ed., vol. 1, table 6.1: F(rho), a*, b*, delta*
HARRIS = [
    (0.3204, 1.2623, 0.8114, 0.9761),
    (0.5916, 1.6440, 0.6687, 0.9077),
    (0.7332, 2.011, 0.5881, 0.8394),
    (0.90999, 3.233, 0.4499, 0.6636),
    (0.97290, 5.267, 0.3490, 0.4960),
]


@pytest.mark.parametrize(("F_rho", "a_star", "b_star", "delta_star"), HARRIS)
def test_exact_hertz_meets_the_table_of_dimensionless_numbers(
    F_rho: float, a_star: float, b_star: float, delta_star: float
) -> None:
    """Compare Hertz with a table to 0.2 %.

    a = a* (3 Q/(2 S E))^(1/3) etc. for two equal bodies, S the sum of curvatures; 0.2 % is the table's digits.
    """
    total = 200.0
    R_x, R_y = 2.0 / (total * (1.0 + F_rho)), 2.0 / (total * (1.0 - F_rho))
    load, a, b, _ = evaluate("normal_contact/hertz-exact", delta=5e-6, R_x=R_x, R_y=R_y, E_eff=STEEL)
    scale = (3.0 * load / (total * STEEL)) ** (1.0 / 3.0)
    assert a == pytest.approx(a_star * scale, rel=2e-3)
    assert b == pytest.approx(b_star * scale, rel=2e-3)
    assert delta_star * scale**2 * total / 2.0 == pytest.approx(5e-6, rel=2e-3)


def test_error_of_the_hamrock_brewe_fit_is_the_stated_one() -> None:
    """Compare the fit's error with the published one.

    Ratios of radii 12..60, equal load: pressure -0.2..+1.4 %, a -2.5..+0.5 % (Hamrock and Brewe: within 3 %).
    """
    pressure, major = [], []
    for ratio in np.geomspace(12.0, 60.0, 12):
        fit = evaluate("normal_contact/hamrock-brewe", delta=5e-6, R_x=5e-3, R_y=5e-3 * ratio, E_eff=STEEL)
        exact = evaluate("normal_contact/hertz-exact", delta=5e-6, R_x=5e-3, R_y=5e-3 * ratio, E_eff=STEEL)
        to_load = (fit[0] / exact[0]) ** (1.0 / 3.0)
        pressure.append(fit[3] / exact[3] / to_load - 1.0)
        major.append(fit[1] / exact[1] / to_load - 1.0)
    assert -0.0025 < min(pressure) < max(pressure) < 0.0145
    assert -0.0255 < min(major) < max(major) < 0.0055


# 6208 inner ring, 2750 1/min, 600 N, eta 97.6 mPa s, alpha_p 20.4 1/GPa, radii and speed at zero contact angle.
FILM = [
    (
        "chittenden",
        Published(0.967e-6, "Chittenden et al. 1985 by hand, exponent 0.68 and mean velocity", "digits", rel=1e-3),
    ),
    ("hamrock-dowson", Published(0.995e-6, "Hamrock and Dowson 1977 by hand", "digits", rel=1e-3)),
]


@pytest.mark.parametrize(("name", "expected"), FILM)
def test_film_of_the_6208(name: str, expected: Published) -> None:
    R_x, R_y = B6208.radii(True)
    u_mean = B6208.mean_velocity(2750.0 * math.pi / 30.0)
    given = {"cos2": 1.0, "load": 600.0, "R_x": R_x, "R_y": R_y, "E_eff": STEEL, "eta0": 0.0976, "alpha_p": 20.4e-9}
    expected.check(evaluate(f"film_thickness/{name}", u_mean=u_mean, **given)[0])


def test_misprinted_exponent_and_sum_velocity_would_nearly_double_the_film() -> None:
    """Compute the film with the misprinted exponent.

    Syla et al. 2026 print U^0.67 (eq. 25) and the sum velocity (Table 2): 1.9 times the film; 3 % for the regime.
    """
    R_x, R_y = B6208.radii(True)
    u_mean = B6208.mean_velocity(2750.0 * math.pi / 30.0)
    given = {"cos2": 1.0, "load": 600.0, "R_x": R_x, "R_y": R_y, "E_eff": STEEL, "eta0": 0.0976, "alpha_p": 20.4e-9}
    h = evaluate("film_thickness/chittenden", u_mean=u_mean, **given)[0]
    U = 0.0976 * u_mean / (STEEL * R_x)
    printed = h * (2.0 * U) ** 0.67 / U**0.68
    assert printed / h == pytest.approx(1.9, rel=0.06)


def test_circular_film_coefficient_of_chittenden() -> None:
    """Compare coefficients for R_s = R_e.

    4.31 {1 - exp(-1.23)} = 3.051 in the centre, 3.68 {1 - exp(-0.67)} = 1.797 at the minimum.
    """
    given = {
        "cos2": math.cos(0.3) ** 2,
        "load": 500.0,
        "R_x": 0.01,
        "R_y": 0.01,
        "E_eff": STEEL,
        "eta0": 0.05,
        "alpha_p": 2e-8,
    }
    U, W, G = 0.05 * 5.0 / (STEEL * 0.01), 500.0 / (STEEL * 1e-4), 2e-8 * STEEL
    common = 0.01 * G**0.49 * U**0.68 * W**-0.073
    assert evaluate("film_thickness/chittenden", u_mean=5.0, **given) / common == pytest.approx(
        [3.051, 1.797], rel=1e-3
    )


@pytest.mark.parametrize(("L", "factor"), [(1.0, 0.797565), (10.0, 0.485898), (0.1, 0.942619)])
def test_murch_wilson_closed_form(L: float, factor: float) -> None:
    """Compute 3.94/(3.94 + L^0.62) by hand.

    Three thermal parameters (Murch and Wilson 1975; Syla et al. 2026, eq. 23).
    """
    given = {"u_slide": 0.0, "p_max": 1e9, "E_eff": STEEL, "eta0": 0.1, "beta": 0.05, "k_oil": 0.1}
    u_mean = math.sqrt(L * 0.1 / (0.1 * 0.05))
    assert evaluate("thermal_correction/murch-wilson", u_mean=u_mean, **given)[0] == pytest.approx(factor, rel=1e-5)


def test_zhu_cheng_agrees_with_murch_wilson_in_pure_rolling() -> None:
    """Compare two fits in pure rolling.

    Within 12 % up to L = 5 at 1 GPa without sliding.
    """
    for L in (0.1, 0.5, 1.0, 2.0, 5.0):
        given = {"u_slide": 0.0, "p_max": 1e9, "E_eff": STEEL, "eta0": 0.1, "beta": 0.05, "k_oil": 0.1}
        u_mean = math.sqrt(L * 0.1 / (0.1 * 0.05))
        old, new = (
            evaluate(f"thermal_correction/{n}", u_mean=u_mean, **given)[0] for n in ("murch-wilson", "zhu-cheng")
        )
        assert new == pytest.approx(old, rel=0.12)
