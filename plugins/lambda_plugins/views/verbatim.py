"""Draw texts without reading formulas in them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import fields, is_dataclass, replace
from typing import Any


def verbatim(value: Any) -> Any:
    """Return data to draw in which every text is literal.

    Parameters
    ----------
    value : object
        A text, or a dataclass, tuple or mapping with texts in it; other values are handed back.
    """
    if isinstance(value, str):
        return value.replace("$", r"\$")  # matplotlib reads a formula between two of them
    if isinstance(value, tuple):
        return tuple(verbatim(item) for item in value)
    if isinstance(value, Mapping):
        return {key: verbatim(item) for key, item in value.items()}
    if is_dataclass(value) and not isinstance(value, type):
        found = {field.name: getattr(value, field.name) for field in fields(value) if field.init}
        changed = {name: verbatim(item) for name, item in found.items()}
        return replace(value, **{name: item for name, item in changed.items() if item is not found[name]})
    return value
