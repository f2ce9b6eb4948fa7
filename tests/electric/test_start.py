"""Test the initial state of the circuit.

The inverter has long been on.
"""

from __future__ import annotations

import math

import numpy as np
import pytest
from electric.networks import ROUGH, SMOOTH, integrate, one_bearing, residuals, steady, switching, turning

from lambda_core import api
from lambda_core.analysis.electric import columns as L
from lambda_core.analysis.electric.voltage_sources import corners, one_period
from lambda_core.case.electric import Inverter, Series, Sine, Step

STOP = 6e-3


def at_rest(angle: np.ndarray) -> np.ndarray:
    return 0.0 * angle


@pytest.mark.parametrize("leak", [0.0, 1e-12, 1e-9, 1e-7])
@pytest.mark.parametrize("brush", [0.0, 1e-8, 1e-5, 1.0])
def test_begins_in_the_steady_state(leak: float, brush: float) -> None:
    """Compare the first period with the fortieth.

    The leak ranges from none to a brush of 1 Ohm.
    """
    inverter = Inverter()
    source, rest = (f(inverter, 0.0, *t, at_rest) for f, t in ((corners, (STOP,)), (one_period, ())))
    films = steady(100e-12, 80e-12, leak=leak, stop=STOP)
    found = integrate(films, one_bearing(50e-12, 800e-12, brush=brush), SMOOTH, source, window=(0.0, 1.0), rest=rest)
    time, volts = found.trace[:, 0], found.trace[:, 2]
    first, late = (volts[(time > 1e-4 * (k + 0.001)) & (time < 1e-4 * (k + 0.999))] for k in (0, 40))
    assert first.size == 12
    np.testing.assert_allclose(first, late, atol=1e-6 * 16.0)


def test_grounded_rotor_has_no_voltage_at_the_start() -> None:
    """Start a grounded rotor with the current of edges.

    An uncharged rotor would start with 16 V; the brush has 1 Ohm.
    """
    inverter = Inverter()
    source, rest = corners(inverter, 0.0, STOP, at_rest), one_period(inverter, 0.0, at_rest)
    films = steady(400e-12, 400e-12, stop=STOP)
    circuit = one_bearing(50e-12, 800e-12, brush=1.0)
    edge = 50e-12 * 2.0 * 800.0 / 3.0 / 50e-9  # C_wr dV/dt of two phases at once through 1 Ohm [V]
    kept = integrate(films, circuit, SMOOTH, source, rest=rest).extremes
    assert np.abs(kept).max() < 1.01 * edge
    found = api.electric("6208-axial-1300", ["electric.duration=5 ms", "electric.grounding.brush=1 Ohm"])
    assert max(map(abs, found.outcome.bearing_voltage_V)) < 1.01 * edge


def test_offset_of_a_measured_series_leaks_away() -> None:
    """Remove the mean of a series about 100 V.

    A bearing that leaks does not see the 100 V from its first moment on.
    """
    points = [(f"{1e-5 * k} s", f"{100.0 + 50.0 * math.sin(0.1 * math.pi * k)} V") for k in range(20)]
    series = Series(points=points, repeat=True)
    source, rest = corners(series, 0.0, STOP, at_rest), one_period(series, 0.0, at_rest)
    films = steady(400e-12, 400e-12, leak=1e-12, stop=STOP)
    found = integrate(films, one_bearing(50e-12, 800e-12), SMOOTH, source, rest=rest)
    ratio = 50.0 / (50.0 + 800.0 + 200.0)
    assert found.extremes[:, 1].max() == pytest.approx(50.0 * ratio, rel=0.02)
    assert found.extremes[:, 0].min() == pytest.approx(-50.0 * ratio, rel=0.02)


def test_periods_close() -> None:
    """End each first period at its first voltage.

    An edge has no period.
    """
    series = Series(points=[("0 s", "3 V"), ("1 us", "5 V"), ("2 us", "-1 V")], repeat=True)
    for source in (Inverter(), Sine(amplitude="5 V", frequency="77 Hz"), series):
        times, volts = one_period(source, 0.0, lambda t: 288.0 * t)
        assert volts[-1] == volts[0]
        assert np.all(np.diff(times) > 0.0)
    assert one_period(Step(amplitude="5 V"), 0.0, at_rest)[0].size == 0


def test_films_that_do_not_stand_the_start() -> None:
    """Ignore breakdowns that only the start causes.

    They are no events, their voltage is no largest one, and all sums close.
    """
    source, rest = switching(0.021), switching(1e-4)
    films, circuit = turning(film=0.5e-6), one_bearing(50e-12, 1000e-12, 5e-12)
    found = integrate(films, circuit, ROUGH, source, seed=1, rest=rest)
    assert found.events[0, 0] > 0.0
    begun = found.total[L.T_BEGAN]
    assert 0.0 < begun < 1e-6
    assert max(map(abs, residuals(found, circuit, source))) < 1e-6
    quiet = integrate(turning(), circuit, SMOOTH, source, rest=rest)
    assert quiet.total[L.T_BEGAN] == 0.0


def test_largest_voltage_is_one_that_films_stand() -> None:
    """Give no voltage when every film breaks down below.

    The rotor of a 6208 has 15 V when nothing breaks down.
    """
    found = api.electric(
        "6208-axial-1300", ["electric.duration=10 ms", "electric.breakdown.parameters.strength=5 V/um"]
    )
    outcome = found.outcome
    assert outcome.discharges > 100
    assert found.events.time[0] > 0.0
    broke = np.abs(found.events.bearing_voltage).max()
    assert max(map(abs, outcome.bearing_voltage_V)) <= 1.001 * broke
    assert broke < 0.7 * outcome.bearing_voltage_ratio * 400.0
