"""Evaluate the right-hand side and the powers."""

from __future__ import annotations

from lambda_core.solver.contact.ring_waves import turn_waves
from lambda_core.solver.layout import balls_of, helper, losses_of, running_of
from lambda_core.solver.motion.bearing_sums import (
    AGAIN,
    add_bearing_powers,
    clear_again,
    clear_bearing_powers,
    is_bypassed,
    keep_contacts,
    powers_of_bearing,
)
from lambda_core.solver.motion.equations import ball_rates, body_rates
from lambda_core.solver.motion.force_elements import cage_forces, clear_forces, drag_force, land_forces, raceway_forces
from lambda_core.solver.motion.links import link_forces
from lambda_core.solver.motion.prescribed import fill_shared
from lambda_core.solver.motion.structures import structure_forces
from lambda_core.solver.records import ROLLERS
from lambda_core.solver.row_code import CONTACTS, GUIDES, MOTION, roller_code
from lambda_core.solver.vec import cosine_sine, dot, increase, turning


@helper
def _move_ball(ball, j, row, bundle, running, want, rate):
    """Write the accelerations of ball j.

    Add drag and weight to the forces on it first.
    """
    system, wrench = bundle.system[0], bundle.ball_wrenches[j]
    if row.drag_on == 1 and system.friction_on == 1:
        lost = drag_force(ball, row, bundle, wrench)
        if lost < -0.5:
            bundle.scratch[0].fault.ball = j
            return 0
        running.drag += lost
    c, s = cosine_sine(ball.azimuth)
    m, g = row.ball_mass, turning(system.gravity, c, s)
    weight = m * g[0], m * g[1], m * g[2]
    increase(wrench.force, weight)
    if want == 1:
        running.input += dot(weight, ball.velocity)
    ball_rates(ball, wrench, row, rate)
    return 1


@helper
def _move_bodies(bundle, running, want, dydt):
    """Write the rates of bodies and contacts.

    They are those of free states of the bodies, and of states of contacts.
    """
    active, base = bundle.active, bundle.system[0].tail
    for b in range(bundle.bodies.size):
        if bundle.bodies[b].moves == 0:
            continue
        external, drive, support = body_rates(
            bundle.bodies[b], bundle.bodies_now[b], bundle.body_wrenches[b], bundle.inputs[b],
            bundle.system[0].gravity, bundle.body_rates[b],
        )  # fmt: skip
        if want == 1:
            running.input += external
            running.drive += drive
            if bundle.bodies[b].is_wave == 1:
                running.bending += support
            else:
                running.support += support
    for k in range(active.size):
        dydt[base + k] = bundle.shared_rates[active[k]]
    base += active.size
    for k in range(bundle.states.size):
        dydt[base + k] = bundle.state_rates[k]


@helper
def _raceways(t, y, bundle, dydt, rates, want):
    """Begin sums with the raceways' share.

    The sums of forces and powers.
    """
    losses = losses_of(rates, bundle.raceways.size)
    if want == AGAIN:
        clear_again(bundle, rates)
    else:
        clear_forces(bundle)
        rates[:] = 0.0
    for r in range(bundle.rows.size):
        row = bundle.rows[r]
        if is_bypassed(row.bearing, bundle, want):
            continue
        if row.kind == ROLLERS:
            if roller_code(bundle.rollers, 0).evaluate(CONTACTS, t, y, r, bundle, dydt, rates, want) != 1:
                return 0
            continue
        if raceway_forces(t, balls_of(y, row), row, bundle, losses, min(want, 1)) != 1:
            return 0
    return 1


@helper
def _guides(t, y, bundle, dydt, rates, want):
    """Add the forces of pockets and lands."""
    running = running_of(rates)[0]
    for r in range(bundle.rows.size):
        row = bundle.rows[r]
        if is_bypassed(row.bearing, bundle, want):
            continue
        if row.kind == ROLLERS:
            if roller_code(bundle.rollers, 0).evaluate(GUIDES, t, y, r, bundle, dydt, rates, want) != 1:
                return 0
            continue
        own = powers_of_bearing(bundle, row.bearing, running)
        if cage_forces(balls_of(y, row), row, bundle, own, min(want, 1)) != 1:
            return 0
    return land_forces(bundle, running, want)


def evaluate(t, y, bundle, dydt, rates, want):
    """Write dy/dt.

    With `want` = 1 it also writes the powers and rates of the running integrals. It is an entry point.

    Parameters
    ----------
    t : float
        Time [s].
    y, dydt : float64[:], shape (9 Z + n_active + states of contacts,)
    rates : float64[:], shape (powers,)
        Losses of the raceways by mechanism (layout.Losses) [W], then records.RUNNING.
    want : int
        0, 1; or 2: as 1, and the raceways' share of the forces (bundle.ball_wrenches, bundle.body_wrenches) and of
        `rates` is there already, left by a caller that has gone through them itself; or 3: as 1, and of bearings that
        rest (bundle.bypassed) forces, powers and rates of the last evaluation stand.

    Returns
    -------
    int
        1 when every kernel was well; otherwise 0 and scratch.fault says which was not.
    """
    system = bundle.system[0]
    bundle.scratch[0].fault.role = -1
    running = running_of(rates)[0]
    if fill_shared(t, y, bundle) != 1:
        return 0
    if want != 2 and _raceways(t, y, bundle, dydt, rates, want) != 1:
        return 0
    if want != AGAIN:
        clear_bearing_powers(bundle)
    if system.guides_on == 1 and _guides(t, y, bundle, dydt, rates, want) != 1:
        return 0
    keep_contacts(bundle)
    if link_forces(t, bundle, running) != 1:
        return 0
    structure_forces(bundle, running)
    turn_waves(bundle)
    for r in range(bundle.rows.size):
        row = bundle.rows[r]
        if is_bypassed(row.bearing, bundle, want):
            continue
        if row.kind == ROLLERS:
            if roller_code(bundle.rollers, 0).evaluate(MOTION, t, y, r, bundle, dydt, rates, want) != 1:
                return 0
            continue
        own = powers_of_bearing(bundle, row.bearing, running)
        balls, moved = balls_of(y, row), balls_of(dydt, row)
        for i in range(row.balls):
            if _move_ball(balls[i], row.first_ball + i, row, bundle, own, min(want, 1), moved[i]) != 1:
                return 0
    want = min(want, 1)
    add_bearing_powers(bundle, running)
    _move_bodies(bundle, running, want, dydt)
    if want == 1:
        running.input_abs = abs(running.input)
        running.relative_speed = abs(bundle.bodies_now[0].spin - bundle.bodies_now[1].spin)
        for i in range(3):
            running.position[i] = bundle.bodies_now[0].position[i]
    return 1
