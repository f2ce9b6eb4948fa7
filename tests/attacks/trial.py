"""One attack: the command line in a process of its own, with limits, and what became of it.

The parent imports everything and loads the compiled solver once; each trial is a fork of it, so that a thousand
commands do not start Python a thousand times. A child has its own folder, its own output files, a limit of memory and
a parent that ends it when its time is over.
"""

from __future__ import annotations

import os
import signal
import sys
import time
from collections.abc import Sequence
from dataclasses import asdict, dataclass
from pathlib import Path

# Exit codes of the program, and what an outcome is called.
NAMES = {0: "fine", 2: "usage", 3: "refused", 4: "unsolved", 5: "partial", 130: "interrupted"}
GOOD = frozenset(NAMES.values())
_PATIENCE = 0.01  # [s] between two looks at a child
_TOLD = 4000  # characters of the end of stderr that are kept
MEMORY = 1 << 30  # [bytes] of resident memory above the parent's, beyond which a trial counts as greedy


@dataclass(frozen=True)
class Outcome:
    """What became of one command.

    Attributes
    ----------
    verdict : str
        A value of `NAMES`; or ``hang``, ``killed`` (by a signal of its own), ``traceback``, ``bug``, ``silent`` (failed
        without a word), ``greedy`` (memory), ``code N``.
    wall_s, memory : float, int
        Wall time [s]; resident memory beyond the parent's [bytes].
    said : str
        The end of stderr.
    """

    verdict: str
    wall_s: float
    memory: int
    said: str

    @property
    def good(self) -> bool:
        """Tell whether the program behaved: it did the work, or said in a sentence why not."""
        return self.verdict in GOOD

    def data(self) -> dict[str, object]:
        """Return a plain dictionary."""
        return asdict(self)


def warm() -> None:
    """Import and compile what every trial needs, in this process."""
    import h5py  # noqa: F401
    import lambda_cli.main  # noqa: F401

    from lambda_core import api

    api.quasistatic("6208-axial-1300")
    for step in api.iterate(api.case("6208-axial-1300")):
        del step
        break


class Trial:
    """A command that runs in a process of its own.

    Parameters
    ----------
    arguments : sequence of str
        Behind the program's name.
    folder : Path
        Working directory, made when it is not there; the files ``stdout`` and ``stderr`` are left in it.
    """

    def __init__(self, arguments: Sequence[str], folder: Path) -> None:
        folder.mkdir(parents=True, exist_ok=True)
        self._folder = folder
        self._before = _resident(os.getpid())
        self._began = time.monotonic()
        sys.stdout.flush()
        sys.stderr.flush()
        self.process = os.fork()
        if self.process == 0:
            _live(arguments, folder)

    def wait(self, limit_s: float) -> Outcome:
        """Wait until it ends, or end it when `limit_s` of wall time are over [s]; the latter counts as a hang."""
        highest = 0
        while True:
            done, status = os.waitpid(self.process, os.WNOHANG)
            wall = time.monotonic() - self._began
            if done:
                said = _tail(self._folder)
                mute = not said.strip() and not (self._folder / "stdout").stat().st_size
                return Outcome(_verdict(status, said, mute, highest), wall, highest, said)
            highest = max(highest, _resident(self.process) - self._before)
            if wall > limit_s or highest > 2 * MEMORY:
                self.kill()
                os.waitpid(self.process, 0)
                return Outcome("hang" if wall > limit_s else "greedy", wall, highest, _tail(self._folder))
            time.sleep(_PATIENCE)

    def kill(self) -> None:
        """End it at once, and whatever it has started."""
        os.killpg(self.process, signal.SIGKILL)


def attempt(arguments: Sequence[str], folder: Path, limit_s: float) -> Outcome:
    """Run a command line to its end; see :class:`Trial`."""
    return Trial(arguments, folder).wait(limit_s)


def _live(arguments: Sequence[str], folder: Path) -> None:
    """Be the child: run the command and leave, never to return."""
    code = 70
    try:
        os.setsid()
        os.chdir(folder)
        for name, number in (("stdout", 1), ("stderr", 2)):
            file = os.open(name, os.O_WRONLY | os.O_CREAT | os.O_TRUNC, 0o644)
            os.dup2(file, number)
        os.dup2(os.open(os.devnull, os.O_RDONLY), 0)
        sys.stdin = open(0, closefd=False)  # noqa: SIM115
        sys.stdout = open(1, "w", buffering=1, closefd=False)  # noqa: SIM115
        sys.stderr = open(2, "w", buffering=1, closefd=False)  # noqa: SIM115
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


def _verdict(status: int, said: str, mute: bool, memory: int) -> str:
    if os.WIFSIGNALED(status):
        return "killed"
    if "Traceback (most recent call last)" in said:
        return "traceback"
    if "has a bug" in said:
        return "bug"
    if memory > MEMORY:
        return "greedy"
    code = os.WEXITSTATUS(status)
    if code != 0 and mute:
        return "silent"
    return NAMES.get(code, f"code {code}")


def _tail(folder: Path) -> str:
    try:
        return (folder / "stderr").read_bytes()[-_TOLD:].decode(errors="replace")
    except OSError:
        return ""


def _resident(process: int) -> int:
    """Return the resident memory of a process [bytes], 0 when it has gone."""
    try:
        pages = int(Path(f"/proc/{process}/statm").read_text(encoding="ascii").split()[1])
    except (OSError, ValueError, IndexError):
        return 0
    return pages * os.sysconf("SC_PAGE_SIZE")
