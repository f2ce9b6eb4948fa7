"""Compute the contact of two neighbouring rollers without a cage.

At every station, a plane across the mean of both axes, the law sees how far one axis is from the other, and how fast it
moves; the station has a share of the force that the law has for the whole length. So rollers that skew or tilt against
each other touch at one end.

Tapered rollers have another radius at every station. Their cones have one apex, so that they touch along a line whose
normal lies across the plane of symmetry: the law, which knows the mean radius, sees both axes moved along it by what
the radius differs.
"""

from __future__ import annotations

import math

from lambda_core.solver.cage.guides import force_and_point, guide_energy, guide_force, guide_loss, neighbour_apply
from lambda_core.solver.layout import guide_law, helper, large_helper, part
from lambda_core.solver.roller.motion import axis_of, from_own
from lambda_core.solver.roller.pocket import SHARES, STATIONS
from lambda_core.solver.vec import (
    add,
    components,
    cosine_sine,
    cross,
    dot,
    inertial,
    length,
    point_velocity,
    scale,
    store,
    subtract,
)


@helper
def _centre(roller):
    """Return the centre of a roller, inertial."""
    c, s = cosine_sine(roller.azimuth)
    return roller.x, roller.radius * c, roller.radius * s


@helper
def _moves(roller, row):
    """Return axis, velocity and angular velocity of a roller, inertial."""
    c, s = cosine_sine(roller.azimuth)
    spin = inertial(from_own(roller.spin, row), c, s)
    return inertial(axis_of(roller, row), c, s), inertial(roller.velocity, c, s), spin


@helper
def _station_state(roller, other, row, share, g):
    """Write a station's place and velocity from the neighbour's.

    Along axes of the pair. `share` is where the station is, -1..1 of half of the length that touches. Both axes are met
    in the plane across their mean at that distance from the middle of both centres.
    """
    own, v, spin = _moves(roller, row)
    its, u, turn = _moves(other, row)
    centre, other_centre = _centre(roller), _centre(other)
    apart, mean, axis = subtract(centre, other_centre), add(centre, other_centre), add(own, its)
    axis = scale(1.0 / length(axis), axis)
    outward = subtract(mean, scale(dot(mean, axis), axis))
    outward = scale(1.0 / length(outward), outward)
    store(g.axial, axis)
    store(g.radial, outward)
    store(g.tangential, cross(axis, outward))
    half, x = 0.5 * dot(apart, axis), 0.5 * share * row.bar_length
    arm = scale((x - half) / dot(own, axis), own)
    lever = scale((x + half) / dot(its, axis), its)
    place = add(apart, subtract(arm, lever))
    wider = scale(-x * math.tan(row.cone_angle) / length(place), place)  # radius beyond the mean, towards the other
    store(g.origin, subtract(lever, wider))
    store(g.place, components(add(place, scale(2.0, wider)), g.axial, g.radial, g.tangential))
    moved = subtract(point_velocity(v, spin, add(arm, wider)), point_velocity(u, turn, add(add(lever, place), wider)))
    store(g.velocity, components(moved, g.axial, g.radial, g.tangential))
    store(g.rotation, components(subtract(spin, turn), g.axial, g.radial, g.tangential))


@helper
def _apply(roller, other, g, out, share, on_roller, on_other):
    """Add a share of a station's force to both rollers.

    The forces are equal and opposite, in their turning frames.
    """
    force, lever = force_and_point(g, out)
    arm = subtract(lever, subtract(_centre(roller), _centre(other)))
    neighbour_apply(roller.azimuth, arm, force, share, on_roller)
    neighbour_apply(other.azimuth, lever, force, -share, on_other)


@large_helper
def neighbour_forces(roller, other, j, row, bundle, on_roller, on_other):
    """Add the forces of roller j and the next.

    They act on both, in their turning frames. Return the power lost [W], or -1.
    """
    scratch, viscosity, lost = bundle.scratch[0], row.oil.viscosity, 0.0
    g, out = scratch.guide, scratch.out[:]
    law, par = guide_law(bundle.laws.guides, row.guide_law), part(bundle.par, row.pocket)
    for i in range(STATIONS.size):
        _station_state(roller, other, row, STATIONS[i], g)
        if guide_force(law, par, g, viscosity, out, scratch.fault, -1) != 1:
            scratch.fault.ball = j
            return -1.0
        lost += SHARES[i] * max(guide_loss(law, par, g, viscosity, out, scratch.at_rest), 0.0)
        _apply(roller, other, g, out, SHARES[i], on_roller, on_other)
    return lost


@helper
def neighbour_energy(roller, other, row, bundle):
    """Return the elastic energy of two neighbouring rollers [J]."""
    scratch, total = bundle.scratch[0], 0.0
    g, law, par = scratch.guide, guide_law(bundle.laws.guides, row.guide_law), part(bundle.par, row.pocket)
    for i in range(STATIONS.size):
        _station_state(roller, other, row, STATIONS[i], g)
        free = max(1.0, 2.0 * row.ball_radius / length(g.place))
        total += SHARES[i] * guide_energy(law, par, g, row.oil.viscosity, scratch.out[:], scratch.at_rest, free)
    return total
