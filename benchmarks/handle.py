"""One model's compiled right-hand side and linear algebra, kept where compiled code reaches it.

Handing the record of constants, pointers and workspaces over from Python takes a millisecond, far longer than an
evaluation. Here it is handed over once; a call through the handle costs a microsecond.
"""

# Numba infers the types of compiled functions.
# mypy: disable-error-code="no-untyped-def, no-untyped-call, misc, untyped-decorator, call-arg, var-annotated"
from __future__ import annotations

import warnings
from functools import cache
from typing import Any

import numpy as np
from numba import njit, types
from numba.core.errors import NumbaExperimentalFeatureWarning
from numba.experimental import structref
from numpy.typing import NDArray

from lambda_core.physics.assembly import Assembly
from lambda_core.physics.compiled import bdf
from lambda_core.physics.compiled import layout as L
from lambda_core.physics.compiled.arrow import arrow_factor, arrow_solve, factors_t, make_factors
from lambda_core.physics.compiled.entry import core
from lambda_core.physics.compiled.jacobian import blocks_t

FloatArray = NDArray[np.float64]
_FIELDS = (
    ("evaluate", bdf.evaluate_t),
    ("jacobian", bdf.jacobian_t),
    ("bundle", L.bundle_t),
    ("blocks", blocks_t),
    ("factors", factors_t),
    ("y", L.array1),
    ("slope", L.array1),
    ("rates", L.array1),
)


@structref.register
class _HandleType(types.StructRef):
    def preprocess_fields(self, fields):
        return tuple((name, types.unliteral(kind)) for name, kind in fields)


class _Handle(structref.StructRefProxy):
    """The handle as Python sees it."""


structref.define_proxy(_Handle, _HandleType, [name for name, _ in _FIELDS])
_handle_t = _HandleType(_FIELDS)
_frozen1 = types.Array(types.float64, 1, "C", readonly=True)


def _new(evaluate, jacobian, bundle, blocks, factors, y, slope, rates):
    handle = structref.new(_handle_t)
    handle.evaluate, handle.jacobian, handle.bundle, handle.blocks = evaluate, jacobian, bundle, blocks
    handle.factors, handle.y, handle.slope, handle.rates = factors, y, slope, rates
    return handle


def _slope(t, y, out, handle):
    for i in range(y.size):
        handle.y[i] = y[i]
    return handle.evaluate(t, handle.y, handle.bundle, out, handle.rates, 0)


def _dense(t, y, out, handle):
    """Write the Jacobian as a dense matrix; returns 1, or what the kernels said."""
    for i in range(y.size):
        handle.y[i] = y[i]
    ok = handle.jacobian(t, handle.y, handle.bundle, handle.blocks)
    bl = handle.blocks
    balls, n = bl.b.shape[0], bl.b.shape[2]
    tail = L.NB * balls
    out[:, :] = 0.0
    for j in range(balls):
        row = L.NB * j
        for i in range(L.NB):
            for k in range(L.NB):
                out[row + i, row + k] = bl.a[j, i, k]
            for k in range(n):
                out[row + i, tail + k] = bl.b[j, i, k]
                out[tail + k, row + i] = bl.c[j, k, i]
    for i in range(n):
        for k in range(n):
            out[tail + i, tail + k] = bl.d[i, k]
    return ok


def _rates(times, states, out, handle):
    for i in range(times.size):
        handle.y[:] = states[i]
        if handle.evaluate(times[i], handle.y, handle.bundle, handle.slope, handle.rates, 1) != 1:
            return 0
        out[i] = handle.rates
    return 1


def _repeat_slope(count, t, handle):
    for _ in range(count):
        handle.evaluate(t, handle.y, handle.bundle, handle.slope, handle.rates, 1)
    return count


def _repeat_jacobian(count, t, handle):
    for _ in range(count):
        handle.jacobian(t, handle.y, handle.bundle, handle.blocks)
    return count


def _repeat_factor(count, gamma, handle):
    for _ in range(count):
        arrow_factor(handle.blocks, 1.0, gamma, handle.factors)
    return count


def _repeat_solve(count, handle):
    for _ in range(count):
        arrow_solve(handle.factors, handle.slope)
    return count


_f8, _i8, _a1 = types.float64, types.int64, L.array1
_SIGNATURES = {
    _new: _handle_t(*(kind for _, kind in _FIELDS)),
    _slope: _i8(_f8, _frozen1, _a1, _handle_t),
    _dense: _i8(_f8, _frozen1, L.array2, _handle_t),
    _rates: _i8(_a1, L.array2, L.array2, _handle_t),
    _repeat_slope: _i8(_i8, _f8, _handle_t),
    _repeat_jacobian: _i8(_i8, _f8, _handle_t),
    _repeat_factor: _i8(_i8, _f8, _handle_t),
    _repeat_solve: _i8(_i8, _handle_t),
}


@cache
def _compiled(function: Any) -> Any:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", NumbaExperimentalFeatureWarning)
        return njit(_SIGNATURES[function], error_model="numpy")(function)


class Handle:
    """A model's compiled functions at the cost of a microsecond per call.

    Parameters
    ----------
    assembly : Assembly
        Of the model; its workspaces are used.
    """

    def __init__(self, assembly: Assembly) -> None:
        self.assembly = assembly
        self.size = n = assembly.size
        self._state, self._slope = np.zeros(n), np.zeros(n)
        compiled = core()
        factors = make_factors(assembly.model.geometry.ball_count, assembly.bundle.active.size)
        self._handle = _compiled(_new)(
            compiled.evaluate_pointer,
            compiled.jacobian_pointer,
            assembly.bundle,
            assembly.blocks,
            factors,
            self._state,
            self._slope,
            np.zeros(L.NI),
        )

    def slope(self, t: float, y: FloatArray, out: FloatArray) -> int:
        """Write dy/dt, shapes (n,); returns 1, or 0 where a kernel refused. `y` may be anything that can be read."""
        y = y.view()
        y.flags.writeable = False
        return int(_compiled(_slope)(t, y, out, self._handle))

    def jacobian(self, t: float, y: FloatArray, out: FloatArray) -> int:
        """Write the dense Jacobian into a matrix (n, n)."""
        y = y.view()
        y.flags.writeable = False
        return int(_compiled(_dense)(t, y, out, self._handle))

    def rates(self, times: FloatArray, states: FloatArray) -> FloatArray:
        """Return the rates of the running integrals, shape (times, layout.NI) [W, rad/s, m]."""
        out = np.zeros((times.size, L.NI))
        if _compiled(_rates)(times, np.ascontiguousarray(states), out, self._handle) != 1:
            raise RuntimeError("a kernel refused a state that an integrator had accepted")
        return out

    def settle_at(self, t: float, y: FloatArray, gamma: float) -> None:
        """Bring everything that is repeated to one state: kinematics, Jacobian, factors."""
        self._state[:] = y
        self.repeat_slope(1, t)
        self.repeat_jacobian(1, t)
        self.repeat_factor(1, gamma)

    def repeat_slope(self, count: int, t: float) -> None:
        """Evaluate the right-hand side with all powers, `count` times at the same state."""
        _compiled(_repeat_slope)(count, t, self._handle)

    def repeat_jacobian(self, count: int, t: float) -> None:
        """Evaluate the Jacobian `count` times at the same state."""
        _compiled(_repeat_jacobian)(count, t, self._handle)

    def repeat_factor(self, count: int, gamma: float) -> None:
        """Factor I - gamma J `count` times."""
        _compiled(_repeat_factor)(count, gamma, self._handle)

    def repeat_solve(self, count: int) -> None:
        """Solve with the factors `count` times."""
        self._slope[:] = 1e-3
        _compiled(_repeat_solve)(count, self._handle)
