"""Repeat parts of a step in compiled code.

So their times contain no call from Python.
"""

# Numba infers the types of compiled functions.
# mypy: disable-error-code="no-untyped-def, no-untyped-call"
from __future__ import annotations

from functools import cache
from typing import Any

from numba import types

from lambda_core.solver.drivers import right_hand_side as base
from lambda_core.solver.integrator.arrow import arrow_factor, arrow_solve

FloatArray = base.FloatArray


def _repeat_slope(count, t, handle):
    memory, bundle = handle.memory, handle.bundle
    for _ in range(count):
        handle.evaluate(t, memory.new, bundle, memory.slope, memory.rates, 1)
    return count


def _repeat_jacobian(count, t, handle):
    memory, bundle, blocks = handle.memory, handle.bundle, handle.blocks
    for _ in range(count):
        handle.jacobian(t, memory.new, bundle, blocks)
    return count


def _repeat_factor(count, gamma, handle):
    blocks, factors = handle.blocks, handle.factors
    for _ in range(count):
        blocks.changed[:], blocks.newer[:] = 1, 1  # otherwise bearings on one shaft keep the factors of their balls
        arrow_factor(blocks, 1.0, gamma, factors)
    return count


def _repeat_solve(count, handle):
    memory, blocks, factors = handle.memory, handle.blocks, handle.factors
    for _ in range(count):
        arrow_solve(blocks, factors, memory.slope)
    return count


_f8, _i8 = types.float64, types.int64
_SIGNATURES: dict[Any, Any] = {
    _repeat_slope: _i8(_i8, _f8, base.handle_t),
    _repeat_jacobian: _i8(_i8, _f8, base.handle_t),
    _repeat_factor: _i8(_i8, _f8, base.handle_t),
    _repeat_solve: _i8(_i8, base.handle_t),
}


@cache
def _compiled(function: Any) -> Any:
    return base.compiled(function, _SIGNATURES[function])


class Handle(base.Handle):
    """Compiled functions of a model.

    Called once or many times at the same state.
    """

    def settle_at(self, t: float, y: FloatArray, gamma: float) -> None:
        """Bring everything to one state.

        Kinematics, Jacobian, factors of what is repeated.
        """
        self._memory.new[:] = y
        self.repeat_slope(1, t)
        self.repeat_jacobian(1, t)
        self.repeat_factor(1, gamma)

    def repeat_slope(self, count: int, t: float) -> None:
        """Repeat the right-hand side.

        With all powers, `count` times at the same state.
        """
        _compiled(_repeat_slope)(count, t, self._handle)

    def repeat_jacobian(self, count: int, t: float) -> None:
        """Evaluate the Jacobian `count` times at the same state."""
        _compiled(_repeat_jacobian)(count, t, self._handle)

    def repeat_factor(self, count: int, gamma: float) -> None:
        """Factor I - gamma J `count` times."""
        _compiled(_repeat_factor)(count, gamma, self._handle)

    def repeat_solve(self, count: int) -> None:
        """Solve with the factors `count` times."""
        self._memory.slope[:] = 1e-3
        _compiled(_repeat_solve)(count, self._handle)
