"""Resultant of a raceway contact: forces and couples of shear, load and rolling losses on the ball."""

from __future__ import annotations

import math

from lambda_core.physics.compiled.layout import (
    C_A,
    C_B,
    C_DAMP,
    C_HYST,
    C_LOAD,
    C_ROLL,
    GRID_AREA,
    GRID_S,
    GRID_T,
    NW,
    Q_VT,
    Q_WS,
    X_INVERSE,
    X_TAU,
    X_VS,
    X_VT,
    helper,
    vector_helper,
)


@vector_helper
def _sum_cells(half_curvature, a, b, grid, cells, wrench):
    """Write the resultant of the shear on the ball over a b: forces, couples."""
    tau, inverse, vt, vs = cells[X_TAU], cells[X_INVERSE], cells[X_VT], cells[X_VS]
    across, along, area = grid[GRID_S], grid[GRID_T], grid[GRID_AREA]
    ft, fs, mt, ms, mn = 0.0, 0.0, 0.0, 0.0, 0.0
    for i in range(tau.size):
        g = tau[i] * area[i] * inverse[i]
        dt, ds = -g * vt[i], -g * vs[i]
        s, t = a * across[i], b * along[i]
        z = half_curvature * s * s
        ft += dt
        fs += ds
        ms -= z * dt
        mt += z * ds
        mn += t * ds - s * dt
    wrench[0], wrench[1], wrench[3], wrench[4], wrench[5] = ft, fs, mt, ms, mn


@helper
def sum_wrench(which, q, system, grid, scalars, cells, wrench):
    """Integrate the shear over the ellipse and add the scalar laws: wrench on the ball."""
    a, b = scalars[C_A], scalars[C_B]
    _sum_cells(0.5 / system.radius_deformed[which], a, b, grid, cells, wrench)
    for i in range(NW):
        wrench[i] *= a * b
    wrench[2] = -(scalars[C_LOAD] + scalars[C_DAMP])
    add_rolling(which, q, system, scalars, wrench)


@helper
def rolling_speeds(which, q, system):
    """Return the speeds that rolling resistance and hysteresis dissipate with [m/s].

    In pure rolling both are the mean surface velocity; defined by the work of their forces so that
    each loss is non-negative whatever the slip.
    """
    rx = system.radius_x[which]
    roll = rx * q[Q_WS] - (rx / system.ball_radius - 0.5) * q[Q_VT]
    return roll, rx * q[Q_WS]


@helper
def add_rolling(which, q, system, scalars, wrench):
    """Add rolling resistance and hysteresis.

    With force F of the inlet on each surface: F (2 R_x/R_b - 1) along rolling on the ball, the opposite on
    the ring, and a couple 2 F R_x against the relative rolling; loss 2 F u. Hysteresis is a pure couple.
    """
    rx = system.radius_x[which]
    roll, bend = rolling_speeds(which, q, system)
    floor = system.roll_floor
    sign = roll / math.sqrt(roll * roll + floor * floor)
    force = scalars[C_ROLL] * sign
    wrench[0] += force * (2.0 * rx / system.ball_radius - 1.0)
    wrench[4] -= 2.0 * force * rx
    wrench[4] -= scalars[C_HYST] * bend / math.sqrt(bend * bend + floor * floor)
