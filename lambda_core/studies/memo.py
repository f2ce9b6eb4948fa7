"""Keep outcomes of jobs for whoever asks again."""

from __future__ import annotations

import json
import os
from collections.abc import Mapping
from pathlib import Path
from typing import Any


class Memo:
    """Outcomes in a folder.

    Each outcome is one JSON file; any process may read and write at any time.

    Parameters
    ----------
    folder : pathlib.Path
        Made when something is kept.
    """

    def __init__(self, folder: Path) -> None:
        self._folder = folder

    def find(self, name: str) -> dict[str, Any] | None:
        """Return the outcome under a name.

        None when there is nothing, or it cannot be read.
        """
        try:
            found = json.loads(self._path(name).read_text(encoding="utf-8"))
        except (OSError, ValueError):
            return None
        return found if isinstance(found, dict) else None

    def keep(self, name: str, content: Mapping[str, Any]) -> None:
        """Write something whole or not at all."""
        path = self._path(name)
        path.parent.mkdir(parents=True, exist_ok=True)
        part = path.with_suffix(f".{os.getpid()}")
        part.write_text(json.dumps(dict(content), allow_nan=False), encoding="utf-8")
        part.replace(path)

    def _path(self, name: str) -> Path:
        return self._folder / f"{name}.json"
