"""Test residuals for patterns that a wrong law leaves."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from lambda_core.domain.arrays import FloatArray

SIGNIFICANT = 0.05
_CHANCE = 1e-3  # p-value above which chance may explain large residuals
_MEDIAN = 0.6745  # of the size of a normal deviate


@dataclass(frozen=True)
class ResidualTest:
    """One test of the residuals.

    Attributes
    ----------
    name : str
        What is tested.
    p_value : float
        Probability of a pattern at least as clear by chance, where the law is right.
    adjusted : float
        The same with all tests of the fit taken into account (Holm 1979).
    """

    name: str
    p_value: float
    adjusted: float = math.nan

    @property
    def is_significant(self) -> bool:
        """Tell whether the residuals speak against the law."""
        return self.adjusted < SIGNIFICANT


def runs_test(residuals: FloatArray) -> float:
    """Return the p-value of too few sign changes.

    The residuals are ordered.

    References
    ----------
    Wald and Wolfowitz 1940, Ann. Math. Statist. 11, 147: exact distribution of the number of runs.
    """
    signs = residuals > 0.0
    above, below = int(signs.sum()), int((~signs).sum())
    if min(above, below) == 0:
        return 2.0 * 0.5**residuals.size if residuals.size > 1 else 1.0
    runs = 1 + int(np.sum(signs[1:] != signs[:-1]))
    total = math.comb(above + below, above)
    return min(1.0, sum(_ways(count, above, below) for count in range(2, runs + 1)) / total)


def _ways(runs: int, above: int, below: int) -> int:
    """Count the sign orders with so many runs."""
    half, odd = divmod(runs, 2)
    if not odd:
        return 2 * math.comb(above - 1, half - 1) * math.comb(below - 1, half - 1)
    return math.comb(above - 1, half) * math.comb(below - 1, half - 1) + math.comb(above - 1, half - 1) * math.comb(
        below - 1, half
    )


def trend_test(residuals: FloatArray, jacobian: FloatArray, column: FloatArray, *, is_error_known: bool) -> float:
    """Return the p-value of a residual trend.

    A trend has a constant, a linear and a quadratic part over a column.

    Parameters
    ----------
    residuals : float64[:], shape (n,)
        In units of their errors.
    jacobian : float64[:, :], shape (n, p)
        Of the fit: what the parameters could still take up is removed first.
    column : float64[:], shape (n,)
        Speed, load or temperature; its logarithm is taken where all values are above zero.
    is_error_known : bool
        Whether the errors of the measurement are known; otherwise the residuals estimate them.

    References
    ----------
    Regression specification error test of added powers: Ramsey 1969, J. R. Statist. Soc. B 31, 350.
    """
    from scipy.stats import chi2, f

    x = np.log(column) if np.all(column > 0.0) else column
    if np.ptp(x) <= 1e-9 * max(1.0, float(np.abs(x).max())):
        return math.nan
    x = (x - x.mean()) / x.std()
    powers = np.column_stack([x**power for power in range(min(3, np.unique(x).size))])
    basis, _ = np.linalg.qr(jacobian)
    added = powers - basis @ (basis.T @ powers)
    left, sizes, _ = np.linalg.svd(added, full_matrices=False)
    left = left[:, sizes > 1e-6 * math.sqrt(x.size)]
    own = residuals - basis @ (basis.T @ residuals)
    gain = float(np.sum((left.T @ own) ** 2))
    terms, rest = left.shape[1], residuals.size - basis.shape[1] - left.shape[1]
    if terms == 0:
        return math.nan
    if is_error_known:
        return float(chi2.sf(gain, terms))
    if rest < 1:
        return math.nan
    remaining = max(float(np.sum(own**2)) - gain, 1e-300)
    return float(f.sf(gain / terms / (remaining / rest), terms, rest))


def scatter_test(residuals: FloatArray, count: int) -> float:
    """Return the p-value of the residuals' scatter.

    They may be larger than their stated errors; chi-square with n - p degrees of freedom.
    """
    from scipy.stats import chi2

    free = residuals.size - count
    return float(chi2.sf(float(np.sum(residuals**2)), free)) if free > 0 else math.nan


def misfit(residuals: FloatArray, count: int) -> float:
    """Return how many times larger residuals are than errors.

    0 where chance explains it: chi-square with n - p degrees of freedom (p below 0.001), and the median of the
    residuals' sizes, which single outliers do not raise, over that of a normal distribution.
    """
    if not scatter_test(residuals, count) < _CHANCE:
        return 0.0
    typical = float(np.median(np.abs(residuals))) / _MEDIAN * math.sqrt(residuals.size / (residuals.size - count))
    return typical if typical > 1.0 else 0.0


def residual_tests(
    residuals: FloatArray, jacobian: FloatArray, columns: Mapping[str, FloatArray], *, is_error_known: bool
) -> list[ResidualTest]:
    """Run every test over every column, the clearest pattern first.

    Parameters
    ----------
    residuals : float64[:], shape (n,)
        In units of their errors, robustly limited by the caller where outliers are expected.
    jacobian : float64[:, :], shape (n, p)
        Of the fit, in the same units.
    columns : mapping of str to float64[:]
        Operating conditions.

    References
    ----------
    Adjustment for the number of tests: Holm 1979, Scand. J. Statist. 6, 65.
    """
    found = []
    for name, column in columns.items():
        if np.unique(column).size < 3:
            p = trend_test(residuals, jacobian, column, is_error_known=is_error_known)
            found.append(ResidualTest(f"trend over {name}", p))
            continue
        order = np.argsort(column, kind="stable")
        found.append(ResidualTest(f"trend over {name}", trend_test(
            residuals, jacobian, column, is_error_known=is_error_known)))  # fmt: skip
        if np.unique(column).size == column.size:  # equal values have no order
            found.append(ResidualTest(f"runs over {name}", runs_test(residuals[order])))
    if is_error_known:
        found.append(ResidualTest("scatter", scatter_test(residuals, jacobian.shape[1])))
    return adjusted([test for test in found if not math.isnan(test.p_value)])


def adjusted(tests: Sequence[ResidualTest]) -> list[ResidualTest]:
    """Return the tests with Holm's adjusted p-values, the smallest first."""
    ordered = sorted(tests, key=lambda test: test.p_value)
    found, largest = [], 0.0
    for rank, test in enumerate(ordered):
        largest = max(largest, min(1.0, (len(ordered) - rank) * test.p_value))
        found.append(ResidualTest(test.name, test.p_value, largest))
    return found
