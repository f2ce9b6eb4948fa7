"""The right-hand side: forces of every element, equations of motion, powers."""

from __future__ import annotations

import math

import numpy as np

from lambda_core.physics.compiled.cage import (
    G_R,
    guide_force,
    guide_loss,
    land_apply,
    land_state,
    neighbour_apply,
    neighbour_state,
    pocket_apply,
    pocket_state,
)
from lambda_core.physics.compiled.kinematics import (
    apply_wrench,
    axis_x,
    contact_kinematics,
    surface_lift,
)
from lambda_core.physics.compiled.layout import (
    BODY_FM,
    BPSI,
    BR,
    BVR,
    BVT,
    BVX,
    BWR,
    BWT,
    BWX,
    CAGE,
    CH_FORCE,
    CH_MOMENT,
    CH_MOTION,
    FAULT,
    FREE,
    GUIDE,
    I_ANGLE,
    I_DRIVE,
    I_INPUT,
    I_INPUT_ABS,
    I_X,
    INNER,
    KIN,
    L_DRAG,
    L_LAND,
    L_POCKET,
    L_SUPPORT,
    NB,
    NS,
    OUT,
    OUTER,
    P_DRAG,
    P_LAND,
    P_POCKET,
    PRESCRIBED,
    R_DRAG,
    RATE,
    RING_FM,
    SAY,
    SAZ,
    SCALARS,
    SHARED,
    SSIGMA,
    STHETA,
    STILL,
    SVX,
    SWY,
    SWZ,
    WRENCH,
    helper,
    par_of,
)
from lambda_core.physics.compiled.raceway import raceway_losses, report
from lambda_core.physics.compiled.timefunctions import fill_shared

_SPIN_FLOOR = 1e-3  # [rad/s] below which a ball's churning moment fades out


@helper
def raceway_forces(y, j, bundle, rates, want):
    """Add both raceway contacts of ball j; with `want`, add their losses to rates."""
    scratch = bundle.scratch
    system = bundle.system[0]
    ball = y[NB * j : NB * j + NB]
    ball_fm = bundle.ball_fm[j]
    for which in range(2):
        ring = scratch[SHARED][NS * which : NS * which + NS]
        kin = scratch[KIN]
        if system.surfaces == 1:
            surface_lift(ball, ring, which, bundle, kin)
        delta = contact_kinematics(ball, ring, which, system, kin)
        if delta <= 0.0:
            continue
        if not delta < np.inf:
            scratch[FAULT][2] = j
            return 0
        laws = bundle.laws.inner if which == INNER else bundle.laws.outer
        ok = bundle.wrench(
            which, kin, laws, bundle.par, bundle.system, bundle.grid, bundle.cells[0], scratch,
            scratch[SCALARS], scratch[WRENCH],
        )  # fmt: skip
        if ok != 1:
            scratch[FAULT][2] = j
            return 0
        apply_wrench(kin, scratch[WRENCH], ball_fm, scratch[RING_FM])
        for k in range(6):
            scratch[BODY_FM + which, k] += scratch[RING_FM][k]
        if want == 1 and system.friction_on == 1:
            raceway_losses(
                which,
                kin,
                system,
                bundle.grid,
                scratch[SCALARS],
                bundle.cells[0],
                rates,
            )
    return 1


@helper
def drag_force(ball, bundle, ball_fm):
    """Add fluid drag and churning of one ball; returns the power lost [W], or -1 on a fault."""
    scratch = bundle.scratch
    system = bundle.system[0]
    w = math.sqrt(ball[BWX] ** 2 + ball[BWR] ** 2 + ball[BWT] ** 2)
    nu = system.eta0 / system.rho0
    scratch[OUT][:2] = np.nan
    status = bundle.laws.drag(
        ball[BVT],
        w,
        ball[BPSI],
        nu,
        system.rho0,
        par_of(bundle.par, system, P_DRAG),
        scratch[OUT],
    )
    force, moment = scratch[OUT][0], scratch[OUT][1]
    if status != 1 or not abs(force) + abs(moment) < np.inf:
        report(scratch[FAULT], R_DRAG, status, -1.0, ball[BVT], w, ball[BPSI], nu)
        return -1.0
    moment /= math.sqrt(w * w + _SPIN_FLOOR * _SPIN_FLOOR)
    ball_fm[2] -= force
    ball_fm[3] -= moment * ball[BWX]
    ball_fm[4] -= moment * ball[BWR]
    ball_fm[5] -= moment * ball[BWT]
    return force * ball[BVT] + moment * w * w


@helper
def cage_forces(y, bundle, rates, want):
    """Add pockets and lands, or ball-ball contacts when there is no cage."""
    scratch = bundle.scratch
    system = bundle.system[0]
    g, out, fault, eta0 = scratch[GUIDE], scratch[OUT], scratch[FAULT], system.eta0
    cage = scratch[SHARED][NS * CAGE : NS * CAGE + NS]
    z = system.balls
    law, par = bundle.laws.pocket, par_of(bundle.par, system, P_POCKET)
    for j in range(z):
        ball = y[NB * j : NB * j + NB]
        k = (j + 1) % z
        other = y[NB * k : NB * k + NB]
        if system.cage_on == 1:
            pocket_state(ball, cage, j, system, g)
        else:
            neighbour_state(ball, other, g)
        if guide_force(law, par, g, eta0, out, fault, -1.0) != 1:
            fault[2] = j
            return 0
        if want == 1:
            rates[L_POCKET if system.cage_on == 1 else L_LAND] += guide_loss(law, par, g, eta0, out, scratch[STILL])
        if system.cage_on == 1:
            pocket_apply(ball, cage, g, out, bundle.ball_fm[j], scratch[BODY_FM + CAGE])
        else:
            a0, a1, a2 = out[3] - g[G_R], out[4] - g[G_R + 1], out[5] - g[G_R + 2]
            neighbour_apply(ball[BPSI], a0, a1, a2, out, 1.0, bundle.ball_fm[j])
            neighbour_apply(other[BPSI], out[3], out[4], out[5], out, -1.0, bundle.ball_fm[k])
    for which in range(2):
        if system.land_on[which] == 0 or system.cage_on == 0:
            continue
        ring = scratch[SHARED][NS * which : NS * which + NS]
        law = bundle.laws.land_inner if which == INNER else bundle.laws.land_outer
        par = par_of(bundle.par, system, P_LAND + which)
        for side in range(2):
            land_state(cage, ring, (2 * side - 1) * system.land_offset, g)
            if guide_force(law, par, g, eta0, out, fault, which) != 1:
                return 0
            if want == 1:
                rates[L_LAND] += guide_loss(law, par, g, eta0, out, scratch[STILL])
            land_apply(cage, ring, g, out, scratch[BODY_FM + CAGE], scratch[BODY_FM + which])
    return 1


@helper
def ball_rates(ball, fm, system, dydt):
    """Equations of motion of one ball in its turning frame (Coriolis and gyroscopic terms)."""
    r = ball[BR]
    orbit = ball[BVT] / r
    dydt[0] = ball[BVX]
    dydt[1] = ball[BVR]
    dydt[2] = orbit
    dydt[3] = fm[0] / system.ball_mass
    dydt[4] = fm[1] / system.ball_mass + ball[BVT] * orbit
    dydt[5] = fm[2] / system.ball_mass - ball[BVR] * orbit
    dydt[6] = fm[3] / system.ball_inertia
    dydt[7] = fm[4] / system.ball_inertia + orbit * ball[BWT]
    dydt[8] = fm[5] / system.ball_inertia - orbit * ball[BWR]


@helper
def body_rates(body, b, fm, channels, system, rate, rates, want):
    """Equations of motion of one shared body under contact force and moment fm (6,).

    Adds loads, gravity, unbalance and supports. With `want`, adds to rates the work of everything
    external: loads, gravity, and whatever holds or drives the driven degrees of freedom.
    """
    ay, az = body[SAY], body[SAZ]
    ax = axis_x(ay, az)
    wy, wz, sigma = body[SWY], body[SWZ], body[SSIGMA]
    wx = -(wy * ay + wz * az) / ax
    mass, ip, it = system.mass[b], system.polar_inertia[b], system.transverse_inertia[b]
    # Axis rate w x a and the spin angle relative to the frame of least rotation.
    ty, tz = wz * ax - wx * az, wx * ay - wy * ax
    for i in range(3):
        rate[i] = body[SVX + i]
    rate[SAY], rate[SAZ] = ty, tz
    rate[STHETA] = sigma - (az * ty - ay * tz) / (1.0 + ax)
    power, support = 0.0, 0.0
    ub = system.unbalance[b] * sigma * sigma
    for i in range(3):
        v = body[SVX + i]
        load = channels[CH_FORCE + 3 * b + i, 0] + mass * system.gravity[i]
        if i == 1:
            load += ub * math.cos(body[STHETA])
        elif i == 2:
            load += ub * math.sin(body[STHETA])
        dof = 6 * b + i
        force = fm[i] + load - system.stiffness[dof] * body[i] - system.damping[dof] * v
        support += system.damping[dof] * v * v
        power += load * v
        if system.mode[dof] == FREE:
            rate[SVX + i] = force / mass
        else:
            rate[SVX + i] = channels[CH_MOTION + dof, 2] if system.mode[dof] == PRESCRIBED else 0.0
            power += (mass * rate[SVX + i] - force) * v
    # Moments: contacts, loads, and supports. Their springs have the potential (k_y a_z^2 + k_z a_y^2)/2 of the
    # tilt (phi_y, phi_z) = (-a_z, a_y); their dampers act across the axis (c_y, c_z) and about it (c_s).
    lx, ly, lz = (
        channels[CH_MOMENT + 3 * b, 0],
        channels[CH_MOMENT + 3 * b + 1, 0],
        channels[CH_MOMENT + 3 * b + 2, 0],
    )
    d = 6 * b
    ky, kz = system.stiffness[d + 3], system.stiffness[d + 4]
    dy, dz = system.damping[d + 3] * wy, system.damping[d + 4] * wz
    resist = system.damping[d + 5] * sigma
    mx = fm[3] + lx + (kz - ky) * ay * az
    my = fm[4] + ly + ky * az * ax
    mz = fm[5] + lz - kz * ay * ax
    support += dy * wy + dz * wz + resist * sigma
    power += lx * (wx + sigma * ax) + ly * (wy + sigma * ay) + lz * (wz + sigma * az)
    about = mx * ax + my * ay + mz * az
    along = about - resist
    if system.mode[d + 5] == FREE:
        rate[SSIGMA] = along / ip
    else:
        rate[SSIGMA] = channels[CH_MOTION + d + 5, 1] if system.mode[d + 5] == PRESCRIBED else 0.0
        drive = (ip * rate[SSIGMA] - along) * sigma
        power += drive
        if want == 1:
            rates[I_DRIVE] += drive
    slant = about - dy * ay - dz * az
    gy, gz = (
        my - dy - slant * ay - ip * sigma * ty,
        mz - dz - slant * az - ip * sigma * tz,
    )
    if system.mode[d + 3] == FREE:
        rate[SWY] = gy / it
    else:
        rate[SWY] = channels[CH_MOTION + d + 3, 2] if system.mode[d + 3] == PRESCRIBED else 0.0
        power += (it * rate[SWY] - gy) * wy
    if system.mode[d + 4] == FREE:
        rate[SWZ] = gz / it
    else:
        rate[SWZ] = channels[CH_MOTION + d + 4, 2] if system.mode[d + 4] == PRESCRIBED else 0.0
        power += (it * rate[SWZ] - gz) * wz
    if want == 1:
        rates[I_INPUT] += power
        rates[L_SUPPORT] += support


def evaluate(t, y, bundle, dydt, rates, want):
    """Write dy/dt; with `want` = 1 also the powers and rates of the running integrals.

    Parameters
    ----------
    t : float
        Time [s].
    y, dydt : float64[:], shape (9 Z + n_active,)
    rates : float64[:], shape (NI,)
        Losses by mechanism [W], input power [W], its absolute value, drive power, |relative speed| [rad/s],
        position of the inner ring [m].

    Returns
    -------
    int
        1 when every kernel was well; otherwise 0 and scratch[FAULT] says which was not.
    """
    scratch = bundle.scratch
    system = bundle.system[0]
    scratch[FAULT][0] = -1.0
    fill_shared(t, y, bundle)
    bundle.ball_fm[:, :] = 0.0
    scratch[BODY_FM : BODY_FM + 3, :6] = 0.0
    rates[:] = 0.0
    z = system.balls
    for j in range(z):
        if raceway_forces(y, j, bundle, rates, want) != 1:
            return 0
    if system.guides_on == 1 and cage_forces(y, bundle, rates, want) != 1:
        return 0
    gx, gy, gz = system.gravity[0], system.gravity[1], system.gravity[2]
    for j in range(z):
        ball = y[NB * j : NB * j + NB]
        fm = bundle.ball_fm[j]
        if system.drag_on == 1 and system.friction_on == 1:
            lost = drag_force(ball, bundle, fm)
            if lost < -0.5:
                scratch[FAULT][2] = j
                return 0
            rates[L_DRAG] += lost
        c, s = math.cos(ball[BPSI]), math.sin(ball[BPSI])
        m = system.ball_mass
        wx, wr, wt = m * gx, m * (gy * c + gz * s), m * (-gy * s + gz * c)
        fm[0] += wx
        fm[1] += wr
        fm[2] += wt
        if want == 1:
            rates[I_INPUT] += wx * ball[BVX] + wr * ball[BVR] + wt * ball[BVT]
        ball_rates(ball, fm, system, dydt[NB * j : NB * j + NB])
    active = bundle.active
    k = 0
    for b in range(3):
        if b == CAGE and system.cage_on == 0:
            continue
        body = scratch[SHARED][NS * b : NS * b + NS]
        body_rates(
            body,
            b,
            scratch[BODY_FM + b],
            bundle.channels,
            system,
            scratch[RATE],
            rates,
            want,
        )
        while k < active.size and active[k] < NS * (b + 1):
            dydt[NB * z + k] = scratch[RATE][active[k] - NS * b]
            k += 1
    if want == 1:
        rates[I_INPUT_ABS] = abs(rates[I_INPUT])
        rates[I_ANGLE] = abs(scratch[SHARED][SSIGMA] - scratch[SHARED][NS * OUTER + SSIGMA])
        for i in range(3):
            rates[I_X + i] = scratch[SHARED][i]
    return 1
