"""One model's compiled functions and arrays behind one address, which calls from Python hand over."""

from __future__ import annotations

from typing import Any, NamedTuple

from numba import types

from lambda_core.laws.jit.references import by_reference, reference_t
from lambda_core.solver import sampling as observe
from lambda_core.solver.integrator import memory as memo
from lambda_core.solver.integrator.arrow import factors_t
from lambda_core.solver.integrator.blocks import blocks_t
from lambda_core.solver.integrator.stepping import advance_sig
from lambda_core.solver.layout import array1, array2, array3, array4, bundle_t, f8, i8


@by_reference
class Handle(NamedTuple):
    """Everything that an integration takes."""

    evaluate: Any  # pointer to forces.evaluate
    jacobian: Any  # pointer to jacobian.jacobian
    advance: Any  # pointer to bdf.advance or esdirk.advance
    observe: Any  # pointer to sampling.observe
    bundle: Any  # Bundle
    blocks: Any  # Blocks
    factors: Any  # Factors
    memory: Any  # Memory


handle_t = reference_t(
    Handle,
    {
        "evaluate": memo.evaluate_t,
        "jacobian": memo.jacobian_t,
        "advance": types.FunctionType(advance_sig),
        "observe": types.FunctionType(observe.observe_sig),
        "bundle": bundle_t,
        "blocks": blocks_t,
        "factors": factors_t,
        "memory": memo.memory_t,
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
