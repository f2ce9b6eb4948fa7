"""Provide machines for searches of temperatures."""

from __future__ import annotations

from typing import Any

from lambda_core.case.written import merged

# A smooth shaft in two equal bearings, its load in the middle.
PAIR: dict[str, Any] = {
    "name": "pair",
    "shaft": {"sections": [{"length": "200 mm", "diameter": "40 mm"}]},
    "bearings": {
        "left": {"designation": "SKF 6208", "at": "50 mm", "clearance": "12 um"},
        "right": {"designation": "SKF 6208", "at": "150 mm", "clearance": "12 um"},
    },
    "loads": {"belt": {"at": "100 mm", "force_z": "-4 kN"}},
    "operation": {"speed": "3000 rpm"},
    "lubricant": {"name": "FVA3A", "temperature": "50 degC"},
}


def pair(**changes: Any) -> dict[str, Any]:
    """Return the tables of the pair with changes."""
    return merged(PAIR, changes)
