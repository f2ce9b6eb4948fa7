"""Report the progress of a long command on stderr.

The forms are a bar, lines, JSON for programs, or nothing.
"""

from __future__ import annotations

import json
import shutil
import sys
import time
from collections.abc import Mapping
from enum import StrEnum
from types import TracebackType
from typing import TYPE_CHECKING, Annotated, Any, Protocol

import typer

from lambda_core.domain.number_text import counted
from lambda_core.domain.wrapping import wrapped

if TYPE_CHECKING:
    from lambda_core.api import FitProgress, Progress, StudyProgress

    AnyProgress = Progress | StudyProgress | FitProgress

_LINE_AFTER = 5.0  # wall time between plain lines [s]


class Style(StrEnum):
    """Style of the progress."""

    AUTO = "auto"
    BAR = "bar"
    PLAIN = "plain"
    JSON = "json"
    NONE = "none"


ProgressOption = Annotated[
    Style,
    typer.Option("--progress", help="On stderr: a bar on a terminal, plain lines, one JSON object per line, or none."),
]
QuietOption = Annotated[bool, typer.Option("--quiet", "-q", help="Print no progress: results and errors only.")]


class Talk(Protocol):
    """One way to say what goes on."""

    def say(self, text: str) -> None:
        """Say a sentence."""

    def update(self, progress: AnyProgress) -> None:
        """Take where the run stands."""

    def __enter__(self) -> Talk: ...

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None: ...


def talk(style: Style, quiet: bool) -> Talk:
    """Return the progress style that the user chose.

    `auto` is a bar on a terminal and lines elsewhere.
    """
    if style is Style.AUTO:
        style = Style.BAR if sys.stderr.isatty() else Style.PLAIN
    if quiet and style is not Style.JSON:
        style = Style.NONE
    return {Style.BAR: Bar, Style.PLAIN: Lines, Style.JSON: JsonLines, Style.NONE: Silence}[style]()


def columns() -> int | None:
    """Return the width of the answer's terminal.

    It is None for a file or a pipe.
    """
    return shutil.get_terminal_size().columns if sys.stdout.isatty() else None


def json_text(data: Mapping[str, Any]) -> str:
    """Return plain data as JSON.

    What is not a number becomes null, as in every other answer.
    """
    from pydantic_core import to_json

    return to_json(data, indent=2, inf_nan_mode="null").decode()


class Silence:
    """Says nothing."""

    def say(self, text: str) -> None:
        """Say a sentence."""

    def update(self, progress: AnyProgress) -> None:
        """Take where the run stands."""

    def __enter__(self) -> Talk:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        """Close nothing."""


class JsonLines(Silence):
    """One JSON object per line.

    Programs that started this one read them.
    """

    def say(self, text: str) -> None:
        """Write a message."""
        self._write({"event": "message", "text": text})

    def update(self, progress: AnyProgress) -> None:
        """Write where the run stands."""
        self._write({"event": "progress", **progress.model_dump(mode="json")})

    def _write(self, data: dict[str, Any]) -> None:
        print(json.dumps(data, allow_nan=False), file=sys.stderr, flush=True)


class Lines(Silence):
    """A line now and then, for logs."""

    def __init__(self) -> None:
        self._last = time.monotonic()

    def say(self, text: str) -> None:
        """Write a line."""
        print(text, file=sys.stderr, flush=True)

    def update(self, progress: AnyProgress) -> None:
        """Write a line every few seconds."""
        now = time.monotonic()
        if now - self._last >= _LINE_AFTER:
            self._last = now
            self.say(f"running  {_share(progress, 1)}{_state(progress)}  {_left(progress)}")


class Bar(Silence):
    """A bar with the time left, on a terminal."""

    def __init__(self) -> None:
        from rich.console import Console
        from rich.progress import BarColumn, Progress, TextColumn

        self._console = Console(stderr=True, highlight=False, markup=False, emoji=False)
        self._bar = Progress(
            TextColumn("{task.description}", markup=False),
            BarColumn(bar_width=30),
            TextColumn("{task.fields[state]}", markup=False),
            console=self._console,
            transient=True,
        )
        self._task = self._bar.add_task("starting", total=None, state="")

    def say(self, text: str) -> None:
        """Show compilation in the bar's place.

        Print everything else above it.
        """
        if text.startswith("compiling"):
            self._bar.update(self._task, description=text, total=None)
        else:
            for line in wrapped(text.splitlines(), self._console.width):
                self._console.print(line, soft_wrap=True)

    def update(self, progress: AnyProgress) -> None:
        """Move the bar."""
        state, done = f"{_share(progress)}{_state(progress)}  {_left(progress)}", progress.percent
        total = None if done is None else 100.0
        self._bar.update(self._task, description="running", total=total, completed=done or 0.0, state=state)

    def __enter__(self) -> Talk:
        self._bar.start()
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._bar.stop()


def _state(progress: AnyProgress) -> str:
    """Write revolutions and torque, or points, in a few words."""
    from lambda_core.api import FitProgress, StudyProgress

    if isinstance(progress, FitProgress):
        error = "" if progress.error_pct is None else f"  error {progress.error_pct:.2g} %"
        return f"{counted(progress.solved, 'point')}{error}"
    if isinstance(progress, StudyProgress):
        failed = f", {progress.failed} failed" if progress.failed else ""
        return f"{progress.done}/{progress.points} points{failed}"
    turns = f"cage rev {progress.cage_revolutions:.1f}/{progress.cage_revolutions_wanted:.3g}"
    if progress.friction_torque_Nmm is None:
        return turns
    band = progress.friction_torque_ci_Nmm
    more = f" ± {band:.1f}" if band is not None else ""
    return f"{turns}  M {progress.friction_torque_Nmm:.1f}{more} N mm"


def _share(progress: AnyProgress, digits: int = 0) -> str:
    """Write the share that is done, where it is known."""
    return "" if progress.percent is None else f"{progress.percent:{4 + digits}.{digits}f} %  "


def _left(progress: AnyProgress) -> str:
    """Write the time left, or that nobody knows it."""
    return "more points than usual" if progress.percent is None else f"{_clock(progress.left_s)} left"


def _clock(seconds: float | None) -> str:
    if seconds is None:
        return "?"
    minutes, rest = divmod(round(seconds), 60)
    hours, minutes = divmod(minutes, 60)
    return f"{hours}:{minutes:02d}:{rest:02d}"
