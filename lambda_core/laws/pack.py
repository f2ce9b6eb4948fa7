"""Load machine code that the installation contains.

A wheel may hold such a pack (:mod:`lambda_core.export.fmu.pack_builder` builds it): one library for each system, whose
functions are called through ctypes, without Numba. It is used where it was made from the sources that are installed,
where nobody damaged it, and where the processor has what it was made for. Everywhere else, and for the laws of others,
code is compiled here (:mod:`lambda_core.laws.kernels`). Both are called and pointed at in the same way.
"""

from __future__ import annotations

import contextlib
import ctypes
import hashlib
import json
import os
import platform
import sys
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cache
from importlib.util import find_spec
from pathlib import Path
from typing import Any

import numpy as np

from lambda_core.domain.errors import UsageError
from lambda_core.domain.installed import OWN, project_of
from lambda_core.domain.roles import ROLES
from lambda_core.laws.jit.plain import is_forced
from lambda_core.laws.jit.words import FUNCTION, Array, words
from lambda_core.laws.law import Law

VARIABLE = "LAMBDA_BEARING_CODE"
NATIVE, PACK = "native", "pack"
FOLDER = Path(__file__).parents[1] / "pack"
MANIFEST = "manifest.json"
HOMES = ("lambda_core", "lambda_plugins")  # packages whose sources the code was made from
_SYSTEMS = {
    ("linux", "x86_64"): "linux", ("win32", "amd64"): "windows", ("linux", "aarch64"): "linux-arm",
    ("darwin", "arm64"): "mac-arm", ("darwin", "x86_64"): "mac-intel",
}  # fmt: skip
_WORDS = Array(np.dtype(np.float64))


class _UnusableError(Exception):
    """Pack that cannot be used.

    `is_fault` tells whether the user should know.
    """

    def __init__(self, why: str, *, is_fault: bool = False) -> None:
        super().__init__(why)
        self.is_fault = is_fault


class Function:
    """Compiled function in a library.

    It takes Python's values, and is a pointer for other compiled code.

    Parameters
    ----------
    address : int
    kinds : sequence
        Of its arguments, as :func:`kind_from` returns them.
    """

    def __init__(self, address: int, kinds: Sequence[Any]) -> None:
        self._address, self._kinds = address, kinds
        types = [each for kind in kinds for each in _types(kind)]
        self._call = ctypes.CFUNCTYPE(ctypes.c_int64, *types)(address)

    def __call__(self, *values: Any) -> int:
        arguments = [word for kind, value in zip(self._kinds, values, strict=True) for word in _words(kind, value)]
        return int(self._call(*arguments))

    def __wrapper_address__(self) -> int:
        return self._address


def kind_from(written: Any) -> Any:
    """Return the kind of an argument.

    Its form in a manifest gives the kind.

    "float", "int", "function"; the attribute that has the address of a tuple; [itemsize or name of a type, dimensions]
    of an array; {"tuple": kinds}.
    """
    if isinstance(written, Mapping):
        return tuple(kind_from(each) for each in written["tuple"])
    if not isinstance(written, list):
        return written
    item, dimensions = written
    if isinstance(item, int):
        return Array(np.dtype({"names": ["record"], "formats": [f"V{item}"], "itemsize": item}), dimensions)
    return Array(np.dtype(item), dimensions)


def _types(kind: Any) -> Iterator[Any]:
    """Yield the word types of an argument.

    Arrays and tuples go field by field.
    """
    if isinstance(kind, tuple):
        for each in kind:
            yield from _types(each)
    elif kind == "float":
        yield ctypes.c_double
    else:
        count = kind.words if isinstance(kind, Array) else FUNCTION.words if kind == "function" else 1
        yield from [ctypes.c_int64] * count


def _words(kind: Any, value: Any) -> Iterator[Any]:
    if isinstance(kind, Array):
        yield from words(kind, value)
    elif isinstance(kind, tuple):
        for each, part in zip(kind, value, strict=True):
            yield from _words(each, part)
    elif kind == "function":
        yield from words(FUNCTION, value)
    else:
        yield float(value) if kind == "float" else int(value) if kind == "int" else getattr(value, kind)


@dataclass(frozen=True)
class Pack:
    """A library of this system, loaded.

    Attributes
    ----------
    code : str
        What results say of the code that computed them: equal words, equal bits on one kind of system.
    key : str
        Hash of the library.
    """

    code: str
    key: str
    _functions: Mapping[str, Mapping[str, Any]] = field(repr=False)
    _library: ctypes.CDLL = field(repr=False)
    _found: dict[str, Function] = field(default_factory=dict, repr=False)

    def has(self, name: str) -> bool:
        """Tell whether a unit is in the library."""
        return name in self._functions

    def unit(self, name: str) -> Function:
        """Return a unit of the solver, or of the network."""
        return self._function(name, [kind_from(each) for each in self._functions[name]["kinds"]])

    def law(self, model: Law) -> Function | None:
        """Return a built-in law's kernel.

        None for a law that is not in the library.
        """
        name, kernel = law_name(model), model.kernel
        if project_of(model.distribution) != OWN or name not in self._functions:
            return None
        if self._functions[name]["kernel"] != f"{kernel.__module__}:{kernel.__qualname__}":
            return None
        kinds = [_WORDS if a.each or a.kind == "a" else "float" for a in ROLES[model.role].arguments]
        return self._function(name, kinds)

    def _function(self, name: str, kinds: Sequence[Any]) -> Function:
        if name not in self._found:
            address = self._library.lb_function(self._functions[name]["place"])
            self._found[name] = Function(int(address), kinds)
        return self._found[name]


def law_name(model: Law) -> str:
    """Return a kernel's name in a pack.

    It is the kernel of a law.
    """
    return f"{model.role}/{model.name}"


_native: list[bool] = []  # as many as callers that want code to be compiled here


@contextlib.contextmanager
def compiled_here() -> Iterator[None]:
    """Leave the pack out.

    It is for callers that need more of the code than its calls.
    """
    _native.append(True)
    try:
        yield
    finally:
        _native.pop()


def pack() -> Pack | None:
    """Return the pack of this installation.

    None where code is compiled here.

    Raises
    ------
    UsageError
        When ``LAMBDA_BEARING_CODE`` asks for a pack that cannot be used, or for something else.
    """
    wanted = os.environ.get(VARIABLE, "")
    if wanted not in ("", NATIVE, PACK):
        raise UsageError(f'{VARIABLE} is "{wanted}": set it to {PACK} or {NATIVE}, or leave it out')
    if wanted == NATIVE or _native or is_forced():
        return None
    found = _opened()
    if isinstance(found, Pack):
        return found
    if wanted == PACK:
        raise UsageError(f"{VARIABLE}={PACK}, but {found}: install a wheel with a pack, or set {VARIABLE}={NATIVE}")
    return None


def code() -> str:
    """Return what results say of the code that computes them."""
    found = pack()
    return found.code if found else NATIVE


def other_code(before: str) -> str:
    """Explain why other code cannot go on.

    The text says that another code began than that of this process, and has a remedy. It is "" where this code can go
    on.

    Parameters
    ----------
    before : str
        As :func:`code` returned it.
    """
    now = code()
    if now == before:
        return ""
    way = f"set {VARIABLE}={before.split()[0]}"
    if before.split()[0] == now.split()[0]:
        way = "take the installation that began it"
    return f"it was computed by other machine code ({before}; this is {now}), whose last digits differ: {way}"


@cache
def _opened() -> Pack | str:
    """Return the pack or its fault.

    Each fault is reported once.
    """
    try:
        return _open(FOLDER)
    except _UnusableError as error:
        if error.is_fault:
            print(
                f"the machine code that came with the program is not used: {error}; it is compiled here",
                file=sys.stderr,
            )
        return str(error)


def _open(folder: Path) -> Pack:
    """Load the library of this system.

    Raises
    ------
    _UnusableError
        When it cannot be used.
    """
    held = _manifest(folder / MANIFEST)
    if held["sources"] != sources():
        raise _UnusableError("it was made from other sources than those installed")
    system = _SYSTEMS.get((sys.platform, platform.machine().lower()), "")
    if system not in held["libraries"]:
        raise _UnusableError("it has none for this system")
    found = held["libraries"][system]
    file = folder / found["file"]
    try:
        content = file.read_bytes()
    except OSError as error:
        raise _UnusableError(f"{file.name} cannot be read ({error.strerror})", is_fault=True) from None
    key = hashlib.sha256(content).hexdigest()
    if key != found["sha256"]:
        raise _UnusableError(f"{file} is damaged, install the program again", is_fault=True)
    try:
        library = ctypes.CDLL(str(file))
    except OSError as error:
        raise _UnusableError(f"{file.name} cannot be loaded ({error})", is_fault=True) from None
    if library.lb_runs_here() != 1:
        raise _UnusableError(f"this processor is less than {found['level']}")
    library.lb_function.restype, library.lb_function.argtypes = ctypes.c_void_p, [ctypes.c_int64]
    return Pack(f"{PACK} {system} {found['level']} {held['made_by']}", key, held["functions"], library)


def _manifest(file: Path) -> Any:
    try:
        text = file.read_text(encoding="utf-8")
    except OSError:
        raise _UnusableError("this installation has none") from None
    try:
        read = json.loads(text)
        held = read["content"]
        if seal(held) == read["seal"]:
            return held
    except (ValueError, KeyError, TypeError):
        pass
    raise _UnusableError(f"{file} is damaged, install the program again", is_fault=True)


def seal(content: Any) -> str:
    """Return the hash of an undamaged manifest."""
    return hashlib.sha256(json.dumps(content, sort_keys=True).encode()).hexdigest()


@cache
def sources() -> str:
    """Return the hash of a pack's sources.

    They are those of the packages that the pack is made from.
    """
    from lambda_core.laws.kernels import sources_key

    found = [find_spec(home) for home in HOMES]
    return sources_key(
        *(Path(spec.submodule_search_locations[0]) for spec in found if spec and spec.submodule_search_locations)
    )
