"""Stages of a raceway contact whose laws are scalar: load, damping, film, rolling losses."""

from __future__ import annotations

import math

import numpy as np

from lambda_core.physics.compiled.faults import report
from lambda_core.physics.compiled.layout import (
    C_A,
    C_B,
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
    C_UMEAN,
    C_WET,
    Q_DELTA,
    Q_UT,
    Q_VN,
    Q_VS,
    Q_VT,
    R_ASPERITY,
    R_DAMPING,
    R_FILM,
    R_HYSTERESIS,
    R_NORMAL,
    R_ROLLING,
    R_THERMAL,
    RACEWAY_KERNELS,
    helper,
    par_of,
    vector_helper,
)


@vector_helper
def finite(values):
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
    if status != 1 or not finite(out[:4]):
        return report(fault, R_NORMAL, status, which, delta, rx, ry, e)
    load, a, b, pmax = out[0], out[1], out[2], out[3]
    scalars[C_LOAD], scalars[C_A], scalars[C_B], scalars[C_PMAX] = load, a, b, pmax
    if system.guides_on == 0:  # quasi-static: nothing moves along the normal
        scalars[C_DAMP] = 0.0
        return 1
    out[0] = np.nan
    status = laws.damping(delta, q[Q_VN], load, par_of(par, system, RACEWAY_KERNELS * which + R_DAMPING), out)
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
        u, theta, load, rx, ry, e, eta0, alpha, par_of(par, system, RACEWAY_KERNELS * which + R_FILM), out
    )
    if status != 1 or not finite(out[:2]):
        return report(fault, R_FILM, status, which, u, theta, load, eta0)
    h_cen, h_min = out[0], out[1]
    slide = math.sqrt(q[Q_VT] ** 2 + q[Q_VS] ** 2)
    out[0] = np.nan
    status = laws.thermal_correction(
        u, slide, pmax, e, eta0, beta, k_oil, par_of(par, system, RACEWAY_KERNELS * which + R_THERMAL), out
    )
    if status != 1 or not abs(out[0]) < np.inf:
        return report(fault, R_THERMAL, status, which, u, slide, pmax, eta0)
    factor = out[0] * system.starvation
    scalars[C_HISO] = h_cen
    scalars[C_HCEN] = h_cen * factor
    scalars[C_HMIN] = h_min * factor
    scalars[C_LAMBDA] = scalars[C_HCEN] / system.roughness
    out[0] = np.nan
    status = laws.asperity_load(scalars[C_LAMBDA], par_of(par, system, RACEWAY_KERNELS * which + R_ASPERITY), out)
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
        load, a, b, rx, ry, system.ball_radius, par_of(par, system, RACEWAY_KERNELS * which + R_HYSTERESIS), out
    )
    if status != 1 or not abs(out[0]) < np.inf:
        return report(fault, R_HYSTERESIS, status, which, load, a, b, rx)
    scalars[C_HYST] = out[0]
    scalars[C_WET] = 1.0
    return 1
