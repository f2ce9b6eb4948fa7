"""Blocks of the Jacobian and the workspaces in which they are made."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numba import types

from lambda_core.solver import records as R
from lambda_core.solver.layout import NB, NS, array1, array2, array3, array4, iarray1, table_t


class Blocks(NamedTuple):
    """Jacobian blocks and workspaces."""

    a: Any  # (Z, 9, 9)
    b: Any  # (Z, 9, n_active)
    c: Any  # (Z, n_active, 9)
    d: Any  # (n_active, n_active)
    own: Any  # (6, 9) d(ball force)/d(ball)
    to_shared: Any  # (6, 12 bodies) d(ball force)/d(shared)
    from_ball: Any  # (bodies, 6, 9) d(body force)/d(ball)
    shared: Any  # (bodies, 6, 12 bodies) d(body force)/d(shared), of one ball, then summed
    parts: Any  # (Z, bodies, 6, 12 bodies) the same of every ball
    due: Any  # int64 (Z,): whether the next call renews this ball; it leaves 1 everywhere
    slope: Any  # TANGENT (1,): d(wrench)/d(kinematics) of one contact
    ball: Any  # (9,) perturbed
    body: Any  # (12,) perturbed
    body2: Any  # (12,) perturbed
    rate: Any  # (12,) time derivative of a body
    near_rate: Any  # (12,) and of a perturbed one
    wrenches: Any  # WRENCH (4,): on ball and body, then on both where one of them is perturbed
    map: Any  # (12, 6) d(rate)/d(force, moment) of one body
    index: Any  # int64 (12 bodies,): position among the free shared states, or -1


_BLOCK_TYPES = {
    "a": array3,
    "b": array3,
    "c": array3,
    "d": array2,
    "own": array2,
    "to_shared": array2,
    "from_ball": array3,
    "shared": array3,
    "parts": array4,
    "due": iarray1,
    "slope": table_t(R.TANGENT),
    "wrenches": table_t(R.WRENCH),
    "map": array2,
    "index": iarray1,
}
blocks_t = types.NamedTuple([_BLOCK_TYPES.get(name, array1) for name in Blocks._fields], Blocks)


def make_blocks(balls: int, bodies: int, active: np.ndarray) -> Blocks:
    """Allocate the blocks for `balls` balls, `bodies` bodies and their free shared states `active`."""
    n, shared = active.size, NS * bodies
    index = np.full(shared, -1, dtype=np.int64)
    index[active] = np.arange(n)
    zeros = np.zeros
    return Blocks(
        a=zeros((balls, NB, NB)),
        b=zeros((balls, NB, n)),
        c=zeros((balls, n, NB)),
        d=zeros((n, n)),
        own=zeros((6, NB)),
        to_shared=zeros((6, shared)),
        from_ball=zeros((bodies, 6, NB)),
        shared=zeros((bodies, 6, shared)),
        parts=zeros((balls, bodies, 6, shared)),
        due=np.ones(balls, dtype=np.int64),
        slope=zeros(1, R.TANGENT),
        ball=zeros(NB),
        body=zeros(NS),
        body2=zeros(NS),
        rate=zeros(NS),
        near_rate=zeros(NS),
        wrenches=zeros(4, R.WRENCH),
        map=zeros((NS, 6)),
        index=index,
    )
