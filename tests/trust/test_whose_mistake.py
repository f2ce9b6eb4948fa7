"""Test errors of the system.

What names somebody's file or lacks room is no bug, anything else is one.
"""

from __future__ import annotations

import errno
import os
from pathlib import Path

import pytest
from lambda_cli.main import main

import lambda_core
from lambda_core import api


@pytest.mark.parametrize(
    ("error", "code", "words"),
    [
        (FileNotFoundError(errno.ENOENT, "No such file or directory", "mine.csv"), 2, 'cannot use "mine.csv": No such'),
        (PermissionError(errno.EACCES, "Permission denied", b"mine.csv"), 2, 'cannot use "mine.csv": Permission'),
        (OSError(errno.ENOSPC, "whatever"), 2, f"the system refuses: {os.strerror(errno.ENOSPC)}"),
        (OSError("Can't read data (wrong B-tree signature)"), 1, "has a bug: OSError: Can't read data"),
        (OSError(errno.EBADF, "Bad file descriptor"), 1, "has a bug"),
        (FileNotFoundError(errno.ENOENT, "No such file", str(Path(lambda_core.__file__).parent / "x")), 1, "has a bug"),
    ],
)
def test_only_errors_about_a_file_or_room_are_blamed_on_the_user(
    error: OSError, code: int, words: str, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    def refuse(*_: object, **__: object) -> None:
        raise error

    monkeypatch.setattr(api, "case", refuse, raising=False)
    monkeypatch.setattr(api, "check", refuse, raising=False)
    assert main(["check", "6208-axial-1300"]) == code
    assert words in capsys.readouterr().err
