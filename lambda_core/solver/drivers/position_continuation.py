"""Find equilibria from those of balls at other azimuths.

With one ball lowest the loads are symmetrical, and its neighbours stand at kinks of their friction together. The
same balls a tenth of a pitch further on do not: their motion is found and taken along to the azimuths that are asked
for (natural-parameter continuation: Allgower and Georg 1990, Numerical Continuation Methods, 1.1).
"""

from __future__ import annotations

import math

from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.errors import SolverError
from lambda_core.domain.time_limit import is_late
from lambda_core.solver.arrays import bundle as L
from lambda_core.solver.drivers.solver_context import SolverContext
from lambda_core.solver.drivers.viscosity_continuation import Solve, StaticReport

_APART = (0.1, -0.1, 0.2)  # where the way may begin, in pitches


def by_other_positions(
    context: SolverContext, start: FloatArray, solve: Solve
) -> tuple[FloatArray, StaticReport] | None:
    """Return the equilibrium by way of other azimuths.

    Also return its report. The result is None where no way leads there.

    Parameters
    ----------
    start : float64[:], shape (size,)
        State without friction.
    solve : callable
        Raises SolverError where it finds none.
    """
    pitch = 2.0 * math.pi / context.model.geometry.ball_count
    for apart in _APART:
        state = start.copy()
        azimuths = L.elements_in(context.bundle, state)["azimuth"]
        try:
            azimuths += apart * pitch
            solve(context, state)
            azimuths -= apart * pitch
            return state, solve(context, state)
        except SolverError:
            if is_late():
                raise
    return None
