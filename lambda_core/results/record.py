"""Define the base of the machine interface."""

from __future__ import annotations

from collections.abc import Collection
from typing import Any

from pydantic import BaseModel, ConfigDict

INTERFACE = 1


class Record(BaseModel):
    """Base of what the machine interface is made of."""

    model_config = ConfigDict(frozen=True, extra="forbid", defer_build=True)

    def __eq__(self, other: object) -> bool:
        """Compare what is declared.

        The origin of a record, which it may remember, does not count.
        """
        return type(other) is type(self) and self.__dict__ == other.__dict__

    def __str__(self) -> str:
        """Return the lines of text.

        A record without a text gives its short form.
        """
        text = getattr(type(self), "text", None)
        return str(text(self)) if callable(text) else repr(self)

    def _repr_html_(self) -> str:
        """Return what a notebook shows: the lines for people."""
        from html import escape

        return f"<pre>{escape(str(self))}</pre>"


def by_bearing(
    record: Record, name: str, around: Collection[str], totals: Collection[str], **more: Any
) -> dict[str, Any]:
    """Return plain data as those of a machine.

    A program then reads one bearing and several in the same way.

    Parameters
    ----------
    record : Record
        Answer about one bearing.
    name : str
        Of the bearing, which has its own table in ``bearings``.
    around : collection of str
        Fields that stand outside that table.
    totals : collection of str
        Fields of the bearing that stand outside its table, too.
    **more
        Further numbers outside.
    """
    data = record.model_dump(mode="json")
    outside = {key: data.pop(key) for key in around} | {key: data[key] for key in totals}
    return outside | more | {"bearings": {name: data}}
