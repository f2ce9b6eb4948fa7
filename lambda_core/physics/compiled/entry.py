"""Entry points of the compiled core: compiled once each, kept on disk, handed out as pointers."""

from __future__ import annotations

import atexit
import gc
import subprocess
import sys
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from lambda_core.physics.compiled import (
    bdf,
    forces,
    handle,
    jacobian,
    layout,
    memory,
    observe,
    raceway,
    statics,
    tangent,
)
from lambda_core.registry.kernels import compile_host, host_folder, host_key
from lambda_core.registry.machine_code import Pointer

_FOLDER = Path(__file__).parent


@dataclass(frozen=True)
class Core:
    """Compiled functions of the core; pointers are for other compiled code."""

    wrench_pointer: Any
    tangent_pointer: Any
    evaluate_pointer: Any
    jacobian_pointer: Any
    evaluate: Any
    jacobian: Any
    advance: Any
    observe: Any
    settle: Any
    advance_pointer: Any
    observe_pointer: Any
    grasp: Any
    proceed: Any
    look: Any


# Each unit calls the others through pointers, so that none is compiled into another.
UNITS: dict[str, tuple[Any, Any]] = {
    "wrench": (raceway.raceway_wrench, layout.wrench_sig),
    "tangent": (tangent.contact_tangent, layout.tangent_sig),
    "evaluate": (forces.evaluate, memory.evaluate_sig),
    "jacobian": (jacobian.jacobian, memory.jacobian_sig),
    "advance": (bdf.advance, bdf.advance_sig),
    "observe": (observe.observe, observe.observe_sig),
    "settle": (statics.settle, statics.settle_sig),
    "grasp": (handle.grasp, handle.grasp_sig),
    "proceed": (handle.proceed, handle.proceed_sig),
    "look": (handle.look, handle.look_sig),
}
# What one process compiles: units that call the same functions share the work, and all take about as long.
GROUPS = (
    ("jacobian",),
    ("evaluate", "observe"),
    ("settle", "grasp", "proceed", "look"),
    ("advance", "wrench", "tangent"),
)
# The equilibrium allocates its workspaces, a handle is allocated itself; all others run without reference counting.
_OPTIONS: dict[str, dict[str, Any]] = {name: {"_nrt": True} for name in ("settle", "grasp", "proceed", "look")}


def missing() -> list[str]:
    """Return the units that are not on disk yet."""
    folders = {
        name: host_folder(host_key(function, _FOLDER, **_OPTIONS.get(name, {})))
        for name, (function, _) in UNITS.items()
    }
    return [name for name, folder in folders.items() if not any(folder.rglob("*.nbc"))]


def build(name: str, announce: Callable[[str], None] | None = None) -> Any:
    """Compile one unit into the cache, or load it; returns its dispatcher."""
    function, signature = UNITS[name]
    return compile_host(function, signature, _FOLDER, announce, **_OPTIONS.get(name, {})).dispatcher


def build_group(names: str) -> None:
    """Compile units, separated by commas, into the cache; the whole work of a process."""
    gc.disable()  # most of what a compiler makes lives until it ends: looking for the rest takes a sixth of the time
    for name in names.split(","):
        build(name)


def begin(announce: Callable[[str], None] | None = None) -> None:
    """Begin to compile what is not on disk, in processes of their own; :func:`core` waits for them.

    A unit whose process fails is compiled by :func:`core`, where its error is seen.
    """
    absent = [] if _loaded or _workers else missing()
    if len(absent) < 2:
        return
    if announce is not None:
        announce(f"compiling {len(absent)} parts of the solver (once, about a quarter of a minute)")
    code = "import sys; from lambda_core.physics.compiled.entry import build_group; build_group(sys.argv[1])"
    for group in GROUPS:
        names = ",".join(name for name in group if name in absent)
        if names:
            command = [sys.executable, "-W", "ignore", "-c", code, names]
            quiet = subprocess.DEVNULL
            _workers.append(subprocess.Popen(command, stdin=quiet, stdout=quiet, stderr=quiet))
    atexit.register(_stop)


def _stop() -> None:
    """End what still compiles: whoever needed it has gone."""
    for worker in _workers:
        worker.terminate()
        worker.wait()


def _call(dispatcher: Any, signature: Any) -> Any:
    """Return the machine code of one signature as a Python callable.

    A dispatcher would work out the types of its arguments at every call, a millisecond for the bundle; here they are
    always the same, made by lambda_core.physics.assembly.
    """
    return dispatcher.get_compile_result(signature).entry_point


def _load(announce: Callable[[str], None] | None) -> Core:
    begin(announce)
    for worker in _workers:
        worker.wait()
    _workers.clear()
    built = {name: build(name, announce) for name in UNITS}
    pointers = {
        f"{name}_pointer": Pointer(built[name], UNITS[name][1])
        for name in ("wrench", "tangent", "evaluate", "jacobian", "advance", "observe")
    }
    names = ("evaluate", "jacobian", "advance", "observe", "settle", "grasp", "proceed", "look")
    return Core(**pointers, **{name: _call(built[name], UNITS[name][1]) for name in names})


_workers: list[subprocess.Popen[bytes]] = []
_loaded: list[Core] = []


def core(announce: Callable[[str], None] | None = None) -> Core:
    """Return the compiled core, from disk when it was compiled before.

    `announce` is called with a sentence before anything is compiled.
    """
    if not _loaded:
        _loaded.append(_load(announce))
    return _loaded[0]
