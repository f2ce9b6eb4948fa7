"""Test the commands of `lambda-bearing db`.

Data on stdout, talk on stderr, exit codes, JSON for every number.
"""

from __future__ import annotations

import contextlib
import json
import sqlite3
from pathlib import Path
from typing import Any

import pytest
from lambda_cli.main import main

ADD = ["db", "add", "bearing", "designation=6208", "maker=FAG", "bore_diameter=40 mm", "outside_diameter=80 mm"]
ADD += ["width=18 mm", "source=FAG catalogue", "grade=A"]


@pytest.fixture(autouse=True)
def own_data(user_folder: Path) -> Path:
    return user_folder


def run(capsys: pytest.CaptureFixture[str], *arguments: str) -> tuple[int, str, str]:
    code = main(list(arguments))
    captured = capsys.readouterr()
    return code, captured.out, captured.err


def data(capsys: pytest.CaptureFixture[str], *arguments: str) -> dict[str, Any]:
    code, out, err = run(capsys, *arguments, "--json")
    assert (code, err) == (0, "")
    loaded: dict[str, Any] = json.loads(out)
    assert loaded["version"] == 1
    return loaded


def test_show_table_6(capsys: pytest.CaptureFixture[str]) -> None:
    shown = data(capsys, "db", "show", "6208", "--maker", "Syla2026")
    assert data(capsys, "db", "show", "syla2026 6208") == shown
    printed = {
        "outside_diameter": 80.0,
        "bore_diameter": 40.0,
        "pitch_diameter": 60.0,
        "race_diameter_inner": 48.083,
        "race_diameter_outer": 71.917,
        "ball_diameter": 11.91,
        "groove_radius_inner": 6.19,
        "groove_radius_outer": 6.31,
        "ball_count": 9,
    }
    assert {name: shown["values"][name]["value"] for name in printed} == printed
    assert all(value["source"] and value["grade"] for value in shown["values"].values())
    cn = next(c for c in shown["clearances"] if c["class"] == "CN")
    assert (cn["minimum_um"], cn["maximum_um"]) == (6, 20)


def test_show_table_3(capsys: pytest.CaptureFixture[str]) -> None:
    code, out, _ = run(capsys, "db", "show", "6319", "--maker", "syla2026")
    assert code == 0
    for text in ("147.5", "117.4", "177.5", "15.375", "15.75", "160", "Table 3", "CN 12-36"):
        assert text in out


def test_show_marks_estimates_and_lists_candidates(capsys: pytest.CaptureFixture[str]) -> None:
    code, out, _ = run(capsys, "db", "show", "6208", "--maker", "NSK")
    assert code == 0
    assert "≈ derived" in out
    assert "≈ assumed" in out
    assert "9 x 11.906" in out
    assert "inner geometry is estimated; candidates" in out
    shown = data(capsys, "db", "show", "6208", "--maker", "NSK")
    assert shown["candidates"][0]["ball_count"] == 9
    assert shown["values"]["dynamic_rating"] == {
        "value": 29.1,
        "unit": "kN",
        "status": "published",
        "grade": "A-",
        "source": "NSK Rolling Bearings catalogue",
    }


@pytest.mark.parametrize(
    ("arguments", "code", "message"),
    [
        (["show", "6208"], 3, "several makers; choose one: KOYO, NSK, SKF, Syla2026"),
        (["show", "XX 6208"], 3, '"XX" is not a maker of 6208'),
        (["show", "fva4"], 3, "nearest: FVA3"),
        (["show", "FVA3", "--temperature", "40"], 2, 'has no unit: write "40 degC"'),
        (["show", "FVA3", "--rheology", "bode"], 3, "is not a known law with data"),
        (["search", "d>x"], 3, "is not a number"),
        (["add", "bering", "x=1"], 2, "nearest: bearing"),
        (["add", "bearing", "designation"], 2, "write NAME=VALUE"),
        (["add", "bearing", "maker=a", "maker=b"], 2, "is given twice"),
        (["import", "nowhere.csv"], 2, "does not exist"),
        (["export", "out.xls"], 2, "export to a"),
    ],
)
def test_mistakes(capsys: pytest.CaptureFixture[str], arguments: list[str], code: int, message: str) -> None:
    found, out, err = run(capsys, "db", *arguments)
    assert (found, out) == (code, "")
    assert message in err
    assert "Traceback" not in err


def test_show_lubricant(capsys: pytest.CaptureFixture[str]) -> None:
    shown = data(capsys, "db", "show", "bode", "--temperature", "40 degC", "--pressure", "0 Pa", "--pressure", "1 GPa")
    assert shown["name"] == "bode-mineral"
    ambient, pressed = shown["table"]["points"]
    assert ambient["viscosity_mPas"] == pytest.approx(97.3, abs=0.05)
    assert pressed["permittivity"] == pytest.approx(2.51, abs=0.005)
    assert shown["table"]["coefficients"][0]["alpha_tangent_per_GPa"] == pytest.approx(20.4, abs=0.05)
    assert {"role", "model", "name", "value", "unit", "source", "grade", "status"} == set(shown["parameters"][0])
    code, out, _ = run(capsys, "db", "show", "FVA3A")
    assert code == 0
    assert "proxy" in out
    assert "valid " in out


def test_show_cage_and_material(capsys: pytest.CaptureFixture[str]) -> None:
    assert data(capsys, "db", "show", "TN9")["values"]["maximum_temperature"]["value"] == 120
    shown = data(capsys, "db", "show", "52100")
    assert (shown["kind"], shown["values"]["youngs_modulus"]["value"]) == ("material", 210)


@pytest.mark.parametrize("words", [["NU", "208"], ["NU208"], ["skf", "nu", "208"], ["32216"]])
def test_a_search_finds_rollers(words: list[str], capsys: pytest.CaptureFixture[str]) -> None:
    row = data(capsys, "db", "search", *words)["rows"][0]
    tapered = words == ["32216"]
    assert (row["designation"], row["kind"]) == (("32216", "tapered") if tapered else ("NU 208", "NU"))
    assert (row["bore_mm"], row["outside_mm"]) == ((80.0, 140.0) if tapered else (40.0, 80.0))
    assert row["C_kN"] > 50.0
    _, out, _ = run(capsys, "db", "search", *words)
    assert f"{row['roller_count']} x {row['roller_diameter_mm']:g}" in out.replace(".000", "")


def test_search(capsys: pytest.CaptureFixture[str]) -> None:
    rows = data(capsys, "db", "search", "--bore", "40", "--series", "62")["rows"]
    assert [row["maker"] for row in rows] == ["KOYO", "NSK", "SKF", "Syla2026"]
    rows = data(capsys, "db", "search", "--bore", "40", "--rating", "40", "--maker", "skf", "--width", "23")["rows"]
    names = [row["designation"] for row in rows]
    rollers = ["N 308", "NJ 2208", "NJ 308", "NU 2208", "NU 308", "NUP 2208", "NUP 308"]
    assert names == ["6308", "7308BE", "QJ308", *rollers]
    code, out, _ = run(capsys, "db", "search", "6208")
    assert code == 0
    assert "≈ 9 x 12.303" in out
    assert "A published" in out
    assert [row["name"] for row in data(capsys, "db", "search", "--lubricants", "fva")["rows"]] == [
        "FVA2",
        "FVA3",
        "FVA3A",
    ]


def test_names_of_oils_are_complete_in_a_narrow_terminal(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    from lambda_cli import db_text

    monkeypatch.setattr(db_text, "columns", lambda: 80)
    assert main(["db", "search", "--lubricants", "vg"]) == 0
    narrow = capsys.readouterr().out
    assert "light-machine-oil-mvi" in narrow
    assert "note" not in narrow.splitlines()[0]
    assert "lambda-bearing db show NAME" in narrow
    monkeypatch.setattr(db_text, "columns", lambda: 120)
    assert main(["db", "search", "--lubricants", "vg"]) == 0
    assert "note" in capsys.readouterr().out.splitlines()[0]


def test_add_then_show(capsys: pytest.CaptureFixture[str]) -> None:
    code, out, err = run(capsys, *ADD)
    assert (code, err) == (0, "")
    assert "added 1 bearing row" in out
    shown = data(capsys, "db", "show", "6208", "--maker", "fag")
    assert (shown["layer"], shown["values"]["width"]["source"]) == ("user", "FAG catalogue")
    code, out, err = run(capsys, *ADD)
    assert (code, out) == (3, "")
    assert "--replace puts the new one in its place" in err
    assert data(capsys, *ADD, "--replace")["replaced"] == {"bearing": 1}


@pytest.mark.full
def test_export_and_import(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    run(capsys, *ADD)
    mine = tmp_path / "mine.toml"
    assert data(capsys, "db", "export", str(mine), "--mine")["rows"]["bearing"] == 1
    bearings = tmp_path / "bearing.csv"
    assert data(capsys, "db", "export", str(bearings))["rows"] == {"bearing": 752}
    bearings.write_text(bearings.read_text(encoding="utf-8") + "x" + "," * 48 + "\n", encoding="utf-8")
    code, _, err = run(capsys, "db", "import", str(bearings), "--replace")
    assert code == 3
    assert "nothing was written; --keep-good takes the 752 good rows" in err
    code, out, err = run(capsys, "db", "import", str(bearings), "--replace", "--keep-good")
    assert code == 3
    assert "added 751 bearing rows" in out
    assert "refused bearing.csv line 754" in err


def test_check(capsys: pytest.CaptureFixture[str]) -> None:
    found = data(capsys, "db", "check")["findings"]
    assert [finding["severity"] for finding in found] == ["warning"]
    run(capsys, "db", "add", "lubricant", "name=empty", "base_type=PAO", "rheology=roelands")
    code, out, _ = run(capsys, "db", "check")
    assert code == 3
    assert "errors: 1" in out


def test_help_lists_the_commands(capsys: pytest.CaptureFixture[str]) -> None:
    code, out, _ = run(capsys, "db", "--help")
    assert code == 0
    for name in ("search", "show", "add", "import", "export", "check"):
        assert name in out


def test_a_catalogue_edited_by_hand_is_accepted(
    capsys: pytest.CaptureFixture[str], caplog: pytest.LogCaptureFixture, own_data: Path
) -> None:
    assert run(capsys, *ADD)[0] == 0
    with contextlib.closing(sqlite3.connect(own_data / "catalogue.sqlite")) as connection, connection:
        connection.execute("UPDATE bearing SET width_mm = 19")
    assert run(capsys, "db", "show", "6208", "--maker", "FAG")[:2] == (3, "")
    assert "bearing 6208 FAG is changed; if that is right: lambda-bearing db accept" in caplog.text
    assert data(capsys, "db", "accept")["differences"] == ["bearing 6208 FAG is changed"]
    assert data(capsys, "db", "show", "6208", "--maker", "FAG")["values"]["width"]["value"] == 19.0
    code, out, err = run(capsys, "db", "accept")
    assert (code, err) == (0, "")
    assert out.startswith("accepted: 0 differences in ")


def test_a_grease_is_shown_with_its_class_and_temperatures(capsys: pytest.CaptureFixture[str]) -> None:
    code, out, _ = run(capsys, "db", "show", "arcanol-multi2")
    assert code == 0
    assert "NLGI 2, lithium soap" in out
    values = data(capsys, "db", "show", "arcanol-multi2")["values"]
    shown = {name: (value["value"], value["unit"]) for name, value in values.items()}
    assert shown["nlgi"] == (2, "")
    assert (shown["lowest_temperature"], shown["highest_temperature"]) == ((-30, "degC"), (120, "degC"))


def test_greases_stand_out_among_the_oils(capsys: pytest.CaptureFixture[str]) -> None:
    _, out, _ = run(capsys, "db", "search", "--lubricants", "mineral-vg100")
    assert "mineral  " in out
    _, out, _ = run(capsys, "db", "search", "--lubricants", "multi2")
    assert "arcanol-multi2  grease" in out
