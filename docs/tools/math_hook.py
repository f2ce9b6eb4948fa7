"""Convert formulas between dollars to MathML.

No script and no font is loaded. Code is left alone.
"""

from __future__ import annotations

import re
from typing import Any, Literal

from latex2mathml.converter import convert

# Fenced and inline code first, so that a dollar in it is never looked at.
_PIECES = re.compile(
    r"(?P<code>^(?P<fence>```|~~~).*?^(?P=fence)[^\n]*$|`[^`\n]+`)"
    r"|\$\$(?P<display>.+?)\$\$"
    r"|(?<![\\$\w])\$(?P<inline>[^\s$](?:[^$\n]*[^\s$])?)\$(?![\d$])",
    re.M | re.S,
)
_FUNCTION = re.compile(r"<mi>(a?r?c?(?:sin|cos|tan)h?|exp|ln)</mi>(?P<open><mo[^>]*>&#x00028;|<mrow><mo|</)?")
_PRIME = re.compile(r"<msup>(<mi>\w</mi>)<mi>&#x02032;</mi></msup>")  # the sign is raised by itself
_SIGN = re.compile(r"(<mo[^>]*>(?!&#x00029;|\)|\])[^<]*</mo>)<mo>&#x02212;</mo>")  # a minus behind an operator


def on_page_markdown(markdown: str, **_: Any) -> str:
    """Return a page with formulas as MathML.

    Mkdocs calls it for every page.
    """
    return _PIECES.sub(_set, markdown)


def _set(piece: re.Match[str]) -> str:
    if piece["code"] is not None:
        return piece[0]
    if piece["display"] is not None:
        return f'<div class="formula">{mathml(piece["display"].strip(), "block")}</div>'
    return f"<span>{mathml(piece['inline'], 'inline')}</span>"  # a line that begins with math would become a block


def mathml(formula: str, display: Literal["inline", "block"]) -> str:
    """Return a formula as MathML, spaced as in print."""
    found = convert(formula, display=display)
    found = found.replace("<mo>&#x0002F;</mo>", '<mo lspace="0.08em" rspace="0.08em">&#x0002F;</mo>')
    found = _FUNCTION.sub(_function, found)
    found = _PRIME.sub(r"<mrow>\1<mo lspace='0' rspace='0'>&#x02032;</mo></mrow>", found)
    return _SIGN.sub(r"\1<mo form='prefix' lspace='0' rspace='0'>&#x02212;</mo>", found)


def _function(name: re.Match[str]) -> str:
    """Return the name of a function.

    A thin space before it, and behind it where no bracket follows.
    """
    behind = "0" if name["open"] else "0.17em"
    return f"<mo form='prefix' lspace='0.17em' rspace='{behind}'>{name[1]}</mo>{name['open'] or ''}"
