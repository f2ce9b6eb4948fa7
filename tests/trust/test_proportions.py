"""Test the warnings about geometries that nobody builds."""

from __future__ import annotations

import math

import pytest

from lambda_core import api
from lambda_core.elements.ball.kinds import kinds
from lambda_core.model.checking import check_bearing
from lambda_core.model.checks.operating_limits import operating_warnings

CASE = "6208-axial-1300"


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ("ball_count=3", "3 balls of 11.91 mm side by side span 46 deg of the pitch circle"),
        ("outside_diameter=99 m", "the wall of the outer ring under its groove"),
        ("bore_diameter=1 mm", "the wall of the inner ring under its groove"),
        ("width=90 m", "the width, 9e+04 mm"),
    ],
)
def test_what_no_maker_builds_is_told(change: str, words: str) -> None:
    case = [f"bearing.geometry.{change}"]
    (found,) = [text for text in operating_warnings(check_bearing(api.case(CASE, case))) if "of the catalogue" in text]
    assert found.startswith(words)
    assert not [text for text in operating_warnings(check_bearing(api.case(CASE))) if "of the catalogue" in text]


@pytest.mark.parametrize("change", ["ball_count=16", "ball_count=1", "outside_diameter=59 mm", "bore_diameter=61 mm"])
def test_what_is_impossible_is_refused(change: str) -> None:
    with pytest.raises(api.CaseError, match=change.split("=")[0] + "|pitch_diameter"):
        api.check(CASE, [f"bearing.geometry.{change}"])


def test_the_ranges_are_those_of_the_catalogue() -> None:
    filling: dict[str, list[float]] = {kind: [] for kind in kinds()}
    wall, width, aligning_wall, aligning_width = [], [], [], []
    for row in api.catalogue().bearings(limit=10_000):
        if row.ball_count is None or row.ball_diameter is None:
            continue
        ball = row.ball_diameter.value
        bore, outside, broad = row.bore_diameter.value, row.outside_diameter.value, row.width.value
        pitch = row.pitch_diameter.value if row.pitch_diameter else 0.5 * (bore + outside)
        filling[row.kind].append(2.0 * (row.ball_count.value - 1) * math.degrees(math.asin(ball / pitch)))
        if row.kind == "self-aligning":
            assert row.contact_angle is not None
            angle = row.contact_angle.value
            sphere = ball + pitch / math.cos(angle)  # diameter of the outer raceway
            aligning_wall += [0.5 * (pitch - ball - bore) / ball, 0.5 * (outside - sphere) / ball]
            aligning_width.append((broad - pitch * math.tan(angle)) / ball)
            continue
        wall += [0.5 * (pitch - ball - bore) / ball, 0.5 * (outside - pitch - ball) / ball]
        width.append((broad - (row.row_distance.value if row.row_distance else 0.0)) / ball)
    assert {kind: len(found) for kind, found in filling.items()} == {
        "deep groove": 349,
        "angular contact": 201,
        "four-point": 46,
        "double row": 42,
        "self-aligning": 86,
    }
    for found, (least, most), step in (
        (filling["deep groove"], kinds()["deep groove"].filling, 1.0),
        (filling["angular contact"], kinds()["angular contact"].filling, 1.0),
        (filling["four-point"], kinds()["four-point"].filling, 1.0),
        (filling["double row"], kinds()["double row"].filling, 1.0),
        (filling["self-aligning"], kinds()["self-aligning"].filling, 1.0),
        (aligning_wall, kinds()["self-aligning"].walls, 0.01),
        (aligning_width, kinds()["self-aligning"].width, 0.01),
        (wall, kinds()["deep groove"].walls, 0.01),
        (width, kinds()["deep groove"].width, 0.01),
    ):
        assert least == pytest.approx(math.floor(min(found) / step) * step)
        assert most == pytest.approx(math.ceil(max(found) / step) * step)
