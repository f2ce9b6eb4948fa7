"""Test the FMU of a shaft in two bearings.

The bits of its engine, what it takes, and what it refuses.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from lambda_core import api
from lambda_core.analysis.electric.circuit_bearing import circuit_bearings
from lambda_core.analysis.electric.circuit_integrator import joined
from lambda_core.analysis.electric.contacts import CHANNELS, contacts_of_samples, films
from lambda_core.analysis.electric.simulation import network_of
from lambda_core.domain.errors import UsageError

CHANGES = ("solver.duration=0.1 s",)  # of the FMU, too
STEP = 1e-4  # [s]


def seen(step: Any) -> dict[str, float]:
    """Return the FMU's outputs after a step.

    The step is one of the program.
    """
    found = {}
    for name, channels in step.bearings.items():
        films, bearing = channels["film_minimum"], f"bearings.{name}"
        found |= {
            f"{bearing}.load": channels["load"].max(),
            f"{bearing}.film_minimum": films[films > 0.0].min(),
            f"{bearing}.capacitance": channels["bearing_capacitance"],
            f"{bearing}.inner_ring.z": channels["body_position"][0, 2],
            f"{bearing}.inner_ring.tilt_y": channels["body_tilt"][0, 0],
            f"{bearing}.cage.spin": channels["body_spin"][2],
            f"{bearing}.reaction_force_z": step.reactions[name][2],
            f"{bearing}.reaction_moment_y": step.reactions[name][4],
        }
    return found | {"bearings.right.outer_ring.x": step.bearings["right"]["body_position"][1, 0]}


@pytest.mark.full
def test_a_machine_has_the_bits_of_its_engine(host: Any, machine_unit: Any, shaft: Path) -> None:
    """Push the gear, then run the shaft up."""
    instance, engine = host.Instance(machine_unit).ready(), api.iterate(shaft, CHANGES, exact=True)
    pushed = ("gears.wheel.force_z", "gears.wheel.moment_y", "shaft.spin")
    assert set(pushed) < set(engine.given)
    for k in range(24):
        if k == 8:
            for name, value in (("gears.wheel.force_z", -500.0), ("gears.wheel.moment_y", 3.0)):
                assert instance.set(name, value) == host.OK
                engine.give(name, value)
        if k == 16:
            assert [instance.set("shaft.spin", 320.0), instance.set("shaft.spin_rate", 50.0)] == [host.OK] * 2
            engine.give("shaft.spin", 320.0, 50.0)
        assert instance.step(STEP) == host.OK, instance.said
        step = engine.step_to(instance.time)
        expected = seen(step)
        assert dict(zip(expected, instance.get(list(expected)), strict=True)) == expected, f"step {k}"
    torque, loss, left, right = instance.get(
        ["machine.friction_torque", "machine.loss", "bearings.left.loss", "bearings.right.loss"]
    )
    assert torque == pytest.approx(1e-3 * step.friction_torque_Nmm, rel=1e-12)
    assert loss == pytest.approx(left + right, rel=1e-12)
    assert left == pytest.approx(float(step.bearings["left"]["loss"].sum()), rel=1e-12)
    (place,) = instance.get(["gears.wheel.z"])
    lumps = step.channels["shaft_position"][:, 2]
    assert lumps.min() <= place <= lumps.max()


CIRCUIT = ("electric.seed=3", "electric.bearings.right.insulation=2 nF")  # of the FMU
SLOPE = 600.0 / (20 * 2e-5)  # of the source [V/s]


def circuit_of_the_program(shaft: Path, steps: int, step: float) -> tuple[list[list[float]], int]:
    """Return the program's circuit of both bearings.

    Voltages and largest currents step by step, and the count of events.
    """
    stepping = api.iterate(shaft, (*CHANGES, *CIRCUIT), exact=True)
    assert isinstance(stepping.model, api.MachineModel)
    bearings = circuit_bearings(stepping.model)
    network = network_of(bearings, [one.model.geometry.balls for one in stepping.model.bearings])
    before, volts, rolled = stepping._engine.now().bearings, 0.0, [None, None]
    found, events = [], 0
    for k in range(steps):
        now = list(stepping.step_to((k + 1) * step).bearings.values())
        parts = []
        for i, one in enumerate(bearings):
            pair = {name: np.stack([before[i][name], now[i][name]]) for name in CHANNELS}
            parts.append(films(contacts_of_samples(pair, one.roughness, ""), one.options, rolled[i]))
        after = volts + SLOPE * (now[0]["time"] - before[0]["time"])
        solution = network.advance(joined(parts), (parts[0].time, np.array([volts, after])))
        potential = network.held()["nodes"].potential
        across = [potential[0], potential[0] - potential[1]]  # the right bearing is insulated
        each = [solution.of(i) for i in range(2)]
        found.append([])
        for voltage, own in zip(across, each, strict=True):
            found[-1] += [float(voltage), *own.extremes[0].tolist(), float(own.events[:, 8].max(initial=0.0))]
        found[-1].append(float(potential[0]))
        before, volts, rolled = now, after, [part.rolled[-1] for part in parts]
        events += len(solution.events)
    return found, events


@pytest.mark.full
def test_the_circuit_of_a_machine_is_that_of_the_program(host: Any, machine_unit: Any, shaft: Path) -> None:
    """Compare both bearings' circuit while the source rises.

    It rises to 480 V; the bits are equal.
    """
    steps, step, source = 16, 2e-5, "electric.source_voltage"
    expected, events = circuit_of_the_program(shaft, steps, step)
    instance, volts, found = host.Instance(machine_unit).ready(), 0.0, []
    names = [
        f"bearings.{name}.{what}"
        for name in ("left", "right")
        for what in ("voltage", "voltage_lowest", "voltage_highest", "arc_peak")
    ]
    for k in range(steps):
        assert [instance.set(source, volts), instance.set(f"{source}_rate", SLOPE)] == [host.OK] * 2
        begin = instance.time
        assert instance.step((k + 1) * step - instance.time) == host.OK, instance.said
        found.append(instance.get([*names, "electric.shaft_voltage"]))
        volts += SLOPE * (instance.time - begin)
    assert events > 0
    assert found == expected
    assert instance.get(["electric.discharges"])[0] > 0.0


@pytest.mark.full
def test_states_of_a_machine_and_its_inputs(host: Any, machine_unit: Any, shaft: Path) -> None:
    """Restore a state in the FMU and the program.

    Both give the same bits with the inputs of that time.
    """
    instance, outputs = host.Instance(machine_unit).ready(), machine_unit.named("output")
    assert [instance.set("gears.wheel.force_y", 200.0), instance.step(STEP)] == [host.OK] * 2
    kept, begin = instance.packed(), instance.time
    assert [instance.set("gears.wheel.force_y", -200.0), instance.step(STEP)] == [host.OK] * 2
    other = host.Instance(machine_unit).ready()
    assert other.unpack(kept, begin) == host.OK
    assert other.get(["gears.wheel.force_y"]) == [200.0]
    assert [other.set("gears.wheel.force_y", -200.0), other.step(STEP)] == [host.OK] * 2
    assert other.get(outputs) == instance.get(outputs)
    engine = api.iterate(shaft, CHANGES, exact=True)
    engine.give("gears.wheel.force_y", 200.0)
    engine.step_to(STEP)
    state = engine.state()
    engine.give("gears.wheel.force_y", -200.0)
    first = seen(engine.step_to(2 * STEP))
    engine.restore(state)
    engine.give("gears.wheel.force_y", -200.0)
    assert seen(engine.step_to(2 * STEP)) == first


@pytest.mark.full
def test_warm_oil_is_that_of_a_case_with_warm_oil(host: Any, machine_unit: Any, shaft: Path) -> None:
    instance = host.Instance(machine_unit).ready()
    engine = api.iterate(shaft, (*CHANGES, "lubricant.temperature=76 degC"), exact=True)
    assert instance.set("lubricant.temperature", 349.15) == host.OK
    for _ in range(20):
        assert instance.step(STEP) == host.OK
        expected = seen(engine.step_to(instance.time))
    name = "bearings.left.film_minimum"
    assert instance.get([name])[0] == pytest.approx(expected[name], rel=5e-3)  # the start is that of 70 degC


@pytest.mark.full
def test_what_a_machine_tells_and_refuses(host: Any, machine_unit: Any, shaft: Path) -> None:
    early = host.Instance(machine_unit)
    assert early.set("gears.wheel.force_z", -100.0) == host.OK
    early.ready()
    assert "the start is the equilibrium of the case" in early.said[-1]
    assert early.set("gears.wheel.force_x", 1e300) == host.OK
    assert early.step(STEP) == host.ERROR
    with pytest.raises(UsageError, match="couple by force, or export one of its bearings alone"):
        api.iterate(shaft, CHANGES, couple="motion")
    with pytest.raises(UsageError, match="give a load by its name, gears"):
        api.iterate(shaft, CHANGES).push((1.0, 0.0, 0.0))


MOVED = pytest.mark.parametrize(("case", "changes"), [
    ("machine", ()),
    ("6208-axial-700", ("elements.bush.law=bushing", "elements.bush.second=inner_ring")),
])  # fmt: skip


@MOVED
def test_steps_by_motion_are_refused_before_temperatures(case: str, changes: tuple[str, ...], shaft: Path) -> None:
    said: list[str] = []
    with pytest.raises(UsageError, match="couple by force"):
        api.iterate(
            shaft if case == "machine" else case, (*changes, "operation.temperatures=computed"), couple="motion",
            announce=said.append,
        )  # fmt: skip
    assert not said


@MOVED
def test_an_export_by_motion_is_refused_before_it_begins(
    case: str, changes: tuple[str, ...], shaft: Path, tmp_path: Path
) -> None:
    said: list[str] = []
    source = shaft if case == "machine" else case
    with pytest.raises(UsageError, match="couple by force"):
        api.export_fmu(source, changes, out=tmp_path / "a.fmu", couple="motion", announce=said.append)
    assert not said


@pytest.mark.full
def test_slopes_of_a_machine_are_those_of_differences(host: Any, machine_unit: Any) -> None:
    """Compare slopes with differences while the shaft speeds up.

    States stand at a communication point: a speed changes films and losses there, a load changes nothing.
    """
    instance = host.Instance(machine_unit).ready()
    assert [instance.set("shaft.spin", 310.0), instance.set("shaft.spin_rate", 50.0)] == [host.OK] * 2
    assert [instance.step(STEP) for _ in range(3)] == [host.OK] * 3
    before = instance.get(machine_unit.named("output"))
    seen = ["machine.loss", "bearings.left.loss", "bearings.right.film_minimum"]
    found = [instance.slope(name, "shaft.spin") for name in seen]
    temperature = instance.slope("machine.loss", "lubricant.temperature")
    assert instance.slope("machine.loss", "gears.wheel.force_z") == 0.0
    assert instance.slope("machine.loss", "shaft.spin_rate") == 0.0
    assert instance.get(machine_unit.named("output")) == before
    speed, by, sides = 310.0 + 50.0 * instance.time, 1e-3, []
    assert instance.set("shaft.spin_rate", 50.0) == host.OK
    for side in (1.0, -1.0):
        assert instance.set("shaft.spin", speed + side * by) == host.OK
        sides.append(np.array(instance.get(seen)))
    expected = (sides[0] - sides[1]) / (2.0 * by)
    assert np.all(np.abs(expected) > 0.0)
    assert found == pytest.approx(expected.tolist(), rel=1e-3)
    assert temperature < 0.0  # a warmer oil loses less
