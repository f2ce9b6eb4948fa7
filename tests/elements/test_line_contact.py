"""Test line contact and profiles of rollers."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.integrate import quad

from lambda_core.elements.roller import line_contact, profiles
from lambda_core.elements.roller.slices import slice_positions

MODULUS = 226e9
LENGTH, DIAMETER = 12e-3, 11e-3


@given(load=st.floats(1e3, 1e6), radius=st.floats(1e-3, 0.1))
def test_hertz_pressure_carries_the_load(load: float, radius: float) -> None:
    width = float(line_contact.half_width(load, radius, MODULUS))
    peak = float(line_contact.peak_pressure(load, radius, MODULUS))
    assert 0.5 * math.pi * width * peak == pytest.approx(load, rel=1e-12)


def test_the_finite_line_has_the_deflection_of_its_pressure() -> None:
    # the middle of a strip with Hertz's pressure across, integrated: u = 2/(pi E') int p/r dA for both bodies
    load, radius = 2000.0, 5e-3
    width = float(line_contact.half_width(load / LENGTH, radius, MODULUS))

    def line(angle: float) -> float:
        return math.cos(angle) ** 2 * 2.0 * math.asinh(0.5 * LENGTH / (width * math.sin(angle)))

    integral = 2.0 * quad(line, 0.0, 0.5 * math.pi)[0] * 2.0 / math.pi * load / LENGTH
    found = line_contact.finite_line_approach(load, LENGTH, radius, MODULUS)
    assert found == pytest.approx(2.0 / (math.pi * MODULUS) * integral, rel=2e-4)  # ln for asinh


@given(load=st.floats(1.0, 1e5), length=st.floats(2e-3, 0.1))
def test_load_and_approach_are_inverse(load: float, length: float) -> None:
    assert float(line_contact.iso_load(line_contact.iso_approach(load, length), length)) == pytest.approx(load)


def test_open_contacts_carry_nothing() -> None:
    assert line_contact.iso_load(np.array([-1e-6, 0.0]), LENGTH).tolist() == [0.0, 0.0]


@given(share=st.floats(-0.49, 0.49))
@pytest.mark.parametrize(
    "profile",
    [
        lambda x: profiles.iso_cylindrical(x, LENGTH, DIAMETER),
        lambda x: profiles.iso_cylindrical(x, LENGTH, 0.25 * DIAMETER),
        lambda x: profiles.iso_tapered(x, LENGTH, DIAMETER, 0.035),
        lambda x: profiles.crowned(x, 2.0),
        lambda x: profiles.two_radii(x, 0.5 * LENGTH, 5.0, 0.5),
        lambda x: profiles.logarithmic(x, LENGTH, 4e-6, flat=2e-3, exponent=3.0, edge_drop=20e-6),
    ],
    ids=["short", "long", "tapered", "crowned", "two radii", "finite edge"],
)
def test_profiles_are_even_and_fall_outwards(profile: profiles.Profile, share: float) -> None:
    x = np.array([share, -share, 1.01 * share]) * LENGTH
    here, there, outside = profile(x)
    assert here == there
    assert 0.0 <= here <= outside


def test_long_rollers_have_a_flat() -> None:
    x = np.linspace(-0.5, 0.5, 1001)[1:-1] * LENGTH
    drop = profiles.iso_cylindrical(x, LENGTH, 2e-3)  # L_we = 6 D_we: 2.5 D_we of crown
    assert np.all(drop[np.abs(x) <= 0.5 * (LENGTH - 5e-3)] == 0.0)
    assert np.all(drop[np.abs(x) > 0.5 * (LENGTH - 5e-3) + 1e-6] > 0.0)


def test_profiles_of_the_standard_have_their_drop_at_half_the_crown() -> None:
    # where the crown's argument is 1/2: scale times ln(4/3)
    drop = math.log(4.0 / 3.0)
    assert float(profiles.iso_cylindrical(3e-3, LENGTH, 11e-3)) == pytest.approx(0.00035 * 11e-3 * drop)
    long = profiles.iso_cylindrical(0.5 * (LENGTH - 2.5e-3), LENGTH, 2e-3)  # middle of a crown of 2.5 mm
    assert float(long) == pytest.approx(0.0005 * 2e-3 * drop)
    assert float(profiles.iso_tapered(3e-3, LENGTH, 11e-3, 0.035)) == pytest.approx(
        0.00045 * 11e-3 / math.cos(0.035) * drop
    )


def test_the_edge_drop_is_met() -> None:
    drop = profiles.logarithmic(0.5 * LENGTH, LENGTH, 4e-6, edge_drop=20e-6)
    assert float(drop) == pytest.approx(20e-6, rel=1e-12)
    assert profiles.logarithmic(0.5 * LENGTH, LENGTH, 4e-6) == math.inf


def test_two_radii_join_without_a_kink() -> None:
    step = 1e-7
    x = 3e-3 + step * np.array([-1.0, 0.0, 1.0])
    before, after = np.diff(profiles.two_radii(x, 6e-3, 5.0, 0.5)) / step
    assert after - before == pytest.approx(0.5 * step * (1.0 / 5.0 + 1.0 / 0.5), rel=0.02)  # curvature only, no step


def test_equal_radii_are_one_crown() -> None:
    x = slice_positions(LENGTH, 31)
    assert profiles.two_radii(x, 5e-3, 2.0, 2.0) == pytest.approx(profiles.crowned(x, 2.0), rel=1e-9, abs=1e-18)


def test_a_table_is_met_and_not_overshot() -> None:
    positions, drops = [-6e-3, -4e-3, 0.0, 4e-3, 6e-3], [20e-6, 1e-6, 0.0, 1e-6, 20e-6]
    assert profiles.tabulated(np.array(positions), positions, drops) == pytest.approx(drops)
    between = profiles.tabulated(np.linspace(-4e-3, 4e-3, 101), positions, drops)
    assert between.min() == 0.0
    assert between.max() <= 1e-6 * (1.0 + 1e-12)
    with pytest.raises(ValueError, match="add points up to both ends"):
        profiles.tabulated(np.array([7e-3]), positions, drops)


def test_profiles_add() -> None:
    x = slice_positions(LENGTH, 30)
    roller = profiles.iso_cylindrical(x, LENGTH, DIAMETER)
    drop = profiles.total(
        x, *[lambda x: profiles.iso_cylindrical(x, LENGTH, DIAMETER)] * 2, lambda x: profiles.crowned(x, 10.0)
    )
    assert drop == pytest.approx(2.0 * roller + profiles.crowned(x, 10.0))
    assert profiles.total(x).tolist() == [0.0] * 30


def test_profiles_refuse_what_lies_outside() -> None:
    with pytest.raises(ValueError, match="within half of `length`"):
        profiles.iso_cylindrical(0.51 * LENGTH, LENGTH, DIAMETER)
    with pytest.raises(ValueError, match="below `length`"):
        profiles.logarithmic(0.0, LENGTH, 4e-6, flat=LENGTH)
