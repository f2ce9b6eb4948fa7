"""Factor and solve the block-arrow matrix in O(Z).

The matrix is M = s I - g J.

The blocks of a ball hold the columns of its own bodies alone (:mod:`.reach`). Where there are several bearings, what
the balls of a row take from the Schur complement is summed in a matrix of that size, and kept: a row is factored anew
where its blocks have changed, or are factored for another g by far. Its part of D then has that g, too.

Every product is a sum of multiples of rows: the entries of a row do not wait for one another, as the terms of an inner
product do. So the ball blocks are kept as inverses, and the other blocks in the order in which they are gone through.
Rows are filled up with zeros to whole vectors, and an entry is in a register while multiples of nine rows are taken
from it (:mod:`.sweeps`).

Further blocks couple balls that touch each other (:mod:`.chain`).
"""

from __future__ import annotations

from lambda_core.solver.arrays.bundle import NB
from lambda_core.solver.integrator.condensed import condense, solve_condensed
from lambda_core.solver.integrator.element_blocks import blocks_of
from lambda_core.solver.integrator.reach import is_split
from lambda_core.solver.integrator.sweeps import spread, write_multiple
from lambda_core.solver.layout import helper, large_helper
from lambda_core.solver.lu import lu_factor, lu_solve
from lambda_core.solver.row_code import BACK, FORWARD, NEWER, WHOLE, roller_blocks

# Relative change of g beyond which what a step divides by it is factored anew; not a tie with one growth of the step.
REFACTOR = 0.41
_ALIKE = 0.05  # likewise, up to which single balls of a row are factored for the g of the others


_factor_balls, _renew_balls, _forward_balls, _back_balls = blocks_of(NB)


@helper
def _has_balls(reach, r):
    """Tell whether a row has balls.

    Its elements have as many states as a ball.
    """
    return reach.states[r + 1] - reach.states[r] == NB * (reach.first[r + 1] - reach.first[r])


@helper
def _factor_row(bl, r, shift, gamma, fa, own):
    """Take the elements' shares from `own`.

    The elements are those of a row; return 0 when a block is singular.
    """
    if _has_balls(bl.reach, r):
        return _factor_balls(bl, r, shift, gamma, fa, own)
    return roller_blocks(fa.rollers, 0).factor(WHOLE, bl, r, shift, gamma, fa, own)


@helper
def _renew_row(bl, r, shift, fa, own):
    """Factor changed elements of a row anew.

    Their blocks have changed; return 0 when a block is singular.
    """
    if _has_balls(bl.reach, r):
        return _renew_balls(bl, r, shift, fa, own)
    return roller_blocks(fa.rollers, 0).factor(NEWER, bl, r, shift, fa.gamma[r], fa, own)


@helper
def _few_are_newer(r, bl):
    """Tell whether a partial renewal is cheaper.

    Compare giving back and taking again with factoring the whole row.
    """
    newer = 0
    for j in range(bl.reach.first[r], bl.reach.first[r + 1]):
        newer += bl.newer[j]
    return 2 * newer <= bl.reach.first[r + 1] - bl.reach.first[r]


@helper
def _add_row(bl, r, shift, gamma, fa):
    """Add a row's contacts to the Schur complement.

    Return 0 when a block is singular.
    """
    own, n, columns = fa.own[r], bl.reach.width[r], bl.reach.columns[r]
    apart = abs(gamma / fa.gamma[r] - 1.0)
    if bl.changed[r] == 1 and apart <= _ALIKE and fa.joined.size == 0 and _few_are_newer(r, bl):
        if _renew_row(bl, r, shift, fa, own) != 1:
            return 0
    elif bl.changed[r] == 1 or apart > REFACTOR:
        own[:, :] = 0.0
        if _factor_row(bl, r, shift, gamma, fa, own) != 1:
            return 0
    more = gamma - fa.gamma[r]
    for i in range(n):
        spread(fa.schur[columns[i]], columns, own[i], more, bl.d_own[r, i], n)
    return 1


@large_helper
def arrow_factor(bl, shift, gamma, fa):
    """Factor shift I - gamma J; returns 0 when singular."""
    schur, reach = fa.schur, bl.reach
    for i in range(schur.shape[0]):
        write_multiple(schur[i], -gamma, bl.d[i], schur.shape[0])
        schur[i, i] += shift
    several = is_split(reach, schur.shape[0])
    for r in range(reach.width.size):
        if several:
            if _add_row(bl, r, shift, gamma, fa) != 1:
                return 0
        elif _factor_row(bl, r, shift, gamma, fa, schur) != 1:
            return 0
    if schur.shape[0] == 0:
        return 1
    if several:
        return condense(schur, reach, fa.condensed)
    return lu_factor(schur, fa.schur_pivots)


@large_helper
def arrow_solve(bl, fa, r):
    """Solve in place for r.

    The right-hand side has shape (9 Z + n,).
    """
    reach, own = bl.reach, fa.tail
    shared = r[reach.states[reach.width.size] :]
    for row in range(reach.width.size):
        n, columns = reach.width[row], reach.columns[row]
        for i in range(n):
            own[i] = shared[columns[i]]
        if _has_balls(reach, row):
            _forward_balls(row, reach, fa, r, own, n)
        else:
            roller_blocks(fa.rollers, 0).solve(FORWARD, row, bl, fa, r, own)
        for i in range(n):
            shared[columns[i]] = own[i]
    if is_split(reach, fa.schur.shape[0]):
        solve_condensed(fa.schur, reach, fa.condensed, shared)
    elif shared.size > 0:
        lu_solve(fa.schur, fa.schur_pivots, shared)
    for row in range(reach.width.size):
        n, columns = reach.width[row], reach.columns[row]
        for i in range(n):
            own[i] = shared[columns[i]]
        if _has_balls(reach, row):
            _back_balls(row, reach, fa, r, own, n)
        else:
            roller_blocks(fa.rollers, 0).solve(BACK, row, bl, fa, r, own)
