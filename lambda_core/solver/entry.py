"""Compile the entry points of the core.

They are kept on disk and passed as pointers.
"""

from __future__ import annotations

import atexit
import gc
import os
import subprocess
import sys
from collections.abc import Callable, Iterable
from pathlib import Path
from typing import Any

from lambda_core.domain.parents import end_with_parent
from lambda_core.laws.jit.machine_code import Pointer
from lambda_core.laws.kernels import compile_host, host_folder, host_key
from lambda_core.solver import layout
from lambda_core.solver import sampling as observe
from lambda_core.solver.code_files import compiled_sources, roller_sources
from lambda_core.solver.contact import cell_probe, raceway, tangent
from lambda_core.solver.integrator import bdf, esdirk, handle, memory, stepping
from lambda_core.solver.motion import forces, jacobian
from lambda_core.solver.statics import continuation as statics

SOURCES = compiled_sources()


# Each unit calls the others through pointers, so that none is compiled into another.
UNITS: dict[str, tuple[Any, Any]] = {
    "wrench": (raceway.raceway_wrenches, layout.wrench_sig),
    "tangent": (tangent.contact_tangent, layout.tangent_sig),
    "evaluate": (forces.evaluate, memory.evaluate_sig),
    "jacobian": (jacobian.jacobian, memory.jacobian_sig),
    "advance": (bdf.advance, stepping.advance_sig),
    "advance_finely": (esdirk.advance, stepping.advance_sig),
    "observe": (observe.observe, observe.observe_sig),
    "solve_static": (statics.solve_static, statics.solve_static_sig),
    "integrate": (handle.integrate, handle.integrate_sig),
    "sample": (handle.sample, handle.sample_sig),
    "probe": (cell_probe.probe, cell_probe.probe_sig),
}
ON_DEMAND = ("advance_finely", "probe")  # compiled when a run first needs it
NEEDED = tuple(name for name in UNITS if name not in ON_DEMAND)
# What one process compiles, the longest work first. Units of a group call the same functions, which are typed once.
GROUPS = (
    ("evaluate", "jacobian", "wrench", "tangent"),
    ("advance", "solve_static", "observe", "integrate", "sample"),
    ("advance_finely", "probe"),
)
# The same with more processors; all but the last take about as long.
FINER_GROUPS = (
    ("jacobian",),
    ("advance",),
    ("evaluate", "observe", "integrate", "sample"),
    ("solve_static", "wrench", "tangent"),
    ("advance_finely", "probe"),
)
# Of machines with rollers, in the same way.
ROLLER_GROUPS = (
    ("roller_jacobian", "roller_factor", "roller_solve"),
    ("roller_evaluate", "roller_observe", "roller_energy", "roller_shares"),
)
OF_ROLLERS = tuple(name for group in ROLLER_GROUPS for name in group)
# The equilibrium allocates its workspaces; all others run without reference counting.
# What takes long lets other threads work: one of them hears the signals meanwhile.
_OPTIONS: dict[str, dict[str, Any]] = {
    name: {"_nrt": True, "nogil": True} for name in ("solve_static", "integrate", "sample")
}


def missing(names: Iterable[str] = tuple(UNITS)) -> list[str]:
    """Return the units that are not on disk yet."""
    folders = {}
    for name in names:
        function, _, sources = _unit(name)
        folders[name] = host_folder(host_key(function, sources, **_OPTIONS.get(name, {})))
    return [name for name, folder in folders.items() if not any(folder.rglob("*.nbc"))]


def build(name: str, announce: Callable[[str], None] | None = None) -> Any:
    """Compile one unit or load it.

    The cache takes it; return its dispatcher.
    """
    function, kind, sources = _unit(name)
    return compile_host(function, kind, sources, announce, **_OPTIONS.get(name, {})).dispatcher


def _unit(name: str) -> tuple[Any, Any, tuple[Path, ...]]:
    """Return a unit's function, signature and sources.

    It may be one of rollers.
    """
    if name in UNITS:
        return (*UNITS[name], SOURCES)
    from lambda_core.solver.roller import units

    return (*units.UNITS[name], roller_sources())


def signature(name: str) -> Any:
    """Return a unit's signature."""
    return _unit(name)[1]


def build_group(names: str) -> None:
    """Compile units into the cache.

    They are separated by commas; this is all the work of a process.
    """
    end_with_parent()
    gc.disable()  # most of what a compiler makes lives until it ends: looking for the rest takes a sixth of the time
    for name in names.split(","):
        build(name)


def begin(announce: Callable[[str], None] | None = None, units: Iterable[str] | None = None) -> None:
    """Begin to compile missing code in processes.

    It is not on disk; :func:`wait` waits for them.

    A unit whose process fails is compiled by :func:`call_and_pointer`, where its error is seen.

    Parameters
    ----------
    announce : callable, optional
        Called with a sentence before anything is compiled.
    units : iterable of str, optional
        Of :data:`UNITS` and :data:`OF_ROLLERS`; by default :data:`NEEDED`. What was asked for before is left out.
    """
    wanted = [*(NEEDED if units is None else units)]
    absent = missing(name for name in wanted if name not in _begun)
    _begun.update(wanted)
    if len(absent) < 2:
        return
    if announce is not None:
        announce(f"compiling {len(absent)} parts of the solver (once, a quarter of a minute to some minutes)")
    code = "import sys; from lambda_core.solver.entry import build_group; build_group(sys.argv[1])"
    for group in (*(GROUPS if _processors() <= len(GROUPS) else FINER_GROUPS), *ROLLER_GROUPS):
        names = ",".join(name for name in group if name in absent)
        if names:
            command = [sys.executable, "-P", "-W", "ignore", "-c", code, names]
            quiet = subprocess.DEVNULL
            _workers.append(subprocess.Popen(command, stdin=subprocess.PIPE, stdout=quiet, stderr=quiet))
    atexit.register(_stop)


def _processors() -> int:
    """Return how many processors this process may use."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


def _stop() -> None:
    """End what still compiles: whoever needed it has gone."""
    for worker in _workers:
        worker.terminate()
        worker.communicate()


def wait() -> None:
    """Wait for the processes that compile."""
    for worker in _workers:
        worker.wait()
        worker.communicate()
    _workers.clear()


def call_and_pointer(name: str, announce: Callable[[str], None] | None = None) -> tuple[Any, Pointer]:
    """Return a unit's callable and address.

    The callable is machine code for Python; the address is for other compiled code.

    A dispatcher would work out the types of its arguments at every call, a millisecond for the bundle; here they are
    always the same, made by lambda_core.solver.drivers.solver_context.
    """
    dispatcher, kind = build(name, announce), signature(name)
    return dispatcher.get_compile_result(kind).entry_point, Pointer(dispatcher, kind)


_workers: list[subprocess.Popen[bytes]] = []
_begun: set[str] = set()  # units that :func:`begin` was asked for in this process
