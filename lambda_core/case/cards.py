"""Describe a declared option for every user interface.

A card has label, unit, limits, default and help.
"""

from __future__ import annotations

import types
from collections.abc import Iterator
from typing import Any, Literal, Union, get_args, get_origin

from annotated_types import Ge, Gt, Le, Lt
from pydantic import BaseModel
from pydantic.fields import FieldInfo
from pydantic_core import PydanticUndefined

from lambda_core.case.option import quantity_of
from lambda_core.case.signals import TimeTable
from lambda_core.domain.option_tree import members
from lambda_core.domain.units import UNITS, show

Kind = Literal["text", "number", "integer", "flag", "choice", "quantity", "signal", "texts", "pairs", "table"]


class FieldCard(BaseModel):
    """One option or parameter, as people read it."""

    name: str
    description: str
    default: str  # as it would stand in a case file; "" when required or absent
    required: bool
    quantity: str  # "" for a plain number
    units: list[str]
    limits: list[str]  # "> 0 m", "<= 0.3"
    kind: Kind
    choices: list[str]
    reference: str


def field_card(model: type[BaseModel], name: str) -> FieldCard:
    """Return the card of one field.

    The field belongs to a table or to a model's parameters.
    """
    info = model.model_fields[name]
    quantity = "" if _is_of_pairs(info.annotation) else quantity_of(model, name)
    choices = _choices(info.annotation)
    extra = info.json_schema_extra if isinstance(info.json_schema_extra, dict) else {}
    return FieldCard(
        name=name,
        description=info.description or "",
        default=written(info.get_default(call_default_factory=True, validated_data={}), quantity),
        required=info.is_required(),
        quantity=quantity,
        units=list(UNITS[quantity or str(extra["x-quantity"])]) if quantity or "x-quantity" in extra else [],
        limits=list(limits(info, quantity)),
        kind=_kind(info, quantity, choices),
        choices=choices,
        reference=str(extra.get("x-reference", "")),
    )


def limits(info: FieldInfo, quantity: str) -> Iterator[str]:
    """Yield the limits of a field as people write them."""
    signs = {Gt: (">", "gt"), Ge: (">=", "ge"), Lt: ("<", "lt"), Le: ("<=", "le")}
    for limit in _metadata(info):
        if type(limit) in signs:
            sign, attribute = signs[type(limit)]
            yield f"{sign} {written(getattr(limit, attribute), quantity)}"


def written(value: Any, quantity: str) -> str:
    """Write a default or limit as in a case."""
    if value is PydanticUndefined or value is None or isinstance(value, dict):
        return ""
    if isinstance(value, list | tuple):
        items = [written(item, quantity) for item in value]
        return f"[{', '.join(items)}]" if items and all(items) else ""
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, float | int):
        return show(float(value), quantity) if quantity else f"{value:g}"
    return str(value)


def _metadata(info: FieldInfo) -> list[Any]:
    """Return the metadata of a field.

    This includes metadata inside ``X | None``.
    """
    found = list(info.metadata)
    for member in get_args(info.annotation):
        found += getattr(member, "__metadata__", ())
    return found


def _plain(annotation: Any) -> list[Any]:
    """Return what an annotation allows besides None, without its decoration."""
    if get_origin(annotation) in (Union, types.UnionType):
        return [plain for member in get_args(annotation) for plain in _plain(member)]
    if hasattr(annotation, "__metadata__"):
        return _plain(get_args(annotation)[0])
    return [] if annotation is type(None) else [annotation]


def _choices(annotation: Any) -> list[str]:
    return [
        str(choice)
        for plain in _plain(annotation)
        if get_origin(plain) is Literal
        for choice in get_args(plain)
        if choice is not None
    ]


def _is_of_pairs(annotation: Any) -> bool:
    """Return whether a list of pairs is allowed."""
    lists = (plain for plain in _plain(annotation) if get_origin(plain) is list)
    return any(get_origin(item) is tuple for plain in lists for item in get_args(plain))


def _kind(info: FieldInfo, quantity: str, choices: list[str]) -> Kind:
    tables = list(members(info.annotation))
    if any(issubclass(table, TimeTable) for table in tables):
        return "signal"
    if tables or dict in [get_origin(plain) for plain in _plain(info.annotation)]:
        return "table"
    if _is_of_pairs(info.annotation):
        return "pairs"
    if quantity:
        return "quantity"
    if choices:
        return "choice"
    plain = _plain(info.annotation)
    if any(get_origin(item) in (list, tuple) for item in plain):
        return "texts"
    simple: dict[Any, Kind] = {bool: "flag", int: "integer", float: "number"}
    return next((simple[item] for item in plain if item in simple), "text")
