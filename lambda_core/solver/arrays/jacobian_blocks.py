"""Define blocks and workspaces of the Jacobian."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from lambda_core.laws.jit.words import Array, by_reference
from lambda_core.solver import records as R
from lambda_core.solver.arrays.bundle import ARRAY1, ARRAY2, ARRAY3, ARRAY4, INTEGERS, NB, NR, NS
from lambda_core.solver.arrays.factors import filled
from lambda_core.solver.arrays.own_bodies import Reach, make_reach

BEFORE, AFTER = 0, 1  # places of X_j,j-1 and X_j,j+1 in the blocks of ball j


@by_reference(
    ARRAY1,
    reach=Reach,
    a=ARRAY3,
    b=ARRAY3,
    c=ARRAY3,
    d=ARRAY2,
    cross=ARRAY4,
    beyond=ARRAY2,
    d_own=ARRAY3,
    changed=INTEGERS,
    newer=INTEGERS,
    own=ARRAY2,
    to_shared=ARRAY2,
    from_ball=ARRAY3,
    shared=ARRAY3,
    parts=ARRAY4,
    due=INTEGERS,
    slope=Array(R.TANGENT),
    wrenches=Array(R.WRENCH),
    map=ARRAY2,
    pushes=ARRAY2,
    moved=ARRAY2,
    roller_map=ARRAY2,
    drivers=ARRAY2,
    index=INTEGERS,
)
class Blocks(NamedTuple):
    """Jacobian blocks and workspaces.

    The blocks of a ball have the columns of its own bodies, in their places.
    """

    reach: Reach  # the own bodies of each row
    a: Any  # (Z, size, size), of the largest block
    b: Any  # (Z, size, filled), the widest row of balls filled up
    c: Any  # (Z, filled, size)
    d: Any  # (n_active, n_active)
    cross: Any  # (Z, 2, size, size), without balls that may touch (0, ...): with the balls before and after, see chain
    beyond: Any  # (6, size) d(ball force)/d(next ball)
    d_own: Any  # (rows, widest, widest): of D what contacts of each row have, where bearings are several
    changed: Any  # int64 (rows,): whether blocks of the row are newer than its factors
    newer: Any  # int64 (Z,): whether blocks of the ball are newer than its factors
    own: Any  # (6, size) d(ball force)/d(ball)
    to_shared: Any  # (6, 12 places) d(ball force)/d(own bodies)
    from_ball: Any  # (places, 6, size) d(own body force)/d(ball)
    parts: Any  # (Z, places, 6, 12 places) d(own body force)/d(own bodies) by each ball
    shared: Any  # (bodies, 6, 12 bodies) d(body force)/d(shared): the parts' sum, and the lands
    due: Any  # int64 (Z,): whether the next call renews this ball; it leaves 1 everywhere
    slope: Any  # TANGENT (1,): d(wrench)/d(kinematics) of one contact
    ball: Any  # (9,) perturbed
    roller: Any  # (11,) perturbed
    moved: Any  # (2, 11) time derivative of a roller, and of a perturbed one
    roller_map: Any  # (11, 6) d(rate)/d(force, moment) of a roller
    drivers: Any  # (12, 6) d(wrench)/d(what a contact of a roller depends on)
    body: Any  # (12,) perturbed
    body2: Any  # (12,) perturbed
    rate: Any  # (12,) time derivative of a body
    near_rate: Any  # (12,) and of a perturbed one
    wrenches: Any  # WRENCH (4,): on ball and body, then on both where one of them is perturbed
    map: Any  # (12, 6) d(rate)/d(force, moment) of one body
    pushes: Any  # (2, 2 waves): of one contact on the waves of its ring, and where a state is perturbed
    index: Any  # int64 (12 bodies,): position among the free shared states, or -1


def may_touch(bundle: Any) -> bool:
    """Tell whether balls may touch each other.

    They are balls of a row without a cage, where such contacts are computed.
    """
    return bool(bundle.system["guides_on"][0]) and not bundle.rows["caged"].all()


def make_blocks(bundle: Any) -> Blocks:
    """Allocate the blocks for the tables of a bundle."""
    balls, bodies, n = int(bundle.system["balls"][0]), bundle.bodies.size, bundle.active.size
    index = np.full(NS * bodies, -1, dtype=np.int64)
    index[bundle.active] = np.arange(n)
    reach, zeros = make_reach(bundle), np.zeros
    places, widest, size = reach.bodies.shape[1], reach.columns.shape[1], int(bundle.rows["size"].max())
    return Blocks(
        reach=reach,
        a=zeros((balls, size, size)),
        b=zeros((balls, size, filled(widest))),
        c=zeros((balls, filled(widest), size)),
        d=zeros((n, n)),
        cross=zeros((balls if may_touch(bundle) else 0, 2, size, size)),
        beyond=zeros((6, size)),
        d_own=zeros((reach.width.size, widest, widest)),
        changed=np.ones(reach.width.size, dtype=np.int64),
        newer=np.ones(balls, dtype=np.int64),
        own=zeros((6, size)),
        to_shared=zeros((6, NS * places)),
        from_ball=zeros((places, 6, size)),
        parts=zeros((balls, places, 6, NS * places)),
        shared=zeros((bodies, 6, NS * bodies)),
        due=np.ones(balls, dtype=np.int64),
        slope=zeros(1, R.TANGENT),
        ball=zeros(NB),
        roller=zeros(NR),
        moved=zeros((2, NR)),
        roller_map=zeros((NR, 6)),
        drivers=zeros((len(R.LINE_DRIVERS), 6)),
        body=zeros(NS),
        body2=zeros(NS),
        rate=zeros(NS),
        near_rate=zeros(NS),
        wrenches=zeros(4, R.WRENCH),
        map=zeros((NS, 6)),
        pushes=zeros((2, 2 * bundle.waves.size)),
        index=index,
    )
