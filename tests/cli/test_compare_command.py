"""Test lambda-bearing compare.

Methods and a result side by side, mistakes named.
"""

from __future__ import annotations

import json

import pytest
from lambda_cli.main import main

CASE = "6208-axial-1300"


def test_every_builtin_method_answers_or_says_why(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["compare", CASE, "--json", "-q"]) == 0
    found = json.loads(capsys.readouterr().out)
    methods = {method["name"]: method for method in found["methods"]}
    assert {"skf", "schaeffler", "analytical-capacitance", "iso-281", "iso-ts-16281", "quasi-static"} <= set(methods)
    assert all(bool(method["numbers"]) != bool(method["reason"]) for method in methods.values())
    stiffness = {n["name"]: n["value"] for n in methods["quasi-static"]["numbers"] if n["group"] == "stiffness"}
    assert len(stiffness) == 15
    assert stiffness["y y"] == pytest.approx(stiffness["z z"], rel=1e-3)  # axial load alone: no direction is special


def test_text_has_one_table_per_group(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["compare", CASE, "--method", "skf", "--method", "quasi-static", "-q"]) == 0
    text = capsys.readouterr().out
    header = next(line for line in text.splitlines() if line.startswith("friction"))
    assert header.split() == ["friction", "skf", "quasi-static"]
    assert "schaeffler" not in text
    # Rounding is no number for people: under an axial load alone the ring does not move sideways.
    assert next(line for line in text.splitlines() if "[N mm]" in line and "land" in line).split()[-1] == "0"
    assert "e-1" not in text.partition("stiffness")[2]


def test_unknown_method_is_named_with_the_nearest(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["compare", CASE, "--method", "skff", "-q"]) == 2
    assert "skf" in capsys.readouterr().err.replace("skff", "")


@pytest.mark.parametrize("arguments", [["a.h5"], ["a.h5", "b.h5"]])
def test_a1_results_are_pointed_to_show_and_view(arguments: list[str], capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["compare", *arguments]) == 2
    assert "lambda-bearing show A.h5 B.h5, or view A.h5 B.h5" in capsys.readouterr().err
