"""Test the commands view, study and report.

Files on disk, data on stdout, exit codes that say how it ended.
"""

from __future__ import annotations

import csv
import io
import json
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING

import pytest
from lambda_cli import main

if TYPE_CHECKING:
    from lambda_core.results.reader import Result
    from lambda_core.studies.folders import StudyStatus

Call = Callable[..., tuple[int, str, str]]

STUDY = """
name = "pair"
case = "6319-cp10-1500"
responses = ["friction_torque_Nmm", "friction_breakdown_Nmm"]
[[parameters]]
path = "loads.radial"
values = ["8 kN", "16 kN"]
"""


@pytest.fixture
def call(capsys: pytest.CaptureFixture[str]) -> Call:
    """Run the program in this process.

    Return exit code, stdout, stderr.
    """

    def run(*arguments: str) -> tuple[int, str, str]:
        code = main.main(list(arguments))
        out, err = capsys.readouterr()
        return code, out, err

    return run


def test_view_writes_pictures_and_prints_their_names(call: Call, combined_run: Result, tmp_path: Path) -> None:
    code, out, _ = call("view", str(combined_run.path), "film", "--out", str(tmp_path))
    assert code == 0
    assert out.splitlines() == [str(tmp_path / f"combined-film.{kind}") for kind in ("svg", "png")]
    assert all(Path(line).stat().st_size > 5000 for line in out.splitlines())


def test_view_wants_a_folder_to_draw_into(call: Call, combined_run: Result, tmp_path: Path) -> None:
    for name in (tmp_path / "film.svg", combined_run.path):  # a file that there is none of, and one that there is
        code, out, err = call("view", str(combined_run.path), "film", "--out", str(name))
        assert (code, out) == (2, "")
        assert f"{name}: pictures go into a folder, which they name themselves there: combined-film.svg" in err
    assert not (tmp_path / "film.svg").exists()


def test_view_prints_data(call: Call, combined_run: Result) -> None:
    code, out, _ = call("view", str(combined_run.path), "film", "--json")
    data = json.loads(out)
    assert code == 0
    assert (data["version"], data["view"]) == (1, "film")
    assert data["panels"][0]["y"]["unit"] == "um"


def test_view_lists_views_with_their_options(call: Call) -> None:
    code, out, _ = call("view", "--list", "--json")
    cards = {card["name"]: card for card in json.loads(out)["views"]}
    assert code == 0
    assert [option["name"] for option in cards["contact-map"]["options"]] == ["ball", "ring", "time"]
    code, out, _ = call("view", "--list")
    assert "stability-map" in out
    assert all(name in out for name in cards)


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["{run}", "fiml"], '"fiml" is not a known view; nearest: film'),
        (["no.h5", "film"], "no.h5 does not exist: name a file that"),
        (["{run}", "film", "pressure"], "give one view"),
        (["{run}", "study-map"], "looks at a study, this is one result"),
        (["{run}", "film", "--set", "x=1"], '"x" is not a known option'),
        (["{run}", "contact-map", "--set", "ring"], "write OPTION=VALUE"),
        (["{run}", "film", "--format", "gif"], '"gif" is not a known format'),
        ([], "name a result file or the folder of a study"),
        (["{folder}", "film"], "is a folder, not a result file"),
    ],
)
def test_view_says_what_is_wrong(
    call: Call, combined_run: Result, tmp_path: Path, words: list[str], message: str
) -> None:
    names = {"run": str(combined_run.path), "folder": str(tmp_path)}
    code, out, err = call(
        "view", *(word.format(**names) for word in words), *(["--out", str(tmp_path)] if words else [])
    )
    assert code == 2
    assert out == ""
    assert message in err
    assert "Traceback" not in err


def test_a_study_from_file_to_table(call: Call, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    Path("pair.toml").write_text(STUDY, encoding="utf-8")
    code, out, _ = call("study", "run", "pair.toml", "--dry-run", "--json", "--quiet")
    assert code == 0
    assert json.loads(out)["points"] == 2
    assert not Path("pair").exists()
    code, out, err = call("study", "run", "pair.toml", "--workers", "1", "--json", "--progress", "json")
    status = json.loads(out)
    assert (code, status["done"], status["pending"]) == (0, 2, 0)
    events = [json.loads(line) for line in err.splitlines()]
    assert events[-1]["event"] == "progress"
    assert events[-1]["done"] == 2
    code, out, _ = call("study", "show", "pair", "--csv")
    rows = list(csv.DictReader(io.StringIO(out)))
    assert [row["loads.radial [kN]"] for row in rows] == ["8.0", "16.0"]
    assert float(rows[1]["friction_torque_Nmm [N mm]"]) > float(rows[0]["friction_torque_Nmm [N mm]"])
    code, out, _ = call("study", "show", "pair", "--json")
    assert json.loads(out)["units"]["friction_torque_Nmm"] == "N mm"
    code, out, _ = call("study", "show", "pair")
    assert "friction" in out
    assert out.count("done") == 2
    code, out, _ = call("study", "show", "pair", "--units", "us")
    assert "[lbf]" in out
    assert "[lbf in]" in out
    assert "1798.5" in out  # 8 kN
    code, out, _ = call("study", "status", "pair")
    assert "2 points, 2 done" in out
    assert call("study", "resume", "pair", "--quiet")[0] == 0
    code, _, err = call("study", "run", "pair.toml", "--quiet")
    assert code == 2
    assert "already holds a study" in err
    code, out, _ = call("report", "pair")
    assert (code, out.strip()) == (0, "pair.html")
    code, _, err = call("report", "pair")
    assert code == 2
    assert "--force" in err


def test_a_report_is_a_page_or_a_pdf(call: Call, combined_run: Result, tmp_path: Path) -> None:
    code, _, err = call("report", str(combined_run.path), "--out", str(tmp_path / "motor.docx"))
    assert code == 2
    assert "a report is written as .html, .htm or .pdf" in err
    assert not (tmp_path / "motor.docx").exists()


def test_an_invalid_study_ends_with_3(call: Call, tmp_path: Path) -> None:
    path = tmp_path / "bad.toml"
    path.write_text(STUDY.replace("loads.radial", "loads.radal"), encoding="utf-8")
    code, out, err = call("study", "run", str(path), "--out", str(tmp_path / "bad"), "--quiet")
    assert code == 3
    assert out == ""
    assert "loads.radal" in err
    code, _, err = call("study", "run", str(tmp_path / "none.toml"))
    assert code == 2
    assert "cannot read the study" in err
    assert "it does not exist; correct the path, or write a study with: lambda-bearing study init" in err


@pytest.mark.full
def test_failed_points_end_with_5(call: Call, tmp_path: Path) -> None:
    text = STUDY.replace("loads.radial", "bearing.clearance").replace('["8 kN", "16 kN"]', '["20 um", "9 mm"]')
    path = tmp_path / "gap.toml"
    path.write_text(text, encoding="utf-8")
    code, out, err = call("study", "run", str(path), "--out", str(tmp_path / "gap"), "--workers", "1", "--quiet")
    assert code == 5
    assert "1 failed" in out
    assert "1 of 2 points have no result" in err


def status_of(**counts: int) -> StudyStatus:
    from lambda_core.studies.folders import StudyStatus

    status = StudyStatus(
        name="pair", title="pair", folder="pair", mode="dynamic", design="grid", points=2, done=0, partial=0, failed=0,
        pending=0, worker_seconds=1.0, wall_s=1.0, parallel_efficiency=None, reasons=[], best=None, message="",
    )  # fmt: skip
    return status.model_copy(update=counts)


@pytest.mark.parametrize(
    ("counts", "code", "words"),
    [
        ({"done": 2}, 0, ""),
        ({"done": 1, "partial": 1}, 5, "1 of 2 points have not converged"),
        ({"failed": 1, "partial": 1}, 5, "1 of 2 points have no result; 1 of 2 points have not converged"),
    ],
)
def test_a_study_of_unconverged_points_is_a_partial_result(
    call: Call, monkeypatch: pytest.MonkeyPatch, counts: dict[str, int], code: int, words: str
) -> None:
    from lambda_core import api

    monkeypatch.setattr(api, "study_resume", lambda *_, **__: status_of(**counts), raising=False)
    ended, _, err = call("study", "resume", "pair", "--quiet")
    assert ended == code
    assert words in err


def test_points_that_wait_for_another_process_are_no_interruption(
    call: Call, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    from lambda_core import api

    status = status_of(done=1, pending=1)
    monkeypatch.setattr(api, "study_resume", lambda *_, **__: status, raising=False)
    code, _, err = call("study", "resume", "pair", "--quiet")
    assert code == 5
    assert "1 of 2 points wait for another process; continue with: lambda-bearing study resume pair" in err
    assert "interrupted" not in err
    stopped = status.model_copy(update={"interrupted": True})
    monkeypatch.setattr(api, "study_resume", lambda *_, **__: stopped, raising=False)
    assert call("study", "resume", "pair", "--quiet")[0] == 130
