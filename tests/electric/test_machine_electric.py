"""Test the command electric for a machine.

All bearings in one circuit, their own options, what it prints and writes.
"""

from __future__ import annotations

import csv
from pathlib import Path
from typing import TYPE_CHECKING

import pytest
from lambda_cli.main import main

from lambda_core import api
from lambda_core.domain.errors import CaseError, UsageError
from lambda_core.model.long_form import long_form

if TYPE_CHECKING:
    from lambda_core.analysis.electric.simulation import CircuitSimulation

MOTOR = Path(__file__).parents[2] / "examples" / "motor-circuit" / "motor.toml"
SHORT = ["electric.duration=4 ms"]


@pytest.fixture(scope="module")
def found() -> CircuitSimulation:
    simulation = api.electric(MOTOR, SHORT)
    assert hasattr(simulation, "bearings")
    return simulation


def test_both_bearings_stand_in_one_circuit(found: CircuitSimulation) -> None:
    """Compare the ratio with all capacitances by hand.

    The coated bearing shares its voltage with the coating.
    """
    near, far = found.bearings["drive_end"], found.bearings["other_end"]
    assert near.circuit is far.circuit
    assert not near.circuit.bearings[0].insulated
    assert far.circuit.bearings[1].coating == 1.5e-9
    bare = [c + around.rings for c, around in zip(near.capacitances, near.circuit.bearings, strict=True)]
    coated = bare[1] * 1.5e-9 / (bare[1] + 1.5e-9)
    ratio = 60e-12 / (60e-12 + 900e-12 + bare[0] + coated)
    assert near.outcome.bearing_voltage_ratio == pytest.approx(ratio, rel=1e-9)
    assert far.outcome.bearing_voltage_ratio == pytest.approx(ratio * 1.5e-9 / (bare[1] + 1.5e-9), rel=1e-9)
    assert near.contacts.load.shape[1] == 8
    assert near.contacts.time[1] != far.contacts.time[1]  # cages turn at speeds of their own


def test_outcome_of_the_shaft(found: CircuitSimulation) -> None:
    outcome = found.outcome
    assert outcome.discharges_per_s == outcome.bearings["drive_end"].discharges_per_s > 1000.0
    assert outcome.bearings["other_end"].discharges == 0
    assert outcome.shaft_voltage_V[1] <= outcome.bearings["drive_end"].bearing_voltage_V[1]
    assert abs(outcome.energy_residual) < 1e-9
    assert abs(outcome.charge_residual) < 1e-9
    text = outcome.text()
    assert "bearing other_end" in text
    assert "circulating currents" in text
    assert "the machine has one more bearing" not in text


def test_the_line_of_discharges_names_the_share_at_the_assumed_limit(found: CircuitSimulation) -> None:
    """Print the share at the assumed limit.

    Users read the rate alone as a forecast; it was printed as 4.759e+04.
    """
    lines = [line for line in found.outcome.text().splitlines() if line.startswith("discharges")]
    share = "% of the breakdowns at breakdown.least_voltage, an assumed lower limit"
    assert [share in line for line in lines] == [True, True, False]
    assert not any("e+" in line for line in lines)


def test_insulation_at_the_drive_end_moves_the_discharges() -> None:
    """Break films down at the end without a sleeve.

    The thin sleeve takes nearly all of the voltage at the drive end.
    """
    moved = api.electric(MOTOR, [*SHORT, "electric.bearings.drive_end.insulation=5 pF"]).outcome.bearings
    assert moved["drive_end"].discharges == 0
    assert moved["other_end"].discharges > 0


def test_command_and_files(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    assert main(["electric", str(MOTOR), "--duration", "2ms", "--out", str(tmp_path / "d.csv")]) == 0
    assert "bearing drive_end" in capsys.readouterr().out
    rows = list(csv.reader((tmp_path / "d.csv").open()))
    assert rows[0][:3] == ["bearing", "time [s]", "ball"]
    assert {row[0] for row in rows[1:]} == {"drive_end"}
    times = [float(row[1]) for row in rows[1:]]
    assert times == sorted(times)


@pytest.mark.parametrize(
    ("change", "where", "words"),
    [
        ("electric.bearings.other_nd.insulation=1 nF", "electric.bearings.other_nd", "nearest: other_end"),
        ("electric.grounding.insulation=1 nF", "electric", "in [electric.bearings.NAME]"),
        ("electric.bearings.drive_end.shunt=1 Ohm", "electric.bearings.drive_end", "`shunt` requires `insulation`"),
        ("electric.bearings.drive_end.film.seels=1 pF", "electric.bearings.drive_end.film.seels", "nearest: seals"),
        ("electric.breakdown.law=feild", "electric.breakdown.law", "nearest: field"),
    ],
)
def test_mistakes_are_named(change: str, where: str, words: str) -> None:
    with pytest.raises(CaseError) as caught:
        api.check(MOTOR, [change])
    (problem,) = caught.value.problems
    assert problem.where == where
    assert words in problem.message


def test_currents_of_a_case_at_rest_are_refused_for_its_speed_not_for_a_duration() -> None:
    with pytest.raises(UsageError, match="at rest no ball passes a point: give the bearing a speed"):
        api.electric("6208-axial-1300", ["operation.speed=0 rpm"])


def test_a_case_without_the_section_gets_defaults(tmp_path: Path) -> None:
    text = MOTOR.read_text()
    path = tmp_path / "plain.toml"
    path.write_text(text[: text.index("[electric]")])
    assert api.check(path).electric is None
    found = api.electric(path, ["electric.duration=1 ms"])
    assert list(found.bearings) == ["drive_end", "other_end"]


SOFT = ["solver.duration=0.012 s", "electric.seed=3"]


@pytest.fixture(scope="module")
def run(tmp_path_factory: pytest.TempPathFactory) -> api.Result:
    return api.run(MOTOR, SOFT, out=tmp_path_factory.mktemp("motor") / "motor.h5")


def test_circuit_during_a_run_of_a_machine(run: api.Result) -> None:
    """Compare the run's tables with those of the command.

    They agree bit by bit for each bearing.
    """
    found = api.electric(run.path)
    both = run.of_machine().circuit()
    assert both["bearing_voltage_least"].shape[1] == 2
    assert both["shaft_voltage_largest"].max() >= both["bearing_voltage_largest"][:, 0].max()
    counted = 0
    summary = run.summary()
    assert summary.bearings["drive_end"].currents.discharges_per_s > 0.0
    assert "discharges per second" in summary.text()
    for name, simulation in found.bearings.items():
        one = run.bearings[name]
        begin, written = simulation.time[0], one.discharges()
        events = simulation.events
        for column in ("time", "ball", "ring", "energy", "bearing_voltage"):
            late = written[column][written["time"] >= begin]
            assert late.tobytes() == getattr(events, column).astype(float).tobytes(), (name, column)
        inside = one.circuit()["time"] > begin
        least = one.circuit()["bearing_voltage_least"][inside]
        assert least.tobytes() == simulation.solution.extremes[:, 0].tobytes()
        counted += written["time"].size
    every = run.of_machine().discharges()
    assert counted == every["time"].size > 0
    assert (every["discharge"][1:] >= every["discharge"][:-1]).all()


def test_a_longer_run_goes_on_with_its_circuit(run: api.Result, tmp_path: Path) -> None:
    api.run(MOTOR, [*SOFT, "solver.duration=0.006 s"], out=tmp_path / "short.h5")
    longer = api.resume(tmp_path / "short.h5", ["solver.duration=0.012 s"])
    for one, other in (
        (longer.of_machine().circuit(), run.of_machine().circuit()),
        (longer.of_machine().discharges(), run.of_machine().discharges()),
    ):
        assert one.keys() == other.keys()
        for name, values in other.items():
            assert one[name].tobytes() == values.tobytes(), name


def test_a_run_of_one_bearing_on_a_shaft_keeps_its_coating(tmp_path: Path) -> None:
    coated = ["electric.grounding.insulation=1.5 nF", "solver.duration=12 ms"]
    machine = api.run(long_form("6208-axial-1300", coated).tables, out=tmp_path / "one.h5")
    circuit = api.electric(machine.path).circuit
    assert circuit.bearings[0].coating == 1.5e-9
    assert circuit.twins == 0.0


def test_currents_follow_computed_temperatures() -> None:
    warm, cold = (
        api.electric("6208-axial-1300", ["electric.duration=1 ms", *changes]).outcome
        for changes in (["operation.temperatures=computed"], [])
    )
    assert warm.bearing_capacitance_pF != pytest.approx(cold.bearing_capacitance_pF, rel=1e-3)


def test_an_endless_duration_is_refused_in_few_digits() -> None:
    with pytest.raises(UsageError, match=r"are [\d.e+]{1,12} positions of the balls, at most 500000: shorten duration"):
        api.electric(MOTOR, ["electric.duration=1e300 s"])
