"""Types of the Jacobian's blocks and of their factors in compiled code."""

from __future__ import annotations

from lambda_core.laws.jit.references import reference_t
from lambda_core.solver.arrays.factors import Factors
from lambda_core.solver.arrays.jacobian_blocks import Blocks

blocks_t = reference_t(Blocks)
factors_t = reference_t(Factors)
