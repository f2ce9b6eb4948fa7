"""Compile kernels and return pointers to them.

Compiled code is kept on disk in folders named by everything it depends on, so an edited
law, an edited helper two files down and an edited constant are all seen by the next
process, and nothing else is compiled again.
"""

from __future__ import annotations

import hashlib
import inspect
import os
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from functools import cache
from pathlib import Path
from types import FunctionType
from typing import Any

from lambda_core.domain.errors import unknown_name
from lambda_core.domain.installed import OWN, project_of
from lambda_core.domain.plugin_errors import PluginError
from lambda_core.domain.processes import locked
from lambda_core.domain.roles import ROLES
from lambda_core.laws import executable
from lambda_core.laws.compiler_words import gist
from lambda_core.laws.jit import binding
from lambda_core.laws.jit.reach import Reach, UnreachableError, kept_reach, reach
from lambda_core.laws.law import Law
from lambda_core.laws.par import par_layout

Announce = Callable[[str], None]


def cache_folder() -> Path:
    """Return the folder of all compiled code.

    It is ``LAMBDA_BEARING_CACHE`` or the user's cache.
    """
    if base := os.environ.get("LAMBDA_BEARING_CACHE"):
        return Path(base).expanduser() / "kernels"
    import platformdirs

    return Path(platformdirs.user_cache_dir("lambda-bearing")) / "kernels"


def _without_indices(hook: Callable[[Any], object]) -> Callable[[Any], object]:
    """Return a hook without a checked index.

    The solver names the law that raised it.
    """
    return hook if getattr(hook, "is_quiet", False) else _QuietHook(hook)


@dataclass(frozen=True)
class _QuietHook:
    before: Callable[[Any], object]
    is_quiet: bool = True

    def __call__(self, raised: Any) -> None:
        if not isinstance(raised.exc_value, IndexError):
            self.before(raised)


@dataclass(frozen=True)
class CompiledKernel:
    """A model's kernel as machine code.

    Attributes
    ----------
    pointer : Pointer
        First-class function for compiled code, of type ``FunctionType(signature(role))``; it
        keeps the code alive and refuses to be pickled.
    key : str
        Hash of everything the kernel reaches (result files store it; worker processes compare it).
    dispatcher : numba dispatcher
        The same code, callable from Python.
    cached : bool
        Whether it came from disk.
    seconds : float
        Time to compile or load [s].
    made : str
        Hash of what the machine code depends on beyond its sources.
    """

    pointer: Any = field(repr=False)
    key: str
    dispatcher: Any = field(repr=False)
    cached: bool
    seconds: float
    made: str = ""


def signature(role: str) -> Any:
    """Return the Numba signature of `role`.

    Its kernels have the form ``int64(float64 or float64[::1], ...)``.
    """
    if role not in ROLES:
        raise PluginError(unknown_name("role", role, ROLES))
    from lambda_core.laws.jit.machine_code import role_signature

    return role_signature(ROLES[role])


def kernel_reach(model: Law) -> Reach:
    """Return everything that a model's kernel reaches.

    Raises
    ------
    PluginError
        When the kernel is no plain Python function or reaches something that cannot be followed.
    """
    kernel = plain_function(model)
    _check_arguments(model, kernel)
    try:
        return kept_reach(kernel)
    except UnreachableError as error:
        raise UnreachableError(f"{model.label}: {error}") from None


def plain_function(model: Law) -> FunctionType:
    """Return a law's kernel.

    PluginError when it is no plain Python function.
    """
    if not isinstance(model.kernel, FunctionType):
        raise PluginError(
            f"{model.label}: the kernel is a {type(model.kernel).__name__}: write a plain Python function "
            "without a decorator, the program compiles it"
        )
    return model.kernel


def compile_kernel(model: Law, announce: Announce | None = None) -> CompiledKernel:
    """Compile a model's kernel or load it.

    A built-in law may be in the pack of the installation.

    Parameters
    ----------
    model : Law
        With a plain Python kernel; the functions that it calls are plain too.
    announce : callable, optional
        Called with one sentence before a compilation; not called when the disk has it.

    Raises
    ------
    PluginError
        When the kernel cannot be compiled, returns anything but int64, or reaches something
        whose content cannot be followed; the sentence names the model and its distribution.
    """
    start, kernel, reached = time.perf_counter(), plain_function(model), kernel_reach(model)
    role, layout = ROLES[model.role], par_layout(model)
    is_foreign = project_of(model.distribution) != OWN
    words = f"{model.role} {reached.key} {binding.source(role, layout, binding.taken_by(kernel), fenced=is_foreign)}"
    key = hashlib.sha256(words.encode()).hexdigest()
    if (packed := _packed(model, key, start)) is not None:
        return packed
    folder = cache_folder() / f"{model.role}-{key[:24]}-{environment()}{'-checked' if is_foreign else ''}"
    if folder in _in_memory:
        return _in_memory[folder]
    from lambda_core.laws.jit import inlined, machine_code

    missed: list[str] = []

    def on_miss() -> None:
        missed.append(model.name)
        if announce is not None:
            announce(f"compiling {model.label} (once)")

    options = {"boundscheck": True} if is_foreign else {}
    if is_foreign:
        sys.unraisablehook = _without_indices(sys.unraisablehook)
    machine_code.make_callable((*reached.helpers, kernel), **options)
    wanted, flat = signature(model.role), binding.bound(kernel, role, layout, fenced=is_foreign)
    try:
        dispatcher = machine_code.compile_into(flat, wanted.args, folder, on_miss, **inlined.LAW, **options)
    except Exception as error:  # Numba answers odd source code with exceptions of many kinds
        if role.batched or is_foreign:
            _check_alone(model, kernel, wanted)
        raise PluginError(f"{model.label} cannot be compiled: {gist(error)}") from None
    _check_return(model, machine_code.returned_type(dispatcher), wanted.return_type)
    pointer = machine_code.Pointer(dispatcher, wanted)
    compiled = CompiledKernel(pointer, key, dispatcher, not missed, time.perf_counter() - start, environment())
    _in_memory[folder] = compiled
    return compiled


def _packed(model: Law, key: str, start: float) -> CompiledKernel | None:
    """Return a law from the installation's pack.

    None where it is to be compiled.
    """
    from lambda_core.laws.pack import pack

    found = pack()
    kernel = found.law(model) if found else None
    if found is None or kernel is None:
        return None
    return CompiledKernel(kernel, key, kernel, cached=True, seconds=time.perf_counter() - start, made=found.key[:16])


def argument_names(role: str) -> tuple[str, ...]:
    """Return the names of a role's arguments in order."""
    return tuple(argument.name for argument in ROLES[role].arguments)


@cache
def _signature(kernel: FunctionType) -> inspect.Signature:
    return inspect.signature(kernel)


def _check_arguments(model: Law, kernel: FunctionType) -> None:
    """Compare names and order with the role.

    Without this two swapped arrays would compile without an error.
    """
    if model.role not in ROLES:
        raise PluginError(unknown_name("role", model.role, ROLES))
    taken, every = _signature(kernel), ROLES[model.role].arguments
    wanted = tuple(each.name for each in every if not each.optional or each.name in taken.parameters)
    plain = all(each.kind is inspect.Parameter.POSITIONAL_OR_KEYWORD for each in taken.parameters.values())
    if tuple(taken.parameters) != wanted or not plain:
        bare = taken.replace(
            parameters=[each.replace(annotation=inspect.Parameter.empty) for each in taken.parameters.values()],
            return_annotation=inspect.Signature.empty,
        )
        some = "" if len(wanted) == len(every) else f", and need only ({', '.join(wanted)})"
        known = ", ".join(argument_names(model.role))
        raise PluginError(f"{model.label} takes {bare}; {model.role} kernels take ({known}){some}")


_in_memory: dict[Path, CompiledKernel] = {}


def _check_alone(model: Law, kernel: FunctionType, wanted: Any) -> None:
    """Refuse a kernel without status.

    The loop over contacts could not be compiled for it.
    """
    from lambda_core.laws.jit import machine_code

    role = ROLES[model.role]
    alone = binding.bound(kernel, role, par_layout(model), alone=True)
    try:
        found = machine_code.return_type(alone, machine_code.alone_arguments(role))
    except Exception:  # something else is wrong with it: the caller reports that
        return
    _check_return(model, found, wanted.return_type)


def _check_return(model: Law, found: Any, wanted: Any) -> None:
    if found != wanted:
        some = "nothing, or a number on some paths only," if str(found).startswith(("none", "Optional")) else str(found)
        raise PluginError(
            f"{model.label} returns {some} in place of an int64 status: "
            "return 1 for a valid result, 2 and up for errors of your own"
        )


@dataclass(frozen=True)
class CompiledHost:
    """An entry point of the core's own compiled code.

    Attributes
    ----------
    dispatcher : numba dispatcher
        Callable from Python with exactly the compiled signature.
    key : str
        Hash of the sources it was compiled from (result files store it).
    cached : bool
        Whether it came from disk.
    seconds : float
        Time to compile or load [s].
    """

    dispatcher: Any = field(repr=False)
    key: str
    cached: bool
    seconds: float


def sources_key(*places: Path) -> str:
    """Return the hash of all sources.

    Hex, of every ``*.py`` among and below `places`, names included.
    """
    digest = hashlib.sha256()
    for name, data in executable.sources(*places):
        digest.update(f"{name} {len(data)}\n".encode() + data)
    return digest.hexdigest()


@cache
def _host_content(function: Callable[..., Any], sources: tuple[Path, ...]) -> tuple[str, str]:
    """Return the hashes of the entry point's content.

    They cover what is executed of the sources and what it reaches, and are computed once per process.
    """
    return executable.executable_key(cache_folder(), *sources), reach(function, lenient=True).key


def host_key(function: Callable[..., Any], sources: tuple[Path, ...], **options: Any) -> str:
    """Return the hash of an entry point.

    It covers all that :func:`compile_host` would compile.
    """
    words = (*_host_content(function, sources), repr(sorted(options.items())))
    return hashlib.sha256("\n".join(words).encode()).hexdigest()


def host_folder(key: str) -> Path:
    """Return the code folder of a key.

    The entry point has this key; the folder exists once it was compiled.
    """
    return cache_folder() / f"host-{key[:24]}-{environment()}"


@contextmanager
def _one_at_a_time(folder: Path) -> Iterator[None]:
    """Let one process compile at a time.

    It compiles into an empty folder; others wait and then load the result.

    Without a lock (a cache that cannot be written) each compiles for itself, which is only slower.
    """
    if any(folder.rglob("*.nbc")):
        yield
        return
    with locked(folder.parent / f"{folder.name}.lock"):
        yield


def compile_host(
    function: Callable[..., Any],
    signature: Any,
    sources: tuple[Path, ...],
    announce: Announce | None = None,
    **options: Any,
) -> CompiledHost:
    """Compile one entry point or load it.

    It belongs to the core and has one signature.

    The cache folder is named by the hash of all code in `sources` (without docstrings and comments), of everything
    that `function` reaches (constants imported from elsewhere included) and of the
    environment (Python, Numba, processor, bounds checks). Functions that `function`
    calls carry a plain ``numba.njit(error_model="numpy")`` and no ``cache=True``: a
    reachable cached one is refused.

    Parameters
    ----------
    function : function
        Undecorated Python function at the top level of a module.
    signature : numba signature
        Return type and arguments, for example ``types.int64(types.float64[::1])``;
        NamedTuple classes in it must live in an importable module.
    sources : tuple of pathlib.Path
        Files and folders of the compiled code, for example ``(Path(__file__).parent,)``.
    announce : callable, optional
        Called with one sentence before a compilation; not called when the disk has it.
    **options
        Further options of ``numba.njit`` (``fastmath``, ``boundscheck``).

    Raises
    ------
    lambda_core.laws.jit.reach.UnreachableError
        For a helper that is cached by itself.

    Examples
    --------
    >>> host = compile_host(step, signature, (Path(__file__).parent,), announce=print)  # doctest: +SKIP
    >>> host.dispatcher(state, rates)  # doctest: +SKIP
    """
    key = host_key(function, sources, **options)
    missed: list[str] = []

    def on_miss() -> None:
        missed.append(function.__qualname__)
        if announce is not None:
            announce(f"compiling {function.__qualname__} (once)")

    from lambda_core.laws.jit import machine_code

    start = time.perf_counter()
    with _one_at_a_time(host_folder(key)):
        dispatcher = machine_code.compile_into(function, signature, host_folder(key), on_miss, **options)
    return CompiledHost(dispatcher, key, not missed, time.perf_counter() - start)


@cache
def environment() -> str:
    """Return the hash of the environment.

    Compiled code depends on it beyond its sources; computed once per process.
    """
    from lambda_core.laws.jit.machine_code import environment_key

    return environment_key()
