"""Test the messages about unknown names and missing files."""

from __future__ import annotations

from pathlib import Path

import pytest
from lambda_cli.main import main

from lambda_core.domain.errors import nearest


def test_swapped_neighbours_come_first() -> None:
    assert nearest("6380", ["6303", "61803", "6308", "6300"])[0] == "6308"


@pytest.mark.parametrize("words", [["FAG", "6308"], ["NU999"]])
def test_a_search_without_rows_says_what_the_catalogue_holds(
    words: list[str], capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["db", "search", *words]) == 3
    shown = capsys.readouterr()
    assert shown.out == ""
    assert f'nothing matches "{" ".join(words)}"' in shown.err
    assert "angular contact, four-point contact, double row and self-aligning ball bearings of" in shown.err
    assert "oils and greases: --lubricants" in shown.err


def test_a_slip_in_a_file_name_names_the_file_next_to_it(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("motor.toml").write_text("")
    assert main(["check", "moter.toml"]) == 2
    assert "nearest files there: motor.toml" in capsys.readouterr().err


def test_a_bad_name_is_blamed_on_the_new_case(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    assert main(["init", "my motor"]) == 3
    said = capsys.readouterr().err
    assert 'new case "my motor": 1 error' in said
    assert "6319-cp10-1500" not in said


def test_show_takes_bare_words(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["db", "show", "SKF", "6308", "C3"]) == 0
    assert "6308  SKF" in capsys.readouterr().out


@pytest.mark.parametrize("words", [["show"], ["search"]])
@pytest.mark.parametrize(
    ("designation", "kind"),
    [("22208", "spherical roller"), ("81112", "needle roller thrust"), ("NN 3008", "double row cylindrical roller")],
)
def test_kinds_that_are_not_simulated_are_named(
    words: list[str], designation: str, kind: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["db", *words, designation]) == 3
    said = capsys.readouterr().err
    assert kind in said
    assert "a kind that is not simulated; nearest kind: " in said


def test_catalogue_says_which_rollers_it_has_not(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["db", "search", "spherical"]) == 3
    assert "no spherical, toroidal or thrust bearings" in capsys.readouterr().err
