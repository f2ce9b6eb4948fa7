"""Compute equations of motion of rollers.

A symmetrical top whose axis tilts and skews in the frame that turns with it.
"""

from __future__ import annotations

import math

from lambda_core.solver.layout import helper, large_helper
from lambda_core.solver.vec import cross, dot, scale, store, subtract


@helper
def to_own(v, row):
    """Return components along the roller's axes.

    The vector is given in the turning frame.
    """
    c, s = math.cos(row.axis_angle), math.sin(row.axis_angle)
    return c * v[0] + s * v[1], -s * v[0] + c * v[1], v[2]


@helper
def from_own(v, row):
    """Return components in the turning frame.

    The vector is given along a roller's own axes.
    """
    c, s = math.cos(row.axis_angle), math.sin(row.axis_angle)
    return c * v[0] - s * v[1], s * v[0] + c * v[1], v[2]


@helper
def _own_axis(roller):
    """Return the axis along the roller's axes.

    It is the unit vector.
    """
    u, v = roller.tilt[0], roller.tilt[1]
    return math.sqrt(max(1.0 - u * u - v * v, 1e-12)), u, v


@helper
def axis_of(roller, row):
    """Return the axis in the turning frame.

    It is the unit vector.
    """
    return from_own(_own_axis(roller), row)


@large_helper
def roller_rates(roller, wrench, row, rate):
    """Write the rates of a roller.

    Time derivative of its state, in the frame that turns with its azimuth.

    With the angular momentum H = I_t w + (I_p - I_t) n a, n = w . a, Euler's equations dH/dt = M leave
    I_p dn/dt = M . a and I_t dw/dt = M - (I_p - I_t) (dn/dt a + n w x a); dw/dt in the turning frame is less by W x w,
    W the orbital speed, and the axis moves with (w - W) x a (Goldstein, Classical Mechanics, 2nd ed., 5-5 and 5-7).

    Parameters
    ----------
    wrench : records.WRENCH
        All forces on the roller, turning frame, about its centre.
    rate : records.ROLLER
        Result.
    """
    orbit = roller.velocity[2] / roller.radius
    m, polar, transverse, force = row.ball_mass, row.ball_inertia, row.transverse_inertia, wrench.force
    rate.x, rate.radius, rate.azimuth = roller.velocity[0], roller.velocity[1], orbit
    rate.velocity[0] = force[0] / m
    rate.velocity[1] = force[1] / m + roller.velocity[2] * orbit
    rate.velocity[2] = force[2] / m - roller.velocity[1] * orbit
    axis, turn = _own_axis(roller), to_own((orbit, 0.0, 0.0), row)
    spin, moment = (roller.spin[0], roller.spin[1], roller.spin[2]), to_own(wrench.moment, row)
    about, along = dot(spin, axis), dot(moment, axis) / polar
    more = polar - transverse
    swing = subtract(subtract(moment, scale(more * along, axis)), scale(more * about, cross(spin, axis)))
    store(rate.spin, subtract(scale(1.0 / transverse, swing), cross(turn, spin)))
    moves = cross(subtract(spin, turn), axis)
    rate.tilt[0], rate.tilt[1] = moves[1], moves[2]


@helper
def roller_energy(roller, row):
    """Return the kinetic energy of a roller [J]."""
    v, w = roller.velocity, roller.spin
    about = dot(w, _own_axis(roller))
    turning = row.transverse_inertia * dot(w, w) + (row.ball_inertia - row.transverse_inertia) * about * about
    return 0.5 * (row.ball_mass * dot(v, v) + turning)
