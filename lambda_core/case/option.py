"""Declare an option once: default, help, limits and source."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, ClassVar

from pydantic import BaseModel, ConfigDict, Field

from lambda_core.domain.units import Quantity

NAME_PATTERN = r"^[A-Za-z0-9][A-Za-z0-9._-]*$"


class Section(BaseModel):
    """Base of every table of a case.

    It accepts no unknown keys, is immutable, and checks defaults like input.
    """

    # what to write in place of a name that one would expect here
    INSTEAD: ClassVar[Mapping[str, str]] = {}

    model_config = ConfigDict(extra="forbid", frozen=True, validate_default=True, allow_inf_nan=False, defer_build=True)


def option(default: Any = ..., description: str = "", *, reference: str = "", quantity: str = "", **limits: Any) -> Any:
    """Declare one option of a case.

    Parameters
    ----------
    default : object
        What holds when nothing is written, as it would stand in a file (``"0.1 um"``); ``...`` means required.
    description : str
        One sentence for people.
    reference : str
        Where the default or the meaning comes from.
    quantity : str
        Of a text that may be a value with its unit, or a name.
    **limits
        Passed to :func:`pydantic.Field` (``ge``, ``gt``, ``le``, ``lt``, ``min_length`` ...), in SI.
    """
    extra: dict[str, Any] = {"x-reference": reference} if reference else {}
    extra |= {"x-quantity": quantity} if quantity else {}
    return Field(default, description=description, json_schema_extra=extra or None, **limits)


def quantity_of(model: type[BaseModel], name: str) -> str:
    """Return the quantity of a plain dimensional field.

    It is "" for any other field.
    """
    info = model.model_fields.get(name)
    if info is None:
        return ""
    pending: list[Any] = [info.annotation, *info.metadata]
    while pending:
        item = pending.pop()
        if isinstance(item, Quantity):
            return item.name
        pending.extend(getattr(item, "__metadata__", ()))
        pending.extend(getattr(item, "__args__", ()))
    return ""
