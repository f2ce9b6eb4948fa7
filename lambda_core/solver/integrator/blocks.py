"""Define types of Jacobian blocks and factors."""

from __future__ import annotations

from lambda_core.laws.jit.references import reference_t
from lambda_core.solver.arrays.factors import Factors
from lambda_core.solver.arrays.jacobian_blocks import Blocks

blocks_t = reference_t(Blocks)
factors_t = reference_t(Factors)
