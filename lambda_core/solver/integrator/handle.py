"""One model's compiled functions and arrays behind one object, handed to compiled code once.

Handing the record of constants, forty pointers and workspaces over from Python takes a tenth of a millisecond, far
longer than an evaluation. A call through the handle costs a microsecond.
"""

from __future__ import annotations

from typing import Any

from numba import types

from lambda_core.laws.jit.unstable import structref
from lambda_core.solver import sampling as observe
from lambda_core.solver.integrator import memory as memo
from lambda_core.solver.integrator.arrow import factors_t
from lambda_core.solver.integrator.blocks import blocks_t
from lambda_core.solver.integrator.stepping import advance_sig
from lambda_core.solver.layout import array1, array2, array3, array4, bundle_t, f8, i8

FIELDS = (
    ("evaluate", memo.evaluate_t),
    ("jacobian", memo.jacobian_t),
    ("advance", types.FunctionType(advance_sig)),
    ("observe", types.FunctionType(observe.observe_sig)),
    ("bundle", bundle_t),
    ("blocks", blocks_t),
    ("factors", factors_t),
    ("memory", memo.memory_t),
)


@structref.register
class HandleType(types.StructRef):
    """Type of the handle in compiled code."""

    def preprocess_fields(self, fields: Any) -> Any:
        """Return the fields with the types of variables."""
        return tuple((name, types.unliteral(kind)) for name, kind in fields)


class Handle(structref.StructRefProxy):
    """The handle as Python sees it."""


structref.define_proxy(Handle, HandleType, [name for name, _ in FIELDS])
handle_t = HandleType(FIELDS)
make_context_sig = handle_t(*(kind for _, kind in FIELDS))
integrate_sig = i8(handle_t, f8, i8)
sample_sig = i8(handle_t, array1, array2, f8, array4, array3, array3, array2, array2, array2, array1)


def make_context(evaluate, jacobian, advance, observe, bundle, blocks, factors, memory):
    """Return a handle on everything; an entry point."""
    handle = structref.new(handle_t)
    handle.evaluate, handle.jacobian, handle.advance, handle.observe = evaluate, jacobian, advance, observe
    handle.bundle, handle.blocks, handle.factors, handle.memory = bundle, blocks, factors, memory
    return handle


def integrate(handle, until, max_work):
    """Integrate; an entry point. See stepping.take_steps."""
    return handle.advance(
        handle.evaluate, handle.jacobian, until, max_work, handle.bundle, handle.blocks, handle.factors, handle.memory
    )


def sample(handle, times, states, shorted, contacts, pockets, lands, extra, shared, rates, dydt):
    """Write what samples show; an entry point. See observe.observe."""
    return handle.observe(
        times, states, handle.bundle, handle.evaluate, shorted, contacts, pockets, lands, extra, shared, rates, dydt
    )
