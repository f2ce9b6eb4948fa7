"""Keep unsaved work for recovery after a crash."""

from __future__ import annotations

import hashlib
import json
import os
import socket
import time
import tomllib
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from lambda_core.api import Status, is_machine, save_text, this_process
from lambda_core.domain.errors import UsageError

if TYPE_CHECKING:
    from lambda_core.api import Draft


def state_folder() -> Path:
    """Return the folder of the builder's state.

    It has recovery files and the files of runs.
    """
    from lambda_core.domain.files import user_data_folder

    return user_data_folder() / "builder"


@dataclass(frozen=True)
class Rescue:
    """Unsaved work of a builder that is gone."""

    file: Path
    path: Path | None  # of the case
    text: str
    when: float

    @property
    def is_machine(self) -> bool:
        """True for the case of a machine."""
        return is_machine(tomllib.loads(self.text))

    def age(self) -> str:
        """Return how long ago it was kept, for people."""
        minutes = (time.time() - self.when) / 60.0
        if minutes < 1.5:
            return "a minute ago"
        if minutes < 90.0:
            return f"{minutes:.0f} minutes ago"
        return f"{minutes / 60.0:.0f} hours ago" if minutes < 2880.0 else f"{minutes / 1440.0:.0f} days ago"


class Keeper:
    """Keeps the unsaved state of one draft."""

    def __init__(self) -> None:
        self._file: Path | None = None

    def keep(self, draft: Draft) -> None:
        """Write the draft's text aside.

        UsageError when that cannot be done.
        """
        file = _file_of(draft.path)
        if self._file is not None and self._file != file:
            self.drop()
        content = {
            "path": str(draft.path.resolve()) if draft.path else None,
            "text": draft.text(),
            "when": time.time(),
            "process": this_process(),
        }
        try:
            file.parent.mkdir(parents=True, exist_ok=True)
        except OSError as error:
            raise UsageError(f'cannot write "{file.parent}": {error.strerror}') from None
        save_text(json.dumps(content), file)
        self._file = file

    def drop(self) -> None:
        """Remove the recovery file.

        Everything is saved, or given up on purpose.
        """
        if self._file is not None:
            _remove(self._file)
            self._file = None


def rescues(path: Path | None) -> list[Rescue]:
    """Return unsaved work on a case.

    None means cases without a file; the newest comes first.
    """
    folder = state_folder() / "unsaved"
    wanted = str(path.resolve()) if path else None
    found = []
    for file in folder.glob("*.json") if folder.is_dir() else ():
        try:
            content = json.loads(file.read_text(encoding="utf-8"))
            if content["path"] != wanted or _is_in_use(content["process"]):
                continue
            tomllib.loads(content["text"])
            found.append(Rescue(file, path, content["text"], float(content["when"])))
        except (OSError, ValueError, KeyError, TypeError):
            continue  # half a file of a full disk, or none of ours
    return sorted(found, key=lambda rescue: -rescue.when)


def take(rescue: Rescue, draft: Draft) -> None:
    """Put rescued work into its draft.

    It appears as unsaved changes of its case.
    """
    draft.replace(tomllib.loads(rescue.text))
    forget(rescue)


def forget(rescue: Rescue) -> None:
    """Give rescued work up."""
    _remove(rescue.file)


def _file_of(path: Path | None) -> Path:
    name = str(path.resolve()) if path else f"untitled-{os.getpid()}"
    return state_folder() / "unsaved" / f"{hashlib.sha256(name.encode()).hexdigest()[:16]}.json"


def _is_in_use(process: dict[str, str]) -> bool:
    """Tell whether the writing builder may be open.

    On another machine nobody can see that.
    """
    return process["host"] != socket.gethostname() or Status(process=process).alive()


def _remove(file: Path) -> None:
    try:
        file.unlink(missing_ok=True)
    except OSError:
        return  # a read-only home; the file is offered again, nothing is lost
