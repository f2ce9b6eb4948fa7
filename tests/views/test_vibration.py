"""Test vibration as a sensor measures it."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from lambda_plugins.views.common import spectrum
from lambda_plugins.views.vibration import envelope

from lambda_core import api
from lambda_core.domain.errors import CaseError, UsageError
from lambda_core.plugins import NotApplicable
from lambda_core.results.reader import Result


def test_the_envelope_of_a_modulated_carrier_is_its_modulation() -> None:
    """Compare envelope and modulation of a carrier.

    (1 + m cos(2 pi f t)) cos(2 pi F t) has the envelope 1 + m cos(2 pi f t), also with a low tone added.
    """
    time = np.arange(8192) / 8192.0
    size = 1.0 + 0.5 * np.cos(2.0 * np.pi * 40.0 * time)
    values = size * np.cos(2.0 * np.pi * 2000.0 * time) + 3.0 * np.sin(2.0 * np.pi * 25.0 * time)
    found = envelope(time, values, 1000.0)
    assert found == pytest.approx(size, abs=0.01)
    frequency, amplitude = spectrum(time, found)
    assert frequency[np.argmax(amplitude)] == pytest.approx(40.0, abs=0.5)


def test_displacement_velocity_and_acceleration_are_of_one_motion(radial_run: Result) -> None:
    """Compare amplitudes by factors of 2 pi f.

    At the passing of the balls, where the ring moves most.
    """
    views = {
        motion: api.view(radial_run, "vibration", {"motion": motion, "axis": "y"})
        for motion in ("displacement", "velocity", "acceleration")
    }
    scale = {"displacement": 1e-6, "velocity": 1e-3, "acceleration": 1.0}
    lines = {motion: view.panels[1].series[0] for motion, view in views.items()}
    at = int(np.argmax(lines["velocity"].y))
    frequency = lines["velocity"].x[at]
    sizes = {motion: scale[motion] * float(line.y[at]) for motion, line in lines.items()}
    assert sizes["velocity"] == pytest.approx(2.0 * np.pi * frequency * sizes["displacement"], rel=0.05)
    assert sizes["acceleration"] == pytest.approx(2.0 * np.pi * frequency * sizes["velocity"], rel=0.05)
    marks = {mark.label: mark.value for mark in views["velocity"].panels[2].marks}
    assert marks["BPFI + shaft"] - marks["BPFI - shaft"] == pytest.approx(2.0 * marks["shaft"])
    assert marks["2 BSF + FTF"] - marks["2 BSF - FTF"] == pytest.approx(2.0 * marks["FTF"])


def test_a_locked_housing_has_no_signal(radial_run: Result) -> None:
    with pytest.raises(NotApplicable, match=r"the housing does not move .*bodies\.outer_ring\.z = { mode"):
        api.view(radial_run, "vibration", {"place": "housing"})


def test_a_measured_signal_stands_with_the_computed_one(radial_run: Result, tmp_path: Path) -> None:
    file = tmp_path / "rig.csv"
    rows = [f"{t:.6f},{np.sin(2.0 * np.pi * 100.0 * t):.6f}" for t in np.arange(3000) / 2000.0]
    file.write_text("\n".join(["time [s],acceleration [m/s2]", *rows]))
    data = api.view(radial_run, "vibration", {"measured": str(file)})
    for panel in data.panels:  # the smaller signal is drawn upon the larger
        assert [(series.name, series.role) for series in panel.series] == [
            ("rig.csv", "measured"),
            ("computed", "inner"),
        ]
    line = data.panels[1].series[0]
    assert line.x[np.argmax(line.y)] == pytest.approx(100.0, abs=1.0)
    assert line.y.max() == pytest.approx(1.0, rel=0.02)
    file.write_text("time [s],acceleration [m/s2]\n0,1\n0.1,one\n")
    with pytest.raises(CaseError, match="line 3, column 2"):
        api.view(radial_run, "vibration", {"measured": str(file)})
    file.write_text("time [s],acceleration [m/s2]\n0,1\n0.1,2\n0.5,1\n")
    with pytest.raises(UsageError, match="evenly spaced"):
        api.view(radial_run, "vibration", {"measured": str(file)})


def test_a_measured_signal_without_a_spectrum_is_refused(radial_run: Result, tmp_path: Path) -> None:
    """Refuse an empty and a short signal.

    The empty cell made a spectrum of nothing, and a short signal blamed the run's averaging window.
    """
    file = tmp_path / "rig.csv"
    rows = [f"{0.001 * k},{k % 3},{k}" for k in range(40)]
    rows[9] = "0.009,,4"
    file.write_text("\n".join(["time [s],acceleration [m/s2],velocity [mm/s]", *rows]), encoding="utf-8")
    with pytest.raises(UsageError, match=r"rig\.csv line 11: acceleration is empty"):
        api.view(radial_run, "vibration", {"measured": str(file)})
    api.view(radial_run, "vibration", {"measured": str(file), "motion": "velocity"})
    file.write_text("\n".join(["time [s],acceleration [m/s2],velocity [mm/s]", *rows[:5]]), encoding="utf-8")
    with pytest.raises(UsageError, match=r"rig\.csv: 5 samples are too few for a spectrum: 32 at least"):
        api.view(radial_run, "vibration", {"measured": str(file)})


def test_a_measured_velocity_is_compared_with_the_computed_one(radial_run: Result, tmp_path: Path) -> None:
    """Show the motion that a file has.

    Only the acceleration was looked for, although another motion was measured.
    """
    file = tmp_path / "rig.csv"
    rows = [f"{0.001 * k},{k % 3}" for k in range(40)]
    file.write_text("\n".join(["time [s],velocity [mm/s]", *rows]), encoding="utf-8")
    data = api.view(radial_run, "vibration", {"measured": str(file), "axis": "y"})
    assert data.title == "Velocity of the shaft"
    assert data.panels[0].y.unit == "mm/s"
    with pytest.raises(UsageError, match=r'"acceleration \[m/s2\]" are needed'):
        api.view(radial_run, "vibration", {"measured": str(file), "motion": "acceleration"})


def test_a_signal_of_few_samples_has_no_envelope(radial_run: Result, tmp_path: Path) -> None:
    """Refuse a sample each second.

    The envelope of nothing was drawn.
    """
    file = tmp_path / "rig.csv"
    file.write_text("\n".join(["time [s],acceleration [m/s2]", *(f"{k},{k % 3}" for k in range(64))]))
    with pytest.raises(UsageError, match=r"rig\.csv: the envelope begins at .* Hz, above all frequencies"):
        api.view(radial_run, "vibration", {"measured": str(file)})


@pytest.mark.full
def test_a_measured_signal_of_the_most_lines_is_read(combined_run: Result, tmp_path: Path) -> None:
    """Read a signal of 200 000 lines.

    So many are allowed, but only 4 MiB were.
    """
    file = tmp_path / "rig.csv"
    rows = [f"{2e-5 * k:.9f},{k % 7:.9f}" for k in range(200_000)]
    file.write_text("\n".join(["time [s],acceleration [m/s2]", *rows]), encoding="utf-8")
    assert len(api.view(combined_run, "vibration", {"measured": str(file)}).panels) == 3
