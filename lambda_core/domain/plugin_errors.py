"""What can be wrong with a plugin, as one sentence with the distribution's name."""

from __future__ import annotations

import traceback
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

from lambda_core.domain.errors import LambdaError

_HOST = Path(__file__).parents[1]  # this core: a plugin's mistake is told with the plugin's own line
_LIBRARIES = {"pydantic", "numpy", "numba", "scipy", "importlib"}


class PluginError(LambdaError):
    """A plugin, or a model that it brings, cannot be used; exits like an invalid case."""

    exit_code = 3


@dataclass(frozen=True)
class PluginFault:
    """A plugin that is not in use although it is installed, and why.

    `is_broken` is False for one that was switched off on purpose.
    """

    distribution: str  # name and version, "my-traction 0.1"
    entry_point: str
    message: str
    is_broken: bool = True

    def __str__(self) -> str:
        return f"{self.distribution} ({self.entry_point}): {self.message}"


@contextmanager
def blamed(what: str) -> Iterator[None]:
    """Turn what a plugin's own code raises into a sentence that names the plugin.

    Parameters
    ----------
    what : str
        What was called, with its distribution: ``the view "film" (my-views 0.1)``.

    Raises
    ------
    PluginError
        For everything but the program's own errors, which have their sentence, and an interruption.
    """
    try:
        yield
    except LambdaError:
        raise
    except (Exception, SystemExit) as error:
        raise PluginError(f"{what} fails: {describe(error)}") from error


def describe(error: BaseException) -> str:
    """Return type, message and place of an exception raised inside a plugin.

    The place is the innermost one that lies in no library.
    """
    places = [(frame.filename, frame.lineno) for frame in traceback.extract_tb(error.__traceback__)]
    text = " ".join(str(error).split())
    if isinstance(error, SyntaxError):
        text, places = error.msg, [(error.filename or "", error.lineno)]
    own = [place for place in places if not _LIBRARIES & set(Path(place[0]).parts) and not place[0].startswith("<")]
    theirs = [place for place in own if not Path(place[0]).is_relative_to(_HOST)] or own
    where = f" ({Path(theirs[-1][0]).name}, line {theirs[-1][1]})" if theirs else ""
    return f"{type(error).__name__}{': ' if text else ''}{text}{where}"
