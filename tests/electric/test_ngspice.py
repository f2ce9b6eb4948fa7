"""Test nine balls with changing capacitances against ngspice."""

from __future__ import annotations

import shutil

import numpy as np
import pytest
from electric.networks import SMOOTH, integrate, switching
from electric.ngspice import CIRCUIT, RECORDED, RISE, STOP, nine_balls, run

from lambda_core.domain.arrays import FloatArray


def own(time: FloatArray) -> FloatArray:
    """Return the own network's voltage [V].

    Between the rings at times.
    """
    found = integrate(nine_balls(), CIRCUIT, SMOOTH, switching(STOP, rise=RISE), window=(0.0, 1.0)).trace
    return np.interp(time, found[:, 0], found[:, 2])


def test_recorded_waveform() -> None:
    """Compare 340 moments of 1 ms to 1e-5.

    60 edges, leaks, brush, insulated ring and a bridged film; the error refers to the largest value.

    1e-3 was asked for; 8e-7 is found. `tests/electric/ngspice.py` records the file anew.
    """
    time, volts = np.loadtxt(RECORDED, delimiter=",", skiprows=1).T
    assert time.size > 300
    assert np.ptp(volts) > 20.0
    np.testing.assert_allclose(own(time), volts, rtol=0.0, atol=1e-5 * np.abs(volts).max())


@pytest.mark.slow
@pytest.mark.skipif(shutil.which("ngspice") is None, reason="ngspice is not installed")
def test_ngspice_today() -> None:
    time, volts = run()
    np.testing.assert_allclose(own(time), volts, rtol=0.0, atol=1e-4 * np.abs(volts).max())
