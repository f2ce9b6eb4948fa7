"""Call the compiled right-hand side from Python.

A call costs a microsecond; the state in hand and what comes of it stand in the integrator's memory.
"""

# Numba infers the types of compiled functions.
# mypy: disable-error-code="no-untyped-def, no-untyped-call, misc, untyped-decorator, call-arg, var-annotated"
from __future__ import annotations

import warnings
from functools import cache
from typing import Any

import numpy as np
from numba import njit, types

from lambda_core.domain.arrays import FloatArray
from lambda_core.laws.jit.unstable import NumbaExperimentalFeatureWarning
from lambda_core.solver import layout as T
from lambda_core.solver.arrays import bundle as L
from lambda_core.solver.arrays.integrator_memory import make_memory
from lambda_core.solver.arrays.jacobian_blocks import AFTER, BEFORE
from lambda_core.solver.drivers.solver_context import SolverContext
from lambda_core.solver.integrator.handle import handle_t
from lambda_core.solver.integrator.state_blocks import dense_slopes

_frozen1 = types.Array(types.float64, 1, "C", readonly=True)


def _slope(t, y, out, handle):
    memory = handle.memory
    for i in range(memory.new.size):
        memory.new[i] = y[i]
    return handle.evaluate(t, memory.new, handle.bundle, out, memory.rates, 0)


def _slope_and_rates(t, y, out, handle):
    memory = handle.memory
    n = memory.new.size
    for i in range(n):
        memory.new[i] = y[i]
    ok = handle.evaluate(t, memory.new, handle.bundle, memory.slope, memory.rates, 1)
    out[:n] = memory.slope
    out[n:] = memory.rates
    return ok


def _dense(t, y, out, handle):
    """Write the Jacobian as a dense matrix.

    Return 1, or the status of the kernels.
    """
    memory = handle.memory
    for i in range(memory.new.size):
        memory.new[i] = y[i]
    if handle.evaluate(t, memory.new, handle.bundle, memory.slope, memory.rates, 0) != 1:
        return 0  # the compiled Jacobian builds on the evaluation at its point
    ok = handle.jacobian(t, memory.new, handle.bundle, handle.blocks)
    bl, reach, n = handle.blocks, handle.blocks.reach, handle.blocks.d.shape[0]
    tail = reach.states[reach.width.size]
    out[:, :] = 0.0
    for r in range(reach.width.size):
        first, count = reach.first[r], reach.first[r + 1] - reach.first[r]
        size = (reach.states[r + 1] - reach.states[r]) // count
        for j in range(first, first + count):
            row = reach.states[r] + size * (j - first)
            for i in range(size):
                for k in range(size):
                    out[row + i, row + k] = bl.a[j, i, k]
                for k in range(reach.width[r]):
                    column = tail + reach.columns[r, k]
                    out[row + i, column] = bl.b[j, i, k]
                    out[column, row + i] = bl.c[j, k, i]
            if bl.cross.shape[0] > 0:
                before = reach.states[r] + size * ((j - first - 1) % count)
                after = reach.states[r] + size * ((j - first + 1) % count)
                for i in range(size):
                    for k in range(size):
                        out[row + i, before + k] += bl.cross[j, BEFORE, i, k]
                        out[row + i, after + k] += bl.cross[j, AFTER, i, k]
    for i in range(n):
        for k in range(n):
            out[tail + i, tail + k] = bl.d[i, k]
    dense_slopes(handle.bundle, tail + n, out)
    return ok


def _rates(times, states, out, handle):
    memory = handle.memory
    for i in range(times.size):
        memory.new[:] = states[i]
        if handle.evaluate(times[i], memory.new, handle.bundle, memory.slope, memory.rates, 1) != 1:
            return 0
        out[i] = memory.rates
    return 1


_f8, _i8, _a1 = types.float64, types.int64, T.array1
_SIGNATURES: dict[Any, Any] = {
    _slope: _i8(_f8, _frozen1, _a1, handle_t),
    _slope_and_rates: _i8(_f8, _frozen1, _a1, handle_t),
    _dense: _i8(_f8, _frozen1, T.array2, handle_t),
    _rates: _i8(_a1, T.array2, T.array2, handle_t),
}


def compiled(function: Any, signature: Any) -> Any:
    """Compile a function of a handle.

    `signature` has the types of its arguments.
    """
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", NumbaExperimentalFeatureWarning)
        return njit(signature, error_model="numpy")(function)


@cache
def _compiled(function: Any) -> Any:
    return compiled(function, _SIGNATURES[function])


class Handle:
    """Compiled functions of a model for fast calls.

    A call costs a microsecond.

    Parameters
    ----------
    context : SolverContext
        Of the model; its workspaces are used.
    """

    def __init__(self, context: SolverContext) -> None:
        self.context = context
        self.size = n = context.size
        self._memory = make_memory(np.zeros(n), context.scale, 1.0, context.bundle, capacity=1)
        self._handle = context.handle(self._memory)

    def slope(self, t: float, y: FloatArray, out: FloatArray) -> int:
        """Write dy/dt.

        All shapes are (n,). Return 1, or 0 where a kernel refused. `y` may be anything that can be read.
        """
        return int(_compiled(_slope)(t, _frozen(y), out, self._handle))

    def slope_and_rates(self, t: float, y: FloatArray, out: FloatArray) -> int:
        """Write dy/dt and the integrals' rates.

        The rates follow dy/dt, as `slope` does.

        `y` may have the running integrals behind the states; nothing depends on them.
        """
        return int(_compiled(_slope_and_rates)(t, _frozen(y), out, self._handle))

    def jacobian(self, t: float, y: FloatArray, out: FloatArray) -> int:
        """Write d(dy/dt)/dy into a matrix.

        It fills its first n rows and columns and writes 0 elsewhere.
        """
        return int(_compiled(_dense)(t, _frozen(y), out, self._handle))

    def rates(self, times: FloatArray, states: FloatArray) -> FloatArray:
        """Return the rates of the running integrals.

        They have the shape (times, powers) [W, rad/s, m].
        """
        out = np.zeros((times.size, L.power_count(self.context.bundle)))
        if _compiled(_rates)(times, np.ascontiguousarray(states), out, self._handle) != 1:
            raise RuntimeError("a kernel refused a state that an integrator had accepted")
        return out


def _frozen(y: FloatArray) -> FloatArray:
    """Return a read-only view.

    CVODE's own arrays are such, and one kind of argument is compiled once.
    """
    y = y.view()
    y.flags.writeable = False
    return y
