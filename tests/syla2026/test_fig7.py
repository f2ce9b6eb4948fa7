"""Test capacitances of the 6208.

The whole figure, with its run, from the command line.
"""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from lambda_cli.main import main


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("reproduction")


@pytest.mark.full
def test_fig7_meets_every_bar(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Check each statement of Syla's section 4.3.

    Syla et al. 2026; bars as in docs/validation.md.
    """
    assert main(["reproduce", "fig7", "--quick", "--workers", "1", "--out", str(folder), "--json", "-q"]) == 0
    found = json.loads(capsys.readouterr().out)
    assert all(bar.startswith("met: ") for bar in found["bars"]), found["bars"]
    assert len(found["contacts"]) == 6
    (effort,) = found["effort"]
    assert effort["computed"] == effort["jobs"] > 0
    assert effort["processor_s"] > 0.0
    run = next(c for c in found["contacts"] if c["dynamic_hertz_pF"] is not None)
    # Under axial load every ball runs alike: a run adds nothing to the quasi-static contacts.
    assert run["dynamic_hertz_pF"] == pytest.approx(run["hertz_pF"], rel=0.01)
    page = (folder / "reproduction.html").read_text(encoding="utf-8")
    assert "http://" not in page.replace("http://www.w3.org", "")
    assert "https://" not in page
    assert {"fig7.svg", "fig7.png", "reproduction.html"} <= {path.name for path in folder.iterdir()}


@pytest.mark.full
def test_a_second_call_computes_nothing_again(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    before = {path: path.stat().st_mtime_ns for path in (folder / "work").rglob("*") if path.is_file()}
    assert before
    assert main(["reproduce", "fig7", "--quick", "--workers", "1", "--out", str(folder), "-q"]) == 0
    said = capsys.readouterr().out
    assert "simulated pF" in said
    assert "(0 of " in said.splitlines()[-1]  # jobs computed now
    assert {path: path.stat().st_mtime_ns for path in (folder / "work").rglob("*") if path.is_file()} == before


def test_an_unknown_experiment_is_named(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["reproduce", "table5", "--out", str(folder), "-q"]) == 2
    assert "table4" in capsys.readouterr().err
