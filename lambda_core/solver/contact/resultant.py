"""Sum forces and couples of a raceway contact."""

from __future__ import annotations

import math

from lambda_core.solver.layout import helper, vector_helper
from lambda_core.solver.vec import scale, store


@vector_helper
def _sum_cells(half_curvature, a, b, grid, cells):
    """Return the shear's resultant on the ball.

    It is over a b: forces along t and s, and couples about t, s, n.
    """
    tau, inverse, vt, vs = cells.shear, cells.inverse_slip, cells.slip_t, cells.slip_s
    across, along, area = grid.across, grid.along, grid.area
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
    return ft, fs, mt, ms, mn


@helper
def sum_wrench(raceway, kin, system, grid, contact, cells, wrench):
    """Return the wrench on the ball.

    It is the integral of the shear over the ellipse, with the scalar laws.
    """
    a, b = contact.semi_axis_a, contact.semi_axis_b
    ft, fs, mt, ms, mn = _sum_cells(0.5 / raceway.radius_deformed, a, b, grid, cells)
    store(wrench.force, (ft * (a * b), fs * (a * b), -(contact.load + contact.damping_force)))
    store(wrench.moment, scale(a * b, (mt, ms, mn)))
    add_rolling(raceway, kin, system, contact, wrench)


@helper
def rolling_speeds(raceway, kin):
    """Return the dissipating speeds of rolling losses [m/s].

    They are those of rolling resistance and hysteresis.

    In pure rolling both are the mean surface velocity; defined by the work of their forces so that
    each loss is non-negative whatever the slip.
    """
    rx = raceway.radius_x
    roll = rx * kin.rotation_s - (rx / raceway.ball_radius - 0.5) * kin.slip_t
    return roll, rx * kin.rotation_s


@helper
def add_rolling(raceway, kin, system, contact, wrench):
    """Add rolling resistance and hysteresis.

    With force F of the inlet on each surface: F (2 R_x/R_b - 1) along rolling on the ball, the opposite on
    the ring, and a couple 2 F R_x against the relative rolling; loss 2 F u. Hysteresis is a pure couple.
    """
    rx = raceway.radius_x
    roll, bend = rolling_speeds(raceway, kin)
    floor = system.roll_floor
    sign = roll / math.sqrt(roll * roll + floor * floor)
    force = contact.rolling_force * sign
    wrench.force[0] += force * (2.0 * rx / raceway.ball_radius - 1.0)
    wrench.moment[1] -= 2.0 * force * rx
    wrench.moment[1] -= contact.hysteresis_moment * bend / math.sqrt(bend * bend + floor * floor)
