"""Test the circuit of a case and of a run.

Numbers, files, command line.
"""

from __future__ import annotations

import csv
import json
from pathlib import Path
from typing import TYPE_CHECKING

import h5py
import numpy as np
import pytest
from lambda_cli.main import main

from lambda_core import api
from lambda_core.analysis.electric.current_numbers import numbers_of
from lambda_core.domain.errors import UsageError

if TYPE_CHECKING:
    from lambda_core.results.reader import Result

RADIAL = ["loads.radial=2 kN", "loads.axial=0 N"]
SHORT = ["electric.duration=0.03 s"]


def test_radial_6208() -> None:
    """Compute a radially loaded 6208 on an 800 V inverter.

    The test looks at every part of the outcome.
    """
    found = api.electric("6208-axial-1300", [*RADIAL, *SHORT])
    outcome, events = found.outcome, found.events
    assert outcome.discharges + outcome.partial_discharges == events.discharge[-1] + 1
    assert outcome.discharges > 50
    assert outcome.breakdown_voltage_V is not None
    assert 2.0 < outcome.breakdown_voltage_V[0] < outcome.breakdown_voltage_V[2] < outcome.bearing_voltage_V[1] * 1.01
    assert sum(outcome.sector_share_inner) == pytest.approx(1.0)
    assert sum(outcome.sector_share_outer) == pytest.approx(1.0)
    # The load zone is at -90 degrees: what breaks down on the resting ring lies around it.
    assert sum(outcome.sector_share_outer[22:32]) > 0.9
    assert max(outcome.sector_share_inner) < 0.2
    assert abs(outcome.energy_residual) < 1e-6
    assert abs(outcome.charge_residual) < 1e-6
    assert np.all(np.diff(events.time) >= 0.0)
    assert np.all(events.film > 0.3e-6)
    assert outcome.voltage_histogram is not None
    assert sum(outcome.voltage_histogram.counts) == outcome.discharges
    assert not any(limit.read_in_the_original for limit in outcome.limits)
    impedance = outcome.impedance_kOhm
    assert impedance["10000 Hz"] / impedance["100000 Hz"] == pytest.approx(10.0, rel=1e-2)


def test_the_voltage_of_a_bearing_is_a_size() -> None:
    """Compare a rising with a falling edge of the source."""
    found = [
        numbers_of(api.electric("6208-axial-1300", ["electric.duration=0.2 ms", f"electric.step.amplitude={volts} V"]))
        for volts in (20, -20)
    ]
    assert found[0].bearing_voltage_V > 0.1
    assert found[1].bearing_voltage_V == pytest.approx(found[0].bearing_voltage_V, rel=1e-6)


def test_run_and_case_agree(combined_run: Result) -> None:
    """Compare capacitances of dynamics and equilibria to 3 %."""
    run = api.electric(combined_run.path, ["electric.inverter.dc_link=400 V"]).outcome
    case = api.electric("6208-axial-1300", ["loads.radial=0.4 kN", *SHORT, "electric.inverter.dc_link=400 V"]).outcome
    assert "400 V" in run.source
    assert run.bearing_capacitance_pF[1] == pytest.approx(case.bearing_capacitance_pF[1], rel=0.03)
    assert run.speed_rpm == pytest.approx(case.speed_rpm, rel=1e-3)


def test_run_takes_options_of_the_circuit_only(combined_run: Result) -> None:
    with pytest.raises(UsageError, match="options of \\[electric\\] only"):
        api.electric(combined_run.path, ["loads.radial=1 kN"])


def test_brush_stops_discharges() -> None:
    found = api.electric("6208-axial-1300", [*RADIAL, *SHORT, "electric.grounding.brush=1 Ohm"]).outcome
    assert found.discharges == 0
    assert found.breakdown_voltage_V is None


def test_same_seed_same_table(tmp_path: Path) -> None:
    """Compare two tables of one seed byte by byte.

    Another seed makes another table.
    """
    tables = []
    for name, seed in (("a", 7), ("b", 7), ("c", 8)):
        found = api.electric("6208-axial-1300", [*RADIAL, *SHORT, f"electric.seed={seed}"])
        tables.append(api.write_discharges(found, tmp_path / f"{name}.csv").read_bytes())
    assert tables[0] == tables[1]
    assert tables[0] != tables[2]


def test_files(tmp_path: Path) -> None:
    found = api.electric("6208-axial-1300", [*RADIAL, *SHORT])
    with api.write_discharges(found, tmp_path / "table.csv").open() as file:
        rows = list(csv.reader(file))
    assert rows[0][:3] == ["time [s]", "ball", "ring"]
    assert len(rows) == found.events.time.size + 1
    assert float(rows[1][7]) == found.events.energy[0]
    with h5py.File(api.write_discharges(found, tmp_path / "table.h5")) as file:
        np.testing.assert_array_equal(file["events/peak"], found.events.peak)
        assert file["events/peak"].attrs["units"] == "A"
        assert json.loads(file["outcome_json"].asstr()[()])["discharges"] == found.outcome.discharges
        assert file["time"].shape == file["bearing_capacitance"].shape == file["least_voltage"].shape
    with pytest.raises(UsageError, match="exists"):
        api.write_discharges(found, tmp_path / "table.csv")
    with pytest.raises(UsageError, match=r"written as \.csv or \.h5"):
        api.write_discharges(found, tmp_path / "table.xlsx")


def test_command(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    arguments = ["electric", "6208-axial-1300", "--udc", "400V", "--fsw", "20kHz", "--duration", "0.01 s", "--quiet"]
    assert main([*arguments, "--json", "--out", str(tmp_path / "x.csv")]) == 0
    found = json.loads(capsys.readouterr().out)
    assert found["case"] == "6208-axial-1300"
    assert "400 V, 20 kHz" in found["source"]
    assert (tmp_path / "x.csv").is_file()
    assert main(arguments) == 0
    assert "not read in the original" in capsys.readouterr().out
    assert main([*arguments, "--units", "us"]) == 0
    text = capsys.readouterr().out
    assert "correlation_length 394 uin" in text
    assert " um" not in text
    assert main([*arguments, "--rise-time", "-5ns"]) == 3
    assert "electric.inverter.rise_time" in capsys.readouterr().err
    assert main([*arguments, "--out", str(tmp_path / "x.csv")]) == 2
    assert "exists" in capsys.readouterr().err


def test_densities_are_over_the_mean_area_of_one_raceway() -> None:
    """Divide by the mean area of one raceway.

    Films are in series: one current goes through the contacts of the inner and then of the outer raceway.

    Under axial load all balls are alike, and each presses on 3/2 Q/p_max (Hertz); the outer's area is a little larger.
    """
    found = api.electric("6208-axial-1300", SHORT).outcome
    state = api.quasistatic("6208-axial-1300")
    inner = 9 * 1.5 * state.max_load_N / (1e3 * state.max_pressure_GPa)  # [mm2]
    assert inner < found.hertz_area_mm2 < 1.3 * inner


def test_what_is_read_is_not_written_over(combined_run: Result, capsys: pytest.CaptureFixture[str]) -> None:
    path = str(combined_run.path)
    before = combined_run.path.read_bytes()
    assert main(["electric", path, "--out", path, "--force"]) == 2
    assert "is the input file" in capsys.readouterr().err
    assert combined_run.path.read_bytes() == before


@pytest.mark.parametrize(
    ("change", "words"),
    [("electric.duration=1e6 s", "at most"), ("electric.inverter.dc_link=1e300 V", "electric.inverter.dc_link")],
)
def test_counts_without_end_are_refused(change: str, words: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["electric", "6208-axial-1300", "--set", change]) in (2, 3)
    assert words in capsys.readouterr().err


def test_a_window_that_ends_before_it_begins_is_refused() -> None:
    with pytest.raises(UsageError, match=r"window = \(0\.0002, 0\.0001\) is not allowed: the first time must be"):
        api.electric("6208-axial-1300", ["electric.duration=0.5 ms"], window=(2e-4, 1e-4))


@pytest.mark.parametrize("duration", ["1 ns", "10 us", "0.1 ms"])
@pytest.mark.filterwarnings("error::RuntimeWarning")
def test_short_spans(duration: str, combined_run: Result) -> None:
    """Reject spans shorter than the samples of a run.

    A case computes at least one position of the balls.
    """
    with pytest.raises(UsageError, match="too short"):
        api.electric(combined_run.path, [f"electric.duration={duration}"])
    found = api.electric("6208-axial-1300", [f"electric.duration={duration}"]).outcome
    assert found.bearing_voltage_V[0] < 0.0 < found.bearing_voltage_V[1]
