"""Test the capacitance and circuit of rollers in motion."""

from __future__ import annotations

import math

import numpy as np
import pytest

from lambda_core import api
from lambda_core.formulas.gap_capacitance import VACUUM_PERMITTIVITY
from lambda_core.results.reader import Result

PERMITTIVITY = 2.2  # the law constant's default
SMOOTH = ["surface.roughness=0.02 um", "models.permittivity=constant", "solver.duration=3 ms"]

MOTOR = {
    "name": "motor",
    "operation": {"speed": "3000 rpm"},
    "lubricant": {"name": "FVA3", "temperature": "70 degC"},
    "surface": {"roughness": "0.02 um"},
    "shaft": {"sections": [{"length": "280 mm", "diameter": "40 mm"}]},
    "bearings": {
        "drive": {"designation": "SKF NU 208 ECP", "at": "20 mm"},
        "other": {"designation": "SKF 6308", "at": "260 mm"},
    },
    "loads": {"belt": {"at": "5 mm", "force_z": "-3 kN"}},
}


@pytest.fixture(scope="module")
def run(tmp_path_factory: pytest.TempPathFactory) -> Result:
    folder = tmp_path_factory.mktemp("rollers")
    case = api.init_case("nu", bearing="SKF NU 208 ECP", path=folder / "nu.toml")
    return api.run(case, SMOOTH, out=folder / "nu.h5")


def test_the_flat_is_a_plate_capacitor_of_the_area_that_carries(run: Result) -> None:
    """Compare C h/(eps_0 eps_r) with the slices' 2 b L.

    It is at most that of the full line, near F/(pi/4 p_max) (Johnson 1985).
    """
    load, a, b = run["load"][-1], run["semi_axis_a"][-1], run["semi_axis_b"][-1]
    carries = load > 100.0
    area = run["capacitance_hertz"][-1] * run["film_central"][-1] / (VACUUM_PERMITTIVITY * PERMITTIVITY)
    assert np.count_nonzero(carries) >= 6
    assert (area[carries] <= 4.0 * (a * b)[carries] * (1.0 + 1e-9)).all()
    mean = load[carries] / (0.25 * math.pi * run["max_pressure"][-1][carries])
    np.testing.assert_allclose(area[carries], mean, rtol=0.15)  # of slices under less than the largest pressure


def test_gaps_at_the_sides_add_to_the_flat_and_open_rollers_have_less(run: Result) -> None:
    load, found, flat = run["load"][-1], run["capacitance"][-1], run["capacitance_hertz"][-1]
    assert np.isfinite(found).all()
    assert (found[load > 0.0] > flat[load > 0.0]).all()
    open_ones = found[load == 0.0]
    assert open_ones.size
    assert open_ones.min() > 0.0
    assert open_ones.max() < found[load > 100.0].min()


def test_rollers_are_two_contacts_in_series_and_parallel_to_each_other(run: Result) -> None:
    inner, outer = run["capacitance"][-1].T
    assert float(run["bearing_capacitance"][-1]) == pytest.approx(
        float((inner * outer / (inner + outer)).sum()), rel=1e-9
    )
    summary = run.summary()
    assert summary.bearing_capacitance_nF == pytest.approx(1e9 * float(run["bearing_capacitance"][-1]))


def test_a_bearing_with_rollers_stands_in_a_circuit(run: Result) -> None:
    """Compare the circuit's capacitance with the run's mean.

    The mean lies between the ends of the capacitance.
    """
    outcome = api.electric(run.path).outcome
    low, *_, high = outcome.bearing_capacitance_pF
    assert 0.9 * low <= 1e12 * float(np.mean(run["bearing_capacitance"])) <= 1.1 * high
    assert abs(outcome.charge_residual) < 1e-6


@pytest.mark.full
def test_a_motor_of_rollers_and_balls_has_one_circuit() -> None:
    outcome = api.electric(MOTOR).outcome
    assert set(outcome.bearings) == {"drive", "other"}
    assert min(outcome.bearings["drive"].bearing_capacitance_pF) > 0.0
    assert abs(outcome.energy_residual) < 1e-6


def test_rollers_at_rest_pass_nothing() -> None:
    with pytest.raises(api.UsageError, match="at rest no roller passes"):
        api.electric(MOTOR, ["operation.speed=0 rpm"])
