"""Compute Newton's correction and its size."""

from __future__ import annotations

import math

from lambda_core.solver.integrator.arrow import REFACTOR, arrow_factor, arrow_solve
from lambda_core.solver.integrator.bypass import follow
from lambda_core.solver.integrator.state_blocks import solve_states
from lambda_core.solver.layout import helper, vector_helper
from lambda_core.solver.motion.bearing_sums import AGAIN
from lambda_core.solver.status import Status


@vector_helper
def norm(v, weight):
    """Return the root mean square of v times weight."""
    total = 0.0
    for i in range(v.size):
        x = v[i] * weight[i]
        total += x * x
    return math.sqrt(total / v.size)


@helper
def shared_norm(bundle, mem):
    """Return the shared correction's rms.

    It is that of the shared bodies, over the error allowed per step.
    """
    first = bundle.system[0].tail
    total = 0.0
    for i in range(first, first + bundle.active.size):
        x = mem.change[i] * mem.weight[i]
        total += x * x
    return math.sqrt(total / max(bundle.active.size, 1))


@helper
def renew(jacobian, t, gamma, bundle, bl, fa, mem):
    """Renew Jacobian and factors when due.

    They are those at the point evaluated last; return a Status.
    """
    control, count = mem.control[0], mem.count[0]
    if count.stale == 1:
        if jacobian(t, mem.new, bundle, bl) != Status.OK:
            return Status.REFUSED
        control.factored_gamma = 0.0
        count.stale = 0
    if abs(gamma / (control.factored_gamma + 1e-300) - 1.0) > REFACTOR:
        count.factorisations += 1
        if arrow_factor(bl, 1.0, gamma, fa) != 1:
            return Status.REFUSED
        control.factored_gamma = gamma
        control.convergence_rate = 1.0
    return Status.OK


@helper
def solve_correction(gamma, want, bundle, bl, fa, mem):
    """Write the last point's correction.

    It uses `want` and fills mem.change; return 0 where singular.
    """
    change, n = mem.change, mem.new.size
    for i in range(n):
        change[i] = mem.base[i] + gamma * mem.slope[i] - mem.new[i]
    if want == AGAIN:
        follow(gamma, bundle, bl, fa, mem)
    arrow_solve(bl, fa, change)
    if bundle.states.size > 0 and solve_states(bundle, gamma, change) != 1:
        return 0
    return 1
