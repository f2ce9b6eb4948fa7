"""Test elastic parts of four-point and double row bearings."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from lambda_core import api
from lambda_core.solver.drivers.dynamics import BearingEngine

COMMON: dict[str, Any] = {
    "name": "kind", "operation": {"speed": "3000 rpm"}, "lubricant": {"name": "FVA3", "temperature": "70 degC"},
    "loads": {"radial": "4 kN", "axial": "1 kN"},
}  # fmt: skip
TWO_ROWS = {
    "contact_angle": "30 deg",
    "axial_clearance": "5 um",
    "geometry": {
        "ball_count": 14, "ball_diameter": "11.112 mm", "pitch_diameter": "60 mm", "conformity_inner": 0.515,
        "conformity_outer": 0.525, "bore_diameter": "40 mm", "outside_diameter": "80 mm", "width": "30.2 mm",
        "series": "32", "rows": 2, "row_distance": "14 mm", "arrangement": "O",
    },
}  # fmt: skip
KINDS = {"four-point": {"designation": "SKF QJ 208"}, "two rows": TWO_ROWS}
CAGE = {"section_height": "2 mm", "section_width": "4 mm"}


def elastic(housing: str) -> dict[str, Any]:
    ring = {"housing_stiffness": housing, "orders": 4}
    return {"inner_ring": ring, "outer_ring": ring, "cage": CAGE}


@pytest.mark.parametrize("kind", KINDS)
def test_rigid_limit_and_load_sharing(kind: str) -> None:
    """Compare rigid and soft housings.

    The rigid one gives the rigid equilibrium, 1e-6; in the soft one the most loaded ball carries less.
    """
    case = {**COMMON, "bearing": KINDS[kind]}
    rigid, stiff, soft = (
        api.quasistatic(api.check({**case, "elastic": parts}))
        for parts in ({}, elastic("1e15 N/m"), elastic("100 N/um"))
    )
    assert stiff.max_load_N == pytest.approx(rigid.max_load_N, rel=1e-6)
    assert stiff.friction_torque_Nmm == pytest.approx(rigid.friction_torque_Nmm, rel=1e-6)
    assert stiff.inner_ring_displacement_um == pytest.approx(rigid.inner_ring_displacement_um, rel=1e-5, abs=1e-4)
    assert soft.max_load_N < 0.97 * rigid.max_load_N
    assert [bent.ring for bent in soft.ring_shapes] == ["inner", "outer"]


@pytest.mark.parametrize("kind", KINDS)
def test_balance_of_a_run(kind: str) -> None:
    """Balance energy to 1e-3 while every part bends."""
    engine = BearingEngine(api.check({**COMMON, "bearing": KINDS[kind], "elastic": elastic("100 N/um")}))
    assert engine.advance(8e-3).ok
    integrals = engine.integrals()
    lost = sum(value for name, value in integrals.items() if name.startswith(("loss.", "support")))
    assert abs(integrals["input"] - lost - integrals["stored"]) < 1e-3 * integrals["input_abs"]
    samples = engine.samples()
    for body in ("inner_ring", "outer_ring", "cage"):
        assert np.ptp(samples[f"{body}_ovality"]) > 1e-7, body
