"""Test fits against certified values and synthetic measurements."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import replace

import numpy as np
import pytest
from numpy.typing import NDArray

from lambda_core.domain.arrays import FloatArray
from lambda_core.fitting.data import Data
from lambda_core.fitting.least_squares import Fit, fit
from lambda_core.fitting.next_point import next_point
from lambda_core.fitting.parameters import Parameter
from lambda_core.fitting.residual_tests import trend_test
from lambda_core.fitting.sentence import sentence
from lambda_core.fitting.uncertainty import counted, robust_factor

from . import certified as C
from . import synthetic as S

ORDINARY = 40  # synthetic fits of each kind in the ordinary tests


@pytest.mark.parametrize("start", [0, 1])
@pytest.mark.parametrize(
    ("model", "y", "starts", "values", "deviations", "scatter"),
    [
        (C.misra, C.MISRA_Y, C.MISRA_STARTS, C.MISRA_VALUES, C.MISRA_DEVIATIONS, C.MISRA_SCATTER),
        (C.thurber, C.THURBER_Y, C.THURBER_STARTS, C.THURBER_VALUES, C.THURBER_DEVIATIONS, C.THURBER_SCATTER),
    ],
)
def test_values_deviations_and_scatter_are_the_certified_ones(
    start: int,
    model: Callable[[FloatArray], FloatArray],
    y: FloatArray,
    starts: Sequence[Sequence[float]],
    values: FloatArray,
    deviations: FloatArray,
    scatter: float,
) -> None:
    parameters = [Parameter(f"b{i}", value) for i, value in enumerate(starts[start])]
    found = fit(model, parameters, Data(y, np.ones_like(y), is_error_known=False), limit=math.inf)
    np.testing.assert_allclose(found.values, values, rtol=1e-6)
    np.testing.assert_allclose(found.standard_errors, deviations, rtol=1e-5)
    assert found.scale == pytest.approx(scatter, rel=1e-7)


def test_the_curve_of_misra_is_told_to_be_the_wrong_law() -> None:
    """Reject the law for Misra's data.

    The residuals bend over pressure, as the documentation of this data set states.
    """
    parameters = [Parameter("b1", 250.0), Parameter("b2", 5e-4)]
    data = Data(C.MISRA_Y, np.ones(14), {"x": C.MISRA_X}, is_error_known=False)
    assert fit(C.misra, parameters, data, limit=math.inf).tests[0].is_significant


def _coverage(noise: str, count: int, *, is_error_known: bool, temperature_error: float) -> tuple[float, float]:
    """Return the coverage of fits.

    Shares whose region holds the truth, and whose law is called wrong.
    """
    fits = [
        S.fitted(S.NOISES[noise], seed, is_error_known=is_error_known, temperature_error=temperature_error)
        for seed in range(count)
    ]
    inside = np.mean([found.contains(S.TRUTH) for found in fits])
    return float(inside), float(np.mean([any(test.is_significant for test in found.tests) for found in fits]))


@pytest.mark.parametrize("noise", S.NOISES)
def test_the_region_holds_the_truth_in_most_synthetic_fits(noise: str) -> None:
    inside, alarms = _coverage(noise, ORDINARY, is_error_known=True, temperature_error=0.0)
    assert inside >= 0.85  # 0.90 less what 40 samples can miss by chance
    assert alarms <= 0.15


@pytest.mark.full
@pytest.mark.parametrize(
    ("noise", "temperature_error"),
    [
        pytest.param(noise, error, marks=[pytest.mark.slow] * ((noise == "normal") == (error > 0.0)))
        for noise in S.NOISES
        for error in (0.0, 1.0)
    ],
)
def test_the_region_holds_the_truth_in_90_to_99_percent(noise: str, temperature_error: float) -> None:
    inside, alarms = _coverage(noise, 200, is_error_known=True, temperature_error=temperature_error)
    assert 0.90 <= inside <= 0.99
    assert alarms <= 0.05


def test_errors_of_the_temperature_widen_the_region() -> None:
    exact = S.fitted(S.normal, 3, is_error_known=True)
    warm = S.fitted(S.normal, 3, is_error_known=True, temperature_error=2.0)
    assert warm.standard_errors[2] > 1.5 * exact.standard_errors[2]


@pytest.mark.parametrize("noise", S.NOISES)
def test_a_wrong_law_is_detected(noise: str) -> None:
    at = S.plan()
    errors = 0.01 * S.torque(S.TRUTH, at)
    columns = {"speed": at.speed, "load": at.load}
    detected = []
    for seed in range(10):
        values = S.NOISES[noise](np.random.default_rng(seed), S.torque(S.TRUTH, at) + 0.004 * at.speed**1.3, errors)
        found = fit(lambda p: S.torque(p, at), S.PARAMETERS, Data(values, errors, columns))
        detected.append(any(test.is_significant for test in found.tests))
    assert np.mean(detected) >= 0.9


def test_a_pair_that_cannot_be_separated_is_reported_and_not_fitted() -> None:
    at = S.plan()
    true = S.torque(S.TRUTH, at)
    errors = 0.01 * true
    values = S.normal(np.random.default_rng(1), true, errors)
    parameters = [*S.PARAMETERS, Parameter("film factor", 1.0, 0.5, 2.0)]
    found = fit(lambda p: S.torque(np.array([p[0], p[1], p[2] * p[3]]), at), parameters, Data(values, errors))
    assert len(found.held) == 1
    assert found.parameters[found.held[0]].name in ("rolling", "film factor")
    assert set(found.directions[-1].weights) == {"rolling", "film factor"}
    assert not found.directions[-1].is_determined
    held = found.held[0]
    assert found.values[held] == found.parameters[held].start
    assert math.isnan(found.standard_errors[held])


def test_leave_one_out_agrees_with_fits_without_each_point() -> None:
    at = S.plan()
    true = S.torque(S.TRUTH, at)
    errors = 0.01 * true
    values = S.normal(np.random.default_rng(2), true, errors)
    complete = fit(lambda p: S.torque(p, at), S.PARAMETERS, Data(values, errors), limit=math.inf)
    for index in (0, 5, 23):
        kept = np.arange(values.size) != index
        part = S.Conditions(*(column[kept] for column in at))
        without = fit(
            lambda p, part=part: S.torque(p, part), S.PARAMETERS, Data(values[kept], errors[kept]), limit=math.inf
        )
        missed = S.torque(without.values, at)[index] - values[index]
        assert complete.left_out[index] == pytest.approx(missed, rel=0.1, abs=0.1)


def test_values_of_a_point_that_share_an_error_do_not_count_twice() -> None:
    """Compare the covariance with generalised least squares.

    Torque and loss of six points move by 5 % with one temperature, by 1 % alone. As independent errors they gave a
    standard error that was too small by a factor of nearly the square root of two.
    """
    x = np.repeat(np.arange(1.0, 7.0), 2) * np.tile([1.0, 30.0], 6)
    own, moved = 0.01 * x, 0.05 * x
    data = Data(x, own, input_errors=np.ones((12, 1)), points=tuple(np.repeat(np.arange(6), 2).tolist()))
    model, slopes = (lambda p: p[0] * x), (lambda p: moved[:, None])
    found = fit(model, [Parameter("a", 0.9, 0.1, 2.0)], data, input_slopes=slopes, limit=math.inf)
    same = np.kron(np.eye(6), np.ones((2, 2)))
    known = np.diag(own**2) + same * np.outer(moved, moved)
    expected = 1.0 / math.sqrt(x @ np.linalg.solve(known, x))
    assert found.standard_errors[0] == pytest.approx(expected, rel=1e-4)
    assert expected == pytest.approx(math.sqrt((0.05**2 + 0.01**2 / 2) / 6))
    alone = fit(model, [Parameter("a", 0.9, 0.1, 2.0)], replace(data, points=()), input_slopes=slopes, limit=math.inf)
    assert alone.standard_errors[0] < 0.75 * expected


def test_the_region_holds_the_truth_where_quantities_share_an_error() -> None:
    """Draw 100 series of torque and loss.

    One error of temperature moves both.
    """
    x = np.repeat(np.arange(1.0, 13.0), 2) * np.tile([1.0, 30.0], 12)
    points = tuple(np.repeat(np.arange(12), 2).tolist())
    inside = []
    for seed in range(100):
        random = np.random.default_rng(seed)
        warm = 0.05 * np.repeat(random.standard_normal(12), 2)
        data = Data(
            x * (1.0 + warm + 0.01 * random.standard_normal(24)), 0.01 * x, input_errors=np.ones((24, 1)), points=points
        )
        found = fit(lambda p: p[0] * x, [Parameter("a", 0.9, 0.1, 2.0)], data, input_slopes=lambda p: 0.05 * x[:, None])
        inside.append(found.contains(np.array([1.0])))
    assert 0.88 <= np.mean(inside) <= 0.99


def _thermometer(told: str, seed: int) -> Fit:
    """Fit torques with a thermometer wrong by 3 K."""
    return S.fitted(S.normal, seed, is_error_known=True, common_error=3.0, is_told=told == "common")


@pytest.mark.parametrize(("told", "least", "most"), [("common", 0.85, 1.0), ("each", 0.0, 0.7)])
def test_the_region_holds_the_truth_where_points_share_an_error(told: str, least: float, most: float) -> None:
    """Draw 40 series with a thermometer that is wrong.

    Its error counts as one of all points, or as independent ones: these promise too much.
    """
    inside = np.mean([_thermometer(told, seed).contains(S.TRUTH) for seed in range(ORDINARY)])
    assert least <= inside <= most


def test_an_error_that_all_points_share_is_exact() -> None:
    """Compare the covariance with generalised least squares.

    Each temperature has an error of its own and one in common.
    """
    x = np.arange(1.0, 13.0)
    own, alone, common = 0.01 * x, 0.02 * x, 0.05 * np.sqrt(x)
    slopes = np.stack([alone, common], axis=1)
    first, second = np.tile([1.0, 0.0], (12, 1)), np.tile([0.0, 1.0], (12, 1))
    data = Data(x, own, input_errors=first, points=tuple(range(12)), common_errors=second)
    found = fit(
        lambda p: p[0] * x, [Parameter("a", 0.9, 0.1, 2.0)], data, input_slopes=lambda p: slopes, limit=math.inf
    )
    known = np.diag(own**2 + alone**2) + np.outer(common, common)
    assert found.standard_errors[0] == pytest.approx(1.0 / math.sqrt(x @ np.linalg.solve(known, x)), rel=1e-4)


def test_a_point_left_out_takes_the_common_error_of_the_others() -> None:
    """Compare it with the best prediction from the others.

    That of correlated errors is x' b + k' K^-1 (y - X b) (Goldberger 1962, J. Am. Stat. Assoc. 57, 369).
    """
    x, random = np.arange(1.0, 13.0), np.random.default_rng(5)
    common = 0.2 * np.sqrt(x)
    y = x + common * random.standard_normal() + 0.01 * x * random.standard_normal(12)
    known = np.diag((0.01 * x) ** 2) + np.outer(common, common)
    data = Data(y, 0.01 * x, input_errors=np.zeros((12, 1)), common_errors=np.ones((12, 1)))
    found = fit(
        lambda p: p[0] * x,
        [Parameter("a", 0.9, 0.1, 2.0)],
        data,
        input_slopes=lambda p: common[:, None],
        limit=math.inf,
    )
    for index in (0, 7):
        kept = np.arange(12) != index
        inverse = np.linalg.inv(known[np.ix_(kept, kept)])
        best = float(x[kept] @ inverse @ y[kept] / (x[kept] @ inverse @ x[kept]))
        value = x[index] * best + known[index, kept] @ inverse @ (y[kept] - x[kept] * best)
        assert found.left_out[index] == pytest.approx(value - y[index], rel=1e-3)


def test_leave_one_out_leaves_all_values_of_a_point_out() -> None:
    """Compare it with fits without each point.

    A point has two values with a shared error.
    """
    at, random = S.plan(), np.random.default_rng(2)
    true = np.repeat(S.torque(S.TRUTH, at), 2)
    points = np.repeat(np.arange(24), 2)
    moved = 0.02 * true[:, None]
    values = true * (1.0 + 0.01 * random.standard_normal(48) + np.repeat(0.02 * random.standard_normal(24), 2))

    def fitted(kept: NDArray[np.bool_]) -> Fit:
        data = Data(
            values[kept],
            0.01 * true[kept],
            input_errors=np.ones((int(kept.sum()), 1)),
            points=tuple(points[kept].tolist()),
        )

        def model(p: FloatArray) -> FloatArray:
            return np.repeat(S.torque(p, at), 2)[kept]

        return fit(model, S.PARAMETERS, data, input_slopes=lambda p: moved[kept], limit=math.inf)

    complete = fitted(np.ones(48, bool))
    for index in (0, 10, 46):
        without = fitted(points != points[index])
        missed = np.repeat(S.torque(without.values, at), 2)[index] - values[index]
        assert complete.left_out[index] == pytest.approx(missed, rel=0.1, abs=0.1)


def test_an_outlier_is_named_and_hardly_moves_the_fit() -> None:
    at = S.plan()
    true = S.torque(S.TRUTH, at)
    errors = 0.01 * true
    values = S.normal(np.random.default_rng(4), true, errors)
    clean = fit(lambda p: S.torque(p, at), S.PARAMETERS, Data(values, errors))
    values[7] *= 1.5
    spoiled = fit(lambda p: S.torque(p, at), S.PARAMETERS, Data(values, errors))
    assert spoiled.outliers == [7]
    assert np.all(np.abs(spoiled.values - clean.values) < 2.0 * clean.standard_errors)


def test_an_outlier_with_large_slopes_determines_nothing() -> None:
    """Pull a parameter to its limit by one wrong point.

    Its slope of 1e6 gave 0.02 an error of 1.2e-6 although ten right points say 0.04.
    """
    slopes = np.array([*[1000.0] * 10, 1e6])
    values = np.array([*40.0 + np.linspace(-1.5, 1.5, 10), 40.0])
    found = fit(lambda p: p[0] * slopes, [Parameter("loss", 0.03, 0.02, 0.06)], Data(values, 0.03 * values))
    assert found.outliers[-1] == 10
    assert found.values[0] == pytest.approx(0.02)
    assert found.contains(np.array([0.04]))
    assert "determine loss" not in sentence(found)
    assert found.posterior[0, 0] > 0.005**2


def test_the_information_counts_the_weights_of_residuals() -> None:
    """Compare it with Huber and Ronchetti 2009, eq. 7.83."""
    random = np.random.default_rng(1)
    jacobian, weights = random.standard_normal((9, 2)), random.uniform(0.1, 1.0, 9)
    own = counted(jacobian, weights)
    square, part = jacobian.T @ jacobian, jacobian.T @ np.diag(weights / weights.mean()) @ jacobian
    np.testing.assert_allclose(own.T @ own, part @ np.linalg.inv(square) @ part)
    np.testing.assert_allclose(counted(jacobian, 0.3 * np.ones(9)).T @ counted(jacobian, np.ones(9)), square)


def test_bands_hold_new_measurements() -> None:
    at = S.plan()
    true = S.torque(S.TRUTH, at)
    inside = []
    for seed in range(20):
        found = S.fitted(S.normal, seed, is_error_known=True)
        fresh = S.normal(np.random.default_rng(1000 + seed), true, found.data.errors)
        half = found.quantile(0.9) * found.prediction_deviation(found.jacobian, found.data.errors)
        inside.append(np.abs(fresh - found.predicted) < half)
    assert 0.85 <= np.mean(inside) <= 0.95


def test_an_interruption_keeps_the_best_values_so_far() -> None:
    at, calls = S.plan(), []
    true = S.torque(S.TRUTH, at)

    def model(values: FloatArray) -> FloatArray:
        calls.append(values)
        if len(calls) > 20:
            raise KeyboardInterrupt
        return S.torque(values, at)

    found = fit(model, S.PARAMETERS, Data(true, 0.01 * true))
    before = S.torque(np.array([p.start for p in S.PARAMETERS]), at)
    assert found.is_interrupted
    assert np.abs(found.predicted - true).sum() < 0.1 * np.abs(before - true).sum()


def test_an_interruption_before_any_values_ends_at_once() -> None:
    """Solve no further points after Ctrl+C.

    The rest of the first pass over all rows was solved for values that were not fitted.
    """
    calls: list[FloatArray] = []

    def model(values: FloatArray) -> FloatArray:
        calls.append(values)
        raise KeyboardInterrupt

    true = S.torque(S.TRUTH, S.plan())
    with pytest.raises(KeyboardInterrupt):
        fit(model, S.PARAMETERS, Data(true, 0.01 * true))
    assert len(calls) == 1


def test_the_next_point_separates_what_the_data_do_not() -> None:
    """Propose another speed to separate two powers of it.

    The data were measured at nearly one speed.
    """
    speed = np.array([100.0, 100.5, 101.0])
    powers = np.column_stack([speed**0.6, speed**0.7])
    offered = np.array([100.0, 101.0, 1000.0])
    parameters = [Parameter("a", 1.0, 0.5, 2.0), Parameter("b", 1.0, 0.5, 2.0)]
    found = next_point(powers, np.column_stack([offered**0.6, offered**0.7]), parameters)
    assert found.index == 2
    assert found.after < 0.6 * found.before
    assert set(found.worst.weights) == {"a", "b"}


@pytest.mark.parametrize("factor", [1.0, 4.0])
def test_a_second_measurement_tells_as_much_as_the_first(factor: float) -> None:
    """Widen the new point's error as those of the others."""
    found = next_point(np.ones((1, 1)), np.ones((1, 1)), [Parameter("a", 1.0, 0.5, 2.0)], factor)
    assert found.after**-2 - found.before**-2 == pytest.approx(found.before**-2 - 1.0)


def test_too_few_points_are_refused() -> None:
    with pytest.raises(ValueError, match="vary fewer parameters or add operating points"):
        fit(C.misra, S.PARAMETERS, Data(np.ones(3), np.ones(3)))


def test_the_covariance_counts_free_residuals_and_outliers() -> None:
    """Compare its factor with Huber and Ronchetti 2009, eq. 7.81.

    Of eight residuals and two parameters two lie outside 1.5: K = 1 + 2/8 0.25/0.75 = 13/12.
    """
    residuals = np.array([0.5, -0.5, 0.5, -0.5, 1.0, -1.0, 3.0, -3.0])
    assert robust_factor(residuals, 2, 1.5) == pytest.approx((13 / 12) ** 2 * (7.5 / 6) / 0.75**2)


def test_residuals_all_far_outside_widen_the_errors() -> None:
    """Widen by the size of the residuals."""
    assert robust_factor(np.array([20.0, -20.0] * 4), 2) == pytest.approx(20.0**2 * 8 / 6)


def test_a_trend_of_a_thousand_right_rows_is_as_rare_as_promised() -> None:
    """Draw residuals of a right law over three conditions."""
    found = []
    for seed in range(400):
        random = np.random.default_rng(seed)
        jacobian, residuals = random.uniform(0.2, 1.0, (1000, 1)), random.standard_normal(1000)
        residuals -= jacobian[:, 0] * (jacobian[:, 0] @ residuals) / (jacobian[:, 0] @ jacobian[:, 0])
        columns = 10.0 ** random.uniform(0.0, 2.0, (3, 1000))
        found += [trend_test(residuals, jacobian, column, is_error_known=False) for column in columns]
    assert 0.03 < np.mean(np.array(found) < 0.05) < 0.07
    assert np.mean(np.array(found) < 0.01) < 0.02
