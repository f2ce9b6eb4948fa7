"""Call a kernel on trial.

It runs in plain Python with protected inputs, and in machine code between guard cells.
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Any

import numpy as np

from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.errors import unknown_name
from lambda_core.domain.plugin_errors import describe
from lambda_core.domain.role import Role
from lambda_core.laws.jit import binding

_GUARD = 8  # cells on either side of every array
_SENTINEL = -7.25e77
_LONGEST = 2_000_000  # lines of Python that one call may take; the default laws take some hundreds


class _EndlessError(Exception):
    """A kernel executed more lines than any law needs."""


@contextmanager
def _ending(most: int) -> Iterator[None]:
    """Limit the lines that Python executes within.

    More than `most` lines end the code; a debugger prevents this.
    """
    before = sys.gettrace()
    if before is not None:
        yield
        return
    left = most

    def count(_frame: object, event: str, _argument: object) -> Any:
        nonlocal left
        if event == "line":
            left -= 1
            if left < 0:
                raise _EndlessError
        return count

    sys.settrace(count)
    try:
        yield
    finally:
        sys.settrace(None)


@dataclass(frozen=True)
class Outcome:
    """Status and outputs of one call.

    A fault is the end of a sentence about it.
    """

    status: int = 0
    outputs: tuple[FloatArray, ...] = ()
    error: str = ""
    comparable: bool = True  # False where Python raises on arithmetic that IEEE numbers define


def plain_call(kernel: Callable[..., int], role: Role, arguments: list[Any]) -> Outcome:
    """Call the kernel in plain Python.

    It gets copies whose inputs cannot be written.
    """
    copies = [np.array(value) if isinstance(value, np.ndarray) else value for value in arguments]
    for argument, value in zip(role.arguments, copies, strict=True):
        if isinstance(value, np.ndarray) and not argument.output:
            value.flags.writeable = False
    try:
        with np.errstate(all="ignore"), _ending(_LONGEST):
            status = kernel(*copies)
    except _EndlessError:
        return Outcome(error=f"does not come to an end: {_LONGEST} lines were executed")
    except IndexError as error:
        return Outcome(error=f"reads or writes outside its arrays: {describe(error)}")
    except ArithmeticError:
        return Outcome(comparable=False)
    except binding.PositionError as error:
        return Outcome(error=f"reads par[{error.index}], but since version 2 its parameters have names")
    except AttributeError as error:
        names = getattr(error.obj, "_fields", None)
        if names is None:
            return Outcome(error=f"raises {describe(error)} in plain Python")
        return Outcome(error=f"reads par.{error.name}: {unknown_name('parameter', str(error.name), names)}")
    except ValueError as error:
        if "read-only" in str(error):
            return Outcome(error=f"writes into one of its inputs: {describe(error)}")
        if "math domain" in str(error) or "expected a" in str(error):
            return Outcome(comparable=False)
        return Outcome(error=f"raises {describe(error)} in plain Python")
    except Exception as error:
        return Outcome(error=f"raises {describe(error)} in plain Python")
    outputs = tuple(v for a, v in zip(role.arguments, copies, strict=True) if a.output)
    return Outcome(status, outputs)


def handed_over(role: Role, arguments: list[Any]) -> list[Any]:
    """Return the arguments of one contact.

    Compiled laws take them so: numbers in which contacts differ are arrays of one.
    """
    pairs = zip(role.arguments, arguments, strict=True)
    return [np.array([value]) if argument.each else value for argument, value in pairs]


def compiled_call(dispatcher: Callable[..., int], role: Role, arguments: list[Any]) -> Outcome:
    """Call the compiled kernel twice.

    Guard cells surround its arrays.

    The outputs are filled with NaN the first time and with a number the second: a kernel
    that reads its outputs, or keeps a state, answers differently.
    """
    answers, arguments = [], handed_over(role, arguments)
    for fill in (np.nan, 0.5):
        buffers = [_guarded(value) if isinstance(value, np.ndarray) else value for value in arguments]
        views = [_inside(value) if isinstance(value, np.ndarray) else value for value in buffers]
        for argument, view in zip(role.arguments, views, strict=True):
            if argument.output:
                view[:] = fill
        status = dispatcher(*views)
        for argument, value, buffer, view in zip(role.arguments, arguments, buffers, views, strict=True):
            if not isinstance(value, np.ndarray):
                continue
            if (buffer[:_GUARD] != _SENTINEL).any() or (buffer[-_GUARD:] != _SENTINEL).any():
                return Outcome(error=f"writes outside the array {argument.name}")
            if not argument.output and not np.array_equal(view, value):
                return Outcome(error=f"writes into its input {argument.name}")
        answers.append((status, tuple(v.copy() for a, v in zip(role.arguments, views, strict=True) if a.output)))
    (status, first), (status_again, second) = answers
    if status != status_again or (status == 1 and not _same(first, second)):
        if status == status_again and any(np.isnan(values).any() for values in first):
            return Outcome(status, first)  # unwritten outputs: told as such
        return Outcome(error="answers differently when called again: it reads its outputs or keeps a state")
    return Outcome(status, first)


def relative_difference(found: tuple[FloatArray, ...], expected: tuple[FloatArray, ...]) -> float:
    """Return the largest relative difference.

    It is relative to the larger magnitude (NaN equals NaN).
    """
    worst = 0.0
    for one, other in zip(found, expected, strict=True):
        scale = np.maximum(np.abs(one), np.abs(other))
        with np.errstate(all="ignore"):
            ratio = np.where(one == other, 0.0, np.abs(one - other) / scale)
        ratio[np.isnan(one) & np.isnan(other)] = 0.0
        worst = max(worst, float(np.max(np.nan_to_num(ratio, nan=np.inf), initial=0.0)))
    return worst


def _guarded(value: FloatArray) -> FloatArray:
    return np.concatenate([np.full(_GUARD, _SENTINEL), value, np.full(_GUARD, _SENTINEL)])


def _inside(buffer: FloatArray) -> FloatArray:
    return buffer[_GUARD : buffer.size - _GUARD]


def _same(first: tuple[FloatArray, ...], second: tuple[FloatArray, ...]) -> bool:
    return all(np.array_equal(one, other, equal_nan=True) for one, other in zip(first, second, strict=True))
