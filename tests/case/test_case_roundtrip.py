"""Test that a case survives TOML exactly.

Saving keeps comments and everything that did not change.
"""

from __future__ import annotations

import tomllib
from pathlib import Path
from typing import Any

import pytest
from case_strategies import cases
from hypothesis import HealthCheck, given, settings

from lambda_core.case.case import Case
from lambda_core.case.case_io import (
    apply_overrides,
    bearing_case,
    builtin_cases,
    builtin_text,
)
from lambda_core.case.case_writer import case_toml, new_case, save_case, standalone_toml, tables_toml
from lambda_core.domain.errors import UsageError

BUILTIN = sorted(builtin_cases())


@settings(max_examples=60, deadline=None, suppress_health_check=[HealthCheck.too_slow, HealthCheck.data_too_large])
@given(cases())
def test_case_to_toml_to_case_is_exact(tables: dict[str, Any]) -> None:
    case = bearing_case(tables)
    assert bearing_case(tomllib.loads(case_toml(case))) == case


@pytest.mark.full
@settings(max_examples=60, deadline=None, suppress_health_check=[HealthCheck.too_slow, HealthCheck.data_too_large])
@given(cases(), cases())
def test_saving_over_another_case_gives_the_new_case(old: dict[str, Any], new: dict[str, Any]) -> None:
    text = case_toml(bearing_case(old))
    case = bearing_case(new)
    assert bearing_case(tomllib.loads(case_toml(case, original=text))) == case


@pytest.mark.parametrize("name", BUILTIN)
def test_builtin_case_is_named_after_its_file_and_survives(name: str) -> None:
    case = bearing_case(name)
    assert case.name == name
    assert case.description
    assert bearing_case(tomllib.loads(case_toml(case))) == case
    assert case_toml(case, builtin_text(name)) == builtin_text(name)


def test_saving_a_change_touches_one_line(tmp_path: Path) -> None:
    path = tmp_path / "mine.toml"
    new_case("mine", "6319-cp10-1500", path, overwrite=False)
    before = path.read_text().splitlines()
    save_case(bearing_case(path).with_(loads={"radial": "20 kN"}), path)
    after = path.read_text().splitlines()
    changed = [(old, new) for old, new in zip(before, after, strict=True) if old != new]
    assert [new.split("#")[0].strip() for _, new in changed] == ['radial = "20 kN"']
    assert changed[0][1].split("#")[1] == changed[0][0].split("#")[1]


def test_unchanged_values_keep_their_spelling(tmp_path: Path) -> None:
    path = tmp_path / "mine.toml"
    path.write_text(builtin_text("6208-axial-700").replace('"700 N"', '"0.70 kN"'))
    save_case(bearing_case(path).with_(operation={"speed": "1000 rpm"}), path)
    text = path.read_text()
    assert '"0.70 kN"' in text
    assert "# inner ring" in text
    assert bearing_case(path).operation.speed == pytest.approx(104.7197551)


@pytest.mark.parametrize("oil", ["VG 32", "an oil of a longer name"])
def test_a_changed_value_leaves_its_comment_in_the_column(oil: str) -> None:
    text = '[lubricant]\nname = "FVA3A"       # the oil\ntemperature = "60 degC" # warm\n'
    line = tables_toml({"lubricant": {"name": oil, "temperature": "60 degC"}}, text).splitlines()[1]
    written = f'name = "{oil}"'
    assert line == f"{written:<20} # the oil"


def test_none_takes_an_option_back_to_its_default() -> None:
    case = bearing_case("6319-cp10-500")
    assert "oil_level" in case.written()["lubricant"]
    assert "oil_level" not in case.with_(lubricant={"oil_level": None}).written()["lubricant"]


def test_with_replaces_a_time_function_entirely() -> None:
    ramp = {"kind": "ramp", "start": "0 N", "end": "1 kN", "end_time": "1 s"}
    case = bearing_case("6208-axial-700").with_(loads={"axial": ramp})
    harmonic = {"kind": "harmonic", "amplitude": "5 N", "frequency": "9 Hz"}
    assert case.with_(loads={"axial": harmonic}).written()["loads"]["axial"] == harmonic


def test_overrides_apply_in_order_and_read_text_and_tables() -> None:
    case = apply_overrides(
        bearing_case("6208-axial-700"),
        [
            "loads.axial=2 kN",
            "loads.axial = 3 kN",
            "bearing.designation=6319",
            "depth.strips=51",
            "depth.cage=false",
            "markers.tip.body=inner_ring",
            'loads.radial={kind="ramp", start="0 N", end="1 kN", end_time="10 ms"}',
        ],
    )
    assert case.loads.axial == 3000.0
    assert case.bearing.designation == "6319"
    assert (case.depth.strips, case.depth.cage) == (51, False)
    assert case.markers["tip"].body == "inner_ring"
    assert case.written()["loads"]["radial"]["end"] == "1 kN"


@pytest.mark.parametrize("text", ["loads.axial", "=3 N", "loads..axial=3 N", ""])
def test_override_without_path_or_value_is_a_usage_error(text: str) -> None:
    with pytest.raises(UsageError, match="write path=value"):
        apply_overrides(bearing_case("6208-axial-700"), [text])


def test_csv_table_is_read_next_to_the_case_and_written_out_for_a_result(tmp_path: Path) -> None:
    (tmp_path / "load.csv").write_text("time [ms], load [kN]\n0, 0\n100, 0.5\n200, 0.7\n")
    path = tmp_path / "mine.toml"
    path.write_text(builtin_text("6208-axial-700").replace('"700 N"', '{ kind = "table", file = "load.csv" }'))
    case = bearing_case(path)
    expected = ((0.0, 0.0), (0.1, 500.0), (0.2, 700.0))
    assert case.loads.axial.rows == expected  # type: ignore[union-attr]
    assert case.with_(depth={"cage": False}).loads.axial.rows == expected  # type: ignore[union-attr]
    alone = bearing_case(tomllib.loads(standalone_toml(case)))
    assert alone.loads.axial.rows == expected  # type: ignore[union-attr]
    assert "load.csv" not in standalone_toml(case)
    assert 'file = "load.csv"' in case_toml(case)
    chosen = apply_overrides(case, ["loads.axial.interpolation=spline"])
    for text in (case_toml(chosen, path.read_text()), standalone_toml(chosen)):
        path.write_text(text)
        assert bearing_case(path).loads.axial.interpolation == "spline"  # type: ignore[union-attr]
        assert bearing_case(path).loads.axial.rows == expected  # type: ignore[union-attr]


def test_new_case_does_not_overwrite(tmp_path: Path) -> None:
    path = tmp_path / "mine.toml"
    new_case("mine", "6208-axial-700", path, overwrite=False)
    with pytest.raises(UsageError, match="exists"):
        new_case("mine", "6208-axial-700", path, overwrite=False)
    new_case("other", str(path), tmp_path / "other.toml", overwrite=False)
    assert bearing_case(tmp_path / "other.toml").name == "other"


def test_saving_into_a_missing_folder_is_a_message(tmp_path: Path) -> None:
    with pytest.raises(UsageError, match="cannot write"):
        save_case(bearing_case("6208-axial-700"), tmp_path / "nowhere" / "x.toml")


def test_case_is_immutable_and_compares_by_value() -> None:
    one, two = bearing_case("6208-axial-700"), bearing_case("6208-axial-700")
    assert one == two
    assert one != two.with_(name="other")
    assert isinstance(one, Case)
    with pytest.raises(ValueError, match="frozen"):
        one.name = "x"  # type: ignore[misc]
