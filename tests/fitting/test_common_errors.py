"""Test errors that values of one instrument have in common."""

from __future__ import annotations

import math
import re
from collections.abc import Sequence
from typing import Any

import numpy as np
import pytest

from lambda_core import api
from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.errors import UsageError
from lambda_core.fitting.data import Data
from lambda_core.fitting.discrepancy import Place, predict
from lambda_core.fitting.least_squares import fit
from lambda_core.fitting.measurements import parse_measurements
from lambda_core.fitting.parameters import Parameter
from lambda_core.fitting.shared_errors import SharedErrors
from lambda_core.fitting.subjects import BearingSubject

from . import synthetic as S

ORDINARY = 40  # synthetic fits of each kind in the ordinary tests
SENSORS = {"offset": {"offset": 40.0}, "scale": {"scale": 0.05}}
CASE = "6319-cp10-1500"
HEAD = "speed [1/min],friction torque [N mm],friction torque error [%]"
COMMON = "friction torque common error [N mm]"


def _coverage(sensor: str, noise: str, count: int, *, is_told: bool) -> float:
    """Return the share of regions that hold the truth."""
    fits = (S.fitted(S.NOISES[noise], n, is_error_known=True, is_told=is_told, **SENSORS[sensor]) for n in range(count))
    return float(np.mean([found.contains(S.TRUTH) for found in fits]))


@pytest.mark.parametrize("sensor", SENSORS)
@pytest.mark.parametrize(("is_told", "least", "most"), [(True, 0.85, 1.0), (False, 0.0, 0.8)])
def test_the_region_holds_the_truth_where_a_sensor_is_wrong(
    sensor: str, is_told: bool, least: float, most: float
) -> None:
    """Draw 40 series with a torque sensor that is wrong.

    Its error counts as one of all torques, or as independent ones: these promise too much.
    """
    assert least <= _coverage(sensor, "normal", ORDINARY, is_told=is_told) <= most


@pytest.mark.full
@pytest.mark.parametrize("noise", S.NOISES)
@pytest.mark.parametrize("sensor", SENSORS)
def test_the_region_of_a_wrong_sensor_holds_the_truth_in_90_to_99_percent(sensor: str, noise: str) -> None:
    assert 0.90 <= _coverage(sensor, noise, 200, is_told=True) <= 0.99


def test_a_wrong_law_is_detected_with_a_wrong_sensor() -> None:
    at, detected = S.plan(), []
    errors = 0.01 * S.torque(S.TRUTH, at)
    for seed in range(10):
        random = np.random.default_rng(seed)
        true = S.torque(S.TRUTH, at) + 0.004 * at.speed**1.3
        values = S.normal(random, true, errors) + 40.0 * random.standard_normal()
        of_sensor = np.full((values.size, 1), 40.0), np.zeros((values.size, 1))
        data = Data(values, errors, {"speed": at.speed}, value_errors=of_sensor[0], value_shares=of_sensor[1])
        found = fit(lambda p: S.torque(p, at), S.PARAMETERS, data)
        detected.append(any(test.is_significant for test in found.tests))
    assert np.mean(detected) >= 0.9


def test_offset_and_scale_of_a_sensor_are_exact() -> None:
    """Compare the covariance with generalised least squares."""
    x = np.arange(1.0, 13.0)
    data = Data(x, 0.01 * x, value_errors=np.tile([0.2, 0.0], (12, 1)), value_shares=np.tile([0.0, 0.05], (12, 1)))
    found = fit(lambda p: p[0] * x, [Parameter("a", 0.9, 0.1, 2.0)], data, limit=math.inf)
    known = np.diag((0.01 * x) ** 2) + 0.2**2 + np.outer(0.05 * x, 0.05 * x)
    assert found.values[0] == pytest.approx(1.0, rel=1e-6)
    assert found.standard_errors[0] == pytest.approx(1.0 / math.sqrt(x @ np.linalg.solve(known, x)), rel=1e-4)


def test_an_error_of_scale_leaves_the_mean_between_its_values() -> None:
    """Fit the two values of Peelle, 1.5 and 1.0.

    They have errors of 10 % and one of 20 % in common: shares of the measured values give 0.88, below both
    (D'Agostini 1994, Nucl. Instrum. Methods A 346, 306).
    """
    y = np.array([1.5, 1.0])
    data = Data(y, 0.1 * y, value_errors=np.zeros((2, 1)), value_shares=np.full((2, 1), 0.2))
    found = fit(lambda p: p[0] * np.ones(2), [Parameter("a", 1.2, 0.1, 3.0)], data, limit=math.inf)
    assert found.values[0] == pytest.approx((1.5 / 1.5**2 + 1.0) / (1.0 / 1.5**2 + 1.0), rel=1e-3)


def test_a_new_measurement_has_the_common_error_of_the_others() -> None:
    """Compare it with the conditional normal distribution by hand.

    Two fitted values have an offset of 10 in common with a new one.
    """
    exact = Parameter("slope", 1.0, 1.0 - 1e-9, 1.0 + 1e-9)
    at = Place(np.full(2, 100.0), np.ones((2, 1)), np.zeros((2, 1)), ("torque",) * 2, np.zeros(2))
    one = Place(at.predicted[:1], at.jacobian[:1], at.coordinates[:1], ("torque",), np.zeros(1))
    own, common = 3.0, 10.0
    errors = np.full(2, math.hypot(own, common))
    shared = SharedErrors.of([np.arange(1), np.arange(1, 2)], np.zeros((2, 0)), np.full((2, 1), common), errors)
    found = predict([exact], np.array([1.0]), np.array([108.0, 112.0]), errors, at, one, errors[:1], shared,
                    np.full((2, 1), common**2))  # fmt: skip
    left = 1.0 / (1.0 / common**2 + 2.0 / own**2)
    assert found.mean[0] == pytest.approx(100.0 + 10.0 * left * 2.0 / own**2, rel=1e-4)
    half = 1.959964 * math.sqrt(left + own**2)
    np.testing.assert_allclose(found.band()[0], [found.mean[0] - half, found.mean[0] + half], rtol=1e-3)


def test_a_quantity_may_have_an_offset_or_an_error_of_scale() -> None:
    torque = "speed [rpm],friction torque [N m],friction torque error [%]"
    found = parse_measurements(f"{torque},friction torque common error [N mm]\n500,1,2,30\n900,2,2,30\n", "rig.csv")
    np.testing.assert_allclose(found.without({0}).common_of_values["friction torque"], [30.0])
    np.testing.assert_allclose(found.deviations("friction torque"), np.hypot([20.0, 40.0], 30.0))
    found = parse_measurements(f"{torque},friction torque common error [%]\n500,1,2,5\n900,2,2,5\n", "rig.csv")
    np.testing.assert_allclose(found.common_shares["friction torque"], 0.05)
    assert found.in_common == "friction torque"


@pytest.fixture
def closed_law(monkeypatch: pytest.MonkeyPatch) -> None:
    """Put a closed law in the place of the solver.

    Its torque grows with the speed; there is no capacitance below 100 1/min. Laws are wrong by 2 %.
    """

    def values(
        self: BearingSubject,
        changes: Sequence[str],
        parameters: Sequence[tuple[Any, float]],
        names: Sequence[str],
        *,
        one: bool,
    ) -> FloatArray:
        del self, one
        speed = float(re.findall(r"speed=([\d.]+)", changes[0])[0])
        torque = 900.0 + 1e4 * (parameters[0][1] - 0.03) + 0.1 * speed
        known = {"friction torque": torque, "power loss": 0.1 * torque, "capacitance": 0.5 if speed > 100 else math.inf}
        return np.array([[known[name] for name in names]])

    monkeypatch.setattr(BearingSubject, "values", values)
    monkeypatch.setattr(BearingSubject, "deviations", lambda self, changes, names, fitted: dict.fromkeys(names, 0.02))


def _fit(head: str, *lines: str, asked: Sequence[str] = ()) -> api.FitReport:
    text = "\n".join(asked)
    new = parse_measurements(text, "other.csv") if asked else None
    return api.fit(CASE, parse_measurements("\n".join([head, *lines]), "rig.csv"), ["loss_factor"], suggest=False,
                   predict=new)  # fmt: skip


LINES = ("500,1000,1,50", "1000,1050,1,50", "2000,1150,1,50", "3000,1250,1,50")


@pytest.mark.usefixtures("closed_law")
def test_predictions_know_the_offset_of_the_same_sensor() -> None:
    """Predict with the sensor of the fit and with another.

    An error in common counted as independent, and the band was as wide as with another sensor.
    """
    head = f"{HEAD},{COMMON}"
    same = _fit(head, *LINES, asked=(head, "1500,1100,1,50")).predictions[0]
    other = _fit(head, *LINES, asked=(HEAD, "1500,1100,5")).predictions[0]
    assert same.band[1] - same.band[0] < 0.7 * (other.band[1] - other.band[0])
    assert same.is_inside


@pytest.mark.usefixtures("closed_law")
@pytest.mark.parametrize("common", ["1e4", "1e7"])
def test_an_offset_of_any_size_leaves_its_differences(common: str) -> None:
    """Fit torques whose offset is 46 and unknown.

    From 1e4 times the errors on nothing was determined, and bands of the same points were narrower than their errors.
    """
    head, lines = f"{HEAD},{COMMON}", [f"{n},{946 + 0.1 * n},0.5,{common}" for n in range(500, 2500, 250)]
    found = _fit(head, *lines, asked=(head, f"1500,{946 + 150},0.5,{common}"))
    low, high = found.predictions[0].band
    assert found.chi_square_per_degree == pytest.approx(0.0, abs=1e-3)
    assert 2 * 1.9 * 5.0 < high - low < 2 * 2.5 * 5.5
    assert found.predictions[0].is_inside


@pytest.mark.usefixtures("closed_law")
def test_an_outlier_is_named_that_is_smaller_than_the_offset() -> None:
    """Make one torque wrong by 60 N mm, offset 50.

    Its weight in the fit was a tenth, and nothing told of it.
    """
    lines = [
        f"{speed},{930 + 0.1 * speed + (60 if speed == 1500 else speed % 3)},1,50" for speed in range(500, 2500, 250)
    ]
    found = _fit(f"{HEAD},{COMMON}", *lines)
    assert [point.line for point in found.points if point.is_outlier] == [6]
    assert "outliers, which count little: line 6 (+" in found.text()


@pytest.mark.usefixtures("closed_law")
def test_points_to_predict_without_errors_are_taken_as_exact() -> None:
    """Predict a value that has no column of errors.

    Its error was 100 %.
    """
    found = _fit(
        HEAD, "500,951,1", "1000,999,1", "2000,1101,1", asked=("speed [1/min],friction torque [N mm]", "800,980")
    )
    low, high = found.predictions[0].band
    assert high - low < 0.12 * found.predictions[0].predicted
    assert "other.csv has no errors of measurement: its bands are for exact measurements." in found.warnings


@pytest.mark.usefixtures("closed_law")
def test_a_quantity_that_was_not_fitted_has_the_errors_of_its_laws() -> None:
    """Predict a loss from fitted torques.

    Its laws counted as exact.
    """
    asked = ("speed [1/min],power loss [W],power loss error [%]", "800,98,0.01")
    found = _fit(HEAD, *(f"{speed},{900 + 0.1 * speed},0.01" for speed in range(500, 3000, 100)), asked=asked)
    low, high = found.predictions[0].band
    assert (high - low) / found.predictions[0].predicted > 0.01


@pytest.mark.usefixtures("closed_law")
def test_a_common_error_needs_errors_of_the_values() -> None:
    with pytest.raises(UsageError, match=r'"friction torque common error" counts against .* "friction torque error'):
        _fit(f"speed [1/min],friction torque [N mm],{COMMON}", "500,950,50", "900,990,50")


@pytest.mark.usefixtures("closed_law")
def test_a_value_that_was_not_measured_needs_no_error() -> None:
    """Leave both cells empty, and infinite values out.

    An empty error was refused, and an infinite capacitance ended the fit with a sentence of SciPy.
    """
    head = f"{HEAD},capacitance [nF],capacitance error [%]"
    found = _fit(head, "500,950,1,,", "1000,1000,1,,", "2000,1100,1,0.5,2", "50,905,1,0.5,2")
    assert [(point.line, point.quantity) for point in found.points][-1] == (4, "capacitance")
    assert found.unsolved_lines == [5]
    assert any("there is no capacitance: asperities connect the rings" in text for text in found.warnings)
