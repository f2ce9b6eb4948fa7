"""Define types of the integrator's memory."""

from __future__ import annotations

from numba import types

from lambda_core.laws.jit.references import reference_t
from lambda_core.solver.arrays.integrator_memory import Memory
from lambda_core.solver.integrator.blocks import blocks_t
from lambda_core.solver.layout import array1, bundle_t, f8, i8

evaluate_sig = i8(f8, array1, bundle_t, array1, array1, i8)
jacobian_sig = i8(f8, array1, bundle_t, blocks_t)
evaluate_t = types.FunctionType(evaluate_sig)
jacobian_t = types.FunctionType(jacobian_sig)
memory_t = reference_t(Memory)
