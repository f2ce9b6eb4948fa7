"""Use the documented part of Numba.

Import it inside functions: Numba takes more than a second to load.
"""

# Numba's caching classes carry only part of their types.
# mypy: disable-error-code="no-untyped-call,attr-defined,assignment"
from __future__ import annotations

import atexit
import contextlib
import gc
import hashlib
import importlib.metadata
import os
import platform
import shutil
import time
import warnings
from collections.abc import Callable
from pathlib import Path
from types import FunctionType, ModuleType
from typing import Any
from weakref import WeakSet

import llvmlite.binding as llvm  # type: ignore[import-untyped]
from numba import config, njit, types
from numba.core.errors import NumbaExperimentalFeatureWarning
from numba.extending import register_jitable

from lambda_core.domain.errors import UsageError
from lambda_core.domain.role import Role
from lambda_core.laws.jit import inlined, plain, stretches
from lambda_core.laws.jit.plain import is_plain

# What Numba makes is full of cycles: to look for them takes an ending interpreter half a second for nothing.
atexit.register(gc.freeze)


def _take_wide_vectors() -> None:
    """Let loops over cells use 512 bits.

    It does so only where the processor has them and keeps its clock with them.

    LLVM takes half of them on Intel's processors, the first of which slowed down; AVX512-VBMI2
    marks the later ones, from Ice Lake on. What the user sets (NUMBA_CPU_NAME, NUMBA_CPU_FEATURES) stays.
    """
    if config.CPU_NAME is not None or config.CPU_FEATURES is not None or not config.ENABLE_AVX:
        return
    with contextlib.suppress(RuntimeError):  # LLVM does not know this processor's features
        features = llvm.get_host_cpu_features()
        if features.get("avx512vbmi2", False):
            config.CPU_FEATURES = features.flatten() + ",-prefer-256-bit"


_take_wide_vectors()
_KEEP = 90.0 * 86400.0  # compiled code that was not used for this long is dropped [s]
_known_helpers: WeakSet[FunctionType] = WeakSet()

# How all machine code is made. Products and sums fuse: twice as fast in polynomials, the same on every machine that
# can. No reference counting: kernels do not allocate, and counting a view in and out takes an atomic operation each.
OPTIONS: dict[str, Any] = {"error_model": "numpy", "fastmath": {"contract"}} | ({} if is_plain() else {"_nrt": False})


def _way() -> ModuleType:
    """Return the method of keeping code.

    It goes through Numba's internals, or is the plain way.
    """
    if is_plain():
        return plain
    from lambda_core.laws.jit import disk_cache

    return disk_cache


def role_signature(role: Role) -> Any:
    """Return the Numba signature of a role's laws.

    It looks like ``int64(float64, ..., float64[::1], ...)``.

    Numbers in which contacts differ are arrays (:mod:`lambda_core.laws.jit.binding`).
    """
    words = (stretches.ROW if argument.each or argument.kind == "a" else types.float64 for argument in role.arguments)
    return types.int64(*words)


def alone_arguments(role: Role) -> tuple[Any, ...]:
    """Return the argument types for one contact.

    They are those of the kernel of a role.
    """
    return tuple(stretches.ROW if argument.kind == "a" else types.float64 for argument in role.arguments)


def return_type(function: FunctionType, arguments: Any) -> Any:
    """Return the inferred type of a function's result.

    Numba compiles the function for this only.
    """
    dispatcher = njit(**OPTIONS)(function)
    dispatcher.compile(arguments)
    return returned_type(dispatcher)


def make_callable(helpers: tuple[FunctionType, ...], **options: Any) -> None:
    """Let compiled kernels call plain Python functions.

    The functions themselves stay as they are.

    Options of ``numba.njit`` hold for functions that no kernel of this process called before.
    """
    for helper in helpers:
        if helper not in _known_helpers:
            register_jitable(**{**OPTIONS, **inlined.OPTIONS, **options})(helper)
            _known_helpers.add(helper)


def returned_type(dispatcher: Any) -> Any:
    """Return the only signature's inferred result type.

    Numba inferred it.
    """
    (compiled,) = dispatcher.overloads.values()
    return types.unliteral(compiled.signature.return_type)


def environment_key() -> str:
    """Return the hash of the compiler's environment.

    Compiled code depends on it besides its sources (hex, 16 characters).

    Versions of Python, numpy, Numba and llvmlite, the processor and its features, the
    optimisation level, how code is made here, and the bounds-check flag, to which Numba's own cache is blind.
    """
    words: list[object] = [platform.python_implementation(), platform.python_version()]
    words += [importlib.metadata.version(name) for name in ("numpy", "numba", "llvmlite")]
    words += _way().processor()
    words += [str(config.OPT), config.BOUNDSCHECK, config.DEBUGINFO_DEFAULT]
    words += [OPTIONS["error_model"], sorted(OPTIONS["fastmath"]), is_plain()]
    words += [
        Path(__file__).with_name(f"{name}.py").read_bytes()
        for name in ("inside_callers", "references", "stretches", "words")
    ]
    return hashlib.sha256(repr(words).encode()).hexdigest()[:16]


def compile_into(
    function: Callable[..., Any], signature: Any, folder: Path, on_miss: Callable[[], None], **options: Any
) -> Any:
    """Compile `function`, or load it from `folder`.

    The `signature` is explicit, and there is only one.

    `signature` may be a tuple of argument types: the return type is then inferred.
    Returns the Numba dispatcher, closed for other signatures.
    """
    if config.DISABLE_JIT:
        raise UsageError("NUMBA_DISABLE_JIT is set: the solver calls compiled code only; unset it")
    _touch(folder)
    dispatcher = njit(**{**OPTIONS, **options})(function)
    _way().attach(dispatcher, function, folder, on_miss)
    with warnings.catch_warnings():
        # Function types as arguments are marked experimental; the tests of this project watch over them.
        warnings.simplefilter("ignore", NumbaExperimentalFeatureWarning)
        dispatcher.compile(signature)
    dispatcher.disable_compile()
    return dispatcher


def _touch(folder: Path) -> None:
    """Mark a folder as used now.

    A new one drops those that nobody has used for long.
    """
    if folder.exists():
        with contextlib.suppress(OSError):
            os.utime(folder)
        return
    oldest = time.time() - _KEEP
    with contextlib.suppress(OSError):
        for other in folder.parent.iterdir():
            if other.stat().st_mtime < oldest:
                shutil.rmtree(other, ignore_errors=True)


class Pointer(types.WrapperAddressProtocol):
    """Address of a compiled kernel.

    Compiled code takes it as a first-class function.

    It keeps the code alive and is never pickled: another process compiles (or loads) its own.
    """

    def __init__(self, dispatcher: Any, signature: Any) -> None:
        self._signature = signature
        self._address: int
        self._address, self._kept = _way().callback(dispatcher, signature)

    def __wrapper_address__(self) -> int:
        return self._address

    def signature(self) -> Any:
        return self._signature

    @property
    def compiled(self) -> Any:
        """Code that Numba keeps behind the pointer.

        The plain way has none.
        """
        return self._kept.get_compile_result(self._signature)

    def __reduce__(self) -> Any:
        raise TypeError("a pointer to compiled code lives in one process: compile the kernel again in the other")
