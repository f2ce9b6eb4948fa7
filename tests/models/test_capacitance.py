"""Test whole capacitance of a contact.

Bounds, limits, and the gap integral against two-dimensional quadrature.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

from lambda_core.formulas.hertz import hertz_contact
from lambda_core.laws.probe import trial_context
from lambda_core.testing import evaluate

from ..literature.gap import surroundings  # noqa: TID252

EPS_0 = 8.8541878128e-12
CONTEXT = trial_context("ball_inner")
BALL_RADIUS = 0.5 * CONTEXT.ball_diameter


def arguments(load: float, h: float, R_x: float = CONTEXT.radius_x, R_y: float = CONTEXT.radius_y) -> dict[str, Any]:
    contact = hertz_contact(load, R_x, R_y, CONTEXT.e_eff)
    return {
        "C_hertz": EPS_0 * 2.3 * contact.area / h,
        "h": h,
        "semi_a": contact.semi_a,
        "semi_b": contact.semi_b,
        "R_x": R_x,
        "R_y": R_y,
        "U": 4e-10,
        "G": 4700.0,
        "W": load / (CONTEXT.e_eff * R_x**2),
        "eps_r0": 2.2,
    }


@pytest.mark.parametrize("name", ["schneider", "constant-factor", "gap-integral"])
class TestEveryLaw:
    def test_surroundings_only_add(self, name: str) -> None:
        for load in (1e-3, 1.0, 500.0, 20e3):
            for h in (1e-9, 1e-7, 1e-6, 1e-5):
                given = arguments(load, h)
                assert evaluate(f"capacitance/{name}", **given)[0] >= given["C_hertz"]

    @pytest.mark.parametrize("change", [{"C_hertz": 0.0}, {"W": 0.0}, {"U": 0.0}, {"h": 0.0}])
    def test_finite_at_the_ends(self, name: str, change: dict[str, float]) -> None:
        assert np.isfinite(evaluate(f"capacitance/{name}", **(arguments(500.0, 1e-6) | change))[0])

    def test_nothing_without_contact(self, name: str) -> None:
        given = arguments(500.0, 1e-6) | {"C_hertz": 0.0, "semi_a": 0.0, "semi_b": 0.0, "W": 0.0}
        assert evaluate(f"capacitance/{name}", **given)[0] == 0.0


@pytest.mark.parametrize("load", [5.0, 500.0, 5000.0])
@pytest.mark.parametrize("ratio", [1.0, 1.5, 30.0, 120.0])
def test_gap_integral_against_two_dimensional_quadrature(load: float, ratio: float) -> None:
    """Compare the gap integral by another route.

    The gap by adaptive quadrature of the elastic potential, the area by Gauss points; 1e-3.
    """
    given = arguments(load, 1e-6, 5e-3, 5e-3 * ratio)
    found = evaluate("capacitance/gap-integral", **given)[0] - given["C_hertz"]
    contact = hertz_contact(load, 5e-3, 5e-3 * ratio, CONTEXT.e_eff)
    expected = EPS_0 * 2.2 * surroundings(contact, CONTEXT.e_eff, 1e-6, BALL_RADIUS)
    assert found == pytest.approx(expected, rel=1e-3)


def test_gap_integral_does_not_care_which_axis_is_longer() -> None:
    wide = evaluate("capacitance/gap-integral", **arguments(500.0, 1e-6, 5e-3, 0.1))
    tall = evaluate("capacitance/gap-integral", **(arguments(500.0, 1e-6, 0.1, 5e-3)))
    assert tall == pytest.approx(wide, rel=1e-3)


def test_gap_integral_grows_with_its_extent_by_the_logarithm() -> None:
    """Compare growth with 2 pi eps sqrt(R_x R_y).

    Far out the gap is r^2/(2 R) in every direction: dC/d ln(extent) for a circle.
    """
    given = arguments(5.0, 1e-7, 5e-3, 5e-3)
    near, far = (evaluate("capacitance/gap-integral", {"extent": e}, **given)[0] for e in (0.8, 1.0))
    expected = EPS_0 * 2.2 * 2.0 * math.pi * 5e-3 * math.log(1.0 / 0.8)
    assert far - near == pytest.approx(expected, rel=0.02)
