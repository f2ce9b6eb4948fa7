"""Test the motor bearing in the shell.

From nothing to a report in at most five commands and three minutes.
"""

from __future__ import annotations

import tempfile
import time
from pathlib import Path

import pytest
from lambda_cli.main import main

MOST_COMMANDS, MOST_SECONDS = 5, 180.0
COMMANDS = (
    ["init", "motor", "--template", "electric-motor", "--bearing", "SKF 6308 C3"],
    ["check", "motor.toml"],
    [
        "run", "motor.toml", "--set", "loads.radial=2.5 kN", "--set", "loads.axial=0.5 kN",
        "--set", "operation.speed=6000 rpm",
    ],
    ["report", "motor.h5", "--project", "Fan", "--author", "E. Engineer"],
)  # fmt: skip


@pytest.mark.full
def test_from_nothing_to_a_report(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    begun = time.process_time()  # what else the machine does not counted
    for command in COMMANDS:
        assert main(command) == 0, capsys.readouterr().err
    assert len(COMMANDS) <= MOST_COMMANDS
    assert time.process_time() - begun < MOST_SECONDS
    page = Path("motor.html").read_text(encoding="utf-8")
    for words in ("6308 C3 (SKF)", "power loss", "rating life L10rh", "static safety", "kappa", "Fan"):
        assert words in page


def test_the_case_is_remembered(
    tmp_path: Path, user_folder: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "temporary").mkdir()
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path / "temporary"))  # the folder of the tests is in the usual one
    assert main(["recent"]) == 0
    said = capsys.readouterr()
    assert (said.out, "init NAME --template" in said.err) == ("", True)
    for name in ("pump", "fan"):
        assert main(["init", name, "--template", "pump"]) == 0
    assert main(["check", "pump.toml"]) == 0
    capsys.readouterr()
    assert main(["recent"]) == 0
    assert capsys.readouterr().out.splitlines() == [str(tmp_path / "pump.toml"), str(tmp_path / "fan.toml")]
    Path("pump.toml").unlink()
    (user_folder / "recent.json").write_text(f'["{tmp_path / "pump.toml"}"')  # cut
    assert main(["recent", "--json"]) == 0
    assert '"cases": []' in capsys.readouterr().out
