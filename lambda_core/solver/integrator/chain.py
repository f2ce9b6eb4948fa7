"""Couple balls that touch each other in the block-arrow matrix.

No cage keeps such balls apart.

Blocks X_j,i are next to the diagonal where ball j touches ball i = j - 1 or j + 1. Balls that touch are a chain, which
is eliminated from one end to the other (block LU of a tridiagonal matrix: Golub and Van Loan 2013, Matrix
Computations, 4.5.1), every ball behind the one before it:

    A_j <- A_j - X_j,i A_i^-1 X_i,j,   B_j <- B_j - X_j,i A_i^-1 B_i,   C_j <- C_j - C_i A_i^-1 X_i,j.

Without it Newton's iteration of two balls that hit each other converges as slowly as the blow is stiff. Where all
balls of a row touch, the chain has no end: it is cut between the last ball and the first, and that pair's coupling is
left to the iteration.
"""

from __future__ import annotations

from typing import Any

from lambda_core.solver.arrays.bundle import BVT, BVX
from lambda_core.solver.arrays.jacobian_blocks import AFTER, BEFORE
from lambda_core.solver.layout import helper, rows_helper


@rows_helper
def _add(row, factor, other, n):
    """Add a multiple of a row's first entries.

    It adds the first n entries of another row.
    """
    for i in range(n):
        row[i] += factor * other[i]


def chains_of(size: int) -> tuple[Any, ...]:
    """Return the functions that couple balls.

    The balls have `size` states, a constant for the compiler.

    find_chains, take_from_block, take_from_columns, take_from_rows, write_ahead, take_part.
    """

    @helper
    def _touches(block):
        """Return whether a block of the coupling holds a force."""
        for i in range(BVX, BVT + 1):
            for k in range(size):
                if block[i, k] != 0.0:
                    return True
        return False

    @helper
    def find_chains(bl, first, last, fa):
        """Mark balls joined to the next.

        They are balls first..last-1; return the ball at which a chain begins.
        """
        begin = -1
        for j in range(first, last):
            after = j + 1 if j + 1 < last else first
            joined = _touches(bl.cross[j, AFTER]) or _touches(bl.cross[after, BEFORE])
            fa.joined[j] = 1 if joined else 0
            if not joined:
                begin = after
        if begin < 0:
            begin, fa.joined[last - 1] = first, 0
        return begin

    @helper
    def take_from_block(bl, j, before, gamma, fa, m):
        """Take the previous ball's share from a block.

        It is taken from the diagonal block of ball j, transposed in m.
        """
        for i in range(size):
            for q in range(size):
                f = -gamma * bl.cross[j, BEFORE, i, q]
                fa.behind[j, i, q] = f
                if f != 0.0:
                    for k in range(size):
                        m[k, i] -= f * fa.ahead[before, q, k]

    @helper
    def take_from_columns(j, before, fa, m, x, n):
        """Take the previous ball's share from columns.

        They are n columns of x = A^-1 B of ball j; m is its inverse, transposed.
        """
        for q in range(size):
            for i in range(size):
                f = 0.0
                for k in range(size):
                    f += m[k, i] * fa.behind[j, k, q]
                if f != 0.0:
                    for c in range(n):
                        x[i, c] -= f * fa.across[before, c, q]

    @helper
    def take_from_rows(before, fa, c, n):
        """Take the previous ball's share from rows.

        The rows are C of a ball, transposed in c.
        """
        for k in range(size):
            for q in range(size):
                f = fa.ahead[before, q, k]
                if f != 0.0:
                    _add(c[k], -f, fa.c[before, q], n)

    @helper
    def write_ahead(bl, j, gamma, fa, m):
        """Write A_j^-1 X_j,j+1 of a joined ball.

        It is joined to the next; m is its inverse, transposed.
        """
        for i in range(size):
            for k in range(size):
                total = 0.0
                for q in range(size):
                    total -= m[q, i] * gamma * bl.cross[j, AFTER, q, k]
                fa.ahead[j, i, k] = total

    @helper
    def take_part(matrix, part, its):
        """Subtract a matrix product from a part.

        The product is a matrix times one ball's part of a solution; the difference is another ball's part.
        """
        for i in range(size):
            total = 0.0
            for k in range(size):
                total += matrix[i, k] * part[k]
            its[i] -= total

    return find_chains, take_from_block, take_from_columns, take_from_rows, write_ahead, take_part
