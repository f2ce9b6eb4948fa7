"""The benchmarks stand beside the packages, not among them; their compiled code is the user's."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))


@pytest.fixture(scope="module", autouse=True)
def shared_compiled_code() -> Iterator[None]:
    with pytest.MonkeyPatch.context() as patch:
        patch.delenv("LAMBDA_BEARING_CACHE", raising=False)
        yield
