"""Write equations of motion of balls and bodies."""

from __future__ import annotations

import math

from lambda_core.solver.contact.contact_kinematics import axis_x
from lambda_core.solver.layout import helper
from lambda_core.solver.records import FREE, PRESCRIBED


@helper
def ball_rates(ball, wrench, row, rate):
    """Write the rates of one ball.

    They are equations of motion in its turning frame (Coriolis and gyroscopic terms).

    Parameters
    ----------
    wrench : records.WRENCH
        All forces on the ball, turning frame.
    rate : records.BALL
        Result: the time derivative of its state.
    """
    orbit = ball.velocity[2] / ball.radius
    m, inertia, force, moment = row.ball_mass, row.ball_inertia, wrench.force, wrench.moment
    rate.x, rate.radius, rate.azimuth = ball.velocity[0], ball.velocity[1], orbit
    rate.velocity[0] = force[0] / m
    rate.velocity[1] = force[1] / m + ball.velocity[2] * orbit
    rate.velocity[2] = force[2] / m - ball.velocity[1] * orbit
    rate.spin[0] = moment[0] / inertia
    rate.spin[1] = moment[1] / inertia + orbit * ball.spin[2]
    rate.spin[2] = moment[2] / inertia - orbit * ball.spin[1]


@helper
def _translate(body, now, wrench, inputs, gravity, rate):
    """Write a body's accelerations along the axes.

    Return external and support power [W].
    """
    mass, sigma = body.mass, now.spin
    power, support = 0.0, 0.0
    whirl = body.unbalance * sigma * sigma
    for i in range(3):
        v = now.velocity[i]
        load = inputs.force[i].value + mass * gravity[i]
        swing = 0.0
        if i == 1:
            swing = whirl * math.cos(now.angle)
        elif i == 2:
            swing = whirl * math.sin(now.angle)
        force = swing + wrench.force[i] + load - body.stiffness[i] * now.position[i] - body.damping[i] * v
        support += body.damping[i] * v * v
        power += load * v
        if body.mode[i] == FREE:
            rate.velocity[i] = force / mass
        else:
            rate.velocity[i] = inputs.motion[i].acceleration if body.mode[i] == PRESCRIBED else 0.0
            power += (mass * rate.velocity[i] - force) * v
    return power, support


@helper
def _turn_across(moment, w, inertia, mode, motion):
    """Return angular acceleration and power across the axis.

    The power is that of the prescribed motion [W].
    """
    if mode == FREE:
        return moment / inertia, 0.0
    rate = motion.acceleration if mode == PRESCRIBED else 0.0
    return rate, (inertia * rate - moment) * w


@helper
def _rotate(body, now, wrench, inputs, rate):
    """Write a body's angular accelerations.

    Return the power of external loads, drive and supports [W].

    What the unbalance force U sigma^2 gives the motion of the axis it takes from the spin: the moment -U sigma (n . v),
    n from the axis to the centre of mass. Of the rotor's own -U (t . a) that leaves out U d(t . v)/dt, a swing without
    mean (Gasch, Nordmann and Pfuetzner, Rotordynamik, 2002, chapter 2).

    Support springs have the potential (k_y a_z^2 + k_z a_y^2)/2 of the tilt (phi_y, phi_z) = (-a_z, a_y); their
    dampers act across the axis (c_y, c_z) and about it (c_s).
    """
    ay, az, sigma = now.tilt[0], now.tilt[1], now.spin
    wy, wz = now.tilt_velocity[0], now.tilt_velocity[1]
    ax = axis_x(ay, az)
    wx = -(wy * ay + wz * az) / ax
    ip, it = body.polar_inertia, body.transverse_inertia
    lx, ly, lz = inputs.moment[0].value, inputs.moment[1].value, inputs.moment[2].value
    ky, kz = body.stiffness[3], body.stiffness[4]
    dy, dz = body.damping[3] * wy, body.damping[4] * wz
    resist = body.damping[5] * sigma
    mx = wrench.moment[0] + lx + (kz - ky) * ay * az
    my = wrench.moment[1] + ly + ky * az * ax
    mz = wrench.moment[2] + lz - kz * ay * ax
    support = dy * wy + dz * wz + resist * sigma
    power = lx * (wx + sigma * ax) + ly * (wy + sigma * ay) + lz * (wz + sigma * az)
    about = mx * ax + my * ay + mz * az
    outward = now.velocity[1] * math.cos(now.angle) + now.velocity[2] * math.sin(now.angle)
    along, drive = about - resist - body.unbalance * sigma * outward, 0.0
    if body.mode[5] == FREE:
        rate.spin = along / ip
    else:
        rate.spin = inputs.motion[5].rate if body.mode[5] == PRESCRIBED else 0.0
        drive = (ip * rate.spin - along) * sigma
    slant = about - dy * ay - dz * az
    gy = my - dy - slant * ay - ip * sigma * rate.tilt[0]
    gz = mz - dz - slant * az - ip * sigma * rate.tilt[1]
    rate.tilt_velocity[0], hold_y = _turn_across(gy, wy, it, body.mode[3], inputs.motion[3])
    rate.tilt_velocity[1], hold_z = _turn_across(gz, wz, it, body.mode[4], inputs.motion[4])
    return power + drive + hold_y + hold_z, drive, support


@helper
def body_rates(body, now, wrench, inputs, gravity, rate):
    """Write the rates of one body.

    They are equations of motion under the wrench of its contacts.

    Adds loads, gravity, unbalance and supports.

    Parameters
    ----------
    body : records.BODY
    now, rate : records.BODY_STATE
        Its state, and the result: the state's time derivative.
    inputs : records.INPUTS

    Returns
    -------
    tuple of 3 floats
        Power of everything external: loads, gravity, and whatever holds or drives the driven degrees of freedom; of
        the spin's drive; lost in the supports [W].
    """
    ay, az, wy, wz = now.tilt[0], now.tilt[1], now.tilt_velocity[0], now.tilt_velocity[1]
    ax = axis_x(ay, az)
    wx = -(wy * ay + wz * az) / ax
    for i in range(3):
        rate.position[i] = now.velocity[i]
    # Axis rate w x a and the spin angle relative to the frame of least rotation.
    ty, tz = wz * ax - wx * az, wx * ay - wy * ax
    rate.tilt[0], rate.tilt[1] = ty, tz
    rate.angle = now.spin - (az * ty - ay * tz) / (1.0 + ax)
    push, damp = _translate(body, now, wrench, inputs, gravity, rate)
    turn, drive, resist = _rotate(body, now, wrench, inputs, rate)
    return push + turn, drive, damp + resist
