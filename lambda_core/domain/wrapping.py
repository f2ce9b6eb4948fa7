"""Wrap lines of a report to the terminal's width."""

from __future__ import annotations

import re
import textwrap
from collections.abc import Iterable, Sequence

HEAD = 17  # characters before what a line says
_INDENT = 9  # the same of lines without a head


def wrapped(lines: Sequence[str], width: int | None) -> list[str]:
    """Return lines no longer than `width`.

    Parts stay together where they fit, and go on below the first.
    """
    if width is None:
        return list(lines)
    found: list[str] = []
    for text in (part for line in lines for part in line.splitlines() or [""]):
        if len(text) <= width:
            found.append(text)
            continue
        indent = " " * (HEAD if len(text) > HEAD and text[HEAD - 1] == " " else _INDENT)
        row, body = (text[:HEAD], text[HEAD:]) if indent == " " * HEAD else ("", text)
        for part in re.split(r"(?<=\S)(?=  +\S)", body):
            if row.strip() and len(row) + len(part) > width:
                found.append(row)
                row = indent + part.strip()
            else:
                row += part
        found += textwrap.wrap(row, width, subsequent_indent=indent, break_on_hyphens=False, drop_whitespace=True)
    return found


def lines_under(head: str, texts: Iterable[str]) -> list[str]:
    """Return a line per text; the first has the head."""
    return [f"{'' if i else head:<{HEAD}}{text}".rstrip() for i, text in enumerate(texts)]
