"""Keep a short list of recent case files."""

from __future__ import annotations

import json
import os
import tempfile
from contextlib import suppress
from pathlib import Path

from lambda_core.domain.files import user_data_folder

_MOST = 20  # files that are kept in mind


def _file() -> Path:
    return user_data_folder() / "recent.json"


def _is_temporary(path: Path) -> bool:
    return path.is_relative_to(Path(tempfile.gettempdir()).resolve())


def recent_cases() -> list[Path]:
    """Return recent files that still exist.

    The newest one comes first; an unreadable list is empty.

    Files in the folder for temporary files are left out.
    """
    try:
        found = json.loads(_file().read_text(encoding="utf-8"))
        return [path for path in map(Path, found) if path.is_file() and not _is_temporary(path)]
    except (OSError, ValueError, TypeError):
        return []


def remember(path: str | Path) -> None:
    """Put a case file at the head of the list.

    Omit temporary files, and ignore failures to write.
    """
    with suppress(OSError):
        case = Path(path).resolve()
        if case.suffix != ".toml" or not case.is_file() or _is_temporary(case):
            return
        names = [str(known) for known in (case, *(known for known in recent_cases() if known != case))]
        file = _file()
        file.parent.mkdir(parents=True, exist_ok=True)
        fresh = file.with_name(f"recent-{os.getpid()}.json")
        fresh.write_text(json.dumps(names[:_MOST]), encoding="utf-8")
        fresh.replace(file)
