"""Run a short part of the attacks.

The long campaign is ``python -m tests.attacks``.
"""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

from tests.attacks.page import ROOT
from tests.attacks.trial import GOOD

_PARTS = ("hostile:1", "corruption:1")
_LONG = ("cases:1", "kills:1", "catalogues:1", "plugins:1", "races:1")
_SEED = "20"  # by which the cases are quick ones


@pytest.mark.timeout(900)  # where nothing is compiled yet
@pytest.mark.parametrize("parts", [_PARTS, pytest.param(_LONG, marks=pytest.mark.full)], ids=["short", "long"])
def test_a_short_campaign_finds_nothing(parts: tuple[str, ...], tmp_path: Path, own_folders: Path) -> None:
    command = [sys.executable, "-m", "tests.attacks", *parts, "--seed", _SEED, "--folder", str(tmp_path)]
    done = subprocess.run(command, cwd=ROOT, env=os.environ, capture_output=True, text=True, check=False)
    failed = [
        f"{file.stem} {entry['number']}: {entry['verdict']}: {entry['said']}"
        for file in tmp_path.glob("*.jsonl")
        for entry in map(json.loads, file.read_text(encoding="utf-8").splitlines())
        if entry["verdict"] not in GOOD
    ]
    assert not failed, "\n".join(failed)
    assert done.returncode == 0, done.stderr
    for part in parts:
        name, _, count = part.partition(":")
        assert len((tmp_path / f"{name}.jsonl").read_text(encoding="utf-8").splitlines()) == int(count)
