"""Format tables and headings of generated pages."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

NOTE = "<!-- written by docs/tools/renew.py from the code: do not edit -->\n"


def cell(text: object) -> str:
    """Return text that stands in one cell of a table."""
    return " ".join(str(text).split()).replace("|", "\\|").replace("<", "&lt;") or "-"


def code(text: str) -> str:
    """Return text in code type; nothing for nothing."""
    return f"`{text}`" if text else ""


def table(head: Sequence[str], rows: Iterable[Sequence[str]]) -> list[str]:
    """Return the lines of a table.

    And an empty one below it.
    """
    lines = [f"| {' | '.join(head)} |", f"|{'---|' * len(head)}"]
    lines += [f"| {' | '.join(part or '-' for part in row)} |" for row in rows]
    return [*lines, ""]


def page(lines: Iterable[str]) -> str:
    """Return a generated page."""
    return f"{NOTE}\n" + "\n".join(lines).rstrip() + "\n"
