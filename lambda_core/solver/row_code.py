"""Define function types of rows of rollers.

They are entry points of their own, called by pointer: the code of balls has none of it, and machines without rollers
never compile it. The addresses stand in tables, Bundle.rollers and Factors.rollers.
"""

from __future__ import annotations

from numba import types

from lambda_core.laws.jit.function_tables import reader
from lambda_core.solver.arrays.bundle import RollerCode
from lambda_core.solver.arrays.factors import RollerBlocks
from lambda_core.solver.integrator.blocks import blocks_t, factors_t
from lambda_core.solver.layout import array1, array2, array3, bundle_t, f8, i8

CONTACTS, GUIDES, MOTION = range(3)  # stages of an evaluation
POCKETS, RACEWAYS = range(2)  # stages of an observation
WHOLE, NEWER, FORWARD, BACK = range(4)  # what is factored; which half of a solution

# (stage, t, y, row, bundle, dydt, rates, want) -> 1 when well
evaluate_sig = i8(i8, f8, array1, i8, bundle_t, array1, array1, i8)
# (y, row, bundle, blocks) -> how many elements were due, -1 on a fault
jacobian_sig = i8(array1, i8, bundle_t, blocks_t)
# (y, row, bundle) -> stored energy [J]
energy_sig = f8(array1, i8, bundle_t)
# (stage, y, row, bundle, shorted, contacts, pockets, losses, rates) -> capacitance [F], negative on a fault
observe_sig = f8(i8, array1, i8, bundle_t, f8, array3, array2, array1, array1)
# (y, row, bundle, share): largest penetration of each roller on the ring of the row's first raceway
shares_sig = i8(array1, i8, bundle_t, array1)
# (stage, blocks, row, shift, gamma, factors, own) -> 0 when a block is singular
factor_sig = i8(i8, blocks_t, i8, f8, f8, factors_t, array2)
# (stage, row, blocks, factors, right-hand side, own) -> 1
solve_sig = i8(i8, i8, blocks_t, factors_t, array1, array1)


def _table(named, *signatures):
    return reader(types.NamedTuple([types.FunctionType(signature) for signature in signatures], named))


roller_code = _table(RollerCode, evaluate_sig, jacobian_sig, energy_sig, observe_sig, shares_sig)
roller_blocks = _table(RollerBlocks, factor_sig, solve_sig)
