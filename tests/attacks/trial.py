"""Run the command in its own process, with limits.

The parent imports everything and loads the compiled solver once; each trial is a fork of it, so that a thousand
commands do not start Python a thousand times. A child has its own folder, its own output files, a limit of memory and
a parent that ends it when its time is over.
"""

from __future__ import annotations

import contextlib
import ctypes
import gc
import importlib
import json
import os
import pkgutil
import resource
import select
import signal
import sys
import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import asdict, dataclass, replace
from pathlib import Path

# Exit codes of the program, and what an outcome is called. 130 is no good end: nobody interrupted the trial.
NAMES = {0: "fine", 2: "usage", 3: "refused", 4: "unsolved", 5: "partial"}
GOOD = frozenset(NAMES.values())
MEMORY = 1 << 30  # [byte] of resident memory that a trial may take, what it shares with its parent included
_END_WITH_PARENT = 1  # PR_SET_PDEATHSIG
_GLANCE = 0.02  # [s] between two looks at a child that runs
_TOLD = 4000  # characters of the end of stderr that are kept
_READ = 1 << 20  # [byte] of stderr that are judged
# Sentences that are none: Python's own words, or an error that does not say what was wrong.
_RAW = ("RuntimeWarning", "DeprecationWarning", "UserWarning", "Exception ignored in", 'cannot use "a file"')


@dataclass(frozen=True)
class Outcome:
    """Outcome of one command.

    Attributes
    ----------
    verdict : str
        A value of `NAMES`; or ``hang``, ``killed`` (by a signal of its own), ``traceback``, ``bug``, ``silent`` (failed
        without a word), ``raw`` (warnings of Python instead of a sentence), ``garbled`` (asked for JSON, gave none),
        ``greedy`` (memory), ``code N``.
    wall_s, cpu_s : float
        Wall time and processor time, from the fork to the end [s].
    memory : int
        Highest resident memory, what is shared with the parent included [byte].
    said : str
        The end of stderr.
    open_s : float
        Wall time from when the file to be watched stood there to the end; 0 without one. Without the time in which
        it waited for a processor that others had, so that a busy machine does not make it look late [s].
    waited_s : float
        Time in which it waited for a processor, in all [s].
    """

    verdict: str
    wall_s: float = 0.0
    memory: int = 0
    said: str = ""
    cpu_s: float = 0.0
    open_s: float = 0.0
    waited_s: float = 0.0

    @property
    def good(self) -> bool:
        """True if the program behaved.

        It did the work, or reported in a sentence why not.
        """
        return self.verdict in GOOD

    def but(self, verdict: str, said: str) -> Outcome:
        """Return the outcome with another verdict.

        And the reason for it.
        """
        return replace(self, verdict=verdict, said=f"{said}\n{self.said}")

    def data(self) -> dict[str, object]:
        """Return a plain dictionary."""
        return asdict(self)


def warm() -> None:
    """Import and compile what every trial needs, in this process."""
    import h5py  # noqa: F401
    import lambda_cli.main  # noqa: F401

    from lambda_core import api

    load_everything()
    api.quasistatic("6208-axial-1300")
    for step in api.iterate(api.case("6208-axial-1300")):
        del step
        break
    settle()


def settle() -> None:
    """Keep present objects from the collector.

    A collection in a child would copy the shared memory page by page.
    """
    gc.collect()
    gc.freeze()


def load_everything() -> None:
    """Import every module of the program.

    Later changes of files do not matter to a long campaign.
    """
    import lambda_cli
    import lambda_db
    import lambda_plugins

    import lambda_core

    for package in (lambda_core, lambda_cli, lambda_db, lambda_plugins):
        for module in pkgutil.walk_packages(package.__path__, f"{package.__name__}."):
            if ".template" not in module.name and not module.name.endswith("__main__"):
                importlib.import_module(module.name)


class Trial:
    """A command that runs in a process of its own.

    Parameters
    ----------
    arguments : sequence of str
        Behind the program's name.
    folder : Path
        Working directory, made when it is not there; the files ``stdout`` and ``stderr`` are left in it.
    environment : mapping of str to str, optional
        Variables that the child has in addition.
    before : callable, optional
        Called in the child before the command: limits, for example.
    watched : Path, optional
        A file; how long the command went on once it stood there is measured.
    fresh : bool
        Start Python anew, as a user does: what the parent has loaded and compiled does not help.
    """

    def __init__(
        self,
        arguments: Sequence[str],
        folder: Path,
        environment: Mapping[str, str] | None = None,
        before: Callable[[], None] | None = None,
        watched: Path | None = None,
        fresh: bool = False,
    ) -> None:
        folder.mkdir(parents=True, exist_ok=True)
        self._folder, self._watched = folder, watched
        self._json = "--json" in arguments and "--help" not in arguments  # help is for people
        self._began = time.monotonic()
        self._seen = 0.0  # since the beginning, without waiting [s]
        sys.stdout.flush()
        sys.stderr.flush()
        self.process = os.fork()
        if self.process == 0:
            _live(arguments, folder, environment or {}, before, fresh)
        self._handle = os.pidfd_open(self.process)

    def wait(self, limit_s: float, look: Callable[[], None] | None = None) -> Outcome:
        """Wait for the end, with limit.

        After `limit_s` it is ended, waiting not counted [s]; this is a hang.

        `look` is called now and then while it runs.
        """
        ended, greedy, waited = "", False, 0.0
        while True:
            over = bool(select.select([self._handle], [], [], 0.0 if ended else _GLANCE)[0])
            wall, waited = time.monotonic() - self._began, max(waited, _waited(self.process))
            if self._watched is not None and not self._seen and self._watched.is_file():
                self._seen = wall - waited
            if over or ended:
                break
            if look is not None:
                look()
            greedy = greedy or _resident(self.process) > 2 * MEMORY
            if greedy or wall - waited > limit_s:
                ended = "greedy" if greedy else "hang"
                self.kill()
        _, status, used = os.wait4(self.process, 0)
        os.close(self._handle)
        memory, cpu = used.ru_maxrss * 1024, used.ru_utime + used.ru_stime
        said = self.said()
        verdict = ended or self._verdict(status, said, memory)
        open_s = wall - waited - self._seen if self._seen else 0.0
        return Outcome(verdict, wall, memory, said[-_TOLD:], cpu, open_s, waited)

    def kill(self) -> None:
        """End it at once, and whatever it has started."""
        try:
            os.killpg(self.process, signal.SIGKILL)
        except ProcessLookupError:  # it has no group of its own yet
            os.kill(self.process, signal.SIGKILL)

    def said(self) -> str:
        """Return what stands on stderr."""
        try:
            return (self._folder / "stderr").read_bytes()[-_READ:].decode(errors="replace")
        except OSError:
            return ""

    def _verdict(self, status: int, said: str, memory: int) -> str:
        if os.WIFSIGNALED(status):
            return "killed"
        if "Traceback (most recent call last)" in said:
            return "traceback"
        if "has a bug" in said:
            return "bug"
        if memory > MEMORY:
            return "greedy"
        code = os.WEXITSTATUS(status)
        if any(word in said for word in _RAW):
            return "raw"
        if self._json and code in (0, 5) and not _strict(self._folder / "stdout"):
            return "garbled"
        if code != 0 and not said.strip() and not (self._folder / "stdout").stat().st_size:
            return "silent"
        return NAMES.get(code, f"code {code}")


def attempt(
    arguments: Sequence[str],
    folder: Path,
    limit_s: float,
    environment: Mapping[str, str] | None = None,
    before: Callable[[], None] | None = None,
    watched: Path | None = None,
    fresh: bool = False,
) -> Outcome:
    """Run a command line to its end; see :class:`Trial`."""
    return Trial(arguments, folder, environment, before, watched, fresh).wait(limit_s)


def _live(
    arguments: Sequence[str],
    folder: Path,
    environment: Mapping[str, str],
    before: Callable[[], None] | None,
    fresh: bool,
) -> None:
    """Run the command in the child.

    It never returns.
    """
    code = 70
    try:
        os.setsid()
        with contextlib.suppress(OSError, AttributeError):  # Linux: a campaign that is ended takes its trials with it
            ctypes.CDLL(None).prctl(_END_WITH_PARENT, signal.SIGKILL)
        os.chdir(folder)
        os.environ.update(environment)
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
        for name, number in (("stdout", 1), ("stderr", 2)):
            file = os.open(name, os.O_WRONLY | os.O_CREAT | os.O_TRUNC, 0o644)
            os.dup2(file, number)
        os.dup2(os.open(os.devnull, os.O_RDONLY), 0)
        sys.stdin = open(0, closefd=False)  # noqa: SIM115
        sys.stdout = open(1, "w", buffering=1, closefd=False)  # noqa: SIM115
        sys.stderr = open(2, "w", buffering=1, closefd=False)  # noqa: SIM115
        if before is not None:
            before()
        if fresh:
            os.execv(sys.executable, [sys.executable, "-P", "-m", "lambda_cli", *arguments])
        from lambda_cli.main import main

        code = main(list(arguments))
        sys.stdout.flush()
        sys.stderr.flush()
    except SystemExit as end:
        code = end.code if isinstance(end.code, int) else 1
    except BaseException:
        import traceback

        traceback.print_exc()
        code = 1
    finally:
        os._exit(code if isinstance(code, int) and 0 <= code < 256 else 1)


def _strict(file: Path) -> bool:
    """Tell whether a file is strict JSON.

    Empty, or JSON documents as the standard has them, one or one a line.
    """
    text = file.read_text(encoding="utf-8", errors="replace")
    try:
        json.loads(text or "0", parse_constant=_refuse)
    except ValueError:
        try:
            for line in text.splitlines():
                json.loads(line, parse_constant=_refuse)
        except ValueError:
            return False
    return True


def _refuse(word: str) -> None:
    raise ValueError(f"{word} is no JSON")


def _waited(process: int) -> float:
    """Return a process's waiting time [s].

    For a processor; 0 where the system does not tell.
    """
    try:
        return int(Path(f"/proc/{process}/schedstat").read_text(encoding="ascii").split()[1]) * 1e-9
    except (OSError, ValueError, IndexError):
        return 0.0


def _resident(process: int) -> int:
    """Return a process's resident memory [byte].

    0 when it has gone.
    """
    try:
        pages = int(Path(f"/proc/{process}/statm").read_text(encoding="ascii").split()[1])
    except (OSError, ValueError, IndexError):
        return 0
    return pages * os.sysconf("SC_PAGE_SIZE")
