"""Keep options and numbers in one piece."""

from __future__ import annotations

import re
from typing import Any

_BLOCK = re.compile(r"(<pre.*?</pre>|<math.*?</math>|<[^>]*>)", re.S)
_OPTION = re.compile(r"<code>(--?[^\s<]{1,30})</code>")
_THOUSANDS = re.compile(r"(?<=\d) (?=\d{3}(?!\d))")


def on_page_content(html: str, **_: Any) -> str:
    """Keep options and numbers of a page whole.

    Mkdocs calls it for every page.
    """
    pieces = _BLOCK.split(html)
    pieces[::2] = [_THOUSANDS.sub("\N{NO-BREAK SPACE}", text) for text in pieces[::2]]  # the odd ones are tags, blocks
    return _OPTION.sub(r'<code class="whole">\1</code>', "".join(pieces))
