"""Test the circuit of a run during its motion."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import pytest

from lambda_core import api
from lambda_core.analysis.electric.contacts import CHANNELS
from lambda_core.analysis.electric.live import Live
from lambda_core.domain.errors import UsageError

if TYPE_CHECKING:
    from pathlib import Path

    from lambda_core.results.reader import Result

CASE = "6208-axial-1300"
CHANGES = ["loads.axial=0 N", "loads.radial=2 kN", "electric.seed=3"]


@pytest.fixture(scope="module")
def run(tmp_path_factory: pytest.TempPathFactory) -> Result:
    path = tmp_path_factory.mktemp("live") / "run.h5"
    return api.run(CASE, [*CHANGES, "solver.duration=0.115 s"], out=path)


def test_what_was_written_is_what_is_found_afterwards(run: Result) -> None:
    """Compare bit by bit from where averages begin."""
    written, found = run.discharges(), api.electric(run.path)
    assert found.events.time.size > 100
    begin = found.films.time[0]
    assert begin > 0.0
    for name, values in written.items():
        again = getattr(found.events, name).astype(np.float64)
        assert values[written["time"] >= begin].tobytes() == again.tobytes(), name
    circuit = run.circuit()
    inside = circuit["time"] > begin
    assert circuit["bearing_voltage_least"][inside].tobytes() == found.solution.extremes[:, 0].tobytes()
    assert circuit["bearing_capacitance"].min() > 80e-12


@pytest.mark.parametrize("size", [1, 7, 60])
def test_samples_may_come_in_any_pieces(run: Result, size: int) -> None:
    """Pass samples one by one and in dozens.

    The tables are those of the run, which flushed by the clock.
    """
    live = Live(api.check(CASE, CHANGES))
    samples = {name: run[name] for name in CHANNELS}
    parts = [
        live.take({"bearing": {name: values[i : i + size] for name, values in samples.items()}})
        for i in range(0, samples["time"].size, size)
    ]
    for kind, complete in (("circuit", run.circuit()), ("discharges", run.discharges())):
        for name, values in complete.items():
            assert np.concatenate([getattr(part, kind)[name] for part in parts]).tobytes() == values.tobytes(), name


@pytest.mark.full
def test_a_longer_run_goes_on_with_its_circuit(run: Result, tmp_path: Path) -> None:
    """Stop after a third, continue, compare the files."""
    path = tmp_path / "short.h5"
    api.run(CASE, [*CHANGES, "solver.duration=0.03 s"], out=path)
    assert 0 < api.result(path).discharges()["time"].size < run.discharges()["time"].size
    longer = api.resume(path, ["solver.duration=0.115 s"])
    for one, other in ((longer.circuit(), run.circuit()), (longer.discharges(), run.discharges())):
        for name, values in other.items():
            assert one[name].tobytes() == values.tobytes(), name
    with pytest.raises(UsageError, match=r"other values: electric\.options\.seed"):
        _resume_with_another_seed(path)


def _resume_with_another_seed(path: Path) -> None:
    from lambda_core.runs.launch import relaunch

    relaunch(path, api.check(CASE, [*CHANGES[:2], "electric.seed=4", "solver.duration=0.2 s"]))


def test_no_circuit_no_tables(combined_run: Result) -> None:
    assert combined_run.circuit() == combined_run.discharges() == {}


def test_motion_is_not_touched(run: Result, tmp_path: Path) -> None:
    """Compare the samples with a run without a circuit."""
    plain = api.run(CASE, [*CHANGES[:2], "solver.duration=0.02 s"], out=tmp_path / "plain.h5")
    for name in ("load", "film_central", "body_position"):
        values = plain[name]
        assert values.tobytes() == run[name][: len(values)].tobytes(), name


def test_summary_counts_what_was_written(run: Result) -> None:
    """Compare discharges and voltages with the command `electric`."""
    found, outcome = run.summary(), api.electric(run.path).outcome
    assert found.currents is not None
    assert found.currents.discharges_per_s == pytest.approx(outcome.discharges_per_s, rel=1e-12)
    assert found.currents.bearing_voltage_V == pytest.approx(outcome.bearing_voltage_V, rel=1e-12)
    assert found.currents.breakdown_voltage_V == pytest.approx(outcome.breakdown_voltage_V, rel=1e-12)
    assert found.currents.peak_current_A == pytest.approx(outcome.peak_current_A, rel=1e-12)
    assert "discharges per second" in found.text()


def test_report_has_a_section(run: Result, tmp_path: Path) -> None:
    page = api.report(run.path, tmp_path / "r.html", appendices=["tables"]).read_text()
    assert "bearing currents" in page
    assert "discharges through the bearing" in page


def test_laws_of_the_films_are_cited(run: Result) -> None:
    laws = {row["role"]: row for row in run.laws if row["element"] == "film_inner"}
    assert laws["breakdown"]["model"] == "statistical"
    assert laws["breakdown"]["kernel_key"] == run.kernel_keys["film_inner/breakdown/statistical"]
    assert any("Jackson" in law.reference for law in api.cite(run.path).laws)
