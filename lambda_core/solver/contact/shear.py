"""Slip and shear stress in the cells of a raceway contact."""

from __future__ import annotations

import math

import numpy as np

from lambda_core.solver.arrays.fault_roles import BOUNDARY_FRICTION, CONTACT_TEMPERATURE, OUTSIDE, RHEOLOGY, TRACTION
from lambda_core.solver.contact.scalar_stages import finite
from lambda_core.solver.faults import report
from lambda_core.solver.layout import helper, part, rows_helper, vector_helper
from lambda_core.solver.vec import inverse_root

# Variance of a uniform distribution over a cell of unit width: the slip's own spread in a cell.
CELL_VARIANCE = 1.0 / 12.0


@rows_helper
def _slip_rows(
    a, b, pmax, vt0, vs0, wt, ws, wn, curvature, floor, across, along, width_s, width_t, share, p, vt, vs, slip, inverse
):
    """Write pressure and slip of every cell; see slip_field."""
    for i in range(p.size):
        p[i] = pmax * share[i]
        s = a * across[i]
        kink = s * curvature
        t, r = vt0 - s * (wn + 0.5 * ws * kink), vs0 + wn * b * along[i] + 0.5 * wt * s * kink
        # Variance of the slip inside a cell, from its slopes across and along.
        slope_t, slope_s = a * width_s[i] * (wn + ws * kink), a * width_s[i] * wt * kink
        turn = b * width_t[i] * wn
        square = floor + CELL_VARIANCE * (slope_t * slope_t + slope_s * slope_s + turn * turn) + t * t + r * r
        per_v = inverse_root(square)
        vt[i], vs[i], slip[i], inverse[i] = t, r, square * per_v, per_v


@helper
def slip_field(raceway, kin, system, grid, contact, cells):
    """Slip of every cell with the spread of slip inside the cell, and its pressure."""
    _slip_rows(
        contact.semi_axis_a, contact.semi_axis_b, contact.max_pressure, kin.slip_t, kin.slip_s,
        kin.rotation_t, kin.rotation_s, kin.rotation_n,
        1.0 / raceway.radius_deformed, system.slip_floor * system.slip_floor,
        grid.across, grid.along, grid.width_across, grid.width_along, grid.pressure,
        cells.pressure, cells.slip_t, cells.slip_s, cells.slip, cells.inverse_slip,
    )  # fmt: skip


@rows_helper
def _close_loop(film_stress, solid_stress, inlet, area, p, tau0, tau, hot, mu):
    """Close the loop of temperature and traction and add the asperities.

    tau between its values at the inlet's and at the hot temperature: shear stress linear in temperature, temperature
    rise linear in shear stress. tau0 and mu become the shares of film and asperities in the shear stress, tau the sum.
    Returns the integrals of the film's stress, of that before, and of the temperature over the unit ellipse.
    """
    first, second, heat = 0.0, 0.0, 0.0
    for i in range(tau.size):
        cold = tau0[i] + 1e-30
        share = cold / max(2.0 * cold - tau[i], 1e-3 * cold)
        film, rise = cold * share, inlet + (hot[i] - inlet) * share
        second += tau[i] * area[i]
        first += film * area[i]
        heat += rise * area[i]
        hot[i] = rise
        tau0[i] = film_stress * film
        mu[i] = solid_stress * mu[i] * p[i]
        tau[i] = tau0[i] + mu[i]
    return first, second, heat


@vector_helper
def _finite_rows(a, b, c, d, e, f):
    """Return whether six rows are finite."""
    total = 0.0
    for i in range(a.size):
        total += abs(a[i]) + abs(b[i]) + abs(c[i]) + abs(d[i]) + abs(e[i]) + abs(f[i])
    return total < np.inf


@helper
def _shear_fault(raceway, contact, cells, fault):
    """Report the first kernel of shear_stage, in the order of their calls, whose result is not finite."""
    slip, p, hot, ring = cells.slip, cells.pressure, cells.temperature, raceway.number
    pmax, h = contact.max_pressure, contact.film_central
    if not finite(cells.ln_eta_inlet):
        return report(fault, RHEOLOGY, 1, ring, pmax, raceway.oil.temperature, 0.0, 0.0)
    if not finite(cells.shear_inlet):
        return report(fault, TRACTION, 1, ring, pmax, h, slip[0], cells.ln_eta_inlet[0])
    if not finite(hot):
        return report(
            fault, CONTACT_TEMPERATURE, 1, ring, contact.entrainment, h, contact.semi_axis_b, cells.shear_inlet[0]
        )
    if not finite(cells.ln_eta):
        return report(fault, RHEOLOGY, 1, ring, pmax, hot[0], 0.0, 0.0)
    if not finite(cells.shear):
        return report(fault, TRACTION, 1, ring, pmax, h, slip[0], cells.ln_eta[0])
    return report(fault, BOUNDARY_FRICTION, 1, ring, slip[0], p[0], 0.0, 0.0)


@helper
def _outside(raceway, contact, cells, fault):
    """Report the first law, in the order of their calls, that wrote behind the end of its output; returns whether."""
    guard, roles = cells.guard, (RHEOLOGY, TRACTION, CONTACT_TEMPERATURE, RHEOLOGY, TRACTION, BOUNDARY_FRICTION)
    found = guard[len(roles), 0] != 0.0  # of the density, which is written over and over: never NaN
    for row in range(len(roles)):
        found = found or guard[row, 0] == guard[row, 0]
    if not found:
        return False
    role = RHEOLOGY
    for row in range(len(roles)):
        if guard[row, 0] == guard[row, 0]:
            role = roles[row]
            break
    guard[len(roles), 0] = 0.0
    report(
        fault, role, OUTSIDE, raceway.number,
        contact.max_pressure, contact.film_central, contact.entrainment, contact.film_parameter,
    )  # fmt: skip
    return True


@helper
def shear_stage(raceway, laws, par, grid, contact, cells, fault):
    """Shear stress of film and asperities in every cell.

    Temperature and traction form a loop (T -> eta -> tau -> T). Two sweeps: at the inlet temperature,
    and at the temperature that this shear would cause; between them the shear stress is
    taken as linear in temperature, which closes the loop. The relative change of
    the mean shear stress from the second sweep to the result is kept in contact.shear_change.

    Each kernel writes into a row of its own, filled with NaN before; all rows are looked at together after the last,
    and so is the guard behind each, which has to be NaN still.
    """
    slip, p, temp, rho = cells.slip, cells.pressure, cells.inlet, cells.density
    cold, ln_eta = cells.ln_eta_inlet, cells.ln_eta
    tau, tau0, hot, mu = cells.shear, cells.shear_inlet, cells.temperature, cells.friction
    h, b, u, inlet = contact.film_central, contact.semi_axis_b, contact.entrainment, raceway.oil.temperature
    ring, where = raceway.number, raceway.parameters
    cells.results[:, :] = np.nan
    temp[:] = inlet
    oil, shear = part(par, where.rheology), part(par, where.traction)
    status = laws.rheology(p, temp, oil, cold, rho)
    if status != 1:
        return report(fault, RHEOLOGY, status, ring, contact.max_pressure, inlet, 0.0, 0.0)
    status = laws.traction(slip, p, temp, cold, h, shear, tau0)
    if status != 1:
        return report(fault, TRACTION, status, ring, contact.max_pressure, h, slip[0], cold[0])
    status = laws.contact_temperature(inlet, u, h, b, tau0, slip, part(par, where.contact_temperature), hot)
    if status != 1:
        return report(fault, CONTACT_TEMPERATURE, status, ring, u, h, b, tau0[0])
    status = laws.rheology(p, hot, oil, ln_eta, rho)
    if status != 1:
        return report(fault, RHEOLOGY, status, ring, contact.max_pressure, hot[0], 0.0, 0.0)
    status = laws.traction(slip, p, hot, ln_eta, h, shear, tau)
    if status != 1:
        return report(fault, TRACTION, status, ring, contact.max_pressure, h, slip[0], ln_eta[0])
    status = laws.boundary_friction(slip, p, u, part(par, where.boundary_friction), mu)
    if status != 1:
        return report(fault, BOUNDARY_FRICTION, status, ring, slip[0], p[0], 0.0, 0.0)
    if not _finite_rows(cold, tau0, hot, ln_eta, tau, mu):
        return _shear_fault(raceway, contact, cells, fault)
    if _outside(raceway, contact, cells, fault):
        return 0
    first, second, heat = _close_loop(
        contact.film_stress, contact.solid_stress, inlet, grid.area, p, tau0, tau, hot, mu
    )
    contact.shear_change = abs(first - second) / (first + 1e-30)
    contact.film_temperature = heat / math.pi
    return 1
