"""Entry points of the compiled core: compiled once each, kept on disk, handed out as pointers."""

from __future__ import annotations

import atexit
import gc
import subprocess
import sys
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from lambda_core.domain.parents import end_with_parent
from lambda_core.laws.jit.machine_code import Pointer
from lambda_core.laws.kernels import compile_host, host_folder, host_key
from lambda_core.solver import layout
from lambda_core.solver import sampling as observe
from lambda_core.solver.code_files import compiled_sources
from lambda_core.solver.contact import raceway, tangent
from lambda_core.solver.integrator import bdf, esdirk, handle, memory, stepping
from lambda_core.solver.motion import forces, jacobian
from lambda_core.solver.statics import continuation as statics

SOURCES = compiled_sources()


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
    advance_finely: Any
    observe: Any
    solve_static: Any
    advance_pointer: Any
    advance_finely_pointer: Any
    observe_pointer: Any
    integrate: Any
    sample: Any


# Each unit calls the others through pointers, so that none is compiled into another.
UNITS: dict[str, tuple[Any, Any]] = {
    "wrench": (raceway.raceway_wrench, layout.wrench_sig),
    "tangent": (tangent.contact_tangent, layout.tangent_sig),
    "evaluate": (forces.evaluate, memory.evaluate_sig),
    "jacobian": (jacobian.jacobian, memory.jacobian_sig),
    "advance": (bdf.advance, stepping.advance_sig),
    "advance_finely": (esdirk.advance, stepping.advance_sig),
    "observe": (observe.observe, observe.observe_sig),
    "solve_static": (statics.solve_static, statics.solve_static_sig),
    "integrate": (handle.integrate, handle.integrate_sig),
    "sample": (handle.sample, handle.sample_sig),
}
# What one process compiles: units that call the same functions share the work, and all take about as long.
GROUPS = (
    ("jacobian",),
    ("evaluate", "observe"),
    ("solve_static", "integrate", "sample"),
    ("advance", "wrench", "tangent"),
    ("advance_finely",),
)
# The equilibrium allocates its workspaces; all others run without reference counting.
# What takes long lets other threads work: one of them hears the signals meanwhile.
_OPTIONS: dict[str, dict[str, Any]] = {
    name: {"_nrt": True, "nogil": True} for name in ("solve_static", "integrate", "sample")
}


def missing() -> list[str]:
    """Return the units that are not on disk yet."""
    folders = {
        name: host_folder(host_key(function, SOURCES, **_OPTIONS.get(name, {})))
        for name, (function, _) in UNITS.items()
    }
    return [name for name, folder in folders.items() if not any(folder.rglob("*.nbc"))]


def build(name: str, announce: Callable[[str], None] | None = None) -> Any:
    """Compile one unit into the cache, or load it; returns its dispatcher."""
    function, signature = UNITS[name]
    return compile_host(function, signature, SOURCES, announce, **_OPTIONS.get(name, {})).dispatcher


def build_group(names: str) -> None:
    """Compile units, separated by commas, into the cache; the whole work of a process."""
    end_with_parent()
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
        announce(f"compiling {len(absent)} parts of the solver (once, a quarter of a minute to some minutes)")
    code = "import sys; from lambda_core.solver.entry import build_group; build_group(sys.argv[1])"
    for group in GROUPS:
        names = ",".join(name for name in group if name in absent)
        if names:
            command = [sys.executable, "-P", "-W", "ignore", "-c", code, names]
            quiet = subprocess.DEVNULL
            _workers.append(subprocess.Popen(command, stdin=subprocess.PIPE, stdout=quiet, stderr=quiet))
    atexit.register(_stop)


def _stop() -> None:
    """End what still compiles: whoever needed it has gone."""
    for worker in _workers:
        worker.terminate()
        worker.communicate()


def _call(dispatcher: Any, signature: Any) -> Any:
    """Return the machine code of one signature as a Python callable.

    A dispatcher would work out the types of its arguments at every call, a millisecond for the bundle; here they are
    always the same, made by lambda_core.solver.drivers.solver_context.
    """
    return dispatcher.get_compile_result(signature).entry_point


def _load(announce: Callable[[str], None] | None) -> Core:
    begin(announce)
    for worker in _workers:
        worker.wait()
        worker.communicate()
    _workers.clear()
    built = {name: build(name, announce) for name in UNITS}
    pointers = {
        f"{name}_pointer": Pointer(built[name], UNITS[name][1])
        for name in ("wrench", "tangent", "evaluate", "jacobian", "advance", "advance_finely", "observe")
    }
    names = (
        "evaluate", "jacobian", "advance", "advance_finely", "observe", "solve_static", "integrate",
        "sample",
    )  # fmt: skip
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
