"""Test a shaft that the ground holds at one place."""

from __future__ import annotations

import tomllib
from typing import Any

import numpy as np
import pytest

from lambda_core import api
from lambda_core.analysis.rotor.vibration import supported
from lambda_core.model.machine_model import MachineModel
from lambda_core.model.machine_templates import shaft_text
from lambda_core.solver.drivers.machine_motion import machine_engine
from lambda_core.solver.drivers.machine_statics import solve_machine


def machine(**support: Any) -> MachineModel:
    """Return the machine that init writes, its shaft held."""
    tables = tomllib.loads(shaft_text("geared-shaft", "box"))
    tables["shaft"]["support"] = support
    found = api.check(tables)
    assert isinstance(found, MachineModel)
    return found


def test_a_held_place_stays_where_it_is_moved() -> None:
    """Keep a held place while the shaft bends.

    The torque of the coupling is that of the gear as before.
    """
    model = machine(at="85 mm", y="locked", z={"motion": "10 um"}, tilt_y="locked")
    state, free = solve_machine(model), solve_machine(machine())
    moved = state.displacement[model.body.rows(0.085)]
    assert moved[[1, 2, 4]] == pytest.approx([0.0, 10e-6, 0.0], abs=1e-18)
    assert np.abs(state.displacement[model.body.rows(0.148)][1:3]).max() > 1e-7
    assert state.drive_torque == pytest.approx(free.drive_torque, rel=1e-9)


def test_a_very_stiff_support_is_a_lock() -> None:
    """Compare 1e15 N/m with a lock.

    The support gives way by a picometre; reactions of the bearings agree to 1e-5.
    """
    locked = solve_machine(machine(at="60 mm", y="locked", z="locked"))
    stiff = machine(at="60 mm", y="1000000000 N/um", z="1000000000 N/um")
    found = solve_machine(stiff)
    assert found.reactions == pytest.approx(locked.reactions, rel=1e-5, abs=1e-3)
    k = supported(stiff, found)
    assert sorted(np.diag(k))[-2:] == pytest.approx([1e15, 1e15], rel=1e-3)


def test_a_shaken_shaft_keeps_its_balance_of_energy() -> None:
    """Balance energy of a shaken shaft.

    The work of the prescribed motion counts as input, to 1e-3.
    """
    shaken = {"motion": {"kind": "harmonic", "amplitude": "3 um", "frequency": "50 Hz"}}
    engine = machine_engine(machine(at="left", x=shaken, z=shaken))
    assert engine.advance(4e-3).ok
    for row in engine.integrals():
        losses = sum(value for name, value in row.items() if name.startswith("loss"))
        assert abs(row["input"] - losses - row["stored"]) < 1e-3 * row["input_abs"]


def test_mistakes_of_a_support() -> None:
    for support, where in (
        ({"at": "900 mm", "y": "locked"}, "shaft.support.at"),
        ({"at": "middle", "y": "locked"}, "shaft.support.at"),
        ({"y": {"motion": "1 m"}}, "shaft.support.y.motion"),
        ({"tilt_x": "locked"}, "shaft.support.tilt_x"),
    ):
        with pytest.raises(api.CaseError) as found:
            machine(**support)
        assert [problem.where for problem in found.value.problems] == [where]


def test_a_torque_drives_the_shaft() -> None:
    """Compare work with torque times angle.

    1 % for the change of speed; the balance of energy closes to 1e-3.
    """
    works = []
    for torque in (0.0, 2.0):
        tables = tomllib.loads(shaft_text("geared-shaft", "box")) | {"gears": {}}
        tables["operation"]["torque"] = f"{torque} N m"
        engine = machine_engine(api.check(tables))
        assert engine.advance(3e-3).ok
        row = engine.integrals()[0]
        losses = sum(value for name, value in row.items() if name.startswith("loss"))
        assert abs(row["input"] - losses - row["stored"]) < 1e-3 * max(row["input_abs"], losses)
        works.append((row["input"], row["stored"], engine.time))
    (_, coasting, _), (work, stored, time) = works
    assert work == pytest.approx(2.0 * 100.0 * np.pi * time, rel=0.01)
    assert coasting < 0.0 < stored


def test_a_torque_and_a_speed_over_time_contradict() -> None:
    tables = tomllib.loads(shaft_text("geared-shaft", "box"))
    ramp = {"kind": "ramp", "start": "0 rpm", "end": "3000 rpm", "end_time": "1 s"}
    tables["operation"] = {"speed": ramp, "torque": "2 N m"}
    with pytest.raises(api.CaseError) as found:
        api.check(tables)
    assert {problem.where for problem in found.value.problems} == {"operation.speed", "gears.wheel.power"}
