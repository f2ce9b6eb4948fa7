"""Result files of a folder, and whether they have changed."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path


def results_in(folder: Path) -> list[Path]:
    """Return the result files of a folder, the newest first."""
    try:
        return sorted(folder.glob("*.h5"), key=lambda path: -path.stat().st_mtime)
    except OSError:
        return []


def stamp_of(paths: Sequence[Path]) -> object:
    """Return what changes when one of the files does."""
    found = []
    for path in paths:
        try:
            status = path.stat()
            found.append((path, status.st_size, status.st_mtime_ns))
        except OSError:
            found.append((path, 0, 0))
    return found
