"""Sum over rows of blocks in fixed order.

The loops vectorise or keep sums in registers.
"""

from __future__ import annotations

from typing import Any

from lambda_core.solver.layout import ordered_rows_helper, rows_helper


def sums_of(size: int) -> tuple[Any, ...]:
    """Return the row and column functions.

    They are add_row, take_rows, add_columns and take_columns of blocks with `size` states.

    A size that the compiler knows keeps sums in registers: one that is read while the code runs takes 1.8 times as
    long.
    """

    @ordered_rows_helper
    def add_row(row, factor, other):
        """Add a multiple of another row of a ball's states."""
        for i in range(size):
            row[i] += factor * other[i]

    @ordered_rows_helper
    def take_rows(row, factors, rows, n):
        """Take multiples of rows.

        There are `size` rows; they are taken from the first n entries of a row.
        """
        for q in range(n):
            total = row[q]
            for k in range(size):
                total -= factors[k] * rows[k, q]
            row[q] = total

    @ordered_rows_helper
    def add_columns(part, factors, columns, n):
        """Add multiples of columns.

        There are n columns, which are kept as rows; one ball's part of a solution takes them.
        """
        for k in range(n):
            for i in range(size):
                part[i] += factors[k] * columns[k, i]

    @ordered_rows_helper
    def take_columns(part, factors, columns, n):
        """Take multiples of columns.

        There are n columns, which are kept as rows; one ball's part of a solution loses them.
        """
        for k in range(n):
            for i in range(size):
                part[i] -= factors[k] * columns[k, i]

    return add_row, take_rows, add_columns, take_columns


@ordered_rows_helper
def write_multiple(row, factor, other, n):
    """Write a multiple of a row.

    Its first n entries are written.
    """
    for i in range(n):
        row[i] = factor * other[i]


@rows_helper
def spread(row, places, own, factor, other, n):
    """Add two rows at their places.

    They are the first n entries of one, and a multiple of another.
    """
    for i in range(n):
        row[places[i]] += own[i] + factor * other[i]
