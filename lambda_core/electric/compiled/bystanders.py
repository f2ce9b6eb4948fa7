"""Films of the other balls while an arc burns in one film of a ball: when the voltage that goes on breaks them down."""

from __future__ import annotations

import math

from lambda_core.electric.compiled.array_types import helper, shared_helper
from lambda_core.electric.compiled.modes import propagate, voltages
from lambda_core.electric.compiled.patches import threshold

_HALVINGS = 40


@helper
def _potential(other, shared, keep, c, q, v):
    """Return the potential of another ball [V], which keeps its charge where it is not among the nodes of `v`."""
    if keep == 1:
        return v[other]
    found = q[other]
    for i in range(shared):
        found -= c[other, i] * v[i]
    return found / c[other, other]


@shared_helper
def past_breakdown(n, shared, ball, keep, c, q, v, limits):
    """Return how far the film of another ball is past its breakdown, relative: >= 0 past it.

    Parameters
    ----------
    limits : float64[:, :], shape (2, at least Z)
        Voltages that the films stand [V]; 0 for films that are not looked at.
    """
    worst = -1.0
    for other in range(shared, n):
        if other == shared + ball:
            continue
        potential = _potential(other, shared, keep, c, q, v)
        for ring in range(2):
            limit = limits[ring, other - shared]
            if limit > 0.0:
                voltage = (v[ring] if ring < shared else 0.0) - potential
                worst = max(worst, abs(voltage) / limit - 1.0)
    return worst


@shared_helper
def watch(
    ball, held, elapsed, roughness, least, law, par, out, seed, known, drawn, limits
):  # fmt: skip
    """Write what the films of the other balls stand, on the patches that they are on `elapsed` after `held` began."""
    for j in range(held.film.shape[0]):
        for ring in range(2):
            limits[ring, j] = 0.0
            if j != ball and held.film[j, ring] > 0.0:
                patch = math.floor(held.rolled[j, ring] + held.rate[j, ring] * elapsed)
                stands = threshold(j, ring, patch, held, roughness, least, law, par, out, seed, known, drawn)
                limits[ring, j] = max(stands, 0.0)


@shared_helper
def first_moment(
    dt, size, decay, s, y, drive, after, area, ahead, n, shared, ball, keep, c, q, limits
):  # fmt: skip
    """Return the part of the step dt after which the film of another ball breaks down [s], by halving; 0: at once."""
    low, high = 0.0, dt
    for _ in range(_HALVINGS):
        at = 0.5 * (low + high)
        propagate(size, decay, y, drive, at, after, area)
        voltages(size, s, after, ahead)
        if past_breakdown(n, shared, ball, keep, c, q, ahead, limits) >= 0.0:
            high = at
        else:
            low = at
    return high
