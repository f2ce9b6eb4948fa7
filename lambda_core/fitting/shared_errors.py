"""Make errors independent that measured values share.

An error of the oil temperature moves torque and loss of a point together: both do not tell twice what one tells. The
error of a thermometer moves all points together, and that of a torque sensor all torques: values covary by the product
of what a common error does to them (JCGM 100:2008, F.1.2.3). They are combined into as many with independent errors of
size one (Aitken 1936, Proc. R. Soc. Edinb. 55, 42: generalised least squares).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from lambda_core.domain.arrays import FloatArray
from lambda_core.fitting.data import Data
from lambda_core.fitting.uncertainty import huber_weights

LEAST_OWN = 1e-12  # share of a variance that belongs to a value alone: keeps the correlations below one
_ITERATIONS = 20  # of weights that find outliers


@dataclass(frozen=True)
class SharedErrors:
    """Correlations of errors within and between points.

    Attributes
    ----------
    groups : tuple of int64[:]
        Values whose errors are correlated: of each point that has several, or all.
    correlations : tuple of float64[:, :]
        Of their errors.
    """

    groups: tuple[NDArray[np.int64], ...] = ()
    correlations: tuple[FloatArray, ...] = ()

    @classmethod
    def of(
        cls,
        groups: Sequence[NDArray[np.int64]],
        moved: FloatArray,
        common: FloatArray,
        errors: FloatArray,
        residuals: FloatArray | float = 0.0,
    ) -> SharedErrors:
        """Return those by errors of operating conditions.

        Parameters
        ----------
        moved : float64[:, :], shape (n, k)
            Change of each value by the error that each condition has at its point alone.
        common : float64[:, :], shape (n, k)
            Change of each value by the error that a condition has in common at all points.
        errors : float64[:], shape (n,)
            Standard deviations with these changes.
        residuals : float64[:], shape (n,)
            Measured less predicted values. Those that are outliers come last: so they say nothing of the errors in
            common, and keep their size.
        """
        every = [_outliers_last(residuals / errors, common / errors[:, None])] if common.any() else []
        several = tuple(group for group in every or groups if group.size > 1)
        place = np.empty(errors.size, dtype=np.int64)
        for number, group in enumerate(groups):
            place[group] = number
        found = []
        for group in several:
            own, all_of = moved[group] / errors[group, None], common[group] / errors[group, None]
            is_one = place[group, None] == place[group]
            matrix = (1.0 - LEAST_OWN) * (is_one * (own @ own.T) + all_of @ all_of.T)
            np.fill_diagonal(matrix, 1.0)
            found.append(matrix)
        return cls(several, tuple(found))

    @cached_property
    def _roots(self) -> list[tuple[FloatArray, FloatArray]]:
        """Cholesky factors of the correlations, and their inverses.

        Outliers spoil less with them than with symmetric roots, which spread each one over all values.
        """
        found = []
        for matrix in self.correlations:
            root = np.asarray(np.linalg.cholesky(matrix), dtype=np.float64)
            found.append((root, np.asarray(np.linalg.inv(root), dtype=np.float64)))
        return found

    def apart(self, values: FloatArray) -> FloatArray:
        """Return values with independent errors of size one.

        They are given in units of their errors, or their derivatives, shape (n,) or (n, p).
        """
        found = values.copy()
        for group, (_, inverse) in zip(self.groups, self._roots, strict=True):
            found[group] = inverse @ values[group]
        return found

    def together(self, values: FloatArray) -> FloatArray:
        """Undo :meth:`apart`."""
        found = values.copy()
        for group, (root, _) in zip(self.groups, self._roots, strict=True):
            found[group] = root @ values[group]
        return found

    def among(self, rows: NDArray[np.int64]) -> SharedErrors:
        """Return those among some values, sorted."""
        found = [(np.isin(group, rows), group, matrix) for group, matrix in zip(
            self.groups, self.correlations, strict=True)]  # fmt: skip
        return SharedErrors(
            tuple(np.searchsorted(rows, group[kept]) for kept, group, _ in found),
            tuple(matrix[np.ix_(kept, kept)] for kept, _, matrix in found),
        )

    def covariance(self, errors: FloatArray) -> FloatArray:
        """Return the covariance of errors of this size."""
        found = np.diag(errors**2)
        for group, matrix in zip(self.groups, self.correlations, strict=True):
            found[np.ix_(group, group)] = matrix * np.outer(errors[group], errors[group])
        return found


def errors_of(data: Data, predicted: FloatArray, slopes: FloatArray | None) -> tuple[FloatArray, SharedErrors]:
    """Return the errors of measured values and what they share.

    Parameters
    ----------
    predicted : float64[:], shape (n,)
        Values at the present parameters.
    slopes : float64[:, :], shape (n, k)
        Derivatives by the operating conditions that have errors; None where they are exact.

    Returns
    -------
    tuple of (float64[:], SharedErrors)
        Standard deviations with the errors of operating conditions and of instruments.
    """
    own = data.absolute(predicted)
    moved, common = np.zeros((own.size, 0)), data.offsets(predicted)
    if slopes is not None:
        moved, of_all = data.moved(slopes)
        common = np.hstack([of_all, common])
    if not common.size:
        return own, SharedErrors()
    errors: FloatArray = np.sqrt(own**2 + np.sum(moved**2, axis=1) + np.sum(common**2, axis=1))
    return errors, SharedErrors.of(data.groups, moved, common, errors, data.values - predicted)


def _outliers_last(residuals: FloatArray, common: FloatArray) -> NDArray[np.int64]:
    """Return the order of values, outliers last.

    It is that of what the errors in common leave of the residuals. All is in units of the errors. The errors in common
    are Huber's estimate with their size known beforehand, by iterated weights (Holland and Welsch 1977, Commun. Stat. A
    6, 813).
    """
    own = np.sqrt(np.maximum(1.0 - np.sum(common**2, axis=1), LEAST_OWN))
    slopes, left = common / own[:, None], np.broadcast_to(residuals, own.shape) / own
    found = np.zeros(common.shape[1])
    for _ in range(_ITERATIONS):
        weighted = slopes * huber_weights(left - slopes @ found)[:, None]
        found = np.linalg.solve(np.eye(found.size) + weighted.T @ slopes, weighted.T @ left)
    return np.argsort(np.abs(left - slopes @ found), kind="stable")
