"""Results and studies of a folder, and whether they have changed."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

# What makes a folder a study; a test holds it to the batch room's own.
MANIFEST = "manifest.sqlite"
WHOLE = "shaft.h5"  # what makes a folder the run of a shaft


def is_study(path: Path) -> bool:
    """Tell whether a path is the folder of a study."""
    return (path / MANIFEST).is_file()


def is_shaft_run(path: Path) -> bool:
    """Tell whether a path is the folder of the run of a shaft, with a result for each of its bearings."""
    return (path / WHOLE).is_file()


def named(path: Path) -> str:
    """Return the name under which a result or a study is listed; that of a bearing on a shaft with its run."""
    if path.is_dir():
        return f"{path.name}/"
    return f"{path.parent.name}/{path.stem}" if is_shaft_run(path.parent) else path.stem


def results_in(folder: Path) -> list[Path]:
    """Return the result files, the studies and the runs of shafts with their bearings in a folder, the newest first."""
    try:
        shafts = [file.parent for file in (*folder.glob(WHOLE), *folder.glob(f"*/{WHOLE}"))]
        bearings = [file for shaft in shafts if shaft != folder for file in shaft.glob("*.h5")]
        files = [file for file in (*folder.glob("*.h5"), *bearings) if file.name != WHOLE]
        found = [*files, *shafts, *(file.parent for file in folder.glob(f"*/{MANIFEST}"))]
        return sorted(found, key=lambda path: -_file(path).stat().st_mtime)
    except OSError:
        return []


def _file(path: Path) -> Path:
    """Return the file that changes as a result, a study or the run of a shaft grows."""
    if not path.is_dir():
        return path
    return path / (WHOLE if is_shaft_run(path) else MANIFEST)


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
