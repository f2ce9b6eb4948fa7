"""Test choosing bearings by load, speed and life."""

from __future__ import annotations

import json
from typing import Any

import pytest
from lambda_cli.main import main

from lambda_core import api
from lambda_core.domain.errors import LambdaError, UsageError

QUESTION = {"radial": "5 kN", "axial": "1 kN", "speed": "3000 rpm", "life": "2000 h", "oil": "FVA3A", "bore": "40 mm"}


def test_the_smallest_that_reach_the_life_come_first() -> None:
    found = api.choose(**QUESTION, kind="deep groove", limit=3)  # type: ignore[arg-type]
    assert [one.met for one in found.candidates] == [True, True, True]
    volumes = [one.outside_mm**2 * one.width_mm for one in found.candidates]
    assert volumes == sorted(volumes)
    for one in found.candidates:
        assert one.bore_mm == 40.0
        assert one.life_h is not None
        assert one.life_h >= 2000.0
        assert one.life_name == "L_10rh"
    sums = sum(found.left_out.values())
    assert found.left_out["do not reach the life"] > 0
    assert sums > 100  # each of the other bearings has its reason
    assert found.text().splitlines()[0].startswith("radial 5 kN, axial 1 kN, 3000 rpm, 2 000 h required")


def test_given_cleanliness_makes_modified_lives_count(capsys: pytest.CaptureFixture[str]) -> None:
    words = [text for key, value in QUESTION.items() for text in (f"--{key}", value)]
    more = ["--kind", "deep groove", "--contamination", "0.5", "--life", "20000 h", "--limit", "2", "--json", "--quiet"]
    assert main(["db", "choose", *words, *more]) == 0
    found = json.loads(capsys.readouterr().out)
    best = found["candidates"][0]
    assert best["life_name"] == "L_nmrh"
    assert best["met"]
    assert best["basic_life_h"] < 20000.0 < best["life_h"]  # a_ISO above 1 at kappa of about 4


def test_cleanliness_is_read_as_in_a_case() -> None:
    number, text = (api.choose(**QUESTION, contamination=e_c, kind="deep groove", limit=1) for e_c in (1.0, "1 "))
    assert text.candidates == number.candidates


@pytest.mark.parametrize(
    ("changes", "said"),
    [
        ({"life": "-1 h"}, "requirements.life +-1 h: must be greater than 0 h"),
        ({"static_safety": -1.0}, "requirements.static_safety +-1.0: must be greater than 0"),
        ({"temperature": "-300 degC"}, "at or below absolute zero"),
        ({"oil": "mineral-vg69"}, 'lubricant.name +"mineral-vg69" is not a known lubricant; nearest: mineral-vg68'),
        ({"limit": 0}, "limit = 0 is not allowed: give a whole number, at least 1"),
    ],
)
def test_values_out_of_range_are_refused_once_and_before_the_search(changes: dict[str, Any], said: str) -> None:
    with pytest.raises(LambdaError, match=said):
        api.choose(**{"radial": "1 kN", "speed": "1000 rpm", "life": "1000 h", **changes})


def test_what_cannot_be_asked_is_named() -> None:
    for changes, words in (
        ({"kind": "deep grove"}, "nearest: deep groove"),
        ({"maker": "SFK"}, '"SFK" is not a known maker; nearest: SKF'),
        ({"radial": "5"}, 'write "5 N"'),
        ({"radial": "0 N", "axial": "0 N"}, "give a radial or an axial one"),
    ):
        with pytest.raises(UsageError, match=words):
            api.choose(**{**QUESTION, **changes})  # type: ignore[arg-type]


ROLLERS = {"radial": "5 kN", "speed": "3000 rpm", "life": "10000 h"}


def test_rollers_are_chosen_with_their_own_exponent_and_limits() -> None:
    found = api.choose(**ROLLERS, kind="NU", bore="40 mm", limit=3)
    nu_208 = next(one for one in found.candidates if one.designation == "NU 208")
    alone = api.quasistatic({
        "name": "nu",
        "bearing": {"designation": "SKF NU 208"},
        "lubricant": {"name": "mineral-vg68", "temperature": "70 degC"},
        "loads": {"radial": "5 kN"},
        "operation": {"speed": "3000 rpm"},
    })  # fmt: skip
    assert nu_208.basic_life_h == pytest.approx((62.0 / 5.0) ** (10 / 3) * 1e6 / (60 * 3000), rel=1e-3)
    assert nu_208.life_h == pytest.approx(alone.rating.reference_life_h, rel=1e-3)
    assert nu_208.friction_torque_Nmm == pytest.approx(alone.friction_torque_Nmm, rel=1e-3)
    mixed = api.choose(**ROLLERS, limit=5)
    assert {"N", "NU"} <= {one.kind for one in mixed.candidates}


def test_thrust_leaves_only_rollers_that_carry_it() -> None:
    found = api.choose(**ROLLERS, axial="1.5 kN", kind="cylindrical", bore="40 mm")
    assert {one.designation for one in found.candidates} == {"NJ 2208", "NUP 2208", "NJ 308", "NUP 308"}
    assert found.left_out["have ribs that carry less axial load"] == 3  # NJ 208: 2.2 kN by heat less 0.15 F_r (SKF)
    assert found.left_out["have rollers that carry no axial load (NU, N, needle)"] >= 4
    turned = api.choose(**ROLLERS, axial="-1.5 kN", kind="cylindrical", bore="40 mm")
    assert [one.life_h for one in turned.candidates] == [one.life_h for one in found.candidates]


def test_tapered_rollers_need_the_thrust_that_presses_them() -> None:
    loaded = api.choose(**ROLLERS, axial="2.5 kN", kind="tapered", contamination=0.5)
    assert loaded.candidates
    assert all(one.met and one.life_name == "L_nmrh" for one in loaded.candidates)
    alone = api.choose(**{**ROLLERS, "speed": "1000 rpm"}, kind="tapered")  # the largest are too slow for 3000 rpm
    assert not alone.candidates
    assert set(alone.left_out) == {"have tapered rollers and need more axial load or a second bearing"}


def test_a_reason_of_one_bearing_is_in_the_singular() -> None:
    reasons = {"have angular contact and need more axial load": 1, "have rollers that carry no axial load": 1}
    said = api.Choice(question="", candidates=[], left_out=reasons).text()
    assert "1 has angular contact and needs more axial load; 1 has rollers that carry no axial load" in said
