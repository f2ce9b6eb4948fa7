"""Provide bearings for searches of temperatures."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Any

import pytest

# Helpers of these tests are modules next to this file.
sys.path.insert(0, str(Path(__file__).parent))


@pytest.fixture(scope="session")
def ordinary() -> dict[str, Any]:
    """Return a 6208 in a pillow block.

    The case has no temperatures.
    """
    return {
        "name": "ordinary",
        "bearing": {"designation": "6208", "maker": "SKF", "clearance": "12 um"},
        "lubricant": {"name": "FVA3A", "temperature": "50 degC"},
        "loads": {"radial": "2 kN"},
        "operation": {"speed": "3000 rpm"},
        "depth": {"cage": False},
    }
