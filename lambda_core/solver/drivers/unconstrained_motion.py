"""Detect unconstrained rigid-body motions under load."""

from __future__ import annotations

import numpy as np

from lambda_core.domain.arrays import FloatArray

_NOTHING = 1e-12  # eigenvalue of a stiffness whose diagonal is one: below it is rounding
_PULLED = 1e-9  # of the loads: less of them along a loose motion is rounding


def unconstrained_motion(stiffness: FloatArray, pull: FloatArray, arms: FloatArray, scale: float) -> FloatArray | None:
    """Return the unconstrained motion under load.

    A stiffness does not hold it; None where loads find hold everywhere.

    Parameters
    ----------
    stiffness : float64[:, :], shape (n, n)
        Symmetric [N/m, N, N m].
    pull : float64[:], shape (n,)
        Loads on the same motions [N, N m].
    arms : float64[:], shape (n,)
        Lengths that make turning a way [m]; 1 for displacements.
    scale : float
        Size of the loads [N].

    Returns
    -------
    float64[:], shape (n,), or None
        Of every motion the way, the longest 1.
    """
    own = np.diag(stiffness)
    unit = 1.0 / np.sqrt(np.where(own > 0.0, own, max(float(own.max()), 1.0)))  # what nothing holds has no own scale
    values, shapes = np.linalg.eigh(stiffness * np.outer(unit, unit))
    loose = shapes[:, values < _NOTHING]
    way = unit * (loose @ (loose.T @ (unit * pull))) * arms
    longest = float(np.abs(way).max(initial=0.0))
    if longest == 0.0 or abs(float(way / arms @ pull)) < _PULLED * scale * longest:
        return None
    return np.asarray(way / longest)
