"""Test designations with suffixes.

What a case takes from each, what is only said, and what is refused.
"""

from __future__ import annotations

from contextlib import closing
from pathlib import Path
from typing import Any

import pytest

from lambda_core import api
from lambda_core.catalogue.designation import read_designation, without_suffixes
from lambda_core.domain.errors import CaseError
from lambda_core.model.bearing_model import BearingModel
from lambda_core.model.checks.operating_limits import operating_warnings

with closing(api.catalogue()) as _opened:
    SUFFIXES = _opened.suffixes()
KNOWN = ["608", "6208", "62/22", "618/4", "6319", "623"]


@pytest.mark.parametrize(
    ("text", "base", "maker", "suffixes"),
    [
        ("6208", "6208", "", []),
        ("SKF 6208", "6208", "SKF", []),
        ("6208 SKF", "6208", "SKF", []),
        ("SKF 6208-2Z/C3", "6208", "SKF", ["2Z", "C3"]),
        ("6208-2RS1", "6208", "", ["2RS1"]),
        ("6208 C3", "6208", "", ["C3"]),
        ("FAG 6319-M", "6319", "FAG", ["M"]),
        ("6208-2RSR-C3", "6208", "", ["2RSR", "C3"]),
        ("6208-C-2HRS-C3", "6208", "", ["C", "2HRS", "C3"]),
        ("6208-2Z.C3.L138", "6208", "", ["2Z", "C3", "L138"]),
        ("6208ZZC3", "6208", "", ["ZZ", "C3"]),
        ("6208DDUCM NSK", "6208", "NSK", ["DDU", "CM"]),
        ("nsk 6208vv", "6208", "nsk", ["VV"]),
        ("6208LLU/C3", "6208", "", ["LLU", "C3"]),
        ("6208-2RS1TN9/C3WT", "6208", "", ["2RS1", "TN9", "C3", "WT"]),
        ("6208-2RSH/C3GJN", "6208", "", ["2RSH", "C3", "GJN"]),
        ("6319 M/C3VL0241", "6319", "", ["M", "C3", "VL0241"]),
        ("6319-M-C4-S0", "6319", "", ["M", "C4", "S0"]),
        ("6319 MA SKF C4", "6319", "SKF", ["MA", "C4"]),
        ("6208 NR", "6208", "", ["NR"]),
        ("6208-ZNR", "6208", "", ["Z", "NR"]),
        ("6208/P63", "6208", "", ["P63"]),
        ("6208/P6 CNL", "6208", "", ["P6", "CNL"]),
        ("608/HC5C3", "608", "", ["HC5", "C3"]),
        ("62/22-2Z", "62/22", "", ["2Z"]),
        ("618/4-2RZ", "618/4", "", ["2RZ"]),
        ("623-Z", "623", "", ["Z"]),
    ],
)
def test_a_designation_is_taken_apart(text: str, base: str, maker: str, suffixes: list[str]) -> None:
    found = read_designation(text, KNOWN, SUFFIXES)
    assert found is not None
    assert (found.base, found.maker, [written for written, _ in found.suffixes]) == (base, maker, suffixes)


def test_a_row_whose_own_designation_has_a_suffix_comes_first() -> None:
    found = read_designation("6208-2Z/C3", [*KNOWN, "6208-2Z"], SUFFIXES)
    assert found is not None
    assert (found.base, [written for written, _ in found.suffixes]) == ("6208-2Z", ["C3"])


def test_no_bearing_stands_in_it() -> None:
    assert read_designation("62081", KNOWN, SUFFIXES) is None
    assert read_designation("NU 208", KNOWN, SUFFIXES) is None


@pytest.mark.parametrize(
    ("text", "kept"),
    [("6208-2Z/C3", "6208"), ("6208 C3 skf", "6208 skf"), ("6208 N", "6208 N"), ("62 40", "62 40"), ("C3", "C3"),
     ("d=40 C>30", "d=40 C>30"), ("6208 d=40", "6208 d=40"), ("618/4-2Z", "618/4"), ("6208-2RSX", "6208-2RSX")],
)  # fmt: skip
def test_a_search_leaves_suffixes_out(text: str, kept: str) -> None:
    assert without_suffixes(text, KNOWN, SUFFIXES) == kept


def model(designation: str, **changes: Any) -> BearingModel:
    tables = api.case("6208-axial-1300").written()
    del tables["bodies"]  # it names a cage
    bearing = {"designation": designation} | changes.pop("bearing", {})
    return api.check(tables | {"bearing": bearing} | changes)


# ISO 5753-1, bore 40 mm: CN 6 to 20, C3 15 to 33, C4 28 to 46 um
@pytest.mark.parametrize(
    ("suffix", "clearance"),
    [
        ("", 13.0),
        ("/CN", 13.0),
        ("-C0", 13.0),
        ("/C3", 24.0),
        (" C4", 37.0),
        ("/P63", 24.0),
        ("/C3L", 0.5 * (15.0 + 24.0)),
        ("/C3H", 0.5 * (24.0 + 33.0)),
        ("/C3M", 24.0),
        ("/C3P", 0.5 * (24.0 + 37.0)),
        ("/CNH", 0.5 * (13.0 + 20.0)),
    ],
)
def test_the_clearance_class_is_taken(suffix: str, clearance: float) -> None:
    assert model(f"SKF 6208{suffix}").geometry.clearance * 1e6 == pytest.approx(clearance)


@pytest.mark.parametrize(
    ("suffix", "cage", "guidance"),
    [
        ("", "steel-ribbon", "ball"),
        ("J", "steel-ribbon", "ball"),
        ("M", "brass-machined", "ball"),
        ("MA", "brass-outer-ring", "outer ring"),
        ("MB", "brass-inner-ring", "inner ring"),
        ("TN9", "pa66", "ball"),
        ("TVH", "pa66", "ball"),
        ("TNH", "peek", "ball"),
    ],
)
def test_the_cage_is_taken(suffix: str, cage: str, guidance: str) -> None:
    found = model(f"SKF 6208 {suffix}")
    assert (found.cage.type, found.cage.guidance) == (cage, guidance)
    assert found.title == f"6208{' ' if suffix else ''}{suffix} (SKF)"


def test_ceramic_balls_are_taken() -> None:
    assert model("SKF 6208/HC5").ball_material.name == "Si3N4"


def test_a_designation_means_what_the_same_options_mean() -> None:
    """Compare the numbers of suffixes and of equal options.

    The result keeps the suffixes as they were written.
    """
    named = model("SKF 6208-2Z/C3 MA")
    plain = model("6208", bearing={"maker": "SKF", "clearance": "C3"}, bodies={"cage": {"type": "brass-outer-ring"}})
    assert api.describe(named).hash == api.describe(plain).hash
    assert "6208-2Z/C3 MA" in named.case_toml
    origins = {v.path: (v.value, v.status) for v in named.values if v.path.startswith("bearing.designation")}
    assert origins["bearing.designation: C3"] == ("C3", "given")
    assert origins["bearing.designation: MA"] == ("brass-outer-ring", "given")


@pytest.mark.parametrize(
    ("suffix", "words"),
    [
        ("-2RS1", "2RS1 of the designation: contact seal (NBR) on both sides: its friction is in SKF's method alone"),
        ("-2Z", "2Z of the designation: shield on both sides: they do not touch"),
        ("/P6", "P6 of the designation: precision class of ISO 492: the model's rings and balls run true"),
        ("/S1", "S1 of the designation: rings heat-stabilised"),
        ("-NR", "NR of the designation: snap ring"),
        ("-2RSH/GJN", "grease filling: the model has the oil that the case names"),
        ("/P63", "P63 of the designation: precision class P6"),
    ],
)
def test_what_the_model_does_not_use_is_said(suffix: str, words: str) -> None:
    assert any(words in sentence for sentence in model(f"SKF 6208{suffix}").assumptions)


@pytest.mark.parametrize(
    ("designation", "changes", "words", "found"),
    [
        ("SKF 6208/C3", {"bearing": {"clearance": "14 um"}}, "C3 of the designation", {"clearance": 14e-6}),
        ("SKF 6208/C3", {"bearing": {"clearance": "C4"}}, "bearing.clearance = C4", {"clearance": 37e-6}),
        ("SKF 6208 M", {"bodies": {"cage": {"type": "pa66"}}}, "bodies.cage.type = pa66", {"cage": "pa66"}),
        ("SKF 6208/HC5", {"materials": {"balls": "ZrO2"}}, "materials.balls of the case", {"balls": "ZrO2"}),
    ],
)
def test_what_the_case_says_wins(designation: str, changes: Any, words: str, found: dict[str, Any]) -> None:
    resolved = model(designation, **changes)
    values = {
        "clearance": resolved.geometry.clearance,
        "cage": resolved.cage.type,
        "balls": resolved.ball_material.name,
    }
    for name, value in found.items():
        assert values[name] == (pytest.approx(value) if isinstance(value, float) else value)
    said = [sentence for sentence in resolved.assumptions if "is ignored" in sentence]
    assert len(said) == 1
    assert words in said[0]


@pytest.mark.parametrize(("clearance", "count"), [("C3", 1), ("C2", 0), ("6 um", 0)])
def test_two_classes_of_clearance_are_a_warning(clearance: str, count: int) -> None:
    """Accept a measured value next to a class of clearance.

    A second class is a mistake in one of the two.
    """
    warned = operating_warnings(model("SKF 6208 C2", bearing={"clearance": clearance}))
    assert [sentence for sentence in warned if "contradict" in sentence] == count * [
        "C2 of the designation and bearing.clearance = C3 contradict each other: C3 counts"
    ]


@pytest.mark.parametrize(
    ("designation", "bearing", "where", "words"),
    [
        ("SKF 6208-2RSX", {}, "bearing.designation", '"2RSX" is not a known suffix of 6208; nearest: 2RS'),
        ("SKF 6208 C7", {}, "bearing.designation", '"C7" is not a known suffix of 6208; classes of clearance: C2, CN'),
        ("SKF 6208/C5 C3", {}, "bearing.designation", '"C5" and "C3" contradict each other'),
        ("SKF 6208-MTN9", {}, "bearing.designation", '"M" and "TN9" contradict each other'),
        ("SKF 6208 E", {}, "bearing.designation", "reinforced ball set"),
        ("SKF 6208/C1", {}, "bearing.clearance", "is not in the catalogue; write its value"),
        ("NSK 6208CM", {}, "bearing.clearance", "CM (radial clearance for electric motors) is not in the catalogue"),
        ("SKF 6208/C5P", {}, "bearing.clearance", "reaches into the class above C5"),
        ("SKF 6208-Y", {}, "bodies.cage.type", "Y (pressed brass cage) is not in the catalogue"),
        (
            "FAG 6319-M",
            {},
            "bearing.maker",
            '"FAG" is not a maker of 6319 in the catalogue; makers: KOYO, SKF, Syla2026',
        ),
        ("6208-2Z", {}, "bearing.maker", "several makers; choose one"),
        ("SKF 6208-2Z", {"maker": "NSK"}, "bearing.maker", 'names "SKF", and the maker is "NSK"'),
        ("6288-2Z", {}, "bearing.designation", "is not a known bearing; nearest: 62"),
    ],
)
def test_what_cannot_be_is_refused(designation: str, bearing: dict[str, str], where: str, words: str) -> None:
    with pytest.raises(CaseError) as caught:
        model(designation, bearing=bearing)
    assert any(problem.where == where and words in problem.message for problem in caught.value.problems)


def test_a_reinforced_ball_set_is_written_in_the_case() -> None:
    balls = {"geometry": {"ball_count": 9, "ball_diameter": "12.7 mm"}}
    assert model("SKF 6208 E", bearing=balls).geometry.ball_diameter == pytest.approx(12.7e-3)


def test_every_suffix_decides_something_the_catalogue_has_and_stands_in_the_documentation() -> None:
    page = (Path(__file__).parents[2] / "docs" / "catalogue.md").read_text(encoding="utf-8")
    catalogue = api.catalogue()
    cages, materials = catalogue.names("cage"), catalogue.names("material")
    catalogue.close()
    assert len(SUFFIXES) > 80
    for suffix in SUFFIXES:
        assert suffix.matches(suffix.written), suffix
        assert f"`{suffix.written}`" in page, suffix
        if suffix.kind == "cage" and suffix.value:
            assert suffix.value in cages
        if suffix.kind == "balls":
            assert suffix.value in materials
