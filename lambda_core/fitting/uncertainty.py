"""Compute the uncertainty of a fit.

Covariance, separable directions, prediction and leave-one-out errors are linearised at the solution. `jacobian` is that
of the predicted values over their errors, shape (n, p).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from lambda_core.domain.arrays import FloatArray

HUBER = 1.345  # standard deviations up to which a residual counts in full: 95 % efficiency for normal errors
# E[psi^2]/E[psi']^2 for normal errors: what the robust loss costs (Huber and Ronchetti 2009, section 4.5).
NORMAL_FACTOR = 1.0526
_NAMED = 0.3  # least component of a direction whose parameter is named
_LARGEST_LEVERAGE = 0.999


@dataclass(frozen=True)
class Direction:
    """Combination of parameters in prior spreads.

    The spreads are those before the fit.

    Attributes
    ----------
    weights : dict of str to float
        Components of the unit vector; small ones are left out.
    spread : float
        Standard deviation along it after the fit over that before it.
    """

    weights: dict[str, float]
    spread: float

    @property
    def is_determined(self) -> bool:
        """True if the data improve on the prior."""
        return self.spread < 1.0

    def text(self) -> str:
        """Return the combination as a sum."""
        terms = [f"{'-' if weight < 0.0 else '+'} {abs(weight):.2f} {name}" for name, weight in self.weights.items()]
        return " ".join(terms).removeprefix("+ ")


def huber_weights(standardised: FloatArray, limit: float = HUBER) -> FloatArray:
    """Return the weights psi(z)/z of residuals.

    The residuals are in units of their error (Huber 1964).
    """
    weights: FloatArray = np.minimum(1.0, limit / np.maximum(np.abs(standardised), 1e-300))
    return weights


def robust_factor(standardised: FloatArray, count: int, limit: float = HUBER) -> float:
    """Return the factor on (J^T J)^-1 of Huber's estimator.

    Parameters
    ----------
    standardised : float64[:], shape (n,)
        Residuals in units of their errors.
    count : int
        Number of fitted parameters.

    References
    ----------
    Huber and Ronchetti 2009, Robust Statistics, 2nd ed., eq. 7.81 with the small-sample factor K of section 7.6.
    """
    n = standardised.size
    inside = float(np.mean(np.abs(standardised) < limit))
    psi = np.clip(standardised, -limit, limit)
    if inside == 0.0:  # the mean of psi' says nothing; psi(z)/z has one
        return float(np.sum(psi**2)) / (n - count) / float(np.mean(huber_weights(standardised, limit))) ** 2
    small = 1.0 + count / n * (1.0 - inside) / inside
    return small**2 * float(np.sum(psi**2)) / (n - count) / inside**2


def counted(jacobian: FloatArray, weights: FloatArray) -> FloatArray:
    """Return slopes that count in a robust fit.

    A point with a small weight pulls the fit no more than others, however large its slopes are. The information is
    W (J^T J)^-1 W with W = J^T D J and D the weights over their mean. It is J^T J where all weights are equal.

    Parameters
    ----------
    weights : float64[:], shape (n,)
        psi(z)/z of the residuals.

    Returns
    -------
    float64[:, :], shape (min(n, p), p)

    References
    ----------
    Huber and Ronchetti 2009, Robust Statistics, 2nd ed., eq. 7.83. It has psi'(z) in place of psi(z)/z; that is zero
    for all large residuals, and then W has no inverse if a wrong law leaves few small ones.
    """
    basis, singular, vectors = np.linalg.svd(jacobian, full_matrices=False)
    found: FloatArray = (basis.T @ (basis * (weights / weights.mean())[:, None])) @ (singular[:, None] * vectors)
    return found


def covariance(jacobian: FloatArray, factor: float) -> FloatArray:
    """Return the covariance of the parameters.

    It is infinite along directions without information.

    Parameters
    ----------
    factor : float
        On (J^T J)^-1.
    """
    _, singular, vectors = np.linalg.svd(jacobian, full_matrices=False)
    floor = singular.max(initial=0.0) * jacobian.shape[0] * np.finfo(float).eps
    inverse = 1.0 / np.maximum(singular, max(floor, 1e-150))
    half = vectors.T * inverse
    found: FloatArray = factor * half @ half.T
    return found


def correlations(matrix: FloatArray) -> FloatArray:
    """Return the correlations that belong to a covariance."""
    deviation = np.sqrt(np.diag(matrix))
    found: FloatArray = np.clip(matrix / np.outer(deviation, deviation), -1.0, 1.0)
    return found


def directions(jacobian: FloatArray, names: Sequence[str], spread: FloatArray, factor: float) -> list[Direction]:
    """Return the principal combinations of parameters.

    The best determined one comes first.

    Parameters
    ----------
    spread : float64[:], shape (p,)
        Standard deviations before the fit: a combination counts as determined when the data leave less.

    References
    ----------
    Singular value analysis of the scaled Jacobian: Belsley, Kuh and Welsch 1980, Regression Diagnostics, chapter 3.
    """
    _, singular, vectors = np.linalg.svd(jacobian * spread, full_matrices=True)
    sizes = np.zeros(len(names))
    sizes[: singular.size] = singular
    found = []
    for size, vector in zip(sizes, vectors, strict=True):
        first = vector[np.argmax(np.abs(vector))]
        parts = {name: float(part * np.sign(first)) for name, part in zip(names, vector, strict=True)}
        order = sorted(parts, key=lambda name: -abs(parts[name]))
        weights = {name: parts[name] for name in order if abs(parts[name]) >= _NAMED}
        found.append(Direction(weights, float(np.sqrt(factor) / size) if size > 0.0 else float("inf")))
    return found


def separable(jacobian: FloatArray, spread: FloatArray, factor: float) -> list[int]:
    """Return the parameters that data can separate.

    They keep their order.

    References
    ----------
    Subset selection by QR with column pivoting in the leading singular directions: Golub and Van Loan 2013, Matrix
    Computations, 4th ed., section 5.5.7.
    """
    from scipy.linalg import qr

    _, singular, vectors = np.linalg.svd(jacobian * spread, full_matrices=False)
    rank = int(np.sum(singular > np.sqrt(factor)))
    if rank == 0:
        return []
    _, _, order = qr(vectors[:rank], pivoting=True, mode="economic")
    return sorted(int(column) for column in order[:rank])


def prediction_variance(gradients: FloatArray, matrix: FloatArray) -> FloatArray:
    """Return the variance of predicted values.

    It has the shape (m,) and follows from their gradients, shape (m, p).
    """
    found: FloatArray = np.einsum("ij,jk,ik->i", gradients, matrix, gradients)
    return found


def leverages(basis: FloatArray) -> FloatArray:
    """Return the leverages of the points.

    How much each pulls the fit towards itself, 0 to 1 (diagonal of the hat matrix).

    Parameters
    ----------
    basis : float64[:, :], shape (n, p)
        Orthonormal, of the weighted derivatives.
    """
    found: FloatArray = np.minimum(np.sum(basis**2, axis=1), _LARGEST_LEVERAGE)
    return found


def left_out_residuals(
    residuals: FloatArray, basis: FloatArray, apart: FloatArray, groups: Sequence[NDArray[np.int64]]
) -> FloatArray:
    """Return the leave-one-out residuals, linearised.

    The values of each group would have them were they all left out of the fit. Errors that a group shares with others
    are predicted from those.

    Parameters
    ----------
    residuals : float64[:], shape (n,)
        Weighted, with independent errors.
    basis : float64[:, :], shape (n, p)
        Orthonormal, of the weighted derivatives.
    apart : float64[:, :], shape (n, n)
        Makes residuals weighted and independent.
    groups : sequence of int64[:]
        Values of each operating point.

    References
    ----------
    Cook and Weisberg 1982, Residuals and Influence in Regression, eqs. 2.2.3 (one value) and 3.6.1 (several); Dubrule
    1983, Math. Geol. 15, 687 (values with correlated errors).
    """
    found = np.zeros_like(residuals)
    for group in groups:
        own, scale = np.linalg.qr(apart[:, group])
        sizes, vectors = np.linalg.svd(basis.T @ own, full_matrices=True)[1:]
        pull = np.zeros(len(group))
        pull[: sizes.size] = np.minimum(sizes**2, _LARGEST_LEVERAGE)
        found[group] = np.linalg.solve(scale, vectors.T @ ((vectors @ (own.T @ residuals)) / (1.0 - pull)))
    return found
