"""Read the tree of declared options from pydantic classes."""

from __future__ import annotations

import types
from collections.abc import Iterator, Sequence
from functools import lru_cache
from typing import Any, Union, get_args, get_origin

from pydantic import BaseModel
from pydantic.fields import FieldInfo

_TAG = "kind:"


def members(annotation: Any) -> Iterator[type[BaseModel]]:
    """Yield the tables that a field allows.

    Its annotation may have unions, Annotated and dict values.
    """
    if isinstance(annotation, type) and issubclass(annotation, BaseModel):
        yield annotation
        return
    origin, arguments = get_origin(annotation), get_args(annotation)
    if origin in (Union, types.UnionType):
        for argument in arguments:
            yield from members(argument)
    elif hasattr(annotation, "__metadata__") or origin is list:
        yield from members(arguments[0])
    elif origin is dict:
        yield from members(arguments[1])


def is_time_function(table: type[BaseModel]) -> bool:
    """Tell whether a table is a kind of time function.

    Its kind is a tag that is always written; the kind of `bearing.rollers` is an option.
    """
    kind = table.model_fields.get("kind")
    return kind is not None and kind.is_required()


def is_tag(part: object) -> bool:
    """Tell whether a path's part is a union tag.

    A tag is no key of a file.
    """
    return isinstance(part, str) and part.startswith(_TAG)


def model_at(root: type[BaseModel], path: Sequence[int | str]) -> type[BaseModel] | None:
    """Return the table's class at `path`.

    None where the path leaves the declared tables.

    A tag behind a key ("kind:ramp") says which of its tables is meant; without one it is the first.
    """
    candidates: list[type[BaseModel]] = [root]
    open_keys = False
    for part in path:
        if isinstance(part, int) or open_keys:
            open_keys = False
            continue
        if is_tag(part):
            candidates = [table for table in candidates if part.removeprefix(_TAG) in _kinds(table)]
            continue
        infos = [info for c in candidates if (info := c.model_fields.get(part)) is not None]
        candidates = [member for info in infos for member in members(info.annotation)]
        open_keys = any(get_origin(info.annotation) is dict for info in infos)
    return candidates[0] if candidates else None


def _kinds(table: type[BaseModel]) -> tuple[Any, ...]:
    """Return the possible kinds of a time function."""
    kind = table.model_fields.get("kind")
    return get_args(kind.annotation) if kind else ()


def field_at(root: type[BaseModel], path: str) -> FieldInfo | None:
    """Return the option's declaration at a dotted path.

    None if there is none.
    """
    *parents, name = path.split(".")
    parent = model_at(root, parents)
    return parent.model_fields.get(name) if parent else None


@lru_cache(maxsize=4)
def option_paths(root: type[BaseModel]) -> tuple[str, ...]:
    """Return the dotted paths of all options.

    A time function counts as one option.
    """
    paths: list[str] = []

    def walk(model: type[BaseModel], prefix: str) -> None:
        for name, info in model.model_fields.items():
            path = f"{prefix}{name}"
            tables = [t for t in members(info.annotation) if not is_time_function(t)]
            if tables and get_origin(info.annotation) is not dict:
                walk(tables[0], f"{path}.")
            else:
                paths.append(path)

    walk(root, "")
    return tuple(paths)
