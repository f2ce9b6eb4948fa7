"""Share fixtures among the tests of studies."""

from __future__ import annotations

import sys
from collections.abc import Callable
from concurrent.futures import Executor
from pathlib import Path

import pytest

# The small studies are also used by scripts in processes of their own.
sys.path.insert(0, str(Path(__file__).parent))


@pytest.fixture
def inline() -> Executor:
    """Return an executor in this process."""
    from studies import Inline

    return Inline()


@pytest.fixture
def write(tmp_path: Path) -> Callable[..., Path]:
    """Write a study file."""

    def one(text: str, name: str = "study.toml") -> Path:
        path = tmp_path / name
        path.write_text(text, encoding="utf-8")
        return path

    return one
