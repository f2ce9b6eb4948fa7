"""Name processes of this computer and lock between them.

Which process writes a file is known by its number and its start: numbers are given out again.
"""

from __future__ import annotations

import os
import signal
import subprocess
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any

ON_WINDOWS = os.name == "nt"
# Of a process that outlives the one that starts it (CREATE_NEW_PROCESS_GROUP on Windows).
APART: dict[str, Any] = {"creationflags": 0x200} if ON_WINDOWS else {"start_new_session": True}
# Requests to stop, from the keyboard, another program or a terminal that is closed.
STOP_SIGNALS: tuple[int, ...] = tuple(
    getattr(signal, name) for name in ("SIGINT", "SIGTERM", "SIGHUP", "SIGBREAK") if hasattr(signal, name)
)


def heard_signals() -> list[int]:
    """Return the requests to stop that count here.

    A process that was started with ``nohup`` outlives its terminal. A shell lets its background ignore Ctrl+C, which
    comes from the keyboard; who sends that signal to one process means it.
    """
    return [n for n in STOP_SIGNALS if n == signal.SIGINT or signal.getsignal(n) != signal.SIG_IGN]


def started(pid: int) -> str:
    """Return the start of a process.

    It is in the system's own count, or "" where there is none.
    """
    import psutil

    try:
        text = Path(f"/proc/{pid}/stat").read_text()  # an exact count: a time of day moves with the clock
    except OSError:
        try:
            return repr(psutil.Process(pid).create_time())
        except psutil.Error:
            return ""
    return text.rpartition(")")[2].split()[19]


def exists(pid: int) -> bool:
    """Tell whether a process runs on this host.

    A process that has ended does not, though nobody may have waited for it.
    """
    import psutil

    try:
        return psutil.Process(pid).status() not in (psutil.STATUS_ZOMBIE, psutil.STATUS_DEAD)
    except psutil.NoSuchProcess:
        return False
    except psutil.AccessDenied:  # somebody else's
        return True


def ask_to_stop(pid: int) -> None:
    """Ask a separate process to stop.

    :data:`APART` started it; it stops at a good point; OSError when that cannot be done.
    """
    os.kill(pid, getattr(signal, "CTRL_BREAK_EVENT", signal.SIGINT) if ON_WINDOWS else signal.SIGINT)


def command_line(words: Sequence[str]) -> str:
    """Write a command for this system's shell.

    It is one line.
    """
    import shlex

    return subprocess.list2cmdline(words) if ON_WINDOWS else shlex.join(words)


@contextmanager
def locked(path: Path) -> Iterator[None]:
    """Hold a lock of this host.

    One process has it at a time; the file stays, empty.

    Where no lock can be made (a folder that takes no file), the work goes on without it.
    """
    from filelock import FileLock

    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        lock = FileLock(path)
        lock.acquire()
    except (OSError, NotImplementedError):
        yield
        return
    try:
        yield
    finally:
        lock.release()
