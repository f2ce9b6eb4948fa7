"""Test rows of rollers in catalogue, case and results."""

from __future__ import annotations

import json
import re
from pathlib import Path

import pytest
from lambda_cli.main import main

from lambda_core import api

CASE = """\
name = "case"
[bearing]
designation = "{designation}"
[lubricant]
name = "FVA3"
temperature = "60 degC"
[loads]
radial = "6 kN"
[operation]
speed = "3000 rpm"
"""


def case(folder: Path, designation: str, *, more: str = "") -> str:
    path = folder / "case.toml"
    path.write_text(CASE.format(designation=designation) + more)
    return str(path)


def test_a_kind_that_is_set_keeps_the_other_values_of_rollers(tmp_path: Path) -> None:
    path = case(tmp_path, "NCF 3008", more="[bearing.rollers]\nroller_count = 18\n")
    rollers = api.check(path, ["bearing.rollers.kind=NJ", "depth.cage=true"]).rollers
    assert rollers is not None
    assert (rollers.kind, rollers.count) == ("NJ", 18)


@pytest.mark.parametrize(
    ("words", "first"),
    [
        (["NU", "208"], "NU 208"),
        (["tapered", "d=40"], "30208"),
        (["needle"], "NA 4904"),
        (["cylindrical", "C>60", "maker=skf"], "N 208"),
        (["NUP", "40"], "NUP 208"),
    ],
)
def test_the_catalogue_lists_rollers(words: list[str], first: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["db", "search", *words, "--json"]) == 0
    rows = json.loads(capsys.readouterr().out)["rows"]
    assert rows[0]["designation"] == first
    assert all("roller_count" in row for row in rows)


def test_the_catalogue_shows_a_roller_bearing(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["db", "show", "SKF", "NU", "208", "ECP"]) == 0
    out = capsys.readouterr().out
    assert "effective_length   9.56  mm" in out
    assert "CN 25-50" in out
    assert "pitch 60.5 mm, roller 11 mm" in out
    assert main(["db", "show", "32216", "--json"]) == 0
    found = json.loads(capsys.readouterr().out)
    assert (found["bearing_kind"], found["values"]["roller_count"]["value"]) == ("tapered", 16)
    assert main(["db", "show", "NU", "217"]) == 3
    assert "nearest: " in capsys.readouterr().err


def test_rollers_count_from_one_as_contacts_do(tmp_path: Path) -> None:
    found = api.quasistatic(case(tmp_path, "NU 208")).bearing("bearing")
    assert found.rollers is not None
    numbers = [one.roller for one in found.rollers.loads]
    assert numbers == list(range(1, 15)) == sorted({contact.element for contact in found.contacts})
    for contact in found.contacts:
        own = found.rollers.loads[contact.element - 1]
        assert contact.load_N == (own.inner_N if contact.ring == "inner" else own.outer_N)


@pytest.mark.parametrize(
    ("designation", "changes", "sentence"),
    [
        ("NU 208", ["bearing.rollers.rib_height=6 mm"], "rib_height must be below half of the roller's diameter, 5.5"),
        ("NU 208", ["bearing.rollers.roller_length=30 mm"], "30 mm: a roller must fit into the bearing's width, 18 mm"),
        ("NU 208", ["bearing.rollers.roller_diameter=1e-17 nm"], "is too thin for a roller of 11 mm: at most 20"),
        ("NU 208", ["bearing.rollers.end_radius=0.1 mm"], "end_radius must be above 4.5 mm, where the end touches"),
        ("32216", ["bearing.rollers.end_radius=1 mm"], "end_radius leaves no contact with the rib: the sphere end"),
        ("32216", ["bearing.rollers.contact_height=30 mm"], "contact_height must be below the large end's diameter"),
        ("NU 208", ["bearing.geometry.ball_count=9"], "ball_count is that of ball bearings; rollers are described in"),
        ("NU 208", ["bearing.rollers.profile=tabulated", 'bearing.rollers.profile_points=[["0 mm", "0 um"], '
          '["6 mm", "9 mm"]]'], "profile falls by 6.95 mm at the ends: must stay below half of the roller's"),
    ],
)  # fmt: skip
def test_what_cannot_be_built_is_refused(designation: str, changes: list[str], sentence: str, tmp_path: Path) -> None:
    if designation == "32216":
        changes = [*changes, "loads.axial=6 kN"]
    with pytest.raises(api.CaseError, match=re.escape(sentence)) as refused:
        api.check(case(tmp_path, designation), changes)
    assert len(refused.value.problems) == 1
