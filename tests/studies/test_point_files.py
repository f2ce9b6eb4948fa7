"""Test result files that a resumed study finds."""

from __future__ import annotations

import errno
import logging
import os
import sqlite3
import subprocess
import sys
from collections.abc import Callable, Iterator
from contextlib import closing
from pathlib import Path
from typing import Any

import h5py
import pytest
from studies import RUNS

from lambda_core import api
from lambda_core.results import file_format as layout
from lambda_core.results import hdf5
from lambda_core.results.run_status import Status, process_identity
from lambda_core.studies import job
from lambda_core.studies.pool import HERE
from lambda_core.studies.store import FILE

Folder = tuple[Path, list[dict[str, Any]]]
HEAD = RUNS.format(duration="0.005 s", speeds=2, loads=2).partition("[[parameters]]")[0]
STUDY = f"""{HEAD}
[[parameters]]
path = "operation.speed"
values = ["2000 rpm", "3000 rpm"]
"""


@pytest.fixture
def study(write: Callable[..., Path], tmp_path: Path) -> Folder:
    """Return a study with an open point.

    Its second point is to do, though its run has come to its last checkpoint; and the table to reach.
    """
    folder = tmp_path / "runs"
    api.study_run(write(STUDY), folder, executor=HERE)
    rows = api.study_table(folder).rows()
    assert [row["state"] for row in rows] == ["partial", "partial"]
    with closing(sqlite3.connect(folder / FILE)) as manifest, manifest:
        manifest.execute("UPDATE points SET state = 'pending', reason = '', responses = '{}' WHERE number = 1")
    return folder, rows


def written_by(path: Path, process: dict[str, str]) -> None:
    """Mark a result as being written."""
    status = api.result(path).status()
    with h5py.File(path, "r+") as file:
        running = Status(rows=status.rows, statistics=status.statistics, process=process)
        file[layout.STATUS][()] = running.to_bytes(layout.STATUS_BYTES)


@pytest.fixture
def writer(study: Folder) -> Iterator[subprocess.Popen[bytes]]:
    """Start a process with the second point."""
    folder, rows = study
    process = subprocess.Popen([sys.executable, "-c", "input()"], stdin=subprocess.PIPE)
    written_by(folder / rows[1]["file"], process_identity(process.pid))
    yield process
    process.kill()
    process.communicate()


class Ends(logging.Handler):
    """Process that ends on request.

    As soon as somebody reports that he waits for it.
    """

    def __init__(self, process: subprocess.Popen[bytes]) -> None:
        super().__init__()
        self.process, self.said = process, list[str]()

    def emit(self, record: logging.LogRecord) -> None:
        self.said.append(record.getMessage())
        self.process.kill()
        self.process.wait()


@pytest.mark.full
def test_a_point_waits_for_the_worker_of_a_killed_director(study: Folder, writer: subprocess.Popen[bytes]) -> None:
    folder, rows = study
    ends, log = Ends(writer), logging.getLogger("lambda_core")
    log.addHandler(ends)
    try:
        status = api.study_resume(folder, executor=HERE)
    finally:
        log.removeHandler(ends)
    (said,) = ends.said
    assert f"still being written by process {writer.pid}: waiting up to" in said
    assert (status.failed, status.pending) == (0, 0)
    assert api.study_table(folder).rows() == rows


@pytest.mark.full
def test_a_point_in_other_hands_is_left_for_the_next_time(
    study: Folder, writer: subprocess.Popen[bytes], monkeypatch: pytest.MonkeyPatch
) -> None:
    folder, rows = study
    monkeypatch.setattr(job, "_PATIENCE", 0.0)
    status = api.study_resume(folder, executor=HERE)
    assert (status.partial, status.failed, status.pending) == (1, 0, 1)
    assert f"point 2: {folder / rows[1]['file']} is still being written by process {writer.pid}" in status.reasons
    writer.kill()
    writer.wait()
    status = api.study_resume(folder, executor=HERE)
    assert (status.partial, status.failed, status.pending) == (2, 0, 0)
    assert api.study_table(folder).rows() == rows


def full_after(monkeypatch: pytest.MonkeyPatch, times: int) -> None:
    """Let the disk be full after some reservations."""
    room, left = hdf5.reserve, times

    def reserve(file: h5py.File, growth: int) -> None:
        nonlocal left
        left -= 1
        if left < 0:
            raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))
        room(file, growth)

    monkeypatch.setattr(hdf5, "reserve", reserve)


@pytest.mark.full
def test_a_disk_without_room_to_go_on_fails_the_point(study: Folder, monkeypatch: pytest.MonkeyPatch) -> None:
    folder, rows = study
    written_by(folder / rows[1]["file"], {})
    with monkeypatch.context() as full:
        full_after(full, 0)
        status = api.study_resume(folder, executor=HERE)
    assert (status.partial, status.failed, status.pending) == (1, 1, 0)
    assert os.strerror(errno.ENOSPC) in status.reasons[1]
    api.study_resume(folder, executor=HERE, retry=True)
    assert api.study_table(folder).rows() == rows


@pytest.mark.full
def test_a_run_that_a_full_disk_ended_goes_on_when_it_is_tried_again(
    study: Folder, monkeypatch: pytest.MonkeyPatch
) -> None:
    folder, rows = study
    (folder / rows[1]["file"]).unlink()
    with monkeypatch.context() as full:
        full_after(full, 3)
        status = api.study_resume(folder, executor=HERE)
    assert (status.partial, status.failed, status.pending) == (1, 1, 0)
    assert os.strerror(errno.ENOSPC) in status.reasons[1]
    api.study_resume(folder, executor=HERE, retry=True)
    assert api.study_table(folder).rows() == rows
