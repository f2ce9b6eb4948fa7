"""Choose the operating point to measure next."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from lambda_core.domain.arrays import FloatArray
from lambda_core.fitting.parameters import Parameter, spreads
from lambda_core.fitting.uncertainty import Direction, directions


@dataclass(frozen=True)
class NextPoint:
    """The best of some candidates.

    Attributes
    ----------
    index : int
        Which candidate.
    worst : Direction
        The combination that is determined worst before.
    before, after : float
        Its standard deviation over that before the fit, without and with the new point.
    """

    index: int
    worst: Direction
    before: float
    after: float


def next_point(
    jacobian: FloatArray, candidates: FloatArray, parameters: Sequence[Parameter], factor: float = 1.0
) -> NextPoint:
    """Return the candidate that adds most information (D-optimal).

    Parameters
    ----------
    jacobian : float64[:, :], shape (n, p)
        Derivatives of the measured points by all parameters over their errors.
    candidates : float64[:, :], shape (m, p)
        The same of the candidates.
    parameters : sequence of Parameter
        Their spreads before the fit count as information, so that every candidate has a finite gain.
    factor : float
        On the covariance.

    References
    ----------
    Fedorov 1972, Theory of Optimal Experiments, section 2.5: the determinant of the information grows by 1 + g C g.
    """
    spread, names = spreads(parameters), [parameter.name for parameter in parameters]
    scaled, offered = jacobian * spread, candidates * spread
    information = scaled.T @ scaled / factor + np.eye(len(names))
    gains = np.einsum("ij,jk,ik->i", offered, np.linalg.inv(information), offered) / factor
    best = int(np.argmax(gains))
    worst = directions(jacobian, names, spread, factor)[-1]
    after = information + np.outer(offered[best], offered[best]) / factor
    vector = np.linalg.eigh(information)[1][:, 0]
    before_after = [float(np.sqrt(vector @ np.linalg.solve(matrix, vector))) for matrix in (information, after)]
    return NextPoint(best, worst, *before_after)
