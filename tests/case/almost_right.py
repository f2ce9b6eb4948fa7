"""Provide a case without mistakes, to add one to it."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

Problems = Callable[..., dict[str, str]]

VALID: dict[str, Any] = {
    "name": "mine",
    "bearing": {"designation": "6208", "maker": "Syla2026", "clearance": "14 um"},
    "lubricant": {"name": "bode-mineral", "temperature": "40 degC"},
    "loads": {"axial": "700 N"},
    "operation": {"speed": "2750 rpm"},
}
