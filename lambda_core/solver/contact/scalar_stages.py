"""Stages of a raceway contact whose laws are scalar: load, damping, film, rolling losses."""

from __future__ import annotations

import math

import numpy as np

from lambda_core.solver.arrays.fault_roles import (
    ASPERITY_LOAD,
    DAMPING,
    ELASTIC_HYSTERESIS,
    FILM_THICKNESS,
    MIXING,
    NORMAL_CONTACT,
    ROLLING_RESISTANCE,
    SUPPLY,
    THERMAL_CORRECTION,
)
from lambda_core.solver.faults import report
from lambda_core.solver.layout import helper, part, vector_helper


@vector_helper
def finite(values):
    total = 0.0
    for i in range(values.size):
        total += abs(values[i])
    return total < np.inf


@helper
def damping_force(raceway, kin, velocity, laws, par, contact, out):
    """Call the damping law of a contact at a penetration velocity: out[0]; returns its status."""
    oil, rx, ry, e = raceway.oil, raceway.radius_x, raceway.radius_y, raceway.modulus
    u = math.sqrt(kin.entrainment_t * kin.entrainment_t + kin.entrainment_s * kin.entrainment_s)
    return laws.damping(
        kin.penetration, velocity, contact.load, u, contact.semi_axis_a, contact.semi_axis_b, rx, ry, e,
        oil.viscosity, oil.alpha_p, part(par, raceway.parameters.damping), out,
    )  # fmt: skip


@helper
def normal_stage(raceway, kin, laws, par, system, contact, out, fault):
    """Elastic load, contact ellipse and damping force."""
    delta, ring, where = kin.penetration, raceway.number, raceway.parameters
    rx, ry, e = raceway.radius_x, raceway.radius_y, raceway.modulus
    out[:4] = 0.0
    if delta > 0.0:
        out[:4] = np.nan
        status = laws.normal_contact(delta, rx, ry, e, part(par, where.normal_contact), out)
        if status != 1 or not finite(out[:4]):
            return report(fault, NORMAL_CONTACT, status, ring, delta, rx, ry, e)
    load = out[0]
    contact.load, contact.semi_axis_a, contact.semi_axis_b, contact.max_pressure = load, out[1], out[2], out[3]
    if system.guides_on == 0:  # quasi-static: nothing moves along the normal
        contact.damping_force = 0.0
        return 1
    out[0] = np.nan
    status = damping_force(raceway, kin, kin.normal_velocity, laws, par, contact, out)
    if status != 1 or not abs(out[0]) < np.inf:
        return report(fault, DAMPING, status, ring, delta, kin.normal_velocity, load, 0.0)
    # A contact never pulls: the damping force cannot exceed the elastic one.
    contact.damping_force = max(out[0], -load)
    return 1


@helper
def film_stage(raceway, kin, laws, par, contact, out, fault):
    """Film thickness, asperity share, rolling resistance and hysteresis (scalar laws)."""
    ring, where, oil = raceway.number, raceway.parameters, raceway.oil
    load, a, b, pmax = contact.load, contact.semi_axis_a, contact.semi_axis_b, contact.max_pressure
    rx, ry, e = raceway.radius_x, raceway.radius_y, raceway.modulus
    eta0, alpha, beta, k_oil = oil.viscosity, oil.alpha_p, oil.beta, oil.conductivity
    ut, us = kin.entrainment_t, kin.entrainment_s
    u = math.sqrt(ut * ut + us * us)
    theta = math.atan2(abs(us), abs(ut)) if u > 0.0 else 0.0
    contact.entrainment = u
    out[:2] = np.nan
    status = laws.film_thickness(u, theta, load, rx, ry, e, eta0, alpha, part(par, where.film_thickness), out)
    if status != 1 or not finite(out[:2]):
        return report(fault, FILM_THICKNESS, status, ring, u, theta, load, eta0)
    h_cen, h_min = out[0], out[1]
    slide = math.sqrt(kin.slip_t**2 + kin.slip_s**2)
    out[0] = np.nan
    status = laws.thermal_correction(u, slide, pmax, e, eta0, beta, k_oil, part(par, where.thermal_correction), out)
    if status != 1 or not abs(out[0]) < np.inf:
        return report(fault, THERMAL_CORRECTION, status, ring, u, slide, pmax, eta0)
    heated = out[0]
    out[:2] = np.nan
    status = laws.supply(u, load, a, b, rx, h_cen * heated, h_min * heated, part(par, where.supply), out)
    if status != 1 or not finite(out[:2]):
        return report(fault, SUPPLY, status, ring, u, load, h_cen, heated)
    factor, inlet = heated * out[0], out[1]
    contact.film_isothermal = h_cen
    contact.film_central = h_cen * factor
    contact.film_minimum = h_min * factor
    contact.film_parameter = contact.film_central / raceway.roughness
    out[0] = np.nan
    status = laws.asperity_load(contact.film_parameter, part(par, where.asperity_load), out)
    if status != 1 or not abs(out[0]) < np.inf:
        return report(fault, ASPERITY_LOAD, status, ring, contact.film_parameter, load, 0.0, 0.0)
    contact.asperity_share = psi = out[0]
    out[:2] = np.nan
    status = laws.mixing(psi, contact.film_parameter, load, contact.max_pressure, a, b, part(par, where.mixing), out)
    if status != 1 or not abs(out[0]) + abs(out[1]) < np.inf:
        return report(fault, MIXING, status, ring, psi, contact.film_parameter, load, contact.max_pressure)
    contact.film_stress, contact.solid_stress = out[0], out[1]
    out[0] = np.nan
    status = laws.rolling_resistance(
        u, load, a, b, rx, ry, e, eta0, alpha, beta, k_oil, part(par, where.rolling_resistance), out
    )
    if status != 1 or not abs(out[0]) < np.inf:
        return report(fault, ROLLING_RESISTANCE, status, ring, u, load, a, b)
    contact.rolling_force = inlet * out[0]
    out[0] = np.nan
    status = laws.elastic_hysteresis(load, a, b, rx, ry, raceway.ball_radius, part(par, where.elastic_hysteresis), out)
    if status != 1 or not abs(out[0]) < np.inf:
        return report(fault, ELASTIC_HYSTERESIS, status, ring, load, a, b, rx)
    contact.hysteresis_moment = out[0]
    contact.wet = 1
    return 1
