"""Compute force elements with a law between bodies."""

from __future__ import annotations

import numpy as np

from lambda_core.solver.arrays.bundle import NS
from lambda_core.solver.arrays.fault_roles import FORCE_ELEMENT
from lambda_core.solver.cage.guides import turning_body, write_frame
from lambda_core.solver.faults import report
from lambda_core.solver.layout import helper, link_law, part
from lambda_core.solver.motion.steps import add_slope, body_step
from lambda_core.solver.records import BODY_STATE
from lambda_core.solver.vec import add, clear, combine, cross, decrease, dot, increase, store, subtract


@helper
def _point(body, place, g):
    """Return a point, axis and angular velocity.

    A point of a body from the body's centre, the body's axis, inertial.
    """
    axis, omega = turning_body(body)
    write_frame(axis, body.angle, g)
    return combine(place, g.axial, g.radial, g.tangential), axis, omega


@helper
def link_state(link, first, second, g):
    """Write the second point's relative state.

    Place, velocity and angular velocity are seen from the first body, in inertial axes.

    The velocity is that against the material of the first body at the same place. g.axial becomes the tilt of one axis
    against the other, g.origin the second point from the second body's centre.
    """
    arm_1, axis_1, omega_1 = _point(first, link.first_place, g)
    arm_2, axis_2, omega_2 = _point(second, link.second_place, g)
    store(g.axial, cross(axis_1, axis_2))
    apart = subtract(add(add(second.position, link.apart), arm_2), first.position)
    store(g.origin, arm_2)
    store(g.place, subtract(apart, arm_1))
    carried = add(first.velocity, cross(omega_1, apart))
    store(g.velocity, subtract(add(second.velocity, cross(omega_2, arm_2)), carried))
    store(g.rotation, subtract(omega_2, omega_1))


@helper
def link_wrench(t, link, bundle, g):
    """Call an element's law on a guide record.

    The law writes scratch.out = force[3], couple[3] on the second body; return 1 when well.
    """
    scratch = bundle.scratch[0]
    out = scratch.out[:]
    out[:6] = np.nan
    law, par = link_law(bundle.laws.links, link.law), part(bundle.par, link.parameters)
    status = law(t, g.place[:], g.axial[:], g.velocity[:], g.rotation[:], par, out)
    total = 0.0
    for i in range(6):
        total += abs(out[i])
    if status != 1 or not total < np.inf:
        return report(scratch.fault, FORCE_ELEMENT, status, link.number, t, g.place[0], g.place[1], g.place[2])
    return 1


@helper
def link_apply(link, first, second, g, out, on_first, on_second):
    """Add an element's wrench to its bodies.

    It acts equally and oppositely, at the second point.
    """
    force, couple = (out[0], out[1], out[2]), (out[3], out[4], out[5])
    increase(on_second.force, force)
    increase(on_second.moment, add(couple, cross(g.origin, force)))
    arm = subtract(add(add(second.position, link.apart), g.origin), first.position)
    decrease(on_first.force, force)
    decrease(on_first.moment, add(couple, cross(arm, force)))


@helper
def _carrier(number, bundle):
    """Return the state of a body or ground.

    The ground is at the origin.
    """
    return bundle.ground[0] if number < 0 else bundle.bodies_now[number]


@helper
def link_forces(t, bundle, running):
    """Add every element and its power.

    The power comes from outside; return 1 when well.
    """
    scratch = bundle.scratch[0]
    g, out = scratch.guide, scratch.out[:]
    for i in range(bundle.links.size):
        link = bundle.links[i]
        first, second = _carrier(link.first, bundle), bundle.bodies_now[link.second]
        link_state(link, first, second, g)
        if link_wrench(t, link, bundle, g) != 1:
            return 0
        on_first = scratch.on_ground if link.first < 0 else bundle.body_wrenches[link.first]
        link_apply(link, first, second, g, out, on_first, bundle.body_wrenches[link.second])
        running.input += dot((out[0], out[1], out[2]), g.velocity) + dot((out[3], out[4], out[5]), g.rotation)
    return 1


@helper
def _link_columns(t, link, bundle, bl):
    """Add the slopes of one element.

    They are differences of its law.
    """
    scratch, fm = bundle.scratch[0], bl.wrenches
    first, second = _carrier(link.first, bundle), bundle.bodies_now[link.second]
    g, out = scratch.guide, scratch.out[:]
    near_first, near_second = bl.body.view(BODY_STATE), bl.body2.view(BODY_STATE)
    link_state(link, first, second, g)
    if link_wrench(t, link, bundle, g) != 1:
        return 0
    clear(fm[0])
    clear(fm[1])
    link_apply(link, first, second, g, out, fm[0], fm[1])
    for k in range(NS if link.first < 0 else 0, 2 * NS):  # the ground does not move
        c = k % NS
        column = NS * link.first + c if k < NS else NS * link.second + c
        if bl.index[column] < 0:
            continue
        step = body_step(c, True)
        near_first[0] = first
        near_second[0] = second
        if k < NS:
            bl.body[c] += step
        else:
            bl.body2[c] += step
        link_state(link, near_first[0], near_second[0], g)
        if link_wrench(t, link, bundle, g) != 1:
            return 0
        clear(fm[2])
        clear(fm[3])
        link_apply(link, near_first[0], near_second[0], g, out, fm[2], fm[3])
        if link.first >= 0:
            add_slope(bl.shared[link.first], column, fm[2], fm[0], step)
        add_slope(bl.shared[link.second], column, fm[3], fm[1], step)
    return 1


@helper
def link_columns(t, bundle, bl):
    """Add every element."""
    for i in range(bundle.links.size):
        if _link_columns(t, bundle.links[i], bundle, bl) != 1:
            return 0
    return 1
