"""Compare capacitance laws with Fig. 7 of the paper.

Syla et al. 2026, tables 5 and 6; and the laws of the surroundings.
"""

from __future__ import annotations

import dataclasses
import math
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.special import roots_legendre

from lambda_core.formulas.gap_capacitance import gap_capacitance
from lambda_core.formulas.hertz import hertz_contact
from lambda_core.laws.probe import trial_context
from lambda_core.testing import evaluate

from .oils import BODE_PERMITTIVITY
from .published import Published
from .statics import B6208, STEEL

EPS_0 = 8.8541878128e-12
ETA, ALPHA, T = 0.0973, 20.4e-9, 313.15
# Axial load [N]: contact angles inner/outer [deg] while running at 2750 1/min.
CASES = {700: (13.66, 13.55), 1300: (15.14, 15.06), 2000: (16.37, 16.31)}


def contact(axial: int, inner: bool) -> dict[str, Any]:
    """Return film, ellipse and groups.

    Of one contact, isothermal: permittivity at the largest pressure as in the paper.
    """
    angles = [math.radians(angle) for angle in CASES[axial]]
    angle = angles[0 if inner else 1]
    load = axial / 9.0 / math.sin(angle)
    R_x, R_y = B6208.radii(inner, angle)
    ellipse = hertz_contact(load, R_x, R_y, STEEL)
    u_mean = B6208.mean_velocity(2750.0 * math.pi / 30.0, angle)
    film = evaluate(
        "film_thickness/chittenden",
        u_mean=u_mean,
        cos2=1.0,
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
    """Compare two conventions of the permittivity.

    Over the ellipse the mean of eps_r(p) is 2..4 % below its value at the largest pressure.
    """
    s = (np.arange(2000) + 0.5) / 2000
    pressure = 1.6e9 * np.sqrt(1.0 - s)  # s = (r/R)^2 divides the ellipse into rings of equal area
    eps = evaluate("permittivity/bode", BODE_PERMITTIVITY, p=np.append(pressure, 1.6e9), T=T, rho=870.0)
    assert 0.02 < 1.0 - eps[:-1].mean() / eps[-1] < 0.04


def test_trends_of_figure_7() -> None:
    """Compare trends with Figure 7.

    Area +78.9 % from 700 to 2000 N (paper 78 %), film outer/inner +19.8 % (about 20 %), C_outer -9.7 % (10-14 %).
    """
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
def test_gap_integral_against_schneider(axial: int, inner: bool) -> None:
    """Compare the plain gap with Schneider's fit.

    The gap lies 8 to 20 % below the fit to full solutions.

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
    """Compare a sphere on a flat with a logarithm.

    No ellipse to speak of: 2 pi eps R ln(1 + r^2/(2 R h)) of the paraboloid; 2 % at r = R.
    """
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


def open_contact(R_x: float, R_y: float, radius: float, gap: float) -> float:
    """Return capacitance over eps_0 [m].

    In vacuum, of a ball that touches nothing, as the core computes it.
    """
    return gap_capacitance(gap, R_x, R_y, radius) / EPS_0


def groove_6208(inner: bool) -> tuple[float, float, float, float, float]:
    """Return the 6208's groove [m].

    R_x, R_y, ball radius, groove radius, radius of the raceway at zero contact angle.
    """
    radius, groove, race = 5.955e-3, 6.1932e-3, 0.5 * (48.083e-3 if inner else 71.917e-3)
    R_x = 1.0 / (1.0 / radius + (1.0 if inner else -1.0) / race)
    return R_x, 1.0 / (1.0 / radius - 1.0 / groove), radius, groove, race


@pytest.mark.parametrize("gap", [0.3e-6, 10e-6, 50e-6])
def test_gap_of_an_open_contact_is_the_integral_over_the_balls_projection(gap: float) -> None:
    """Integrate the gap over the ball's projection.

    dA/(h + x^2/(2 R_x) + y^2/(2 R_y)) over a disc, by quadrature in r^2 and the angle; closed form, 1e-6.
    """
    R_x, R_y, radius, _, _ = groove_6208(inner=True)
    nodes, weights = roots_legendre(200)
    reach = math.log1p(radius**2 / (2.0 * R_x * gap))
    grown = np.exp(0.5 * reach * (nodes + 1.0))  # r^2 = 2 R_x h (grown - 1), spread over the decades from gap to edge
    total, angles = 0.0, (np.arange(128) + 0.5) * math.pi / 256.0
    for angle in angles:
        bend = R_x * (np.cos(angle) ** 2 / R_x + np.sin(angle) ** 2 / R_y)
        total += float(np.sum(0.5 * reach * weights * R_x * grown / (1.0 + bend * (grown - 1.0))))
    expected = 2.0 * math.pi / angles.size * total
    assert open_contact(R_x, R_y, radius, gap) == pytest.approx(expected, rel=1e-6)


def plates(inner: bool, gap: float) -> tuple[float, float]:
    """Return the integral of dA/distance [m].

    Between the exact sphere and the exact groove, along the ball's normals.

    Elements of the ball's surface, and of its projection: what the paraboloids stand for, in two readings.
    """
    _, _, radius, groove, race = groove_6208(inner)
    side = -1.0 if inner else 1.0
    centres, ball = race - side * groove, race - side * (radius + gap)
    nodes, weights = roots_legendre(600)
    s = 0.5 * math.log(1e6) * (nodes - 1.0)  # angles from 1e-6 of a right angle on
    theta, width = 0.5 * math.pi * np.exp(s), 0.5 * math.log(1e6) * weights
    surface = projected = 0.0
    for phi in (np.arange(24) + 0.5) * math.pi / 48.0:
        x, t, n = np.sin(theta) * np.sin(phi), np.sin(theta) * np.cos(phi), np.cos(theta)
        low, high = np.full_like(theta, radius), np.full_like(theta, 6.0 * radius)

        def beyond(length: NDArray[np.float64], x: Any = x, t: Any = t, n: Any = n) -> NDArray[np.bool_]:
            """Tell whether a point is behind the groove.

            It is on the ray.
            """
            radial = np.hypot(length * t, ball + side * length * n)
            return np.asarray(np.hypot(radial - centres, length * x) > groove)

        meets = beyond(high)
        for _ in range(70):
            middle = 0.5 * (low + high)
            low, high = np.where(beyond(middle), low, middle), np.where(beyond(middle), middle, high)
        ring = np.where(meets, radius**2 * np.sin(theta) * theta / (high - radius), 0.0) * width
        surface += float(ring.sum())
        projected += float((ring * n).sum())
    return 2.0 * math.pi / 24.0 * surface, 2.0 * math.pi / 24.0 * projected


@pytest.mark.parametrize("gap", [0.3e-6, 1e-6, 10e-6, 50e-6])
@pytest.mark.parametrize("inner", [True, False])
def test_open_contact_lies_between_two_readings_of_the_exact_gap(inner: bool, gap: float) -> None:
    """Compare with the exact sphere in its groove.

    3 to 7 % below by projection, 10 to 39 % above by the ball's surface.
    """
    R_x, R_y, radius, _, _ = groove_6208(inner)
    found = open_contact(R_x, R_y, radius, gap)
    surface, projected = plates(inner, gap)
    assert 0.92 < projected / found < 0.98
    assert 1.08 < surface / found < 1.40


SPHERE_PLANE = [(1e-4, 69.4814, 0.24), (1e-3, 55.0311, 0.30), (1e-2, 40.6929, 0.40)]


@pytest.mark.parametrize(("ratio", "exact", "below"), SPHERE_PLANE)
def test_open_contact_against_the_exact_sphere_before_a_plane(ratio: float, exact: float, below: float) -> None:
    """Compare with Boyer et al. 1994.

    4 pi R sinh a sum 1/sinh(n a), cosh a = 1 + h/R, and their 4 pi R [1 + ln(1 + R/h)/2].

    Ours leaves out the half of the sphere that faces away: in a bearing it faces the other ring.
    """
    a = math.acosh(1.0 + ratio)
    series = 4.0 * math.pi * math.sinh(a) * float(np.sum(1.0 / np.sinh(a * np.arange(1, int(600.0 / a)))))
    Published(exact, "sphere and plane, exact series", "digits", rel=1e-5).check(series)
    near = "Boyer et al. 1994, J. Phys. D 27, 1504, approximation"
    Published(4.0 * math.pi * (1.0 + 0.5 * math.log1p(1.0 / ratio)), near, "stated: 2 %", rel=0.025).check(series)
    found = open_contact(1.0, 1.0, 1.0, ratio)
    assert found == pytest.approx(2.0 * math.pi * math.log1p(0.5 / ratio), rel=1e-12)
    Published(exact, near, "one half of the sphere only", rel=below).check(found)
    assert found < exact


def test_open_contact_meets_the_gap_integral_of_a_contact_without_load() -> None:
    """Compare with a contact of 1 mN.

    Inner ring, its film as the gap: 1 % for the flattened ellipse.
    """
    R_x, R_y, radius, _, _ = groove_6208(inner=True)
    ellipse, film = hertz_contact(1e-3, R_x, R_y, STEEL), 1e-6
    context = dataclasses.replace(trial_context("ball_inner"), ball_diameter=2.0 * radius)
    loaded = evaluate(
        "capacitance/gap-integral",
        context=context,
        C_hertz=EPS_0 * ellipse.area / film,
        h=film,
        semi_a=ellipse.semi_a,
        semi_b=ellipse.semi_b,
        R_x=R_x,
        R_y=R_y,
        U=1e-10,
        G=4700.0,
        W=1e-12,
        eps_r0=1.0,
    )[0]
    assert EPS_0 * open_contact(R_x, R_y, radius, film) == pytest.approx(loaded, rel=0.01)
