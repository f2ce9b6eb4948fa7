"""Read and write the values of form rows.

A value is an option of the draft, or a part of one such as a term of a sum.
"""

from __future__ import annotations

from copy import deepcopy
from typing import Any, Protocol

from lambda_core.api import Draft
from lambda_gui.nodes import Keys


class Place(Protocol):
    """Place of a written value."""

    @property
    def keys(self) -> Keys:
        """Path in the case."""

    def get(self) -> Any:
        """Return what is written, None where nothing is."""

    def put(self, value: Any) -> None:
        """Write a value; None takes it out."""


class Option:
    """An option of the draft."""

    def __init__(self, draft: Draft, keys: Keys) -> None:
        self._draft = draft
        self.keys = keys

    def get(self) -> Any:
        """Return what is written."""
        return self._draft.get(*self.keys)

    def put(self, value: Any) -> None:
        """Write a value."""
        self._draft.set(*self.keys, value=value)

    def part(self, name: str) -> Option:
        """Return the place of a table's entry.

        The table is here.
        """
        return Option(self._draft, (*self.keys, name))


class Part:
    """An entry of a list that is written completely."""

    def __init__(self, parent: Place, *path: int | str) -> None:
        self._parent, self._path = parent, path
        self.keys = (*parent.keys, *(str(part) for part in path))

    def get(self) -> Any:
        """Return the entry."""
        value = self._parent.get()
        for part in self._path:
            try:
                value = value[part]
            except (KeyError, IndexError, TypeError):
                return None
        return value

    def put(self, value: Any) -> None:
        """Write the list with this entry changed."""
        parent = deepcopy(self._parent.get())
        inner = parent
        for part in self._path[:-1]:
            inner = inner.setdefault(part, {}) if isinstance(inner, dict) else inner[part]
        if value is None and isinstance(inner, dict):
            inner.pop(self._path[-1], None)
        else:
            inner[self._path[-1]] = "" if value is None else value
        self._parent.put(parent)

    def part(self, name: str) -> Part:
        """Return the place of a table's entry.

        The table is here.
        """
        return Part(self._parent, *self._path, name)


class Held:
    """A value of a form that is no case."""

    def __init__(self, values: dict[Keys, Any], keys: Keys) -> None:
        self._values, self.keys = values, keys

    def get(self) -> Any:
        """Return the value."""
        return self._values.get(self.keys)

    def put(self, value: Any) -> None:
        """Set the value."""
        self._values[self.keys] = value
