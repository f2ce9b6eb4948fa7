"""Linear algebra of the block-arrow matrix M = s I - g J: factor and solve in O(Z).

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

from lambda_core.laws.jit.references import reference_t
from lambda_core.solver.arrays.bundle import NB
from lambda_core.solver.arrays.factors import Factors
from lambda_core.solver.integrator.chain import (
    find_chains,
    take_from_block,
    take_from_columns,
    take_from_rows,
    take_part,
    write_ahead,
)
from lambda_core.solver.integrator.condensed import condense, solve_condensed
from lambda_core.solver.integrator.reach import is_split
from lambda_core.solver.integrator.sweeps import add_columns, add_row, spread, take_columns, take_rows, write_multiple
from lambda_core.solver.layout import helper, large_helper
from lambda_core.solver.lu import filled_up, lu_factor, lu_solve

# Relative change of g beyond which what a step divides by it is factored anew; not a tie with one growth of the step.
REFACTOR = 0.41
_ALIKE = 0.05  # likewise, up to which single balls of a row are factored for the g of the others


factors_t = reference_t(Factors)


@helper
def _invert(m, pivots):
    """Invert a ball block in place: Gauss and Jordan's elimination with row pivoting; returns 0 when singular."""
    for k in range(NB):
        best, row = abs(m[k, k]), k
        for i in range(k + 1, NB):
            if abs(m[i, k]) > best:
                best, row = abs(m[i, k]), i
        pivots[k] = row
        if not best > 0.0:
            return 0
        if row != k:
            for c in range(NB):
                m[k, c], m[row, c] = m[row, c], m[k, c]
        inverse = 1.0 / m[k, k]
        m[k, k] = 1.0
        for c in range(NB):
            m[k, c] *= inverse
        for i in range(NB):
            if i != k:
                f = m[i, k]
                m[i, k] = 0.0
                add_row(m[i], -f, m[k])
    for k in range(NB - 1, -1, -1):
        row = pivots[k]
        if row != k:
            for i in range(NB):
                m[i, k], m[i, row] = m[i, row], m[i, k]
    return 1


@helper
def _in_turn(begin, i, first, last):
    """Return the ball i places after `begin` in the ring first..last-1."""
    j = begin + i
    return j if j < last else j - (last - first)


@helper
def _joined_before(reach, r, j, fa):
    """Return the ball before ball j of row r where the two are joined, else -1."""
    if fa.joined.size == 0:
        return -1
    before = j - 1 if j > reach.first[r] else reach.first[r + 1] - 1
    return before if fa.joined[before] == 1 else -1


@helper
def _share(sign, c, x, part, own, n):
    """Take C A^-1 B of a ball from `own`, times a sign: forces move speeds, so that half of its rows are empty."""
    for i in range(n):
        empty = True
        for k in range(NB):
            part[k] = sign * c[k, i]
            empty &= part[k] == 0.0
        if not empty:
            take_rows(own[i], part, x, filled_up(n))


@helper
def _factor_ball(bl, j, before, shift, gamma, fa, own, n):
    """Invert the block of ball j and take its share, of n columns, from `own`; returns 0 when singular.

    `before` is the ball that it is joined to, -1 for none.
    """
    m, x, across, c = fa.inverse[j], fa.x, fa.across[j], fa.c[j]
    for i in range(NB):
        for k in range(NB):
            m[k, i] = -gamma * bl.a[j, i, k]
        m[i, i] += shift
    if before >= 0:
        take_from_block(bl, j, before, gamma, fa, m)
    if _invert(m, fa.pivots) != 1:
        return 0
    for i in range(NB):
        for k in range(NB):
            fa.part[k] = gamma * m[k, i]
        x[i, :] = 0.0
        take_rows(x[i], fa.part, bl.b[j], filled_up(n))
    if before >= 0:
        take_from_columns(j, before, fa, m, x, n)
    for i in range(NB):
        for q in range(n):
            across[q, i] = x[i, q]
    for i in range(n):
        for k in range(NB):
            c[k, i] = -gamma * bl.c[j, i, k]
    if before >= 0:
        take_from_rows(before, fa, c, n)
    _share(1.0, c, x, fa.part, own, n)
    if fa.joined.size > 0 and fa.joined[j] == 1:
        write_ahead(bl, j, gamma, fa, m)
    return 1


@helper
def _factor_row(bl, r, shift, gamma, fa, own):
    """Take the shares of the balls of a row from `own`; returns 0 when a block is singular."""
    fa.gamma[r], bl.changed[r] = gamma, 0
    first, last = bl.reach.first[r], bl.reach.first[r + 1]
    if fa.joined.size > 0:
        fa.begin[r] = find_chains(bl, first, last, fa)
    for i in range(last - first):
        j = _in_turn(fa.begin[r], i, first, last)
        before = _joined_before(bl.reach, r, j, fa)
        if _factor_ball(bl, j, before, shift, gamma, fa, own, bl.reach.width[r]) != 1:
            return 0
        bl.newer[j] = 0
    return 1


@helper
def _give_back(j, fa, own, n):
    """Add to `own` again what ball j has taken from it."""
    x, across, c = fa.x, fa.across[j], fa.c[j]
    for k in range(NB):
        for q in range(n):
            x[k, q] = across[q, k]
    _share(-1.0, c, x, fa.part, own, n)


@helper
def _few_are_newer(r, bl):
    """Return whether giving back and taking again is less than factoring the whole row."""
    newer = 0
    for j in range(bl.reach.first[r], bl.reach.first[r + 1]):
        newer += bl.newer[j]
    return 2 * newer <= bl.reach.first[r + 1] - bl.reach.first[r]


@helper
def _renew_row(bl, r, shift, fa, own):
    """Factor the balls of a row anew whose blocks have changed, for the g of the others; returns 0 when singular."""
    n, bl.changed[r] = bl.reach.width[r], 0
    for j in range(bl.reach.first[r], bl.reach.first[r + 1]):
        if bl.newer[j] == 1:
            _give_back(j, fa, own, n)
            if _factor_ball(bl, j, -1, shift, fa.gamma[r], fa, own, n) != 1:
                return 0
            bl.newer[j] = 0
    return 1


@helper
def _add_row(bl, r, shift, gamma, fa):
    """Add to the Schur complement what the contacts of a row have of it; returns 0 when a block is singular."""
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


@helper
def _solve_forward(row, reach, fa, r, own, n):
    """Write A_j^-1 times each ball's part of the right-hand side, and take its share from `own`."""
    part, first, last = fa.part, reach.first[row], reach.first[row + 1]
    for place in range(last - first):
        j = _in_turn(fa.begin[row], place, first, last)
        its = r[NB * j : NB * j + NB]
        before = _joined_before(reach, row, j, fa)
        if before >= 0:
            take_part(fa.behind[j], r[NB * before : NB * before + NB], its)
        for i in range(NB):
            part[i] = 0.0
        add_columns(part, its, fa.inverse[j], NB)
        for k in range(NB):
            its[k] = part[k]
        take_rows(own, part, fa.c[j], filled_up(n))


@helper
def _solve_back(row, reach, fa, r, own, n):
    """Take from each ball's part what the shared part, in `own`, and the ball after it have of it."""
    first, last = reach.first[row], reach.first[row + 1]
    for place in range(last - first - 1, -1, -1):
        j = _in_turn(fa.begin[row], place, first, last)
        its = r[NB * j : NB * j + NB]
        take_columns(its, own, fa.across[j], n)
        if fa.joined.size > 0 and fa.joined[j] == 1:
            after = _in_turn(j, 1, first, last)
            take_part(fa.ahead[j], r[NB * after : NB * after + NB], its)


@large_helper
def arrow_solve(bl, fa, r):
    """Solve in place for the right-hand side r, shape (9 Z + n,)."""
    reach, own = bl.reach, fa.tail
    shared = r[NB * fa.inverse.shape[0] :]
    for row in range(reach.width.size):
        n, columns = reach.width[row], reach.columns[row]
        for i in range(n):
            own[i] = shared[columns[i]]
        _solve_forward(row, reach, fa, r, own, n)
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
        _solve_back(row, reach, fa, r, own, n)
