"""Test angular contact bearings of the catalogue on a shaft.

The row's contact angle counts, and the side that they take.
"""

from __future__ import annotations

import math
from typing import Any

import pytest

from lambda_core.domain.errors import CaseError
from lambda_core.model.resolve_machine import resolve_machine


def pair(**left: str) -> dict[str, Any]:
    bearing = {"designation": "NSK 7208 B", "preload": "5 um"}
    return {
        "name": "pair",
        "shaft": {"sections": [{"length": "100 mm", "diameter": "40 mm"}]},
        "bearings": {
            "left": {**bearing, "at": "20 mm", **left},
            "right": {"designation": "SKF 7208 BEP", "at": "80 mm", "takes": "-x"},
        },
        "loads": {"force": {"at": "50 mm", "force_z": "-2 kN"}},
        "lubricant": {"name": "FVA3", "temperature": "60 degC"},
        "operation": {"speed": "1500 rpm"},
    }


def test_the_rows_angle_counts() -> None:
    """Use 40 degrees for ratings and play.

    Play to touching rings is A sin(alpha_0) with A = 0.04 D_w, before the preload.
    """
    left, right = resolve_machine(pair(takes="+x")).bearings
    assert math.degrees(left.nominal_angle) == pytest.approx(40.0)
    assert (left.dynamic_rating, right.dynamic_rating) == (32.0e3, 34.5e3)
    play = 0.04 * 11.906e-3 * math.sin(math.radians(40.0))
    assert left.seating.shift[0] == pytest.approx(-(play + 5e-6), rel=5e-4)
    assert right.seating.shift[0] == pytest.approx(0.04 * 12.7e-3 * math.sin(math.radians(40.0)), rel=5e-4)


def test_the_side_is_required() -> None:
    case = pair()
    del case["bearings"]["left"]["preload"]
    with pytest.raises(CaseError, match=r"takes.*angular contact"):
        resolve_machine(case)
