"""Slip and shear stress in the cells of a raceway contact."""

from __future__ import annotations

import math

import numpy as np

from lambda_core.physics.compiled.faults import report
from lambda_core.physics.compiled.layout import (
    C_A,
    C_B,
    C_CHANGE,
    C_HCEN,
    C_PMAX,
    C_PSI,
    C_TMEAN,
    C_UMEAN,
    GRID_AREA,
    GRID_DS,
    GRID_DT,
    GRID_P,
    GRID_S,
    GRID_T,
    Q_VS,
    Q_VT,
    Q_WN,
    Q_WS,
    Q_WT,
    R_BOUNDARY,
    R_RHEOLOGY,
    R_TEMPERATURE,
    R_TRACTION,
    RACEWAY_KERNELS,
    X_INVERSE,
    X_LN,
    X_LN0,
    X_MU,
    X_P,
    X_RESULTS,
    X_RHO,
    X_SLIP,
    X_T,
    X_T1,
    X_TAU,
    X_TAU0,
    X_VS,
    X_VT,
    helper,
    par_of,
    rows_helper,
    vector_helper,
)
from lambda_core.physics.compiled.scalar_stages import finite

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
        v = math.sqrt(floor + CELL_VARIANCE * (slope_t * slope_t + slope_s * slope_s + turn * turn) + t * t + r * r)
        vt[i], vs[i], slip[i], inverse[i] = t, r, v, 1.0 / v


@helper
def slip_field(which, q, system, grid, scalars, cells):
    """Slip of every cell with the spread of slip inside the cell, and its pressure."""
    _slip_rows(
        scalars[C_A], scalars[C_B], scalars[C_PMAX], q[Q_VT], q[Q_VS], q[Q_WT], q[Q_WS], q[Q_WN],
        1.0 / system.radius_deformed[which], system.slip_floor * system.slip_floor,
        grid[GRID_S], grid[GRID_T], grid[GRID_DS], grid[GRID_DT], grid[GRID_P],
        cells[X_P], cells[X_VT], cells[X_VS], cells[X_SLIP], cells[X_INVERSE],
    )  # fmt: skip


@rows_helper
def _close_loop(psi, inlet, area, p, tau0, tau, hot, mu, scalars):
    """Close the loop of temperature and traction and add the asperities.

    tau between its values at the inlet's and at the hot temperature: shear stress linear in temperature, temperature
    rise linear in shear stress. tau0 and mu become the shares of film and asperities in the shear stress, tau the sum.
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
        tau0[i] = (1.0 - psi) * film
        mu[i] = psi * mu[i] * p[i]
        tau[i] = tau0[i] + mu[i]
    scalars[C_CHANGE] = abs(first - second) / (first + 1e-30)
    scalars[C_TMEAN] = heat / math.pi


@vector_helper
def _finite_rows(a, b, c, d, e, f):
    """Return whether six rows are finite."""
    total = 0.0
    for i in range(a.size):
        total += abs(a[i]) + abs(b[i]) + abs(c[i]) + abs(d[i]) + abs(e[i]) + abs(f[i])
    return total < np.inf


@helper
def _shear_fault(which, system, scalars, cells, fault):
    """Report the first kernel of shear_stage, in the order of their calls, whose result is not finite."""
    slip, p, hot = cells[X_SLIP], cells[X_P], cells[X_T1]
    pmax, h = scalars[C_PMAX], scalars[C_HCEN]
    if not finite(cells[X_LN0]):
        return report(fault, R_RHEOLOGY, 1, which, pmax, system.oil_temperature, 0.0, 0.0)
    if not finite(cells[X_TAU0]):
        return report(fault, R_TRACTION, 1, which, pmax, h, slip[0], cells[X_LN0, 0])
    if not finite(hot):
        return report(fault, R_TEMPERATURE, 1, which, scalars[C_UMEAN], h, scalars[C_B], cells[X_TAU0, 0])
    if not finite(cells[X_LN]):
        return report(fault, R_RHEOLOGY, 1, which, pmax, hot[0], 0.0, 0.0)
    if not finite(cells[X_TAU]):
        return report(fault, R_TRACTION, 1, which, pmax, h, slip[0], cells[X_LN, 0])
    return report(fault, R_BOUNDARY, 1, which, slip[0], p[0], 0.0, 0.0)


@helper
def shear_stage(which, laws, par, system, grid, scalars, cells, fault):
    """Shear stress of film and asperities in every cell.

    Temperature and traction form a loop (T -> eta -> tau -> T). Two sweeps: at the inlet temperature,
    and at the temperature that this shear would cause; between them the shear stress is
    taken as linear in temperature, which closes the loop. The relative change of
    the mean shear stress from the second sweep to the result is kept in scalars[C_CHANGE].

    Each kernel writes into a row of its own, filled with NaN before; all rows are looked at together after the last.
    """
    slip, p, temp, rho = cells[X_SLIP], cells[X_P], cells[X_T], cells[X_RHO]
    cold, ln_eta = cells[X_LN0], cells[X_LN]
    tau, tau0, hot, mu = cells[X_TAU], cells[X_TAU0], cells[X_T1], cells[X_MU]
    h, b, u, inlet = scalars[C_HCEN], scalars[C_B], scalars[C_UMEAN], system.oil_temperature
    first = RACEWAY_KERNELS * which
    cells[:X_RESULTS, :] = np.nan
    temp[:] = inlet
    oil, shear = par_of(par, system, first + R_RHEOLOGY), par_of(par, system, first + R_TRACTION)
    status = laws.rheology(p, temp, oil, cold, rho)
    if status != 1:
        return report(fault, R_RHEOLOGY, status, which, scalars[C_PMAX], inlet, 0.0, 0.0)
    status = laws.traction(slip, p, temp, cold, h, shear, tau0)
    if status != 1:
        return report(fault, R_TRACTION, status, which, scalars[C_PMAX], h, slip[0], cold[0])
    status = laws.contact_temperature(inlet, u, h, b, tau0, slip, par_of(par, system, first + R_TEMPERATURE), hot)
    if status != 1:
        return report(fault, R_TEMPERATURE, status, which, u, h, b, tau0[0])
    status = laws.rheology(p, hot, oil, ln_eta, rho)
    if status != 1:
        return report(fault, R_RHEOLOGY, status, which, scalars[C_PMAX], hot[0], 0.0, 0.0)
    status = laws.traction(slip, p, hot, ln_eta, h, shear, tau)
    if status != 1:
        return report(fault, R_TRACTION, status, which, scalars[C_PMAX], h, slip[0], ln_eta[0])
    status = laws.boundary_friction(slip, p, par_of(par, system, first + R_BOUNDARY), mu)
    if status != 1:
        return report(fault, R_BOUNDARY, status, which, slip[0], p[0], 0.0, 0.0)
    if not _finite_rows(cold, tau0, hot, ln_eta, tau, mu):
        return _shear_fault(which, system, scalars, cells, fault)
    _close_loop(scalars[C_PSI], inlet, grid[GRID_AREA], p, tau0, tau, hot, mu, scalars)
    return 1
