"""Provide a bearing that runs away."""

from __future__ import annotations

from typing import Any

from lambda_core.case.written import merged

# Oil that is kept at one temperature, a cooled housing, a shaft that takes little heat: the classic way into preload.
PRELOADED: dict[str, Any] = {
    "name": "preloaded",
    "bearing": {"designation": "6208", "maker": "SKF", "clearance": "5 um"},
    "lubricant": {"name": "FVA3A", "temperature": "40 degC"},
    "loads": {"radial": "500 N"},
    "operation": {"speed": "3000 rpm"},
    "depth": {"cage": False},
    "thermal": {
        "conductances": "none",
        "nodes": {"oil": {"temperature": "60 degC"}},
        "links": {
            "shaft": {"between": ["inner_ring", "ambient"], "conductance": "0.2 W/K"},
            "housing": {"between": ["outer_ring", "ambient"], "conductance": "20 W/K"},
            "inside": {"between": ["inner_ring", "oil"], "conductance": "0.1 W/K"},
            "outside": {"between": ["outer_ring", "balls"], "conductance": "5 W/K"},
        },
    },
}


def preloaded(speed: str, **changes: Any) -> dict[str, Any]:
    """Return the tables of the preloaded bearing at a speed."""
    return merged(merged(PRELOADED, {"operation": {"speed": speed}}), changes)
