"""Follow what a function reaches: code, called functions, constants.

Numba stamps a cached function with its own source file only, so an edited helper or an
edited constant in another file would silently leave the old physics running. The hash
made here covers all of it and names the folder in which the compiled code is kept.
"""

from __future__ import annotations

import builtins
import dis
import hashlib
import inspect
import sys
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from functools import cache
from types import BuiltinFunctionType, CodeType, FunctionType, ModuleType
from typing import Any

import numpy as np

from lambda_core.domain.plugin_errors import PluginError
from lambda_core.laws.jit.plain import instructions, is_forced

# Modules that Numba implements itself: their content belongs to the interpreter and to
# numpy, whose versions are part of the cache's environment.
_LIBRARIES = frozenset(sys.stdlib_module_names) | {"numpy", "numba", "llvmlite"}
_IMPURE = frozenset({"random", "numpy.random", "time", "datetime", "os", "sys"})
_MISSING = object()


class UnreachableError(PluginError):
    """Kernel that uses something unknown.

    Its content cannot be followed or may change unseen.
    """


@dataclass(frozen=True)
class Reach:
    """All that a function depends on.

    Attributes
    ----------
    key : str
        Hash (hex) of bytecode, constants (no docstrings), default values and values of globals, recursively.
    helpers : tuple of function
        Plain Python functions that it calls, directly or through others, itself excluded.
    codes : tuple of code
        Every code object that was followed, its own first.
    """

    key: str
    helpers: tuple[FunctionType, ...]
    codes: tuple[CodeType, ...]


_Read = tuple[dict[str, Any], str, Any]  # look-up of a global: where, name, value
_kept: dict[FunctionType, tuple[Reach, tuple[_Read, ...]]] = {}


def reach(function: Callable[..., Any], *, lenient: bool = False) -> Reach:
    """Follow everything that `function` reaches.

    Parameters
    ----------
    function : function or Numba dispatcher
        Where to start.
    lenient : bool
        Take objects of unknown content (types, intrinsics) by their name instead of refusing.

    Raises
    ------
    UnreachableError
        For a helper with a compiled-code cache of its own, one that calls itself, and a
        global whose value cannot be hashed; the sentence names it.
    """
    return _walked(function, lenient).reach(function)


def kept_reach(function: FunctionType) -> Reach:
    """Return a function's :func:`reach`, followed once.

    It is followed anew when a name that it reads stands for another object. Every model asks for the reach of its
    twenty laws, a millisecond each.
    """
    found, read = _kept.get(function, (None, ()))
    if found is not None and all(scope.get(name, _MISSING) is value for scope, name, value in read):
        return found
    walk = _walked(function, lenient=False)
    found = walk.reach(function)
    if walk.is_fixed:
        _kept[function] = found, tuple(walk.read)
    return found


def _walked(function: Any, lenient: bool) -> _Walk:
    walk = _Walk(lenient)
    walk.value(function, "the function itself")
    return walk


def content_key(function: Callable[..., Any]) -> str:
    """Return the key of a function's content.

    It has all that the function reaches, objects of unknown content by their name.

    A function of a module with a file is followed once; one that was typed in (a notebook, a shell) each time, because
    what it calls can be typed again.
    """
    module = sys.modules.get(getattr(_plain(function), "__module__", None) or "")
    is_typed = module is None or module.__name__ == "__main__" or getattr(module, "__file__", None) is None
    return reach(function, lenient=True).key if is_typed else _kept_key(function)


@cache
def _kept_key(function: Callable[..., Any]) -> str:
    return reach(function, lenient=True).key


def _plain(function: Any) -> Any:
    """Return the Python function of a dispatcher.

    The dispatcher is Numba's; other objects stay as they are.
    """
    return getattr(function, "py_func", function)


@dataclass
class _Walk:
    lenient: bool
    added: list[bytes] = field(default_factory=list)
    functions: list[FunctionType] = field(default_factory=list)
    codes: list[CodeType] = field(default_factory=list)
    seen: dict[int, int] = field(default_factory=dict)
    within: list[FunctionType] = field(default_factory=list)  # functions being followed now
    read: list[_Read] = field(default_factory=list)
    is_fixed: bool = True  # False where something can change in place

    def reach(self, function: Any) -> Reach:
        """Return what was followed from a function."""
        root = _plain(function)
        helpers = tuple(helper for helper in self.functions if helper is not root)
        return Reach(hashlib.sha256(b"".join(self.added)).hexdigest(), helpers, tuple(self.codes))

    def add(self, *words: object) -> None:
        for word in words:
            data = word if isinstance(word, bytes) else str(word).encode()
            self.added += (len(data).to_bytes(8, "little"), data)

    def value(self, value: Any, where: str) -> None:
        """Add one value.

        It is a constant, a function, or a container of them.
        """
        if value is None or value is Ellipsis or isinstance(value, bool | int | float | complex | str | bytes):
            self.add("constant", type(value).__name__, repr(value))
        elif isinstance(value, np.ndarray | np.generic):
            array, self.is_fixed = np.asarray(value), False
            if array.dtype.hasobject:
                raise UnreachableError(f"{where} is an array of Python objects: use numbers")
            self.add("array", array.dtype.str, array.shape, np.ascontiguousarray(array).tobytes())
        elif isinstance(value, tuple):
            self.add("tuple", type(value).__qualname__, len(value))
            for index, item in enumerate(value):
                self.value(item, f"{where}[{index}]")
        elif isinstance(value, frozenset):
            self.add("set", sorted(map(repr, value)))
        elif isinstance(value, CodeType):
            self.code(value, {}, {}, where)
        elif isinstance(value, FunctionType):
            self.function(value, where)
        elif hasattr(value, "py_func") and hasattr(value, "targetoptions"):
            self.dispatcher(value, where)
        elif _of_library(value):
            self.add("library", _module(value), _name(value))
        elif self.lenient:
            self.add("other", type(value).__module__, type(value).__qualname__, _name(value))
        else:
            raise UnreachableError(
                f"{where} is a {type(value).__name__}: a kernel may use numbers, strings, tuples, "
                "numpy arrays, plain Python functions and those of math and numpy"
            )

    def function(self, function: FunctionType, where: str) -> None:
        if function in self.within and not self.lenient:
            raise UnreachableError(f"{function.__qualname__} calls itself: write a loop")
        if id(function) in self.seen:
            self.add("again", self.seen[id(function)])
            return
        self.seen[id(function)] = len(self.seen)
        self.functions.append(function)
        for index, default in enumerate(function.__defaults__ or ()):
            self.value(default, f"default {index} of {function.__qualname__} ({where})")
        for name, default in sorted((function.__kwdefaults__ or {}).items()):
            self.value(default, f"default of {name} in {function.__qualname__} ({where})")
        free: dict[str, Any] = {}
        self.is_fixed = self.is_fixed and function.__closure__ is None and function.__kwdefaults__ is None
        for name, cell in zip(function.__code__.co_freevars, function.__closure__ or (), strict=True):
            free[name] = cell.cell_contents
        self.within.append(function)
        self.code(function.__code__, function.__globals__, free, function.__qualname__)
        self.within.pop()

    def code(self, code: CodeType, scope: dict[str, Any], free: dict[str, Any], where: str) -> None:
        """Add one code object.

        It has its instructions, its constants and the globals that it reads.
        """
        self.codes.append(code)
        self.add("code", code.co_code, code.co_argcount, code.co_kwonlyargcount, code.co_flags & ~_HAS_DOCSTRING)
        self.add(code.co_varnames, code.co_names, code.co_freevars, code.co_cellvars)
        for constant in code.co_consts[_has_docstring(code) :]:
            if isinstance(constant, CodeType):
                self.code(constant, scope, free, f"{where}.{constant.co_name}")
            else:
                self.value(constant, f"a constant of {where}")
        for name, value in sorted(free.items()):
            if name in code.co_freevars:
                self.value(value, f'"{name}", used by {where},')
        for name, value in _globals_read(code, scope, where, self.read):
            self.add("global", name)
            self.value(value, f'"{name}", used by {where},')

    def dispatcher(self, dispatcher: Any, where: str) -> None:
        if getattr(getattr(dispatcher, "_cache", None), "cache_path", None) is not None:
            name = f"{dispatcher.py_func.__module__}.{dispatcher.py_func.__qualname__}"
            raise UnreachableError(
                f"{name} is compiled with cache=True, which hides edits in other files: "
                "write it as a plain Python function"
            )
        self.add("dispatcher", sorted((key, _ordered(item)) for key, item in dispatcher.targetoptions.items()))
        self.function(dispatcher.py_func, where)


def _ordered(value: Any) -> str:
    """Write an option with ordered sets.

    The order of sets otherwise differs from process to process.
    """
    return repr(sorted(value)) if isinstance(value, set | frozenset) else repr(value)


def _name(value: Any) -> str:
    name = getattr(value, "__qualname__", None) or getattr(value, "__name__", None)
    return name if isinstance(name, str) else ""


def _of_library(value: Any) -> bool:
    """Tell whether an object belongs to a library.

    The object is a function or type of Python, numpy or Numba.
    """
    if not isinstance(value, BuiltinFunctionType | np.ufunc | type) and not callable(value):
        return False
    if isinstance(value, np.ufunc) and getattr(np, value.__name__, None) is not value:
        return False  # scipy's: Numba does not know it
    return bool(_name(value)) and _module(value).split(".")[0] in _LIBRARIES


def _module(value: Any) -> str:
    """Return the module of a function or type.

    Ufuncs name none before numpy 2.2.
    """
    return getattr(value, "__module__", None) or "builtins"


def raises(code: CodeType) -> bool:
    """Tell whether a function has a raise or an assert."""
    return dis.opmap["RAISE_VARARGS"] in code.co_code[::2]


@cache
def _has_docstring(code: CodeType) -> bool:
    """Tell whether the first constant is nothing but a docstring.

    An equal text in the body is the same constant: then it is executed.
    """
    is_function = code.co_flags & inspect.CO_OPTIMIZED and not code.co_name.startswith("<")
    if not is_function or not isinstance((*code.co_consts, None)[0], str):
        return False
    if sys.version_info >= (3, 14) and not code.co_flags & _HAS_DOCSTRING:
        return False
    argument = 0
    for operation, low in zip(code.co_code[::2], code.co_code[1::2], strict=True):
        argument = argument << 8 | low
        if operation == dis.EXTENDED_ARG:
            continue
        if operation in dis.hasconst and argument == 0:
            return False
        argument = 0
    return True


_HAS_DOCSTRING = 0x4000000  # of co_flags since Python 3.14; before, a function without one has None as first constant
_READS = {dis.opmap[name]: name for name in ("LOAD_GLOBAL", "LOAD_ATTR", "LOAD_METHOD") if name in dis.opmap}
# The lowest bit of these arguments is a flag: of LOAD_GLOBAL always, of LOAD_ATTR since LOAD_METHOD went into it with
# Python 3.12. The table of operations does not tell: it goes on naming LOAD_METHOD, which compiled code never holds.
_FLAGGED = {"LOAD_GLOBAL", "LOAD_ATTR"} if sys.version_info >= (3, 12) else {"LOAD_GLOBAL"}
_SKIPPED = {dis.opmap["CACHE"]}
_UNREAD = (3, 14)  # of Python; its code was not read here yet


@cache
def _instructions(code: CodeType) -> tuple[tuple[str, str], ...]:
    """Return the instructions of a function.

    (operation, name), without a name where an instruction reads none.

    The standard library's disassembler says the same, with much else that takes a tenth of a second at every start.
    """
    if is_forced() or sys.version_info >= _UNREAD:
        return instructions(code)
    found: list[tuple[str, str]] = []
    argument = 0
    for operation, low in zip(code.co_code[::2], code.co_code[1::2], strict=True):
        argument = argument << 8 | low
        if operation == dis.EXTENDED_ARG:
            continue
        if (name := _READS.get(operation)) is not None:
            found.append((name, code.co_names[argument >> (name in _FLAGGED)]))
        elif operation not in _SKIPPED:
            found.append(("", ""))
        argument = 0
    return tuple(found)


def _globals_read(code: CodeType, scope: dict[str, Any], where: str, read: list[_Read]) -> Iterator[tuple[str, Any]]:
    """Yield every global that `code` loads.

    (dotted name, value), through modules; each look-up is added to `read`.

    A module is followed only along the attributes that are read from it.
    """
    found: dict[str, Any] = {}
    path, value = "", _MISSING
    for operation, name in _instructions(code):
        if isinstance(value, ModuleType):
            if operation not in ("LOAD_ATTR", "LOAD_METHOD"):
                raise UnreachableError(f'{where} hands the module "{path}" on: call {path}.function(...) directly')
            read.append((vars(value), name, getattr(value, name, _MISSING)))
            path, value = f"{path}.{name}", read[-1][-1]
        elif operation == "LOAD_GLOBAL":
            read.append((scope, name, scope.get(name, _MISSING)))
            path, value = name, scope.get(name, getattr(builtins, name, _MISSING))
        else:
            continue
        if value is _MISSING:
            raise UnreachableError(f'{where} uses "{path}", which does not exist')
        if value is print:
            raise UnreachableError(f"{where} prints: a kernel is a function of its arguments only")
        if isinstance(value, ModuleType):
            if value.__name__ in _IMPURE:
                raise UnreachableError(f'{where} uses "{value.__name__}": a kernel is a function of its arguments only')
        else:
            found[path], value = value, _MISSING
    yield from sorted(found.items(), key=lambda item: item[0])
