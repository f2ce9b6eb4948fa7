"""Queue runs and studies, one at a time.

A run outlives whoever asked for it: what it says goes to a file, and a queue that is opened later finds the runs that
are still going on. The result file is the truth; nothing else is needed to look at it or to go on with it.
"""

from __future__ import annotations

import json
import os
import shutil
import signal
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Literal

from lambda_core.domain.errors import LambdaError, UsageError
from lambda_core.runs.progress import Progress
from lambda_core.studies.programs import SAID, Program, Programs
from lambda_core.studies.scheduler import Counts, Director, StudyProgress

RunKind = Literal["run", "study"]
State = Literal["waiting", "running", "done", "stopped", "failed"]

_MOST_KEPT = 4000  # points of the progress; older ones are thinned out
_CONVERGED, _PARTIAL, _INTERRUPTED = 0, 5, 130
_FORGOTTEN_AFTER = 86400.0  # [s] age at which the files of a run that nobody took in are cleared away
_COMPLETE: dict[RunKind, str] = {"run": "converged", "study": "every point has a result"}
_SHORT: dict[RunKind, str] = {"run": "not converged", "study": "not every point has a result"}
_ENDING: dict[RunKind, str] = {"run": ".h5", "study": ""}


@dataclass
class QueuedRun:
    """One run or one study in the queue.

    A run of a bearing or of a shaft: waiting, going on, or ended.
    """

    name: str
    result: Path  # the file, or the folder of a study
    folder: Path  # of its own files: the case as it was, what it says
    command: Sequence[str] = ()  # of the program that does the work
    kind: RunKind = "run"
    resumes: bool = False
    state: State = "waiting"
    message: str = ""
    history: list[Progress] = field(default_factory=list)
    points: StudyProgress | None = None  # of a study: where it stands
    program: Program | None = None
    _is_news: bool = False  # its end is still to be reported
    _read: int = 0
    _rest: bytes = b""

    @property
    def last(self) -> Progress | None:
        """Last progress of the run."""
        return self.history[-1] if self.history else None

    @property
    def percent(self) -> float:
        """Completed share of the run [%]."""
        told = self.points or self.last
        return told.percent if told is not None else 0.0

    @property
    def left_s(self) -> float | None:
        """Remaining time [s].

        None where that is not known.
        """
        told = self.points or self.last
        return told.left_s if told is not None else None

    @property
    def is_complete(self) -> bool:
        """True if nothing is left to do."""
        return self.message == _COMPLETE[self.kind]

    @property
    def is_active(self) -> bool:
        """True while its process is at work."""
        return self.state == "running"

    def begin(self) -> QueuedRun:
        """Start the process.

        Do not start it while it is at work or after the run was taken out of the queue. Return the run.
        """
        if self.state == "waiting":
            self._is_news = True
            program = Program(self.folder)
            try:
                program.start([*self.command, self.kind, "resume" if self.resumes else "begin", str(self.result)])
            except OSError as error:
                self.state, self.message = "failed", f"cannot be started: {error.strerror}"
            else:
                self.state, self.program = "running", program
        return self

    def take_in(self) -> bool:
        """Read the messages of the process.

        Tell whether anything is new.
        """
        if self.state != "running":
            return False
        try:
            with (self.folder / SAID).open("rb") as file:
                file.seek(self._read)
                data = file.read()
        except OSError:
            return False
        self._read += len(data)
        *lines, self._rest = (self._rest + data).split(b"\n")
        for line in lines:
            self._hear(line.decode("utf-8", "replace"))
        return bool(lines)

    def end(self) -> None:
        """Read the last messages of an ended process.

        It also reads the exit code.
        """
        if self.state != "running" or self.program is None:
            return
        self.take_in()
        words, code = self.message, self.program.code
        if code is None:  # started by a queue that is gone: the result file knows how it ended
            code = _CODE_OF[self.kind](self.result)
        if code == _CONVERGED:
            self.state, self.message = "done", _COMPLETE[self.kind]
        elif code == _PARTIAL:
            self.state, self.message = "done", words or _SHORT[self.kind]
        elif code in (_INTERRUPTED, -signal.SIGINT):
            kept = "what it has is kept" if self.result.exists() else "it had not begun"
            self.state, self.message = "stopped", f"stopped; {kept}"
        else:
            self.state, self.message = "failed", words or f"ended with code {code}"

    def cancel(self) -> None:
        """Ask the process to stop.

        It keeps what it has. A run that waits is taken out of the queue.
        """
        if self.state == "waiting":
            self.state, self.message = "stopped", "taken out of the queue"
        elif self.state == "running" and self.program is not None:
            try:
                self.program.interrupt()
            except OSError as error:
                self.message = f"cannot be stopped: {error.strerror}"
                return
            self.message = "stopping ..."

    def forget(self) -> None:
        """Remove the run's own files; the result stays."""
        shutil.rmtree(self.folder, ignore_errors=True)

    def _hear(self, line: str) -> None:
        try:
            found: dict[str, Any] = json.loads(line)
            is_progress = found.pop("event") == "progress"
            if is_progress and self.kind == "study":
                self.points = StudyProgress(**found)
            elif is_progress:
                self.history.append(Progress(**found))
                if len(self.history) > _MOST_KEPT:
                    self.history[: _MOST_KEPT // 2] = self.history[: _MOST_KEPT // 2 : 2]
            elif not self.message.startswith("stopping"):
                self.message = str(found["text"])
        except (ValueError, KeyError, TypeError, AttributeError):
            if line.strip():
                self.message = line.strip()  # an error in plain words


def _code_of_run(result: Path) -> int:
    from lambda_core.runs.stored import summary

    try:
        found = summary(result)
    except LambdaError:
        return 1
    if found.converged:
        return _CONVERGED
    return {"interrupted": _INTERRUPTED, "failed": 4, "running": 1}.get(found.state, _PARTIAL)


def _code_of_study(folder: Path) -> int:
    from lambda_core.studies.folders import status

    try:
        found = status(folder)
    except LambdaError:
        return 1
    if found.pending:
        return _INTERRUPTED
    return _PARTIAL if found.failed or found.partial else _CONVERGED


_CODE_OF = {"run": _code_of_run, "study": _code_of_study}


class RunQueue:
    """Queue of runs.

    It starts one at a time, in the order of the requests. The director that starts them keeps it.

    Parameters
    ----------
    folder : pathlib.Path
        Where runs have their own files.
    command : sequence of str
        Program that does the work. It takes the kind, "begin" or "resume", and the path of the result; it works in a
        folder with ``case.toml`` and ``study.toml``. On stderr it writes one JSON object a line.
    ended : callable
        Called with each run that has ended.
    """

    def __init__(self, folder: Path, command: Sequence[str], ended: Callable[[QueuedRun], None]) -> None:
        self.runs: list[QueuedRun] = []
        self._folder, self._command, self._ended = folder, tuple(command), ended
        self._director = Director[QueuedRun, QueuedRun](self, Programs(1), QueuedRun.begin, _never_lost, keep_after=0.0)

    def add(self, name: str, case_toml: str, folder: Path, kind: RunKind = "run", study_toml: str = "") -> QueuedRun:
        """Put a case or study into the queue.

        The study is one of the case; results go into `folder` under a free name.

        Parameters
        ----------
        kind : "run" or "study"
            What is done with the case, of one bearing or of a machine.
        study_toml : str
            Of a study, whose case is ``case.toml``.

        Raises
        ------
        UsageError
            When the case cannot be written aside or the folder is not writable.
        """
        if not os.access(folder, os.W_OK | os.X_OK):
            raise UsageError(f"the folder {folder} is not writable: save the case in another one first")
        own = self._folder / f"{time.strftime('%Y%m%d-%H%M%S')}-{os.getpid()}-{len(self.runs)}"
        run = QueuedRun(name, self._free(folder, name, _ENDING[kind]), own, self._command, kind)
        about = {"name": name, "result": str(run.result), "kind": kind}
        files = {"case.toml": case_toml, "study.toml": study_toml, "about": json.dumps(about)}
        try:
            own.mkdir(parents=True)
            for file, text in files.items():
                (own / file).write_text(text, encoding="utf-8")
        except OSError as error:
            shutil.rmtree(own, ignore_errors=True)
            raise UsageError(f"cannot write {own}: {error.strerror}") from None
        self.runs.append(run)
        self._director.add([run])
        self.poll()
        return run

    def go_on(self, run: QueuedRun) -> None:
        """Put a stopped run into the queue again.

        It is continued.
        """
        run.resumes, run.state, run.message = True, "waiting", ""
        run._read, run._rest = 0, b""
        self._director.add([run])
        self.poll()

    def _free(self, folder: Path, name: str, ending: str) -> Path:
        taken = {run.result for run in self.runs}
        path, number = folder.resolve() / f"{name}{ending}", 1
        while path.exists() or path in taken:
            number += 1
            path = folder.resolve() / f"{name}-{number}{ending}"
        return path

    def poll(self) -> bool:
        """Read the messages of all runs.

        It also starts the next one and tells whether anything is new.
        """
        news = [run.take_in() for run in self.runs]
        return self._director.step() or any(news)

    @property
    def active(self) -> list[QueuedRun]:
        """Runs that are waiting or going on."""
        return [run for run in self.runs if run.state in ("waiting", "running")]

    def find_earlier(self) -> None:
        """Take in the runs of earlier queues.

        Clear away what has long ended.
        """
        for own in sorted(self._folder.iterdir()) if self._folder.is_dir() else ():
            try:
                about = json.loads((own / "about").read_text(encoding="utf-8"))
                program = Program.found(own)
                kind: RunKind = about.get("kind", "run")
                run = QueuedRun(about["name"], Path(about["result"]), own, self._command, kind, state="running")
                run.program, run._is_news = program, True
                is_alive = program.is_alive()
            except (OSError, ValueError, KeyError, TypeError):
                continue
            if is_alive:
                self.runs.append(run)
                self._director.hand_out(run)
            elif time.time() - own.stat().st_mtime > _FORGOTTEN_AFTER:
                run.forget()

    def close(self) -> None:
        """Remove the files of runs that have ended."""
        for run in self.runs:
            if run.state not in ("waiting", "running"):
                run.forget()

    def keep(self, outcomes: Sequence[QueuedRun]) -> None:
        """Report runs that have ended.

        Their results are in their files.
        """
        for run in outcomes:
            if run._is_news:  # not one that was taken out of the queue before it began
                run._is_news = False
                run.end()
                self._ended(run)

    def counts(self) -> Counts:
        """Return how many runs are in which state."""
        states = [run.state for run in self.runs]
        ended = states.count("done"), 0, states.count("failed") + states.count("stopped")
        return Counts(len(states), *ended, pending=len(states) - sum(ended))


def _never_lost(run: QueuedRun, reason: str) -> QueuedRun:
    """Return the run as it is.

    The run's program reports its end.
    """
    return run
