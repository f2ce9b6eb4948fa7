"""Compute the capacitance of loaded contacts and open gaps."""

from __future__ import annotations

import numpy as np

from lambda_core.formulas.gap_capacitance import VACUUM_PERMITTIVITY, gap_capacitance
from lambda_core.solver.arrays.fault_roles import CAPACITANCE, PERMITTIVITY
from lambda_core.solver.contact.contact_kinematics import contact_wrench
from lambda_core.solver.faults import report
from lambda_core.solver.layout import cells_of, helper, part
from lambda_core.solver.records import LINE

_gap_capacitance = helper(gap_capacitance)


@helper
def bulk_permittivity(raceway, laws, bundle):
    """Return the oil's relative permittivity without pressure.

    It holds at the oil's temperature.
    """
    par, where, cells = bundle.par, raceway.parameters, cells_of(bundle.cells, 0, 1, bundle.grid.shape[1])
    p, temp, rho, eps = cells.pressure[:1], cells.temperature[:1], cells.density[:1], cells.friction[:1]
    p[0], temp[0] = 0.0, raceway.oil.temperature
    laws.rheology(p, temp, part(par, where.rheology), cells.ln_eta[:1], rho)
    laws.permittivity(p, temp, rho, part(par, where.permittivity), eps)
    return eps[0]


@helper
def contact_capacitance(raceway, kin, laws, bundle, grid, cells, shorted, touching, sample):
    """Write the capacitances of a contact [F].

    One is that of the Hertzian area. The other is that of the contact, which is at least that of two that touch.

    `grid` and `cells` are those of the contact in scratch: an ellipse's, or the slices of a line.
    """
    scratch, par, where = bundle.scratch[0], bundle.par, raceway.parameters
    contact, out, oil = scratch.contact[0], scratch.out[:], raceway.oil
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
    across = raceway.radius_y if raceway.kind == LINE else rx  # W = F/(E' R_x L) of a line, F/(E' R_x^2) of a point
    u = oil.viscosity * abs(kin.entrainment_t) / (e * rx)
    out[0] = np.nan
    status = laws.capacitance(
        hertz, h, a, b, rx, raceway.radius_y, u, oil.alpha_p * e, load / (e * rx * across), bulk,
        part(par, where.capacitance), out,
    )  # fmt: skip
    if status != 1 or not abs(out[0]) < np.inf:
        return report(scratch.fault, CAPACITANCE, status, ring, hertz, h, a, b)
    sample.capacitance_hertz = hertz
    touches = contact.film_parameter < shorted and contact.asperity_share > 0.0
    sample.capacitance = np.inf if touches else max(out[0], touching)
    return 1


@helper
def touching_film(raceway, kin, bundle):
    """Return the film [m] at first touch.

    It is the central film of entrained oil where ball and raceway just touch, or -1.

    Hertz's contact and with it the law of the film end where the approach is that of the surfaces' roughness: the film
    there stands for all lighter contacts. Writes over the contact in scratch.
    """
    contact, penetration, velocity = bundle.scratch[0].contact[0], kin.penetration, kin.normal_velocity
    kin.penetration, kin.normal_velocity = raceway.roughness, 0.0
    found = contact_wrench(raceway, 0, bundle)
    film = contact.film_central
    kin.penetration, kin.normal_velocity = penetration, velocity
    return film if found == 1 else -1.0


@helper
def open_capacitance(raceway, gap, bulk):
    """Return the capacitance [F] of an open contact.

    Ball and raceway are at a distance [m], which is at least their roughness.
    """
    distance = max(gap, raceway.roughness)
    return bulk * _gap_capacitance(distance, raceway.radius_x, raceway.radius_y, raceway.ball_radius)
