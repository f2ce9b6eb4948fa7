"""Compute vibration modes from the integrator's Jacobian."""

from __future__ import annotations

from typing import Any

import numpy as np

from lambda_core.domain.arrays import FloatArray
from lambda_core.solver.arrays import bundle as L
from lambda_core.solver.arrays.jacobian_blocks import AFTER, BEFORE, Blocks

_RING = 0.5  # share of a mode's kinetic energy in the rings, from which on it is one of theirs
_SLOWEST = 20.0  # [Hz]
_DAMPED = 0.3  # of critical; what is damped by more rings in no spectrum
_MOST = 8  # modes that are reported


def dense(blocks: Blocks) -> FloatArray:
    """Return the block-arrow Jacobian as one matrix.

    What a ball does not reach stays zero.
    """
    reach, tail = blocks.reach, int(blocks.reach.states[-1])
    size = tail + blocks.d.shape[0]
    matrix = np.zeros((size, size))
    for r, width in enumerate(reach.width):
        columns = tail + reach.columns[r, :width]
        z = reach.first[r + 1] - reach.first[r]
        states = np.arange(reach.states[r], reach.states[r + 1]).reshape(z, -1)
        size = states.shape[1]
        for i, j in enumerate(range(reach.first[r], reach.first[r + 1])):
            own = states[i]
            matrix[np.ix_(own, own)] = blocks.a[j, :size, :size]
            matrix[np.ix_(own, columns)] = blocks.b[j, :size, :width]
            matrix[np.ix_(columns, own)] = blocks.c[j, :width, :size]
            if blocks.cross.size:
                for side, place in ((BEFORE, (i - 1) % z), (AFTER, (i + 1) % z)):
                    matrix[np.ix_(own, states[place])] += blocks.cross[j, side, :size, :size]
    matrix[tail:, tail:] = blocks.d
    return matrix


def ring_modes(
    bundle: Any, blocks: Blocks, inertia: FloatArray, *, until: float | None = None
) -> list[tuple[float, float]]:
    """Return the modes of the rings.

    Each has a frequency [Hz] and a damping ratio [-], in order of frequency.

    A mode belongs to the rings where half of its kinetic energy or more is theirs. Those of the Jacobian blocks are
    those of the last steps: loaded balls go round, and the modes with them.

    Parameters
    ----------
    inertia : float64[:]
        Mass or moment of inertia of each state, 0 for a position; (n,).
    until : float, optional
        Tell those up to this frequency [Hz], and some above it where they are few: a shaft has modes of its own far
        above all that is asked for. Otherwise those that are damped least.
    """
    matrix = dense(blocks)
    if not np.isfinite(matrix).all():
        return []
    values, vectors = np.linalg.eig(matrix)
    energy = np.abs(vectors) ** 2 * inertia[: matrix.shape[0], None]
    bodies = np.asarray(bundle.active) // L.NS
    rings = int(blocks.reach.states[-1]) + np.flatnonzero(bundle.bodies["is_cage"][bodies] == 0)
    share = energy[rings].sum(axis=0) / (energy.sum(axis=0) + 1e-300)
    frequency, damping = np.abs(values) / (2.0 * np.pi), -values.real / (np.abs(values) + 1e-300)
    mine = (values.imag > 0.0) & (share > _RING) & (frequency > _SLOWEST) & (damping > 0.0) & (damping < _DAMPED)
    every = sorted(zip(frequency[mine].tolist(), damping[mine].tolist(), strict=True))
    if until is not None:
        return every[: max(_MOST, sum(f <= until for f, _ in every))]
    return sorted(sorted(every, key=lambda mode: mode[1])[:_MOST])
