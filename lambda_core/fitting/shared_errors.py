"""Make errors independent that values of a point share.

An error of the oil temperature moves torque and loss of a point together: both do not tell twice what one tells.
The values of each point are combined into as many with independent errors of size one (Aitken 1936, Proc. R. Soc.
Edinb. 55, 42: generalised least squares).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from lambda_core.domain.arrays import FloatArray

_LEAST_OWN = 1e-6  # share of a variance that belongs to a value alone: keeps the correlations below one


@dataclass(frozen=True)
class SharedErrors:
    """Correlations of errors within operating points.

    Attributes
    ----------
    groups : tuple of int64[:]
        Values of each point that has several.
    correlations : tuple of float64[:, :]
        Of their errors.
    """

    groups: tuple[NDArray[np.int64], ...] = ()
    correlations: tuple[FloatArray, ...] = ()

    @classmethod
    def of(cls, groups: Sequence[NDArray[np.int64]], moved: FloatArray, errors: FloatArray) -> SharedErrors:
        """Return those by errors of operating conditions.

        Parameters
        ----------
        moved : float64[:, :], shape (n, k)
            Change of each value by the error of each condition.
        errors : float64[:], shape (n,)
            Standard deviations with these changes.
        """
        several = tuple(group for group in groups if group.size > 1)
        found = []
        for group in several:
            parts = moved[group] / errors[group, None]
            matrix = (1.0 - _LEAST_OWN) * (parts @ parts.T)
            np.fill_diagonal(matrix, 1.0)
            found.append(matrix)
        return cls(several, tuple(found))

    def apart(self, values: FloatArray) -> FloatArray:
        """Return values with independent errors of size one.

        They are given in units of their errors, or their derivatives, shape (n,) or (n, p).
        """
        found = values.copy()
        for group, matrix in zip(self.groups, self.correlations, strict=True):
            found[group] = np.linalg.solve(np.linalg.cholesky(matrix), values[group])
        return found

    def together(self, values: FloatArray) -> FloatArray:
        """Undo :meth:`apart`."""
        found = values.copy()
        for group, matrix in zip(self.groups, self.correlations, strict=True):
            found[group] = np.linalg.cholesky(matrix) @ values[group]
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
