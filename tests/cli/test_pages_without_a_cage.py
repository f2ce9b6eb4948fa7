"""Test that pages of a full complement name no cage.

What is its cage's elsewhere is that of rollers as they go round and rub each other. JSON keeps its names.
"""

from __future__ import annotations

import json
import re
from collections.abc import Callable
from pathlib import Path

import pytest
from lambda_cli.main import main

CASE = """
name = "full"
[bearing]
designation = "SKF NCF 3008"
[lubricant]
name = "FVA3"
temperature = "70 degC"
[loads]
radial = "5 kN"
[operation]
speed = "1000 rpm"
[output]
interval = "0.3 ms"
"""
# Names of the contract, the option and the law, and the sentence that says what is missing.
ALLOWED = re.compile(r"no cage: neighbouring|cage off|cage_contact|cage is switched off|cage type|cage_\w+|code of")


@pytest.fixture(scope="module")
def run(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return the case of a short run."""
    path = tmp_path_factory.mktemp("full") / "full.toml"
    path.write_text(CASE)
    words = ["run", str(path), "--duration", "2 ms", "--band", "none", "--quiet", "--out", str(path.with_suffix(".h5"))]
    assert main(words) == 5
    return path


def said(text: str) -> list[str]:
    return [line for line in text.splitlines() if "cage" in ALLOWED.sub("", line)]


@pytest.mark.parametrize(
    "words",
    [
        lambda case: ["check", case, "--all"],
        lambda case: ["quasistatic", case, "--quiet"],
        lambda case: ["show", case.replace(".toml", ".h5")],
        lambda case: ["compare", case, "--quiet", "--result", case.replace(".toml", ".h5")],
        lambda case: ["thermal", case, "--quiet", "--band", "none"],
        lambda case: ["estimate", case, "--quiet"],
        lambda case: ["electric", case.replace(".toml", ".h5"), "--quiet", "--duration", "2 ms"],
    ],
    ids=["check", "quasistatic", "show", "compare", "thermal", "estimate", "electric"],
)
def test_pages_name_no_cage(words: Callable[[str], list[str]], run: Path, capsys: pytest.CaptureFixture[str]) -> None:
    capsys.readouterr()
    assert main(words(str(run))) in (0, 5)
    out, err = capsys.readouterr()
    assert said(out) == []
    assert said(err) == []


def test_summary_names_orbit_and_neighbours(run: Path, capsys: pytest.CaptureFixture[str]) -> None:
    capsys.readouterr()
    assert main(["show", str(run.with_suffix(".h5"))]) == 0
    text = capsys.readouterr().out
    assert re.search(r"^roller orbit +0\.4\d+ of inner ring", text, re.M)
    assert re.search(r"neighbours \d", text)
    assert "whole roller orbits were averaged" in text
    assert main(["show", str(run.with_suffix(".h5")), "--json"]) == 0
    (found,) = json.loads(capsys.readouterr().out)["bearings"].values()
    assert found["full_complement"]
    assert found["cage_speed_ratio"] > 0.4


def test_report_names_no_cage(run: Path, tmp_path: Path) -> None:
    page = tmp_path / "page.html"
    assert main(["report", str(run.with_suffix(".h5")), "--out", str(page)]) == 0
    words = re.sub(r"<!--|-->|<style.*?</style>|<[^>]*>", " ", page.read_text(), flags=re.S)
    assert said(words) == []
