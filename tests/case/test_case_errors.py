"""Test that every mistake gives one sentence at its path."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest
from almost_right import VALID, Problems
from hypothesis import HealthCheck, example, given, settings
from hypothesis import strategies as st

from lambda_core import api
from lambda_core.case.case import Case
from lambda_core.case.case_io import bearing_case, toml_tables
from lambda_core.domain.errors import CaseError, UsageError
from lambda_core.domain.option_tree import field_at, option_paths


def test_the_valid_case_is_valid(problems: Problems) -> None:
    assert problems() == {}


@pytest.mark.parametrize(
    ("changes", "where", "said"),
    [
        ({"loads": {"radial": "16,5 kN"}}, "loads.radial", 'write a decimal point: "16.5 kN"'),
        ({"loads": {"radial": 16}}, "loads.radial", 'write "16 N"'),
        ({"loads": {"radial": "3 rpm"}}, "loads.radial", "not a unit of force"),
        ({"loads": {"radail": "3 N"}}, "loads.radail", "nearest: radial"),
        ({"output": {"tolerance": 1e-3}}, "output.tolerance", "did you mean solver.tolerance?"),
        ({"bearing": {"designation": 6208}}, "bearing.designation", 'write it in quotes: "6208"'),
        ({"bearing": {"clearance": "CX"}}, "bearing.clearance", "write C2, CN, C3, C4, C5"),
        ({"bearing": {"clearance": "C7"}}, "bearing.clearance", "is not a clearance class"),
        ({"bearing": {"clearance_pick": "midle"}}, "bearing.clearance_pick", "nearest: middle"),
        ({"bearing": {"fits": {"shaft": "12"}}}, "bearing.fits.shaft", "has no unit"),
        ({"bearing": "6208"}, "bearing", "is not a table: write its options in [bearing]"),
        (
            {"models": {"traction": {"name": "ree-eyring"}}},
            "models.traction",
            'is text in quotes, not a table: write traction = "ree-eyring"',
        ),
        (
            {"bearing": {"rollers": {"profile": {}}}},
            "bearing.rollers.profile",
            'a table is not allowed: write "iso" or',
        ),
        ({"lubricant": {"temperature": "40"}}, "lubricant.temperature", 'write "40 degC"'),
        ({"lubricant": {"temperature": None}}, "lubricant.temperature", "is required"),
        ({"lubricant": {"starvation": 1.5}}, "lubricant.starvation", "must be at most 1"),
        ({"surface": {"roughness": "-1 um"}}, "surface.roughness", "-1 um: must be greater than 0 um"),
        ({"surface": {"roughness": "-6 uin"}}, "surface.roughness", "must be greater than 0 uin"),
        ({"bearing": {"contact_angle": "50 deg"}}, "bearing.contact_angle", "50 deg: must be at most 45 deg"),
        ({"bearing": {"contact_angle": "0.9 rad"}}, "bearing.contact_angle", "must be at most 0.785398 rad"),
        ({"depth": {"strips": 2.5}}, "depth.strips", "is not a whole number"),
        ({"depth": {"cage": "of"}}, "depth.cage", "is not true or false"),
        ({"solver": {"tolerance": "fine"}}, "solver.tolerance", "is not a number without a unit"),
        ({"bodies": {"inner_ring": {"x": "fre"}}}, "bodies.inner_ring.x", "nearest: free"),
        ({"bodies": {"inner_ring": {"x": {"mode": "prescribed"}}}}, "bodies.inner_ring.x", "needs a motion"),
        (
            {"bodies": {"inner_ring": {"x": {"mode": "locked", "stiffness": "1 N/um"}}}},
            "bodies.inner_ring.x",
            'need mode = "free"',
        ),
        ({"operation": {"speed": {"kind": "rmp"}}}, "operation.speed", '"rmp" is not a kind of time function'),
        ({"operation": {"speed": {"start": "1 rpm"}}}, "operation.speed", "a time function needs its kind"),
        (
            {"operation": {"speed": {"kind": "ramp", "end": "9 rpm", "end_time": "1 s"}}},
            "operation.speed.start",
            "is required: value before the ramp",
        ),
        (
            {"operation": {"speed": {"kind": "ramp", "start": "0 rpm", "end": "9 rpm", "end_time": "1 s", "to": "9"}}},
            "operation.speed.to",
            "here are: kind, start, end, start_time, end_time",
        ),
        ({"clearance": "C3"}, "clearance", "is not an option here; did you mean bearing.clearance?"),
        (
            {"operation": {"speed": {"kind": "ramp", "start": "0 rpm", "end": "9 N", "end_time": "1 s"}}},
            "operation.speed.end",
            "not a unit of rotational_speed",
        ),
        (
            {
                "operation": {
                    "speed": {"kind": "ramp", "start": "0 rpm", "end": "9 rpm", "start_time": "2 s", "end_time": "1 s"}
                }
            },
            "operation.speed",
            "end_time must be later than start_time",
        ),
        (
            {"loads": {"radial": {"kind": "sum", "terms": ["1 N", {"kind": "harmonic", "amplitude": "1 N"}]}}},
            "loads.radial.terms.1.frequency",
            "is required",
        ),
        (
            {"loads": {"radial": {"kind": "table", "points": [["1 s", "0 N"], ["1 s", "5 N"]]}}},
            "loads.radial",
            "the times must increase",
        ),
        ({"loads": {"radial": {"kind": "table"}}}, "loads.radial", "give either `points` or `file`"),
        ({"loads": {"radial": {"kind": "table", "file": "no.csv"}}}, "loads.radial", 'cannot read "no.csv"'),
        ({"name": "a/b"}, "name", "letters, digits"),
        ({"electric": {"series": {"file": ""}}}, "electric.series.file", "is empty"),
        ({"markers": {"tip": {"body": "spindle"}}}, "markers.tip.body", "inner_ring"),
    ],
)
def test_mistake_in_the_file(problems: Problems, changes: dict[str, Any], where: str, said: str) -> None:
    found = problems(**changes)
    assert said in found[where]
    assert len(found) == 1


@pytest.mark.parametrize(
    ("changes", "where", "said"),
    [
        ({"bearing": {"designation": "6391", "maker": None}}, "bearing.designation", "nearest: 6"),
        ({"bearing": {"maker": None}}, "bearing.maker", "several makers; choose one: KOYO, NSK, SKF, Syla2026"),
        ({"bearing": {"maker": "Sila2026"}}, "bearing.maker", "Syla2026"),
        ({"bearing": {"designation": None, "maker": None}}, "bearing.designation", "is required"),
        ({"lubricant": {"name": "FVA4"}}, "lubricant.name", "nearest: FVA"),
        ({"materials": {"balls": "Si3N5"}}, "materials.balls", "nearest: Si3N4"),
        ({"bodies": {"cage": {"type": "brass-machine"}}}, "bodies.cage.type", "nearest: brass-machined"),
        ({"models": {"traction": "ree-eyrng"}}, "models.traction", "nearest: ree-eyring; available: ree-eyring"),
        (
            {"forces": {"ball_inner": {"models": {"cage_contact": "none"}}}},
            "forces.ball_inner.models.cage_contact",
            "no such role",
        ),
        ({"parameters": {"tractoin": {}}}, "parameters.tractoin", "nearest: traction"),
        (
            {"parameters": {"traction": {"tau": "5 MPa"}}},
            "parameters.traction.tau",
            "is not a known parameter of traction ree-eyring",
        ),
        ({"parameters": {"traction": {"tau_eyring": 5}}}, "parameters.traction.tau_eyring", "has no unit"),
        (
            {"parameters": {"traction": {"tau_eyring": "5 mm"}}},
            "parameters.traction.tau_eyring",
            "not a unit of pressure",
        ),
        (
            {"forces": {"ball_outer": {"parameters": {"traction": {"tau": 1}}}}},
            "forces.ball_outer.parameters.traction.tau",
            "is not a parameter of traction ree-eyring; it has:",
        ),
        (
            {"models": {"rheology": "vogel-dicke"}},
            "models.rheology",
            "density_slope, and the lubricant bode-mineral has no data for them; it has data for barus-limited, bode",
        ),
    ],
)
def test_name_that_is_not_known(problems: Problems, changes: dict[str, Any], where: str, said: str) -> None:
    assert said in problems(**changes)[where]


INLINE = {
    "ball_count": 9,
    "ball_diameter": "30 mm",
    "pitch_diameter": "147.5 mm",
    "conformity_inner": 0.515,
    "conformity_outer": 0.525,
    "bore_diameter": "95 mm",
    "outside_diameter": "200 mm",
    "width": "45 mm",
}


@pytest.mark.parametrize(
    ("geometry", "where", "said"),
    [
        (
            {"ball_count": 16},
            "bearing.geometry.ball_count",
            "16 balls of 30 mm do not fit on a pitch diameter of 147.5 mm: at most 15",
        ),
        ({"conformity_inner": 0.5}, "bearing.geometry.conformity_inner", "must be greater than 0.5"),
        (
            {"conformity_inner": None, "groove_radius_inner": "15 mm"},
            "bearing.geometry.groove_radius_inner",
            "is a conformity of 0.5: it must be larger than half the ball diameter",
        ),
        ({"groove_radius_inner": "15.5 mm"}, "bearing.geometry.conformity_inner", "write one of them"),
        ({"pitch_diameter": "90 mm"}, "bearing.geometry.pitch_diameter", "does not lie between the bore of 95 mm"),
        ({"ball_diameter": "53 mm", "ball_count": 3}, "bearing.geometry.ball_diameter", "leaves no ring"),
        (
            {"race_diameter_inner": "110 mm", "race_diameter_outer": "177 mm"},
            "bearing.geometry.pitch_diameter",
            "contradicts the raceway",
        ),
        (
            {"race_diameter_inner": "115.5 mm", "race_diameter_outer": "179.5 mm"},
            "bearing.geometry.ball_diameter",
            "contradicts the raceway diameters, which leave 32 mm",
        ),
        (
            {"shoulder_diameter_inner": "150 mm"},
            "bearing.geometry.shoulder_diameter_inner",
            "between raceway and pitch",
        ),
        ({"width": None}, "bearing.geometry.width", "is required without a designation"),
        ({"ball_diameter": None}, "bearing.geometry.ball_diameter", "is required without a designation"),
    ],
)
def test_impossible_geometry(problems: Problems, geometry: dict[str, Any], where: str, said: str) -> None:
    own = {"designation": None, "maker": None, "clearance": "CN", "geometry": {**INLINE, **geometry}}
    found = problems(bearing=own)
    assert said in found[where]


@pytest.mark.parametrize(
    ("clearance", "said"),
    [("-300 um", "more interference than a bearing survives"), ("2 mm", "lets the contacts leave the grooves")],
)
def test_clearance_of_no_real_bearing(problems: Problems, clearance: str, said: str) -> None:
    assert said in problems(bearing={"clearance": clearance})["bearing.clearance"]


def test_clearance_against_raceway_diameters(problems: Problems) -> None:
    races = {"race_diameter_inner": "48.083 mm", "race_diameter_outer": "71.917 mm"}
    assert problems(bearing={"geometry": races}) == {}
    found = problems(bearing={"geometry": races, "clearance": "20 um"})
    assert "contradicts the raceway diameters, which leave 14 um" in found["bearing.clearance"]


@pytest.mark.parametrize(
    ("changes", "where", "said"),
    [
        ({"operation": {"torque": "1 N m"}}, "operation.torque", 'needs bodies.inner_ring.spin = "free"'),
        ({"bodies": {"inner_ring": {"spin": "locked"}}}, "bodies.inner_ring.spin", "contradicts operation.speed"),
        ({"bodies": {"inner_ring": {"x": "locked"}}}, "bodies.inner_ring.x", "a load acts along it"),
        (
            {"depth": {"cage": False}, "models": {"cage_contact": "spherical-pocket"}},
            "models.cage_contact",
            "there is no cage",
        ),
        ({"depth": {"cage": False}, "loads": {"cage": {"force_x": "1 N"}}}, "loads.cage", "there is no cage"),
        ({"depth": {"cage": False}, "markers": {"a": {"body": "cage"}}}, "markers.a", "there is no cage"),
        ({"operation": {"speed": "0 rpm"}}, "solver.duration", "is required if nothing turns"),
        (
            {"solver": {"duration": "2 s", "max_duration": "1 s"}},
            "solver.duration",
            "is longer than solver.max_duration",
        ),
        ({"bodies": {"cage": {"land_clearance": "0.3 mm"}}}, "bodies.cage.land_clearance", "has no guiding land"),
        ({"bodies": {"cage": {"guidance": "outer ring"}}}, "bodies.cage.land_clearance", "is required"),
        # 500 meant for the axial load, typed one field too early
        ({"loads": {"radial_direction": "500 deg"}}, "loads.radial_direction", "-360 deg to 360 deg, not 500 deg"),
        (
            {"bodies": {"inner_ring": {"tilt_y": "4 mrad"}}},
            "bodies.inner_ring.tilt_y",
            'a motion is written { motion = "4 mrad" }',
        ),
    ],
)
def test_contradiction(problems: Problems, changes: dict[str, Any], where: str, said: str) -> None:
    found = problems(**changes)
    assert said in found[where]
    assert len(found) == 1


def test_mistakes_of_file_catalogue_registry_and_geometry_come_at_once(problems: Problems) -> None:
    found = problems(
        bearing={"designation": "6391", "maker": None},
        loads={"radial": "16,5 kN", "axial": "3 rpm"},
        models={"traction": "ree-eyrng"},
        parameters={"elastic_hysteresis": {"loss": 0.1}},
    )
    assert set(found) == {
        "loads.radial",
        "loads.axial",
        "bearing.designation",
        "models.traction",
        "parameters.elastic_hysteresis.loss",
    }


def test_missing_sections_do_not_hide_other_mistakes() -> None:
    found = {p.where: p.message for p in api.problems({"name": "x", "models": {"traction": "zzz"}})}
    assert set(found) == {"bearing", "lubricant", "operation", "models.traction"}


@pytest.mark.parametrize(
    ("line", "where", "said"),
    [
        ("radial = 16,5 kN  # load", "line 2", 'write the value in quotes: radial = "16.5 kN"'),
        ("radial = 16 kN", "line 2", 'write the value in quotes: radial = "16 kN"'),
        ('radial = "1 N"\nradial = "2 N"', "line 3", "overwrite"),
        ('radial = "1 N', "line 2", 'radial = "1 N'),
        ("radial", "line 2", "radial"),
    ],
)
def test_toml_syntax_error_names_its_line(line: str, where: str, said: str) -> None:
    with pytest.raises(CaseError) as caught:
        toml_tables(f"[loads]\n{line}\n", "my.toml")
    (problem,) = caught.value.problems
    assert problem.where == where
    assert said in problem.message
    assert str(caught.value).startswith("my.toml: 1 error\n")


def test_file_that_is_no_text(tmp_path: Path) -> None:
    path = tmp_path / "x.toml"
    path.write_bytes(b"\xff\xfe\x00\x01")
    with pytest.raises(CaseError, match="UTF-8"):
        bearing_case(path)


def test_unknown_source_offers_the_nearest_builtin_case(tmp_path: Path) -> None:
    with pytest.raises(UsageError, match="nearest built-in cases: 6319-cp10-1500"):
        bearing_case("6319-cp10-150")
    with pytest.raises(UsageError, match="is a folder"):
        bearing_case(tmp_path)


@pytest.mark.parametrize(
    ("content", "said"),
    [
        ("", "the first line must name both columns"),
        ("time,load\n0,1\n", "the first line must name both columns"),
        ("time [s],load [rpm]\n0,1\n", "line 2"),
        ("time [s],load [N]\n0,1,2\n", "expected two columns, found 3"),
        ("time [s],load [N]\n0,x\n", "line 2"),
        ("time [s],load [N]\n0,1\n", "at least two points"),
    ],
)
def test_bad_csv_table(tmp_path: Path, content: str, said: str) -> None:
    (tmp_path / "t.csv").write_text(content)
    text = '[loads]\naxial = { kind = "table", file = "t.csv" }'
    with pytest.raises(CaseError) as caught:
        bearing_case(toml_tables(text, "case"), folder=tmp_path)
    assert said in {p.where: p.message for p in caught.value.problems}["loads.axial"]


def _values() -> st.SearchStrategy[Any]:
    leaves = st.one_of(st.none(), st.booleans(), st.integers(), st.floats(), st.text(max_size=8))
    keys = st.sampled_from(["kind", "mode", "name", "ball_inner", "models", "start", "terms", "x"]) | st.text(
        max_size=5
    )
    return st.recursive(leaves, lambda inner: st.lists(inner, max_size=3) | st.dictionaries(keys, inner, max_size=3))


@settings(deadline=None, suppress_health_check=[HealthCheck.too_slow])
@example("assumptions", "\n")
@given(st.sampled_from(sorted({*VALID, *option_paths(Case)})), _values())
def test_any_value_anywhere_is_accepted_or_a_sentence(path: str, value: Any) -> None:
    change: Any = value
    for part in reversed(path.split(".")):
        change = {part: change}
    from lambda_core.case.written import merged

    for problem in api.problems(merged(VALID, change)):
        assert problem.where
        assert problem.message
        assert "\n" not in problem.message
        assert "kind:" not in problem.where


def test_every_option_explains_itself() -> None:
    found = {path: field_at(Case, path) for path in option_paths(Case)}
    assert len(found) > 300
    assert [path for path, info in found.items() if info is None or not info.description] == []
