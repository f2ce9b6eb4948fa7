"""Generate the code between solver arrays and kernels.

The solver calls every law with one flat array of parameters, always in the same form, so that laws can be exchanged
without compiling the solver. What is written here makes a record of that array and hands it to the kernel; compiled, it
is taken into the kernel, and reading ``par.limit_ratio`` is reading one number.

One call is for all contacts of a raceway. Where a role has numbers that differ between them, what is written here goes
through the contacts in a loop: compilers take several of them at once where the kernel allows it.
"""

from __future__ import annotations

import inspect
from collections import namedtuple
from collections.abc import Callable, Iterator
from functools import lru_cache
from types import FunctionType
from typing import Any

from lambda_core.domain.role import Argument, Role
from lambda_core.laws.named_numbers import Layout

STRIDE = 8  # from the outputs of one contact to those of the next, in a role without cells: a line of the cache
FILE = "<parameters by name>"  # stands for the file of generated code in messages


class PositionError(TypeError):
    """Kernel that read its parameters by position.

    `index` is the position that it read.
    """

    def __init__(self, index: object) -> None:
        super().__init__(f"par[{index}]")
        self.index = index


def stretch(array: Any, start: int, count: int) -> Any:
    """Return part of an array as view.

    Compiled code does not check the end of the array.
    """
    return array[start : start + count]


def status_of(returned: Any) -> Any:
    """Return the result of a kernel as status.

    Compiled code refuses anything but an int64.
    """
    return returned


def source(role: Role, layout: Layout, taken: tuple[str, ...], *, alone: bool = False, fenced: bool = False) -> str:
    """Return the generated function as text.

    Parameters
    ----------
    role : Role
        Of the kernel; one of its arguments is ``par``.
    layout : Layout
        Names of the record, in the order of the flat array.
    taken : tuple of str
        Arguments that the kernel has.
    alone : bool
        For one contact, whose numbers are numbers. Otherwise those in which contacts differ are arrays, as are cells
        and outputs of all contacts one after another, and the status is another one than 1 where any contact has one.
    fenced : bool
        An elementwise kernel is handed one cell at a time, so that no index of it reaches another cell or contact.
    """
    counts: list[str] = []
    record, _ = _record(layout, "0", counts, iter(range(1000)))
    lines = [
        f"def flat({', '.join(argument.name for argument in role.arguments)}):",
        *counts,
        f"record = {record}",
    ]
    known = {argument.name: argument for argument in role.arguments}
    written = next(argument.name for argument in role.arguments if argument.output)
    if fenced and role.elementwise and not role.batched:
        cell = [f"stretch({name}, k, 1)" if _is_cells(known[name]) else _named(name) for name in taken]
        return "\n    ".join([*lines, *_looped(f"{written}.size", ", ".join(cell))]) + "\n"
    if alone or not role.batched:
        return "\n    ".join([*lines, f"return kernel({', '.join(map(_named, taken))})"]) + "\n"
    first = next(argument.name for argument in role.arguments if argument.each)
    if role.elementwise:
        lines.append(f"cells = {written}.size // {first}.size")
    handed = ", ".join(_of_contact(role, known[name]) for name in taken)
    return "\n    ".join([*lines, *_looped(f"{first}.size", handed)]) + "\n"


def _looped(count: str, handed: str) -> list[str]:
    """Return the lines that call the kernel repeatedly.

    `count` times, with 1 for a status where every call has 1.
    """
    return [
        "failed = 0",
        f"for k in range({count}):",
        f"    failed |= status_of(kernel({handed})) ^ 1",
        "return failed ^ 1",
    ]


def _is_cells(argument: Argument) -> bool:
    return argument.kind == "a" and argument.name != "par"


def _named(name: str) -> str:
    return "record" if name == "par" else name


def _of_contact(role: Role, argument: Argument) -> str:
    """Return an argument's value for contact k.

    The kernel gets this value.
    """
    if argument.each:
        return f"{argument.name}[k]"
    if argument.kind == "f" or argument.name == "par":
        return _named(argument.name)
    if role.elementwise:
        return f"stretch({argument.name}, k * cells, cells)"
    return f"stretch({argument.name}, k * {STRIDE}, {len(role.outputs)})"


@lru_cache(maxsize=256)
def taken_by(kernel: Callable[..., int]) -> tuple[str, ...]:
    """Return the names of a kernel's arguments.

    It may leave out what its role did not have at first.
    """
    return tuple(inspect.signature(kernel).parameters)


@lru_cache(maxsize=256)
def bound(
    kernel: Callable[..., int],
    role: Role,
    layout: Layout,
    *,
    alone: bool = False,
    strict: bool = False,
    fenced: bool = False,
) -> FunctionType:
    """Return the function that takes the flat array.

    It calls the kernel with the record.

    Parameters
    ----------
    kernel : function
        It is called with a record in place of the flat array.
    role, layout, alone, fenced
        As for :func:`source`.
    strict : bool
        For calls in plain Python: a record that refuses to be read by position (:class:`PositionError`).
    """
    scope: dict[str, Any] = {
        "__name__": kernel.__module__,
        "kernel": kernel,
        "stretch": stretch,
        "status_of": status_of,
    }
    for place, each in enumerate(_layouts(layout)):
        base: type = namedtuple(each.name, each.names)  # type: ignore[misc]
        scope[f"Record{place}"] = type(each.name, (_Strict, base), {}) if strict else base
    exec(compile(source(role, layout, taken_by(kernel), alone=alone, fenced=fenced), FILE, "exec"), scope)
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
    """Yield every record in order.

    :func:`_record` numbers them in this order.
    """
    yield layout
    for member in layout.members:
        if isinstance(member.kind, Layout):
            yield from _layouts(member.kind)


def _record(layout: Layout, start: str, counts: list[str], places: Iterator[int]) -> tuple[str, str]:
    """Return the record as call, and the end.

    The end is the place behind its last word; fixed steps are summed up.
    """
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
    """Return a place some words on.

    An example is "n0 + 3" after "n0 + 2".
    """
    head, _, last = place.rpartition(" + ")
    return f"{head} + {int(last) + step}" if head else str(int(last) + step)
