"""Compiled kernels: from a model's plain Python function to a pointer that compiled code calls.

Compiled code is kept on disk in folders named by everything it depends on, so an edited
law, an edited helper two files down and an edited constant are all seen by the next
process, and nothing else is compiled again.
"""

from __future__ import annotations

import hashlib
import os
import time
from collections.abc import Callable
from dataclasses import dataclass, field
from functools import cache
from pathlib import Path
from typing import Any

from lambda_core.registry.reach import reach

Announce = Callable[[str], None]


def cache_folder() -> Path:
    """Return the folder of all compiled code: ``LAMBDA_BEARING_CACHE`` or the user's cache."""
    base = os.environ.get("LAMBDA_BEARING_CACHE")
    if base:
        return Path(base).expanduser() / "kernels"
    import platformdirs

    return Path(platformdirs.user_cache_dir("lambda-bearing")) / "kernels"


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


def sources_key(folder: Path) -> str:
    """Return a hash (hex) of every ``*.py`` below `folder`, names included."""
    digest = hashlib.sha256()
    for path in sorted(folder.rglob("*.py")):
        data = path.read_bytes()
        digest.update(f"{path.relative_to(folder).as_posix()} {len(data)}\n".encode() + data)
    return digest.hexdigest()


def compile_host(
    function: Callable[..., Any],
    signature: Any,
    sources: Path,
    announce: Announce | None = None,
    **options: Any,
) -> CompiledHost:
    """Compile one entry point of the core for one signature, or load it from disk.

    The cache folder is named by the hash of all sources below `sources`, of everything
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
    sources : pathlib.Path
        Folder of the compiled subpackage, ``Path(__file__).parent``.
    announce : callable, optional
        Called with one sentence before a compilation; not called when the disk has it.
    **options
        Further options of ``numba.njit`` (``fastmath``, ``boundscheck``).

    Raises
    ------
    lambda_core.registry.reach.UnreachableError
        For a helper that is cached by itself.

    Examples
    --------
    >>> host = compile_host(step, signature, Path(__file__).parent, announce=print)  # doctest: +SKIP
    >>> host.dispatcher(state, rates)  # doctest: +SKIP
    """
    reached = reach(function, lenient=True)
    words = (sources_key(sources), reached.key, repr(sorted(options.items())))
    key = hashlib.sha256("\n".join(words).encode()).hexdigest()
    missed: list[str] = []

    def on_miss() -> None:
        missed.append(function.__qualname__)
        if announce is not None:
            announce(f"compiling {function.__qualname__} (once)")

    from lambda_core.registry import machine_code

    start = time.perf_counter()
    folder = cache_folder() / f"host-{key[:24]}-{_environment()}"
    dispatcher = machine_code.compile_into(function, signature, folder, on_miss, **options)
    return CompiledHost(dispatcher, key, not missed, time.perf_counter() - start)


@cache
def _environment() -> str:
    from lambda_core.registry.machine_code import environment_key

    return environment_key()
