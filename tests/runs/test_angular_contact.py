"""Test an angular contact bearing from designation to result."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import pytest

from lambda_core import api
from lambda_core.results.reader import Result

CASE: dict[str, Any] = {
    "name": "7208",
    "bearing": {"designation": "NSK 7208 B"},
    "lubricant": {"name": "FVA3", "temperature": "60 degC"},
    "loads": {"axial": "2 kN", "radial": "500 N"},
    "operation": {"speed": "1500 rpm"},
    "bodies": {"inner_ring": {"tilt_y": "locked", "tilt_z": "locked"}},
}


def test_the_row_makes_the_contact_angle() -> None:
    """Compare clearance with 2 A (1 - cos(alpha_0)).

    Free angle 40 degrees, A = 0.04 D_w; the case's own angle comes first.
    """
    g = api.check(CASE).geometry
    assert math.degrees(g.contact_angle) == pytest.approx(40.0)
    assert g.clearance == pytest.approx(0.08 * 11.906e-3 * (1.0 - math.cos(math.radians(40.0))), rel=3e-4)
    assert math.degrees(api.check(CASE, ["bearing.contact_angle=30 deg"]).geometry.contact_angle) == pytest.approx(30.0)
    wide = api.check(CASE, ["bearing.clearance=100 um"]).geometry
    assert (wide.contact_angle, wide.clearance) == (0.0, pytest.approx(100e-6))


@pytest.mark.parametrize("change", ["bearing.clearance=C3", "bearing.designation=NSK 7208B C3"])
def test_a_class_of_radial_contact_is_refused(change: str) -> None:
    with pytest.raises(api.CaseError, match=r'"C3" is a class of radial contact bearings: leave it out, 7208B has'):
        api.check(CASE, [change])


def test_a_run(tmp_path: Path) -> None:
    """Balance forces and energy at 40 degrees.

    Balls stay near this angle; the energy balance closes to 1e-3.
    """
    path = tmp_path / "angular.h5"
    api.run(CASE, ["solver.duration=2 ms", "depth.strips=15"], out=path)
    summary = Result(path).summary()
    assert summary.energy_residual < 1e-3
    loaded = [c for c in summary.contacts if c.ring == "inner"]
    axial = sum(c.load_N * math.sin(math.radians(c.contact_angle_deg)) for c in loaded)
    assert axial == pytest.approx(2000.0, rel=0.02)
    assert all(35.0 < c.contact_angle_deg < 46.0 for c in loaded if c.load_N > 50.0)
