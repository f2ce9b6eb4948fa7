"""What a sample shows beyond the state: contact channels, energies. Off the hot path."""

from __future__ import annotations

import math

import numpy as np

from lambda_core.physics.compiled.bdf import evaluate_t
from lambda_core.physics.compiled.cage import (
    GAUSS_NODES,
    GAUSS_WEIGHTS,
    guide_energy,
    guide_force,
    land_state,
    neighbour_state,
    pocket_apply,
    pocket_state,
)
from lambda_core.physics.compiled.kinematics import (
    axis_x,
    contact_angle,
    contact_kinematics,
    surface_lift,
)
from lambda_core.physics.compiled.layout import (
    BODY_FM,
    BVR,
    BVT,
    BVX,
    BWR,
    BWT,
    BWX,
    C_A,
    C_B,
    C_DAMP,
    C_HCEN,
    C_HMIN,
    C_LAMBDA,
    C_LOAD,
    C_PMAX,
    C_PSI,
    C_TMEAN,
    CAGE,
    FAULT,
    GRID_AREA,
    GUIDE,
    INNER,
    KIN,
    NB,
    NS,
    OUT,
    OUTER,
    P_LAND,
    P_POCKET,
    Q_DELTA,
    Q_UT,
    Q_VT,
    Q_WN,
    R_CAPACITANCE,
    R_NORMAL,
    R_PERMITTIVITY,
    R_RHEOLOGY,
    RACEWAY_KERNELS,
    SAY,
    SAZ,
    SCALARS,
    SHARED,
    SSIGMA,
    STILL,
    SVX,
    SWY,
    SWZ,
    WRENCH,
    X_LN,
    X_MU,
    X_P,
    X_RHO,
    X_T1,
    array1,
    array2,
    array3,
    array4,
    bundle_t,
    f8,
    helper,
    i8,
    par_of,
)
from lambda_core.physics.compiled.raceway import raceway_losses, report
from lambda_core.physics.compiled.timefunctions import fill_shared

VACUUM_PERMITTIVITY = 8.8541878128e-12  # [F/m], CODATA 2018

# Contact channels, in this order along the last axis of `contacts`.
CONTACT_CHANNELS = (
    "load",
    "contact_angle",
    "max_pressure",
    "semi_axis_a",
    "semi_axis_b",
    "film_central",
    "film_minimum",
    "film_parameter",
    "asperity_share",
    "film_temperature",
    "slip",
    "entrainment",
    "spin_velocity",
    "capacitance_hertz",
    "capacitance",
    "contact_loss",
)
observe_sig = i8(
    array1,
    array2,
    bundle_t,
    evaluate_t,
    f8,
    array4,
    array3,
    array3,
    array2,
    array2,
    array2,
    array1,
)


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
    status = laws.rheology(
        p,
        temp,
        par_of(par, system, RACEWAY_KERNELS * which + R_RHEOLOGY),
        cells[X_LN],
        rho,
    )
    if status == 1:
        status = laws.permittivity(
            p,
            temp,
            rho,
            par_of(par, system, RACEWAY_KERNELS * which + R_PERMITTIVITY),
            eps,
        )
    total = 0.0
    for i in range(eps.size):
        total += eps[i] * grid[GRID_AREA, i]
    if status != 1 or not abs(total) < np.inf:
        return report(scratch[FAULT], R_PERMITTIVITY, status, which, p[0], temp[0], rho[0], 0.0)
    a, b, load = scalars[C_A], scalars[C_B], scalars[C_LOAD]
    hertz = VACUUM_PERMITTIVITY * total * a * b / h
    p[:1] = 0.0
    laws.rheology(
        p[:1],
        temp[:1],
        par_of(par, system, RACEWAY_KERNELS * which + R_RHEOLOGY),
        cells[X_LN][:1],
        rho[:1],
    )
    laws.permittivity(
        p[:1],
        temp[:1],
        rho[:1],
        par_of(par, system, RACEWAY_KERNELS * which + R_PERMITTIVITY),
        eps[:1],
    )
    rx, e = system.radius_x[which], system.e_eff[which]
    u = system.eta0 * abs(q[Q_UT]) / (e * rx)
    out[0] = np.nan
    status = laws.capacitance(
        hertz, h, a, b, rx, system.radius_y[which], u, system.alpha_p * e, load / (e * rx * rx), eps[0],
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


@helper
def _raceway_channels(y, j, which, bundle, shorted, channels, losses):
    """Write the channels of one contact; zeros and the gap's capacitance when it is open."""
    scratch = bundle.scratch
    system = bundle.system[0]
    laws = bundle.laws.inner if which == INNER else bundle.laws.outer
    par = bundle.par
    ball = y[NB * j : NB * j + NB]
    ring = scratch[SHARED][NS * which : NS * which + NS]
    channels[:] = 0.0
    kin = scratch[KIN]
    if system.surfaces == 1:
        surface_lift(ball, ring, which, bundle, kin)
    delta = contact_kinematics(ball, ring, which, system, kin)
    if not delta < np.inf:
        return 0
    channels[1] = contact_angle(kin, which)
    channels[9] = system.oil_temperature
    if delta <= 0.0:
        eps, cells = bundle.cells[0][X_MU][:1], bundle.cells[0]
        cells[X_P, 0], cells[X_T1, 0] = 0.0, system.oil_temperature
        laws.rheology(
            cells[X_P][:1],
            cells[X_T1][:1],
            par_of(par, system, RACEWAY_KERNELS * which + R_RHEOLOGY),
            cells[X_LN][:1],
            cells[X_RHO][:1],
        )
        laws.permittivity(
            cells[X_P][:1],
            cells[X_T1][:1],
            cells[X_RHO][:1],
            par_of(par, system, RACEWAY_KERNELS * which + R_PERMITTIVITY),
            eps,
        )
        channels[14] = eps[0] * gap_capacitance(system, which, -delta)
        return 1
    scalars = scratch[SCALARS]
    ok = bundle.wrench(
        which, kin, laws, par, bundle.system, bundle.grid, bundle.cells[0], scratch, scalars,
        scratch[WRENCH],
    )  # fmt: skip
    if ok != 1:
        return 0
    losses[:] = 0.0
    raceway_losses(which, kin, system, bundle.grid, scalars, bundle.cells[0], losses)
    channels[0] = scalars[C_LOAD] + scalars[C_DAMP]
    channels[2], channels[3], channels[4] = scalars[C_PMAX], scalars[C_A], scalars[C_B]
    channels[5], channels[6], channels[7] = (
        scalars[C_HCEN],
        scalars[C_HMIN],
        scalars[C_LAMBDA],
    )
    channels[8], channels[9] = scalars[C_PSI], scalars[C_TMEAN]
    channels[10], channels[11], channels[12] = kin[Q_VT], kin[Q_UT], kin[Q_WN]
    for i in range(losses.size):
        channels[15] += losses[i]
    return contact_capacitance(which, kin, laws, bundle, shorted, channels)


@helper
def _contact_energy(which, delta, bundle):
    """Return the elastic energy of a raceway contact at penetration delta [J].

    With delta u^2 for the penetration, eight points are exact for a power law of exponent 3/2.
    """
    scratch = bundle.scratch
    system = bundle.system[0]
    laws = bundle.laws.inner if which == INNER else bundle.laws.outer
    par = bundle.par
    total = 0.0
    for i in range(GAUSS_NODES.size):
        u = GAUSS_NODES[i]
        laws.normal_contact(
            delta * u * u, system.radius_x[which], system.radius_y[which], system.e_eff[which],
            par_of(par, system, RACEWAY_KERNELS * which + R_NORMAL), scratch[OUT],
        )  # fmt: skip
        total += GAUSS_WEIGHTS[i] * scratch[OUT][0] * 2.0 * delta * u
    return total


@helper
def _kinetic_body(body, b, system):
    ay, az = body[SAY], body[SAZ]
    ax = axis_x(ay, az)
    wy, wz, sigma = body[SWY], body[SWZ], body[SSIGMA]
    wx = -(wy * ay + wz * az) / ax
    v2 = body[SVX] ** 2 + body[SVX + 1] ** 2 + body[SVX + 2] ** 2
    energy = 0.5 * system.mass[b] * v2 + 0.5 * system.polar_inertia[b] * sigma * sigma
    energy += 0.5 * system.transverse_inertia[b] * (wx * wx + wy * wy + wz * wz)
    for i in range(3):
        energy += 0.5 * system.stiffness[6 * b + i] * body[i] * body[i]
    energy += 0.5 * system.stiffness[6 * b + 3] * az * az + 0.5 * system.stiffness[6 * b + 4] * ay * ay
    return energy


@helper
def stored_energy(t, y, bundle):
    """Return kinetic plus elastic energy of all bodies, contacts and supports [J]."""
    scratch = bundle.scratch
    system, out = bundle.system[0], scratch[OUT]
    fill_shared(t, y, bundle)
    total = 0.0
    cage = scratch[SHARED][NS * CAGE : NS * CAGE + NS]
    for j in range(system.balls):
        ball = y[NB * j : NB * j + NB]
        v2 = ball[BVX] ** 2 + ball[BVR] ** 2 + ball[BVT] ** 2
        w2 = ball[BWX] ** 2 + ball[BWR] ** 2 + ball[BWT] ** 2
        total += 0.5 * system.ball_mass * v2 + 0.5 * system.ball_inertia * w2
        for which in range(2):
            ring = scratch[SHARED][NS * which : NS * which + NS]
            if system.surfaces == 1:
                surface_lift(ball, ring, which, bundle, scratch[KIN])
            if contact_kinematics(ball, ring, which, system, scratch[KIN]) > 0.0:
                total += _contact_energy(which, scratch[KIN][Q_DELTA], bundle)
        if system.guides_on == 1:
            g, law, par = (
                scratch[GUIDE],
                bundle.laws.pocket,
                par_of(bundle.par, system, P_POCKET),
            )
            start = 0.0
            if system.cage_on == 1:
                pocket_state(ball, cage, j, system, g)
            else:
                k = (j + 1) % system.balls
                neighbour_state(ball, y[NB * k : NB * k + NB], g)
                apart = math.sqrt(g[0] ** 2 + g[1] ** 2 + g[2] ** 2)
                start = max(1.0, 2.0 * system.ball_radius / apart)
            total += guide_energy(law, par, g, system.eta0, out, scratch[STILL], start)
    for b in range(3):
        if b != CAGE or system.cage_on == 1:
            total += _kinetic_body(scratch[SHARED][NS * b : NS * b + NS], b, system)
    if system.cage_on == 1 and system.guides_on == 1:
        for which in range(2):
            if system.land_on[which] == 0:
                continue
            law = bundle.laws.land_inner if which == INNER else bundle.laws.land_outer
            par = par_of(bundle.par, system, P_LAND + which)
            ring = scratch[SHARED][NS * which : NS * which + NS]
            for side in range(2):
                land_state(cage, ring, (2 * side - 1) * system.land_offset, scratch[GUIDE])
                total += guide_energy(law, par, scratch[GUIDE], system.eta0, out, scratch[STILL], 0.0)
    return total


@helper
def _observe_one(t, y, bundle, shorted, contacts, pockets, lands, extra):
    """Write what one sample shows; see observe."""
    scratch = bundle.scratch
    system = bundle.system[0]
    scratch[FAULT][0] = -1.0
    extra[0] = stored_energy(t, y, bundle)
    fill_shared(t, y, bundle)
    total = 0.0
    for j in range(system.balls):
        for which in range(2):
            if _raceway_channels(y, j, which, bundle, shorted, contacts[j, which], extra[2:]) != 1:
                scratch[FAULT][2] = j
                return 0
        ci, co = contacts[j, INNER, 14], contacts[j, OUTER, 14]
        total += 1.0 / (1.0 / ci + 1.0 / co) if ci > 0.0 and co > 0.0 else 0.0
    extra[1] = total
    pockets[:, :] = 0.0
    lands[:, :] = 0.0
    if system.cage_on == 0:
        return 1
    cage = scratch[SHARED][NS * CAGE : NS * CAGE + NS]
    for j in range(system.balls):
        ball = y[NB * j : NB * j + NB]
        pocket_state(ball, cage, j, system, scratch[GUIDE])
        if (
            guide_force(
                bundle.laws.pocket,
                par_of(bundle.par, system, P_POCKET),
                scratch[GUIDE],
                system.eta0,
                scratch[OUT],
                scratch[FAULT],
                -1.0,
            )
            != 1
        ):
            return 0
        bundle.ball_fm[:, :] = 0.0
        pocket_apply(
            ball,
            cage,
            scratch[GUIDE],
            scratch[OUT],
            bundle.ball_fm[0],
            scratch[BODY_FM + CAGE],
        )
        for k in range(3):
            pockets[j, k] = bundle.ball_fm[0, k]
    for which in range(2):
        if system.land_on[which] == 0:
            continue
        law = bundle.laws.land_inner if which == INNER else bundle.laws.land_outer
        par = par_of(bundle.par, system, P_LAND + which)
        ring = scratch[SHARED][NS * which : NS * which + NS]
        for side in range(2):
            land_state(cage, ring, (2 * side - 1) * system.land_offset, scratch[GUIDE])
            if (
                guide_force(
                    law,
                    par,
                    scratch[GUIDE],
                    system.eta0,
                    scratch[OUT],
                    scratch[FAULT],
                    which,
                )
                != 1
            ):
                return 0
            for axis in range(3):
                for k in range(3):
                    lands[which, axis] += scratch[OUT][k] * scratch[GUIDE][9 + 3 * k + axis]
    return 1


def observe(
    times,
    states,
    bundle,
    evaluate,
    shorted,
    contacts,
    pockets,
    lands,
    extra,
    shared,
    rates,
    dydt,
):
    """Write what samples show; an entry point.

    Parameters
    ----------
    times : float64[:], shape (n,)
    states : float64[:, :], shape (at least n, 9 Z + n_active)
    evaluate : pointer
        The right-hand side.
    shorted : float
        Asperity share above which a contact counts as touching metal; below zero the stored energy alone is written.
    contacts : float64[:, :, :, :], shape (n, Z, 2, 16)
        CONTACT_CHANNELS.
    pockets : float64[:, :, :], shape (n, Z, 3)
        Force of the cage on each ball, axes x, r, t [N].
    lands : float64[:, :, :], shape (n, 2, 3)
        Force of each ring's land on the cage, inertial [N].
    extra : float64[:, :], shape (n, NI + 2)
        [:, 0] stored energy [J]; [:, 1] capacitance of the bearing [F]; [:, 2] torque that balances the contacts of the
        inner ring about its axis [N m]; the rest is scratch.
    shared : float64[:, :], shape (n, 36)
        The whole shared state.
    rates : float64[:, :], shape (n, NI)
        Losses [W] and the rates of the other running integrals.
    dydt : float64[:], shape (9 Z + n_active,)
        Workspace.

    Returns
    -------
    int
        1 when every kernel was well; otherwise 0 and scratch[FAULT] says which was not.
    """
    for i in range(times.size):
        y = states[i]
        if shorted < 0.0:
            extra[i, 0] = stored_energy(times[i], y, bundle)
            continue
        if (
            _observe_one(
                times[i],
                y,
                bundle,
                shorted,
                contacts[i],
                pockets[i],
                lands[i],
                extra[i],
            )
            != 1
        ):
            return 0
        if evaluate(times[i], y, bundle, dydt, rates[i], 1) != 1:
            return 0
        for k in range(3 * NS):
            shared[i, k] = bundle.scratch[SHARED, k]
        ay, az = shared[i, SAY], shared[i, SAZ]
        m = bundle.scratch[BODY_FM + INNER]
        extra[i, 2] = -(m[3] * axis_x(ay, az) + m[4] * ay + m[5] * az)
    return 1
