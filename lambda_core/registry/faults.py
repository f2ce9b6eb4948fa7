"""What can be wrong with a plugin, as one sentence with the distribution's name."""

from __future__ import annotations

import traceback
from dataclasses import dataclass
from pathlib import Path

from lambda_core.errors import LambdaError


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


def describe(error: BaseException) -> str:
    """Return type, message and innermost place of an exception raised inside a plugin."""
    frames = traceback.extract_tb(error.__traceback__)
    place = ""
    if isinstance(error, SyntaxError) and error.filename:
        place = f" ({Path(error.filename).name}, line {error.lineno})"
    elif frames:
        place = f" ({Path(frames[-1].filename).name}, line {frames[-1].lineno})"
    text = error.msg if isinstance(error, SyntaxError) else " ".join(str(error).split())
    return f"{type(error).__name__}: {text}{place}" if text else f"{type(error).__name__}{place}"
