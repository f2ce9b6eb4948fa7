"""Voltage at which a film breaks down, patch by patch."""

from __future__ import annotations

import math

from lambda_core.electric.columns import F_LEAST, F_PARTICLE, F_ROUGHNESS, F_STRENGTH
from lambda_core.electric.compiled.array_types import shared_helper
from lambda_core.electric.compiled.chance import uniform, upper_quantile


@shared_helper
def threshold(ball, ring, patch, film, spots, particles, law, seed, known, drawn):
    """Return the voltage that the film of one contact stands while it is on a patch [V].

    Rough film: the N = A/l^2 independent spots of a patch have Gaussian heights around the mean film h, and the lowest
    one decides: P(no breakdown | V) = Phi((h - V/E_b)/sigma)^N. Solved for V with one random number u per patch:
    V = E_b (h - sigma z), 1 - Phi(z) = 1 - u^(1/N). sigma = 0 is the deterministic field E_b h. A particle of size d,
    there with probability 1 - exp(-particles), leaves E_b (h - d). Below a least voltage nothing breaks down.

    Parameters
    ----------
    known : int64[:, :], shape (Z, 2)
        Patch that `drawn` was drawn for.
    drawn : float64[:, :, :], shape (Z, 2, 2)
        z of the lowest spot; 1 where there is a particle.
    """
    if known[ball, ring] != patch:
        known[ball, ring] = patch
        drawn[ball, ring, 0] = 0.0
        drawn[ball, ring, 1] = 0.0
        if law[F_ROUGHNESS] > 0.0:
            below = -math.expm1(math.log(uniform(seed, ball, ring, patch, 0)) / max(spots, 1.0))
            drawn[ball, ring, 0] = upper_quantile(below)
        if particles > 0.0 and uniform(seed, ball, ring, patch, 1) < -math.expm1(-particles):
            drawn[ball, ring, 1] = 1.0
    gap = film - law[F_ROUGHNESS] * drawn[ball, ring, 0]
    if drawn[ball, ring, 1] > 0.0:
        gap = min(gap, film - law[F_PARTICLE])
    return max(law[F_STRENGTH] * gap, law[F_LEAST])
