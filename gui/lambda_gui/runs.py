"""Manage the builder's queue of runs in its own folder."""

from __future__ import annotations

import sys
from collections.abc import Callable

from lambda_core.api import QueuedRun, RunQueue
from lambda_gui.recovery import state_folder

_PROGRAM = (sys.executable, "-P", "-m", "lambda_cli.queued")


def open_queue(ended: Callable[[QueuedRun], None]) -> RunQueue:
    """Return the queue of this builder.

    `ended` is called with each run that has ended.
    """
    return RunQueue(state_folder() / "runs", _PROGRAM, ended)
