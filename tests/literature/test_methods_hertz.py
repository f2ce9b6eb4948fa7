"""Compare Hertz theory with closed forms and tables."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from lambda_core.formulas.hertz import (
    ball_raceway_radii,
    hertz_contact,
    hertz_shape,
    load_at_pressure,
    reduced_modulus,
    stiffness_constant,
)

from .published import Published
from .reference import hertz_factors, principal_curvatures

STEEL = reduced_modulus(210e9, 0.3, 210e9, 0.3)

# Harris and Kotzalas, Rolling Bearing Analysis, 5th ed., vol. 1, table 6.1: F(rho), a*, b*, delta*
DIMENSIONLESS = [
    (0.1075, 1.0760, 0.9318, 0.9974),
    (0.3204, 1.2623, 0.8114, 0.9761),
    (0.4795, 1.4556, 0.7278, 0.9429),
    (0.5916, 1.6440, 0.6687, 0.9077),
    (0.6716, 1.8258, 0.6245, 0.8733),
    (0.7332, 2.011, 0.5881, 0.8394),
    (0.7948, 2.265, 0.5480, 0.7961),
    (0.83495, 2.494, 0.5186, 0.7602),
    (0.87366, 2.800, 0.4863, 0.7169),
    (0.90999, 3.233, 0.4499, 0.6636),
    (0.93657, 3.738, 0.4166, 0.6112),
    (0.95738, 4.395, 0.3830, 0.5551),
    (0.97290, 5.267, 0.3490, 0.4960),
    (0.983797, 6.448, 0.3150, 0.4352),
    (0.990902, 8.062, 0.2814, 0.3745),
    (0.995112, 10.222, 0.2497, 0.3176),
]


def _dimensionless(curvature_difference: float) -> tuple[float, float, float]:
    """Return a*, b*, delta* from the product.

    Curvature sum 2 per metre, F(rho) given, load and modulus of one.
    """
    across, along = 1.0 / (1.0 - curvature_difference), 1.0 / (1.0 + curvature_difference)
    contact = hertz_contact(1.0, along, across, 1.0)
    unit = (3.0 / 2.0) ** (1.0 / 3.0)  # [3 Q/(2 sum rho) * (2/E')]^(1/3) with sum rho = 2, Q = E' = 1
    delta = contact.approach / (unit**2)  # delta = delta* [..]^(2/3) sum rho/2
    return contact.semi_a / unit, contact.semi_b / unit, delta


@pytest.mark.parametrize(("difference", "a", "b", "delta"), DIMENSIONLESS)
def test_table_of_dimensionless_parameters(difference: float, a: float, b: float, delta: float) -> None:
    source, reason = "Harris and Kotzalas, table 6.1", "four printed digits of an old table, its own errors included"
    computed = _dimensionless(difference)
    for value, number in zip((a, b, delta), computed, strict=True):
        Published(value, source, reason, rel=4e-4).check(number)


@given(st.floats(0.02, 0.99995))
def test_agrees_with_the_classical_route(difference: float) -> None:
    expected = hertz_factors(difference)
    assert _dimensionless(difference) == pytest.approx((expected.a, expected.b, expected.delta), rel=1e-9)


def test_sphere_on_plane() -> None:
    # closed form, Johnson 1985, section 4.2(a): a^3 = 3 P R/(4 E*), delta = a^2/R, p_0 = 3 P/(2 pi a^2)
    load, radius, modulus = 250.0, 6e-3, STEEL / 2.0
    a = (0.75 * load * radius / modulus) ** (1.0 / 3.0)
    contact = hertz_contact(load, radius, radius, STEEL)
    assert contact.semi_a == pytest.approx(a, rel=1e-12)
    assert contact.semi_b == pytest.approx(a, rel=1e-12)
    assert contact.approach == pytest.approx(a**2 / radius, rel=1e-12)
    assert contact.p_max == pytest.approx(1.5 * load / math.pi / a**2, rel=1e-12)


def test_long_ellipse_tends_to_the_line_contact() -> None:
    # Johnson 1985, eq. 4.45: p_0^2 = P' E*/(pi R) with the load per length at the middle, P' = 3 P/(4 a) of an ellipse
    load, radius = 1000.0, 5e-3
    contact = hertz_contact(load, radius, 5e5 * radius, STEEL)
    per_length = 0.75 * load / contact.semi_a
    assert contact.p_max == pytest.approx(math.sqrt(per_length * STEEL / 2.0 / (math.pi * radius)), rel=1e-4)


@pytest.mark.parametrize(
    ("angle", "a", "b", "p_max", "approach"),
    [(15.09, 1238.7, 132.7, 1.6107, 6.721), (0.0, 1239.5, 132.1, 1.6170, 6.727)],
)
def test_6208_inner_contact(angle: float, a: float, b: float, p_max: float, approach: float) -> None:
    # independent solution of the geometry of Syla et al. 2026, table 6, at 554.7 N; all printed digits
    radii = ball_raceway_radii(11.91e-3, 60e-3, 6.19e-3, math.radians(angle), inner=True)
    contact = hertz_contact(554.7, *radii, STEEL)
    assert contact.semi_a * 1e6 == pytest.approx(a, abs=0.05)
    assert contact.semi_b * 1e6 == pytest.approx(b, abs=0.05)
    assert contact.p_max * 1e-9 == pytest.approx(p_max, abs=5e-5)
    assert contact.approach * 1e6 == pytest.approx(approach, abs=5e-4)


@pytest.mark.parametrize(("radius_x", "radius_y"), [(5e-3, 160e-3), (7e-3, 7e-3), (7e-3, 2e-3)])
def test_pressure_integral_and_load_are_the_same(radius_x: float, radius_y: float) -> None:
    load = 731.0
    contact = hertz_contact(load, radius_x, radius_y, STEEL)
    # ellipsoid of pressure by quadrature over the quarter ellipse
    nodes, weights = np.polynomial.legendre.leggauss(80)
    x, weight = 0.5 * (nodes + 1.0), 0.5 * weights
    inner = np.sqrt(1.0 - x**2)  # half width at x, both scaled by the semi-axes
    quarter = sum(w * h**2 * math.pi / 4.0 for w, h in zip(weight, inner, strict=True))
    assert 4.0 * contact.p_max * contact.semi_a * contact.semi_b * quarter == pytest.approx(load, rel=1e-4)


def test_surface_deflection_meets_the_undeformed_shape() -> None:
    """Compare deflection with the gap by Boussinesq.

    The deflection at the centre and at the ends of the axes closes the gap of the two bodies.
    """
    radius_x, radius_y, load = 5e-3, 90e-3, 400.0
    contact = hertz_contact(load, radius_x, radius_y, STEEL)

    def deflection(x: float, y: float) -> float:
        # polar quadrature about the point: the kernel 1/r cancels the Jacobian
        total = 0.0
        for angle in (np.arange(720) + 0.5) * 2.0 * math.pi / 720:
            cosine, sine = math.cos(angle), math.sin(angle)
            # chord of the ellipse through (x, y) along this direction: p^2 = A - 2 B r - C r^2
            c = (cosine / contact.semi_b) ** 2 + (sine / contact.semi_a) ** 2
            b = x * cosine / contact.semi_b**2 + y * sine / contact.semi_a**2
            a = 1.0 - (x / contact.semi_b) ** 2 - (y / contact.semi_a) ** 2
            # int_0^end sqrt(a - 2 b r - c r^2) dr in closed form
            root = math.sqrt(max(a, 0.0) * c + b * b)
            start = math.asin(min(max(b / root, -1.0), 1.0))
            total += (root**2 / c**1.5) * (0.25 * math.pi - 0.5 * start - 0.25 * math.sin(2.0 * start))
        return contact.p_max / (math.pi * STEEL / 2.0) * total * 2.0 * math.pi / 720

    centre = deflection(0.0, 0.0)
    assert centre == pytest.approx(contact.approach, rel=1e-4)
    assert centre - deflection(0.8 * contact.semi_b, 0.0) == pytest.approx(
        (0.8 * contact.semi_b) ** 2 / (2.0 * radius_x), rel=1e-3
    )
    assert centre - deflection(0.0, 0.8 * contact.semi_a) == pytest.approx(
        (0.8 * contact.semi_a) ** 2 / (2.0 * radius_y), rel=2e-3
    )


@given(st.floats(1.0, 1e5), st.floats(1e-3, 20e-3), st.floats(1.0, 300.0))
def test_powers_of_the_load(load: float, radius: float, ratio: float) -> None:
    one, eight = (hertz_contact(q, radius, ratio * radius, STEEL) for q in (load, 8.0 * load))
    assert eight.semi_a == pytest.approx(2.0 * one.semi_a, rel=1e-9)
    assert eight.p_max == pytest.approx(2.0 * one.p_max, rel=1e-9)
    assert eight.approach == pytest.approx(4.0 * one.approach, rel=1e-9)
    assert load_at_pressure(one.p_max, radius, ratio * radius, STEEL) == pytest.approx(load, rel=1e-9)
    stiffness = stiffness_constant(radius, ratio * radius, STEEL)
    assert stiffness * one.approach**1.5 == pytest.approx(load, rel=1e-9)


@given(st.floats(1.0, 1e4))
def test_turned_by_a_right_angle(ratio: float) -> None:
    shape, turned = hertz_shape(1.0, ratio), hertz_shape(ratio, 1.0)
    assert shape.ratio * turned.ratio == pytest.approx(1.0, rel=1e-12)
    assert (shape.first, shape.second) == pytest.approx((turned.first, turned.second), rel=1e-12)


@pytest.mark.parametrize("bad", [(-1.0, 1.0), (1.0, 0.0), (math.inf * 0.0, 1.0)])
def test_conforming_surfaces_are_refused(bad: tuple[float, float]) -> None:
    with pytest.raises(ValueError, match="positive reduced radii"):
        hertz_shape(*bad)


@pytest.mark.parametrize("angle", [0.0, 10.0, 25.0])
@pytest.mark.parametrize("inner", [True, False])
def test_radii_from_the_curvature_of_the_torus(angle: float, inner: bool) -> None:
    """Compare radii with curvatures of the torus.

    Numerical principal curvatures of the groove, with no bearing formula, against the closed form.
    """
    ball, pitch, groove, alpha = 11.91e-3, 60e-3, 6.19e-3 if inner else 6.31e-3, math.radians(angle)
    sign = -1.0 if inner else 1.0
    # ball centre on the pitch circle, contact at the angle; groove centre on the line through both
    centre = np.array([0.0, 0.0, 0.5 * pitch])
    normal = np.array([sign * math.sin(alpha), 0.0, sign * math.cos(alpha)])
    contact = centre + 0.5 * ball * normal
    groove_centre = contact - groove * normal
    # the torus is about the shaft axis; its tube centre may lie off the pitch circle's plane
    shifted = contact - np.array([groove_centre[0], 0.0, 0.0])
    curvatures = principal_curvatures(shifted, float(groove_centre[2]), groove, 4e-6)
    tube = curvatures[int(np.argmin(np.abs(np.abs(curvatures) - 1.0 / groove)))]
    around = curvatures.sum() - tube
    # the distance grows out of the tube: its curvatures are those of a solid tube, the ring is the other side
    radius_x, radius_y = ball_raceway_radii(ball, pitch, groove, alpha, inner=inner)
    assert 2.0 / ball - tube == pytest.approx(1.0 / radius_y, rel=1e-4)
    assert 2.0 / ball - around == pytest.approx(1.0 / radius_x, rel=1e-4)
