"""Compare rating lives with standards, catalogues and theory."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from lambda_core.formulas.life import (
    ball_capacities,
    basic_rating_life,
    contamination_range,
    dynamic_equivalent_load,
    life_hours,
    life_modification_factor,
    reference_rating_life,
    reference_viscosity,
    static_equivalent_load,
)

from .published import Published
from .reference import fatigue_integral, sjovall_integrals

RPM = math.pi / 30.0


def test_catalogue_example() -> None:
    # SKF, Rolling bearings, calculation example 1: 6309, C = 55.3 kN, F_r = 10 kN, 3000 1/min
    source, reason = "SKF, Rolling bearings, selecting bearing size, example 1", "printed digits"
    life = basic_rating_life(55.3e3, 10e3)
    Published(169.0, source, reason, abs=0.5).check(life)
    Published(940.0, source, reason, abs=5.0).check(life_hours(life, 3000 * RPM))


def test_catalogue_program() -> None:
    # SKF Bearing Calculator report (2015): 6309, C 55.3, C_0 31.5 kN, F_r 4, F_a 0.5 kN, 1800 1/min -> P 4 kN, 24500 h
    source, reason = "SKF Bearing Calculator report for a 6309, 2015", "three printed digits"
    equivalent = dynamic_equivalent_load(4e3, 0.5e3, 31.5e3, 13.0)
    Published(4.0, source, reason, abs=0.005).check(equivalent.load * 1e-3)
    hours = life_hours(basic_rating_life(55.3e3, equivalent.load), 1800 * RPM)
    Published(24500.0, source, reason, abs=50.0).check(hours)


# ISO 281:2007, table 3, radial contact groove ball bearings: f_0 F_a/C_0r, e, Y at large F_a/F_r
@pytest.mark.parametrize(
    ("relative", "limit", "axial"),
    [
        (0.172, 0.19, 2.30),
        (0.345, 0.22, 1.99),
        (0.689, 0.26, 1.71),
        (1.03, 0.28, 1.55),
        (1.38, 0.30, 1.45),
        (2.07, 0.34, 1.31),
        (3.45, 0.38, 1.15),
        (5.17, 0.42, 1.04),
        (6.89, 0.44, 1.00),
    ],
)
def test_equivalent_load_nearly_joins_at_the_limit(relative: float, limit: float, axial: float) -> None:
    """Join the branches of P at F_a/F_r = e.

    They differ by less than the table's rounding, which checks every typed entry.
    """
    static, factor = 20e3, 14.0
    axial_load = relative * static / factor
    below = dynamic_equivalent_load(axial_load / limit * 1.0001, axial_load, static, factor)
    above = dynamic_equivalent_load(axial_load / limit * 0.9999, axial_load, static, factor)
    assert (below.axial_factor, above.axial_factor) == (0.0, pytest.approx(axial, abs=1e-9))
    # X + Y e = 1 within the two printed digits of e and Y
    Published(1.0, "ISO 281:2007, table 3", "e and Y have two digits", abs=0.012).check(0.56 + axial * limit)
    assert above.load == pytest.approx(below.load, rel=0.013)


@pytest.mark.parametrize(("angle", "edges"), [(0.0, (0.172, 6.89)), (math.radians(15.0), (0.178, 7.14))])
def test_factors_are_held_beyond_the_table(angle: float, edges: tuple[float, float]) -> None:
    for edge, beyond in zip(edges, (0.01, 20.0), strict=True):
        at, outside = (dynamic_equivalent_load(0.0, x * 1e3, 14e3, 14.0, angle) for x in (edge, beyond))
        assert outside.limit == pytest.approx(at.limit, rel=1e-12)
        assert outside.axial_factor == pytest.approx(at.axial_factor, rel=1e-12)


# ISO 281:2007, table 3, two rows of 15 degrees: f_0 i F_a/C_0r, where C_0r is that of both; e, Y up to e, Y above it
@pytest.mark.parametrize(
    ("relative", "limit", "below", "above"),
    [(0.178, 0.38, 1.65, 2.39), (0.714, 0.43, 1.46, 2.11), (1.43, 0.47, 1.34, 1.93), (7.14, 0.56, 1.12, 1.63)],
)
def test_factors_of_two_rows_of_15_degrees(relative: float, limit: float, below: float, above: float) -> None:
    static, factor, angle = 40e3, 14.0, math.radians(15.0)
    axial = relative * static / (2.0 * factor)
    light = dynamic_equivalent_load(10.0 * axial, axial, static, factor, angle, rows=2)
    thrust = dynamic_equivalent_load(0.0, axial, static, factor, angle, rows=2)
    source, reason = "ISO 281:2007, table 3, two rows", "two printed digits, and those of one row"
    Published(limit, source, reason, abs=1e-9).check(light.limit)
    Published(below, source, "0.625/e, where e has two digits", abs=0.015).check(light.axial_factor)
    Published(0.72, source, reason, abs=0.009).check(thrust.radial_factor)
    Published(above, source, reason, abs=0.009).check(thrust.axial_factor)


def test_static_equivalent_load() -> None:
    # ISO 76:2006, table 2
    assert static_equivalent_load(1000.0, 200.0) == 1000.0
    assert static_equivalent_load(1000.0, 2000.0) == pytest.approx(1600.0)


def test_capacity_constants_are_load_integrals() -> None:
    """Compare 0.407 and 0.389 with load integrals.

    ISO/TS 16281: J_r/J_1 and J_r/J_2 with half the raceway loaded, by quadrature.
    """
    radial = sjovall_integrals(0.5)[0]
    source, reason = "ISO/TS 16281:2008, eq. 19-20", "last printed digit"
    Published(0.407, source, reason, abs=0.0005).check(radial / fatigue_integral(0.5, 3.0))
    # 0.3895 by quadrature against the printed 0.389
    Published(0.389, source, "rounding in the standard", abs=0.0006).check(radial / fatigue_integral(0.5, 10.0 / 3.0))


@pytest.mark.parametrize("angle", [0.0, 15.0, 40.0])
@pytest.mark.parametrize("gamma", [0.1, 0.2, 0.3])
def test_reference_life_of_the_standard_case_is_the_basic_life(gamma: float, angle: float) -> None:
    """Compare L_10r with (C/F_r)^3.

    Many balls, half the raceway loaded: this defines the capacities at every angle.
    """
    count, rating, load, alpha = 360, 30e3, 4e3, math.radians(angle)
    angles = 2.0 * math.pi * np.arange(count) / count
    relative = np.maximum(np.cos(angles), 0.0) ** 1.5
    loads = list(relative * load / float(np.sum(relative * np.cos(angles))) / math.cos(alpha))
    result = reference_rating_life(
        loads,
        loads,
        dynamic_rating=rating,
        gamma=gamma,
        inner_conformity=0.52,
        outer_conformity=0.52,
        nominal_angle=alpha,
    )
    reason = "three digits of 0.407 and 0.389, raised to the third power"
    Published((rating / load) ** 3, "ISO 281:2007", reason, rel=0.006).check(result.life)
    Published(load, "ISO 281:2007", reason, rel=0.002).check(result.equivalent_load)


def test_capacities_combine_to_the_rating() -> None:
    """Compare capacities with Lundberg and Palmgren.

    (Q_ci J_r/J_1 Z)^(-10/3) + (Q_ce J_r/J_2 Z)^(-10/3) = C^(-10/3).
    """
    rating, count = 29.1e3, 9
    inner, outer = ball_capacities(rating, count, 0.1985, 0.52, 0.53)
    total = (0.407 * count * inner) ** (-10 / 3) + (0.389 * count * outer) ** (-10 / 3)
    assert total ** (-0.3) == pytest.approx(rating, rel=1e-12)


def test_resting_ring_counts_more() -> None:
    # a ring that stands still relative to the load has the larger mean load (exponent 10/3 against 3)
    loads = [100.0, 500.0, 900.0, 500.0, 100.0, 0.0, 0.0, 0.0]
    arguments = {"dynamic_rating": 30e3, "gamma": 0.2, "inner_conformity": 0.52, "outer_conformity": 0.53}
    inner = reference_rating_life(loads, loads, **arguments)
    outer = reference_rating_life(loads, loads, inner_rotates=False, **arguments)
    assert outer.life < inner.life  # the inner ring decides, and now it stands still
    assert outer.load_inner > inner.load_inner


def test_reference_viscosity() -> None:
    # ISO 281:2007, 9.3.3.2; exact values of the printed equations
    source, reason = "ISO 281:2007, eq. 28-29", "exact"
    Published(4500.0 / math.sqrt(1.6e5), source, reason, rel=1e-12).check(reference_viscosity(1600 * RPM, 0.1) * 1e6)
    Published(45000.0 * 100.0**-0.83 / 10.0, source, reason, rel=1e-12).check(reference_viscosity(100 * RPM, 0.1) * 1e6)


def test_reference_viscosity_is_nearly_continuous() -> None:
    below, above = (reference_viscosity(rpm * RPM, 0.06) for rpm in (999.999, 1000.001))
    assert below == pytest.approx(above, rel=0.025)  # the standard's own step of 2.3 %


@pytest.mark.parametrize(("kappa", "step"), [(0.4, 2e-3), (1.0, 1e-9)])
def test_branches_of_the_modification_factor_join(kappa: float, step: float) -> None:
    below, above = (life_modification_factor(kappa + d, 0.5, 800.0, 4e3) for d in (-1e-12, 1e-12))
    assert below == pytest.approx(above, rel=step)


def test_modification_factor_limits() -> None:
    # ISO 281:2007, 9.3.3: without any fatigue strength left 0.1, at most 50, kappa counted up to 4
    assert life_modification_factor(2.0, 0.0, 800.0, 4e3) == pytest.approx(0.1)
    assert life_modification_factor(4.0, 1.0, 4e3, 4e3) == 50.0
    assert life_modification_factor(9.0, 0.4, 800.0, 4e3) == life_modification_factor(4.0, 0.4, 800.0, 4e3)
    with pytest.raises(ValueError, match=r"0\.1 and more"):
        life_modification_factor(0.05, 0.5, 800.0, 4e3)


@given(st.floats(0.1, 4.0), st.floats(0.05, 0.95), st.floats(500.0, 2e4))
def test_modification_factor_is_monotonic(kappa: float, cleanliness: float, load: float) -> None:
    factor = life_modification_factor(kappa, cleanliness, 800.0, load)
    assert 0.1 <= factor <= 50.0
    assert life_modification_factor(kappa, cleanliness + 0.05, 800.0, load) >= factor
    assert life_modification_factor(kappa, cleanliness, 800.0, 1.1 * load) <= factor
    assert life_modification_factor(min(1.1 * kappa, 4.0), cleanliness, 800.0, load) >= factor * (1.0 - 1e-3)


@given(st.lists(st.floats(0.0, 1e4), min_size=7, max_size=9), st.floats(1.1, 3.0))
def test_reference_life_scales_with_the_cube(loads: list[float], scale: float) -> None:
    arguments = {"dynamic_rating": 30e3, "gamma": 0.2, "inner_conformity": 0.52, "outer_conformity": 0.53}
    once = reference_rating_life(loads, loads, **arguments)
    more = reference_rating_life([scale * q for q in loads], [scale * q for q in loads], **arguments)
    if max(loads) < 1e-3:
        return
    assert more.life == pytest.approx(once.life / scale**3, rel=1e-9)
    assert (30e3 / once.equivalent_load) ** 3 == pytest.approx(once.life, rel=1e-9)


def test_no_load_lives_forever() -> None:
    result = reference_rating_life(
        [0.0] * 9, [0.0] * 9, dynamic_rating=1e4, gamma=0.2, inner_conformity=0.52, outer_conformity=0.53
    )
    assert math.isinf(result.life)
    assert math.isinf(basic_rating_life(1e4, 0.0))
    assert math.isinf(life_hours(100.0, 0.0))


def test_contamination_levels() -> None:
    # ISO 281:2007, table 13
    assert contamination_range("normal cleanliness", 0.06) == (0.5, 0.6)
    assert contamination_range("normal cleanliness", 0.1475) == (0.6, 0.8)
    assert contamination_range("extreme cleanliness", 0.06) == (1.0, 1.0)
    with pytest.raises(ValueError, match="nearest: typical contamination"):
        contamination_range("typical contaminaton", 0.06)
