"""Capacitance of the 6208 contacts of Syla et al. 2026 (Fig. 7, Tables 5 and 6) and the laws of its surroundings."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

from lambda_core.physics.hertz import hertz_contact
from lambda_core.registry.probe import trial_context
from lambda_core.testing import evaluate

from .oils import BODE_PERMITTIVITY
from .published import Published
from .statics import B6208, STEEL

EPS_0 = 8.8541878128e-12
ETA, ALPHA, T = 0.0973, 20.4e-9, 313.15
# Axial load [N]: contact angles inner/outer [deg] while running at 2750 1/min.
CASES = {700: (13.66, 13.55), 1300: (15.14, 15.06), 2000: (16.37, 16.31)}


def contact(axial: int, inner: bool) -> dict[str, Any]:
    """Film, ellipse and groups of one contact, isothermal; permittivity at the largest pressure as in the paper."""
    angles = [math.radians(angle) for angle in CASES[axial]]
    angle = angles[0 if inner else 1]
    load = axial / 9.0 / math.sin(angle)
    R_x, R_y = B6208.radii(inner, angle)
    ellipse = hertz_contact(load, R_x, R_y, STEEL)
    u_mean = B6208.mean_velocity(2750.0 * math.pi / 30.0, angle)
    film = evaluate(
        "film_thickness/chittenden",
        u_mean=u_mean,
        theta=0.0,
        load=load,
        R_x=R_x,
        R_y=R_y,
        E_eff=STEEL,
        eta0=ETA,
        alpha_p=ALPHA,
    )[0]
    pressures = np.array([0.0, ellipse.p_max])
    ambient, peak = evaluate("permittivity/bode", BODE_PERMITTIVITY, p=pressures, T=T, rho=870.0)
    return {
        "C_hertz": EPS_0 * float(peak) * ellipse.area / film,
        "h": film,
        "semi_a": ellipse.semi_a,
        "semi_b": ellipse.semi_b,
        "R_x": R_x,
        "R_y": R_y,
        "U": ETA * u_mean / (STEEL * R_x),
        "G": ALPHA * STEEL,
        "W": load / (STEEL * R_x**2),
        "eps_r0": float(ambient),
    }


HAND = "6208 of Syla et al. 2026, 2750 1/min, 40 degC, isothermal, by hand"
INNER = {(700, True): 8.2, (1300, True): 12.1, (2000, True): 15.9}
OUTER = {(700, False): 7.4, (1300, False): 11.0, (2000, False): 14.4}
HERTZ = INNER | OUTER


@pytest.mark.parametrize(("axial", "inner"), HERTZ)
def test_capacitance_of_the_hertzian_area(axial: int, inner: bool) -> None:
    found = contact(axial, inner)["C_hertz"]
    Published(HERTZ[axial, inner], f"{HAND}, pF", "printed digits", rel=0.015).check(1e12 * found)


def test_permittivity_of_the_cells_lowers_it_by_three_percent() -> None:
    """Over the ellipse the mean of eps_r(p) is 2..4 % below its value at the largest pressure (two conventions)."""
    s = (np.arange(2000) + 0.5) / 2000
    pressure = 1.6e9 * np.sqrt(1.0 - s)  # s = (r/R)^2 divides the ellipse into rings of equal area
    eps = evaluate("permittivity/bode", BODE_PERMITTIVITY, p=np.append(pressure, 1.6e9), T=T, rho=870.0)
    assert 0.02 < 1.0 - eps[:-1].mean() / eps[-1] < 0.04


def test_trends_of_figure_7() -> None:
    """Area +78.9 % from 700 to 2000 N (paper 78 %), film outer/inner +19.8 % (about 20 %), C_outer -9.7 % (10-14 %)."""
    light, heavy = contact(700, True), contact(2000, True)
    area = heavy["semi_a"] * heavy["semi_b"] / (light["semi_a"] * light["semi_b"]) - 1.0
    Published(0.789, HAND, "digits; paper 0.78", abs=0.01).check(area)
    inner, outer = contact(1300, True), contact(1300, False)
    Published(0.198, HAND, "digits; paper about 0.20", abs=0.004).check(outer["h"] / inner["h"] - 1.0)
    Published(-0.097, HAND, "digits; paper 0.10..0.14", abs=0.01).check(outer["C_hertz"] / inner["C_hertz"] - 1.0)
    Published(-0.06, HAND, "digits; the paper's -0.09 holds more than the load", abs=0.005).check(
        heavy["h"] / light["h"] - 1.0
    )


FACTORS = {(700, True): 4.6, (2000, True): 3.5, (700, False): 4.9, (2000, False): 3.7}


@pytest.mark.parametrize(("axial", "inner"), FACTORS)
def test_schneider_factor(axial: int, inner: bool) -> None:
    given = contact(axial, inner)
    factor = evaluate("capacitance/schneider", **given)[0] / given["C_hertz"]
    Published(FACTORS[axial, inner], f"Schneider et al. 2021 on the {HAND}", "printed digits", abs=0.06).check(factor)


def test_constant_factor() -> None:
    given = contact(1300, True)
    found = evaluate("capacitance/constant-factor", **given)[0]
    Published(3.5, "Barz 1996", "exact", rel=1e-12).check(found / given["C_hertz"])


@pytest.mark.parametrize(("axial", "inner"), HERTZ)
def test_gap_integral_beside_schneider(axial: int, inner: bool) -> None:
    """Two independent routes to the surroundings: the plain gap lies 8 to 20 % below Schneider's fit to full solutions.

    The difference is the oil's constriction and the outer edge: taken at 1.2 instead of 1 ball radius it is 5 to 17 %.
    """
    given = contact(axial, inner)
    context = trial_context("ball_inner")
    given["C_hertz"] = EPS_0 * given["eps_r0"] * math.pi * given["semi_a"] * given["semi_b"] / given["h"]
    fit = evaluate("capacitance/schneider", context=context, **given)[0]
    for extent, low, high in ((1.0, 0.085, 0.205), (1.2, 0.045, 0.175)):
        plain = evaluate("capacitance/gap-integral", {"extent": extent}, context, **given)[0]
        assert low < 1.0 - plain / fit < high


def test_capacitance_of_two_spheres_without_contact_pressure() -> None:
    """Sphere on flat, no ellipse to speak of: 2 pi eps R ln(1 + r^2/(2 R h)) of the paraboloid; 2 % at r = R."""
    R, h = 6e-3, 2e-6
    ellipse = hertz_contact(1e-3, R, R, STEEL)
    area = EPS_0 * 2.2 * ellipse.area / h
    groups = {"U": 1e-10, "G": 4700.0, "W": 1e-12, "eps_r0": 2.2}
    context = trial_context("ball_inner")
    outer = 0.5 * context.ball_diameter
    found = evaluate(
        "capacitance/gap-integral",
        context=context,
        C_hertz=area,
        h=h,
        semi_a=ellipse.semi_a,
        semi_b=ellipse.semi_b,
        R_x=R,
        R_y=R,
        **groups,
    )[0]
    expected = EPS_0 * 2.2 * 2.0 * math.pi * R * math.log1p(outer**2 / (2.0 * R * h))
    Published(expected, "closed form of the paraboloid", "flattened contact of 1 mN", rel=0.02).check(found)
