"""Test preload of angular contact pairs on shafts.

Force, lift-off, and places that count from first contact.
"""

from __future__ import annotations

from typing import Any

import pytest

from lambda_core import api
from lambda_core.analysis.rotor.machine_equilibrium import MachineEquilibrium


def _pair(speed: str, load: str = "0 N", preload: str | None = "5 um", **more: Any) -> dict[str, Any]:
    bearing = {"designation": "NSK 7208B"} | ({} if preload is None else {"preload": preload}) | more
    return {
        "name": "pair",
        "operation": {"speed": speed},
        "lubricant": {"name": "FVA3", "temperature": "60 degC"},
        "gravity": {"z": "0 m/s2"},
        "shaft": {"sections": [{"length": "200 mm", "diameter": "40 mm"}]},
        "bearings": {
            "left": bearing | {"at": "30 mm", "takes": "-x"},
            "right": bearing | {"at": "170 mm", "takes": "+x"},
        },
        "loads": {"thrust": {"at": "100 mm", "force_x": load}},
    }


def _solved(case: dict[str, Any]) -> MachineEquilibrium:
    found = api.quasistatic(case)
    assert isinstance(found, MachineEquilibrium)
    return found


def test_displacements_of_a_preloaded_pair_leave_the_free_gap_out() -> None:
    found = _solved(_pair("100 rpm"))
    assert [one.displacement_um[0] for one in found.bearings.values()] == pytest.approx([-5.0, 5.0], abs=0.3)
    assert [one.clearance_um for one in found.bearings.values()] == [None, None]


def test_preload_force_is_the_thrust_without_loads() -> None:
    alone, loaded = _solved(_pair("100 rpm")), _solved(_pair("100 rpm", "200 N"))
    force = [one.preload_force_N for one in loaded.bearings.values()]
    assert force == pytest.approx([abs(one.axial_load_N) for one in alone.bearings.values()], rel=1e-6)
    assert force[0] is not None
    assert force[0] < abs(loaded.bearing("right").axial_load_N)


def test_lift_off_thrust_unloads_the_opposite_bearing() -> None:
    """Compare with 2^1.5 times the preload.

    Two equal springs F = k s^1.5 part there (Harris and Kotzalas 2006, ch. 9).
    """
    found = _solved(_pair("100 rpm")).bearing("right")
    assert found.preload_force_N is not None
    assert found.lift_off_N is not None
    assert found.lift_off_N / found.preload_force_N == pytest.approx(2.0**1.5, rel=0.03)
    before = _solved(_pair("100 rpm", f"{-0.9 * found.lift_off_N} N"))
    after = _solved(_pair("100 rpm", f"{-1.1 * found.lift_off_N} N"))
    lifted = [min(abs(one.displacement_um[0]) for one in each.bearings.values()) for each in (before, after)]
    assert lifted[0] > 0.1
    assert [abs(one.axial_load_N) > 5.0 for one in before.bearings.values()] == [True, True]
    assert [abs(one.axial_load_N) > 5.0 for one in after.bearings.values()].count(False) == 1


def test_bearings_that_take_thrust_from_both_sides_have_no_preload_force() -> None:
    case = _pair("100 rpm")
    for one in case["bearings"].values():
        one |= {"designation": "SKF 6208"}
        del one["preload"], one["takes"]
    found = _solved(case)
    assert [(one.preload_force_N, one.lift_off_N) for one in found.bearings.values()] == [(None, None)] * 2
    assert all(one.clearance_um for one in found.bearings.values())


def test_a_spring_has_its_force_and_no_lift_off() -> None:
    found = _solved(_pair("100 rpm", preload=None, preload_force="300 N"))
    assert [one.lift_off_N for one in found.bearings.values()] == [None, None]
