"""Start programs that outlive their parent, as workers.

What such a program says goes to files in a folder of its own, so that a later process finds it again.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Sequence
from concurrent.futures import Executor, Future
from pathlib import Path
from typing import Any

from lambda_core.domain.processes import ask_to_stop
from lambda_core.results.run_status import Status, process_identity
from lambda_core.studies.pool import Pool, start_apart

SAID, ANSWER, _PROCESS = "said", "answer", "process"  # files of a program: stderr, stdout, who it is


class Program:
    """One program and its folder.

    Parameters
    ----------
    folder : pathlib.Path
        Where it works and what it says is written.
    """

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self._child: Any = None
        self._process: dict[str, str] = {}
        self.code: int | None = None  # once it has ended; None too when nobody knows

    @staticmethod
    def found(folder: Path) -> Program:
        """Return the program of an earlier process.

        It was started in a folder; OSError or ValueError when there is none.
        """
        program = Program(folder)
        program._process = json.loads((folder / _PROCESS).read_text(encoding="utf-8"))
        return program

    def start(self, command: Sequence[str]) -> None:
        """Start it; OSError when that cannot be done."""
        self._child = start_apart(command, self.folder, said=self.folder / SAID, answer=self.folder / ANSWER)
        self._process = process_identity(self._child.pid)
        (self.folder / _PROCESS).write_text(json.dumps(self._process), encoding="utf-8")

    def is_alive(self) -> bool:
        """Tell whether it is at work.

        Once it has ended, `code` is the exit code, as far as that can be known.
        """
        if self._child is None:
            return Status(process=self._process).alive()
        self.code = self._child.poll()
        return self.code is None

    def interrupt(self) -> None:
        """Ask it to stop; OSError when that cannot be done."""
        ask_to_stop(int(self._process["pid"]))


class Programs(Pool, Executor):
    """One program for each task.

    What is submitted starts a program and returns an outcome that has it as its `program`, None when there is nothing
    to wait for. The outcome is handed over once that program has ended.
    """

    ahead = 1

    def __init__(self, workers: int) -> None:
        super().__init__(workers)
        self._begun: list[tuple[Future[Any], Any]] = []

    def open(self) -> Executor:
        """Return itself."""
        return self

    def submit(self, fn: Callable[..., Any], /, *args: Any, **kwargs: Any) -> Future[Any]:
        """Start the program of a task."""
        future: Future[Any] = Future()
        future.set_running_or_notify_cancel()
        self._begun.append((future, fn(*args, **kwargs)))
        return future

    def watch(self) -> None:
        """Take in which programs have ended."""
        begun, self._begun = self._begun, []
        for future, outcome in begun:
            if outcome.program is not None and outcome.program.is_alive():
                self._begun.append((future, outcome))
            else:
                future.set_result(outcome)

    def close(self, *, stop: bool = False) -> None:
        """Leave the programs at work."""
