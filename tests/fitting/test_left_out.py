"""Test fits with doubtful rows.

Rows without a solution, rows that are equal, and rows that the solver doubts.
"""

from __future__ import annotations

import json
import logging
import re
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from lambda_cli.main import main

from lambda_core import api
from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.errors import EquilibriumError, SolverError
from lambda_core.domain.log_sentences import SOLVER, gathered
from lambda_core.fitting.measurements import parse_measurements
from lambda_core.fitting.subjects import BearingSubject

CASE = "6319-cp10-1500"
HEADER = "speed [1/min],friction torque [N mm],friction torque error [%]"
LINES = ("500,950,1", "1000,1000,1", "2000,1100,1", "3000,1200,1")
UNSOLVED = 2000.0


@pytest.fixture(autouse=True)
def _closed_law(monkeypatch: pytest.MonkeyPatch) -> None:
    """Put a closed law in the place of the solver.

    It has no solution at one speed, and doubts above 2500 1/min.
    """

    def values(
        self: BearingSubject,
        changes: Sequence[str],
        parameters: Sequence[tuple[Any, float]],
        names: Sequence[str],
        *,
        one: bool,
    ) -> FloatArray:
        speed = float(re.findall(r"speed=([\d.]+)", changes[0])[0])
        if speed == UNSOLVED:
            raise EquilibriumError("no equilibrium was found", 0.5)
        if speed > 2500.0:
            logging.getLogger(SOLVER).warning("the torque is less accurate at %g 1/min", speed)
        return np.array([[900.0 + 1e4 * (parameters[0][1] - 0.03) + 0.1 * speed]])

    monkeypatch.setattr(BearingSubject, "values", values)
    monkeypatch.setattr(BearingSubject, "deviations", lambda *args: {})


def _fit(*lines: str, predict: Sequence[str] = ()) -> api.FitReport:
    asked = parse_measurements("\n".join([HEADER, *predict]), "other.csv") if predict else None
    measured = parse_measurements("\n".join([HEADER, *lines]), "rig.csv")
    return api.fit(CASE, measured, ["loss_factor"], suggest=False, predict=asked)


def test_a_row_without_a_solution_is_named_and_left_out() -> None:
    """Fit the other rows.

    The first such row ended the fit.
    """
    said: list[str] = []
    measured = parse_measurements("\n".join([HEADER, *LINES]), "rig.csv")
    found = api.fit(CASE, measured, ["loss_factor"], suggest=False, announce=said.append)
    assert found.unsolved_lines == [4]
    assert [point.line for point in found.points] == [2, 3, 5]
    assert found.parameters[0].value == pytest.approx(0.03, rel=1e-3)
    warning = "rig.csv line 4 has no solution and is left out, 3 measured values are left: no equilibrium was found"
    assert warning in found.warnings
    assert any("line 4" in text for text in said)
    assert found.sentence.startswith("The 3 measured values")


def test_too_few_rows_with_a_solution_end_the_fit() -> None:
    with pytest.raises(SolverError, match=r"rig\.csv line 3: no .*; 1 of at least 2 measured values are left"):
        _fit(LINES[0], LINES[2])


def test_a_fit_without_some_rows_is_a_partial_result(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    data = tmp_path / "rig.csv"
    data.write_text("\n".join([HEADER, *LINES]))
    assert main(["fit", CASE, str(data), "--vary", "loss_factor", "--json", "-q"]) == 5
    out, err = capsys.readouterr()
    assert json.loads(out)["unsolved_lines"] == [4]
    assert err.strip() == "the fit leaves out lines of rig.csv without a solution: 4"


def test_points_to_predict_without_a_solution_are_left_out() -> None:
    found = _fit(LINES[0], LINES[1], predict=(LINES[2], LINES[1]))
    assert [point.line for point in found.predictions] == [3]
    assert any(text.startswith("other.csv line 2 has no solution") for text in found.warnings)
    none = _fit(LINES[0], LINES[1], predict=(LINES[2],))
    assert not none.predictions
    assert any(text.startswith("no points were predicted: other.csv line 2") for text in none.warnings)


def test_doubts_of_the_solver_stand_in_the_report_once(capsys: pytest.CaptureFixture[str]) -> None:
    """Name the lines in the warnings.

    The solver's sentence appeared on stderr for every solution, despite --quiet.
    """
    found = _fit(LINES[0], LINES[1], LINES[3], "4000,1300,1")
    expected = "rig.csv line 4: the torque is less accurate at 3000 1/min. The same holds for line 5."
    assert [text for text in found.warnings if "accurate" in text] == [expected]
    assert "accurate" not in capsys.readouterr().err


def test_equal_rows_are_named_and_count() -> None:
    """Warn of copied rows.

    Two measurements of one value differ in some digit or in their label.
    """
    found = _fit(LINES[0], LINES[1], LINES[0], "500,951,1")
    assert (
        "Lines 2, 4 of rig.csv agree in every column, and each counts as a measurement: remove copies."
        in found.warnings
    )
    assert len(found.points) == 4
    labelled = parse_measurements("\n".join([f"label,{HEADER}", *(f"{i},{LINES[0]}" for i in range(3))]), "rig.csv")
    assert not labelled.equal_lines()


def test_sentences_of_other_loggers_are_not_gathered(caplog: pytest.LogCaptureFixture) -> None:
    with gathered(SOLVER) as found:
        logging.getLogger(SOLVER).warning("kept")
        logging.getLogger("lambda_core").warning("printed")
    logging.getLogger(SOLVER).warning("printed again")
    assert found == ["kept"]
    assert caplog.messages == ["printed", "printed again"]
