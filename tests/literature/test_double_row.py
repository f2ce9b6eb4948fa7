"""Test two rows of angular contact in one bearing.

Against one row, a closed form of the preload, levers, a run.
"""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from lambda_core import api
from lambda_core.formulas.hertz import ball_raceway_radii, stiffness_constant
from lambda_core.formulas.ratings import dynamic_rating, static_rating
from lambda_core.solver.drivers.equilibrium import Equilibrium, solve
from lambda_core.solver.drivers.stiffness import stiffness_matrix
from lambda_core.solver.records import CONTACT_CHANNELS

from .statics import STEEL

BALLS, BALL, PITCH, APART = 14, 11.112e-3, 60.0e-3, 14.0e-3
DISTANCE, FREE = 0.04 * BALL, math.radians(30.0)
LOAD, ANGLE = CONTACT_CHANNELS.index("load"), CONTACT_CHANNELS.index("contact_angle")


def case(*, play: float | None, axial: float = 0.0, arrangement: str = "O") -> dict[str, Any]:
    """Return a bearing at rest.

    Of two rows with an axial clearance [m], of one row without.
    """
    geometry: dict[str, Any] = {
        "ball_count": BALLS, "ball_diameter": f"{1e3 * BALL} mm", "pitch_diameter": f"{1e3 * PITCH} mm",
        "conformity_inner": 0.515, "conformity_outer": 0.525, "bore_diameter": "40 mm", "outside_diameter": "80 mm",
        "width": "30.2 mm", "series": "32",
    }  # fmt: skip
    bearing: dict[str, Any] = {"contact_angle": f"{math.degrees(FREE)} deg", "geometry": geometry}
    if play is not None:
        geometry |= {"rows": 2, "row_distance": f"{1e3 * APART} mm", "arrangement": arrangement}
        bearing["axial_clearance"] = f"{1e6 * play} um"
    return {
        "name": "rows",
        "bearing": bearing,
        "lubricant": {"name": "FVA3", "temperature": "60 degC"},
        "loads": {"axial": f"{axial} N"},
        "operation": {"speed": "0 rpm"},
        "solver": {"duration": "1 s"},
        "gravity": {"z": "0 m/s2"},
        "models": {"fluid_drag": "none", "normal_contact": "hertz-exact"},
        "bodies": {"inner_ring": {"tilt_y": "locked", "tilt_z": "locked"}},
    }


def equilibrium(**what: Any) -> Equilibrium:
    return solve(api.check(case(**what)))


@pytest.mark.parametrize(("arrangement", "axial", "row"), [("O", 3000.0, 0), ("O", -3000.0, 1), ("X", 3000.0, 1)])
def test_thrust_is_carried_by_one_row(arrangement: str, axial: float, row: int) -> None:
    """Compare with a bearing of one row to 1e-4.

    With play one row carries: back to back the left one a thrust to +x.
    """
    one, two = equilibrium(play=None, axial=3000.0), equilibrium(play=20e-6, axial=axial, arrangement=arrangement)
    carrying = slice(row * BALLS, (row + 1) * BALLS)
    other = slice((1 - row) * BALLS, (2 - row) * BALLS)
    assert two.contacts[other, :, LOAD].max() == 0.0
    assert two.contacts[carrying, :, LOAD] == pytest.approx(one.contacts[:, :, LOAD], rel=1e-4)
    assert np.abs(two.contacts[carrying, :, ANGLE]) == pytest.approx(one.contacts[:, :, ANGLE], rel=1e-4)
    # From the middle a ring goes half of the play; a row alone goes A sin(alpha_0) from where its grooves face.
    travel = one.displacement[0] - DISTANCE * math.sin(FREE)
    assert math.copysign(1.0, axial) * two.displacement[0] == pytest.approx(10e-6 + travel, rel=1e-3)


def test_preload_in_closed_form() -> None:
    """Compare both rows with K delta^1.5 to 0.1 %.

    An axial clearance of -20 um; the length of A that is left.

    Groove centres are A sin(alpha_0) + 10 um apart along the shaft and A cos(alpha_0) across it.
    """
    found = equilibrium(play=-20e-6)
    along, across = DISTANCE * math.sin(FREE) + 10e-6, DISTANCE * math.cos(FREE)
    angle = math.atan2(along, across)
    inner, outer = (
        stiffness_constant(*ball_raceway_radii(BALL, PITCH, groove * BALL, angle, inner=side), STEEL)
        for groove, side in ((0.515, True), (0.525, False))
    )
    both = (inner ** (-2.0 / 3.0) + outer ** (-2.0 / 3.0)) ** -1.5
    load = both * (math.hypot(along, across) - DISTANCE) ** 1.5
    assert found.contacts[:, :, LOAD] == pytest.approx(load, rel=1e-3)
    assert np.abs(found.contacts[:, :, ANGLE]) == pytest.approx(angle, rel=1e-3)
    assert np.all(np.sign(found.contacts[:, 0, ANGLE]) == [1.0] * BALLS + [-1.0] * BALLS)


def test_back_to_back_is_stiff_against_tilt() -> None:
    """Compare tilting stiffness of both arrangements to 1 %.

    From the springs between groove centres, their ratio.

    Under preload a spring of length L = A + delta carries Q: along itself it has k = 1.5 Q/delta, across Q/L. A centre
    at x, r from the bearing's middle meets the first with the lever r sin(alpha) +- x cos(alpha), the second with r
    cos(alpha) -+ x sin(alpha), upper signs back to back.
    """
    stiff, soft = (stiffness_matrix(equilibrium(play=-20e-6, arrangement=a)) for a in "OX")
    along, across = DISTANCE * math.sin(FREE) + 10e-6, DISTANCE * math.cos(FREE)
    length, angle = math.hypot(along, across), math.atan2(along, across)
    turning = (length - DISTANCE) / (1.5 * length)  # Q/L over k
    sine, cosine, x, r = math.sin(angle), math.cos(angle), 0.5 * APART, 0.5 * PITCH
    back, face = (
        (r * sine + side * x * cosine) ** 2 + turning * (r * cosine - side * x * sine) ** 2 for side in (1.0, -1.0)
    )
    assert stiff[3][3] / soft[3][3] == pytest.approx(back / face, rel=0.01)
    assert stiff[0][0] == pytest.approx(soft[0][0], rel=1e-3)


def test_ratings_are_those_of_two_rows() -> None:
    """Compare with 2^0.7 and 2 of one row (exact).

    C of ISO 281 and C_0 of ISO 76.
    """
    size = BALLS, BALL, PITCH
    assert dynamic_rating(*size, contact_angle=FREE, rows=2) == pytest.approx(
        2.0**0.7 * dynamic_rating(*size, contact_angle=FREE)
    )
    assert static_rating(*size, contact_angle=FREE, rows=2) == pytest.approx(
        2.0 * static_rating(*size, contact_angle=FREE)
    )
    assert api.check(case(play=0.0)).geometry.rated_rows == 2


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"axial_clearance": None}, "is required for two rows"),
        ({"axial_clearance": "2 mm"}, "lets the balls leave"),
        ({"row_distance": "2 mm"}, "run into each other"),
        ({"row_distance": "28 mm"}, "narrower than the grooves"),
    ],
)
def test_what_is_no_bearing_of_two_rows_is_refused(change: dict[str, Any], words: str) -> None:
    wrong = case(play=20e-6)
    for name, value in change.items():
        section = wrong["bearing"] if name == "axial_clearance" else wrong["bearing"]["geometry"]
        if value is None:
            del section[name]
        else:
            section[name] = value
    with pytest.raises(api.CaseError, match=words):
        api.check(wrong)


def test_a_run_with_a_cage_for_both_rows(tmp_path: Path) -> None:
    """Balance energy to 1e-3 in a run of 2 ms.

    Both loads act; the cage has balls of both rows.
    """
    start = case(play=10e-6, axial=500.0) | {"operation": {"speed": "3000 rpm"}, "solver": {"duration": "2 ms"}}
    start["loads"]["radial"] = "2 kN"
    result = api.result(api.run(start, out=tmp_path / "rows.h5"))
    assert result["load"].shape[1:] == (2 * BALLS, 2)
    places = result["ball_axial"][-1].reshape(2, BALLS).mean(axis=1)
    assert places == pytest.approx([-0.5 * APART, 0.5 * APART], abs=1e-4)
    assert abs(result.summary().energy_residual) < 1e-3
