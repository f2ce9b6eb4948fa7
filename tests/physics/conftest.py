"""Compiled code of these tests is shared with the user's: its folders are named by content."""

from __future__ import annotations

from collections.abc import Iterator

import pytest


@pytest.fixture(scope="module", autouse=True)
def shared_compiled_code() -> Iterator[None]:
    with pytest.MonkeyPatch.context() as patch:
        patch.delenv("LAMBDA_BEARING_CACHE", raising=False)
        yield
