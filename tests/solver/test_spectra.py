"""Test spectra of a bearing with a defect.

They hang neither on the step nor on the samples.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from lambda_core import api
from lambda_core.domain.arrays import FloatArray

AXIAL = "6208-axial-700"
DEFECT = ('forces.ball_outer.models.surface="defect"', "depth.cage=false", "solver.duration=60 ms")
RESOLVE = 2000.0  # [Hz], the default where a raceway is not nominal
BAND = (150.0, 1900.0)  # [Hz]
LARGEST = 6


def velocity(out: Path, *changes: str) -> tuple[FloatArray, FloatArray]:
    """Return the inner ring's velocity [m/s].

    With times [s], behind the start of a run.
    """
    result = api.run(AXIAL, [*DEFECT, *changes], out=out)
    late = result["time"] > 0.012
    return result["time"][late], result["body_velocity"][late, 0, :]


def lines(times: FloatArray, values: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return frequencies in the band and amplitudes (Hann window)."""
    window = np.hanning(len(values))
    seen = np.abs(np.fft.rfft((values - values.mean()) * window)) * 2.0 / window.sum()
    frequency = np.fft.rfftfreq(len(values), float(np.diff(times).mean()))
    inside = (frequency > BAND[0]) & (frequency < BAND[1])
    return frequency[inside], seen[inside]


def off(lines_: FloatArray, reference: FloatArray) -> float:
    """Return the largest relative difference.

    Among the largest lines of a reference.
    """
    top = np.argsort(reference)[-LARGEST:]
    return float(np.abs(lines_[top] / reference[top] - 1.0).max())


@pytest.mark.slow
def test_lines_of_a_defect_hang_on_no_step(tmp_path: Path) -> None:
    """Halve the step and compare six lines.

    None of the largest along and across the shaft moves by 3 %.
    """
    every = "output.interval=0.05 ms"
    times, chosen = velocity(tmp_path / "chosen.h5", every)
    again, half = velocity(tmp_path / "half.h5", every, f"solver.max_step={1.0 / (12.0 * RESOLVE)} s")
    assert np.array_equal(times, again)
    for axis in (0, 2):
        assert off(lines(times, chosen[:, axis])[1], lines(times, half[:, axis])[1]) < 0.03


@pytest.mark.slow
def test_what_is_faster_hardly_falls_into_a_spectrum(tmp_path: Path) -> None:
    """Compare lines with eight times the samples.

    Behind a filter: 1.5 % of the lines along the shaft.

    Across it lines are smaller and much stands above: 6 % (130 % with half the samples). The filter itself and the ends
    of the window take up to 1 %.
    """
    from scipy.signal import filtfilt, firwin  # half a second for one slow test

    times, seen = velocity(tmp_path / "seen.h5")
    interval = float(np.diff(times).mean())
    assert interval * RESOLVE < 1.0 / 5.0
    dense_times, dense = velocity(tmp_path / "dense.h5", f"output.interval={interval / 8.0!r} s")
    edge = 1.15 * RESOLVE
    low = filtfilt(firwin(1201, edge, fs=8.0 / interval), [1.0], dense, axis=0)
    start = int(np.argmin(np.abs(dense_times - times[0])))
    count = min(len(seen), len(low[start::8]))
    for axis, most in ((0, 0.015), (2, 0.06)):
        reference = lines(times[:count], low[start::8][:count, axis])[1]
        assert off(lines(times[:count], seen[:count, axis])[1], reference) < most
