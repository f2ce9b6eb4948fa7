"""Factor roller blocks of the block-arrow matrix.

Entry points of their own, called by pointer.
"""

from __future__ import annotations

from lambda_core.solver.arrays.bundle import NR
from lambda_core.solver.integrator.element_blocks import blocks_of
from lambda_core.solver.row_code import FORWARD, NEWER

_factor, _renew, _forward, _back = blocks_of(NR)


def factor(stage, bl, r, shift, gamma, fa, own):
    """Take the rollers' shares from `own`.

    The rollers are those of a row; the stage NEWER renews their shares. Return 0 when a block is singular.
    """
    if stage == NEWER:
        return _renew(bl, r, shift, fa, own)
    return _factor(bl, r, shift, gamma, fa, own)


def solve(stage, row, bl, fa, right, own):
    """Do half of a solution for rollers.

    The rollers are those of a row.
    """
    if stage == FORWARD:
        _forward(row, bl.reach, fa, right, own, bl.reach.width[row])
    else:
        _back(row, bl.reach, fa, right, own, bl.reach.width[row])
    return 1
