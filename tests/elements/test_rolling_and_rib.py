"""Test rolling resistance of lines, and ribs of tapered rollers."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from lambda_core.elements.roller import rib
from lambda_core.elements.roller.line_film import asperity_share
from lambda_core.elements.roller.rolling import rolling_force, rolling_torque

MODULUS, RADIUS = 226e9, 5e-3
ANGLES = rib.tapered_angles(17e-3, 108.5e-3, math.radians(15.64))
LARGE = 17.83e-3
APEX = 0.5 * LARGE / math.sin(ANGLES.half)
ENDS = pytest.mark.parametrize("face", ["cone", "sphere"])


def force(load: float, speed: float = 5.0, viscosity: float = 0.05) -> float:
    return float(rolling_force(load, RADIUS, speed, viscosity, MODULUS))


def test_the_sum_of_speeds_is_worth_a_factor() -> None:
    """Compare the torque for both definitions of speed.

    The sum of the surface speeds is twice the mean: 2^(3/4) = 1.68 in the torque of loaded contacts.
    """
    assert force(2e5, speed=10.0) / force(2e5) == pytest.approx(2.0**0.75, rel=1e-3)
    # and the value itself: F/(E' R l) = 1.47 U^(3/4) under load, U = 2 eta u/(E' R)
    flow = 2.0 * 0.05 * 5.0 / (MODULUS * RADIUS)
    assert force(2e5) / (MODULUS * RADIUS) == pytest.approx(1.42 / 0.966 * flow**0.75, rel=1e-3)


def test_light_contacts_are_rigid() -> None:
    # sqrt(U W): twice the speed, or twice the load, is worth sqrt(2)
    assert force(20.0, speed=10.0) / force(20.0) == pytest.approx(math.sqrt(2.0), rel=1e-3)
    assert force(40.0) / force(20.0) == pytest.approx(math.sqrt(2.0), rel=1e-3)


@given(load=st.floats(1.0, 1e6), speed=st.floats(1e-3, 50.0))
def test_resistance_grows_with_speed_and_hardly_falls_with_load(load: float, speed: float) -> None:
    assert force(load, speed=1.1 * speed) > force(load, speed=speed)
    assert force(1.1 * load, speed=speed) > 0.99999 * force(load, speed=speed)


def test_slow_and_unloaded_lines_hardly_resist() -> None:
    assert force(0.0) == 0.0
    assert force(1e5, speed=1e-9) < 1e-4 * force(1e5, speed=1.0)


def test_torque_is_the_lost_power() -> None:
    assert rolling_torque(np.array([[1.0, 2.0], [3.0, 4.0]]), 5.0, -200.0) == pytest.approx(2.0 * 10.0 * 5.0 / 200.0)


def test_raceways_meet_the_roller_at_its_mean_diameter() -> None:
    # the roller's axis at half the pitch diameter, its radius from there to either raceway
    along = 0.5 * 108.5e-3 / math.sin(ANGLES.roller)
    assert along * math.tan(ANGLES.half) == pytest.approx(8.5e-3)
    assert ANGLES.inner + 4.0 * 0.5 * ANGLES.half == pytest.approx(ANGLES.outer)


def test_the_roller_rolls_on_both_raceways() -> None:
    # vectors in the plane of axis and roller: roller against outer ring along its generatrix, against inner along its
    relative = -rib.relative_speed(ANGLES, 1.0)
    roller = np.array([1.0, 0.0]) + relative * np.array([math.cos(ANGLES.inner), math.sin(ANGLES.inner)])
    assert roller[1] / roller[0] == pytest.approx(math.tan(ANGLES.outer))
    # orbit and spin about the roller's own axis
    spin = roller[1] / math.sin(ANGLES.roller)
    assert roller[0] - spin * math.cos(ANGLES.roller) == pytest.approx(rib.orbital_ratio(ANGLES))


def test_cylindrical_limit_of_the_relative_speed() -> None:
    # a vanishing taper: omega_rel = omega (D_pw + D_we)/(2 D_we)
    flat = rib.tapered_angles(10e-3, 60e-3, 1e-6)
    assert rib.relative_speed(flat, 1.0) == pytest.approx(3.5, rel=1e-6)
    assert rib.orbital_ratio(flat) == pytest.approx(0.5 * (1.0 - 10.0 / 60.0), rel=1e-6)


@ENDS
@given(height=st.floats(1e-3, 8e-3), share=st.floats(0.5, 0.95))
def test_the_sphere_touches_at_the_height(face: str, height: float, share: float) -> None:
    found = rib.rib_contact(ANGLES, LARGE, share * APEX, height, rib=face)
    centre = 0.5 * LARGE / math.tan(ANGLES.half) - share * APEX
    assert centre * math.sin(ANGLES.half) + share * APEX * math.sin(found.normal) == pytest.approx(height)
    assert found.radius_x > share * APEX  # a concave rib
    assert found.radius_y >= share * APEX * (1.0 - 1e-12)


def test_a_centred_sphere_would_conform() -> None:
    with pytest.raises(ValueError, match="below the rib's radius"):
        rib.rib_contact(ANGLES, LARGE, 1.05 * APEX, 3e-3, rib="sphere")
    with pytest.raises(ValueError, match="does not reach"):
        rib.rib_contact(ANGLES, LARGE, 1e-3, 3e-3)
    with pytest.raises(ValueError, match="rib"):
        rib.rib_contact(ANGLES, LARGE, 0.9 * APEX, 3e-3, rib="flat")


@given(normal=st.floats(-0.1, 0.1))
def test_rib_and_raceways_balance(normal: float) -> None:
    face, inner = rib.rib_load(1000.0, ANGLES, normal)
    wedge = 2.0 * ANGLES.half
    outer = 1000.0 * np.array([math.sin(wedge), -math.cos(wedge)])
    balance = outer + inner * np.array([0.0, 1.0]) - face * np.array([math.cos(normal), math.sin(normal)])
    assert balance == pytest.approx(np.zeros(2), abs=1e-9)


def test_the_rib_slides_in_proportion_to_its_height() -> None:
    low, high = (rib.sliding_speed(ANGLES, 200.0, height) for height in (1e-3, 3e-3))
    assert high == pytest.approx(3.0 * low)
    assert rib.sliding_speed(ANGLES, 200.0, 0.0) == 0.0


@pytest.mark.parametrize(("face", "least", "most"), [("sphere", 1.3, 2.0), ("cone", 0.9, 1.0)])
def test_a_flatter_end_raises_the_film_of_a_spherical_rib(face: str, least: float, most: float) -> None:
    """Compare a spherical with a conical rib.

    On a conical rib the flatter end makes the contact longer, not wider, and oil leaves at its sides.
    """
    films = []
    for share in (0.85, 0.95):
        contact = rib.rib_contact(ANGLES, LARGE, share * APEX, 3e-3, rib=face)
        films.append(rib.rib_film(100.0, contact, rib.rib_entrainment(ANGLES, 200.0, contact), 0.05, 2e-8, MODULUS))
    assert least < films[1] / films[0] < most


@ENDS
def test_the_rib_film_has_its_exponents(face: str) -> None:
    contact = rib.rib_contact(ANGLES, LARGE, 0.85 * APEX, 3e-3, rib=face)
    speed = rib.rib_entrainment(ANGLES, 200.0, contact)

    def film(load: float = 100.0, times: float = 1.0) -> float:
        return rib.rib_film(load, contact, times * speed, 0.05, 2e-8, MODULUS)

    assert film(times=2.0) / film() == pytest.approx(2.0**0.68)
    assert film(load=200.0) / film() == pytest.approx(2.0**-0.073)
    assert speed > 0.5 * rib.sliding_speed(ANGLES, 200.0, 3e-3)


@pytest.mark.parametrize(("speed", "film"), [(0.0508, 0.107e-6), (0.2, 0.223e-6)])
def test_the_film_of_an_ellipse_long_in_sliding_is_that_of_a_numerical_solution(speed: float, film: float) -> None:
    """Compare with an own solution of Reynolds' equation.

    Isothermal, Barus' law, Love's deflections and cavitation, 80 by 40 cells.

    Rib of a 32216, R_x 9 R_y. Fits for ellipses across rolling give twice the film.
    """
    contact = rib.RibContact(3e-3, 0.0, 0.05, 1.965, 0.2188, 0.2188)
    assert rib.rib_film(170.0, contact, speed, 0.0354, 18e-9, MODULUS) == pytest.approx(film, rel=0.2)


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize(("film", "scale", "share"), [(0.9, 1.0, 1.0), (1.4, 1.0, 0.0), (1.4, 0.0, 1.0)])
def test_a_steep_share_of_asperities_is_all_or_nothing(film: float, scale: float, share: float) -> None:
    """Take exponents of any size.

    The power of a film parameter above one overflowed, with a warning of numpy's on the terminal.
    """
    assert asperity_share(np.float64(film), scale, 1e5) == share
