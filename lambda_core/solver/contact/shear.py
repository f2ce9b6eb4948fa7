"""Compute slip and shear stress in contact cells."""

from __future__ import annotations

import math

import numpy as np

from lambda_core.solver.arrays.bundle import RESULTS
from lambda_core.solver.arrays.fault_roles import BOUNDARY_FRICTION, CONTACT_TEMPERATURE, OUTSIDE, RHEOLOGY, TRACTION
from lambda_core.solver.contact.scalar_stages import finite
from lambda_core.solver.faults import report
from lambda_core.solver.layout import cells_of, helper, of, part, rows_helper, vector_helper
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
    """Write slip and pressure of every cell.

    The spread of slip inside the cell is added.
    """
    _slip_rows(
        contact.semi_axis_a, contact.semi_axis_b, contact.max_pressure, kin.slip_t, kin.slip_s,
        kin.rotation_t, kin.rotation_s, kin.rotation_n,
        1.0 / raceway.radius_deformed, system.slip_floor * system.slip_floor,
        grid.across, grid.along, grid.width_across, grid.width_along, grid.pressure,
        cells.pressure, cells.slip_t, cells.slip_s, cells.slip, cells.inverse_slip,
    )  # fmt: skip


@rows_helper
def _close_loop(film_stress, solid_stress, inlet, area, p, tau0, tau, hot, mu):
    """Close the temperature-traction loop with asperities.

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
def _shear_fault(raceway, first, cells, scratch):
    """Report the first non-finite kernel of shear_stage.

    The kernels have the order of their calls.
    """
    slip, p, hot, ring, fault = cells.slip, cells.pressure, cells.temperature, raceway.number, scratch.fault
    contact = scratch.contact[first]
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
def _begin(block, end):
    """Fill the laws' rows with NaN.

    The places behind them are filled, too; the density is written over and over.
    """
    for row in range(RESULTS):
        for i in range(end + 1):
            block[row, i] = np.nan
    block[RESULTS, end] = 0.0


@helper
def _outside(raceway, first, block, end, scratch):
    """Report the first law beyond its output.

    It wrote behind the end, in the order of their calls; return whether there is one.
    """
    roles = (RHEOLOGY, TRACTION, CONTACT_TEMPERATURE, RHEOLOGY, TRACTION, BOUNDARY_FRICTION)
    found = block[RESULTS, end] != 0.0
    for row in range(len(roles)):
        found = found or block[row, end] == block[row, end]
    if not found:
        return False
    role = RHEOLOGY
    for row in range(len(roles)):
        if block[row, end] == block[row, end]:
            role = roles[row]
            break
    contact = scratch.contact[first]
    report(
        scratch.fault, role, OUTSIDE, raceway.number,
        contact.max_pressure, contact.film_central, contact.entrainment, contact.film_parameter,
    )  # fmt: skip
    return True


@helper
def _sweeps(raceway, first, count, laws, par, cells, scratch):
    """Call the shear laws for all cells.

    They concern the film's shear and the asperities' friction of contacts; return 0 on a fault.
    """
    slip, p, temp, rho, film = cells.slip, cells.pressure, cells.inlet, cells.density, cells.film
    cold, ln_eta = cells.ln_eta_inlet, cells.ln_eta
    tau, tau0, hot, mu = cells.shear, cells.shear_inlet, cells.temperature, cells.friction
    lanes, fault, inlet, ring, where = (
        scratch.lanes, scratch.fault, raceway.oil.temperature, raceway.number, raceway.parameters
    )  # fmt: skip
    u, pmax, h, b = lanes.u_mean[first], lanes.p_max[first], lanes.h[first], lanes.semi_b[first]
    oil, shear = part(par, where.rheology), part(par, where.traction)
    status = laws.rheology(p, temp, oil, cold, rho)
    if status != 1:
        return report(fault, RHEOLOGY, status, ring, pmax, inlet, 0.0, 0.0)
    status = laws.traction(slip, p, temp, cold, film, shear, tau0)
    if status != 1:
        return report(fault, TRACTION, status, ring, pmax, h, slip[0], cold[0])
    status = laws.contact_temperature(
        inlet, of(lanes.u_mean, first, count), of(lanes.h, first, count), of(lanes.semi_b, first, count), tau0, slip,
        part(par, where.contact_temperature), hot,
    )  # fmt: skip
    if status != 1:
        return report(fault, CONTACT_TEMPERATURE, status, ring, u, h, b, tau0[0])
    status = laws.rheology(p, hot, oil, ln_eta, rho)
    if status != 1:
        return report(fault, RHEOLOGY, status, ring, pmax, hot[0], 0.0, 0.0)
    status = laws.traction(slip, p, hot, ln_eta, film, shear, tau)
    if status != 1:
        return report(fault, TRACTION, status, ring, pmax, h, slip[0], ln_eta[0])
    status = laws.boundary_friction(slip, p, of(lanes.u_mean, first, count), part(par, where.boundary_friction), mu)
    if status != 1:
        return report(fault, BOUNDARY_FRICTION, status, ring, slip[0], p[0], 0.0, 0.0)
    return 1


@helper
def shear_stage(raceway, first, count, laws, par, grid, block, scratch):
    """Write the shear stress of every cell.

    It is that of film and asperities, for contacts of which contact `first` has the first cells.

    Temperature and traction form a loop (T -> eta -> tau -> T). Two sweeps: at the inlet temperature,
    and at the temperature that this shear would cause; between them the shear stress is
    taken as linear in temperature, which closes the loop. The relative change of
    the mean shear stress from the second sweep to the result is kept in contact.shear_change.

    Each kernel writes into a row of its own, filled with NaN before; all rows are looked at together after the last,
    and so is what stands behind each, which has to be NaN still.
    """
    width, inlet = grid.area.size, raceway.oil.temperature
    cells = cells_of(block, 0, count, width)
    _begin(block, count * width)
    temp, film = cells.inlet, cells.film
    for k in range(count):
        h = scratch.lanes.h[first + k]
        for i in range(k * width, (k + 1) * width):
            temp[i], film[i] = inlet, h
    if _sweeps(raceway, first, count, laws, par, cells, scratch) != 1:
        return 0
    if not _finite_rows(
        cells.ln_eta_inlet, cells.shear_inlet, cells.temperature, cells.ln_eta, cells.shear, cells.friction
    ):
        return _shear_fault(raceway, first, cells, scratch)
    if _outside(raceway, first, block, count * width, scratch):
        return 0
    for k in range(count):
        contact, its = scratch.contact[first + k], cells_of(block, k, 1, width)
        mean, second, heat = _close_loop(
            contact.film_stress, contact.solid_stress, inlet, grid.area, its.pressure, its.shear_inlet, its.shear,
            its.temperature, its.friction,
        )  # fmt: skip
        contact.shear_change = abs(mean - second) / (mean + 1e-30)
        contact.film_temperature = heat / math.pi
    return 1
