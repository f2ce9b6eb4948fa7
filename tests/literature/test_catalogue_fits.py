"""Compare limits and fits with ISO 286 and ISO 492."""

from __future__ import annotations

import math
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from lambda_core import api
from lambda_core.formulas import fits
from lambda_core.formulas.tolerances import (
    HOUSING_CLASSES,
    SHAFT_CLASSES,
    Limits,
    bore_deviations,
    housing_deviations,
    outside_deviations,
    shaft_deviations,
)

# Deviations in um as printed in ISO 286-2 (shaft and hole tables) and repeated in bearing makers' catalogues; exact.
PRINTED_SHAFTS = [
    (40, "g6", -25, -9),
    (40, "h6", -16, 0),
    (40, "j5", -5, 6),
    (40, "j6", -5, 11),
    (40, "k5", 2, 13),
    (40, "k6", 2, 18),
    (40, "m5", 9, 20),
    (40, "m6", 9, 25),
    (40, "n6", 17, 33),
    (40, "p6", 26, 42),
    (95, "k5", 3, 18),
    (95, "m6", 13, 35),
    (95, "j6", -9, 13),
    (20, "k5", 2, 11),
    (10, "j5", -2, 4),
    (150, "m6", 15, 40),
    (150, "p6", 43, 68),
    (200, "n6", 31, 60),
    (300, "g6", -49, -17),
    (450, "k6", 5, 45),
    (100, "js6", -11, 11),
    (5, "h7", -12, 0),
]
PRINTED_HOUSINGS = [
    (80, "H7", 0, 30),
    (80, "J7", -12, 18),
    (80, "K7", -21, 9),
    (80, "M7", -30, 0),
    (80, "N7", -39, -9),
    (80, "P7", -51, -21),
    (80, "F7", 30, 60),
    (80, "G7", 10, 40),
    (80, "H6", 0, 19),
    (200, "H7", 0, 46),
    (200, "K7", -33, 13),
    (200, "J7", -16, 30),
    (200, "N7", -60, -14),
    (200, "P7", -79, -33),
    (40, "K6", -13, 3),
    (40, "J6", -6, 10),
    (300, "M6", -41, -9),
    (300, "M7", -52, 0),
    (20, "F7", 20, 41),
    (120, "J7", -13, 22),
    (450, "P7", -108, -45),
]


def in_um(limits: Limits) -> Any:
    return pytest.approx((limits.minimum * 1e6, limits.maximum * 1e6), abs=1e-6)


@pytest.mark.parametrize(("diameter", "name", "lower", "upper"), PRINTED_SHAFTS)
def test_shaft_classes_are_the_printed_ones(diameter: float, name: str, lower: float, upper: float) -> None:
    assert (lower, upper) == in_um(shaft_deviations(diameter * 1e-3, name))


@pytest.mark.parametrize(("diameter", "name", "lower", "upper"), PRINTED_HOUSINGS)
def test_housing_classes_are_the_printed_ones(diameter: float, name: str, lower: float, upper: float) -> None:
    assert (lower, upper) == in_um(housing_deviations(diameter * 1e-3, name))


@pytest.mark.parametrize(
    ("diameter", "bore", "outside"),
    # ISO 492, normal class, as printed in makers' catalogues [um]
    [(10, -8, -8), (25, -10, -9), (40, -12, -11), (62, -15, -13), (95, -20, -15), (140, -25, -18), (160, -25, -25)],
)
def test_normal_tolerances_of_bearings(diameter: float, bore: float, outside: float) -> None:
    assert in_um(bore_deviations(diameter * 1e-3)) == (bore, 0)
    assert in_um(outside_deviations(diameter * 1e-3)) == (outside, 0)


def test_interference_of_40_k5_is_the_printed_one() -> None:
    # SKF general catalogue, shaft tolerances table, 40 mm k5: theoretical interference +2 to +25 um; exact
    assert in_um(fits.shaft_interference(0.040, "k5")) == (2, 25)
    # SKF, housing tolerances, 80 mm H7: clearance 0 to 43 um; exact
    assert in_um(fits.housing_interference(0.080, "H7")) == (-43, 0)


def test_unknown_class_names_the_nearest() -> None:
    with pytest.raises(ValueError, match='"k9" is not a known shaft class; nearest: k'):
        shaft_deviations(0.04, "k9")
    with pytest.raises(ValueError, match="is not a known housing class"):
        housing_deviations(0.08, "h7")
    with pytest.raises(ValueError, match="tabulated up to 500 mm"):
        shaft_deviations(0.6, "k5")


@given(diameter=st.floats(0.001, 0.5), shaft=st.sampled_from(SHAFT_CLASSES), hole=st.sampled_from(HOUSING_CLASSES))
def test_limits_are_ordered_and_as_wide_as_the_grade(diameter: float, shaft: str, hole: str) -> None:
    for limits in (shaft_deviations(diameter, shaft), housing_deviations(diameter, hole)):
        assert 3.9e-6 <= limits.maximum - limits.minimum <= 97.1e-6


RINGS = fits.Rings(0.040, 0.080, 0.048083, 0.071917, 0.01191)


def test_same_material_gives_the_printed_short_form() -> None:
    """Compare fits with NSK's short form.

    Inner ring on a hollow steel shaft, I k (1 - k0^2)/(1 - k^2 k0^2), k = d/D_i, k0 = d0/d; an identity.
    """
    interference, k, k0 = 10e-6, 0.040 / 0.048083, 0.5
    expected = interference * k * (1 - k0**2) / (1 - k**2 * k0**2)
    steel = fits.STEEL
    found = fits.inner_ring_expansion(interference, 0.040, 0.048083, steel, steel, 0.020)
    assert found == pytest.approx(expected, rel=1e-12)
    h, h0 = 0.071917 / 0.080, 0.080 / 0.120
    expected = interference * h * (1 - h0**2) / (1 - h**2 * h0**2)
    found = fits.outer_ring_contraction(interference, 0.080, 0.071917, steel, steel, 0.120)
    assert found == pytest.approx(expected, rel=1e-12)


def test_soft_shaft_expands_the_ring_less() -> None:
    aluminium = fits.Solid(70e9, 0.33, 23e-6)
    soft = fits.inner_ring_expansion(10e-6, 0.040, 0.048, fits.STEEL, aluminium, 0.0)
    hard = fits.inner_ring_expansion(10e-6, 0.040, 0.048, fits.STEEL, fits.STEEL, 0.0)
    assert soft < 0.9 * hard


def test_steps_add_up_and_each_is_shown() -> None:
    shaft = fits.Seat(fits.shaft_interference(0.040, "k5"))
    housing = fits.Seat(fits.housing_interference(0.080, "K7"), free_diameter=0.120)
    warm = fits.Temperatures(inner_ring=343.15, outer_ring=333.15, balls=343.15, shaft=343.15, housing=323.15)
    result = fits.operating_clearance(RINGS, Limits(6e-6, 20e-6), shaft, housing, warm)
    names = [step.name for step in result.steps]
    assert names == [
        "unmounted clearance",
        "interference on shaft",
        "inner ring expansion",
        "interference in housing",
        "outer ring contraction",
        "ring temperatures",
        "ball temperature",
        "operating clearance",
    ]
    assert result.value == pytest.approx(sum(step.value for step in result.steps if step.counts), abs=1e-15)
    # by hand, mean interference 13.5 um, ground seat 40/42, same material: 13.5 * 40/42 * 40/48.083 = 10.70 um
    assert result.steps[2].value == pytest.approx(-10.70e-6, abs=0.01e-6)
    # 12e-6 (40 K 71.917 mm - 50 K 48.083 mm) = 5.670 um and -2 * 12e-6 * 50 K * 11.91 mm = -14.29 um
    assert result.steps[5].value == pytest.approx(5.670e-6, abs=0.001e-6)
    assert result.steps[6].value == pytest.approx(-14.292e-6, abs=0.001e-6)


def test_loose_fit_takes_nothing_and_steps_stay_visible() -> None:
    loose = fits.Seat(fits.shaft_interference(0.040, "g6"), finish="none")
    assert loose.interference.minimum < 0
    result = fits.operating_clearance(RINGS, Limits(13e-6, 13e-6), fits.Seat(Limits(-20e-6, -5e-6)))
    assert result.limits == Limits(13e-6, 13e-6)


@given(
    low=st.floats(-30e-6, 30e-6),
    width=st.floats(0.0, 30e-6),
    inner=st.floats(250.0, 420.0),
    outer=st.floats(250.0, 420.0),
)
def test_uniform_temperature_of_one_steel_scales_the_clearance_only(
    low: float, width: float, inner: float, outer: float
) -> None:
    seat = fits.Seat(Limits(low, low + width))
    cold = fits.operating_clearance(RINGS, Limits(13e-6, 13e-6), seat)
    all_warm = fits.operating_clearance(RINGS, Limits(13e-6, 13e-6), seat, None, fits.Temperatures(*([inner] * 5)))
    # d_o - d_i - 2 D_w of the printed diameters is 14 um: its own growth is below 0.03 um
    assert all_warm.value == pytest.approx(cold.value, abs=0.03e-6)
    hotter_inside = fits.operating_clearance(
        RINGS,
        Limits(13e-6, 13e-6),
        None,
        None,
        fits.Temperatures(inner_ring=max(inner, outer), outer_ring=min(inner, outer)),
    )
    cooler_inside = fits.operating_clearance(
        RINGS,
        Limits(13e-6, 13e-6),
        None,
        None,
        fits.Temperatures(inner_ring=min(inner, outer), outer_ring=min(inner, outer)),
    )
    assert hotter_inside.value <= cooler_inside.value + 1e-12


def test_impossible_diameters_are_refused() -> None:
    with pytest.raises(ValueError, match="0 < bore < inner race"):
        fits.Rings(0.05, 0.04, 0.045, 0.06, 0.01)
    with pytest.raises(ValueError, match="finish"):
        fits.operating_clearance(RINGS, Limits(0, 0), fits.Seat(Limits(1e-6, 2e-6), finish="rough"))
    with pytest.raises(ValueError, match="hollow"):
        fits.inner_ring_expansion(1e-6, 0.04, 0.048, fits.STEEL, fits.STEEL, 0.05)
    assert math.isfinite(fits.outer_ring_contraction(1e-6, 0.08, 0.07, fits.STEEL, fits.STEEL, math.inf))


def test_rigid_housing_hands_on_the_complete_interference() -> None:
    """Compare a rigid housing with the closed form.

    Only the ring yields: u = I (2 h)/[(1 + h^2) - nu (1 - h^2)], h = d_race/D.
    """
    h, nu = 0.071917 / 0.080, 0.3
    rigid = fits.Solid(math.inf, 0.3, 12e-6)
    found = fits.outer_ring_contraction(10e-6, 0.080, 0.071917, fits.STEEL, rigid, math.inf)
    assert found == pytest.approx(10e-6 * 2 * h / ((1 + h**2) - nu * (1 - h**2)), rel=1e-12)


def test_reference_temperature_moves_with_the_parts() -> None:
    warm = fits.Temperatures(*([333.15] * 6))
    assert fits.operating_clearance(RINGS, Limits(1e-5, 1e-5), temperatures=warm).value == pytest.approx(
        1e-5, abs=1e-18
    )


def test_a_case_without_housing_diameter_has_endless_steel() -> None:
    """Compare with ever larger housings of steel.

    A thin housing leaves more of the clearance.
    """

    def clearance(*changes: str) -> float:
        return api.check("6208-axial-700", ["bearing.fits.housing=20 um", *changes]).geometry.clearance

    absent = clearance()
    huge, thin = (clearance(f"bearing.fits.housing_outside_diameter={size}") for size in ("100 m", "95 mm"))
    assert absent == pytest.approx(huge, abs=1e-10)
    assert thin > absent + 1e-6
