"""Axial and radial velocity of balls along their paths: what a ball has beside its orbital speed where loads differ."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from lambda_core.domain.arrays import FloatArray


def path_velocities(balls: NDArray[Any]) -> FloatArray:
    """Return axial and radial velocity of each ball of a row from where its neighbours are.

    In steady running every ball comes by where its neighbour is now, so that place is a function of azimuth, x(psi),
    and dx/dt = omega dx/dpsi. The balls of a row are evenly spaced: the derivative is that of the trigonometric
    polynomial through them.

    Parameters
    ----------
    balls : records.BALL[:], shape (Z,)
        One row, by azimuth.

    Returns
    -------
    float64[:, :], shape (Z, 2)
        Axial, radial [m/s].
    """
    orbit = balls["velocity"][:, 2] / balls["radius"]
    return np.stack([orbit * _slope(balls["x"]), orbit * _slope(balls["radius"])], axis=1)


def _slope(values: FloatArray) -> FloatArray:
    """Return the derivative with respect to azimuth of what is known at evenly spaced azimuths."""
    waves = np.fft.rfft(values)
    order = np.arange(waves.size)
    if values.size % 2 == 0:
        order[-1] = 0  # the shortest wave has its extremes at the balls
    slope: FloatArray = np.fft.irfft(1j * order * waves, values.size)
    return slope
