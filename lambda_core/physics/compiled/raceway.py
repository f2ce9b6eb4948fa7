"""The contact pipeline of one ball-raceway contact: from kinematics q to the wrench on the ball.

Stages, each a kernel of the model: normal force, damping, film with thermal correction, asperity
share, shear in every cell (rheology, traction, temperature), rolling resistance, hysteresis.
"""

from __future__ import annotations

import math

import numpy as np

from lambda_core.physics.compiled.layout import (
    C_A,
    C_B,
    C_CHANGE,
    C_DAMP,
    C_HCEN,
    C_HISO,
    C_HMIN,
    C_HYST,
    C_LAMBDA,
    C_LOAD,
    C_PMAX,
    C_PSI,
    C_ROLL,
    C_TMEAN,
    C_UMEAN,
    C_WET,
    FAULT,
    GRID_AREA,
    GRID_DS,
    GRID_DT,
    GRID_P,
    GRID_S,
    GRID_T,
    L_BOUNDARY,
    L_DAMP,
    L_HYST,
    L_ROLL,
    L_SLIDE,
    L_SPIN,
    NW,
    OUT,
    Q_DELTA,
    Q_UT,
    Q_VN,
    Q_VS,
    Q_VT,
    Q_WN,
    Q_WS,
    Q_WT,
    R_ASPERITY,
    R_BOUNDARY,
    R_DAMPING,
    R_FILM,
    R_HYSTERESIS,
    R_NORMAL,
    R_RHEOLOGY,
    R_ROLLING,
    R_TEMPERATURE,
    R_THERMAL,
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
    vector_helper,
)

# Variance of a uniform distribution over a cell of unit width: the slip's own spread in a cell.
_CELL_VARIANCE = 1.0 / 12.0


@helper
def report(fault, role, status, which, i0, i1, i2, i3):
    """Record the first fault of an evaluation: role, the kernel's status, ring, inputs."""
    if fault[0] < 0.0:
        fault[0] = role
        fault[1] = status
        fault[3] = which
        fault[4], fault[5], fault[6], fault[7] = i0, i1, i2, i3
    return 0


@vector_helper
def _finite(values):
    total = 0.0
    for i in range(values.size):
        total += abs(values[i])
    return total < np.inf


@helper
def normal_stage(which, q, laws, par, system, scalars, out, fault):
    """Elastic load, contact ellipse and damping force."""
    delta = q[Q_DELTA]
    rx, ry, e = system.radius_x[which], system.radius_y[which], system.e_eff[which]
    out[:4] = np.nan
    status = laws.normal_contact(delta, rx, ry, e, par_of(par, system, RACEWAY_KERNELS * which + R_NORMAL), out)
    if status != 1 or not _finite(out[:4]):
        return report(fault, R_NORMAL, status, which, delta, rx, ry, e)
    load, a, b, pmax = out[0], out[1], out[2], out[3]
    scalars[C_LOAD], scalars[C_A], scalars[C_B], scalars[C_PMAX] = load, a, b, pmax
    if system.guides_on == 0:  # quasi-static: nothing moves along the normal
        scalars[C_DAMP] = 0.0
        return 1
    out[0] = np.nan
    status = laws.damping(
        delta,
        q[Q_VN],
        load,
        par_of(par, system, RACEWAY_KERNELS * which + R_DAMPING),
        out,
    )
    if status != 1 or not abs(out[0]) < np.inf:
        return report(fault, R_DAMPING, status, which, delta, q[Q_VN], load, 0.0)
    # A contact never pulls: the damping force cannot exceed the elastic one.
    scalars[C_DAMP] = max(out[0], -load)
    return 1


@helper
def film_stage(which, q, laws, par, system, scalars, out, fault):
    """Film thickness, asperity share, rolling resistance and hysteresis (scalar laws)."""
    load, a, b, pmax = scalars[C_LOAD], scalars[C_A], scalars[C_B], scalars[C_PMAX]
    rx, ry, e = system.radius_x[which], system.radius_y[which], system.e_eff[which]
    eta0, alpha, beta, k_oil = system.eta0, system.alpha_p, system.beta, system.k_oil
    ut, us = q[Q_UT], q[Q_UT + 1]
    u = math.sqrt(ut * ut + us * us)
    theta = math.atan2(abs(us), abs(ut)) if u > 0.0 else 0.0
    scalars[C_UMEAN] = u
    out[:2] = np.nan
    status = laws.film_thickness(
        u,
        theta,
        load,
        rx,
        ry,
        e,
        eta0,
        alpha,
        par_of(par, system, RACEWAY_KERNELS * which + R_FILM),
        out,
    )
    if status != 1 or not _finite(out[:2]):
        return report(fault, R_FILM, status, which, u, theta, load, eta0)
    h_cen, h_min = out[0], out[1]
    slide = math.sqrt(q[Q_VT] ** 2 + q[Q_VS] ** 2)
    out[0] = np.nan
    status = laws.thermal_correction(
        u,
        slide,
        pmax,
        e,
        eta0,
        beta,
        k_oil,
        par_of(par, system, RACEWAY_KERNELS * which + R_THERMAL),
        out,
    )
    if status != 1 or not abs(out[0]) < np.inf:
        return report(fault, R_THERMAL, status, which, u, slide, pmax, eta0)
    factor = out[0] * system.starvation
    scalars[C_HISO] = h_cen
    scalars[C_HCEN] = h_cen * factor
    scalars[C_HMIN] = h_min * factor
    scalars[C_LAMBDA] = scalars[C_HCEN] / system.roughness
    out[0] = np.nan
    status = laws.asperity_load(
        scalars[C_LAMBDA],
        par_of(par, system, RACEWAY_KERNELS * which + R_ASPERITY),
        out,
    )
    if status != 1 or not abs(out[0]) < np.inf:
        return report(fault, R_ASPERITY, status, which, scalars[C_LAMBDA], load, 0.0, 0.0)
    scalars[C_PSI] = out[0]
    out[0] = np.nan
    status = laws.rolling_resistance(
        u,
        load,
        a,
        b,
        rx,
        ry,
        e,
        eta0,
        alpha,
        beta,
        k_oil,
        par_of(par, system, RACEWAY_KERNELS * which + R_ROLLING),
        out,
    )
    if status != 1 or not abs(out[0]) < np.inf:
        return report(fault, R_ROLLING, status, which, u, load, a, b)
    scalars[C_ROLL] = out[0]
    out[0] = np.nan
    status = laws.elastic_hysteresis(
        load,
        a,
        b,
        rx,
        ry,
        system.ball_radius,
        par_of(par, system, RACEWAY_KERNELS * which + R_HYSTERESIS),
        out,
    )
    if status != 1 or not abs(out[0]) < np.inf:
        return report(fault, R_HYSTERESIS, status, which, load, a, b, rx)
    scalars[C_HYST] = out[0]
    scalars[C_WET] = 1.0
    return 1


@vector_helper
def slip_field(which, q, system, grid, scalars, cells):
    """Slip of every cell with the spread of slip inside the cell, and its pressure.

    Several short loops: the compiler vectorises a loop only while it can tell its few arrays apart.
    """
    a, b, pmax = scalars[C_A], scalars[C_B], scalars[C_PMAX]
    vt0, vs0 = q[Q_VT], q[Q_VS]
    wt, ws, wn = q[Q_WT], q[Q_WS], q[Q_WN]
    curvature = 1.0 / system.radius_deformed[which]
    floor = system.slip_floor * system.slip_floor
    slip, p, vt, vs = cells[X_SLIP], cells[X_P], cells[X_VT], cells[X_VS]
    across, along, width_s, width_t = (
        grid[GRID_S],
        grid[GRID_T],
        grid[GRID_DS],
        grid[GRID_DT],
    )
    share = grid[GRID_P]
    n = slip.size
    for i in range(n):
        p[i] = pmax * share[i]
    for i in range(n):
        s = a * across[i]
        vt[i] = vt0 - s * (wn + 0.5 * ws * s * curvature)
    for i in range(n):
        s = a * across[i]
        vs[i] = vs0 + wn * b * along[i] + 0.5 * wt * s * s * curvature
    # Variance of the slip inside a cell, from its slopes across and along.
    for i in range(n):
        kink = a * across[i] * curvature
        slope_t, slope_s = a * width_s[i] * (wn + ws * kink), a * width_s[i] * wt * kink
        turn = b * width_t[i] * wn
        slip[i] = floor + _CELL_VARIANCE * (slope_t * slope_t + slope_s * slope_s + turn * turn)
    for i in range(n):
        slip[i] = math.sqrt(slip[i] + vt[i] * vt[i] + vs[i] * vs[i])
    inverse = cells[X_INVERSE]
    for i in range(n):
        inverse[i] = 1.0 / slip[i]


@vector_helper
def _close_loop(tau0, tau, hot, area, inlet, scalars):
    """Close the loop of temperature and traction: tau between its values at the inlet's and at the hot temperature.

    Shear stress linear in temperature, temperature rise linear in shear stress.
    """
    first, second, heat = 0.0, 0.0, 0.0
    for i in range(tau.size):
        second += tau[i] * area[i]
    for i in range(tau.size):
        cold = tau0[i] + 1e-30
        share = cold / max(2.0 * cold - tau[i], 1e-3 * cold)
        hot[i] = inlet + (hot[i] - inlet) * share
        heat += hot[i] * area[i]
        tau[i] = cold * share
        first += tau[i] * area[i]
    scalars[C_CHANGE] = abs(first - second) / (first + 1e-30)
    scalars[C_TMEAN] = heat / math.pi


@vector_helper
def _mix(psi, tau, tau0, mu, p):
    """Add film and asperities: tau0 and mu become their shares of the shear stress, tau the sum."""
    for i in range(tau.size):
        tau0[i] = (1.0 - psi) * tau[i]
        mu[i] = psi * mu[i] * p[i]
        tau[i] = tau0[i] + mu[i]


@vector_helper
def _finite_rows(block):
    """Return whether the results of all kernels of a contact are finite; their rows begin the block."""
    total = 0.0
    for row in range(X_RESULTS):
        for i in range(block.shape[1]):
            total += abs(block[row, i])
    return total < np.inf


@helper
def _shear_fault(which, system, scalars, cells, fault):
    """Report the first kernel of shear_stage, in the order of their calls, whose result is not finite."""
    slip, p, hot = cells[X_SLIP], cells[X_P], cells[X_T1]
    pmax, h = scalars[C_PMAX], scalars[C_HCEN]
    if not _finite(cells[X_LN0]):
        return report(fault, R_RHEOLOGY, 1, which, pmax, system.oil_temperature, 0.0, 0.0)
    if not _finite(cells[X_TAU0]):
        return report(fault, R_TRACTION, 1, which, pmax, h, slip[0], cells[X_LN0, 0])
    if not _finite(hot):
        return report(fault, R_TEMPERATURE, 1, which, scalars[C_UMEAN], h, scalars[C_B], cells[X_TAU0, 0])
    if not _finite(cells[X_LN]):
        return report(fault, R_RHEOLOGY, 1, which, pmax, hot[0], 0.0, 0.0)
    if not _finite(cells[X_TAU]):
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
    if not _finite_rows(cells):
        return _shear_fault(which, system, scalars, cells, fault)
    _close_loop(tau0, tau, hot, grid[GRID_AREA], inlet, scalars)
    _mix(scalars[C_PSI], tau, tau0, mu, p)
    return 1


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


def raceway_wrench(which, q, laws, par, systems, grid, cells, scratch, scalars, wrench):
    """Run the whole pipeline of one contact; an entry point of its own, called by pointer.

    Parameters
    ----------
    which : int
        INNER or OUTER.
    q : float64[:], at least (9,)
        Kinematics of the contact.
    laws, par, systems, grid, cells, scratch
        See layout.Bundle; `cells` is one of its two blocks.
    scalars : float64[:]
        Result: scalars of the contact (layout.C_LOAD ...).
    wrench : float64[:]
        Result: force and couple on the ball at the contact's centre, axes t, s, n.

    Returns
    -------
    int
        1 when every kernel was well; otherwise 0 and scratch[FAULT] says which was not.
    """
    system, out, fault = systems[0], scratch[OUT], scratch[FAULT]
    if normal_stage(which, q, laws, par, system, scalars, out, fault) != 1:
        return 0
    if system.friction_on == 0:
        wrench[:NW] = 0.0
        wrench[2] = -(scalars[C_LOAD] + scalars[C_DAMP])
        return 1
    if film_stage(which, q, laws, par, system, scalars, out, fault) != 1:
        return 0
    slip_field(which, q, system, grid, scalars, cells)
    if shear_stage(which, laws, par, system, grid, scalars, cells, fault) != 1:
        return 0
    sum_wrench(which, q, system, grid, scalars, cells, wrench)
    return 1


pipeline = helper(raceway_wrench)


@vector_helper
def _cell_powers(a, b, wn, grid, cells):
    """Return the power of film shear by sliding and by spin and that of the asperities, over a b."""
    inverse, vt, vs, fluid, solid = (
        cells[X_INVERSE],
        cells[X_VT],
        cells[X_VS],
        cells[X_TAU0],
        cells[X_MU],
    )
    across, along, area = grid[GRID_S], grid[GRID_T], grid[GRID_AREA]
    width_s, width_t = grid[GRID_DS], grid[GRID_DT]
    slide, spin, boundary = 0.0, 0.0, 0.0
    for i in range(vt.size):
        v2 = (vt[i] * vt[i] + vs[i] * vs[i]) * area[i] * inverse[i]
        s, t, ds, dt = a * across[i], b * along[i], a * width_s[i], b * width_t[i]
        turning = wn * wn * (s * s + t * t + _CELL_VARIANCE * (ds * ds + dt * dt))
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
