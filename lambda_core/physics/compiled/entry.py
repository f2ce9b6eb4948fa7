"""Entry points of the compiled core: compiled once each, kept on disk, handed out as pointers."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any

from lambda_core.physics.compiled import bdf, forces, jacobian, observe, statics
from lambda_core.registry.kernels import compile_host
from lambda_core.registry.machine_code import Pointer

_FOLDER = Path(__file__).parent


@dataclass(frozen=True)
class Core:
    """Compiled functions of the core; `*_pointer` are for other compiled code."""

    evaluate: Any
    evaluate_pointer: Any
    jacobian: Any
    jacobian_pointer: Any
    advance: Any
    observe: Any
    settle: Any


@cache
def _core(announce: Callable[[str], None] | None) -> Core:
    def build(function: Any, signature: Any) -> Any:
        return compile_host(function.py_func, signature, _FOLDER, announce).dispatcher

    evaluate = build(forces.evaluate, bdf.evaluate_sig)
    jac = build(jacobian.jacobian, bdf.jacobian_sig)
    return Core(
        evaluate,
        Pointer(evaluate, bdf.evaluate_sig),
        jac,
        Pointer(jac, bdf.jacobian_sig),
        build(bdf.advance, bdf.advance_sig),
        build(observe.observe, observe.observe_sig),
        build(statics.settle, statics.settle_sig),
    )


def core(announce: Callable[[str], None] | None = None) -> Core:
    """Return the compiled core, from disk when it was compiled before.

    `announce` is called with a sentence before anything is compiled.
    """
    return _core(announce)
