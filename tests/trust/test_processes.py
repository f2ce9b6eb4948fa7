"""Test processes, locks and file names on three systems.

Tests named `windows` force what cannot run here.
"""

from __future__ import annotations

import errno
import multiprocessing
import os
import subprocess
import sys
import threading
import time
from pathlib import Path
from typing import Any

import psutil
import pytest

from lambda_core import api
from lambda_core.domain import files, processes
from lambda_core.domain.errors import PartialResultError, UsageError
from lambda_core.results import writer
from lambda_core.results.opening import BeingWrittenError
from lambda_core.results.run_status import Status, process_identity
from lambda_core.runs.loop import NothingLeftError

CASE, SHORT = "6208-axial-1300", ["solver.duration=1 ms", "output.interval=0.1 ms"]


def test_a_process_exists_until_it_has_ended() -> None:
    child = subprocess.Popen([sys.executable, "-c", "input()"], stdin=subprocess.PIPE)
    assert processes.exists(child.pid)
    assert processes.started(child.pid) != ""
    assert processes.started(child.pid) == processes.started(child.pid)
    assert child.stdin is not None
    child.stdin.close()
    end = time.monotonic() + 10.0
    while processes.exists(child.pid) and time.monotonic() < end:  # a zombie: nobody has waited for it yet
        time.sleep(0.01)
    assert not processes.exists(child.pid)
    child.wait()
    assert not processes.exists(child.pid)
    assert processes.exists(os.getpid())


def test_on_macos_a_reused_process_id_is_another_process(monkeypatch: pytest.MonkeyPatch) -> None:
    """Know a process by its start without /proc.

    A writer whose number was given out again counted as running, and nobody could continue its file.
    """
    read = Path.read_text

    def without_proc(path: Path, *given: Any, **named: Any) -> str:
        if path.parts[1:2] == ("proc",):
            raise FileNotFoundError(path)
        return read(path, *given, **named)

    monkeypatch.setattr(Path, "read_text", without_proc)
    writing = Status(process=process_identity(os.getpid()))
    assert writing.alive()
    start = psutil.Process().create_time()
    monkeypatch.setattr(psutil.Process, "create_time", lambda _: start + 1.0)
    assert processes.exists(os.getpid())
    assert not writing.alive()


def _hold(path: str, held: str) -> None:
    with processes.locked(Path(path)):
        Path(held).touch()
        time.sleep(0.3)


def test_a_lock_lets_one_process_in_at_a_time(tmp_path: Path) -> None:
    held = tmp_path / "held"
    other = multiprocessing.get_context("spawn").Process(target=_hold, args=(str(tmp_path / "a.lock"), str(held)))
    other.start()
    while not held.exists():
        time.sleep(0.01)
    start = time.monotonic()
    with processes.locked(tmp_path / "a.lock"):
        assert time.monotonic() - start > 0.05
    other.join()


def test_of_two_that_resume_one_file_one_is_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    path = tmp_path / "run.h5"
    api.run(CASE, SHORT, out=path)
    told: list[BaseException] = []
    continued = writer.ResultWriter.continued

    def slowly(*given: Any) -> writer.ResultWriter:
        time.sleep(0.2)
        return continued(*given)

    monkeypatch.setattr(writer.ResultWriter, "continued", slowly)

    def go_on() -> None:
        try:
            api.resume(path, ["solver.duration=6 ms"])
        except BaseException as error:
            told.append(error)

    both = [threading.Thread(target=go_on) for _ in range(2)]
    for one in both:
        one.start()
    for one in both:
        one.join()
    assert len(told) == 1
    assert isinstance(told[0], BeingWrittenError | NothingLeftError), told  # the first may be through by then
    assert api.result(path).status().state == "finished"


def test_a_failed_write_leaves_no_run_that_counts_as_running(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """End a run after a disk error.

    The same process can resume its file.
    """
    path, calls = tmp_path / "run.h5", []
    complete = writer.ResultWriter._append_samples

    def failing(self: writer.ResultWriter) -> None:
        calls.append(1)
        if len(calls) > 1:
            raise OSError(5, "Input/output error")
        complete(self)

    monkeypatch.setattr(writer.ResultWriter, "_append_samples", failing)
    with pytest.raises(PartialResultError, match="Input/output error"):
        api.run(CASE, SHORT, out=path)
    monkeypatch.undo()
    status = api.result(path).status()
    assert (status.state, status.alive()) == ("interrupted", False)
    assert api.resume(path).status().state == "finished"


def test_on_windows_files_are_renamed_while_closed(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Rename files after closing them.

    Windows renames no open file: the order is another there, the result the same.
    """
    api.run(CASE, SHORT, out=tmp_path / "here.h5")
    monkeypatch.setattr(writer, "ON_WINDOWS", True)
    opened: list[bool] = []
    replace = os.replace

    def watched(source: str | Path, target: str | Path) -> None:
        opened.append(any(Path(file.path) == Path(source) for file in __import__("psutil").Process().open_files()))
        replace(source, target)

    monkeypatch.setattr(os, "replace", watched)
    there = tmp_path / "there.h5"
    api.run(CASE, SHORT, out=there, overwrite=True)
    api.resume(there, ["solver.duration=2 ms"])
    assert opened
    assert not any(opened)
    first, second = api.result(tmp_path / "here.h5"), api.result(there)
    assert (first["load"] == second["load"][: len(first["time"])]).all()


def test_a_file_system_without_links_takes_a_run(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Write a run where links are refused, as on exFAT."""

    def refused(source: str | Path, target: str | Path) -> None:
        raise PermissionError(errno.EPERM, os.strerror(errno.EPERM))

    monkeypatch.setattr(os, "link", refused)
    api.run(CASE, SHORT, out=tmp_path / "stick.h5")
    assert api.result(tmp_path / "stick.h5").status().state == "finished"
    with pytest.raises(UsageError, match="exists"):
        api.run(CASE, SHORT, out=tmp_path / "stick.h5")


def test_names_of_devices_that_windows_cannot_open_are_refused(tmp_path: Path) -> None:
    for name in ("nul.h5", "CON", "com1.toml"):
        with pytest.raises(UsageError, match="Windows opens no file with the name of a device"):
            files.check_target(Path(name))
    assert files.check_target(Path("nulled.h5")) == Path("nulled.h5")
    with pytest.raises(UsageError, match="Windows opens no file"):
        api.init_case("CON", path=tmp_path / "CON.toml")


def test_on_windows_commands_are_quoted_for_its_shell(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(processes, "ON_WINDOWS", True)
    assert processes.command_line(["C:\\Program Files\\python.exe", "a b"]) == '"C:\\Program Files\\python.exe" "a b"'
    monkeypatch.setattr(processes, "ON_WINDOWS", False)
    assert processes.command_line(["/usr/bin/python", "a b"]) == "/usr/bin/python 'a b'"
