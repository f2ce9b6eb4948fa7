"""Test locks between processes."""

from __future__ import annotations

from pathlib import Path

import pytest
from filelock import FileLock, Timeout

from lambda_core.domain.processes import locked


def test_a_lock_keeps_every_other_holder_out(tmp_path: Path) -> None:
    """Lock a file against every other holder.

    The second holder asks in this process or in another one.
    """
    path = tmp_path / "locks" / "one.lock"
    with locked(path), pytest.raises(Timeout):
        FileLock(path).acquire(timeout=0.0)
    with FileLock(path).acquire(timeout=0.0):
        assert path.exists()
