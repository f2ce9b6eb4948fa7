"""Compare samples of the posterior with theory."""

from __future__ import annotations

import sys

import numpy as np
import pytest

from lambda_core import api
from lambda_core.domain.errors import UsageError
from lambda_core.fitting.least_squares import Data, fit
from lambda_core.fitting.measurements import parse_measurements
from lambda_core.fitting.parameters import Parameter
from lambda_core.fitting.sampling import _corners, sample

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
    np.testing.assert_allclose(drawn.samples.std(axis=0) / deviation, 1.0, atol=0.15)


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
    density = np.exp(-0.5 * ((x - 1.2) / 0.2) ** 2 / found.factor)
    assert drawn.mean() == pytest.approx(float((x * density).sum() / density.sum()), abs=0.01)


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
