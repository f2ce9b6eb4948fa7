"""Compute the breakdown statistics of rough films with scipy."""

from __future__ import annotations

import numpy as np

from lambda_core.domain.arrays import FloatArray


def breakdown_probability(
    voltage: FloatArray | float, film: float, roughness: float, field: float, spots: float
) -> FloatArray:
    """Return a rough film's breakdown probability.

    At a voltage [V].

    1 - Phi((h - V/E_b)/sigma)^N: Gaussian heights of rms `roughness` [m] around the mean film h [m], N = A/l_corr^2
    independent spots, E_b [V/m] in the gap of the lowest one (weakest link). Jackson, Saha and Janik 2025, J. Tribol.
    147, 051103, treat the onset of discharges by statistics of roughness too (not read in the original). Valid while
    spots are independent and the film is thicker than its roughness.
    """
    from scipy.special import log_ndtr

    gap = film - np.abs(np.asarray(voltage, dtype=np.float64)) / field
    return np.asarray(-np.expm1(spots * log_ndtr(gap / roughness)), dtype=np.float64)


def breakdown_voltage(
    probability: FloatArray | float, film: float, roughness: float, field: float, spots: float
) -> FloatArray:
    """Return a rough film's breakdown voltage [V].

    With a probability, the inverse of breakdown_probability.
    """
    from scipy.special import ndtri

    # Phi(z) = (1 - p)^(1/N), by its small complement.
    tail = -np.expm1(np.log1p(-np.asarray(probability, dtype=np.float64)) / spots)
    return np.asarray(field * (film + roughness * ndtri(tail)), dtype=np.float64)
