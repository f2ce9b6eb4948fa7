"""Test the profiles that a case gives its rollers."""

from __future__ import annotations

import copy
from typing import Any

import numpy as np
import pytest

from lambda_core import api
from lambda_core.domain.errors import CaseError
from lambda_core.elements.roller import profiles
from lambda_core.elements.roller.roller_bearing import RollerBearing
from lambda_core.elements.roller.slices import slice_positions

CASE: dict[str, Any] = {
    "name": "profiled",
    "bearing": {"designation": "NU 208"},
    "lubricant": {"name": "FVA3", "temperature": "60 degC"},
    "loads": {"radial": "5 kN"},
    "operation": {"speed": "3000 rpm"},
}
POINTS = [["0 mm", "0 um"], ["3 mm", "1 um"], ["5.5 mm", "8 um"]]


def rollers(**options: Any) -> RollerBearing:
    """Return a case's rollers with options of the profile."""
    case = copy.deepcopy(CASE)
    case["bearing"]["rollers"] = options
    found = api.check(case).rollers
    assert found is not None
    return found


def test_a_case_gives_rollers_a_crown_two_radii_or_a_table() -> None:
    crown = rollers(profile="crowned", profile_radius="2 m")
    x = slice_positions(crown.effective_length, 40)
    assert crown.drops(40) == pytest.approx(profiles.crowned(x, 2.0))
    two = rollers(profile="two-radii", profile_length="6 mm", profile_radius="500 mm")
    assert two.drops(40) == pytest.approx(profiles.two_radii(x, 6e-3, np.inf, 0.5))
    bent = rollers(
        profile="two-radii", profile_length="6 mm", profile_radius="500 mm", profile_middle_radius="3 m"
    )  # fmt: skip
    assert bent.drops(40) == pytest.approx(profiles.two_radii(x, 6e-3, 3.0, 0.5))
    table = rollers(profile="tabulated", profile_points=POINTS)
    drop = table.drops(40)
    assert drop == pytest.approx(drop[::-1])
    assert np.interp(3e-3, x, drop) == pytest.approx(1e-6, rel=0.02)


@pytest.mark.parametrize(
    ("options", "words"),
    [
        ({"profile": "crowned"}, "crowned needs profile_radius"),
        ({"profile": "crowned", "profile_radius": "3 mm"}, "must be above half of the contact's length"),
        ({"profile": "two-radii", "profile_radius": "1 m"}, "profile_length is absent"),
        ({"profile": "two-radii", "profile_radius": "1 m", "profile_length": "20 mm"}, "below the contact's length"),
        ({"profile": "two-radii", "profile_radius": "1 mm", "profile_length": "6 mm"}, "is too small"),
        ({"profile": "tabulated", "profile_points": POINTS[::-1]}, "must begin at 0 mm"),
        ({"profile": "tabulated", "profile_points": POINTS[:2]}, "reach half of the contact's length"),
        ({"profile": "tabulated", "profile_points": [*POINTS[:2], *POINTS[1:]]}, "must increase"),
        ({"profile": "tabulated", "profile_points": [POINTS[0], ["6 mm", "-1 um"]]}, "at least 0 um"),
        ({"profile": "tabulated", "profile_points": [POINTS[0], ["6 mm", "nan um"]]}, "not a number"),
        ({"profile": "none", "profile_radius": "1 m"}, "no option of the profile none"),
    ],
)
def test_a_profile_that_no_roller_can_have_is_refused(options: dict[str, Any], words: str) -> None:
    with pytest.raises(CaseError, match=words):
        rollers(**options)
