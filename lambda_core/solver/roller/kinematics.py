"""Find contacts of a roller and their velocities.

Raceways and ribs are cones about the axis of their body, rollers are cones whose end faces are spheres about a point of
their axis. Vectors have the components x, r, t of the frame that turns with the roller's azimuth.
"""

from __future__ import annotations

import math

from lambda_core.solver.contact.contact_kinematics import axis_x, azimuth_on
from lambda_core.solver.contact.ring_waves import widen
from lambda_core.solver.layout import helper, large_helper
from lambda_core.solver.roller.motion import axis_of, from_own
from lambda_core.solver.vec import (
    add,
    combine,
    components,
    cross,
    dot,
    increase,
    inertial,
    length,
    negative,
    point_velocity,
    scale,
    store,
    subtract,
    turning,
)


@helper
def centre_from(roller, ring):
    """Return a roller's centre from a ring's.

    Return cosine and sine of the roller's azimuth, the ring's axis, and the centre.
    """
    c, s = math.cos(roller.azimuth), math.sin(roller.azimuth)
    ay, az = ring.tilt[0], ring.tilt[1]
    x, r, aside = turning(ring.position, c, s)
    return c, s, turning((axis_x(ay, az), ay, az), c, s), (roller.x - x, roller.radius - r, -aside)


@helper
def _outwards(place, axis):
    """Return a place along and off an axis.

    Return distance along the axis, distance from it, and the unit vector away from it.
    """
    along = dot(place, axis)
    across = subtract(place, scale(along, axis))
    far = length(across)
    return along, far, scale(1.0 / far, across)


@helper
def bend_ring(roller, ring, raceway, bundle, kin):
    """Look up an elastic ring's waves at a roller.

    `line_kinematics` and `rib_kinematics` take them: call this first.

    The whole roller is where its centre is on the circumference; all of the ring's section moves outwards alike.
    """
    kin.widening, kin.widening_slope, kin.widening_rate = 0.0, 0.0, 0.0
    if raceway.waves[1] == raceway.waves[0]:
        return
    c, s, axis, centre = centre_from(roller, ring)
    across = subtract(centre, scale(dot(centre, axis), axis))
    widen(raceway, azimuth_on(ring, across, c, s), bundle, kin)


@helper
def _write(roller, ring, row, azimuth, axis, centre, lever, frame, slope, kin):
    """Write frame, arms and velocities.

    The contact is at `lever` from the roller's centre.

    `slope` is the direction along the contact in which entrainment changes, a unit vector. The contact follows the
    roller's centre round the ring's axis.

    A roller that tilts in its contact keeps its rolling radius: what carries is its own surface, flattened, and its
    material passes with the speed of the undeformed generatrix (Johnson, Contact Mechanics, 1985, section 8.1: rigid
    velocities of undeformed surfaces, and strains, which two alike bodies share). So the slip along rolling changes
    along the line with (spin x generatrix) t, not with the spin about the normal alone, of which rolling on a tilted
    axis is a part.
    """
    c, s = azimuth
    t, s_, n = frame
    ay, az, wy, wz = ring.tilt[0], ring.tilt[1], ring.tilt_velocity[0], ring.tilt_velocity[1]
    w = turning((-(wy * ay + wz * az) / axis_x(ay, az), wy, wz), c, s)
    omega, v = add(w, scale(ring.spin, axis)), turning(ring.velocity, c, s)
    spin, arm = from_own(roller.spin, row), add(centre, lever)
    on_roller, on_ring = point_velocity(roller.velocity, spin, lever), point_velocity(v, omega, arm)
    slip = subtract(on_roller, on_ring)
    kin.slip_t, kin.slip_s = dot(slip, t), dot(slip, s_)
    u = subtract(subtract(roller.velocity, v), cross(w, centre))
    _, rho, p = _outwards(centre, axis)
    turn = add(w, scale(dot(u, t) / rho, axis))  # of the contact about the ring's centre
    kin.rotation_t, kin.rotation_s, drilling = components(subtract(spin, omega), t, s_, n)
    kin.rotation_n = drilling - kin.line_tilt * dot(subtract(spin, turn), s_)
    point, both = point_velocity(roller.velocity, turn, lever), add(on_roller, on_ring)
    kin.entrainment_t = 0.5 * dot(both, t) - dot(point, t)
    kin.entrainment_s = 0.5 * dot(both, s_) - dot(point, s_)
    kin.entrainment_slope = dot(cross(subtract(scale(0.5, add(spin, omega)), turn), slope), t)
    kin.normal_velocity, kin.line_tilt_rate = dot(slip, n), kin.rotation_t
    store(kin.t, t)
    store(kin.s, s_)
    store(kin.n, n)
    store(kin.arm, arm)
    kin.axial, kin.radial, kin.outward = dot(n, axis), dot(n, p), dot(n, p)
    kin.cosine, kin.sine = c, s
    kin.lift, kin.rise_t, kin.rise_s = 0.0, -kin.outward * kin.widening_slope / rho, 0.0
    kin.normal_velocity += kin.rise_t * (dot(u, t) - ring.spin * rho) - kin.outward * kin.widening_rate


@helper
def line_kinematics(roller, ring, row, raceway, kin):
    """Return the approach of a line contact [m].

    It is that of a roller's contact with a raceway, at its middle, without profile.

    The roller's generatrix that is nearest to the raceway and the raceway's lie in one plane but for a skew, whose
    effect on the gap is of the second order (x^2 skew^2/(2 R), a nanometre for 1 mrad).
    """
    c, s, axis, centre = centre_from(roller, ring)
    _, _, p = _outwards(centre, axis)
    slant, flat = math.sin(raceway.cone), math.cos(raceway.cone)
    n = scale(raceway.side, subtract(scale(flat, p), scale(slant, axis)))
    t = cross(axis, p)
    s_ = cross(n, t)
    own = axis_of(roller, row)
    towards = subtract(n, scale(dot(n, own), own))
    towards = scale(1.0 / length(towards), towards)
    lever = scale(row.ball_radius, towards)
    along, far, _ = _outwards(add(centre, lever), axis)
    above = far - raceway.groove_circle - kin.widening
    delta = raceway.side * (above * flat - (along - raceway.axial_offset) * slant)
    generatrix = add(scale(math.cos(row.cone_angle), own), scale(math.sin(row.cone_angle), towards))
    sign = 1.0 if dot(generatrix, s_) > 0.0 else -1.0
    kin.penetration, kin.line_tilt, kin.reach = delta, sign * dot(n, generatrix), row.ball_radius
    _write(roller, ring, row, (c, s), axis, centre, lever, (t, s_, n), s_, kin)
    kin.line_skew = sign * dot(own, t)
    return delta


@helper
def rib_kinematics(roller, ring, row, raceway, kin):
    """Return the penetration of a rib contact [m].

    Identifies the contact of a roller's end, a sphere, with a rib, a cone.
    """
    c, s, axis, centre = centre_from(roller, ring)
    own, end = axis_of(roller, row), row.end_radius
    middle = scale(raceway.side * (0.5 * row.total_length - end), own)  # of the sphere, from the roller's centre
    along, far, p = _outwards(add(centre, middle), axis)
    n = scale(raceway.side, add(scale(math.cos(raceway.rib_angle), axis), scale(math.sin(raceway.rib_angle), p)))
    t = cross(axis, p)
    gap = raceway.side * (
        (along - raceway.axial_offset) * math.cos(raceway.rib_angle)
        + (far - raceway.rib_radius - kin.widening) * math.sin(raceway.rib_angle)
    )
    delta = gap + end
    lever = add(middle, scale(end, n))
    kin.penetration, kin.line_tilt, kin.reach = delta, 0.0, end
    _write(roller, ring, row, (c, s), axis, centre, lever, (t, cross(n, t), n), t, kin)
    return delta


@large_helper
def apply_roller_wrench(kin, roller, ring, wrench, on_roller, on_ring):
    """Turn a contact wrench into force and moment.

    They act on roller and ring, equal and opposite.

    As contact_kinematics.apply_wrench, for contacts that are not on the normal through the centre. `on_roller` is added
    to, `on_ring` set. Where the raceway rises along t, what leans passes through the roller's centre, by whose azimuth
    alone it rises.
    """
    _, _, _, centre = centre_from(roller, ring)
    f = combine(wrench.force, kin.t, kin.s, kin.n)
    m = combine(wrench.moment, kin.t, kin.s, kin.n)
    lever = subtract(kin.arm, centre)
    if kin.rise_t != 0.0:
        lean = scale(wrench.force[2] * kin.rise_t, kin.t)
        f, m = add(f, lean), subtract(m, cross(lever, lean))
    increase(on_roller.force, f)
    increase(on_roller.moment, add(m, cross(lever, f)))
    c, s = kin.cosine, kin.sine
    store(on_ring.force, inertial(negative(f), c, s))
    store(on_ring.moment, inertial(subtract(negative(m), cross(kin.arm, f)), c, s))
