"""Provide cases that are almost right, and their mistakes."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Any

import pytest

from lambda_core import api
from lambda_core.case.written import merged

# Tests import the helpers of this folder by name.
sys.path.insert(0, str(Path(__file__).parent))
from almost_right import VALID, Problems


@pytest.fixture
def problems() -> Problems:
    """Return path -> sentence for every problem.

    Of the valid case after changes.
    """

    def find(**changes: Any) -> dict[str, str]:
        return {problem.where: problem.message for problem in api.problems(merged(VALID, changes))}

    return find
