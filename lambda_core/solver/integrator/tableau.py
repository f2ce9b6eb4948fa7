"""Define coefficients of ESDIRK4(3)6L[2]SA.

Six stages: the first is the last one of the step before, five are implicit.

Kennedy and Carpenter, Diagonally implicit Runge-Kutta methods for ordinary differential equations. A review,
NASA/TM-2016-219173, 2016, table 16 (and Appl. Numer. Math. 146 (2019) 221). Order 4, with an embedded formula of
order 3; both are L-stable. Every implicit stage has the same gamma, and so the same arrow matrix as a step of the BDF.
"""

from __future__ import annotations

import numpy as np

from lambda_core.domain.arrays import FloatArray

STAGES = 6
GAMMA = 0.25  # of each implicit stage: y_i = base + GAMMA h f(y_i)
_R = float(np.sqrt(2.0))


def _matrix() -> FloatArray:
    """Return a_ij: y_i = y + h sum_j a_ij f_j."""
    rows = (
        (),
        (1.0 / 4.0,),
        ((1.0 - _R) / 8.0, (1.0 - _R) / 8.0),
        ((5.0 - 7.0 * _R) / 64.0, (5.0 - 7.0 * _R) / 64.0, 7.0 * (1.0 + _R) / 32.0),
        (
            (-13796.0 - 54539.0 * _R) / 125000.0, (-13796.0 - 54539.0 * _R) / 125000.0,
            (506605.0 + 132109.0 * _R) / 437500.0, 166.0 * (-97.0 + 376.0 * _R) / 109375.0,
        ),
        (
            (1181.0 - 987.0 * _R) / 13782.0, (1181.0 - 987.0 * _R) / 13782.0, 47.0 * (-267.0 + 1783.0 * _R) / 273343.0,
            -16.0 * (-22922.0 + 3525.0 * _R) / 571953.0, -15625.0 * (97.0 + 376.0 * _R) / 90749876.0,
        ),
    )  # fmt: skip
    a = np.zeros((STAGES, STAGES))
    for i, row in enumerate(rows):
        a[i, : len(row)] = row
        a[i, i] = GAMMA if i else 0.0
    return a


A = _matrix()
NODES = A.sum(axis=1)  # times of the stages, in steps: 0, 1/2, (2 - sqrt(2))/4, 5/8, 26/25, 1
WEIGHTS = A[-1].copy()  # stiffly accurate: the last stage is the result
EMBEDDED = np.array(
    [
        -480923228411.0 / 4982971448372.0,
        -480923228411.0 / 4982971448372.0,
        6709447293961.0 / 12833189095359.0,
        3513175791894.0 / 6748737351361.0,
        -498863281070.0 / 6042575550617.0,
        2077005547802.0 / 8945017530137.0,
    ]
)
ERROR = WEIGHTS - EMBEDDED  # h sum_j ERROR_j f_j is the difference of both formulas

# What the scheme takes of a quadratic energy y.M y/2 in a step is h^2/2 sum_ij LOSS_ij f_i.M f_j: the matrix of
# algebraic stability (Burrage and Butcher 1979, SIAM J. Numer. Anal. 16, 46; Hairer and Wanner 1996, IV.12).
LOSS = WEIGHTS[:, None] * A + WEIGHTS[None, :] * A.T - np.outer(WEIGHTS, WEIGHTS)
