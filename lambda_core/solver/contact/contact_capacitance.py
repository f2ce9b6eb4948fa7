"""Capacitance of loaded contacts and of open gaps."""

from __future__ import annotations

import math

import numpy as np

from lambda_core.solver.arrays.fault_roles import CAPACITANCE, PERMITTIVITY
from lambda_core.solver.faults import report
from lambda_core.solver.layout import cells_of, grid_of, helper, part

VACUUM_PERMITTIVITY = 8.8541878128e-12  # [F/m], CODATA 2018


@helper
def bulk_permittivity(raceway, laws, bundle):
    """Return the relative permittivity of the oil at no pressure and the oil's temperature."""
    par, where, cells = bundle.par, raceway.parameters, cells_of(bundle.cells[0])
    p, temp, rho, eps = cells.pressure[:1], cells.temperature[:1], cells.density[:1], cells.friction[:1]
    p[0], temp[0] = 0.0, raceway.oil.temperature
    laws.rheology(p, temp, part(par, where.rheology), cells.ln_eta[:1], rho)
    laws.permittivity(p, temp, rho, part(par, where.permittivity), eps)
    return eps[0]


@helper
def contact_capacitance(raceway, kin, laws, bundle, shorted, sample):
    """Write the capacitance of the Hertzian area and of the contact [F]."""
    scratch, par, where = bundle.scratch[0], bundle.par, raceway.parameters
    contact, cells, grid, out, oil = (
        scratch.contact[0],
        cells_of(bundle.cells[0]),
        grid_of(bundle.grid),
        scratch.out[:],
        raceway.oil,
    )
    temp, p, eps, rho = cells.temperature, cells.pressure, cells.friction, cells.density
    h, ring = contact.film_central, raceway.number
    temp[:] = oil.temperature
    eps[:] = np.nan
    status = laws.rheology(p, temp, part(par, where.rheology), cells.ln_eta, rho)
    if status == 1:
        status = laws.permittivity(p, temp, rho, part(par, where.permittivity), eps)
    total = 0.0
    for i in range(eps.size):
        total += eps[i] * grid.area[i]
    if status != 1 or not abs(total) < np.inf:
        return report(scratch.fault, PERMITTIVITY, status, ring, p[0], temp[0], rho[0], 0.0)
    a, b, load = contact.semi_axis_a, contact.semi_axis_b, contact.load
    hertz = VACUUM_PERMITTIVITY * total * a * b / h
    bulk = bulk_permittivity(raceway, laws, bundle)
    rx, e = raceway.radius_x, raceway.modulus
    u = oil.viscosity * abs(kin.entrainment_t) / (e * rx)
    out[0] = np.nan
    status = laws.capacitance(
        hertz, h, a, b, rx, raceway.radius_y, u, oil.alpha_p * e, load / (e * rx * rx), bulk,
        part(par, where.capacitance), out,
    )  # fmt: skip
    if status != 1 or not abs(out[0]) < np.inf:
        return report(scratch.fault, CAPACITANCE, status, ring, hertz, h, a, b)
    sample.capacitance_hertz = hertz
    touches = contact.film_parameter < shorted and contact.asperity_share > 0.0
    sample.capacitance = np.inf if touches else out[0]
    return 1


@helper
def gap_capacitance(raceway, gap):
    """Return the capacitance [F] of a ball and a raceway that stand `gap` [m] apart, in vacuum.

    Plates in each element (Derjaguin 1934): dA/(h + x^2/(2 R_x) + y^2/(2 R_y)) over the ball's projection, in closed
    form 4 pi sqrt(R_x R_y) ln{[sqrt(h_x/R_y) + sqrt(h_y/R_x)]/[sqrt(h/R_y) + sqrt(h/R_x)]}, h_x = h + R_b^2/(2 R_x).
    The edge is that of the law `gap-integral`, which this meets at vanishing load. Surfaces are no closer than their
    roughness.
    """
    h, s = max(gap, raceway.roughness), raceway.ball_radius * raceway.ball_radius
    rx, ry = raceway.radius_x, raceway.radius_y
    edge = math.sqrt((h + 0.5 * s / rx) / ry) + math.sqrt((h + 0.5 * s / ry) / rx)
    middle = math.sqrt(h / ry) + math.sqrt(h / rx)
    return VACUUM_PERMITTIVITY * 4.0 * math.pi * math.sqrt(rx * ry) * math.log(edge / middle)
