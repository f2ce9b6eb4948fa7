"""The case of one bearing in the long form, against itself: 200 random cases."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from lambda_core import api
from lambda_core.case.case_io import load_case
from lambda_core.model.bodies.resolve_bodies import body_loads
from lambda_core.model.checking import check_bearing
from lambda_core.model.laws.time_functions import initial

CASES = Path(__file__).parents[2] / "benchmarks" / "case_tables.jsonl"
# Fields of a resolved bearing that have nothing to do with how it is held, loaded and observed
SAME = (
    "geometry", "ball_material", "inner_material", "outer_material", "cage_material", "oil", "oil_level", "roughness",
    "starvation", "gravity", "cage", "depth", "mounting", "elastic",
)  # fmt: skip
CONTACTS = ("ball_inner", "ball_outer", "ball_cage", "ball_ball", "cage_inner", "cage_outer", "fluid_drag")

STRAIGHT = ["loads.radial=2 kN", "bodies.inner_ring.tilt_y=locked", "bodies.inner_ring.tilt_z=locked"]


def cases() -> list[dict[str, Any]]:
    """Return the random cases."""
    return [json.loads(line) for line in CASES.read_text(encoding="utf-8").splitlines()]


@pytest.mark.parametrize("part", range(4))
def test_a_random_bearing_is_the_same_in_a_machine(part: int) -> None:
    """Everything of the bearing itself, to the last digit, and the loads on its inner ring."""
    with_catalogue = api.catalogue()
    for tables in cases()[part::4]:
        case, single = load_case(tables), check_bearing(tables, catalogue=with_catalogue)
        machine = api.check(api.long_form(tables).tables, catalogue=with_catalogue)
        assert isinstance(machine, api.MachineModel)
        (bearing,) = machine.bearings
        for name in SAME:
            assert repr(getattr(bearing.model, name)) == repr(getattr(single, name)), (tables["name"], name)
        for element in CONTACTS:
            assert repr(bearing.model.laws.get(element)) == repr(single.laws.get(element)), (tables["name"], element)
        force, moment = body_loads("inner_ring", case)
        rows = machine.body.rows(bearing.position)
        acting = [initial(f) for f in (*force, *moment[1:])]
        expected = [machine.loads[rows][i] for i in (0, 1, 2, 4, 5)]
        assert expected == pytest.approx(acting, abs=1e-9 * max(map(abs, acting), default=0.0) + 1e-12)
    with_catalogue.close()


def test_the_equilibrium_is_that_of_the_bearing() -> None:
    """Under a radial and an axial load without tilt, but for friction, which a machine neglects in its equilibrium."""
    changes = ["loads.radial=2 kN", "loads.axial=500 N", "bodies.inner_ring.tilt_y=locked", "gravity.z=0 m/s2"]
    changes += ["bodies.inner_ring.tilt_z=locked"]
    single = api.quasistatic("6208-axial-1300", changes)
    long = api.long_form("6208-axial-1300", changes)
    (bearing,) = api.quasistatic(long.tables).bearings
    assert long.differences == ()
    assert bearing.force_N[0] == pytest.approx(-500.0, rel=1e-6)
    assert bearing.max_load_N == pytest.approx(single.max_load_N, rel=5e-3)
    assert bearing.friction_torque_Nmm == pytest.approx(single.friction_torque_Nmm, rel=1e-2)


def test_what_a_machine_does_not_have_is_said() -> None:
    case = api.case("6208-axial-1300").with_(
        markers={"pin": {"body": "inner_ring", "z": "10 mm"}},
        elements={"spring": {"second": "pin", "parameters": {"stiffness_z": "1 N/um"}}},
        operation={"temperatures": "computed"},
    )
    long = api.long_form(case)
    told = {difference.partition(":")[0] for difference in long.differences}
    assert told == {"operation.temperatures", "elements.spring"}
    assert isinstance(api.check(long.tables), api.MachineModel)


def test_rings_and_cage_carry_loads_markers_and_connections() -> None:
    case = api.case("6208-axial-1300").with_(
        bodies={"outer_ring": {"y": "free", "z": "free"}},
        markers={"rim": {"body": "outer_ring", "z": "40 mm"}, "journal": {"body": "inner_ring", "x": "2 mm"}},
        loads={"cage": {"force_z": "1 N"}, "outer_ring": {"force_y": "20 N"}},
        elements={
            "seat": {"second": "outer_ring", "parameters": {"stiffness_y": "50 N/um", "stiffness_z": "50 N/um"}},
            "band": {"first": "cage", "second": "outer_ring", "parameters": {"stiffness_z": "1 N/mm"}},
        },
    )
    long = api.long_form(case)
    assert long.differences == ()
    machine = api.check(long.tables)
    assert isinstance(machine, api.MachineModel)
    loads = {part.part: [initial(f) for f in load] for part, load in machine.part_loads.items()}
    assert loads == {"cage": [0.0, 0.0, 1.0, 0.0, 0.0, 0.0], "outer_ring": [0.0, 20.0, 0.0, 0.0, 0.0, 0.0]}
    (rim,) = (place for name, place in machine.markers if name == "rim")
    assert rim.body == ("bearing", "outer_ring")
    assert [(link.name, link.first.body, link.second.body) for link in machine.links] == [
        ("seat", -1, ("bearing", "outer_ring")), ("band", ("bearing", "cage"), ("bearing", "outer_ring")),
    ]  # fmt: skip


@pytest.mark.parametrize(
    ("name", "changes"),
    [
        ("the outer ring turns", ["operation.speed=0 rpm", 'bodies.outer_ring.spin={motion="1500 rpm"}']),
        (
            "it turns to and fro",
            ['bodies.outer_ring.spin={motion={kind="harmonic", amplitude="50 rpm", frequency="100 Hz"}}'],
        ),
        ("a heavy, unbalanced ring", ["bodies.inner_ring.mass=1 kg", "bodies.inner_ring.unbalance=20 g mm"]),
        (
            "a loaded ring on springs",
            [
                "bodies.outer_ring.y=free",
                "bodies.outer_ring.z=free",
                "loads.outer_ring.force_z=-300 N",
                "elements.seat.second=outer_ring",
                "elements.seat.parameters.stiffness_y=50 N/um",
                "elements.seat.parameters.stiffness_z=50 N/um",
                "elements.seat.parameters.damping_y=2 N s/mm",
                "elements.seat.parameters.damping_z=2 N s/mm",
            ],
        ),
        (
            "a dragged cage",
            [
                "loads.cage.force_y=2 N",
                "elements.drag.first=outer_ring",
                "elements.drag.second=cage",
                "elements.drag.parameters.stiffness_x=1 N/mm",
            ],
        ),
        ("a cage on a mandrel", ["bodies.cage.x=locked", 'bodies.cage.y={motion="0.02 mm"}', "bodies.cage.mass=80 g"]),
    ],
)
def test_rings_and_cage_move_as_in_the_bearing_alone(name: str, changes: list[str], tmp_path: Path) -> None:
    """The machine's rigid shaft has a mass and an elasticity of its own: torques agree to 1e-4, not bit for bit."""
    changes = [*STRAIGHT, "solver.duration=40 ms", *changes]
    long = api.long_form("6208-axial-1300", changes)
    assert long.differences == ()
    single = api.run("6208-axial-1300", changes, out=tmp_path / "single.h5")
    machine = api.run(long.tables, out=tmp_path / "machine.h5")
    alone, among = single.summary(), machine.summary().bearings["bearing"]
    assert among.friction_torque_Nmm == pytest.approx(alone.friction_torque_Nmm, rel=1e-4)
    assert among.power_loss_W == pytest.approx(alone.power_loss_W, rel=1e-4)
    assert among.cage_speed_ratio == pytest.approx(alone.cage_speed_ratio, rel=1e-4)
    assert abs(machine.summary().energy_residual) < 1e-3


def test_a_mistake_about_a_ring_is_shown_where_it_stands_in_the_machine() -> None:
    tables = dict(api.long_form("6208-axial-1300").tables)
    tables["bearings"] = {"bearing": {**tables["bearings"]["bearing"], "outer_ring": {"mass": "-1 kg"}}}
    with pytest.raises(api.CaseError, match=r"bearings\.bearing\.outer_ring\.mass"):
        api.check(tables)
