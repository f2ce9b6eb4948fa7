"""Define factors of the block-arrow matrix."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from lambda_core.laws.jit.words import by_reference
from lambda_core.solver.arrays.bundle import ARRAY1, ARRAY2, ARRAY3, INTEGERS, INTEGERS2
from lambda_core.solver.arrays.own_bodies import Reach

LANES = 8  # numbers that a processor works on at once, at most


def filled(n: int) -> int:
    """Return the padded length of a row.

    Zeros pad the n numbers, so that none is left over.
    """
    return -(-n // LANES) * LANES


@by_reference(ARRAY1, **dict.fromkeys(("upper", "lower", "on_speeds"), ARRAY2), pivots=INTEGERS)
class Condensed(NamedTuple):
    """Factors of speeds and positions."""

    upper: Any  # (speeds, filled): of the turned matrix of the speeds
    lower: Any  # (speeds, filled): multipliers, below a diagonal of ones that is not kept
    inverse: Any  # (speeds,): of the diagonal of `upper`
    pivots: Any  # int64 (speeds,)
    on_speeds: Any  # (positions, filled): what the positions have of the rows of speeds
    packed: Any  # (filled,): the speeds' part of a right-hand side
    found: Any  # (filled,): and of its solution


class RollerBlocks(NamedTuple):
    """Pointers to the factors' code of roller rows.

    The code is in lambda_core.solver.row_code.
    """

    factor: Any
    solve: Any


@by_reference(
    ARRAY1,
    **dict.fromkeys(("inverse", "across", "c", "own", "behind", "ahead"), ARRAY3),
    **dict.fromkeys(("x", "schur"), ARRAY2),
    **dict.fromkeys(("pivots", "schur_pivots", "begin", "joined"), INTEGERS),
    condensed=Condensed,
    rollers=INTEGERS2,
)
class Factors(NamedTuple):
    """Inverses of ball blocks and Schur factors.

    The LU factors are those of the Schur complement; `size` is that of the largest block.
    """

    inverse: Any  # (Z, size, size): (A_j^-1)^T
    pivots: Any  # int64 (size,)
    x: Any  # (size, filled): A_j^-1 B_j of the ball in hand
    across: Any  # (Z, widest, size): (A_j^-1 B_j)^T
    c: Any  # (Z, size, filled): C_j^T, scaled
    schur: Any  # (n, filled)
    schur_pivots: Any  # int64 (n,)
    condensed: Any  # Condensed: the same where there are several bearings
    own: Any  # (rows, widest, filled): what each row of balls has of the Schur complement
    gamma: Any  # (rows,): g that each row is factored for
    tail: Any  # (filled,): of the shared part of a right-hand side
    part: Any  # (size,): one ball's part of a solution, or what rows are multiplied by
    begin: Any  # int64 (rows,): ball of each row that is eliminated first
    joined: Any  # int64 (Z or 0,): whether a ball's coupling with the next one is eliminated
    behind: Any  # (Z or 0, size, size): X_j,j-1, scaled
    ahead: Any  # (Z or 0, size, size): A_j^-1 X_j,j+1
    rollers: Any  # int64 (1, 2): addresses of RollerBlocks; without rollers (0, 2)


def make_condensed(positions: int, speeds: int) -> Condensed:
    """Allocate for so many states that all bearings share."""
    row = filled(speeds)
    return Condensed(
        np.zeros((speeds, row)),
        np.zeros((speeds, row)),
        np.zeros(speeds),
        np.zeros(speeds, dtype=np.int64),
        np.zeros((positions, row)),
        np.zeros(row),
        np.zeros(row),
    )


def make_factors(reach: Reach, n: int, coupled: int, size: int, rollers: Any) -> Factors:
    """Allocate factors for rows of balls.

    `reach` describes the rows; n shared states and `coupled` balls that may touch.

    No element has more than `size` states; `rollers` are the addresses of RollerBlocks.
    """
    balls, widest = int(reach.first[-1]), reach.columns.shape[1]
    row = filled(widest)
    return Factors(
        np.zeros((balls, size, size)),
        np.zeros(size, dtype=np.int64),
        np.zeros((size, row)),
        np.zeros((balls, widest, size)),
        np.zeros((balls, size, row)),
        np.zeros((n, filled(n))),
        np.zeros(n, dtype=np.int64),
        make_condensed(reach.positions.size, reach.speeds.size),
        np.zeros((reach.width.size, widest, row)),
        np.ones(reach.width.size),
        np.zeros(row),
        np.zeros(size),
        reach.first[:-1].copy(),
        np.zeros(coupled, dtype=np.int64),
        np.zeros((coupled, size, size)),
        np.zeros((coupled, size, size)),
        rollers,
    )
