"""Power that a raceway contact dissipates, by mechanism."""

from __future__ import annotations

import math

from lambda_core.physics.compiled.layout import (
    C_A,
    C_B,
    C_DAMP,
    C_HYST,
    C_ROLL,
    C_WET,
    GRID_AREA,
    GRID_DS,
    GRID_DT,
    GRID_S,
    GRID_T,
    L_BOUNDARY,
    L_DAMP,
    L_HYST,
    L_ROLL,
    L_SLIDE,
    L_SPIN,
    Q_VN,
    Q_WN,
    X_INVERSE,
    X_MU,
    X_TAU0,
    X_VS,
    X_VT,
    helper,
    vector_helper,
)
from lambda_core.physics.compiled.resultant import rolling_speeds
from lambda_core.physics.compiled.shear import CELL_VARIANCE


@vector_helper
def _cell_powers(a, b, wn, grid, cells):
    """Return the power of film shear by sliding and by spin and that of the asperities, over a b."""
    inverse, vt, vs, fluid, solid = (cells[X_INVERSE], cells[X_VT], cells[X_VS], cells[X_TAU0], cells[X_MU])
    across, along, area = grid[GRID_S], grid[GRID_T], grid[GRID_AREA]
    width_s, width_t = grid[GRID_DS], grid[GRID_DT]
    slide, spin, boundary = 0.0, 0.0, 0.0
    for i in range(vt.size):
        v2 = (vt[i] * vt[i] + vs[i] * vs[i]) * area[i] * inverse[i]
        s, t, ds, dt = a * across[i], b * along[i], a * width_s[i], b * width_t[i]
        turning = wn * wn * (s * s + t * t + CELL_VARIANCE * (ds * ds + dt * dt))
        rest_t, rest_s = vt[i] + wn * s, vs[i] - wn * t
        share = turning / (turning + rest_t * rest_t + rest_s * rest_s + 1e-30)
        spin += fluid[i] * v2 * share
        slide += fluid[i] * v2 * (1.0 - share)
        boundary += solid[i] * v2
    return slide, spin, boundary


@helper
def raceway_losses(which, q, system, grid, scalars, cells, losses):
    """Add the power that this contact dissipates, by mechanism [W]; call after raceway_wrench.

    Power of the film's shear in a cell is split between sliding and spin in proportion
    to the squares of the two velocity fields, so that both are non-negative.
    """
    if scalars[C_WET] == 0.0:
        return
    a, b = scalars[C_A], scalars[C_B]
    slide, spin, boundary = _cell_powers(a, b, q[Q_WN], grid, cells)
    roll, bend = rolling_speeds(which, q, system)
    floor = system.roll_floor
    losses[L_SLIDE + which] += a * b * slide
    losses[L_SPIN + which] += a * b * spin
    losses[L_BOUNDARY + which] += a * b * boundary
    losses[L_ROLL + which] += 2.0 * scalars[C_ROLL] * roll * roll / math.sqrt(roll * roll + floor * floor)
    turn = bend / system.radius_x[which]
    losses[L_HYST + which] += scalars[C_HYST] * turn * bend / math.sqrt(bend * bend + floor * floor)
    losses[L_DAMP + which] += scalars[C_DAMP] * q[Q_VN]
