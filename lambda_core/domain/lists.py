"""Read lists that callers give."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TypeVar

from lambda_core.domain.errors import UsageError

T = TypeVar("T")


def listed(given: Iterable[T], name: str) -> list[T]:
    """Return the items of an argument.

    Raises
    ------
    UsageError
        When it is one text, which Python would read letter by letter, or no list.
    """
    if isinstance(given, str):
        raise UsageError(f'{name}: "{given}" is a text, not a list: write ["{given}"]')
    if not isinstance(given, Iterable):
        raise UsageError(f"{name}: must be a list, not {type(given).__name__}: write [...]")
    return list(given)
