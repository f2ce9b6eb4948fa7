"""Test results side by side."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING

import pytest
from lambda_cli.main import main

from lambda_core import api
from lambda_core.domain.errors import UsageError

if TYPE_CHECKING:
    from lambda_core.results.reader import Result


def test_what_differs_is_what_the_cases_say(radial_run: Result, combined_run: Result) -> None:
    found = api.side_by_side([radial_run, combined_run])
    inputs = {row.option: row.values for row in found.inputs}
    cases = [run.case_toml for run in (radial_run, combined_run)]
    assert inputs
    for option, values in inputs.items():
        assert len(set(values)) == 2, option
        for value, text in zip(values, cases, strict=True):
            assert value is None or value in text
    assert "name" not in inputs
    numbers = {row.name: row.values for row in found.numbers}
    assert numbers["friction torque"] == [run.summary().friction_torque_Nmm for run in (radial_run, combined_run)]
    rating = combined_run.rating
    assert rating is not None
    assert numbers["reference rating life L_10rh of ISO/TS 16281"][1] == rating.reference_life_h


def test_one_result_twice_has_the_same_inputs(radial_run: Result) -> None:
    found = api.side_by_side([radial_run, radial_run])
    assert found.inputs == []
    assert "the same inputs" in found.text()
    with pytest.raises(UsageError, match="at least two results"):
        api.side_by_side([radial_run])


def test_the_comparison_view_says_what_differs(radial_run: Result, combined_run: Result) -> None:
    notes = api.view([radial_run, combined_run], "comparison").notes
    first = api.side_by_side([radial_run, combined_run]).inputs[0]
    assert any(note.startswith(f"{first.option}: ") for note in notes)


def test_show_takes_several_results(
    radial_run: Result, combined_run: Result, capsys: pytest.CaptureFixture[str]
) -> None:
    files = [str(radial_run.path), str(combined_run.path)]
    assert main(["show", *files, "--units", "us"]) == 0
    assert "friction torque [lbf in]" in capsys.readouterr().out
    assert main(["show", *files, "--json"]) == 0
    assert json.loads(capsys.readouterr().out)["files"] == files
    assert main(["show", *files, "--assumptions"]) == 2
