"""Test prescribed motions of seats and bodies."""

from __future__ import annotations

import tomllib
from typing import Any

import numpy as np
import pytest

from lambda_core import api
from lambda_core.case.written import merged
from lambda_core.domain.elements import OUTER
from lambda_core.model.machine_templates import shaft_text
from lambda_core.model.resolve_machine import resolve_machine
from lambda_core.solver.drivers.machine_motion import machine_engine
from lambda_core.solver.drivers.machine_statics import solve_machine


def tables(left: dict[str, Any], right: dict[str, Any], **changes: Any) -> dict[str, Any]:
    """Return the template with prescribed seats."""
    seats = {"left": {"support": left}, "right": {"support": right}}
    return merged(tomllib.loads(shaft_text("geared-shaft", "box")), {"bearings": seats, **changes})


def test_a_shaft_that_is_carried_along_stays_as_it_is() -> None:
    """Move both seats on one rigid carrier.

    By 20 um and 0.2 mrad: the same reactions, second order.
    """
    angle, y, z = 2e-4, 2e-5, -1e-5  # about z [rad], [m]
    model = resolve_machine(tomllib.loads(shaft_text("geared-shaft", "box")))
    places = {bearing.name: bearing.position for bearing in model.bearings}
    seats = [
        {
            "y": {"motion": f"{y + angle * places[name]:.12g} m"},
            "z": {"motion": f"{z} m"},
            "tilt_z": {"motion": f"{angle} rad"},
        }
        for name in ("left", "right")
    ]
    seats[0]["x"] = {"motion": "3 um"}
    at_rest, carried = solve_machine(model), solve_machine(resolve_machine(tables(*seats)))
    assert carried.reactions == pytest.approx(at_rest.reactions, rel=2e-3, abs=0.5)
    moved = (carried.displacement - at_rest.displacement).reshape(-1, 6)
    assert moved[:, 0] == pytest.approx(3e-6, abs=2e-8)
    assert moved[:, 1] == pytest.approx(y + angle * model.body.positions, abs=2e-8)
    assert moved[:, 2] == pytest.approx(z, abs=2e-8)
    assert moved[:, 5] == pytest.approx(angle, rel=1e-3)


def test_a_seat_out_of_line_loads_its_bearing() -> None:
    """Tilt a seat by half a milliradian.

    The rings tilt by this, less the bending of the shaft.
    """
    report = api.quasistatic(resolve_machine(tables({}, {"tilt_y": {"motion": "0.5 mrad"}})))
    at_rest = api.quasistatic(resolve_machine(tables({}, {})))
    one, other = (found.bearings["right"] for found in (report, at_rest))
    assert one.misalignment_mrad[0] - other.misalignment_mrad[0] == pytest.approx(-0.5, rel=0.1)
    assert abs(one.moment_Nm[0]) > 5.0 * abs(other.moment_Nm[0])


def test_a_shaft_follows_seats_that_move() -> None:
    """Move both seats up and shake one.

    By 20 um in 4 ms; the right one is shaken along x at 250 Hz.
    """
    up = {"kind": "ramp", "start": "0 um", "end": "20 um", "start_time": "0 s", "end_time": "4 ms"}
    shaken = {"kind": "harmonic", "amplitude": "2 um", "frequency": "250 Hz"}
    right = {"x": {"motion": shaken}, "z": {"motion": up}}
    engine = machine_engine(resolve_machine(tables({"x": "free", "z": {"motion": up}}, right)))
    still = machine_engine(resolve_machine(tables({"x": "free"}, {"x": "locked"})))
    assert engine.advance(8e-3).ok
    assert still.advance(8e-3).ok
    moved, alike = engine.samples(), still.samples()
    assert moved is not None
    assert alike is not None
    t = moved.machine["time"]
    rings = [samples["body_position"][:, OUTER] for samples in moved.bearings]
    assert rings[0][:, 2] == pytest.approx(np.minimum(t / 4e-3, 1.0) * 2e-5, abs=1e-12)
    assert rings[1][:, 0] == pytest.approx(2e-6 * np.sin(2.0 * np.pi * 250.0 * t), abs=1e-12)
    speed = moved.bearings[1]["body_velocity"][:, OUTER, 0]
    assert speed == pytest.approx(2e-6 * 500.0 * np.pi * np.cos(500.0 * np.pi * t), abs=1e-9)
    late = t > 6e-3
    risen = moved.machine["shaft_position"][late, :, 2].mean(axis=0) - alike.machine["shaft_position"][
        alike.machine["time"] > 6e-3, :, 2
    ].mean(axis=0)
    assert risen == pytest.approx(2e-5, abs=1e-6)
    row = engine.integrals()[0]
    losses = sum(value for name, value in row.items() if name.startswith("loss"))
    assert abs(row["input"] - losses - row["stored"]) < 1e-3 * row["input_abs"]


BOX = {"x": "85 mm", "z": "-40 mm", "length": "160 mm", "width": "120 mm", "height": "80 mm"}


def boxed(hold: dict[str, Any]) -> dict[str, Any]:
    """Return the template with bearings in a body.

    The ground holds the body.
    """
    held = dict.fromkeys(("x", "y", "z", "tilt_x", "tilt_y", "tilt_z"), "locked")
    case = tables({}, {}, bodies={"box": {**BOX, "support": {**held, **hold}}})
    for bearing in case["bearings"].values():
        bearing["outer"] = "box"
    return case


def test_a_body_with_prescribed_motion_carries_its_bearings() -> None:
    """Carry bearings by a body with prescribed motion.

    By 20 um and, about its centre, 0.2 mrad: reactions as before, the shaft moves with the body.
    """
    at_rest, model = (
        solve_machine(resolve_machine(boxed({}))),
        resolve_machine(boxed({"x": {"motion": "3 um"}, "y": {"motion": "20 um"}, "tilt_z": {"motion": "0.2 mrad"}})),
    )
    carried = solve_machine(model)
    assert carried.bodies[0] == pytest.approx([3e-6, 2e-5, 0.0, 0.0, 0.0, 2e-4], abs=1e-15)
    assert carried.reactions == pytest.approx(at_rest.reactions, rel=2e-3, abs=0.5)
    moved = (carried.displacement - at_rest.displacement).reshape(-1, 6)
    assert moved[:, 0] == pytest.approx(3e-6, abs=2e-8)
    assert moved[:, 1] == pytest.approx(2e-5 + 2e-4 * (model.body.positions - 85e-3), abs=2e-8)


def test_a_body_that_is_shaken_does_work() -> None:
    """Shake a body at 100 Hz and balance energy.

    10 um, far below all modes: body, rings and shaft go along.
    """
    swing = {"kind": "harmonic", "amplitude": "10 um", "frequency": "100 Hz"}
    engine = machine_engine(resolve_machine(boxed({"y": {"motion": swing}, "x": {"motion": "3 um"}})))
    assert engine.advance(8e-3).ok
    samples = engine.samples()
    t = samples.machine["time"]
    expected = 1e-5 * np.sin(200.0 * np.pi * t)
    assert samples.machine["body_position"][:, 0, 1] == pytest.approx(expected, abs=1e-12)
    assert samples.machine["body_position"][:, 0, 0] == pytest.approx(3e-6, abs=1e-12)
    shaft = samples.machine["shaft_position"][:, :, 1].mean(axis=1)
    size = np.linalg.lstsq(np.column_stack([expected, np.ones(t.size)]), shaft, rcond=None)[0][0]
    assert size == pytest.approx(1.0, abs=0.15)
    row = engine.integrals()[0]
    losses = sum(value for name, value in row.items() if name.startswith("loss"))
    assert abs(row["input"] - losses - row["stored"]) < 1e-3 * row["input_abs"]


def test_motions_that_cannot_be_prescribed() -> None:
    """Refuse four motions at their paths.

    An elastically supported ring, one in a body, one on a preload spring, a course by a law.
    """
    box = {"x": "85 mm", "mass": "9 kg", "polar_inertia": "1 kg m2", "transverse_inertia": "1 kg m2"}
    for changes, where, said in (
        (tables({"y": {"mode": "free", "motion": "1 um"}}, {}), "support.y", 'needs mode = "prescribed", not "free"'),
        (
            tables({"y": {"motion": "1e6 mm"}}, {}),
            "support.y.motion",
            "goes to 1e+06 mm, allowed up to 100 mm: check the unit",
        ),
        (
            tables({}, {}, bodies={"box": {**box, "support": {"tilt_y": {"motion": "9 deg"}}}}),
            "bodies.box.support.tilt_y.motion",
            "goes to 9 deg, allowed up to 5.73 deg: check the unit",
        ),
        (
            merged(
                tables({"y": {"motion": "1 um"}}, {}, bodies={"box": box}), {"bearings": {"left": {"outer": "box"}}}
            ),
            "support.y.motion",
            "only a ring whose `outer` is the ground",
        ),
        (
            merged(
                tables({"x": {"motion": "1 um"}}, {}),
                {"bearings": {"left": {"takes": "+x", "preload_force": "100 N"}}},
            ),
            "support.x.motion",
            "`preload_force` makes the ring slide",
        ),
        (
            tables({}, {}, bodies={"box": {**box, "motion_z": "1 um"}}),
            "bodies.box.motion_z",
            "write support.z = { motion = ... }",
        ),
        (
            tables({"z": {"motion": {"kind": "law", "law": "chip", "amplitude": "1 um"}}}, {}),
            "support.z.motion.law",
            "nearest: chirp",
        ),
    ):
        with pytest.raises(api.CaseError) as found:
            resolve_machine(changes)
        problems = {problem.where: problem.message for problem in found.value.problems}
        assert said in problems[where if where.startswith("bodies") else f"bearings.left.{where}"], problems
