"""Blocks of the Jacobian and the workspaces in which they are made."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numba import types

from lambda_core.physics.compiled.layout import NB, NI, NS, array1, array2, array3, array4, iarray1


class Blocks(NamedTuple):
    """Jacobian blocks and workspaces."""

    a: Any  # (Z, 9, 9)
    b: Any  # (Z, 9, n_active)
    c: Any  # (Z, n_active, 9)
    d: Any  # (n_active, n_active)
    own: Any  # (6, 9) d(ball force)/d(ball)
    to_shared: Any  # (6, 36) d(ball force)/d(shared)
    from_ball: Any  # (3, 6, 9) d(body force)/d(ball)
    shared: Any  # (3, 6, 36) d(body force)/d(shared), of one ball, then summed
    parts: Any  # (Z, 3, 6, 36) the same of every ball
    due: Any  # int64 (Z,): whether the next call renews this ball; it leaves 1 everywhere
    slope: Any  # (6, 9) d(wrench)/dq
    ball: Any  # (9,) perturbed
    body: Any  # (12,) perturbed
    body2: Any  # (12,) perturbed
    fm: Any  # (4, 6): base and perturbed force and moment of ball and body
    map: Any  # (12, 6) d(rate)/d(force, moment) of one body
    rates: Any  # (NI,) scratch
    index: Any  # int64 (36,): position among the free shared states, or -1


_BLOCK_TYPES = {
    "a": array3,
    "b": array3,
    "c": array3,
    "from_ball": array3,
    "shared": array3,
    "parts": array4,
    "due": iarray1,
    "index": iarray1,
}
_BLOCK_TYPES.update(dict.fromkeys(("d", "own", "to_shared", "slope", "fm", "map"), array2))
blocks_t = types.NamedTuple([_BLOCK_TYPES.get(name, array1) for name in Blocks._fields], Blocks)


def make_blocks(balls: int, active: np.ndarray) -> Blocks:
    """Allocate the blocks for `balls` balls and the free shared states `active`."""
    n = active.size
    index = np.full(3 * NS, -1, dtype=np.int64)
    index[active] = np.arange(n)
    zeros = np.zeros
    return Blocks(
        zeros((balls, NB, NB)),
        zeros((balls, NB, n)),
        zeros((balls, n, NB)),
        zeros((n, n)),
        zeros((6, NB)),
        zeros((6, 3 * NS)),
        zeros((3, 6, NB)),
        zeros((3, 6, 3 * NS)),
        zeros((balls, 3, 6, 3 * NS)),
        np.ones(balls, dtype=np.int64),
        zeros((6, 9)),
        zeros(NB),
        zeros(NS),
        zeros(NS),
        zeros((4, 6)),
        zeros((NS, 6)),
        zeros(NI),
        index,
    )
