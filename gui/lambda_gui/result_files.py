"""List results and studies of a folder and their changes."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

# What makes a folder a study; a test compares it with that of package studies.
MANIFEST = "manifest.sqlite"


def is_study(path: Path) -> bool:
    """Tell whether a path is the folder of a study."""
    return (path / MANIFEST).is_file()


def named(path: Path) -> str:
    """Return the listed name of a result.

    It may also be that of a study.
    """
    return f"{path.name}/" if path.is_dir() else path.stem


def results_in(folder: Path) -> list[Path]:
    """Return a folder's results and studies.

    The newest one comes first.
    """
    try:
        found = [*folder.glob("*.h5"), *(file.parent for file in folder.glob(f"*/{MANIFEST}"))]
        return sorted(found, key=lambda path: -_file(path).stat().st_mtime)
    except OSError:
        return []


def _file(path: Path) -> Path:
    """Return the file that grows.

    It is that of a result or a study.
    """
    return path / MANIFEST if path.is_dir() else path


def stamp_of(paths: Sequence[Path]) -> object:
    """Return what changes when one of the files does."""
    found = []
    for path in paths:
        try:
            status = _file(path).stat()
            found.append((path, status.st_size, status.st_mtime_ns))
        except OSError:
            found.append((path, 0, 0))
    return found
