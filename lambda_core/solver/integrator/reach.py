"""List the bodies and Jacobian columns that each row reaches.

A ball touches the raceways of its row and its cage, the waves of all of them and nothing else, so its blocks hold the
columns of those bodies alone: the *own* bodies of its row. Numbers among them are places; a row with fewer than the
widest leaves the rest unused.

The rates of positions depend on the state of their own body alone. So positions are eliminated first, each among the
states of its body (:mod:`.condensed`).
"""

from __future__ import annotations

from lambda_core.solver.layout import helper


@helper
def is_split(reach, n):
    """Tell whether several bearings share a shaft.

    No row of balls then reaches all of n shared states.
    """
    return reach.width[0] != n
