"""A disk that is full at any point of a run: a message, no crash, nothing lost that was there."""

from __future__ import annotations

import json
import random
import subprocess
import sys
import time
from pathlib import Path

import pytest

from lambda_core.simulate.results import Result

HERE = Path(__file__).parent
# The first object of a result file to the last sample of this run span this many bytes.
LIMITS = [3_000, 1_100_000, *sorted(random.Random(1).sample(range(1_200_000, 12_000_000), 4))]
WANTED = {"solver": {"duration": 1.2}, "checkpoint_interval": 0.03}


def run(verb: str, path: Path, **wanted: object) -> subprocess.CompletedProcess[str]:
    command = [sys.executable, str(HERE / "fake_run.py"), verb, str(path), json.dumps(wanted)]
    return subprocess.run(command, capture_output=True, text=True, check=False)


@pytest.fixture(scope="module")
def whole(tmp_path_factory: pytest.TempPathFactory) -> Result:
    """The same run with room enough."""
    path = tmp_path_factory.mktemp("whole") / "r.h5"
    assert run("run", path, **WANTED).returncode == 0
    return Result(path)


@pytest.mark.parametrize("limit", LIMITS)
def test_a_full_disk_at_any_point(limit: int, tmp_path: Path, whole: Result) -> None:
    path = tmp_path / "r.h5"
    done = run("run", path, limit=limit, **WANTED)
    assert "Traceback" not in done.stderr
    assert [p.name for p in tmp_path.iterdir()] in ([], ["r.h5"])  # no half-written copies
    if done.returncode == 2:  # not even the frame of the file had room
        assert f"cannot write {path}: File too large" in done.stderr
        assert not path.exists()
        return
    assert done.returncode == 5, done.stderr
    assert f"cannot write {path}: File too large; what was written before is kept" in done.stderr
    result = Result(path)
    status = result.status()
    for channel in result.channels:
        assert len(result[channel.name]) == status.rows.samples
    assert status.state == "stopped"
    resumed = run("resume", path, **WANTED)  # with room again
    assert resumed.returncode == 0, resumed.stderr
    for channel in result.channels:
        assert Result(path)[channel.name].tobytes() == whole[channel.name].tobytes()


def test_a_result_deleted_during_the_run_is_said(tmp_path: Path) -> None:
    path = tmp_path / "r.h5"
    command = [sys.executable, str(HERE / "fake_run.py"), "run", str(path)]
    wanted = {"solver": {"duration": 0.2}, "truth": {"slowness": 1e-3}}
    process = subprocess.Popen(
        [*command, json.dumps(wanted)], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
    )
    while not path.exists():
        assert process.poll() is None
    time.sleep(0.2)
    path.unlink()
    _, errors = process.communicate()
    assert process.returncode == 5
    assert "was deleted or renamed during the run" in errors
    assert not list(tmp_path.iterdir())
