"""Equations of motion of the balls and of the shared bodies."""

from __future__ import annotations

import math

from lambda_core.physics.compiled.kinematics import axis_x
from lambda_core.physics.compiled.layout import (
    BR,
    BVR,
    BVT,
    BVX,
    BWR,
    BWT,
    CH_FORCE,
    CH_MOMENT,
    CH_MOTION,
    FREE,
    I_DRIVE,
    I_INPUT,
    L_SUPPORT,
    PRESCRIBED,
    SAY,
    SAZ,
    SSIGMA,
    STHETA,
    SVX,
    SWY,
    SWZ,
    helper,
)


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
def _translate(body, b, fm, channels, system, rate):
    """Write the accelerations of a shared body along the axes; returns external and support power [W]."""
    mass, sigma = system.mass[b], body[SSIGMA]
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
    return power, support


@helper
def _turn_across(moment, w, inertia, dof, channels, system):
    """Return the angular acceleration across the axis and the power of what prescribes it [W]."""
    if system.mode[dof] == FREE:
        return moment / inertia, 0.0
    rate = channels[CH_MOTION + dof, 2] if system.mode[dof] == PRESCRIBED else 0.0
    return rate, (inertia * rate - moment) * w


@helper
def _rotate(body, b, fm, channels, system, rate):
    """Write the angular accelerations of a shared body; returns external, drive's and support power [W].

    Support springs have the potential (k_y a_z^2 + k_z a_y^2)/2 of the tilt (phi_y, phi_z) = (-a_z, a_y); their
    dampers act across the axis (c_y, c_z) and about it (c_s).
    """
    ay, az, wy, wz, sigma = body[SAY], body[SAZ], body[SWY], body[SWZ], body[SSIGMA]
    ax = axis_x(ay, az)
    wx = -(wy * ay + wz * az) / ax
    ip, it, d, m = system.polar_inertia[b], system.transverse_inertia[b], 6 * b, CH_MOMENT + 3 * b
    lx, ly, lz = channels[m, 0], channels[m + 1, 0], channels[m + 2, 0]
    ky, kz = system.stiffness[d + 3], system.stiffness[d + 4]
    dy, dz = system.damping[d + 3] * wy, system.damping[d + 4] * wz
    resist = system.damping[d + 5] * sigma
    mx = fm[3] + lx + (kz - ky) * ay * az
    my = fm[4] + ly + ky * az * ax
    mz = fm[5] + lz - kz * ay * ax
    support = dy * wy + dz * wz + resist * sigma
    power = lx * (wx + sigma * ax) + ly * (wy + sigma * ay) + lz * (wz + sigma * az)
    about = mx * ax + my * ay + mz * az
    along, drive = about - resist, 0.0
    if system.mode[d + 5] == FREE:
        rate[SSIGMA] = along / ip
    else:
        rate[SSIGMA] = channels[CH_MOTION + d + 5, 1] if system.mode[d + 5] == PRESCRIBED else 0.0
        drive = (ip * rate[SSIGMA] - along) * sigma
    slant = about - dy * ay - dz * az
    gy = my - dy - slant * ay - ip * sigma * rate[SAY]
    gz = mz - dz - slant * az - ip * sigma * rate[SAZ]
    rate[SWY], hold_y = _turn_across(gy, wy, it, d + 3, channels, system)
    rate[SWZ], hold_z = _turn_across(gz, wz, it, d + 4, channels, system)
    return power + drive + hold_y + hold_z, drive, support


@helper
def body_rates(body, b, fm, channels, system, rate, rates, want):
    """Equations of motion of one shared body under contact force and moment fm (6,).

    Adds loads, gravity, unbalance and supports. With `want`, adds to rates the work of everything
    external: loads, gravity, and whatever holds or drives the driven degrees of freedom.
    """
    ay, az, wy, wz = body[SAY], body[SAZ], body[SWY], body[SWZ]
    ax = axis_x(ay, az)
    wx = -(wy * ay + wz * az) / ax
    for i in range(3):
        rate[i] = body[SVX + i]
    # Axis rate w x a and the spin angle relative to the frame of least rotation.
    ty, tz = wz * ax - wx * az, wx * ay - wy * ax
    rate[SAY], rate[SAZ] = ty, tz
    rate[STHETA] = body[SSIGMA] - (az * ty - ay * tz) / (1.0 + ax)
    push, damp = _translate(body, b, fm, channels, system, rate)
    turn, drive, resist = _rotate(body, b, fm, channels, system, rate)
    if want == 1:
        rates[I_INPUT] += push + turn
        rates[I_DRIVE] += drive
        rates[L_SUPPORT] += damp + resist
