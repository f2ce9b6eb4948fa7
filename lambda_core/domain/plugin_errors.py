"""Define the errors of plugins, with the distribution's name."""

from __future__ import annotations

import contextlib
import sys
import traceback
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

from lambda_core.domain.errors import LambdaError
from lambda_core.domain.printable import printable

_HOST = Path(__file__).parents[1]  # this core: the message about a plugin's mistake names the plugin's own line
_LIBRARIES = {"pydantic", "numpy", "numba", "scipy", "importlib"}


class PluginError(LambdaError):
    """Plugin or model that cannot be used.

    It exits like an invalid case.
    """

    exit_code = 3


@dataclass(frozen=True)
class PluginFault:
    """Installed plugin that is not in use.

    It has the reason.

    `is_broken` is False for one that was switched off on purpose.
    """

    distribution: str  # name and version, "my-traction 0.1"
    entry_point: str
    message: str
    is_broken: bool = True

    def __str__(self) -> str:
        return f"{self.distribution} ({self.entry_point}): {self.message}"


@contextmanager
def blamed(what: str, but: tuple[type[Exception], ...] = ()) -> Iterator[None]:
    """Turn a plugin's error into a sentence.

    The sentence names the plugin.

    Parameters
    ----------
    what : str
        What was called, with its distribution: ``the view "film" (my-views 0.1)``.
    but : tuple of exception types
        That are not the plugin's.

    Raises
    ------
    PluginError
        For everything but the program's own errors, which have their sentence, and an interruption.

    What it prints meanwhile goes to stderr: stdout is for data.
    """
    try:
        with contextlib.redirect_stdout(sys.stderr):
            yield
    except (Exception, SystemExit) as error:
        if isinstance(error, (LambdaError, *but)):
            raise
        raise PluginError(f"{what} fails: {describe(error)}") from error


_failures: list[str] = []  # of plugins, in this process, after which the rest went on


def went_on_without(failure: str) -> None:
    """Record a failure of a plugin.

    The rest went on without it; the exit code shows it.
    """
    _failures.append(failure)


def failures_so_far() -> tuple[str, ...]:
    """Return the recorded failures of this process.

    The rest went on without what failed.
    """
    return tuple(_failures)


def describe(error: BaseException) -> str:
    """Describe an exception that a plugin raised.

    Return type, message and place.

    The place is the innermost one that lies in no library.
    """
    places = [(frame.filename, frame.lineno) for frame in traceback.extract_tb(error.__traceback__)]
    text = " ".join(str(error).split())
    if isinstance(error, SyntaxError):
        text, places = error.msg, [(error.filename or "", error.lineno)]
    own = [place for place in places if not _LIBRARIES & set(Path(place[0]).parts) and not place[0].startswith("<")]
    theirs = [place for place in own if not Path(place[0]).is_relative_to(_HOST)] or own
    where = f" ({Path(theirs[-1][0]).name}, line {theirs[-1][1]})" if theirs else ""
    return printable(f"{type(error).__name__}{': ' if text else ''}{text}{where}")
