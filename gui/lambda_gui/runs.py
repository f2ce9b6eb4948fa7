"""Runs as processes of their own, and the queue they wait in.

A run outlives the builder: what it says goes to a file, and a builder that starts finds
the runs that are still going on. The result file is the truth; nothing else is needed to
look at it or to go on with it.
"""

from __future__ import annotations

import json
import os
import shutil
import signal
import subprocess
import sys
import time
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

from lambda_core.api import Status, process_identity
from lambda_core.domain.errors import UsageError
from lambda_gui.recovery import state_folder

if TYPE_CHECKING:
    from lambda_core.api import Progress

State = Literal["waiting", "running", "done", "stopped", "failed"]

_KEPT = 4000  # points of the live traces; older ones are thinned out
_PROGRAM = (sys.executable, "-P", "-m", "lambda_cli")
_CONVERGED, _PARTIAL, _INTERRUPTED = 0, 5, 130


@dataclass
class Run:
    """One run: waiting, going on, or ended."""

    name: str
    result: Path
    folder: Path  # of its own files: the case as it was, what it says
    resumes: bool = False
    state: State = "waiting"
    message: str = ""
    history: list[Progress] = field(default_factory=list)
    process: dict[str, str] = field(default_factory=dict)
    _child: subprocess.Popen[bytes] | None = None
    _read: int = 0
    _rest: bytes = b""

    @property
    def last(self) -> Progress | None:
        """Where the run stands."""
        return self.history[-1] if self.history else None

    @property
    def is_active(self) -> bool:
        """Whether its process is at work."""
        return self.state == "running"

    def start(self) -> None:
        """Start the process; UsageError when that cannot be done."""
        work = ["resume", str(self.result)] if self.resumes else ["run", "case.toml", "--out", str(self.result)]
        command = [*_PROGRAM, *work, "--progress=json", "--json"]
        try:
            with (self.folder / "said").open("wb") as said, (self.folder / "summary").open("wb") as summary:
                self._child = subprocess.Popen(
                    command,
                    cwd=self.folder,
                    stdin=subprocess.DEVNULL,
                    stdout=summary,
                    stderr=said,
                    start_new_session=True,
                )
            self.process = process_identity(self._child.pid)
            (self.folder / "process").write_text(json.dumps(self.process), encoding="utf-8")
        except OSError as error:
            self.state, self.message = "failed", f"cannot be started: {error.strerror}"
            return
        self.state = "running"

    def poll(self) -> bool:
        """Take in what the process has said; tell whether anything is new."""
        if self.state != "running":
            return False
        code = self._child.poll() if self._child is not None else None
        is_gone = code is not None or (self._child is None and not Status(process=self.process).alive())
        news = self._listen()
        if is_gone:
            self._ended(code)
        return news or is_gone

    def cancel(self) -> None:
        """Ask the process to stop; it keeps what it has. A run that waits is taken out of the queue."""
        if self.state == "waiting":
            self.state, self.message = "stopped", "taken out of the queue"
        elif self.state == "running":
            try:
                os.kill(int(self.process["pid"]), signal.SIGINT if os.name != "nt" else signal.SIGTERM)
            except OSError as error:
                self.message = f"cannot be stopped: {error.strerror}"
                return
            self.message = "stopping ..."

    def forget(self) -> None:
        """Remove the run's own files; the result stays."""
        shutil.rmtree(self.folder, ignore_errors=True)

    def _listen(self) -> bool:
        try:
            with (self.folder / "said").open("rb") as file:
                file.seek(self._read)
                data = file.read()
        except OSError:
            return False
        self._read += len(data)
        *lines, self._rest = (self._rest + data).split(b"\n")
        for line in lines:
            self._take(line.decode("utf-8", "replace"))
        return bool(lines)

    def _take(self, line: str) -> None:
        from lambda_core.api import Progress

        try:
            found: dict[str, Any] = json.loads(line)
            if found.pop("event") == "progress":
                self.history.append(Progress(**found))
                if len(self.history) > _KEPT:
                    self.history[: _KEPT // 2] = self.history[: _KEPT // 2 : 2]
            elif not self.message.startswith("stopping"):
                self.message = str(found["text"])
        except (ValueError, KeyError, TypeError, AttributeError):
            if line.strip():
                self.message = line.strip()  # an error in plain words

    def _ended(self, code: int | None) -> None:
        words = self.message
        if code is None:  # started by a builder that is gone: the result file knows how it ended
            code = _code_of(self.result)
        if code == _CONVERGED:
            self.state, self.message = "done", "converged"
        elif code == _PARTIAL:
            self.state, self.message = "done", words or "not converged"
        elif code in (_INTERRUPTED, -signal.SIGINT):
            kept = "what it has is kept" if self.result.exists() else "it had not begun"
            self.state, self.message = "stopped", f"stopped; {kept}"
        else:
            self.state, self.message = "failed", words or f"ended with code {code}"


def _code_of(result: Path) -> int:
    from lambda_core import api

    try:
        summary = api.summary(result)
    except api.LambdaError:
        return 1
    if summary.converged:
        return _CONVERGED
    return {"interrupted": _INTERRUPTED, "failed": 4, "running": 1}.get(summary.state, _PARTIAL)


class Queue:
    """Runs in the order in which they were asked for, one at a time.

    Parameters
    ----------
    ended : callable
        Called with each run that has ended.
    """

    def __init__(self, ended: Callable[[Run], None]) -> None:
        self.runs: list[Run] = []
        self._ended = ended

    def add(self, name: str, case_toml: str, folder: Path) -> Run:
        """Put a case into the queue; its result goes into `folder` under a name that is free.

        Raises
        ------
        UsageError
            When the case cannot be written aside or the folder is not writable.
        """
        if not os.access(folder, os.W_OK | os.X_OK):
            raise UsageError(f"the folder {folder} is not writable: save the case in another one first")
        own = state_folder() / "runs" / f"{time.strftime('%Y%m%d-%H%M%S')}-{os.getpid()}-{len(self.runs)}"
        run = Run(name, self._free(folder, name), own)
        try:
            own.mkdir(parents=True)
            (own / "case.toml").write_text(case_toml, encoding="utf-8")
            (own / "about").write_text(json.dumps({"name": name, "result": str(run.result)}), encoding="utf-8")
        except OSError as error:
            shutil.rmtree(own, ignore_errors=True)
            raise UsageError(f"cannot write {own}: {error.strerror}") from None
        self.runs.append(run)
        self.poll()
        return run

    def go_on(self, run: Run) -> None:
        """Put a run that was stopped into the queue again, to be continued."""
        run.resumes, run.state, run.message = True, "waiting", ""
        run._read, run._rest = 0, b""
        self.poll()

    def _free(self, folder: Path, name: str) -> Path:
        taken = {run.result for run in self.runs}
        path, number = folder.resolve() / f"{name}.h5", 1
        while path.exists() or path in taken:
            number += 1
            path = folder.resolve() / f"{name}-{number}.h5"
        return path

    def poll(self) -> bool:
        """Take in what the runs say, start the next one; tell whether anything is new."""
        news = False
        for run in self.runs:
            was_active = run.is_active
            news |= run.poll()
            if was_active and not run.is_active:
                self._ended(run)
        if not any(run.is_active for run in self.runs):
            waiting = next((run for run in self.runs if run.state == "waiting"), None)
            if waiting is not None:
                waiting.start()
                news = True
                if not waiting.is_active:
                    self._ended(waiting)
        return news

    @property
    def active(self) -> list[Run]:
        """Runs that are waiting or going on."""
        return [run for run in self.runs if run.state in ("waiting", "running")]

    def find_earlier(self) -> None:
        """Take in the runs of builders that are gone; clear away what has long ended."""
        folder = state_folder() / "runs"
        for own in sorted(folder.iterdir()) if folder.is_dir() else ():
            try:
                about = json.loads((own / "about").read_text(encoding="utf-8"))
                process = json.loads((own / "process").read_text(encoding="utf-8"))
                run = Run(about["name"], Path(about["result"]), own, state="running", process=process)
            except (OSError, ValueError, KeyError, TypeError):
                continue
            if Status(process=process).alive():
                self.runs.append(run)
            elif time.time() - own.stat().st_mtime > 86400.0:
                run.forget()

    def close(self) -> None:
        """Remove the files of runs that have ended."""
        for run in self.runs:
            if run.state not in ("waiting", "running"):
                run.forget()
