"""Evaluate laws without cells.

They give load, damping, film and rolling losses.

A law is called once for all contacts from place `first` on, `count` of them, which lie in scratch. It takes what it
needs from scratch.lanes and leaves its results in scratch.out, STRIDE numbers apart.
"""

from __future__ import annotations

import math

import numpy as np

from lambda_core.laws.jit.binding import STRIDE
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
from lambda_core.solver.layout import helper, of, part, vector_helper

_VECTOR = 8  # contacts that compiled laws take at once


@vector_helper
def finite(values):
    total = 0.0
    for i in range(values.size):
        total += abs(values[i])
    return total < np.inf


@vector_helper
def _well(out, n, results):
    """Return whether the first results of n contacts are finite."""
    total = 0.0
    for k in range(n):
        for i in range(results):
            total += abs(out[STRIDE * k + i])
    return total < np.inf


@helper
def _blank(out, n, results):
    """Fill first results of contacts with NaN.

    Laws that leave one of the n contacts out are then seen.
    """
    for k in range(n):
        for i in range(results):
            out[STRIDE * k + i] = np.nan


@helper
def _full(count):
    """Return the contacts per call of a law.

    Half a vector and more costs what a full one does.
    """
    rest = count % _VECTOR
    return count + _VECTOR - rest if 2 * rest >= _VECTOR else count


@helper
def _repeat(lane, first, count, n):
    """Fill a lane up with copies of its first number."""
    for k in range(first + count, first + n):
        lane[k] = lane[first]


@helper
def _motion(first, count, n, scratch):
    """Write penetrations and speeds of contacts into lanes.

    The speeds are the normal velocity and the mean speed of both surfaces.
    """
    lanes = scratch.lanes
    for k in range(first, first + count):
        kin = scratch.kinematics[k]
        lanes.delta[k], lanes.velocity[k] = kin.penetration, kin.normal_velocity
        lanes.u_mean[k] = math.sqrt(kin.entrainment_t * kin.entrainment_t + kin.entrainment_s * kin.entrainment_s)
    _repeat(lanes.delta, first, count, n)
    _repeat(lanes.velocity, first, count, n)
    _repeat(lanes.u_mean, first, count, n)


@helper
def _loads(raceway, first, count, n, laws, par, scratch):
    """Call the law of the load.

    It is called for contacts that are closed as the first one is; return 0 on a fault.
    """
    lanes, out, ring = scratch.lanes, scratch.out[:], raceway.number
    rx, ry, e = raceway.radius_x, raceway.radius_y, raceway.modulus
    if scratch.kinematics[first].penetration > 0.0:
        _blank(out, n, 4)
        status = laws.normal_contact(
            of(lanes.delta, first, n), rx, ry, e, part(par, raceway.parameters.normal_contact), of(out, 0, STRIDE * n)
        )
        if status != 1 or not _well(out, n, 4):
            return report(scratch.fault, NORMAL_CONTACT, status, ring, lanes.delta[first], rx, ry, e)
    else:
        for i in range(STRIDE * n):
            out[i] = 0.0
    for k in range(n):
        i = STRIDE * k
        lanes.load[first + k], lanes.semi_a[first + k] = out[i], out[i + 1]
        lanes.semi_b[first + k], lanes.p_max[first + k] = out[i + 2], out[i + 3]
    for k in range(first, first + count):
        contact = scratch.contact[k]
        contact.load, contact.semi_axis_a, contact.semi_axis_b = lanes.load[k], lanes.semi_a[k], lanes.semi_b[k]
        contact.max_pressure, contact.wet = lanes.p_max[k], 0
    return 1


@helper
def _damping(raceway, first, count, n, laws, par, scratch):
    """Write damping forces of contacts.

    The contacts fill their lanes; return 0 on a fault.
    """
    lanes, out, oil = scratch.lanes, scratch.out[:], raceway.oil
    rx, ry, e = raceway.radius_x, raceway.radius_y, raceway.modulus
    _blank(out, n, 1)
    status = laws.damping(
        of(lanes.delta, first, n), of(lanes.velocity, first, n), of(lanes.load, first, n), of(lanes.u_mean, first, n),
        of(lanes.semi_a, first, n), of(lanes.semi_b, first, n), rx, ry, e, oil.viscosity, oil.alpha_p,
        part(par, raceway.parameters.damping), of(out, 0, STRIDE * n),
    )  # fmt: skip
    if status != 1 or not _well(out, n, 1):
        return report(
            scratch.fault, DAMPING, status, raceway.number,
            lanes.delta[first], lanes.velocity[first], lanes.load[first], 0.0,
        )  # fmt: skip
    for k in range(count):
        # A contact never pulls: the damping force cannot exceed the elastic one.
        scratch.contact[first + k].damping_force = max(out[STRIDE * k], -lanes.load[first + k])
    return 1


@helper
def normal_stage(raceway, first, count, laws, par, system, scratch):
    """Write elastic load, ellipse and damping force."""
    n = _full(count)
    _motion(first, count, n, scratch)
    if _loads(raceway, first, count, n, laws, par, scratch) != 1:
        return 0
    if system.guides_on == 0:  # quasi-static: nothing moves along the normal
        for k in range(first, first + count):
            scratch.contact[k].damping_force = 0.0
        return 1
    return _damping(raceway, first, count, n, laws, par, scratch)


@helper
def line_damping(raceway, place, laws, par, scratch):
    """Write the damping force of a line.

    Its loads are those of its slices; return 0 on a fault.
    """
    lanes, contact = scratch.lanes, scratch.contact[place]
    _motion(place, 1, 1, scratch)
    lanes.load[place], lanes.semi_a[place], lanes.semi_b[place] = contact.load, contact.semi_axis_a, contact.semi_axis_b
    return _damping(raceway, place, 1, 1, laws, par, scratch)


@helper
def _rolling(first, count, n, scratch):
    """Write the film stages' inputs into lanes.

    They are loads and motion.
    """
    lanes = scratch.lanes
    for k in range(first, first + count):
        kin, contact = scratch.kinematics[k], scratch.contact[k]
        ut, us = kin.entrainment_t, kin.entrainment_s
        square = ut * ut + us * us
        lanes.u_mean[k], lanes.cos2[k] = math.sqrt(square), ut * ut / square if square > 0.0 else 1.0
        lanes.u_slide[k] = math.sqrt(kin.slip_t * kin.slip_t + kin.slip_s * kin.slip_s)
        lanes.load[k], lanes.semi_a[k], lanes.semi_b[k] = contact.load, contact.semi_axis_a, contact.semi_axis_b
        lanes.p_max[k] = contact.max_pressure
    _repeat(lanes.u_mean, first, count, n)
    _repeat(lanes.cos2, first, count, n)
    _repeat(lanes.u_slide, first, count, n)
    _repeat(lanes.load, first, count, n)
    _repeat(lanes.semi_a, first, count, n)
    _repeat(lanes.semi_b, first, count, n)
    _repeat(lanes.p_max, first, count, n)


@helper
def _films(raceway, first, count, n, laws, par, scratch):
    """Write films.

    Isothermal, as heat in the inlet and missing oil leave them; 0 on a fault.
    """
    ring, where, oil = raceway.number, raceway.parameters, raceway.oil
    lanes, out, fault = scratch.lanes, scratch.out[:], scratch.fault
    rx, ry, e = raceway.radius_x, raceway.radius_y, raceway.modulus
    eta0, alpha, beta, k_oil = oil.viscosity, oil.alpha_p, oil.beta, oil.conductivity
    u, load, results = of(lanes.u_mean, first, n), of(lanes.load, first, n), of(out, 0, STRIDE * n)
    _blank(out, n, 2)
    status = laws.film_thickness(
        u, of(lanes.cos2, first, n), load, rx, ry, e, eta0, alpha, part(par, where.film_thickness), results
    )
    if status != 1 or not _well(out, n, 2):
        return report(
            fault, FILM_THICKNESS, status, ring, lanes.u_mean[first], lanes.cos2[first], lanes.load[first], eta0
        )
    for k in range(n):
        lanes.h_cen[first + k], lanes.h_min[first + k] = out[STRIDE * k], out[STRIDE * k + 1]
    _blank(out, n, 1)
    status = laws.thermal_correction(
        u, of(lanes.u_slide, first, n), of(lanes.p_max, first, n), e, eta0, beta, k_oil,
        part(par, where.thermal_correction), results,
    )  # fmt: skip
    if status != 1 or not _well(out, n, 1):
        return report(
            fault, THERMAL_CORRECTION, status, ring,
            lanes.u_mean[first], lanes.u_slide[first], lanes.p_max[first], eta0,
        )  # fmt: skip
    for k in range(count):
        scratch.contact[first + k].film_isothermal = lanes.h_cen[first + k]
    for k in range(n):
        heated = out[STRIDE * k]
        lanes.h_cen[first + k] *= heated
        lanes.h_min[first + k] *= heated
    _blank(out, n, 2)
    status = laws.supply(
        u, load, of(lanes.semi_a, first, n), of(lanes.semi_b, first, n), rx, of(lanes.h_cen, first, n),
        of(lanes.h_min, first, n), part(par, where.supply), results,
    )  # fmt: skip
    if status != 1 or not _well(out, n, 2):
        return report(
            fault, SUPPLY, status, ring, lanes.u_mean[first], lanes.load[first], lanes.h_cen[first], lanes.h_min[first]
        )
    for k in range(n):
        lanes.h[first + k] = lanes.h_cen[first + k] * out[STRIDE * k]
        lanes.film_parameter[first + k] = lanes.h[first + k] / raceway.roughness
    for k in range(count):
        contact = scratch.contact[first + k]
        contact.film_central, contact.film_parameter = lanes.h[first + k], lanes.film_parameter[first + k]
        contact.film_minimum = lanes.h_min[first + k] * out[STRIDE * k]
        contact.rolling_force = out[STRIDE * k + 1]  # the share that is left of it
    return 1


@helper
def _asperities(raceway, first, count, n, laws, par, scratch):
    """Write the shares of asperities and film.

    They are shares in the load and in the shear stress; return 0 on a fault.
    """
    ring, where = raceway.number, raceway.parameters
    lanes, out, fault = scratch.lanes, scratch.out[:], scratch.fault
    ratio, results = of(lanes.film_parameter, first, n), of(out, 0, STRIDE * n)
    _blank(out, n, 1)
    status = laws.asperity_load(ratio, part(par, where.asperity_load), results)
    if status != 1 or not _well(out, n, 1):
        return report(
            fault, ASPERITY_LOAD, status, ring, lanes.film_parameter[first], lanes.load[first], 0.0, 0.0
        )  # fmt: skip
    for k in range(n):
        lanes.psi[first + k] = out[STRIDE * k]
    _blank(out, n, 2)
    status = laws.mixing(
        of(lanes.psi, first, n), ratio, of(lanes.load, first, n), of(lanes.p_max, first, n),
        of(lanes.semi_a, first, n), of(lanes.semi_b, first, n), part(par, where.mixing), results,
    )  # fmt: skip
    if status != 1 or not _well(out, n, 2):
        return report(
            fault, MIXING, status, ring,
            lanes.psi[first], lanes.film_parameter[first], lanes.load[first], lanes.p_max[first],
        )  # fmt: skip
    for k in range(count):
        contact = scratch.contact[first + k]
        contact.asperity_share = lanes.psi[first + k]
        contact.film_stress, contact.solid_stress = out[STRIDE * k], out[STRIDE * k + 1]
    return 1


@helper
def rolling_forces(raceway, first, n, laws, par, scratch):
    """Write rolling resistance into scratch.out; 0 on a fault."""
    oil, lanes, out = raceway.oil, scratch.lanes, scratch.out[:]
    _blank(out, n, 1)
    status = laws.rolling_resistance(
        of(lanes.u_mean, first, n), of(lanes.load, first, n), of(lanes.semi_a, first, n), of(lanes.semi_b, first, n),
        raceway.radius_x, raceway.radius_y, raceway.modulus, oil.viscosity, oil.alpha_p, oil.beta, oil.conductivity,
        part(par, raceway.parameters.rolling_resistance), of(out, 0, STRIDE * n),
    )  # fmt: skip
    if status != 1 or not _well(out, n, 1):
        return report(
            scratch.fault, ROLLING_RESISTANCE, status, raceway.number,
            lanes.u_mean[first], lanes.load[first], lanes.semi_a[first], lanes.semi_b[first],
        )  # fmt: skip
    return 1


@helper
def _hysteresis(raceway, first, count, n, laws, par, scratch):
    """Write losses in the solids; 0 on a fault."""
    lanes, out = scratch.lanes, scratch.out[:]
    _blank(out, n, 1)
    status = laws.elastic_hysteresis(
        of(lanes.load, first, n), of(lanes.semi_a, first, n), of(lanes.semi_b, first, n),
        raceway.radius_x, raceway.radius_y, raceway.ball_radius,
        part(par, raceway.parameters.elastic_hysteresis), of(out, 0, STRIDE * n),
    )  # fmt: skip
    if status != 1 or not _well(out, n, 1):
        return report(
            scratch.fault, ELASTIC_HYSTERESIS, status, raceway.number,
            lanes.load[first], lanes.semi_a[first], lanes.semi_b[first], raceway.radius_x,
        )  # fmt: skip
    for k in range(count):
        contact = scratch.contact[first + k]
        contact.hysteresis_moment, contact.entrainment, contact.wet = out[STRIDE * k], lanes.u_mean[first + k], 1
    return 1


@helper
def film_stage(raceway, first, count, laws, par, scratch):
    """Compute film, asperity share and losses in the solids.

    The rolling force of contacts is the share of it that heat and supply leave; return 0 on a fault.
    """
    n = _full(count)
    _rolling(first, count, n, scratch)
    if _films(raceway, first, count, n, laws, par, scratch) != 1:
        return 0
    if _asperities(raceway, first, count, n, laws, par, scratch) != 1:
        return 0
    return _hysteresis(raceway, first, count, n, laws, par, scratch)


@helper
def rolling_stage(raceway, first, count, laws, par, scratch):
    """Multiply the rolling force of points.

    Call it after film_stage; return 0 on a fault.
    """
    n = _full(count)
    if rolling_forces(raceway, first, n, laws, par, scratch) != 1:
        return 0
    for k in range(count):
        scratch.contact[first + k].rolling_force *= scratch.out[STRIDE * k]
    return 1
