"""Hold measured values with their errors."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from lambda_core.domain.arrays import FloatArray

_SMALLEST_SHARE = 1e-3  # of the median value, which proportional errors do not go below


@dataclass(frozen=True)
class Data:
    """Measured values with their errors.

    Attributes
    ----------
    values : float64[:], shape (n,)
        Measured values.
    errors : float64[:], shape (n,)
        Standard deviations; where `is_error_known` is False only their ratios count.
    columns : mapping of str to float64[:]
        Operating conditions, for tests of the residuals.
    input_errors : float64[:, :], shape (n, k)
        Standard deviations of k operating conditions at each point alone; empty where they are exact.
    is_error_known : bool
        Whether the size of the errors is known; otherwise the scatter of the residuals gives it.
    is_proportional : bool
        Whether `errors` are shares of the predicted values. Shares of the measured ones would tie errors to noise.
    points : tuple of int
        Operating point of each value; values of one point share the errors of its conditions. Each its own if empty.
    common_errors : float64[:, :], shape (n, k)
        Standard deviations of the errors that the same conditions have in common at all points; empty for none.
    value_errors, value_shares : float64[:, :], shape (n, q)
        Standard deviations of the errors that values of one quantity have in common, a column for each such error,
        and the same as shares of the predicted values; empty for none. Shares of the measured ones would make fits
        too small (D'Agostini 1994, Nucl. Instrum. Methods A 346, 306).
    """

    values: FloatArray
    errors: FloatArray
    columns: Mapping[str, FloatArray] = field(default_factory=dict)
    input_errors: FloatArray = field(default_factory=lambda: np.zeros((0, 0)))
    is_error_known: bool = True
    is_proportional: bool = False
    points: tuple[int, ...] = ()
    common_errors: FloatArray = field(default_factory=lambda: np.zeros((0, 0)))
    value_errors: FloatArray = field(default_factory=lambda: np.zeros((0, 0)))
    value_shares: FloatArray = field(default_factory=lambda: np.zeros((0, 0)))

    def absolute(self, predicted: FloatArray) -> FloatArray:
        """Return the errors in the unit of the values."""
        if not self.is_proportional:
            return self.errors
        size = np.abs(predicted)
        found: FloatArray = self.errors * np.maximum(size, _SMALLEST_SHARE * float(np.median(size)))
        return found

    def moved(self, slopes: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return what errors of the conditions change.

        The first array has the errors of each point alone, the second those in common, shape (n, k).

        Parameters
        ----------
        slopes : float64[:, :], shape (n, k)
            Derivatives of the predicted values by the conditions.
        """
        common = self.common_errors if self.common_errors.size else np.zeros_like(self.input_errors)
        return slopes * self.input_errors, slopes * common

    def offsets(self, predicted: FloatArray) -> FloatArray:
        """Return what common errors of values change, shape (n, q)."""
        if not self.value_errors.size:
            return np.zeros((self.values.size, 0))
        found: FloatArray = self.value_errors + self.value_shares * predicted[:, None]
        return found

    @property
    def groups(self) -> list[NDArray[np.int64]]:
        """Values of each operating point."""
        if not self.points:
            return list(np.arange(self.values.size)[:, None])
        points = np.array(self.points)
        order = np.argsort(points, kind="stable")
        return np.split(order, np.flatnonzero(np.diff(points[order])) + 1)
