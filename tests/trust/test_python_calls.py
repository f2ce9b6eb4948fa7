"""Calls of the Python API with what is no case and no change: refused in a sentence, before anything runs."""

from __future__ import annotations

from typing import Any

import pytest

from lambda_core import api
from lambda_core.domain.errors import UsageError


@pytest.mark.parametrize("source", [True, 1, None, 2.5, b"bytes"])
def test_a_source_that_is_no_case_is_named(source: Any) -> None:
    with pytest.raises(UsageError, match=rf"{type(source).__name__} is not a case: give a file"):
        api.check(source)


@pytest.mark.parametrize("change", [1, None, ["loads.radial", "1 N"], {"loads.radial": "1 N"}])
def test_a_change_that_is_no_text_is_named(change: Any) -> None:
    with pytest.raises(UsageError, match="is not a change: write path=value"):
        api.check("6208-axial-1300", [change])
