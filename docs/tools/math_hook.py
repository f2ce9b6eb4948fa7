"""Formulas of the pages, set when the site is built: LaTeX between dollars becomes MathML, which browsers draw.

No script and no font is loaded. Code is left alone.
"""

from __future__ import annotations

import re
from typing import Any

from latex2mathml.converter import convert

# Fenced and inline code first, so that a dollar in it is never looked at.
_PIECES = re.compile(
    r"(?P<code>^(?P<fence>```|~~~).*?^(?P=fence)[^\n]*$|`[^`\n]+`)"
    r"|\$\$(?P<display>.+?)\$\$"
    r"|(?<![\\$\w])\$(?P<inline>[^\s$](?:[^$\n]*[^\s$])?)\$(?![\d$])",
    re.M | re.S,
)


def on_page_markdown(markdown: str, **_: Any) -> str:
    """Return a page's text with its formulas as MathML; called by mkdocs for every page."""
    return _PIECES.sub(_set, markdown)


def _set(piece: re.Match[str]) -> str:
    if piece["code"] is not None:
        return piece[0]
    if piece["display"] is not None:
        return f'<div class="formula">{convert(piece["display"].strip(), display="block")}</div>'
    return f"<span>{convert(piece['inline'])}</span>"  # markdown would take a line that begins with math for a block
