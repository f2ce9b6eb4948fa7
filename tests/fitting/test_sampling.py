"""Compare samples of the posterior with theory."""

from __future__ import annotations

import sys

import numpy as np
import pytest
from scipy.special import huber
from scipy.stats import norm

from lambda_core import api
from lambda_core.domain.errors import UsageError
from lambda_core.fitting.data import Data
from lambda_core.fitting.least_squares import fit
from lambda_core.fitting.measurements import parse_measurements
from lambda_core.fitting.parameters import Parameter
from lambda_core.fitting.sampling import _corners, loss_share, sample

from . import synthetic as S

CASE = "6319-cp10-1500"
MEASURED = "speed [1/min],friction torque [N mm],friction torque error [%]\n500,925,3\n1500,1306,3\n3000,1564,3"


def test_samples_of_a_well_determined_fit_are_those_of_its_covariance() -> None:
    pytest.importorskip("emcee")
    found = S.fitted(S.normal, 5, is_error_known=True)
    drawn = sample(lambda p: S.torque(p, S.plan()), found, 4000)
    assert drawn.interpolation_error < 0.2
    assert drawn.effective > 1000
    deviation = np.sqrt(np.diag(found.covariance))
    np.testing.assert_allclose((drawn.samples.mean(axis=0) - found.values) / deviation, 0.0, atol=0.3)
    np.testing.assert_allclose(drawn.samples.std(axis=0) / deviation, 1.0, atol=0.1)


def test_samples_stay_within_the_range_and_lean_on_its_end() -> None:
    """Sample a density that falls from the range's end.

    The data want 1.2, the range ends at 1: exp(-(x - 1.2)^2/(2 0.2^2)) below 1.
    """
    pytest.importorskip("emcee")
    data = Data(np.full(4, 1.2), np.full(4, 0.4))
    found = fit(lambda p: np.full(4, p[0]), [Parameter("x", 0.5, 0.0, 1.0)], data)
    drawn = sample(lambda p: np.full(4, p[0]), found, 4000).samples[:, 0]
    assert drawn.max() <= 1.0
    x = np.linspace(0.0, 1.0, 2001)
    density = np.exp(-0.5 * ((x - 1.2) / 0.2) ** 2 * loss_share(found))
    assert drawn.mean() == pytest.approx(float((x * density).sum() / density.sum()), abs=0.01)


def test_an_outlier_counts_in_the_samples_as_in_the_fit() -> None:
    """Sample a constant of 24 values with one outlier.

    One normal value of 24 is moved by ten errors. Samples were 15 % wider than the fit: the loss counted 1/factor,
    though its curvature is below one.
    """
    pytest.importorskip("emcee")
    values = 5.0 + 0.1 * norm.ppf((np.arange(24) + 0.5) / 24)
    values[12] += 1.0
    data = Data(values, np.full(24, 0.1))
    found = fit(lambda p: np.full(24, p[0]), [Parameter("x", 4.0, 0.0, 10.0)], data)
    drawn = sample(lambda p: np.full(24, p[0]), found, 20000).samples[:, 0]
    assert drawn.mean() == pytest.approx(found.values[0], abs=0.1 * found.standard_errors[0])
    assert drawn.std() == pytest.approx(found.standard_errors[0], rel=0.05)
    assert values.mean() > found.values[0] + found.standard_errors[0]  # where normal errors would lie
    x = np.linspace(4.8, 5.3, 2001)
    loss = huber(1.345, (values - x[:, None]) / 0.1).sum(axis=1)
    density = np.exp(-loss_share(found) * loss)
    low, high = np.interp([0.025, 0.975], np.cumsum(density) / density.sum(), x)
    assert np.quantile(drawn, [0.025, 0.975]) == pytest.approx([low, high], abs=0.1 * found.standard_errors[0])


def test_residuals_that_are_all_large_keep_the_samples_wide() -> None:
    """Sample a constant with errors ten times too small."""
    pytest.importorskip("emcee")
    values = 5.0 + norm.ppf((np.arange(24) + 0.5) / 24)
    found = fit(lambda p: np.full(24, p[0]), [Parameter("x", 4.0, 0.0, 10.0)], Data(values, np.full(24, 0.1)))
    drawn = sample(lambda p: np.full(24, p[0]), found, 4000).samples[:, 0]
    assert drawn.std() == pytest.approx(1.0 / np.sqrt(24), rel=0.4)


@pytest.mark.parametrize(("count", "corners"), [(1, 2), (2, 4), (3, 8), (4, 16), (7, 16), (12, 32)])
def test_corners_stay_few_and_see_every_parameter(count: int, corners: int) -> None:
    """Balance the columns of the corners.

    No product of two columns equals a third, so that pairs are not taken for single parameters.
    """
    found = _corners(count)
    assert found.shape == (corners, count)
    signs = 2.0 * found - 1.0
    assert np.all(np.abs(signs) == 1.0)
    assert np.all(signs.sum(axis=0) == 0.0)
    assert np.array_equal(signs.T @ signs, corners * np.eye(count))
    for i in range(count):
        for j in range(i):
            assert np.all((signs[:, i] * signs[:, j]) @ signs == 0.0)


@pytest.mark.full
def test_a_fit_of_a_case_tells_its_samples() -> None:
    pytest.importorskip("emcee")
    report = api.fit(CASE, parse_measurements(MEASURED, "rig.csv"), ["loss_factor"], suggest=False, sample=500)
    assert report.posterior is not None
    (one,) = report.posterior.parameters
    assert len(one.samples) == 500
    low, high = one.interval_95
    assert 0.02 <= low < one.median < high <= 0.047
    assert "posterior, 500 samples" in report.text()


def test_what_is_missing_or_wrong_is_one_sentence(monkeypatch: pytest.MonkeyPatch) -> None:
    measured = parse_measurements(MEASURED, "rig.csv")
    with pytest.raises(UsageError, match=r"^sample -1.*from 1 to 100000"):
        api.fit(CASE, measured, ["loss_factor"], sample=-1)
    monkeypatch.setitem(sys.modules, "emcee", None)
    with pytest.raises(UsageError, match=r'pip install "lambda-bearing\[sampling\]"'):
        api.fit(CASE, measured, ["loss_factor"], sample=10)
