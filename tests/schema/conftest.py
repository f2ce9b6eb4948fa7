"""Cases that are almost right, and one door to every mistake in them."""

from __future__ import annotations

import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from lambda_core import api
from lambda_core.schema.case import merged

# Tests import the strategies of this folder by name.
sys.path.insert(0, str(Path(__file__).parent))

Problems = Callable[..., dict[str, str]]

VALID: dict[str, Any] = {
    "name": "mine",
    "bearing": {"designation": "6208", "maker": "Syla2026", "clearance": "14 um"},
    "lubricant": {"name": "bode-mineral", "temperature": "40 degC"},
    "loads": {"axial": "700 N"},
    "operation": {"speed": "2750 rpm"},
}


@pytest.fixture
def problems() -> Problems:
    """Return path -> sentence for everything wrong with the valid case after changes."""

    def find(**changes: Any) -> dict[str, str]:
        return {problem.where: problem.message for problem in api.problems(merged(VALID, changes))}

    return find
