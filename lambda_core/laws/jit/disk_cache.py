"""Keep compiled code on disk through Numba's cache.

The program names the folder; a hit does not load the compiler.
"""

# Numba's caching classes carry only part of their types.
# mypy: disable-error-code="no-untyped-call,attr-defined,assignment"
from __future__ import annotations

import atexit
import contextlib
import functools
import hashlib
import io
import os
import pickle
import shutil
import tempfile
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import llvmlite.binding as llvm  # type: ignore[import-untyped]
from numba.core.caching import CompileResultCacheImpl, FunctionCache, IndexDataCacheFile, _CacheLocator
from numba.core.codegen import JitEngine
from numba.core.registry import cpu_target
from numba.core.runtime.nrt import rtsys

KNOWN = all(
    hasattr(kind, name)
    for kind, names in (
        (FunctionCache, ("_load_overload", "_guard_against_spurious_io_errors")),
        (IndexDataCacheFile, ("_load_index", "_load_data", "_open_for_write", "_data_path")),
        (CompileResultCacheImpl, ("rebuild",)),
        (JitEngine, ("is_symbol_defined", "_load_defined_symbols")),
    )
    for name in names
)
_LARGE = 200_000  # bytes of LLVM's code that are worth while to leave unread: parts of the solver, no laws


class _FolderLocator(_CacheLocator):
    """Locator of one given folder for a function.

    The folder's name already identifies its content.
    """

    folder: Path

    def __init__(self, function: Callable[..., Any]) -> None:
        self._py_file = function.__code__.co_filename
        self._place = function.__module__  # not its line: a longer docstring above it moves that

    def get_cache_path(self) -> str:
        return str(self.folder)

    def get_source_stamp(self) -> str:
        return ""

    def get_disambiguator(self) -> str:
        return self._place

    @classmethod
    def from_function(cls, py_func: Callable[..., Any], py_file: str) -> _FolderLocator | None:
        self = cls(py_func)
        try:
            self.ensure_cache_path()
        except OSError:
            # A read-only home: work from a folder of this process instead of not at all.
            type(self).folder = _own_folder()
        return self


@functools.cache
def _own_folder() -> Path:
    """Return the temporary folder of this process.

    It is removed when the process ends.
    """
    made, maker = Path(tempfile.mkdtemp(prefix="lambda-bearing-")), os.getpid()

    def remove() -> None:
        if os.getpid() == maker:  # not a fork of it
            shutil.rmtree(made, ignore_errors=True)

    atexit.register(remove)
    return made


class _SealedFiles(IndexDataCacheFile):
    """Cache files that end in a hash.

    It is the hash of their content: machine code with a flipped bit would end the process.
    """

    def _load_index(self) -> Any:
        return {} if _unsealed(Path(self._index_path)) is None else super()._load_index()

    def _load_data(self, name: str) -> Any:
        path = Path(self._data_path(name))
        held = _unsealed(path)
        if held is None:
            raise FileNotFoundError(path)  # which counts as a miss: it is compiled, and written over
        return pickle.loads(held)

    @contextlib.contextmanager
    def _open_for_write(self, filepath: str) -> Iterator[io.BytesIO]:
        with super()._open_for_write(filepath) as stream:
            held = io.BytesIO()
            yield held
            stream.write(held.getvalue() + hashlib.sha256(held.getvalue()).digest())


def _unsealed(path: Path) -> memoryview | None:
    """Return a file's content before its hash.

    None where there is no file, or the hash is of another.
    """
    try:
        content = memoryview(path.read_bytes())
    except OSError:
        return None
    size = hashlib.sha256().digest_size
    held, seal = content[:-size], content[-size:]
    return held if hashlib.sha256(held).digest() == seal else None


class _Results(CompileResultCacheImpl):
    """Rebuilds what was compiled from its machine code alone.

    Numba also keeps LLVM's code, for functions that are to be compiled and call this one. Reading it takes half of
    the time that the solver takes to load; here it is read when somebody asks for it.
    """

    def rebuild(self, target_context: Any, payload: Any) -> Any:
        (name, kind, data), described, *rest = payload
        if kind != "object" or len(data[1]) < _LARGE:
            return super().rebuild(target_context, payload)
        machine_code, code = data
        engine = target_context.codegen()._engine
        # The ways in for Python and for C, which are asked for at once, stand among the names of the machine code, too.
        wrappers = (described.llvm_cpython_wrapper_name, described.llvm_cfunc_wrapper_name)
        found_there = {symbol for symbol in wrappers if f"\0{symbol}\0".encode() in machine_code}
        if wrappers[0] not in found_there:  # another form of machine code
            return super().rebuild(target_context, payload)
        engine._defined_symbols |= found_there
        found = super().rebuild(target_context, ((name, kind, (machine_code, _nothing())), described, *rest))
        library = found.library
        library._shared_module = None

        def read() -> Any:
            if library._shared_module is None:
                library._shared_module = llvm.parse_bitcode(code)
                engine._load_defined_symbols(library._shared_module)
            return library._shared_module

        def pointer(symbol: str) -> Any:
            if not engine.is_symbol_defined(symbol):
                read()
            return type(library).get_pointer_to_function(library, symbol)

        library._get_module_for_linking, library.get_pointer_to_function = read, pointer
        return found


@functools.cache
def _nothing() -> bytes:
    return bytes(llvm.parse_assembly("").as_bitcode())


def attach(dispatcher: Any, function: Callable[..., Any], folder: Path, on_miss: Callable[[], None]) -> None:
    """Attach a cache in `folder` to a dispatcher.

    It is for `function`, and calls `on_miss` before compiling.
    """
    locator = type("FolderLocator", (_FolderLocator,), {"folder": folder})
    implementation = type("FolderCacheImpl", (_Results,), {"_locator_classes": [locator]})

    class FolderCache(FunctionCache):
        _impl_class = implementation

        def __init__(self, py_func: Callable[..., Any]) -> None:
            super().__init__(py_func)
            self._cache_file = _SealedFiles(
                self._cache_path, self._impl.filename_base, self._impl.locator.get_source_stamp()
            )

        def load_overload(self, sig: Any, target_context: Any) -> Any:
            try:
                # The inherited method first loads all that a compiler needs, half a second even when nothing is
                # compiled; on a miss the compiler does so itself.
                rtsys.initialize(target_context)
                with self._guard_against_spurious_io_errors():
                    found = self._load_overload(sig, target_context)
            except Exception:  # a file cut short by a full disk or a killed process: compile anew
                found = None
                self.flush()
            if found is None:
                on_miss()
            return found

    dispatcher._cache = FolderCache(function)


def processor() -> tuple[Any, ...]:
    """Return what tells machines apart: processor and its features."""
    found: tuple[Any, ...] = cpu_target.target_context.codegen().magic_tuple()
    return found


def callback(dispatcher: Any, signature: Any) -> tuple[int, object]:
    """Return a compiled function's address for C.

    Also return the object that keeps it alive.
    """
    compiled = dispatcher.get_compile_result(signature)
    return int(compiled.library.get_pointer_to_function(compiled.fndesc.llvm_cfunc_wrapper_name)), dispatcher
