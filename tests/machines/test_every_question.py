"""Every question that one bearing answers, asked of a machine of two bearings by its command."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from lambda_cli.main import main

# Question: what is asked of the file, and what the answer has to contain. Commands that print JSON are read as it.
QUESTIONS = {
    "check": (["check", "box.toml", "--json"], "bearings"),
    "quasistatic": (["quasistatic", "box.toml", "--json", "-q"], "system_life_h"),
    "modes": (["modes", "box.toml", "--json", "-q"], "critical_speeds"),
    "stribeck": (["stribeck", "box.toml", "--bearing", "left", "--speed", "100 rpm", "--speed", "1000 rpm", "--json"],
                 "torque_Nmm"),
    "compare": (["compare", "box.toml", "--bearing", "right", "--json", "-q"], "methods"),
    "cross-check of one": (
        ["cross-check", "box.toml", "--bearing", "right", "--duration", "1 ms", "--json", "-q"], "agree"),
    "cross-check": (["cross-check", "box.toml", "--duration", "1 ms", "--json", "-q"], "agree"),
    "electric-map": (["electric-map", "box.toml", "--bearing", "left", "--points", "1x1", "--executor", "here",
                      "--set", "electric.duration=2 ms", "--json", "-q"], "points"),
    "study": (["study", "run", "study.toml", "--executor", "here", "--json", "-q"], "done"),
    "thermal": (["thermal", "box.toml", "--json", "-q"], "temperatures_degC"),
    "estimate": (["estimate", "box.toml", "--json", "-q"], "processor_s"),
    "duty": (["duty", "day.toml", "--json", "-q"], "system_life_h"),
}  # fmt: skip
DAY = """
name = "day"
case = "box.toml"
[[phases]]
name = "all day"
time = "8 h"
"""
STUDY = """
name = "power"
case = "box.toml"
responses = ["system_life_h"]
[[parameters]]
path = "gears.wheel.power"
values = ["5 kW", "15 kW"]
"""
ABOUT_ONE = ("stribeck", "compare", "electric-map")


@pytest.fixture
def box(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Work in a folder with the case of a shaft in two bearings."""
    monkeypatch.chdir(tmp_path)
    assert main(["init", "box", "--template", "geared-shaft"]) == 0
    (tmp_path / "study.toml").write_text(STUDY)
    (tmp_path / "day.toml").write_text(DAY)
    return tmp_path / "box.toml"


@pytest.mark.parametrize("question", QUESTIONS)
def test_a_machine_answers(question: str, box: Path, capsys: pytest.CaptureFixture[str]) -> None:
    if question.startswith("cross-check"):
        pytest.importorskip("sksundae")
    capsys.readouterr()
    arguments, contained = QUESTIONS[question]
    assert main(arguments) == 0
    assert contained in json.loads(capsys.readouterr().out)


@pytest.mark.parametrize("question", ABOUT_ONE)
def test_a_question_about_one_bearing_names_those_there_are(
    question: str, box: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    arguments = list(QUESTIONS[question][0])
    at = arguments.index("--bearing")
    capsys.readouterr()
    assert main([*arguments[:at], *arguments[at + 2 :]]) == 2
    assert "--bearing (left, right)" in capsys.readouterr().err
    assert main([*arguments[: at + 1], "rigth", *arguments[at + 2 :]]) == 2
    assert '"rigth" is not a known bearing; nearest: right' in capsys.readouterr().err
    single = ["6208-axial-1300" if part == "box.toml" else part for part in arguments]
    assert main(single) == 2
    assert "one bearing: leave out --bearing" in capsys.readouterr().err
