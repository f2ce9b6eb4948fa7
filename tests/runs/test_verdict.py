"""Test the standard answer.

Modified life, verdict against required life and limits, margins.
"""

from __future__ import annotations

import tomllib

import pytest

from lambda_core import api
from lambda_core.analysis.rotor.machine_equilibrium import MachineEquilibrium
from lambda_core.model.machine_templates import shaft_text
from lambda_core.results.quasistatic import QuasiStatic
from lambda_core.results.verdict import Margin

CASE = {
    "name": "motor",
    "bearing": {"designation": "6308 C3", "maker": "SKF"},
    "lubricant": {"name": "FVA3A", "temperature": "60 degC"},
    "loads": {"radial": "5 kN", "axial": "1 kN"},
    "operation": {"speed": "3000 rpm"},
    "bodies": {"inner_ring": {"tilt_y": "locked", "tilt_z": "locked"}},
    "life": {"contamination": "normal cleanliness"},
    "requirements": {"life": "20000 h"},
}


def test_the_verdict_comes_first_with_its_margins() -> None:
    found = api.quasistatic(CASE)
    assert isinstance(found, QuasiStatic)
    assert found.verdict is not None
    assert found.verdict.met
    text = found.text().splitlines()
    assert text[0].startswith("verdict")
    assert "of 20 000 h required" in text[0]
    # limiting speed of the 6308 is 11 000 1/min; 0.01 C = 423 N and P is 5 kN; 4.2 GPa of ISO 76
    for words in ("n 27 % of 11 000 1/min", "minimum load met 12 times", "p 55 % of 4.2 GPa"):
        assert words in text[1]


def test_modified_lives_stand_next_to_the_basic_ones() -> None:
    found = api.quasistatic(CASE)
    assert isinstance(found, QuasiStatic)
    rating = found.rating
    assert rating is not None
    other = api.compare(CASE, contamination=0.5)
    assert rating.contamination == 0.5  # lower end of 0.5 to 0.6 below 100 mm (ISO 281, table 13)
    assert rating.contamination_given
    for name, method, row in (
        ("modified_life_h", "iso-281", "modified rating life, hours"),
        ("modified_reference_life_h", "iso-ts-16281", "reference modified rating life, hours"),
    ):
        assert getattr(rating, name) == pytest.approx(other.value(method, "life", row), rel=1e-9)
    assert "L_nmh" in found.text()


@pytest.mark.parametrize(
    ("requirement", "words"),
    [
        ({"life": "1e5 h"}, "L_nmrh"),
        ({"static_safety": 10.0}, "static safety"),
        ({"viscosity_ratio": 9.0}, "kappa"),
        ({"film_parameter": 9.0}, "Lambda"),
        ({"temperature": "50 degC"}, "oil temperature"),
    ],
)
def test_each_requirement_that_is_missed_is_named(requirement: dict[str, str | float], words: str) -> None:
    found = api.quasistatic({**CASE, "requirements": requirement})
    assert isinstance(found, QuasiStatic)
    assert found.verdict is not None
    assert not found.verdict.met
    assert found.verdict.sentence.startswith("NOT MET")
    assert words in found.verdict.sentence


def test_a_load_below_the_minimum_is_its_share_of_it() -> None:
    """Say by how much."""
    idle = Margin(
        name="load", value=32.5, limit=325.0, unit="N", side="at least", is_required=False,
        met=False, share=0.1, basis="SKF: 0.01 C",
    )  # fmt: skip
    assert idle.text() == "load 10 % of the minimum of 325 N"


def test_a_life_without_given_cleanliness_counts_without_a_iso() -> None:
    found = api.quasistatic({key: value for key, value in CASE.items() if key != "life"})
    assert isinstance(found, QuasiStatic)
    assert found.verdict is not None
    assert not found.verdict.met  # L_10rh is 3 200 h
    assert "L_10rh" in found.verdict.sentence
    assert "the case gives none" in found.text()


def test_an_unknown_level_of_contamination_names_the_nearest() -> None:
    with pytest.raises(api.CaseError, match="normal cleanliness"):
        api.check({**CASE, "life": {"contamination": "normal cleanlines"}})
    assert api.check(CASE, ["life.contamination=0.7"]).contamination == 0.7  # type: ignore[union-attr]


def test_every_bearing_of_a_machine_is_judged() -> None:
    found = api.quasistatic(tomllib.loads(shaft_text("geared-shaft", "box")), ["requirements.life=20000 h"])
    assert isinstance(found, MachineEquilibrium)
    assert [one.verdict.met for one in found.bearings.values()] == [True, True]
    assert "\nverdict          left MET   right MET\n" in found.text()
    assert found.text().count("\nverdict          MET: L_nmrh") == 2


def test_one_bearing_compare_and_machines_assume_the_same_contamination_and_say_so() -> None:
    case = {key: value for key, value in CASE.items() if key not in ("life", "requirements", "bodies")}
    shaft = {
        **{key: case[key] for key in ("name", "lubricant", "operation")},
        "shaft": {"sections": [{"length": "200 mm", "diameter": "40 mm"}]},
        "bearings": {name: {**CASE["bearing"], "at": at} for name, at in (("a", "30 mm"), ("b", "170 mm"))},
        "loads": {"pull": {"at": "100 mm", "force_z": "-10 kN"}},
    }
    words = "e_C 0.5: normal cleanliness, the case gives none (life.contamination)"
    rating, other, machine = api.quasistatic(case).rating, api.compare(case), api.quasistatic(shaft)  # type: ignore[union-attr]
    assert rating is not None
    assert (rating.contamination, other.contamination, machine.bearings["a"].rating.contamination) == (0.5, 0.5, 0.5)  # type: ignore[union-attr]
    found = other.value("iso-281", "life", "modified rating life, hours")
    assert rating.modified_life_h == pytest.approx(found, rel=1e-9)
    assert all(one.rating.modified_life_h and not one.rating.contamination_given for one in machine.bearings.values())  # type: ignore[union-attr]
    assert words in api.quasistatic(case).text()
    assert f"modified lives: {words}" in other.text()
    assert f"with {words}" in machine.text()
    shafted = api.compare(shaft, bearing="a").value("iso-281", "life", "modified rating life, hours")
    assert shafted == pytest.approx(machine.bearings["a"].rating.modified_life_h, rel=1e-6)  # type: ignore[union-attr]


def test_compare_follows_the_contamination_of_the_case() -> None:
    name = ("iso-281", "life", "modified rating life, hours")
    case = {**CASE, "life": {"contamination": 0.2}}
    assert api.compare(case).value(*name) == api.compare(CASE, contamination=0.2).value(*name)
    assert "modified lives: e_C 0.2" in api.compare(case).text()
    rollers = {
        "name": "rollers",
        "bearing": {"designation": "SKF NU 208 ECP"},
        "lubricant": {"name": "FVA3A", "temperature": "60 degC"},
        "loads": {"radial": "10 kN"},
        "operation": {"speed": "1500 rpm"},
    }
    assert api.compare({**rollers, "life": {"contamination": 0.2}}).contamination == 0.2
    assert not api.compare(rollers).contamination_given


@pytest.mark.parametrize(
    ("contamination", "words"),
    [
        *((value, "e_C lies between 0 and 1") for value in (2.0, -0.1)),
        (float("nan"), "give a finite number. e_C of ISO"),
    ],
)
def test_compare_refuses_a_contamination_that_is_none(contamination: float, words: str) -> None:
    with pytest.raises(api.UsageError, match=words):
        api.compare(CASE, contamination=contamination)
