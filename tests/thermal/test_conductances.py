"""Test conductances against limits, quadratures and printed numbers."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.special import erfc, gamma

from lambda_core.analysis.thermal import surroundings
from lambda_core.analysis.thermal.conductances import (
    effusivity,
    exchanged,
    in_series,
    oil_film_coefficient,
    resting_contact,
    resting_line,
    rolling_contact,
    rolling_line,
    wall,
)
from lambda_core.analysis.thermal.heat import strain_shares, surface_shares
from lambda_core.laws.context import Material

STEEL = Material("steel", 208e9, 0.3, 7850.0, 46.0, 475.0)
CERAMIC = Material("Si3N4", 310e9, 0.26, 3200.0, 25.0, 800.0)
E = effusivity(STEEL)
ONCE = np.array([2e-5])  # [s]


def test_two_half_spaces_without_a_film_exchange_as_the_root_of_time() -> None:
    # Carslaw and Jaeger 1959, section 2.5: flux e dT/sqrt(pi t) into a half-space whose surface jumps by dT; two of
    # them in contact meet at the mean by effusivities.
    expected = E * CERAMIC_E / (E + CERAMIC_E) * 2.0 * math.sqrt(ONCE[0] / math.pi)
    assert exchanged(ONCE, 1e11, E, CERAMIC_E)[0] == pytest.approx(expected, rel=1e-3)


CERAMIC_E = effusivity(CERAMIC)


def test_a_poor_film_passes_heat_in_proportion_to_time() -> None:
    assert exchanged(ONCE, 1e3, E, E)[0] == pytest.approx(1e3 * ONCE[0], rel=1e-3)


@pytest.mark.parametrize("film", [3e4, 1e5, 3e5, 3e6])
def test_the_exchanged_heat_is_the_integral_of_the_flux(film: float) -> None:
    rate = film * (1.0 / E + 1.0 / CERAMIC_E)

    def flux(time: float) -> float:
        x = rate * math.sqrt(time)
        return film * math.exp(x * x) * float(erfc(x))

    assert exchanged(ONCE, film, E, CERAMIC_E)[0] == pytest.approx(quad(flux, 0.0, ONCE[0])[0], rel=2e-5)


def test_a_rolling_contact_without_a_film_has_its_closed_form() -> None:
    # u a (e/2) (2/sqrt pi) sqrt(2 b/u) int (1 - x^2)^(1/4) dx, the integral sqrt(pi) Gamma(5/4)/Gamma(7/4) = 1.748
    a, b, u = 1.2e-3, 0.13e-3, 5.0
    integral = math.sqrt(math.pi) * gamma(1.25) / gamma(1.75)
    expected = u * a * E / math.sqrt(math.pi) * math.sqrt(2.0 * b / u) * integral
    assert rolling_contact(a, b, u, 1e12, E, E) == pytest.approx(expected, rel=5e-4)
    assert rolling_contact(a, b, 0.0, 1e12, E, E) == 0.0


def test_a_film_that_insulates_passes_heat_through_the_area() -> None:
    a, b, u, film = 1.2e-3, 0.13e-3, 50.0, 1e3
    assert rolling_contact(a, b, u, film, E, E) == pytest.approx(film * math.pi * a * b, rel=5e-3)


def test_a_contact_at_rest_is_a_constriction_on_both_sides() -> None:
    assert resting_contact(1e-3, 1e-3, 46.0) == pytest.approx(in_series(4.0 * 46.0 * 1e-3, 4.0 * 46.0 * 1e-3))


def test_a_wall_and_a_row() -> None:
    assert wall(0.04, 0.08, 0.02, 50.0) == pytest.approx(2.0 * math.pi * 50.0 * 0.02 / math.log(2.0))
    assert in_series(2.0, 3.0, 6.0) == pytest.approx(1.0)
    assert in_series(2.0, 0.0) == 0.0


def test_oil_along_a_plate() -> None:
    # Re = 4e4, Pr = 125: Nu = 0.332 x 5 x 200 = 332
    assert oil_film_coefficient(4.0, 0.1, 1e-5, 0.14, 125.0) == pytest.approx(332.0 * 0.14 / 0.1)
    assert oil_film_coefficient(0.0, 0.1, 1e-5, 0.14, 125.0) == pytest.approx(0.14 / 0.1)  # still oil conducts


def test_air_on_a_housing() -> None:
    # McAdams: Gr Pr = 9.80665 x 40 x 0.12^3/(313.15 x 1.79e-5^2) x 0.71 = 4.80e6, Nu = 0.53 x 46.8 = 24.8
    assert surroundings.natural_convection(0.12, 333.15, 293.15) == pytest.approx(5.72, rel=3e-3)
    # Churchill and Bernstein at Re = 1e4, Pr = 0.71: 0.3 + 0.62 x 100 x 0.8921/1.1389 x (1 + 0.12405)^0.8 = 53.63
    speed = 1e4 * surroundings.AIR_VISCOSITY / 0.12
    nusselt = surroundings.forced_convection(0.12, speed) * 0.12 / surroundings.AIR_CONDUCTIVITY
    assert nusselt == pytest.approx(53.63, rel=5e-4)
    assert surroundings.radiation(1.0, 300.0, 300.0) == pytest.approx(6.124, rel=1e-3)  # 4 sigma T^3


def test_a_long_shaft_is_two_fins() -> None:
    h, d, k = 20.0, 0.04, 46.0
    one = math.sqrt(h * math.pi * d * k * math.pi * d * d / 4.0)
    assert surroundings.long_fin(d, h, k) == pytest.approx(2.0 * one)


def test_palmgren_area_is_a_cylinder_with_its_ends() -> None:
    d = 0.08
    height, width = 1.5 * d, d
    expected = math.pi * height * width + 2.0 * math.pi / 4.0 * height**2
    assert surroundings.housing_area(d) == pytest.approx(expected)


def test_shares_of_two_bodies() -> None:
    assert surface_shares("a", STEEL, "b", STEEL) == {"a": 0.5, "b": 0.5}
    hybrid = surface_shares("ring", STEEL, "balls", CERAMIC)
    assert hybrid["ring"] == pytest.approx(E / (E + CERAMIC_E))
    assert sum(hybrid.values()) == pytest.approx(1.0)
    soft = strain_shares("ring", STEEL, "balls", CERAMIC)
    assert soft["ring"] > 0.5
    assert sum(soft.values()) == pytest.approx(1.0)


def test_a_line_of_square_shape_has_the_constriction_of_a_square() -> None:
    """Compare a square line with 0.4732.

    By the mean temperature under even flux (Yovanovich); long lines: ln(L/b) + 1/2.
    """
    side = 1e-3
    assert resting_line(side, 0.5 * side, 46.0) == pytest.approx(46.0 * side / (2.0 * 0.4732), rel=1e-4)
    length, half = 10e-3, 0.1e-3
    strip = math.pi * 46.0 * length / (2.0 * (math.log(length / half) + 0.5))
    assert resting_line(length, half, 46.0) == pytest.approx(strip, rel=0.002)


def test_a_line_passes_more_than_the_ellipse_with_its_axes() -> None:
    """Compare a line with an ellipse.

    Every strip of a line takes the time of the ellipse's middle: fast films pass 4/pi as much, by the area.
    """
    line, ellipse = (f(x, 1e-4, 5.0, 1e3, E, E) for f, x in ((rolling_line, 10e-3), (rolling_contact, 5e-3)))
    assert line / ellipse == pytest.approx(4.0 / math.pi, rel=1e-2)
