"""Make slow read-only data once for all test processes."""

from __future__ import annotations

import shutil
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

try:
    import fcntl
except ImportError:  # Windows: each process makes its own
    fcntl = None  # type: ignore[assignment]
CAN_SHARE = fcntl is not None


def made_once(folder: Path, fill: Callable[[Path], object]) -> Path:
    """Return a folder that one process fills.

    Others wait meanwhile, and try themselves where it failed.
    """
    folder.parent.mkdir(exist_ok=True)
    done = folder.with_name(f"{folder.name}.done")
    with alone(folder.with_name(f"{folder.name}.lock")):
        if not done.exists():
            shutil.rmtree(folder, ignore_errors=True)
            folder.mkdir()
            fill(folder)
            done.touch()
    return folder


@contextmanager
def alone(path: Path) -> Iterator[None]:
    """Let other processes wait meanwhile."""
    with path.open("w") as lock:
        if CAN_SHARE:
            fcntl.flock(lock, fcntl.LOCK_EX)
        yield
