"""Test the circuit in the library.

Voltages and discharges of the program, under a source that the host is.
"""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from lambda_core import api
from lambda_core.analysis.electric.circuit_bearing import circuit_bearings
from lambda_core.analysis.electric.contacts import CHANNELS, contacts_of_samples, films
from lambda_core.analysis.electric.simulation import network_of
from lambda_core.export.fmu.circuit_image import circuit
from lambda_core.solver.drivers.assembly import BearingSpan

CASE = "6208-axial-1300"
CHANGES = ("solver.duration=0.2 s", "electric.seed=3", "electric.grounding.insulation=2 nF")
STEP = 2e-5  # [s]
SOURCE = "electric.source_voltage"
Export = Callable[[int, str], Path]
ANSWERS = ["electric.voltage", "electric.voltage_lowest", "electric.voltage_highest", "electric.arc_peak"]


@pytest.fixture(scope="module")
def unit(host: Any, exported: Export, tmp_path_factory: pytest.TempPathFactory) -> Any:
    """Return the FMU of a bearing with a circuit."""
    return host.Unit(exported(3, "force"), tmp_path_factory.mktemp("circuit"))


def slopes(k: int) -> float:
    """Return the source's rate in steps [V/s].

    Up to 600 V and down again.
    """
    return 600.0 / (20 * STEP) * (1.0 if k % 40 < 20 else -1.0)


def of_the_program(steps: int) -> tuple[list[list[float]], Any]:
    """Return the program's voltages and currents.

    Largest currents step by step, and the events, of an integration through the same samples.
    """
    stepping = api.iterate(CASE, CHANGES, exact=True)
    bearing = circuit_bearings(stepping.model)[0]
    network = network_of([bearing], [stepping.model.geometry.balls])
    before, rolled, volts = stepping._engine.now(), None, 0.0
    found, events = [], []
    for k in range(steps):
        now = stepping.step_to((k + 1) * STEP).channels
        pair = {name: np.stack([before[name], now[name]]) for name in CHANNELS}
        parts = films(contacts_of_samples(pair, bearing.roughness, ""), bearing.options, rolled)
        after = volts + slopes(k) * (now["time"] - before["time"])
        solution = network.advance(parts, (parts.time, np.array([volts, after]))).of(0)
        peak = float(solution.events[:, 8].max(initial=0.0))
        potential = network.held()["nodes"].potential
        found.append([float(potential[0] - potential[1]), *solution.extremes[0].tolist(), peak])
        before, rolled, volts = now, parts.rolled[-1], after
        events.append(solution.events)
    return found, np.concatenate(events)


@pytest.mark.full
def test_voltages_and_discharges_are_those_of_the_program(host: Any, unit: Any) -> None:
    """Compare bit by bit on both slopes of the source.

    A saved and restored instance and another instance give the same bits.
    """
    steps = 80
    expected, events = of_the_program(steps)
    bearing, volts, state = host.Instance(unit).ready(), 0.0, b""
    found = []
    for k in range(steps):
        assert [bearing.set(SOURCE, volts), bearing.set(f"{SOURCE}_rate", slopes(k))] == [host.OK] * 2
        begin = bearing.get(["time"])[0]
        assert bearing.step((k + 1) * STEP - bearing.time) == host.OK
        found.append(bearing.get(ANSWERS))
        volts += slopes(k) * (bearing.get(["time"])[0] - begin)
        if k == 30:
            state, there = bearing.packed(), (bearing.time, volts)
    assert len(events) > 3
    assert found == expected
    count, energy = bearing.get(["electric.discharges", "electric.discharge_energy"])
    assert count == events[-1, 3] + 1.0
    assert energy == pytest.approx(events[:, 6].sum(), rel=1e-9)
    other = host.Instance(unit).ready()
    assert other.unpack(state, there[0]) == host.OK
    volts = there[1]
    for k in range(31, 36):
        other.set(SOURCE, volts), other.set(f"{SOURCE}_rate", slopes(k))
        begin = other.get(["time"])[0]
        other.step((k + 1) * STEP - other.time)
        assert other.get(ANSWERS) == found[k]
        volts += slopes(k) * (other.get(["time"])[0] - begin)


@pytest.mark.full
def test_an_edge_moves_the_rotor_at_once(host: Any, unit: Any) -> None:
    """Step the source by too little for a discharge.

    The bearing takes its share of the voltage, and the motion does not change.
    """
    bearing, still = host.Instance(unit).ready(), host.Instance(unit).ready()
    assert [each.step(STEP) for each in (bearing, still)] == [host.OK] * 2
    assert bearing.set(SOURCE, 1.0) == host.OK
    assert [each.step(STEP) for each in (bearing, still)] == [host.OK] * 2
    (voltage, current, x), (none, _, same) = (
        each.get(["electric.voltage", "electric.source_current", "inner_ring.x"]) for each in (bearing, still)
    )
    assert none == 0.0
    assert 0.0 < voltage < 0.5
    assert x == same
    assert current > 0.0
    assert bearing.slope("electric.voltage", SOURCE) == 0.0  # what a step has done does not change any more


@pytest.mark.full
def test_a_case_without_a_circuit_has_no_source(
    host: Any, exported: Callable[[int, str], Path], tmp_path: Path
) -> None:
    unit = host.Unit(exported(2, "force"), tmp_path)
    assert not [name for name in unit.references if name.startswith("electric.")]


@pytest.mark.parametrize(("bearing", "what"), [("SKF NU 208 ECP", "rollers"), ("QJ208", "four-point contacts")])
def test_circuits_that_are_not_exported(bearing: str, what: str, tmp_path: Path) -> None:
    case = api.init_case("other", bearing=bearing, path=tmp_path / "other.toml")
    model = api.check(case, ("electric.seed=3", "solver.duration=1 ms"))
    assert isinstance(model, api.BearingModel)
    raceways = 2 if what == "rollers" else 4
    spans = [BearingSpan((0, 1, 2), 0, 0, 0, model.geometry.balls, 0, 0, 0, 0)]
    with pytest.raises(api.UsageError, match=f"the circuit of {what} is not exported"):
        circuit(model, spans, raceways * model.geometry.balls)
