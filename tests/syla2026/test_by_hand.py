"""Test sliding, rolling and hysteresis of the 6319, derived twice.

By the program, and with numpy alone (by_hand.py).
"""

from __future__ import annotations

from functools import cache

import pytest
from lambda_syla2026 import parameters as P
from lambda_syla2026.published import LOADS, POINTS, Point
from lambda_syla2026.readings import Numbers, friction

from lambda_core import api

from . import by_hand

FINE = ("depth.strips=61", "depth.rows=15")


@cache
def derived(load: float, rpm: float, heated: bool = True) -> dict[str, float]:
    """Return the second derivation's torques.

    It takes seconds, and tests share points.
    """
    return by_hand.torques(load, rpm, heated=heated)


def both(point: Point, *changes: str) -> tuple[Numbers, dict[str, float]]:
    found = friction(api.check(point.case, (*P.changes(), *changes)))
    return found, derived(LOADS[point.load], float(point.speed))


# Both loads at the ends of speed; between them by name.
@pytest.mark.parametrize(
    "point",
    [POINTS[0], pytest.param(POINTS[2], marks=pytest.mark.slow), pytest.param(POINTS[-1], marks=pytest.mark.full)],
    ids=lambda point: point.case,
)
def test_parts_of_the_torque(point: Point) -> None:
    """Compute parts of the torque to 1 %.

    The difference is the balls' gravity, and the program's rounded corner where the shear stress meets its limit.
    """
    found, hand = both(point, *FINE)
    for name, expected in hand.items():
        assert found[name] == pytest.approx(expected, rel=0.01), name


@pytest.mark.full
@pytest.mark.parametrize("point", [POINTS[0], POINTS[-1]], ids=lambda point: point.case)
def test_one_cell_along_rolling_overestimates_sliding(point: Point) -> None:
    """Compare one cell with slices along rolling.

    The default has slices, as the paper: the mean pressure of a strip in place of Hertz's along it.

    The stress goes with ln(eta), which grows ever more slowly with pressure, so its mean over a strip lies below its
    value at the mean pressure: by 2 to 3.5 %, 0.5 to 1.5 % of the torque.
    """
    found, hand = both(point)
    assert 0.01 < (found["sliding"] or 0.0) / hand["sliding"] - 1.0 < 0.04


@pytest.mark.slow
def test_what_an_estimate_without_the_unloaded_elements_leaves_out(monkeypatch: pytest.MonkeyPatch) -> None:
    """Add the rolling torque of unloaded balls.

    A first estimate had 248, 519 and 733 N mm of rolling: 30 um of clearance, loaded balls only.

    Centrifugal force presses every ball on the outer ring, under 3000 1/min with 111 g x 73.75 mm x (125 rad/s)^2 = 128
    N. The six balls outside the load zone add 2, 9 and 17 %.
    """
    monkeypatch.setattr(by_hand, "CLEARANCE", 30e-6)
    for rpm, estimate, share in ((500.0, 248.0, 0.02), (1500.0, 519.0, 0.09), (3000.0, 733.0, 0.17)):
        loaded = by_hand.torques(16e3, rpm, unloaded=False)["rolling"]
        every = by_hand.torques(16e3, rpm)["rolling"]
        assert loaded == pytest.approx(estimate, rel=0.02)
        assert every / loaded - 1.0 == pytest.approx(share, abs=0.015)


def test_strips_of_an_unloaded_ball_against_the_formula_of_a_point_contact() -> None:
    """Compare strips at 128 N with Houpert's points.

    7.5826 E' R_x^2 (R_y/R_x)^0.4055 W^(1/3) U^0.75 (common form) lies above the strips.

    So the share of the balls outside the load zone is not overestimated by taking strips there.
    """
    contact, u = by_hand.Contact(by_hand.OUTER, 128.0), 11.06
    U = by_hand.ETA * u / (by_hand.E_EFF * contact.R_x)
    W = contact.load / (by_hand.E_EFF * contact.R_x**2)
    L = by_hand.ETA * by_hand.BETA * u * u / by_hand.CONDUCTIVITY
    point = 7.5826 * by_hand.E_EFF * contact.R_x**2 * (contact.R_y / contact.R_x) ** 0.4055 * W ** (1 / 3) * U**0.75
    assert 0.6 < contact.rolling(u) * (1.0 + 0.29 * L**0.78) / point < 1.0


@pytest.mark.slow
def test_heat_takes_off_more_the_faster_it_runs() -> None:
    """Compare sliding at 500 and 3000 1/min.

    Film temperature alone: 2 % less at 500 1/min, 10 to 12 % less at 3000 1/min.

    Without heat it grows with asinh(eta v/(h tau_e)), with heat it stays.
    """
    shares = []
    for rpm in (500.0, 3000.0):
        hot, cold = (derived(16e3, rpm, heated)["sliding"] for heated in (True, False))
        shares.append(hot / cold - 1.0)
    assert shares[0] == pytest.approx(-0.021, abs=0.01)
    assert shares[1] == pytest.approx(-0.106, abs=0.02)
