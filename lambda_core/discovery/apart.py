"""Try laws in a process of their own.

A law that never ends or writes out of bounds ends only that process.
"""

from __future__ import annotations

import importlib
import os
import signal
import subprocess
import sys
import threading
from collections.abc import Callable, Iterator, Sequence
from queue import Empty, Queue

from lambda_core.discovery.local_files import guests
from lambda_core.discovery.registry import Registry
from lambda_core.discovery.survey import CheckCard, check_installed, chosen

LIMIT = 120.0  # [s] for one law; a kernel of 400 branches takes 50 s to compile
PATIENCE = 15.0  # [s] before a message appears


def check_apart(
    registry: Registry,
    wanted: Sequence[str] = (),
    limit: float = LIMIT,
    announce: Callable[[str], None] | None = None,
) -> Iterator[CheckCard]:
    """Test models in separate processes.

    It works as :func:`survey.check_installed`, each process within a limit of time.

    Parameters
    ----------
    registry : Registry
        What is installed.
    wanted : sequence of str
        Distributions, roles, or "role/name"; all models when empty.
    limit : float
        Wall time that one law may take [s].
    announce : callable, optional
        Called with a sentence about a law that takes long.

    Raises
    ------
    UsageError
        For a name that is none of these.
    """
    labels = [f"{role}/{name}" for role, name in chosen(registry, wanted)]
    yield from tried_apart(registry, labels, __name__, limit, announce)


def tried_apart(
    registry: Registry, labels: Sequence[str], module: str, limit: float, announce: Callable[[str], None] | None = None
) -> Iterator[CheckCard]:
    """Have a module test things in its process.

    It is a separate process, each test within a limit of time.

    Parameters
    ----------
    labels : sequence of str
        "role/name" or "kind/name" of each.
    module : str
        Run with the labels as its arguments; it calls :func:`answer`.
    """
    left = list(labels)
    while left:
        with _Trials(left, module) as trials:
            trials.begun()
            while left:
                role, _, name = left[0].partition("/")
                answer = trials.next(min(limit, PATIENCE))
                if answer is None and announce is not None:
                    announce(f"{left[0]} ({registry.origin(role, name)}) takes long: it compiles, or never ends")
                answer = answer or trials.next(max(limit - PATIENCE, 0.0)) or _endless(limit)
                label = left.pop(0)
                if isinstance(answer, CheckCard):
                    yield answer
                    continue
                origin = registry.origin(role, name)
                fault = f"{label} ({origin}) {answer}"
                yield CheckCard(
                    role=role, name=name, distribution=origin, ok=False, faults=[fault], warnings=[], not_tried="",
                    nanoseconds=None,
                )  # fmt: skip
                break


def _endless(limit: float) -> str:
    return f"did not come to an end within {limit:g} s: it loops, or takes that long to compile"


class _Trials:
    """The process, and what it says."""

    def __init__(self, labels: Sequence[str], module: str) -> None:
        command = [sys.executable, "-P", "-m", module, *labels]
        self._process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE)
        assert self._process.stdin is not None
        with self._process.stdin as handed:
            handed.write(guests())
        self._lines: Queue[bytes] = Queue()
        threading.Thread(target=self._read, daemon=True).start()

    def __enter__(self) -> _Trials:
        return self

    def __exit__(self, *_: object) -> None:
        self._process.kill()
        self._process.wait()

    def _read(self) -> None:
        assert self._process.stdout is not None
        with self._process.stdout as lines:
            for line in lines:
                self._lines.put(line)
        self._lines.put(b"")

    def begun(self) -> None:
        """Wait until everything is imported: that is no law's time."""
        line = self._lines.get()
        if not line:  # ended: the next question gets the message
            self._lines.put(line)

    def next(self, limit: float) -> CheckCard | str | None:
        """Return the result of the next model.

        A failure returns a sentence; the result is None after `limit` [s].
        """
        try:
            line = self._lines.get(timeout=limit)
        except Empty:
            return None
        if line:
            return CheckCard.model_validate_json(line)
        code = self._process.wait()
        how = signal.Signals(-code).name if code < 0 else f"exit code {code}"
        return f"ended the process that tried it ({how}): machine code checks no bounds"


def answer(trials: Callable[[Registry, Sequence[str]], Iterator[CheckCard]], labels: Sequence[str]) -> None:
    """Test things and write a line for each.

    Prints of plugins go to stderr.
    """
    from lambda_core.discovery.manager import as_guests_of, registry

    as_guests_of(sys.stdin.buffer.read())
    with os.fdopen(os.dup(1), "w", encoding="utf-8") as answers:
        os.dup2(2, 1)
        installed = registry()
        importlib.import_module("numba")  # which the first law would wait for
        print("begun", file=answers, flush=True)
        for card in trials(installed, labels):
            print(card.model_dump_json(), file=answers, flush=True)


if __name__ == "__main__":
    answer(check_installed, sys.argv[1:])
