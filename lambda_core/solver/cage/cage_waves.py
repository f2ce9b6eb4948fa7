"""Move pockets and guides of elastic cages.

Guides load the waves of the cage.

A cage bends in its plane as an elastic ring does (contact.ring_waves): w = sum of c_n cos(n a) + s_n sin(n a) outwards
and, since its circumference keeps its length, v = sum of (-c_n sin(n a) + s_n cos(n a))/n along it, a the azimuth in
the cage's material. Pockets are carried by both, their axes keep the direction of the rigid cage; the generalised
forces are the same shapes times the force, so that the work on a guide is that on all bodies together.
"""

from __future__ import annotations

import math

from lambda_core.solver.contact.ring_waves import add_pushes
from lambda_core.solver.layout import helper
from lambda_core.solver.vec import add, cross, store

_SCAN = 8  # places per wave of the highest order at which the narrowest gap of a land is looked for
_NEWTON, _FOUND = 20, 1e-14  # iterations from there on, and the last step that ends them [rad]


@helper
def _displacement(first, last, cosine, sine, bundle):
    """Return displacements and rates at an azimuth.

    They point outwards and along the circumference, in the material.
    """
    c, s, order = cosine, sine, 1.0
    w, v, w_rate, v_rate = 0.0, 0.0, 0.0, 0.0
    for i in range(first, last):
        c, s = c * cosine - s * sine, s * cosine + c * sine
        order += 1.0
        now = bundle.bodies_now[bundle.waves[i].body]
        w += now.position[1] * c + now.position[2] * s
        v += (now.position[2] * c - now.position[1] * s) / order
        w_rate += now.velocity[1] * c + now.velocity[2] * s
        v_rate += (now.velocity[2] * c - now.velocity[1] * s) / order
    return w, v, w_rate, v_rate


@helper
def carry_pocket(azimuth, row, bundle, g):
    """Move a pocket with the cage's waves.

    The pocket is at an azimuth in the cage's material; that of a tapered roller leans by the row's axis_angle.
    """
    lean, flat = math.sin(row.axis_angle), math.cos(row.axis_angle)  # of outwards, along the pocket's axes
    g.wave_cosine, g.wave_sine = math.cos(azimuth), math.sin(azimuth)
    g.facing_radial, g.facing_tangential = 1.0, 0.0
    w, v, w_rate, v_rate = _displacement(row.waves[0], row.waves[1], g.wave_cosine, g.wave_sine, bundle)
    g.place[0] -= lean * w
    g.place[1] -= flat * w
    g.place[2] -= v
    g.velocity[0] -= lean * w_rate
    g.velocity[1] -= flat * w_rate
    g.velocity[2] -= v_rate
    for i in range(3):
        g.origin[i] += w * (lean * g.axial[i] + flat * g.radial[i]) + v * g.tangential[i]


@helper
def _outline(first, last, azimuth, bundle):
    """Return the outward displacement at an azimuth.

    It holds in the material; also return its first two derivatives [m].
    """
    w, slope, bend, order = 0.0, 0.0, 0.0, 1.0
    for i in range(first, last):
        order += 1.0
        now = bundle.bodies_now[bundle.waves[i].body]
        c, s = math.cos(order * azimuth), math.sin(order * azimuth)
        w += now.position[1] * c + now.position[2] * s
        slope += order * (now.position[2] * c - now.position[1] * s)
        bend -= order * order * (now.position[1] * c + now.position[2] * s)
    return w, slope, bend


@helper
def _narrowest(land, y, z, turned, bundle):
    """Return the azimuth of the narrowest gap.

    It holds in the ring's frame. The cage is off the ring's axis by y, z, against the land.

    The way towards the land, side (y cos + z sin + w), is largest there: looked for from place to place and then by
    Newton's method. Of a cage more oval than its clearance only the nearest of its contacts with the land is found.
    """
    first, last, side = land.waves[0], land.waves[1], land.side
    places = _SCAN * (last - first + 1)
    start = math.atan2(side * z, side * y)
    found, best = start, -math.inf
    for k in range(places):
        at = start + 2.0 * math.pi * k / places
        w, _, _ = _outline(first, last, at - turned, bundle)
        near = side * (y * math.cos(at) + z * math.sin(at) + w)
        if near > best:
            found, best = at, near
    for _ in range(_NEWTON):
        c, s = math.cos(found), math.sin(found)
        _, slope, bend = _outline(first, last, found - turned, bundle)
        curved = side * (bend - y * c - z * s)
        if curved >= 0.0:
            break
        step = side * (z * c - y * s + slope) / curved
        found -= step
        if abs(step) < _FOUND:
            break
    return found


@helper
def carry_land(land, cage, bundle, g):
    """Turn a wavy cage into a round one.

    It has place and velocity at a station of the land; the round cage touches alike.

    It comes as near, at the azimuth where the bent one comes nearest, and its surface there has the same velocity.
    """
    y, z = g.place[1], g.place[2]
    at = _narrowest(land, y, z, cage.angle, bundle)
    c, s = math.cos(at), math.sin(at)
    g.wave_cosine, g.wave_sine = math.cos(at - cage.angle), math.sin(at - cage.angle)
    g.facing_radial, g.facing_tangential = c, s
    w, _, w_rate, v_rate = _displacement(land.waves[0], land.waves[1], g.wave_cosine, g.wave_sine, bundle)
    near = y * c + z * s + w
    shift = 0.0, near * c - y, near * s - z
    elastic = 0.0, w_rate * c - v_rate * s, w_rate * s + v_rate * c
    store(g.velocity, add(add(g.velocity, cross(g.rotation, shift)), elastic))
    store(g.place, (g.place[0], near * c, near * s))


@helper
def guide_pushes(first, last, g, out, sign, pushes):
    """Write a guide's forces on the waves.

    Generalised forces on its cage, cosine and sine in turn [N].

    Parameters
    ----------
    first, last : int
        The cage's waves.
    out : float64[:]
        The force that the guide's law wrote, in the guide's frame.
    sign : float
        1 where it acts on the cage, -1 where on a ball.
    pushes : float64[:]
        Result.
    """
    outwards = sign * (out[1] * g.facing_radial + out[2] * g.facing_tangential)
    along = sign * (out[2] * g.facing_radial - out[1] * g.facing_tangential)
    c, s, order = g.wave_cosine, g.wave_sine, 1.0
    for i in range(last - first):
        c, s = c * g.wave_cosine - s * g.wave_sine, s * g.wave_cosine + c * g.wave_sine
        order += 1.0
        pushes[2 * i] = outwards * c - along * s / order
        pushes[2 * i + 1] = outwards * s + along * c / order


@helper
def push_cage(first, last, sign, bundle):
    """Add the guide in scratch to wave forces.

    They act on the waves of its cage.
    """
    scratch = bundle.scratch[0]
    pushes = scratch.out[6:]  # behind the force
    guide_pushes(first, last, scratch.guide, scratch.out[:], sign, pushes)
    add_pushes(first, last, pushes, bundle)
