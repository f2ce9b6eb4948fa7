"""Test how the rows of a long file are solved."""

from __future__ import annotations

import pickle

import numpy as np
import pytest
from lambda_cli.talk import Lines

from lambda_core.domain.errors import CaseError, EquilibriumError, LambdaError, Problem
from lambda_core.fitting import operating_points, rows
from lambda_core.fitting.operating_points import OperatingPoints
from lambda_core.fitting.rows import Asked, FitProgress, Rows, Solved, Watch
from lambda_core.fitting.subjects import subject_of
from lambda_core.model.bearing_model import BearingModel
from lambda_core.studies.job import resolve_point

CASE = "6319-cp10-500"
TORQUE = ("friction torque",)


def _asked(*speeds: float) -> list[Asked]:
    return [Asked((f"operation.speed={speed} rpm",), TORQUE) for speed in speeds]


@pytest.mark.full
def test_processes_answer_what_one_answers(monkeypatch: pytest.MonkeyPatch) -> None:
    """Solve rows, a wrong one among them, in two processes."""
    monkeypatch.setattr(rows, "FEW", 2)
    subject = subject_of(CASE)
    parameters, asked = [(subject.varied("loss_factor"), 0.033)], _asked(500, 600, 0, 700)
    heard: list[int] = []
    several = Rows(subject, 2)
    several.heard = heard.append
    try:
        found = several.solve(parameters, asked, one=False)
    finally:
        several.close()
    alone = Rows(subject).solve(parameters, asked, one=False)
    assert sum(heard) == len(asked)
    for one, other in zip(found[:2], alone[:2], strict=True):
        assert isinstance(one, Solved)
        assert isinstance(other, Solved)
        np.testing.assert_array_equal(one.values, other.values)
    assert isinstance(found[2], LambdaError)
    assert str(found[2]) == str(alone[2])
    assert len(alone) == 3  # one process ends with the first error


@pytest.mark.parametrize(
    "error", [CaseError("rig", [Problem("loads.radial", "is wrong")]), EquilibriumError("none found", 0.5)]
)
def test_errors_come_back_from_a_process(error: LambdaError) -> None:
    again = pickle.loads(pickle.dumps(error))
    assert (type(again), str(again), vars(again)) == (type(error), str(error), vars(error))


def test_a_file_longer_than_the_memory_keeps_its_first_points(monkeypatch: pytest.MonkeyPatch) -> None:
    """Go over three rows twice with room for two.

    All points were forgotten before they came by again, so that each pass resolved and solved all of them anew.
    """
    monkeypatch.setattr(operating_points, "_KEPT", 2)
    resolved: list[tuple[str, ...]] = []

    def resolve(toml: str, changes: tuple[str, ...], *, is_static: bool) -> BearingModel:
        resolved.append(changes)
        return resolve_point(toml, changes, is_static=is_static)

    monkeypatch.setattr("lambda_core.fitting.operating_points.resolve_point", resolve)
    points = OperatingPoints(subject_of(CASE).case_toml)
    for _ in range(2):
        for row in _asked(500, 600, 700):
            points.values(row.changes, (), TORQUE, one=True)
    assert [changes[0] for changes in resolved] == [f"operation.speed={speed} rpm" for speed in (500, 600, 700, 700)]


def test_a_fit_tells_the_time_left(monkeypatch: pytest.MonkeyPatch) -> None:
    """Take the time of rows after the first pass."""
    now, told = [0.0], list[FitProgress]()
    monkeypatch.setattr("lambda_core.fitting.rows.time.monotonic", lambda: now[0])
    watch = Watch(10, 1, told.append)
    for _ in range(10):
        now[0] += 2.0
        watch.heard(1)
    assert told[-1].left_s is None
    watch.error_pct = 3.0
    for _ in range(20):
        now[0] += 1.0
        watch.heard(1)
    assert (told[-1].solved, told[-1].error_pct) == (30, 3.0)
    assert told[-1].left_s == pytest.approx(60.0)  # nine passes as a rule, three are done
    for _ in range(100):
        now[0] += 1.0
        watch.heard(1)
    assert (told[-1].percent, told[-1].left_s) == (None, None)  # it takes longer than usual


@pytest.mark.parametrize(("solved", "said"), [(1, "1 point  error"), (2, "2 points  error")])
def test_the_progress_of_a_fit_counts_one_point(solved: int, said: str, capsys: pytest.CaptureFixture[str]) -> None:
    lines = Lines()
    lines._last = -1e9
    lines.update(FitProgress(solved=solved, error_pct=3.0, percent=10.0, wall_s=1.0, left_s=9.0))
    assert said in capsys.readouterr().err
