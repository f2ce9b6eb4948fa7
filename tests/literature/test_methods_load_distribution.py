"""Compare load distribution with tables and a commercial program.

These are the exact solutions that the project's own equilibrium has to meet; here the reference itself is checked.
"""

from __future__ import annotations

import math

import numpy as np
import pytest

from lambda_core.formulas.hertz import ball_raceway_radii, reduced_modulus, stiffness_constant
from lambda_core.formulas.life import reference_rating_life

from .paper_6208 import axial_6208
from .peers import MASTA
from .published import Published
from .reference import (
    axial_equilibrium,
    sjovall_integrals,
    specification_equilibrium,
    stribeck_number,
)

STEEL = reduced_modulus(210e9, 0.3, 210e9, 0.3)

# Harris and Kotzalas, Rolling Bearing Analysis, 5th ed., vol. 1, table 7.4 (point contact): epsilon, J_r, J_a
INTEGRALS = [
    (0.1, 0.1156, 0.1196),
    (0.2, 0.1590, 0.1707),
    (0.3, 0.1892, 0.2110),
    (0.4, 0.2117, 0.2462),
    (0.5, 0.2288, 0.2782),
    (0.6, 0.2416, 0.3084),
    (0.7, 0.2505, 0.3374),
    (0.8, 0.2559, 0.3658),
    (0.9, 0.2576, 0.3945),
    (1.0, 0.2546, 0.4244),
    (1.25, 0.2289, 0.5044),
    (5.0 / 3.0, 0.1871, 0.6060),
    (2.5, 0.1339, 0.7240),
    (5.0, 0.0711, 0.8558),
]


@pytest.mark.parametrize(("epsilon", "radial", "axial"), INTEGRALS)
def test_sjovall_integrals(epsilon: float, radial: float, axial: float) -> None:
    source, reason = "Harris and Kotzalas, table of load distribution integrals", "last printed digit"
    computed = sjovall_integrals(epsilon)
    Published(radial, source, reason, abs=6e-5).check(computed[0])
    Published(axial, source, reason, abs=6e-5).check(computed[1])


def test_stribeck_number_without_clearance() -> None:
    # Stribeck 1901: Q_max = 4.37 F_r/Z without clearance (5 with a usual clearance, the value of ISO 76)
    reason = "number of balls: 4.345 to 4.385 for 8 to 20 balls"
    for count in range(8, 21):
        Published(4.37, "Stribeck 1901", reason, abs=0.026).check(stribeck_number(count))
    assert 1.0 / sjovall_integrals(0.5)[0] == pytest.approx(4.37, abs=0.005)


# --- the 6208 of Syla et al. 2026, table 6, under pure axial load ----------------------------------------------------


@pytest.mark.parametrize(("load", "angle", "ball"), [(700, 13.59, 330.9), (1300, 15.09, 554.7), (2000, 16.33, 790.3)])
def test_axial_load_static(load: float, angle: float, ball: float) -> None:
    result = axial_6208(load, running=False)
    assert math.degrees(result.angle_inner) == pytest.approx(angle, abs=0.006)
    assert result.load_inner == pytest.approx(ball, abs=0.06)


@pytest.mark.parametrize(("load", "inner", "outer"), [(700, 13.66, 13.55), (1300, 15.14, 15.06), (2000, 16.37, 16.31)])
def test_axial_load_running(load: float, inner: float, outer: float) -> None:
    result = axial_6208(load, running=True)
    assert math.degrees(result.angle_inner) == pytest.approx(inner, abs=0.011)
    assert math.degrees(result.angle_outer) == pytest.approx(outer, abs=0.011)


def test_axial_angle_follows_harris_equation() -> None:
    # Harris and Kotzalas, vol. 1, ch. 7: F_a/(Z K A^1.5) = sin(alpha) (cos(alpha_0)/cos(alpha) - 1)^1.5
    stiffness, legs, clearance = (1e10, 8e9), (0.24e-3, 0.36e-3), 14e-6
    result = axial_equilibrium(1300.0, 9, legs, clearance, stiffness)
    combined = sum(k ** (-2.0 / 3.0) for k in stiffness) ** -1.5
    distance = sum(legs)
    free = math.acos(1.0 - clearance / 2.0 / distance)
    left = 1300.0 / (9 * combined * distance**1.5)
    right = math.sin(result.angle_inner) * (math.cos(free) / math.cos(result.angle_inner) - 1.0) ** 1.5
    assert left == pytest.approx(right, rel=1e-9)


# --- a commercial program's numbers for a small bearing --------------------------------------------------------------


@pytest.mark.parametrize("name", MASTA)
def test_commercial_program(name: str) -> None:
    peer = MASTA[name]
    count, ball, pitch = peer.geometry[0], peer.geometry[1] * 1e-3, peer.geometry[2] * 1e-3
    inner, outer = 0.52 * ball, 0.53 * ball
    constants = [
        stiffness_constant(*ball_raceway_radii(ball, pitch, groove, 0.0, inner=side), STEEL)
        for groove, side in ((inner, True), (outer, False))
    ]
    result = specification_equilibrium(
        ball_count=count,
        groove_centre_distance=inner + outer - ball,
        lever=0.5 * pitch,
        first_ball=0.0 if peer.loads[0] else -0.5 * math.pi,
        clearance=peer.clearance * 1e-6,
        spring_constant=sum(k ** (-2.0 / 3.0) for k in constants) ** -1.5,
        radial_load=peer.loads[0],
        axial_load=peer.loads[1],
        moment=peer.loads[2],
    )
    reason = "four digits; both solve the same equations iteratively"
    computed = (result.radial * 1e6, result.axial * 1e6, abs(result.tilt) * 1e3)
    for value, number in zip(peer.displacement, computed, strict=True):
        if value is not None:
            Published(value, peer.source, reason, rel=2e-4).check(number)
    if peer.life is not None:
        reference = reference_rating_life(
            list(result.loads),
            list(result.loads),
            dynamic_rating=23400.0,
            gamma=ball / pitch,
            inner_conformity=0.52,
            outer_conformity=0.53,
        )
        Published(peer.life, peer.source, reason, rel=2e-4).check(reference.life)


def test_specification_reduces_to_many_balls() -> None:
    """Compare 400 balls with Sjoevall's integral.

    Without clearance: Q_max = F_r/(Z J_r).
    """
    result = specification_equilibrium(
        ball_count=400,
        groove_centre_distance=0.6e-3,
        lever=30e-3,
        clearance=0.0,
        spring_constant=5e9,
        radial_load=1e5,
        axial_load=0.0,
    )
    assert float(np.max(result.loads)) == pytest.approx(1e5 / (400 * sjovall_integrals(0.5)[0]), rel=1e-4)
