"""Define benchmark tables and targets, and print them.

The forms are text, Markdown and JSON.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

Cell = str | float | int | None


@dataclass(frozen=True)
class Table:
    """Hold measured numbers; the column names contain the units."""

    title: str
    columns: tuple[str, ...]
    rows: tuple[tuple[Cell, ...], ...]
    notes: tuple[str, ...] = ()


@dataclass(frozen=True)
class Target:
    """Figure with its limits.

    `at_least` makes them lower limits.
    """

    what: str
    unit: str
    reached: float
    must: float | None = None
    goal: float | None = None
    at_least: bool = False

    @property
    def verdict(self) -> str:
        """Best limit that was met.

        "goal", "must" or "missed".
        """
        for name, limit in (("goal", self.goal), ("must", self.must)):
            if limit is not None and self._meets(limit):
                return name
        return "missed"

    def limit(self, value: float | None) -> str:
        """Return one limit for people."""
        return "" if value is None else f"{'≥' if self.at_least else '≤'} {number(value)}"

    def _meets(self, limit: float) -> bool:
        return self.reached >= limit if self.at_least else self.reached <= limit


@dataclass(frozen=True)
class Section:
    """Tables of one benchmark.

    Or the reason why they are `missing`.
    """

    name: str
    tables: tuple[Table, ...] = ()
    targets: tuple[Target, ...] = ()
    missing: str = ""
    failed: bool = False  # where it should have measured
    seconds: float = 0.0
    load: float = math.nan  # load average of the machine when it ended


def number(value: Cell) -> str:
    """Return a cell with three significant digits."""
    if value is None:
        return "-"
    if isinstance(value, str):
        return value
    if isinstance(value, int):
        return str(value)
    if not math.isfinite(value):
        return str(value)
    if value == 0.0 or 1e-3 <= abs(value) < 1e5:
        digits = 2 - math.floor(math.log10(abs(value))) if value else 0
        return f"{value:.{max(digits, 0)}f}"
    return f"{value:.1e}"


def target_table(targets: tuple[Target, ...]) -> Table:
    """Return targets as a table."""
    rows = tuple((t.what, t.unit, t.reached, t.limit(t.must), t.limit(t.goal), t.verdict) for t in targets)
    return Table("Targets", ("figure", "unit", "reached", "must", "goal", "met"), rows)


def as_text(table: Table) -> str:
    """Return a table for a terminal."""
    cells = [table.columns, *(tuple(number(cell) for cell in row) for row in table.rows)]
    widths = [max(len(row[i]) for row in cells) for i in range(len(table.columns))]
    lines = ["  ".join(cell.ljust(width) for cell, width in zip(row, widths, strict=True)).rstrip() for row in cells]
    return "\n".join([table.title, *lines, *(f"  {note}" for note in table.notes)])


def as_markdown(table: Table, level: int = 3) -> str:
    """Return a table for the documentation."""
    lines = [f"{'#' * level} {table.title}", "", _row(table.columns), _row(("---",) * len(table.columns))]
    lines += [_row(tuple(number(cell) for cell in row)) for row in table.rows]
    return "\n".join([*lines, *(f"\n{note}" for note in table.notes)])


def _row(cells: tuple[str, ...]) -> str:
    return f"| {' | '.join(cell.replace('|', '/') for cell in cells)} |"
