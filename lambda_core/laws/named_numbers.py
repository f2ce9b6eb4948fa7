"""Convert records of numbers to flat arrays.

A kernel reads ``par.limit_ratio`` and ``par.knots[i]``. The solver hands every law one flat float64 array: in order of
declaration a number is one word, an array is its length and then its values, and a record within a record stands in
its place. :mod:`lambda_core.laws.jit.binding` reads the names back, at no cost.
"""

from __future__ import annotations

import math
import types
import typing
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, fields, is_dataclass
from functools import cache
from typing import Annotated, Any, get_args, get_origin

import numpy as np
from pydantic import BaseModel

_NUMBERS = (float, int, bool)
_KINDS = (float, int, np.number)  # of values; a tuple is asked faster than a union


class RecordError(ValueError):
    """Class or value that is no record.

    It cannot become a record of numbers; the message is the end of a sentence.
    """


@dataclass(frozen=True)
class Member:
    """One member of a record.

    It is a number ("float", "int", "bool"), an "array", or a record.
    """

    name: str
    kind: str | Layout


@dataclass(frozen=True)
class Layout:
    """The names of a record in order of declaration."""

    name: str
    members: tuple[Member, ...]

    @property
    def names(self) -> tuple[str, ...]:
        """The names that a kernel may read."""
        return tuple(member.name for member in self.members)


@cache
def layout_of(record: type) -> Layout:
    """Return the layout of a record type.

    Parameters
    ----------
    record : type
        A pydantic model, a NamedTuple or a dataclass whose members are ``float``, ``int``, ``bool``, arrays (a numpy
        array, or a list or tuple of numbers) or such records.

    Raises
    ------
    RecordError
        Naming the member of any other type.
    """
    return Layout(record.__name__, tuple(Member(name, _kind(record, name, hint)) for name, hint in _hints(record)))


def is_record(candidate: Any) -> bool:
    """Tell whether a type has named members.

    Such a type is a pydantic model, a NamedTuple or a dataclass.
    """
    if not isinstance(candidate, type):
        return False
    return issubclass(candidate, BaseModel) or is_dataclass(candidate) or hasattr(candidate, "_fields")


def flatten(layout: Layout, record: Any, behind: Iterable[float] = ()) -> np.ndarray[Any, np.dtype[np.float64]]:
    """Return a record as one flat array.

    Parameters
    ----------
    layout : Layout
        Of the record's type.
    record : object
        With these names, SI.
    behind : iterable of float
        Finite numbers that follow the record.

    Returns
    -------
    ndarray of float64, shape (n,)
        Contiguous and finite.

    Raises
    ------
    RecordError
        Naming the member that is no finite number, or no array of such.
    """
    found: list[float] = []
    _add_words(found, layout, record, "")
    return np.array([*found, *behind], dtype=np.float64)


def _hints(record: type) -> Iterator[tuple[str, Any]]:
    if issubclass(record, BaseModel):
        yield from ((name, info.annotation) for name, info in record.model_fields.items())
        return
    try:
        hints = typing.get_type_hints(record, include_extras=True)
    except NameError as error:
        raise RecordError(f"{record.__name__} is annotated with {error.name}, which its module does not have") from None
    names = [field.name for field in fields(record)] if is_dataclass(record) else record._fields  # type: ignore[attr-defined]
    yield from ((name, hints.get(name, float)) for name in names)


def _kind(record: type, name: str, hint: Any) -> str | Layout:
    while get_origin(hint) is Annotated:
        hint = get_args(hint)[0]
    if hint in _NUMBERS:
        return str(hint.__name__)
    if hint is np.float64:
        return "float"
    if is_record(hint):
        return layout_of(hint)
    origin = get_origin(hint)
    if hint is np.ndarray or origin is np.ndarray:
        return "array"
    if origin in (list, tuple) and all(item in (*_NUMBERS, Ellipsis) for item in map(_bare, get_args(hint))):
        return "array"
    said = getattr(hint, "__name__", str(hint)) if not isinstance(hint, types.GenericAlias) else str(hint)
    raise RecordError(f"{record.__name__}.{name} ({said}) is neither a number nor an array of numbers")


def _bare(hint: Any) -> Any:
    return get_args(hint)[0] if get_origin(hint) is Annotated else hint


def _add_words(found: list[float], layout: Layout, record: Any, path: str) -> None:
    for member in layout.members:
        value = getattr(record, member.name)
        if isinstance(member.kind, Layout):
            _add_words(found, member.kind, value, f"{path}{member.name}.")
        elif member.kind == "array":
            values = _numbers(value, f"{path}{member.name}")
            found.append(float(values.size))
            found += values.tolist()
        else:
            if not isinstance(value, _KINDS):
                raise RecordError(f"{path}{member.name} = {value!r}, must be a number")
            if not math.isfinite(value):
                raise RecordError(f"{path}{member.name} = {value}, must be finite")
            found.append(float(value))


def _numbers(value: Any, name: str) -> np.ndarray[Any, np.dtype[np.float64]]:
    try:
        values = np.asarray(value, dtype=np.float64)
    except (TypeError, ValueError):
        raise RecordError(f"{name} is a {type(value).__name__}, which is no array of numbers") from None
    if values.ndim != 1:
        raise RecordError(f"{name} has {values.ndim} dimensions, must have one")
    if not np.isfinite(values).all():
        index = int(np.flatnonzero(~np.isfinite(values))[0])
        raise RecordError(f"{name}[{index}] = {values[index]}, must be finite")
    return values
