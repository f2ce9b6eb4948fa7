"""Find contacts and their velocities.

The geometry is an exact sphere in a torus, with ring tilt.

Vectors have components along x (shaft), r (radial at the ball), t (tangential), a right-handed frame
that turns with the ball's azimuth.
"""

from __future__ import annotations

import math

import numpy as np

from lambda_core.solver.arrays.fault_roles import SURFACE
from lambda_core.solver.contact.ring_waves import widen
from lambda_core.solver.faults import report
from lambda_core.solver.layout import helper, part, raceway_laws
from lambda_core.solver.vec import (
    add,
    combine,
    components,
    cosine_sine,
    cross,
    dot,
    dot_onto,
    increase,
    inertial,
    negative,
    point_velocity,
    scale,
    store,
    subtract,
    turning,
)


@helper
def axis_x(ay, az):
    """Return a unit axis's x component.

    The other two components give it.
    """
    return math.sqrt(max(1.0 - ay * ay - az * az, 1e-12))


@helper
def _from_axis(ball, ring, c, s):
    """Return the ball's place from a ring.

    Return the ring's axis, the ball's centre from the ring's, its part along the axis and that across it.

    c and s are cosine and sine of the ball's azimuth.
    """
    ay, az = ring.tilt[0], ring.tilt[1]
    axis = turning((axis_x(ay, az), ay, az), c, s)
    x, r, aside = turning(ring.position, c, s)
    d = ball.x - x, ball.radius - r, -aside
    axial = dot(d, axis)
    return axis, d, axial, subtract(d, scale(axial, axis))


@helper
def azimuth_on(ring, across, c, s):
    """Return an azimuth in a ring's material [rad].

    It is that of a vector across the ring's axis; c and s are cosine and sine of the element's azimuth.
    """
    # Azimuth in the frame of least rotation of the tilted ring, less its spin: fixed to the raceway.
    ay, az = ring.tilt[0], ring.tilt[1]
    p0, q1, q2 = inertial(across, c, s)
    lean = p0 + (ay * q1 + az * q2) / (1.0 + axis_x(ay, az))
    azimuth = math.atan2(q2 - az * lean, q1 - ay * lean) - ring.angle
    return azimuth - 2.0 * math.pi * math.floor(azimuth / (2.0 * math.pi) + 0.5)


@helper
def surface_lift(ball, ring, raceway, bundle, kin):
    """Look up the raceway's surface under a ball.

    `contact_kinematics` takes it: call this first where a surface is in use.

    Writes kin.lift, the height, and kin.rise_t, kin.rise_s, its slopes with the ball centre's place along t and s; NaN
    when the law refused. In the quasi-static equilibrium raceways are nominal but for the waves of elastic rings.
    """
    scratch = bundle.scratch[0]
    kin.lift, kin.rise_t, kin.rise_s = 0.0, 0.0, 0.0
    kin.widening, kin.widening_slope, kin.widening_rate = 0.0, 0.0, 0.0
    textured, bends = raceway.surface_on == 1 and bundle.system[0].guides_on == 1, raceway.waves[1] > raceway.waves[0]
    if not (textured or bends):
        return
    c, s = cosine_sine(ball.azimuth)
    _, _, along, across = _from_axis(ball, ring, c, s)
    axial = along - raceway.axial_offset
    rho = math.sqrt(across[1] * across[1] + across[0] * across[0] + across[2] * across[2])
    radial = rho - raceway.groove_circle
    azimuth = azimuth_on(ring, across, c, s)
    if bends:
        widen(raceway, azimuth, bundle, kin)
    if not textured:
        return
    angle = math.atan2(raceway.side * axial, raceway.side * radial)
    out, par = scratch.surface[:], part(bundle.par, raceway.parameters.surface)
    out[:] = np.nan
    status = raceway_laws(bundle.laws.raceways, raceway.laws).surface(azimuth, angle, par, out)
    if status != 1 or not abs(out[0]) + abs(out[1]) + abs(out[2]) < np.inf:
        report(scratch.fault, SURFACE, status, raceway.number, azimuth, angle, 0.0, 0.0)
        kin.lift = np.nan
        return
    kin.lift = out[0]
    kin.rise_t = out[1] / rho
    kin.rise_s = out[2] / math.sqrt(axial * axial + radial * radial)


@helper
def near(raceway, system):
    """Return the gap of first forces [m].

    Below it ball and raceway act on each other; films push only where something moves.
    """
    return raceway.reach if system.guides_on == 1 else 0.0


@helper
def contact_kinematics(ball, ring, raceway, kin):
    """Identify the contact of one ball with one raceway.

    Parameters
    ----------
    ball : records.BALL
    ring : records.BODY_STATE
        State of the body that carries the raceway.
    raceway : records.RACEWAY
    kin : records.KINEMATICS
        Result: penetration and velocities, frame, arms, contact angle. What `surface_lift` wrote is taken from it.

    Returns
    -------
    float
        Penetration [m], negative a gap; velocities are written only within the reach of the film. NaN when the surface
        law refused.
    """
    c, s = cosine_sine(ball.azimuth)
    axis, centre, along, across = _from_axis(ball, ring, c, s)
    rho = math.sqrt(across[1] * across[1] + across[0] * across[0] + across[2] * across[2])
    p = across[0] / rho, across[1] / rho, across[2] / rho
    axial, radial = along - raceway.axial_offset, rho - raceway.groove_circle - kin.widening
    length = math.sqrt(axial * axial + radial * radial)
    delta = length + raceway.ball_radius - raceway.groove_radius + kin.lift
    kin.penetration = delta
    kin.axial, kin.radial = axial, radial
    kin.cosine, kin.sine = c, s
    if delta <= -raceway.reach:
        return delta
    na, nr = axial / length, radial / length
    n = add(scale(na, axis), scale(nr, p))
    t = cross(axis, p)
    s_ = cross(n, t)
    reach = raceway.ball_radius - 0.5 * delta
    arm = add(centre, scale(reach, n))
    kin.outward = nr
    if raceway.waves[1] > raceway.waves[0]:
        kin.rise_t -= nr * kin.widening_slope / rho
    _velocities(ball, ring, axis, centre, (c, s), (t, s_, n), (rho, length, nr), reach, arm, kin)
    store(kin.t, t)
    store(kin.s, s_)
    store(kin.n, n)
    kin.reach = reach
    store(kin.arm, arm)
    return delta


@helper
def _velocities(ball, ring, axis, centre, azimuth, frame, lengths, reach, arm, kin):
    """Write the velocities at a contact.

    They are normal, slip, relative rotation and entrainment.
    """
    c, s = azimuth
    t, s_, n = frame
    rho, length, nr = lengths
    ay, az, wy, wz, sigma = ring.tilt[0], ring.tilt[1], ring.tilt_velocity[0], ring.tilt_velocity[1], ring.spin
    # Angular velocity of the ring: across its axis, and with that about it.
    w = turning((-(wy * ay + wz * az) / axis[0], wy, wz), c, s)
    omega = add(w, scale(sigma, axis))
    v = turning(ring.velocity, c, s)
    # Surface velocities at the contact's centre.
    on_ball = add(ball.velocity, scale(reach, cross(ball.spin, n)))
    on_ring = point_velocity(v, omega, arm)
    slip = subtract(on_ball, on_ring)
    kin.slip_t, kin.slip_s = dot(slip, t), dot(slip, s_)
    kin.rotation_t, kin.rotation_s, kin.rotation_n = components(subtract(ball.spin, omega), t, s_, n)
    # Velocity of the contact point itself: it follows the ball's centre round the ring's axis and
    # along the groove; u is the ball centre's velocity in the ring's frame without its spin.
    u = subtract(subtract(ball.velocity, v), cross(w, centre))
    orbit, along = dot(u, t) / rho, dot(u, s_) / length
    turn = cross(w, n)
    point_t = dot(ball.velocity, t) + reach * dot_onto(orbit * nr, turn, t)
    point_s = dot(ball.velocity, s_) + reach * dot_onto(along, turn, s_)
    both = add(on_ball, on_ring)
    kin.entrainment_t = 0.5 * dot(both, t) - point_t
    kin.entrainment_s = 0.5 * dot(both, s_) - point_s
    # A raceway that rises under the ball: the penetration's own rate.
    normal = dot(slip, n) + kin.rise_t * (dot(u, t) - sigma * rho)
    kin.normal_velocity = normal + kin.rise_s * dot(u, s_) - nr * kin.widening_rate


@helper
def touch(ball, ring, raceway, bundle, kin):
    """Return a ball's penetration of a raceway.

    Identifies the contact, on its surface where that is not nominal.

    See contact_kinematics.
    """
    if bundle.system[0].surfaces == 1:
        surface_lift(ball, ring, raceway, bundle, kin)
    return contact_kinematics(ball, ring, raceway, kin)


@helper
def _wrenches(raceway, first, count, bundle):
    return bundle.wrench(
        raceway, first, count, raceway_laws(bundle.laws.raceways, raceway.laws), bundle.par, bundle.system[0],
        bundle.grid, bundle.cells, bundle.scratch[0],
    )  # fmt: skip


@helper
def contact_wrench(raceway, place, bundle):
    """Run the laws of one contact.

    It writes contact and wrench at a place of scratch; return 1, or 0 on a fault.
    """
    return _wrenches(raceway, place, 1, bundle)


@helper
def contact_wrenches(raceway, first, count, bundle):
    """Run the laws of several contacts together.

    It writes contacts and wrenches at their places of scratch.

    Returns 1, or 0 on a fault: scratch.fault names the first contact that has one when it is alone.
    """
    if _wrenches(raceway, first, count, bundle) == 1:
        return 1
    scratch = bundle.scratch[0]
    fault, role = scratch.fault, scratch.fault.role
    for k in range(first, first + count):
        fault.role, fault.ball = -1, scratch.ball[k]
        if count > 1 and _wrenches(raceway, k, 1, bundle) != 1:
            return 0
    fault.role, fault.ball = role, scratch.ball[first]
    return 0


@helper
def contact_angle(kin, raceway):
    """Return the contact angle of an identified contact [rad]."""
    return math.atan2(raceway.side * kin.axial, raceway.side * kin.radial)


@helper
def apply_wrench(kin, wrench, on_ball, on_ring):
    """Turn a contact wrench into force and moment.

    They act on ball and ring, equal and opposite.

    Parameters
    ----------
    wrench : records.WRENCH
        Force and couple on the ball at the contact's centre, axes t, s, n. On a raceway that rises along t and s the
        normal force leans by the slopes; it keeps passing through the ball's centre, on which alone the penetration
        depends.
    on_ball : records.WRENCH
        Added to: force and moment about the ball's centre, axes x, r, t [N, N m].
    on_ring : records.WRENCH
        Set: force and moment about the ring's centre, inertial axes x, y, z [N, N m].
    """
    d, normal = kin.reach, wrench.force[2]
    lean_t, lean_s = normal * kin.rise_t, normal * kin.rise_s
    f = combine((wrench.force[0] + lean_t, wrench.force[1] + lean_s, normal), kin.t, kin.s, kin.n)
    couple = wrench.moment[0] + d * lean_s, wrench.moment[1] - d * lean_t, wrench.moment[2]
    m = combine(couple, kin.t, kin.s, kin.n)
    increase(on_ball.force, f)
    increase(on_ball.moment, add(m, scale(d, cross(kin.n, f))))
    c, s = kin.cosine, kin.sine
    store(on_ring.force, (-f[0], -f[1] * c + f[2] * s, -f[1] * s - f[2] * c))
    store(on_ring.moment, inertial(subtract(negative(m), cross(kin.arm, f)), c, s))
