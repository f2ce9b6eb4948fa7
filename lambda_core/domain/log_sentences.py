"""Gather sentences that a part of the program logs."""

from __future__ import annotations

import logging
import threading
from collections.abc import Iterator
from contextlib import contextmanager

SOLVER = "lambda_core.solver"  # logger of the solver


@contextmanager
def gathered(name: str) -> Iterator[list[str]]:
    """Gather warnings of a logger, and print none.

    Only those of this thread.

    Parameters
    ----------
    name : str
        Name of the logger.
    """
    found: list[str] = []
    thread = threading.get_ident()

    def keep(record: logging.LogRecord) -> bool:
        if record.thread != thread:
            return True
        found.append(record.getMessage())
        return False

    log = logging.getLogger(name)
    log.addFilter(keep)
    try:
        yield found
    finally:
        log.removeFilter(keep)
