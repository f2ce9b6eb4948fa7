"""Solve contact states by their own blocks.

A block holds the slopes of the rates with the states, fresh at every iterate. How forces and states change each other
stands in no block: that is left to the iteration, which converges where a step is short against the time in which
they do so; where it is not, steps get shorter.
"""

from __future__ import annotations

from lambda_core.solver.contact.contact_states import first_state
from lambda_core.solver.layout import helper
from lambda_core.solver.lu import lu_factor, lu_solve


@helper
def solve_states(bundle, gamma, change):
    """Solve the contacts' part of a correction.

    It solves (I - gamma dr/dx) in place, for Newton; return 0 when singular.
    """
    behind = change.size - bundle.states.size
    for r in range(bundle.rows.size):
        row = bundle.rows[r]
        for k in range(row.first_raceway, row.first_raceway + row.raceways):
            raceway = bundle.raceways[k]
            n = raceway.states
            for j in range(row.first_ball, row.first_ball + row.balls):
                first = first_state(raceway, j)
                block = bundle.state_slopes[first : first + n, :n]
                for s in range(n):
                    for c in range(n):
                        block[s, c] *= -gamma
                    block[s, s] += 1.0
                if lu_factor(block, bundle.state_pivots) != 1:
                    return 0
                lu_solve(block, bundle.state_pivots, change[behind + first : behind + first + n])
    return 1


@helper
def dense_slopes(bundle, behind, out):
    """Write the contact states' slopes densely.

    They are slopes of all rates with the states of their own contacts, from row `behind` on.
    """
    for r in range(bundle.rows.size):
        row = bundle.rows[r]
        for k in range(row.first_raceway, row.first_raceway + row.raceways):
            raceway = bundle.raceways[k]
            for j in range(row.first_ball, row.first_ball + row.balls):
                first = first_state(raceway, j)
                for s in range(raceway.states):
                    for c in range(raceway.states):
                        out[behind + first + s, behind + first + c] = bundle.state_slopes[first + s, c]
