"""Entry points of the compiled core: compiled once each, kept on disk, handed out as pointers."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any

from lambda_core.physics.compiled import bdf, forces, jacobian, layout, observe, raceway, statics, tangent
from lambda_core.registry.kernels import compile_host
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


# Each unit calls the others through pointers, so that none is compiled into another.
UNITS: dict[str, tuple[Any, Any]] = {
    "wrench": (raceway.raceway_wrench, layout.wrench_sig),
    "tangent": (tangent.contact_tangent, layout.tangent_sig),
    "evaluate": (forces.evaluate, bdf.evaluate_sig),
    "jacobian": (jacobian.jacobian, bdf.jacobian_sig),
    "advance": (bdf.advance, bdf.advance_sig),
    "observe": (observe.observe, observe.observe_sig),
    "settle": (statics.settle, statics.settle_sig),
}


@cache
def _core(announce: Callable[[str], None] | None) -> Core:
    built = {
        name: compile_host(function, signature, _FOLDER, announce).dispatcher
        for name, (function, signature) in UNITS.items()
    }
    pointers = {
        f"{name}_pointer": Pointer(built[name], UNITS[name][1])
        for name in ("wrench", "tangent", "evaluate", "jacobian")
    }
    rest = {name: built[name] for name in ("evaluate", "jacobian", "advance", "observe", "settle")}
    return Core(**pointers, **rest)


def core(announce: Callable[[str], None] | None = None) -> Core:
    """Return the compiled core, from disk when it was compiled before.

    `announce` is called with a sentence before anything is compiled.
    """
    return _core(announce)
