"""Compute the contact of a roller with its pocket.

At every station the law of the pocket sees how far the roller's axis is from its place, and how fast it moves; the
station has a share of the force that the law has for the whole length. So a roller that skews touches a bar at one end.
The waves of an elastic cage carry all stations of a pocket alike.
"""

from __future__ import annotations

import math

import numpy as np

from lambda_core.solver.cage.cage_waves import carry_pocket, guide_pushes
from lambda_core.solver.cage.guides import (
    guide_energy,
    guide_force,
    guide_loss,
    pocket_apply,
    turning_body,
    write_frame,
)
from lambda_core.solver.layout import guide_law, helper, large_helper, part
from lambda_core.solver.roller.motion import axis_of, from_own
from lambda_core.solver.vec import add, combine, components, cross, inertial, scale, store, subtract

# Gauss-Legendre: exact for forces that grow with the cube along the roller.
STATIONS, SHARES = np.polynomial.legendre.leggauss(4)
SHARES = 0.5 * SHARES


@helper
def _pocket_axes(roller, cage, j, row, g):
    """Write a pocket's axes; return what its stations share.

    They are the middle of the pocket, the roller's middle and velocity, its axis, and the spins of roller and cage.
    """
    axis, omega = turning_body(cage)
    write_frame(axis, cage.angle + row.pocket_phase + 2.0 * math.pi * (j - row.first_ball) / row.balls, g)
    circle = add(scale(row.pocket_circle, g.radial), scale(row.pocket_offset, axis))
    lean, flat = math.sin(row.axis_angle), math.cos(row.axis_angle)
    along = combine((flat, lean, 0.0), g.axial, g.radial, g.tangential)
    across = combine((-lean, flat, 0.0), g.axial, g.radial, g.tangential)
    store(g.axial, along)
    store(g.radial, across)
    c, s = math.cos(roller.azimuth), math.sin(roller.azimuth)
    middle = subtract((roller.x, roller.radius * c, roller.radius * s), cage.position)
    own, spin = inertial(axis_of(roller, row), c, s), inertial(from_own(roller.spin, row), c, s)
    store(g.rotation, components(subtract(spin, omega), g.axial, g.radial, g.tangential))
    return circle, middle, inertial(roller.velocity, c, s), own, spin, omega


@helper
def _station_state(shared, cage, j, row, share, bundle, g):
    """Write a station's state in its pocket.

    It is place and velocity of a station of the roller's axis, along the axes of _pocket_axes.

    `share` is where the station is, -1..1 of half of the length of a bar.
    """
    circle, middle, velocity, own, spin, omega = shared
    x = 0.5 * share * row.bar_length
    arm = scale(x, own)
    store(g.origin, add(circle, scale(x, g.axial)))
    d = add(middle, arm)
    store(g.place, components(subtract(d, g.origin), g.axial, g.radial, g.tangential))
    v = subtract(subtract(add(velocity, cross(spin, arm)), cage.velocity), cross(omega, d))
    store(g.velocity, components(v, g.axial, g.radial, g.tangential))
    if row.waves[1] > row.waves[0]:
        carry_pocket(row.pocket_phase + 2.0 * math.pi * (j - row.first_ball) / row.balls, row, bundle, g)


@helper
def _push_cage(row, scratch):
    """Add a station's push on the cage's waves.

    The sum is that of its pocket; the station's force is in scratch.
    """
    first, last, out = row.waves[0], row.waves[1], scratch.out[:]
    across = out[1]
    out[1] = math.sin(row.axis_angle) * out[0] + math.cos(row.axis_angle) * across
    guide_pushes(first, last, scratch.guide, out, -1.0, scratch.pushes[1])
    out[1] = across
    for i in range(2 * (last - first)):
        scratch.pushes[0, i] += scratch.pushes[1, i]


@large_helper
def pocket_forces(roller, cage, j, row, bundle, on_roller, on_cage):
    """Add a pocket's forces.

    They act on roller (turning frame) and cage (inertial frame); return the power lost [W], or -1.

    Generalised forces on the waves of an elastic cage are left in scratch.pushes[0].
    """
    scratch, viscosity, lost = bundle.scratch[0], row.oil.viscosity, 0.0
    g, out = scratch.guide, scratch.out[:]
    law, par = guide_law(bundle.laws.guides, row.guide_law), part(bundle.par, row.pocket)
    bends = row.waves[1] > row.waves[0]
    if bends:
        scratch.pushes[0, :] = 0.0
    shared = _pocket_axes(roller, cage, j, row, g)
    for i in range(STATIONS.size):
        _station_state(shared, cage, j, row, STATIONS[i], bundle, g)
        if guide_force(law, par, g, viscosity, out, scratch.fault, -1) != 1:
            scratch.fault.ball = j
            return -1.0
        lost += SHARES[i] * max(guide_loss(law, par, g, viscosity, out, scratch.at_rest), 0.0)
        for k in range(3):
            out[k] *= SHARES[i]
        pocket_apply(roller, cage, g, out, on_roller, on_cage)
        if bends:
            _push_cage(row, scratch)
    return lost


@helper
def pocket_energy(roller, cage, j, row, bundle):
    """Return a roller's elastic energy [J].

    It is that of its contact with its pocket.
    """
    scratch, total = bundle.scratch[0], 0.0
    law, par = guide_law(bundle.laws.guides, row.guide_law), part(bundle.par, row.pocket)
    shared = _pocket_axes(roller, cage, j, row, scratch.guide)
    for i in range(STATIONS.size):
        _station_state(shared, cage, j, row, STATIONS[i], bundle, scratch.guide)
        found = guide_energy(law, par, scratch.guide, row.oil.viscosity, scratch.out[:], scratch.at_rest, 0.0)
        total += SHARES[i] * found
    return total
