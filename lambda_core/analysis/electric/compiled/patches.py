"""Find the voltage at which a film breaks down."""

from __future__ import annotations

import math

from lambda_core.analysis.electric.compiled.array_types import helper, shared_helper
from lambda_core.analysis.electric.compiled.matrices import across
from lambda_core.analysis.electric.compiled.random_keys import uniform

NO_PATCH = -(2**62)


@shared_helper
def _draw(ball, ring, patch, held, films):
    """Return the breakdown voltage of a patch [V].

    The law of the role breakdown gives it; < 0 where it refuses.

    It gets two random numbers of the patch, keyed by seed, ball, ring and patch.
    """
    b = films.bearing[ball]
    status = films.law(
        held.film[ball, ring], held.thinnest[ball, ring], films.roughness[b], held.area[ball, ring],
        uniform(films.seed, ball, ring, patch, 0), uniform(films.seed, ball, ring, patch, 1),
        films.par[2 * b + ring], films.out,
    )  # fmt: skip
    if status != 1:
        return -float(status) - 1.0
    films.known[ball, ring] = patch
    films.drawn[ball, ring] = max(films.out[0], films.least[b])
    return films.drawn[ball, ring]


@helper
def threshold(ball, ring, elapsed, held, films):
    """Return the breakdown voltage of one contact [V].

    It is that of its film on its present patch; < 0 when the law refuses.

    Parameters
    ----------
    elapsed : float
        Time since `held` began [s].
    """
    patch = math.floor(held.rolled[ball, ring] + held.rate[ball, ring] * elapsed)
    if films.known[ball, ring] == patch:
        return films.drawn[ball, ring]
    return _draw(ball, ring, patch, held, films)


@helper
def first_breakdown(net, v, v1, held, elapsed, films):
    """Return the first breakdown of a step.

    The part of the step after which a film breaks down (2: none does, < 0: refused), its ball and its ring.

    Between the ends of a step the voltages are straight lines.
    """
    best, at_ball, at_ring = 2.0, -1, -1
    for j in range(held.film.shape[0]):
        for ring in range(2):
            end = across(net, v1, j, ring)
            if held.film[j, ring] <= 0.0 or abs(end) < films.least[films.bearing[j]]:
                continue
            stands = threshold(j, ring, elapsed, held, films)
            if stands < 0.0:
                return stands, j, ring
            if abs(end) < stands:
                continue
            sign = 1.0 if end > 0.0 else -1.0
            begin = sign * across(net, v, j, ring)
            part = 0.0 if begin >= stands else (stands - begin) / (abs(end) - begin)
            if part < best:
                best, at_ball, at_ring = part, j, ring
    return best, at_ball, at_ring


@helper
def stood_by(ball, elapsed, held, films, stand):
    """Write the breakdown voltages of one ball [V].

    Infinite where there is no film; return < 0 where the law refuses, or 0.
    """
    for ring in range(2):
        stand[ring] = math.inf
        if held.film[ball, ring] > 0.0:
            stand[ring] = threshold(ball, ring, elapsed, held, films)
            if stand[ring] < 0.0:
                return stand[ring]
    return 0.0
