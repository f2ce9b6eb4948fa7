"""Test the commands that a queue's kinds of work mean."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from lambda_cli.queued import main

from lambda_core import api

NOT_CONVERGED = 5
FINISHED = 2  # nothing is left to resume
STUDY = """
name = "pair"
case = "case.toml"
responses = ["friction_torque_Nmm"]
[[parameters]]
path = "loads.axial"
values = ["700 N", "1000 N"]
"""


@pytest.fixture(autouse=True)
def in_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    case = api.init_case("case", "6208-axial-700", path=tmp_path / "case.toml").read_text(encoding="utf-8")
    (tmp_path / "case.toml").write_text(f'{case}\n[solver]\nduration = "1 ms"\n', encoding="utf-8")
    (tmp_path / "study.toml").write_text(STUDY, encoding="utf-8")


@pytest.mark.full
@pytest.mark.parametrize(("kind", "begun", "resumed"), [("run", NOT_CONVERGED, FINISHED), ("study", 0, 0)])
def test_work_begins_and_resumes_with_reports_in_json(
    kind: str, begun: int, resumed: int, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    result = tmp_path / "own.h5"
    assert main([kind, "begin", str(result)]) == begun
    out, err = capsys.readouterr()
    assert result.exists()
    assert json.loads(out)
    assert '{"event": "progress"' in err
    assert main([kind, "resume", str(result)]) == resumed
    out, err = capsys.readouterr()
    assert "nothing is left to do" in err if resumed else json.loads(out)
