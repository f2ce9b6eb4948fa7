"""Store named tuples as words that compiled code reads.

Numba is not needed here: what stands in the words is the same wherever compiled code comes from. :mod:`.references`
reads the fields in code that is compiled here.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, TypeVar

import numpy as np
from numpy.typing import NDArray

HEAD = 4  # words of an array before its address: two of Numba's memory management, items, size of an item
_FUNCTION_WORDS = 3  # of a pointer to a function: its address for C, and two for Python, which stay 0
T = TypeVar("T")


@dataclass(frozen=True)
class Array:
    """Arrays in C order.

    Attributes
    ----------
    dtype : dtype
        Of its items: numbers, or a record.
    ndim : int
    """

    dtype: np.dtype[Any]
    ndim: int = 1

    @property
    def words(self) -> int:
        """Number of words of an array."""
        return HEAD + 1 + 2 * self.ndim

    def of(self, value: Any, address: int) -> tuple[int, ...]:
        """Return the words of an array.

        Its items are at an address.

        Raises
        ------
        TypeError
            When it is of another type: compiled code would read past its end.
        """
        if value.ndim != self.ndim or value.itemsize != self.dtype.itemsize or not value.flags.c_contiguous:
            raise TypeError(f"an array of {value.dtype}, shape {value.shape}, where compiled code takes {self}")
        if self.dtype.names is None and value.dtype != self.dtype:
            raise TypeError(f"an array of {value.dtype} where compiled code takes {self}")
        return (0, 0, value.size, value.itemsize, address, *value.shape, *value.strides)

    def __str__(self) -> str:
        what = f"records of {self.dtype.itemsize} bytes" if self.dtype.names else str(self.dtype)
        return f"{what} in {self.ndim} dimension{'s' if self.ndim > 1 else ''}"


@dataclass(frozen=True)
class Function:
    """A pointer to a compiled function."""

    words: int = _FUNCTION_WORDS


FUNCTION = Function()
Kind = Array | Function | type  # the last of them by :func:`by_reference`


def words_of(kind: Kind) -> int:
    """Return how many words of eight bytes a field takes."""
    return sum(map(words_of, kinds_of(kind).values())) if isinstance(kind, type) else kind.words


def kinds_of(named: Any) -> Mapping[str, Kind]:
    """Return the kinds of a class's fields.

    The class comes from :func:`by_reference`; they are in the order of the tuple.
    """
    found: Mapping[str, Kind] = named.KINDS
    return found


def attribute(named: type) -> str:
    """Return the attribute of the words' address.

    It belongs to this class and no other.
    """
    return f"address_{named.__name__}"


def by_reference(otherwise: Kind | None = None, /, **kinds: Kind) -> Callable[[type[T]], type[T]]:
    """Give a class of named tuples an address.

    Compiled code uses it; the words are made when it is first needed.

    Parameters
    ----------
    otherwise : Array, Function or class from by_reference, optional
        Kind of the fields that are not named.
    **kinds : the same
        Kinds of fields by name.
    """

    def made(named: Any) -> Any:
        fields = {name: kinds.get(name, otherwise) for name in named._fields}
        assert kinds.keys() <= fields.keys(), named
        own: dict[str, Any] = {name: getattr(named, name) for name in ("__module__", "__doc__", "__qualname__")}
        own["__getstate__"] = lambda _: None  # a copy, in this process or another, has arrays at other addresses
        kept: Any = type(named.__name__, (named,), {**own, "KINDS": fields})  # without __slots__, unlike the tuple
        setattr(kept, attribute(kept), property(_address))
        return kept

    return made


def _address(self: Any) -> int:
    kept: Any = self.__dict__.get("_words")
    if kept is None:
        kept = self._words = np.array(words(type(self), self), dtype=np.int64)
    return int(kept.ctypes.data)


def words(kind: Kind, value: Any) -> list[int]:
    """Return the words of a field.

    TypeError where an array is of another type.
    """
    found: list[int] = []
    _add_words(found, kind, value)
    return found


def _add_words(found: list[int], kind: Kind, value: Any) -> None:
    if isinstance(kind, Array):
        found += kind.of(value, int(value.ctypes.data))
    elif isinstance(kind, Function):
        found += (value.__wrapper_address__(), 0, 0)
    else:
        for of_field, one in zip(kinds_of(kind).values(), value, strict=True):  # in the order of the tuple
            _add_words(found, of_field, one)


def addresses(rows: Sequence[Sequence[Any]]) -> NDArray[np.int64]:
    """Return the table of rows of pointers.

    They point to compiled functions; the table does not keep their code alive.
    """
    return np.array([[pointer.__wrapper_address__() for pointer in row] for row in rows], dtype=np.int64)
