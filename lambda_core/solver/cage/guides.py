"""Compute contacts of the cage.

Balls touch pockets, lands touch rings, and balls touch each other without a cage.
"""

from __future__ import annotations

import math

import numpy as np

from lambda_core.solver.arrays.fault_roles import CAGE_CONTACT
from lambda_core.solver.cage.cage_waves import carry_land, carry_pocket
from lambda_core.solver.contact.contact_kinematics import axis_x
from lambda_core.solver.faults import report
from lambda_core.solver.layout import helper
from lambda_core.solver.vec import (
    add,
    combine,
    combine_onto,
    components,
    cosine_sine,
    cross,
    decrease,
    dot,
    increase,
    inertial,
    point_velocity,
    scale,
    store,
    subtract,
    turning,
)

# Gauss-Legendre, 8 points on 0..1.
GAUSS_NODES = np.polynomial.legendre.leggauss(8)[0] * 0.5 + 0.5
GAUSS_WEIGHTS = np.polynomial.legendre.leggauss(8)[1] * 0.5
_PARTS = 10  # of the way of an elastic contact, each half as long as the next: laws bend near first touch


@helper
def turning_body(body):
    """Return axis and angular velocity of a body, inertial."""
    ay, az = body.tilt[0], body.tilt[1]
    wy, wz = body.tilt_velocity[0], body.tilt_velocity[1]
    axis = axis_x(ay, az), ay, az
    across = -(wy * ay + wz * az) / axis[0], wy, wz
    return axis, add(across, scale(body.spin, axis))


@helper
def write_frame(axis, phi, g):
    """Write a body's unit vectors at angle phi.

    They are axial, radial and tangential, about its axis.
    """
    ax, ay, az = axis
    c1 = 1.0 + ax
    y0, y1, y2 = -ay, 1.0 - ay * ay / c1, -ay * az / c1
    z0, z1, z2 = -az, -ay * az / c1, 1.0 - az * az / c1
    c, s = cosine_sine(phi)
    store(g.axial, axis)
    store(g.radial, (c * y0 + s * z0, c * y1 + s * z1, c * y2 + s * z2))
    store(g.tangential, (-s * y0 + c * z0, -s * y1 + c * z1, -s * y2 + c * z2))


@helper
def _project(v, g):
    """Return a vector's components along the axes.

    The vector is inertial, the axes are those of the frame.
    """
    return components(v, g.axial, g.radial, g.tangential)


@helper
def pocket_state(ball, cage, j, row, bundle, g):
    """Write ball j's state in its pocket.

    Position and velocity are relative to the pocket, in its frame; the ball belongs to the row.
    """
    axis, omega = turning_body(cage)
    write_frame(axis, cage.angle + row.pocket_phase + 2.0 * math.pi * (j - row.first_ball) / row.balls, g)
    c, s = cosine_sine(ball.azimuth)
    # Ball from the cage's centre.
    d = subtract((ball.x, ball.radius * c, ball.radius * s), cage.position)
    store(g.origin, add(scale(row.pocket_circle, g.radial), scale(row.pocket_offset, axis)))
    store(g.place, _project(subtract(d, g.origin), g))
    v = subtract(subtract(inertial(ball.velocity, c, s), cage.velocity), cross(omega, d))
    store(g.velocity, _project(v, g))
    store(g.rotation, _project(subtract(inertial(ball.spin, c, s), omega), g))
    if row.waves[1] > row.waves[0]:
        carry_pocket(row.pocket_phase + 2.0 * math.pi * (j - row.first_ball) / row.balls, row, bundle, g)


@helper
def land_state(cage, ring, land, bundle, g):
    """Write the state of a land's station.

    It is the position of a station of the cage's axis relative to the ring's, and its velocity.
    """
    offset = land.offset
    axis, omega = turning_body(cage)
    ring_axis, ring_omega = turning_body(ring)
    write_frame(ring_axis, 0.0, g)
    station = scale(offset, axis)
    store(g.origin, scale(offset, ring_axis))
    e = add(subtract(cage.position, ring.position), station)
    store(g.place, _project(subtract(e, g.origin), g))
    v = subtract(subtract(add(cage.velocity, cross(omega, station)), ring.velocity), cross(ring_omega, e))
    store(g.velocity, _project(v, g))
    store(g.rotation, _project(subtract(omega, ring_omega), g))
    if land.waves[1] > land.waves[0]:
        carry_land(land, cage, bundle, g)


@helper
def neighbour_state(ball, other, g):
    """Write a ball's state relative to its neighbour.

    It consists of position and velocity along axes of the inertial frame.
    """
    store(g.axial, (1.0, 0.0, 0.0))
    store(g.radial, (0.0, 1.0, 0.0))
    store(g.tangential, (0.0, 0.0, 1.0))
    store(g.origin, (0.0, 0.0, 0.0))
    c, s = cosine_sine(ball.azimuth)
    d, e = cosine_sine(other.azimuth)
    apart = (
        ball.x - other.x,
        ball.radius * c - other.radius * d,
        ball.radius * s - other.radius * e,
    )
    spin = inertial(other.spin, d, e)
    store(g.place, apart)
    v = subtract(inertial(ball.velocity, c, s), inertial(other.velocity, d, e))
    store(g.velocity, subtract(v, cross(spin, apart)))
    store(g.rotation, subtract(inertial(ball.spin, c, s), spin))


@helper
def guide_force(law, par, g, viscosity, out, fault, place):
    """Call a cage law on a guide record.

    The law writes out = force[3], point[3] in the frame; return 1 when well.
    """
    out[:6] = np.nan
    status = law(g.place[:], g.velocity[:], g.rotation[:], viscosity, par, out)
    total = 0.0
    for i in range(6):
        total += abs(out[i])
    if status != 1 or not total < np.inf:
        return report(fault, CAGE_CONTACT, status, place, g.place[0], g.place[1], g.place[2], g.velocity[0])
    return 1


@helper
def _law_at_rest(law, par, share, g, viscosity, out, still):
    """Write the law's force at rest.

    It holds at `share` of the way to the record's place.
    """
    store(still.place, scale(share, g.place))
    store(still.velocity, (0.0, 0.0, 0.0))
    store(still.rotation, (0.0, 0.0, 0.0))
    law(still.place[:], still.velocity[:], still.rotation[:], viscosity, par, out)


@helper
def guide_loss(law, par, g, viscosity, out, still):
    """Return the loss of a cage contact [W].

    It is all work less that of the elastic force.

    The elastic force is the law's force at rest. Call after guide_force, whose result `out` keeps.
    """
    # A contact that leaves too fast to push back has no force, but loses its elastic energy all the same.
    f, p = (out[0], out[1], out[2]), (out[3], out[4], out[5])
    v = point_velocity(g.velocity, g.rotation, subtract(p, g.place))
    _law_at_rest(law, par, 1.0, g, viscosity, out, still)
    elastic = dot(out, g.velocity)
    store(out, f)
    out[3], out[4], out[5] = p
    return elastic - dot(f, v)


@helper
def _force_along(law, par, share, g, viscosity, out, still):
    """Return the force at rest along r.

    Write the force at `share` of the way to the record's place; return its component along r.
    """
    _law_at_rest(law, par, share, g, viscosity, out, still)
    return dot(out, g.place)


@helper
def guide_energy(law, par, g, viscosity, out, still, start):
    """Return a cage contact's elastic energy [J].

    It is the work against the force at rest on the way to its place r.

    The way begins at `start` r, where there is no force: 0 in a pocket, beyond first touch for two balls. First
    touch is found by bisection, since the play is often a hundred times the penetration.
    """
    if _force_along(law, par, 1.0, g, viscosity, out, still) == 0.0:
        return 0.0
    free, pressed = start, 1.0
    for _ in range(40):
        middle = 0.5 * (free + pressed)
        if _force_along(law, par, middle, g, viscosity, out, still) == 0.0:
            free = middle
        else:
            pressed = middle
    total, end = 0.0, 1.0
    for step in range(_PARTS):
        begin = 0.5 * (free + end) if step < _PARTS - 1 else free
        for i in range(GAUSS_NODES.size):
            share = begin + GAUSS_NODES[i] * (end - begin)
            total -= GAUSS_WEIGHTS[i] * (end - begin) * _force_along(law, par, share, g, viscosity, out, still)
        end = begin
    return total


@helper
def force_and_point(g, out):
    """Return the force and point of a law.

    The point of action is measured from the guiding body's centre, in inertial axes.
    """
    f = combine((out[0], out[1], out[2]), g.axial, g.radial, g.tangential)
    return f, combine_onto(g.origin, (out[3], out[4], out[5]), g.axial, g.radial, g.tangential)


@helper
def pocket_apply(ball, cage, g, out, on_ball, on_cage):
    """Add a pocket's force to ball and cage.

    Ball (axes x, r, t) and cage (inertial), equal and opposite.
    """
    c, s = cosine_sine(ball.azimuth)
    f, p = force_and_point(g, out)
    centre = subtract((ball.x, ball.radius * c, ball.radius * s), cage.position)
    increase(on_ball.force, turning(f, c, s))
    increase(on_ball.moment, turning(cross(subtract(p, centre), f), c, s))
    decrease(on_cage.force, f)
    decrease(on_cage.moment, cross(p, f))


@helper
def land_apply(cage, ring, g, out, on_cage, on_ring):
    """Add a land's force to cage and ring.

    Inertial, equal and opposite.
    """
    f, p = force_and_point(g, out)
    increase(on_cage.force, f)
    increase(on_cage.moment, cross(subtract(add(p, ring.position), cage.position), f))
    decrease(on_ring.force, f)
    decrease(on_ring.moment, cross(p, f))


@helper
def neighbour_apply(azimuth, arm, out, sign, on_ball):
    """Add a ball-ball force.

    It is inertial, times sign, and acts at `arm` from the ball's centre.
    """
    c, s = cosine_sine(azimuth)
    f = scale(sign, out)
    increase(on_ball.force, turning(f, c, s))
    increase(on_ball.moment, turning(cross(arm, f), c, s))


@helper
def first_arm(g, out):
    """Return the point of a ball-ball force.

    It is measured from the first ball's centre.
    """
    return out[3] - g.place[0], out[4] - g.place[1], out[5] - g.place[2]
