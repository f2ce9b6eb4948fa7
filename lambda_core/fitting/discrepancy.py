"""Model the errors of laws in a fit.

A fit finds the best values of its parameters under laws that are not exact. Measured values are taken as

    measured = predicted (1 + d) + error,

with a relative discrepancy d that changes smoothly with the operating conditions: a Gaussian process. How large it may
be is known before the measurements: as large as the model band of all that is not fitted. How far it reaches is not
known. Both are averaged over, weighted by what the residuals say.

References
----------
Kennedy and O'Hagan 2001, J. R. Statist. Soc. B 63, 425 (model discrepancy as a Gaussian process); Brynjarsdottir and
O'Hagan 2014, Inverse Problems 30, 114007 (its size needs prior knowledge); Gelman 2006, Bayesian Analysis 1, 515
(half-normal prior of a standard deviation); Quinonero-Candela and Rasmussen 2005, J. Mach. Learn. Res. 6, 1939
(a subset of the values in place of all).
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from lambda_core.analysis.band.neighbours import spread_out
from lambda_core.domain.arrays import FloatArray
from lambda_core.fitting.parameters import Parameter
from lambda_core.fitting.shared_errors import SharedErrors

# Sizes over that known beforehand: midpoints of equally likely parts of a half-normal distribution.
_PARTS = 12
_MOST = 200  # measured values that decide the errors of laws: the work grows with the third power
# Reach in ratios of conditions, e-folds: laws of friction and film are powers of speed and load, so an error of a law
# changes by its own size over about one. Log-uniform over a factor of four both ways.
_REACHES = (0.25, 0.5, 1.0, 2.0, 4.0)
_MARGIN = 0.05  # e-folds beyond the range of measured conditions that still count as inside
_APART = SharedErrors()
_LEAST_ERROR = 1e-6  # of a measured value
_CONDITIONS = ("speed", "radial load", "axial load", "moment y", "moment z")  # over which it changes


@dataclass(frozen=True)
class Place:
    """Place of a predicted value.

    Attributes
    ----------
    predicted : float64[:], shape (n,)
        By the fitted values.
    jacobian : float64[:, :], shape (n, p)
        Derivatives by the parameters.
    coordinates : float64[:, :], shape (n, d)
        See :func:`coordinates`.
    kinds : tuple of str
        Quantity of each value; discrepancies of different ones are independent.
    sizes : float64[:], shape (n,)
        Relative standard deviation of the discrepancy that is known beforehand.
    """

    predicted: FloatArray
    jacobian: FloatArray
    coordinates: FloatArray
    kinds: tuple[str, ...]
    sizes: FloatArray


def coordinates(conditions: Sequence[Mapping[str, float]]) -> FloatArray:
    """Return the conditions of a discrepancy.

    It changes with them; shape (n, d): logarithms of speeds and loads.

    A load that is zero somewhere counts in units of the largest one. Over other conditions the discrepancy is constant.
    """
    columns = []
    for name in _CONDITIONS:
        if not all(name in one for one in conditions):
            continue
        column = np.abs([one[name] for one in conditions])
        largest = float(column.max(initial=0.0))
        if largest > 0.0:
            columns.append(np.log(column) if np.all(column > 0.0) else column / largest)
    return np.column_stack(columns) if columns else np.zeros((len(conditions), 1))


@dataclass(frozen=True)
class Prediction:
    """Values predicted with discrepancy.

    It is a mixture of normal distributions, one for each size and reach.

    Attributes
    ----------
    weights : float64[:], shape (m,)
    means, deviations : float64[:, :], shape (m, n)
    """

    weights: FloatArray
    means: FloatArray
    deviations: FloatArray

    @property
    def mean(self) -> FloatArray:
        """Mean of each value."""
        found: FloatArray = self.weights @ self.means
        return found

    def band(self, coverage: float = 0.95) -> FloatArray:
        """Return both ends of each value's band.

        The array has shape (n, 2).
        """
        tail = 0.5 * (1.0 - coverage)
        return np.column_stack([self._quantile(tail), self._quantile(1.0 - tail)])

    def _quantile(self, share: float) -> FloatArray:
        """Return a quantile of each mixture by bisection."""
        from scipy.special import ndtr

        width = 40.0 * self.deviations.max(axis=0)
        low, high = self.means.min(axis=0) - width, self.means.max(axis=0) + width
        for _ in range(80):
            middle = 0.5 * (low + high)
            below = self.weights @ ndtr((middle - self.means) / np.maximum(self.deviations, 1e-300)) < share
            low, high = np.where(below, middle, low), np.where(below, high, middle)
        found: FloatArray = 0.5 * (low + high)
        return found


def predict(
    parameters: Sequence[Parameter],
    values: FloatArray,
    measured: FloatArray,
    errors: FloatArray,
    at: Place,
    asked: Place,
    asked_errors: FloatArray | float = 0.0,
    shared: SharedErrors = _APART,
    shared_with: FloatArray | float = 0.0,
) -> Prediction:
    """Predict values with their errors.

    They are errors of the parameters and of the laws.

    Parameters
    ----------
    parameters : sequence of Parameter
        Those of the fit; each is known beforehand as uniform over its range, taken as normal.
    values : float64[:], shape (p,)
        Fitted ones, around which the model is taken as linear.
    measured, errors : float64[:], shape (n,)
        Measured values and their standard deviations.
    at : Place
        Where was measured.
    asked : Place
        Where values are wanted.
    asked_errors : float64[:] or float
        Standard deviations of new measurements there; 0 for the true values.
    shared : SharedErrors
        What the errors of measured values have in common.
    shared_with : float64[:, :], shape (n, m)
        Covariance of these errors with those of the new measurements.

    Returns
    -------
    Prediction
    """
    from scipy.linalg import solve_triangular

    shared_with = np.broadcast_to(shared_with, (measured.size, asked.predicted.size))
    if measured.size > _MOST:
        rows = _far_apart(at.coordinates)
        at, measured, errors, shared = _rows(at, rows), measured[rows], errors[rows], shared.among(rows)
        shared_with = shared_with[rows]
    before, spread = _known_before(parameters)
    offset = before - values
    both = _joined(at, asked)
    # points that are fitted exactly still have a covariance
    floor = _LEAST_ERROR * np.maximum(np.abs(measured), _LEAST_ERROR * np.abs(measured).max())
    count = measured.size
    mean = both.predicted + both.jacobian @ offset
    linear = both.jacobian * spread
    known = linear[:count] @ linear.T
    known[:, :count] += shared.covariance(np.maximum(errors, floor))
    known[:, count:] += shared_with
    size = np.abs(both.predicted) * both.sizes
    apart = _beyond(at.coordinates, asked.coordinates)[:count]
    products = np.outer(size[:count], size)
    alone, own_size = np.sum(linear[count:] ** 2, axis=1) + np.asarray(asked_errors) ** 2, size[count:] ** 2
    residual = measured - mean[:count]
    logs, means, deviations = [], [], []
    factors, every_reach = _grid(both.coordinates.shape[1])
    for reaches in every_reach:
        kernel = products * np.where(apart, 0.0, _kernel(both, count, reaches))
        for factor in factors:
            total = known + factor**2 * kernel
            own = np.linalg.cholesky(total[:, :count])
            whitened = solve_triangular(own, np.column_stack([residual, total[:, count:]]), lower=True)
            logs.append(-0.5 * float(whitened[:, 0] @ whitened[:, 0]) - float(np.log(np.diag(own)).sum()))
            means.append(mean[count:] + whitened[:, 1:].T @ whitened[:, 0])
            variance = alone + factor**2 * own_size - np.sum(whitened[:, 1:] ** 2, axis=0)
            deviations.append(np.sqrt(np.maximum(variance, 0.0)))
    weights = np.exp(np.array(logs) - max(logs))
    return Prediction(weights / weights.sum(), np.array(means), np.array(deviations))


def _far_apart(places: FloatArray) -> NDArray[np.int64]:
    """Return the rows that decide the errors of laws.

    First those that lie far apart, then, where places repeat, others at even distances.
    """
    chosen = spread_out(places, _MOST)
    others = np.setdiff1d(np.arange(len(places)), chosen)
    more = others[np.linspace(0, others.size - 1, _MOST - len(chosen)).astype(np.int64)]
    return np.sort(np.concatenate([np.array(chosen, dtype=np.int64), more]))


def _rows(place: Place, rows: NDArray[np.int64]) -> Place:
    kinds = tuple(place.kinds[row] for row in rows)
    return Place(place.predicted[rows], place.jacobian[rows], place.coordinates[rows], kinds, place.sizes[rows])


def _known_before(parameters: Sequence[Parameter]) -> tuple[FloatArray, FloatArray]:
    """Return the prior of the parameters.

    It consists of means and standard deviations before the measurements.
    """
    means = [
        0.5 * (p.low + p.high) if math.isfinite(p.high - p.low) and not p.is_prior else p.start for p in parameters
    ]
    return np.array(means), np.array([p.spread for p in parameters])


def _joined(one: Place, other: Place) -> Place:
    return Place(
        np.concatenate([one.predicted, other.predicted]),
        np.vstack([one.jacobian, other.jacobian]),
        np.vstack([one.coordinates, other.coordinates]),
        (*one.kinds, *other.kinds),
        np.concatenate([one.sizes, other.sizes]),
    )


def _beyond(measured: FloatArray, asked: FloatArray) -> NDArray[np.bool_]:
    """Mark the pairs that extrapolate.

    A pair extrapolates where one lies outside the range of measured conditions and the other was measured. The shape is
    (n, n).

    Outside, what residuals say of the laws' errors is no evidence: there the discrepancy is as unknown as before.
    """
    low, high = measured.min(axis=0) - _MARGIN, measured.max(axis=0) + _MARGIN
    outside = np.concatenate([np.zeros(len(measured), bool), np.any((asked < low) | (asked > high), axis=1)])
    inside = np.concatenate([np.ones(len(measured), bool), np.zeros(len(asked), bool)])
    found: NDArray[np.bool_] = (outside[:, None] & inside) | (inside[:, None] & outside)
    return found


def _grid(dimensions: int) -> tuple[list[float], list[FloatArray]]:
    """Return sizes and reaches of the discrepancy.

    Sizes are relative to those known beforehand. Each condition has a reach, and errors of different laws have both.
    """
    from scipy.special import ndtri

    middles = (np.arange(_PARTS) + 0.5) / _PARTS
    reaches = [np.array(each) for each in itertools.product(_REACHES, repeat=dimensions)]
    return ndtri(0.5 + 0.5 * middles).tolist(), reaches


def _kernel(place: Place, count: int, reaches: FloatArray) -> FloatArray:
    """Return correlations of the first values with all.

    They are squared exponentials, and 0 between different quantities.
    """
    scaled = place.coordinates / reaches
    apart = np.sum((scaled[:count, None, :] - scaled[None, :, :]) ** 2, axis=-1)
    kinds = np.unique(np.array(place.kinds), return_inverse=True)[1]
    found: FloatArray = np.where(kinds[:count, None] == kinds[None, :], np.exp(-0.5 * apart), 0.0)
    return found


def sizes_known_before(
    effects_at: Callable[[int], Mapping[str, float]], predicted: FloatArray, kinds: Sequence[str]
) -> dict[str, float]:
    """Return the prior size of each quantity's discrepancy.

    It is relative, that of the middle one of its values.

    Parameters
    ----------
    effects_at : callable
        Standard deviation of the logarithm of each quantity at the operating point of a value, by all that is not
        fitted.
    """
    found = {}
    for kind in dict.fromkeys(kinds):
        rows = [row for row, own in enumerate(kinds) if own == kind]
        middle = sorted(rows, key=lambda row: float(predicted[row]))[len(rows) // 2]
        found[kind] = effects_at(middle)[kind]
    return found
