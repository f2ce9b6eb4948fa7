"""Test the case of one bearing written as a machine."""

from __future__ import annotations

import json
import tomllib
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from lambda_core import api
from lambda_core.analysis.thermal.temperature_text import ways
from lambda_core.catalogue.protocol import Catalogue
from lambda_core.model.checking import check_bearing
from lambda_core.model.laws.time_functions import initial
from lambda_core.solver.drivers.assembly import assembly_of
from lambda_core.solver.drivers.compiled_laws import Kernels, derive_oils
from lambda_core.solver.drivers.first_state import first_frame
from lambda_core.solver.drivers.lumps import lump
from lambda_core.solver.drivers.machine_assembly import machine_assembly
from lambda_core.solver.drivers.tables import build

CASES = Path(__file__).parents[2] / "benchmarks" / "case_tables.jsonl"
STRAIGHT = ["loads.radial=2 kN", "bodies.inner_ring.tilt_y=locked", "bodies.inner_ring.tilt_z=locked"]
OF_THE_MACHINE = {"input_power", "input_torque", "stored_energy"}  # channels of a bearing that stand for its machine


def cases() -> list[dict[str, Any]]:
    """Return the random cases."""
    return [json.loads(line) for line in CASES.read_text(encoding="utf-8").splitlines()]


def test_a_random_bearing_has_the_tables_of_its_machine() -> None:
    """Compare tables for every sixteenth of 200 cases.

    The full suite tests half of the others, the slow one all.
    """
    _compare_tables(cases()[::16])


@pytest.mark.parametrize(
    "part", [pytest.param(part, marks=pytest.mark.full if part < 4 else pytest.mark.slow) for part in range(1, 8)]
)
def test_every_random_bearing_has_the_tables_of_its_machine(part: int) -> None:
    _compare_tables(cases()[part::8] + (cases()[8::16] if part == 1 else []))


def _compare_tables(chosen: list[dict[str, Any]]) -> None:
    """Compare the compiled tables byte by byte."""
    with_catalogue = api.catalogue()
    for tables in chosen:
        alone, long = _tables(tables, with_catalogue)
        for name in alone._fields:
            if name != "laws":  # addresses of this process
                assert getattr(alone, name).tobytes() == getattr(long, name).tobytes(), (tables["name"], name)
    with_catalogue.close()


def _tables(tables: dict[str, Any], with_catalogue: Catalogue) -> tuple[Any, Any]:
    """Return the tables of bearing and machine.

    The bearing is alone.
    """
    single = check_bearing(tables, catalogue=with_catalogue)
    machine = api.check(api.long_form(tables).tables, catalogue=with_catalogue)
    assert isinstance(machine, api.MachineModel)
    kernels, frame = Kernels(single), first_frame(single)
    oils = derive_oils(single, kernels, frame)
    among = Kernels(machine.bearings[0].model)
    return (
        build(assembly_of(single, kernels, frame, oils)),
        build(machine_assembly(machine, lump(machine), [(among, frame, oils)])),
    )


def test_the_equilibrium_is_that_of_the_bearing() -> None:
    """Include the friction of the balls.

    The pose of the shaft is that without friction.
    """
    changes = [*STRAIGHT, "gravity.z=0 m/s2"]
    single = api.quasistatic("6208-axial-1300", changes)
    long = api.long_form("6208-axial-1300", changes)
    assert long.differences == ()
    (among,) = api.quasistatic(long.tables).bearings.values()
    assert among.max_load_N == single.max_load_N
    assert among.friction_torque_Nmm == single.friction_torque_Nmm
    assert among.max_pressure_GPa == single.max_pressure_GPa


def test_rollers_move_as_in_the_bearing_bit_by_bit(tmp_path: Path) -> None:
    source, changes = api.init_case("nu", bearing="SKF NU 208 ECP", path=tmp_path / "nu.toml"), ["solver.duration=2 ms"]
    long = api.long_form(source, changes)
    assert long.differences == ()
    single = api.run(source, changes, out=tmp_path / "single.h5")
    machine = api.run(long.tables, out=tmp_path / "machine.h5")
    for channel in ("load", "ball_spin", "body_position", "pocket_force"):
        assert np.array_equal(single[channel], machine.of_bearing()[channel], equal_nan=True), channel


def test_a_new_case_of_one_bearing_can_be_written_as_a_machine(tmp_path: Path) -> None:
    given: dict[str, Any] = {"bearing": "SKF 6208", "changes": ["loads.radial=2 kN"]}
    single = api.init_case("one", path=tmp_path / "one.toml", **given)
    machine = api.init_case("one", path=tmp_path / "machine.toml", as_machine=True, **given)
    assert tomllib.loads(machine.read_text(encoding="utf-8")) == api.long_form(single).tables
    from_file = api.init_case("one", str(single), tmp_path / "again.toml", as_machine=True)
    assert from_file.read_text(encoding="utf-8") == machine.read_text(encoding="utf-8")
    for start in ({"start": str(machine)}, {"template": "geared-shaft"}):
        with pytest.raises(api.UsageError, match="a machine already"):
            api.init_case("two", path=tmp_path / "two.toml", as_machine=True, **start)


def test_a_gear_in_the_case_of_one_bearing_names_the_way_to_a_machine() -> None:
    tables = api.case("6208-axial-1300").written() | {"gears": {"wheel": {"at": "bearing"}}}
    with pytest.raises(api.CaseError) as refused:
        api.check(tables)
    (problem,) = refused.value.problems
    assert problem.where == "gears"
    assert "--as-machine" in problem.message


def test_what_a_machine_does_not_have_is_said() -> None:
    long = api.long_form(api.case("6208-axial-1300").with_(electric={"step": {"amplitude": "5 V"}}))
    assert [one.partition(":")[0] for one in long.differences] == ["electric.machine.other_bearings"]
    assert isinstance(api.check(long.tables), api.MachineModel)


def test_a_program_reads_both_forms_alike(tmp_path: Path) -> None:
    """Find each number of a bearing at the same place.

    The bearing is alone, or in a machine.
    """
    long = api.long_form("6208-axial-1300", STRAIGHT).tables
    file = api.init_case("long", "6208-axial-1300", tmp_path / "long.toml", as_machine=True)
    circuit = ["electric.duration=1 ms"]
    cycle = {"name": "day", "phases": [{"name": "all day", "time": "8 h"}]}
    pairs = (
        (api.quasistatic("6208-axial-1300", STRAIGHT), api.quasistatic(long)),
        (api.electric("6208-axial-1300", circuit).outcome, api.electric(long, circuit).outcome),
        (api.duty(cycle | {"case": "6208-axial-1300"}), api.duty(cycle | {"case": str(file)})),
    )
    for alone, among in ((one.to_dict(), other.to_dict()) for one, other in pairs):
        assert alone["bearings"].keys() == among["bearings"].keys()
        (one,), (other,) = alone["bearings"].values(), among["bearings"].values()
        of_a_ring_alone = {"inner_ring_displacement_um", "inner_ring_tilt_mrad", "axial_play_um"}
        assert one.keys() - of_a_ring_alone <= other.keys()
        assert alone.keys() - {"headline"} <= among.keys()


def test_modes_are_those_of_ring_and_shaft_on_the_bearing() -> None:
    """Compare with a mass on springs.

    (2 pi f)^2 are the eigenvalues of K/m; x, y and z are free. The locked tilts, held by stiff springs in the
    equilibrium, had modes of their own.
    """
    changes = [*STRAIGHT, "bodies.inner_ring.shaft_mass=20 kg"]
    found = api.modes("6208-axial-1300", changes)
    model = api.check("6208-axial-1300", changes)
    (one,) = found.bearings.values()
    ring = model.bearing_models[""].inner_ring
    expected = np.sqrt(np.linalg.eigvalsh(np.array(one.stiffness)[:3, :3] / ring.mass)) / (2.0 * np.pi)
    assert [mode.frequency_Hz for mode in found.modes] == pytest.approx(expected, rel=1e-3)
    assert {mode.kind for mode in found.modes} == {"axial", "lateral"}
    assert api.modes(model) == found


THERMAL = [
    "thermal.nodes.housing.heat=20 W",
    "thermal.nodes.outer_ring.start=30 degC",
    'thermal.links.wall.between=["housing", "ambient"]',
    "thermal.links.wall.conductance=2 W/K",
    "thermal.oil_flow=0.1 l/min",
]


def _labels(text: str) -> list[str]:
    """Return the first words of the rows of tables."""
    return [line[:30].strip() for line in text.splitlines() if line.startswith("  ") and "->" not in line[:30]]


@pytest.mark.parametrize("changes", [[], THERMAL, ["thermal.conductances=iso-15312"]])
def test_temperatures_are_those_of_the_bearing(changes: list[str]) -> None:
    alone = api.thermal("6208-axial-1300", changes)
    long = api.long_form("6208-axial-1300", changes)
    assert long.differences == ()
    among = api.thermal(long.tables)
    for node, temperature in alone.temperatures_degC.items():
        name = node if node in ("housing", "ambient") else f"bearing.{node}"
        assert among.temperatures_degC[name] == pytest.approx(temperature, abs=1e-3), node
    (one,), (other,) = alone.bearings.values(), among.bearings.values()
    assert other.nodes == {part: f"bearing.{node}" for part, node in one.nodes.items()}
    way, same = [{frozenset((w.source, w.target)): w.heat for w in ways(found)} for found in (alone, among)]
    assert same == pytest.approx(way, abs=0.01)
    assert _labels(among.text()) == _labels(alone.text())


def test_the_circuit_is_that_of_the_bearing() -> None:
    changes = [
        "electric.step.amplitude=5 V",
        "electric.machine.other_bearings=100 pF",
        "electric.grounding.insulation=4 nF",
        "electric.duration=1 ms",
    ]
    long = api.long_form("6208-axial-1300", changes)
    assert long.differences == ()
    assert long.tables["electric"]["bearings"] == {"bearing": {"insulation": "4 nF"}}
    alone, among = api.electric("6208-axial-1300", changes), api.electric(long.tables)
    assert among.outcome.bearing_voltage_ratio == pytest.approx(alone.outcome.bearing_voltage_ratio, rel=1e-2)


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
        pytest.param(
            "the outer ring turns",
            ["operation.speed=0 rpm", 'bodies.outer_ring.spin={motion="1500 rpm"}'],
            marks=pytest.mark.full,
        ),
        pytest.param(
            "it turns to and fro",
            ['bodies.outer_ring.spin={motion={kind="harmonic", amplitude="50 rpm", frequency="100 Hz"}}'],
            marks=pytest.mark.full,
        ),
        pytest.param(
            "a heavy, unbalanced ring",
            ["bodies.inner_ring.mass=1 kg", "bodies.inner_ring.unbalance=20 g mm"],
            marks=pytest.mark.full,
        ),
        (
            "a loaded ring on springs, and a spring at a pin that turns with the other ring",
            [
                "bodies.outer_ring.y=free",
                "bodies.outer_ring.z=free",
                "loads.outer_ring.force_z=-300 N",
                "elements.seat.second=outer_ring",
                "elements.seat.parameters.stiffness_y=50 N/um",
                "elements.seat.parameters.stiffness_z=50 N/um",
                "elements.seat.parameters.damping_y=2 N s/mm",
                "elements.seat.parameters.damping_z=2 N s/mm",
                "markers.pin.body=inner_ring",
                "markers.pin.z=10 mm",
                "markers.pin.x=2 mm",
                "elements.spring.second=pin",
                "elements.spring.parameters.stiffness_z=20 N/mm",
                "bodies.inner_ring.unbalance=2 g mm",
            ],
        ),
        pytest.param(
            "a dragged cage",
            [
                "loads.cage.force_y=2 N",
                "elements.drag.first=outer_ring",
                "elements.drag.second=cage",
                "elements.drag.parameters.stiffness_x=1 N/mm",
            ],
            marks=pytest.mark.full,
        ),
        ("a cage on a mandrel", ["bodies.cage.x=locked", 'bodies.cage.y={motion="0.02 mm"}', "bodies.cage.mass=80 g"]),
    ],
)
def test_the_motion_is_that_of_the_bearing_bit_by_bit(name: str, changes: list[str], tmp_path: Path) -> None:
    changes = [*STRAIGHT, "solver.duration=3 ms", *changes]
    long = api.long_form("6208-axial-1300", changes)
    assert long.differences == ()
    single = api.run("6208-axial-1300", changes, out=tmp_path / "single.h5")
    machine = api.run(long.tables, out=tmp_path / "machine.h5")
    alone, among = single.of_bearing(), machine.of_bearing()
    names = {channel.name for channel in among.channels} - OF_THE_MACHINE
    assert {"load", "ball_spin", "body_position", "pocket_force", "max_pressure"} < names
    for channel in names:
        assert np.array_equal(alone[channel], among[channel], equal_nan=True), channel
    summary = machine.summary()
    assert summary.bearings["bearing"].friction_torque_Nmm == single.summary().friction_torque_Nmm
    assert abs(summary.energy_residual) < 1e-3


def test_a_brake_of_the_shaft_is_no_friction_of_its_bearing(tmp_path: Path) -> None:
    """Drive the shaft against a resistance that grows with speed."""
    changes = [*STRAIGHT, "operation.torque=0.5 N m", 'bodies.inner_ring.spin={damping="0.002 N m s/rad"}']
    changes.append("solver.duration=10 ms")
    long = api.long_form("6208-axial-1300", changes)
    assert long.differences == ()
    assert long.tables["shaft"]["support"]["spin"] == {"damping": "0.002 N m s/rad"}
    single = api.run("6208-axial-1300", changes, out=tmp_path / "single.h5")
    machine = api.run(long.tables, out=tmp_path / "machine.h5")
    assert np.array_equal(single["body_spin"], machine.of_bearing()["body_spin"])
    summary = machine.summary()
    assert summary.energy_residual == pytest.approx(single.summary().energy_residual, rel=1e-6)
    found = summary.bearings["bearing"].friction_torque_Nmm
    assert found is not None
    assert 200.0 < found < 300.0


def test_a_mistake_about_a_ring_is_shown_where_it_stands_in_the_machine() -> None:
    tables = dict(api.long_form("6208-axial-1300").tables)
    tables["bearings"] = {"bearing": {**tables["bearings"]["bearing"], "outer_ring": {"mass": "-1 kg"}}}
    with pytest.raises(api.CaseError, match=r"bearings\.bearing\.outer_ring\.mass"):
        api.check(tables)
