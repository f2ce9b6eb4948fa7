"""Compile with documented parts of Python and Numba only.

Taken where ``LAMBDA_BEARING_PLAIN_JIT`` is 1, or where Numba's internals are not those that :mod:`disk_cache` and
:mod:`inside_callers` know. The same keys and results; but nothing is kept on disk, so every process compiles for
itself.
"""

# Numba's compiler carries only part of its types.
# mypy: disable-error-code="no-untyped-call"
from __future__ import annotations

import dis
import os
import platform
from collections.abc import Callable
from functools import cache
from pathlib import Path
from types import CodeType
from typing import Any

VARIABLE = "LAMBDA_BEARING_PLAIN_JIT"
_READS = ("LOAD_GLOBAL", "LOAD_ATTR", "LOAD_METHOD")


def is_forced() -> bool:
    """Tell whether somebody asks for the plain way."""
    return os.environ.get(VARIABLE, "") not in ("", "0")


@cache
def is_plain() -> bool:
    """Tell whether this process uses the plain way.

    It loads Numba.
    """
    if is_forced():
        return True
    try:
        from lambda_core.laws.jit import disk_cache, inside_callers
    except (ImportError, AttributeError):  # another Numba than the one that was known
        return True
    return not (disk_cache.KNOWN and inside_callers.KNOWN)


def instructions(code: CodeType) -> tuple[tuple[str, str], ...]:
    """Return the instructions of a function.

    (operation, name), without a name where an instruction reads none.
    """
    read = ((each.opname, str(each.argval)) for each in dis.get_instructions(code) if each.opname != "EXTENDED_ARG")
    return tuple(pair if pair[0] in _READS else ("", "") for pair in read)


def attach(dispatcher: Any, function: Callable[..., Any], folder: Path, on_miss: Callable[[], None]) -> None:
    """Keep nothing: the function is compiled now."""
    on_miss()


def processor() -> tuple[str, ...]:
    """Return what tells machines apart."""
    import llvmlite.binding  # type: ignore[import-untyped]

    return platform.machine(), llvmlite.binding.get_host_cpu_name()


def callback(dispatcher: Any, signature: Any) -> tuple[int, object]:
    """Return a compiled function's address for C.

    Also return the object that keeps it alive.
    """
    from numba import cfunc

    made = cfunc(signature, **{key: value for key, value in dispatcher.targetoptions.items() if key != "nopython"})
    kept = made(dispatcher.py_func)
    return int(kept.address or 0), kept
