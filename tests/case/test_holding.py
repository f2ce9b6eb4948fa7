"""Test the one notation of held degrees of freedom."""

from __future__ import annotations

import tomllib
from typing import Any

import numpy as np
import pytest

from lambda_core import api
from lambda_core.case.draft import draft_of
from lambda_core.case.written import merged
from lambda_core.model.checking import check_bearing
from lambda_core.model.laws.time_functions import initial
from lambda_core.model.machine_model import MachineModel
from lambda_core.model.machine_templates import shaft_text
from lambda_core.solver.drivers.structure import static_rows, structure

BOX = {"x": "85 mm", "length": "160 mm", "width": "120 mm", "height": "80 mm"}


def tables(**changes: Any) -> dict[str, Any]:
    """Return the case that init writes, changed."""
    return merged(tomllib.loads(shaft_text("geared-shaft", "box")), changes)


def machine(**changes: Any) -> MachineModel:
    """Return that case resolved."""
    found = api.check(tables(**changes))
    assert isinstance(found, api.MachineModel)
    return found


def mistakes(source: Any) -> dict[str, str]:
    """Return what is wrong with a case, by place."""
    return {problem.where: problem.message for problem in api.problems(source)}


@pytest.mark.parametrize(
    ("short", "long"),
    [
        ("200 N/um", {"mode": "free", "stiffness": "200 N/um"}),
        ({"stiffness": "2 N/um", "damping": "3 N s/m"}, {"mode": "free", "stiffness": "2 N/um", "damping": "3 N s/m"}),
        ({"motion": "3 um"}, {"mode": "prescribed", "motion": "3 um"}),
        ("locked", {"mode": "locked"}),
    ],
)
def test_short_and_long_forms_are_one(short: Any, long: Any) -> None:
    """Write a ring's support back as it was read."""
    rings = []
    for how in (short, long):
        case = api.case("6208-axial-1300").with_(bodies={"outer_ring": {"y": how}})
        assert case.written()["bodies"]["outer_ring"]["y"] == short
        rings.append(check_bearing(case).outer_ring)
    assert rings[0] == rings[1]


def test_a_seat_takes_what_a_ring_takes() -> None:
    """Give seats stiffness, damping and motion in every table."""
    support = {"y": {"stiffness": "200 N/um", "damping": "1000 N s/m"}, "tilt_z": {"motion": "0.2 mrad"}}
    seat = machine(bearings={"right": {"support": support}}).bearings[1].seating
    assert seat.stiffness[1] == pytest.approx(2e8)
    assert seat.damping[1] == pytest.approx(1000.0)
    assert seat.shift[4] == pytest.approx(2e-4)


def test_the_ground_damps_a_body() -> None:
    """Find stiffness and damping of a support at the centre."""
    held = {"x": {"stiffness": "3 N/um", "damping": "70 N s/m"}, "tilt_x": {"damping": "2 N m s/rad"}, "z": "5 N/um"}
    model = machine(bodies={"box": {**BOX, "support": held}})
    rows = static_rows(model)
    stiffness, damping = (np.diag(found)[rows.bodies :] for found in structure(model, rows))
    assert stiffness == pytest.approx([3e6, 0.0, 5e6, 0.0, 0.0, 0.0])
    assert damping == pytest.approx([70.0, 0.0, 0.0, 2.0, 0.0, 0.0])


def test_a_connection_is_a_spring_and_a_damper() -> None:
    seal = {"at": "160 mm", "z": {"stiffness": "1 N/um", "damping": "200 N s/m"}, "tilt_y": "1 N m/mrad"}
    (spring,) = machine(connections={"seal": seal}).springs
    assert np.diag(spring.stiffness) == pytest.approx([0.0, 0.0, 1e6, 0.0, 1e3, 0.0])
    assert np.diag(spring.damping) == pytest.approx([0.0, 0.0, 200.0, 0.0, 0.0, 0.0])


def test_a_part_stands_at_a_length_a_marker_or_a_bearing() -> None:
    loads = {
        "one": {"at": "21 mm", "force_z": "-1 N"},
        "two": {"at": "left", "force_z": "-1 N"},
        "three": {"at": "seat", "force_z": "-1 N"},
    }
    model = machine(loads=loads, markers={"seat": {"x": "21 mm"}}, gears={"wheel": None})
    assert dict(model.load_places) == dict.fromkeys(loads, pytest.approx(0.021))
    assert model.loads[model.body.rows(0.021)][2] == pytest.approx(-3.0)


@pytest.mark.parametrize(
    ("changes", "where", "said"),
    [
        ({"bearings": {"left": {"position": "21 mm"}}}, "bearings.left.position", 'write at = "85 mm"'),
        ({"loads": {"a": {"marker": "foot"}}}, "loads.a.marker", 'at = "NAME"'),
        ({"springs": {"a": {"at": "1 mm"}}}, "springs", "write [connections.NAME]"),
        (
            {"bearings": {"left": {"support": {"motion_y": "1 um"}}}},
            "bearings.left.support.motion_y",
            "write y = { motion = ... }",
        ),
        (
            {"bearings": {"left": {"support": {"damping_y": "1 N s/m"}}}},
            "bearings.left.support.damping_y",
            "write y = { stiffness = ..., damping = ... }",
        ),
        ({"bodies": {"b": {**BOX, "hold_z": "free"}}}, "bodies.b.hold_z", "write support.z"),
        ({"connections": {"a": {"at": "1 mm", "x": "locked"}}}, "connections.a.x", '"free" or a stiffness'),
        ({"connections": {"a": {"at": "12", "x": "1 N/um"}}}, "connections.a.at", 'a length with its unit, "85 mm"'),
        ({"connections": {"a": {"at": "8 kg", "x": "1 N/um"}}}, "connections.a.at", "kg is not a unit of length"),
        ({"markers": {"85mm": {"x": "85 mm"}}}, "markers.85mm", "looks like a length"),
    ],
)
def test_what_to_write_instead(changes: dict[str, Any], where: str, said: str) -> None:
    assert said in mistakes(tables(**changes))[where]


def test_loads_turn_a_body_that_is_free_to_spin() -> None:
    """Apply a torque to an outer ring that may turn.

    At a locked ring it is a mistake, as any load along a lock is.
    """
    case = api.case("6208-axial-1300")
    load = {"outer_ring": {"moment_x": "2 N m"}}
    free = check_bearing(case.with_(loads=load, bodies={"outer_ring": {"spin": "free"}}))
    assert initial(free.outer_ring.moment[0]) == pytest.approx(2.0)
    assert "a load acts along it" in mistakes(case.with_(loads=load))["bodies.outer_ring.spin"]


def test_a_draft_edits_short_forms() -> None:
    """Show and change stiffness and mode in both forms."""
    draft = draft_of(shaft_text("geared-shaft", "box"), None)
    support = ("bearings", "right", "support")
    assert draft.get(*support, "x", "mode") == "free"
    draft.set(*support, "y", value="200 N/um")
    assert draft.get(*support, "y", "stiffness") == "200 N/um"
    draft.set(*support, "y", "damping", value="10 N s/m")
    assert draft.get(*support, "y") == {"stiffness": "200 N/um", "damping": "10 N s/m"}
    draft.set(*support, "y", "damping", value=None)
    assert draft.get(*support, "y") == "200 N/um"
    assert not mistakes(draft.tables)
