"""Test runs on a disk that is full."""

from __future__ import annotations

import json
import os
import random
import signal
from pathlib import Path
from typing import TYPE_CHECKING

import pytest
from fake_engine import FAKE_RUN

from lambda_core.results.reader import Result

if TYPE_CHECKING:
    from warm import Warm

# The first object of a result file to the last sample of this run span this many bytes.
LIMITS = [3_000, 1_100_000, *sorted(random.Random(1).sample(range(1_200_000, 10_000_000), 2))]
WANTED = {"solver": {"duration": 1.2}, "checkpoint_interval": 0.03}


def run(warm: Warm, verb: str, path: Path, **wanted: object) -> tuple[int | None, str]:
    """Run or resume; return the exit code and the messages."""
    process = warm.start(FAKE_RUN, verb, str(path), json.dumps(wanted))
    _, said = process.communicate()
    return process.returncode, said


@pytest.fixture(scope="module")
def complete(warm: Warm, tmp_path_factory: pytest.TempPathFactory) -> Result:
    """Return the same run with enough room."""
    path = tmp_path_factory.mktemp("whole") / "r.h5"
    assert run(warm, "run", path, **WANTED) == (0, "")
    return Result(path)


@pytest.mark.parametrize(
    "limit",
    [
        *LIMITS[:-2],
        pytest.param(LIMITS[-2], marks=pytest.mark.slow),
        pytest.param(LIMITS[-1], marks=pytest.mark.full),
    ],
)
def test_a_full_disk_at_any_point(limit: int, warm: Warm, tmp_path: Path, complete: Result) -> None:
    path = tmp_path / "r.h5"
    code, said = run(warm, "run", path, limit=limit, **WANTED)
    assert "Traceback" not in said
    assert [p.name for p in tmp_path.iterdir()] in ([], ["r.h5"])  # no half-written copies
    if code == 2:  # not even the frame of the file had room
        assert f"cannot write {path}: File too large" in said
        assert not path.exists()
        return
    assert code == 5, said
    assert f"cannot write {path}: File too large; earlier results are kept" in said
    result = Result(path)
    status = result.status()
    for channel in result.channels:
        assert len(result[channel.name]) == status.rows.samples
    assert status.state == "interrupted"
    assert run(warm, "resume", path, **WANTED) == (0, "")  # with room again
    for channel in result.channels:
        assert Result(path)[channel.name].tobytes() == complete[channel.name].tobytes()


@pytest.mark.full
def test_a_result_deleted_during_the_run_is_said(warm: Warm, tmp_path: Path) -> None:
    path = tmp_path / "r.h5"
    wanted = {"solver": {"duration": 0.2}, "truth": {"slowness": 1e-3}}
    process = warm.start(FAKE_RUN, "run", str(path), json.dumps(wanted))
    while not path.exists():
        assert process.poll() is None
    os.kill(process.pid, signal.SIGSTOP)  # it must not reach its end before
    path.unlink()
    os.kill(process.pid, signal.SIGCONT)
    _, errors = process.communicate()
    assert process.returncode == 5
    assert "was deleted, renamed or replaced during the run" in errors
    assert not list(tmp_path.iterdir())
