"""Voltage at which a film breaks down, patch by patch."""

from __future__ import annotations

from lambda_core.electric.compiled.array_types import shared_helper
from lambda_core.electric.compiled.chance import uniform


@shared_helper
def threshold(ball, ring, patch, held, roughness, least, law, par, out, seed, known, drawn):
    """Return the voltage that the film of one contact stands while it is on a patch [V], < 0 where the law refuses.

    The law of the role breakdown gets two random numbers of the patch, keyed by seed, ball, ring and patch.

    Parameters
    ----------
    known : int64[:, :], shape (Z, 2)
        Patch that `drawn` was found for; no patch where the film has changed.
    drawn : float64[:, :], shape (Z, 2)
        Voltages [V].
    """
    if known[ball, ring] != patch:
        status = law(
            held.film[ball, ring], held.thinnest[ball, ring], roughness, held.area[ball, ring],
            uniform(seed, ball, ring, patch, 0), uniform(seed, ball, ring, patch, 1), par[ring], out,
        )  # fmt: skip
        if status != 1:
            return -float(status) - 1.0
        known[ball, ring] = patch
        drawn[ball, ring] = max(out[0], least)
    return drawn[ball, ring]
