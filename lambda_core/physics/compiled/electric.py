"""Capacitance of loaded contacts and of open gaps."""

from __future__ import annotations

import math

import numpy as np

from lambda_core.physics.compiled.faults import report
from lambda_core.physics.compiled.layout import (
    C_A,
    C_B,
    C_HCEN,
    C_LOAD,
    C_PSI,
    FAULT,
    GRID_AREA,
    OUT,
    Q_UT,
    R_CAPACITANCE,
    R_PERMITTIVITY,
    R_RHEOLOGY,
    RACEWAY_KERNELS,
    SCALARS,
    X_LN,
    X_MU,
    X_P,
    X_RHO,
    X_T1,
    helper,
    par_of,
)

VACUUM_PERMITTIVITY = 8.8541878128e-12  # [F/m], CODATA 2018


@helper
def bulk_permittivity(which, laws, bundle):
    """Return the relative permittivity of the oil at no pressure and the oil's temperature."""
    system, par, cells = bundle.system[0], bundle.par, bundle.cells[0]
    p, temp, rho, eps = cells[X_P][:1], cells[X_T1][:1], cells[X_RHO][:1], cells[X_MU][:1]
    p[0], temp[0] = 0.0, system.oil_temperature
    laws.rheology(p, temp, par_of(par, system, RACEWAY_KERNELS * which + R_RHEOLOGY), cells[X_LN][:1], rho)
    laws.permittivity(p, temp, rho, par_of(par, system, RACEWAY_KERNELS * which + R_PERMITTIVITY), eps)
    return eps[0]


@helper
def contact_capacitance(which, q, laws, bundle, shorted, channels):
    """Write the capacitance of the Hertzian area and of the contact [F]."""
    scratch = bundle.scratch
    system, par, grid = bundle.system[0], bundle.par, bundle.grid
    scalars, cells, out = scratch[SCALARS], bundle.cells[0], scratch[OUT]
    temp, p, eps, rho = cells[X_T1], cells[X_P], cells[X_MU], cells[X_RHO]
    h = scalars[C_HCEN]
    temp[:] = system.oil_temperature
    eps[:] = np.nan
    status = laws.rheology(p, temp, par_of(par, system, RACEWAY_KERNELS * which + R_RHEOLOGY), cells[X_LN], rho)
    if status == 1:
        status = laws.permittivity(p, temp, rho, par_of(par, system, RACEWAY_KERNELS * which + R_PERMITTIVITY), eps)
    total = 0.0
    for i in range(eps.size):
        total += eps[i] * grid[GRID_AREA, i]
    if status != 1 or not abs(total) < np.inf:
        return report(scratch[FAULT], R_PERMITTIVITY, status, which, p[0], temp[0], rho[0], 0.0)
    a, b, load = scalars[C_A], scalars[C_B], scalars[C_LOAD]
    hertz = VACUUM_PERMITTIVITY * total * a * b / h
    bulk = bulk_permittivity(which, laws, bundle)
    rx, e = system.radius_x[which], system.e_eff[which]
    u = system.eta0 * abs(q[Q_UT]) / (e * rx)
    out[0] = np.nan
    status = laws.capacitance(
        hertz, h, a, b, rx, system.radius_y[which], u, system.alpha_p * e, load / (e * rx * rx), bulk,
        par_of(par, system, RACEWAY_KERNELS * which + R_CAPACITANCE), out,
    )  # fmt: skip
    if status != 1 or not abs(out[0]) < np.inf:
        return report(scratch[FAULT], R_CAPACITANCE, status, which, hertz, h, a, b)
    channels[13] = hertz
    channels[14] = np.inf if scalars[C_PSI] > shorted else out[0]
    return 1


@helper
def gap_capacitance(system, which, gap):
    """Return the capacitance [F] of a ball and a raceway that stand `gap` [m] apart, in vacuum.

    Plates in each element (Derjaguin 1934): dA/(h + x^2/(2 R_x) + y^2/(2 R_y)) over the ball's projection, in closed
    form 4 pi sqrt(R_x R_y) ln{[sqrt(h_x/R_y) + sqrt(h_y/R_x)]/[sqrt(h/R_y) + sqrt(h/R_x)]}, h_x = h + R_b^2/(2 R_x).
    The edge is that of the law `gap-integral`, which this meets at vanishing load. Surfaces are no closer than their
    roughness.
    """
    h, s = max(gap, system.roughness), system.ball_radius * system.ball_radius
    rx, ry = system.radius_x[which], system.radius_y[which]
    edge = math.sqrt((h + 0.5 * s / rx) / ry) + math.sqrt((h + 0.5 * s / ry) / rx)
    middle = math.sqrt(h / ry) + math.sqrt(h / rx)
    return VACUUM_PERMITTIVITY * 4.0 * math.pi * math.sqrt(rx * ry) * math.log(edge / middle)
