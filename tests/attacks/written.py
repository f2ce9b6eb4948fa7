"""Write tables as TOML, whatever they contain."""

from __future__ import annotations

import json
from typing import Any


def toml(made: dict[str, Any]) -> str:
    """Return a table as a document.

    The reader must refuse what TOML has no word for.
    """
    return "".join(f"{_key(key)} = {_inline(content)}\n" for key, content in made.items())


def _key(text: str) -> str:
    return json.dumps(text, ensure_ascii=True)


def _inline(content: Any) -> str:
    if isinstance(content, dict):
        return "{" + ", ".join(f"{_key(key)} = {_inline(inner)}" for key, inner in content.items()) + "}"
    if isinstance(content, list):
        return "[" + ", ".join(_inline(inner) for inner in content) + "]"
    if isinstance(content, str):
        return json.dumps(content, ensure_ascii=True)
    if isinstance(content, bool):
        return str(content).lower()
    return "null" if content is None else repr(content)
