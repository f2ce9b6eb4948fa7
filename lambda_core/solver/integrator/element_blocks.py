"""Factor the blocks of one row of elements.

The blocks serve :mod:`.arrow`.
"""

from __future__ import annotations

from typing import Any

import numba

from lambda_core.solver.integrator.chain import chains_of
from lambda_core.solver.integrator.sweeps import sums_of
from lambda_core.solver.layout import helper
from lambda_core.solver.lu import filled_up


@helper
def _in_turn(begin, i, first, last):
    """Return the i-th ball after `begin`.

    The ring is first..last-1.
    """
    j = begin + i
    return j if j < last else j - (last - first)


@helper
def _joined_before(reach, r, j, fa):
    """Return the joined ball before j.

    The ball is in row r; return -1 where the two are not joined.
    """
    if fa.joined.size == 0:
        return -1
    before = j - 1 if j > reach.first[r] else reach.first[r + 1] - 1
    return before if fa.joined[before] == 1 else -1


def blocks_of(size: int) -> tuple[Any, ...]:
    """Return the functions of element blocks.

    They factor and solve a row of elements with `size` states, a constant for the compiler.

    factor_row, renew_row, solve_forward, solve_back.
    """
    add_row, take_rows, add_columns, take_columns = sums_of(size)
    find_chains, take_from_block, take_from_columns, take_from_rows, write_ahead, take_part = chains_of(size)

    @numba.njit(inline="always")
    def _part_of(r, row, reach, j):
        """Return an element's states in a vector.

        The element is j of a row; the result is a view.
        """
        return r[reach.states[row] + size * (j - reach.first[row]) :][:size]

    @helper
    def _invert(m, pivots):
        """Invert a ball block in place.

        It uses Gauss and Jordan's elimination with row pivoting; return 0 when singular.
        """
        for k in range(size):
            best, row = abs(m[k, k]), k
            for i in range(k + 1, size):
                if abs(m[i, k]) > best:
                    best, row = abs(m[i, k]), i
            pivots[k] = row
            if not best > 0.0:
                return 0
            if row != k:
                for c in range(size):
                    m[k, c], m[row, c] = m[row, c], m[k, c]
            inverse = 1.0 / m[k, k]
            m[k, k] = 1.0
            for c in range(size):
                m[k, c] *= inverse
            for i in range(size):
                if i != k:
                    f = m[i, k]
                    m[i, k] = 0.0
                    add_row(m[i], -f, m[k])
        for k in range(size - 1, -1, -1):
            row = pivots[k]
            if row != k:
                for i in range(size):
                    m[i, k], m[i, row] = m[i, row], m[i, k]
        return 1

    @helper
    def _share(sign, c, x, part, own, n):
        """Take C A^-1 B of a ball.

        It is taken from `own`, times a sign. Forces move speeds, so that half of its rows are empty.
        """
        for i in range(n):
            empty = True
            for k in range(size):
                part[k] = sign * c[k, i]
                empty &= part[k] == 0.0
            if not empty:
                take_rows(own[i], part, x, filled_up(n))

    @helper
    def _factor_ball(bl, j, before, shift, gamma, fa, own, n):
        """Invert ball j's block, take its share.

        The share has n columns and is taken from `own`; return 0 when singular.

        `before` is the ball that it is joined to, -1 for none.
        """
        m, x, across, c = fa.inverse[j], fa.x, fa.across[j], fa.c[j]
        for i in range(size):
            for k in range(size):
                m[k, i] = -gamma * bl.a[j, i, k]
            m[i, i] += shift
        if before >= 0:
            take_from_block(bl, j, before, gamma, fa, m)
        if _invert(m, fa.pivots) != 1:
            return 0
        for i in range(size):
            for k in range(size):
                fa.part[k] = gamma * m[k, i]
            x[i, :] = 0.0
            take_rows(x[i], fa.part, bl.b[j], filled_up(n))
        if before >= 0:
            take_from_columns(j, before, fa, m, x, n)
        for i in range(size):
            for q in range(n):
                across[q, i] = x[i, q]
        for i in range(n):
            for k in range(size):
                c[k, i] = -gamma * bl.c[j, i, k]
        if before >= 0:
            take_from_rows(before, fa, c, n)
        _share(1.0, c, x, fa.part, own, n)
        if fa.joined.size > 0 and fa.joined[j] == 1:
            write_ahead(bl, j, gamma, fa, m)
        return 1

    @helper
    def factor_row(bl, r, shift, gamma, fa, own):
        """Take the balls' shares from `own`.

        They are those of a row; return 0 when a block is singular.
        """
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
        """Give ball j's share back to `own`.

        It has taken it before.
        """
        x, across, c = fa.x, fa.across[j], fa.c[j]
        for k in range(size):
            for q in range(n):
                x[k, q] = across[q, k]
        _share(-1.0, c, x, fa.part, own, n)

    @helper
    def renew_row(bl, r, shift, fa, own):
        """Factor changed balls of a row anew.

        Their blocks have changed, and the others keep their g; return 0 if singular.
        """
        n, bl.changed[r] = bl.reach.width[r], 0
        for j in range(bl.reach.first[r], bl.reach.first[r + 1]):
            if bl.newer[j] == 1:
                _give_back(j, fa, own, n)
                if _factor_ball(bl, j, -1, shift, fa.gamma[r], fa, own, n) != 1:
                    return 0
                bl.newer[j] = 0
        return 1

    @helper
    def solve_forward(row, reach, fa, r, own, n):
        """Solve the balls' parts forward.

        Write A_j^-1 times each ball's part of the right-hand side, and take its share from `own`.
        """
        part, first, last = fa.part, reach.first[row], reach.first[row + 1]
        for place in range(last - first):
            j = _in_turn(fa.begin[row], place, first, last)
            its = _part_of(r, row, reach, j)
            before = _joined_before(reach, row, j, fa)
            if before >= 0:
                take_part(fa.behind[j], _part_of(r, row, reach, before), its)
            for i in range(size):
                part[i] = 0.0
            add_columns(part, its, fa.inverse[j], size)
            for k in range(size):
                its[k] = part[k]
            take_rows(own, part, fa.c[j], filled_up(n))

    @helper
    def solve_back(row, reach, fa, r, own, n):
        """Solve the balls' parts back.

        Take from each the share of the shared part, in `own`, and that of the ball after it.
        """
        first, last = reach.first[row], reach.first[row + 1]
        for place in range(last - first - 1, -1, -1):
            j = _in_turn(fa.begin[row], place, first, last)
            its = _part_of(r, row, reach, j)
            take_columns(its, own, fa.across[j], n)
            if fa.joined.size > 0 and fa.joined[j] == 1:
                after = _part_of(r, row, reach, _in_turn(j, 1, first, last))
                take_part(fa.ahead[j], after, its)

    return factor_row, renew_row, solve_forward, solve_back
