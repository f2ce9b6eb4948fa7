"""Compute the power that a contact dissipates, by mechanism."""

from __future__ import annotations

import math

from lambda_core.solver.contact.resultant import rolling_speeds
from lambda_core.solver.contact.shear import CELL_VARIANCE
from lambda_core.solver.layout import helper, vector_helper


@vector_helper
def _cell_powers(a, b, wn, grid, cells):
    """Return the powers over a b.

    They are those of film shear by sliding and by spin, and of the asperities.
    """
    inverse, vt, vs, fluid, solid = cells.inverse_slip, cells.slip_t, cells.slip_s, cells.shear_inlet, cells.friction
    across, along, area = grid.across, grid.along, grid.area
    width_s, width_t = grid.width_across, grid.width_along
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
def raceway_losses(raceway, kin, system, grid, contact, cells, losses):
    """Add the power that this contact dissipates.

    It goes to layout.Losses [W]; call this after raceway_wrench.

    Power of the film's shear in a cell is split between sliding and spin in proportion
    to the squares of the two velocity fields, so that both are non-negative.
    """
    k = raceway.number
    losses.damping[k] += contact.damping_force * kin.normal_velocity
    if contact.wet == 0:
        return
    a, b = contact.semi_axis_a, contact.semi_axis_b
    slide, spin, boundary = _cell_powers(a, b, kin.rotation_n, grid, cells)
    roll, bend = rolling_speeds(raceway, kin)
    floor = system.roll_floor
    losses.sliding[k] += a * b * slide
    losses.spin[k] += a * b * spin
    losses.boundary[k] += a * b * boundary
    losses.rolling[k] += 2.0 * contact.rolling_force * roll * roll / math.sqrt(roll * roll + floor * floor)
    turn = bend / raceway.radius_x
    losses.hysteresis[k] += contact.hysteresis_moment * turn * bend / math.sqrt(bend * bend + floor * floor)
