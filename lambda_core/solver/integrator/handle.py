"""Hold functions and arrays of a model behind one address."""

from __future__ import annotations

from numba import types

from lambda_core.laws.jit.references import reference_t
from lambda_core.solver import sampling as observe
from lambda_core.solver.arrays.integrator_memory import Handle
from lambda_core.solver.integrator import memory as memo
from lambda_core.solver.integrator.stepping import advance_sig
from lambda_core.solver.layout import array1, array2, array3, array4, f8, i8

handle_t = reference_t(
    Handle,
    {
        "evaluate": memo.evaluate_t,
        "jacobian": memo.jacobian_t,
        "advance": types.FunctionType(advance_sig),
        "observe": types.FunctionType(observe.observe_sig),
    },
)
integrate_sig = i8(handle_t, f8, i8)
sample_sig = i8(handle_t, array1, array2, f8, array4, array3, array3, array2, array2, array2, array1)


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
