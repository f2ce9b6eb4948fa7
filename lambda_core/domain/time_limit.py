"""Limit the wall time of searches."""

from __future__ import annotations

import math
import time
from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar

from lambda_core.domain.errors import SolverError

_END: ContextVar[float] = ContextVar("end", default=math.inf)


@contextmanager
def time_limit(end: float) -> Iterator[None]:
    """Let searches inside know their end [s of time.perf_counter]."""
    token = _END.set(end)
    try:
        yield
    finally:
        _END.reset(token)


def is_late() -> bool:
    """Tell whether the limit of wall time has passed."""
    return time.perf_counter() > _END.get()


def check_time(what: str) -> None:
    """Refuse to go on behind the limit; SolverError."""
    if is_late():
        raise SolverError(f"{what} did not end within the limit of wall time: give more time (solver.max_wall)")
