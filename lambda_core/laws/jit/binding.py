"""Between the solver's flat array and a kernel's named parameters: a few lines of generated Python for each law.

The solver calls every law with one flat array of parameters, always in the same form, so that laws can be exchanged
without compiling the solver. What is written here makes a record of that array and hands it to the kernel; compiled, it
is taken into the kernel, and reading ``par.limit_ratio`` is reading one number.
"""

from __future__ import annotations

import inspect
from collections import namedtuple
from collections.abc import Callable, Iterator
from functools import lru_cache
from types import FunctionType
from typing import Any

from lambda_core.laws.named_numbers import Layout

FILE = "<parameters by name>"  # stands for the file of generated code in messages


class PositionError(TypeError):
    """A kernel read its parameters by position; `index` is what it asked for."""

    def __init__(self, index: object) -> None:
        super().__init__(f"par[{index}]")
        self.index = index


def source(arguments: tuple[str, ...], layout: Layout, taken: tuple[str, ...]) -> str:
    """Return the generated function as text.

    Parameters
    ----------
    arguments : tuple of str
        Of the role, in order; one of them is ``par``.
    layout : Layout
        Names of the record, in the order of the flat array.
    taken : tuple of str
        Arguments that the kernel has.
    """
    counts: list[str] = []
    record, _ = _record(layout, "0", counts, iter(range(1000)))
    handed = ", ".join("record" if name == "par" else name for name in taken)
    lines = [
        f"def flat({', '.join(arguments)}):",
        *counts,
        f"record = {record}",
        f"return kernel({handed})",
    ]
    return "\n    ".join(lines) + "\n"


@lru_cache(maxsize=256)
def taken_by(kernel: Callable[..., int]) -> tuple[str, ...]:
    """Return the names of a kernel's arguments: it may leave out what its role had not at first."""
    return tuple(inspect.signature(kernel).parameters)


@lru_cache(maxsize=256)
def bound(
    kernel: Callable[..., int], arguments: tuple[str, ...], layout: Layout, *, strict: bool = False
) -> FunctionType:
    """Return the function that takes the flat array and calls the kernel with the record.

    Parameters
    ----------
    kernel : function
        It is called with a record in place of the flat array.
    arguments, layout
        As for :func:`source`.
    strict : bool
        For calls in plain Python: a record that refuses to be read by position (:class:`PositionError`).
    """
    scope: dict[str, Any] = {"__name__": kernel.__module__, "kernel": kernel}
    for place, each in enumerate(_layouts(layout)):
        base: type = namedtuple(each.name, each.names)  # type: ignore[misc]
        scope[f"Record{place}"] = type(each.name, (_Strict, base), {}) if strict else base
    exec(compile(source(arguments, layout, taken_by(kernel)), FILE, "exec"), scope)
    made: FunctionType = scope["flat"]
    made.__name__ = made.__qualname__ = kernel.__name__
    return made


class _Strict:
    """A record's names without its positions."""

    def __getitem__(self, index: object) -> Any:
        raise PositionError(index)

    def __iter__(self) -> Iterator[Any]:
        raise PositionError("...")


def _layouts(layout: Layout) -> Iterator[Layout]:
    """Yield every record in the order in which :func:`_record` numbers them."""
    yield layout
    for member in layout.members:
        if isinstance(member.kind, Layout):
            yield from _layouts(member.kind)


def _record(layout: Layout, start: str, counts: list[str], places: Iterator[int]) -> tuple[str, str]:
    """Return (the record written as a call, the place behind its last word); fixed steps are summed up."""
    place, words = next(places), []
    for member in layout.members:
        if isinstance(member.kind, Layout):
            word, start = _record(member.kind, start, counts, places)
        elif member.kind == "array":
            count = f"n{len(counts)}"
            counts.append(f"{count} = int(par[{start}])")
            begin = _after(start, 1)
            start = f"{count} + {begin}"
            word = f"par[{begin}:{start}]"
        else:
            word = {"float": "par[{}]", "int": "int(par[{}])", "bool": "par[{}] != 0.0"}[member.kind].format(start)
            start = _after(start, 1)
        words.append(word)
    return f"Record{place}({', '.join(words)})", start


def _after(place: str, step: int) -> str:
    """Return a place some words on: "n0 + 3" after "n0 + 2"."""
    head, _, last = place.rpartition(" + ")
    return f"{head} + {int(last) + step}" if head else str(int(last) + step)
