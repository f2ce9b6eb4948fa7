"""Evaluate rows of rollers.

Right-hand side, samples and energies; entry points of their own, called by pointer.
"""

from __future__ import annotations

import math

import numba
import numpy as np

from lambda_core.solver.arrays.bundle import MECHANISMS, NR
from lambda_core.solver.contact.contact_kinematics import contact_angle, contact_wrench, near
from lambda_core.solver.contact.dissipation import raceway_losses
from lambda_core.solver.contact.ring_waves import add_pushes, push_waves
from lambda_core.solver.layout import cells_of, grid_of, helper, large_helper, losses_of, running_of
from lambda_core.solver.motion.bearing_sums import powers_of_bearing
from lambda_core.solver.motion.energy import contact_energy
from lambda_core.solver.motion.force_elements import drag_force
from lambda_core.solver.records import CONTACT_SAMPLE, LINE, ROLLER
from lambda_core.solver.roller.capacitance import in_series, loaded_capacitance, open_line
from lambda_core.solver.roller.kinematics import apply_roller_wrench, bend_ring, line_kinematics, rib_kinematics
from lambda_core.solver.roller.line import closest, line_energy, line_losses, line_wrench
from lambda_core.solver.roller.motion import from_own, roller_energy, roller_rates
from lambda_core.solver.roller.neighbours import neighbour_energy, neighbour_forces
from lambda_core.solver.roller.pocket import pocket_energy, pocket_forces
from lambda_core.solver.row_code import CONTACTS, GUIDES, POCKETS
from lambda_core.solver.vec import clear, dot, increase, store, turning


@numba.njit(inline="always")
def rollers_of(y, row):
    """Return the rollers of a row.

    They are a view of a state vector, as a table of records.ROLLER.
    """
    return y[row.first_state : row.first_state + NR * row.balls].view(ROLLER)


@large_helper
def touch_roller(roller, ring, row, raceway, bundle, kin):
    """Return the approach of a roller.

    It is that of the nearest point of a contact; a negative one is a gap [m].
    """
    bend_ring(roller, ring, raceway, bundle, kin)
    if raceway.kind == LINE:
        line_kinematics(roller, ring, row, raceway, kin)
        return closest(raceway, kin, bundle)
    return rib_kinematics(roller, ring, row, raceway, kin)


@large_helper
def roller_wrench(raceway, place, bundle):
    """Run the laws of a contact.

    They write to a place of scratch; return 1, or 0 on a fault.
    """
    if raceway.kind == LINE:
        return line_wrench(raceway, place, bundle)
    return contact_wrench(raceway, place, bundle)


@helper
def _wrench_here(raceway, j, bundle):
    """Run the laws of the contact in scratch."""
    if roller_wrench(raceway, 0, bundle) != 1:
        bundle.scratch[0].fault.ball = j
        return 0
    return 1


@helper
def _add_contact(raceway, roller, ring, j, bundle):
    """Add the contact's wrench to forces.

    It is in scratch; the forces on roller j and on the raceway's body take it.
    """
    scratch, on_body = bundle.scratch[0], bundle.body_wrenches[raceway.body]
    apply_roller_wrench(
        scratch.kinematics[0], roller, ring, scratch.wrench[0], bundle.ball_wrenches[j], scratch.on_ring
    )
    increase(on_body.force, scratch.on_ring.force)
    increase(on_body.moment, scratch.on_ring.moment)
    if raceway.waves[1] > raceway.waves[0]:
        push_waves(raceway, 0, bundle)


@helper
def _add_losses(raceway, bundle, losses):
    """Add what the contact in scratch dissipates."""
    if raceway.kind == LINE:
        line_losses(raceway, bundle, losses)
        return
    scratch = bundle.scratch[0]
    raceway_losses(
        raceway, scratch.kinematics[0], bundle.system[0], grid_of(bundle.grid), scratch.contact[0],
        cells_of(bundle.cells, 0, 1, bundle.grid.shape[1]), losses,
    )  # fmt: skip


@helper
def _contacts(rollers, row, bundle, losses, want):
    """Add the raceway contacts of a row."""
    system, kin = bundle.system[0], bundle.scratch[0].kinematics[0]
    for i in range(row.balls):
        j = row.first_ball + i
        for k in range(row.first_raceway, row.first_raceway + row.raceways):
            raceway = bundle.raceways[k]
            ring = bundle.bodies_now[raceway.body]
            delta = touch_roller(rollers[i], ring, row, raceway, bundle, kin)
            if delta <= -near(raceway, system):
                continue
            if not delta < np.inf or _wrench_here(raceway, j, bundle) != 1:
                bundle.scratch[0].fault.ball = j
                return 0
            _add_contact(raceway, rollers[i], ring, j, bundle)
            if want == 1 and system.friction_on == 1:
                _add_losses(raceway, bundle, losses)
    return 1


@helper
def _pockets(rollers, row, bundle, own, want):
    """Add the pockets of a row."""
    cage, on_cage = bundle.bodies_now[row.cage], bundle.body_wrenches[row.cage]
    for i in range(row.balls):
        j = row.first_ball + i
        lost = pocket_forces(rollers[i], cage, j, row, bundle, bundle.ball_wrenches[j], on_cage)
        if lost < -0.5:
            return 0
        add_pushes(row.waves[0], row.waves[1], bundle.scratch[0].pushes[0], bundle)
        if want == 1:
            own.pocket += lost
    return 1


@helper
def _neighbours(rollers, row, bundle, own, want):
    """Add the contacts of neighbouring rollers.

    They are those of a row without a cage.
    """
    for i in range(row.balls):
        j, k = row.first_ball + i, (i + 1) % row.balls
        on_next = bundle.ball_wrenches[row.first_ball + k]
        lost = neighbour_forces(rollers[i], rollers[k], j, row, bundle, bundle.ball_wrenches[j], on_next)
        if lost < -0.5:
            return 0
        if want == 1:
            own.land += lost
    return 1


@large_helper
def roller_drag(roller, row, bundle, on_roller):
    """Add drag and churning of a roller.

    Return the power lost [W], or -1 on a fault.
    """
    wrench = bundle.scratch[0].on_ground
    clear(wrench)
    lost = drag_force(roller, row, bundle, wrench)
    increase(on_roller.force, wrench.force)
    increase(on_roller.moment, from_own(wrench.moment, row))
    return lost


@helper
def _move(rollers, moved, row, bundle, own, want):
    """Write the accelerations of a row.

    Add drag and weight first.
    """
    system = bundle.system[0]
    for i in range(row.balls):
        j, roller = row.first_ball + i, rollers[i]
        wrench = bundle.ball_wrenches[j]
        if row.drag_on == 1 and system.friction_on == 1:
            lost = roller_drag(roller, row, bundle, wrench)
            if lost < -0.5:
                bundle.scratch[0].fault.ball = j
                return 0
            own.drag += lost
        c, s = math.cos(roller.azimuth), math.sin(roller.azimuth)
        m, g = row.ball_mass, turning(system.gravity, c, s)
        weight = m * g[0], m * g[1], m * g[2]
        increase(wrench.force, weight)
        if want == 1:
            own.input += dot(weight, roller.velocity)
        roller_rates(roller, wrench, row, moved[i])
    return 1


def evaluate(stage, t, y, r, bundle, dydt, rates, want):
    """Do one stage of forces.evaluate.

    It does so for a row of rollers; return 1 when well.
    """
    row, rollers = bundle.rows[r], rollers_of(y, bundle.rows[r])
    if stage == CONTACTS:
        return _contacts(rollers, row, bundle, losses_of(rates, bundle.raceways.size), min(want, 1))
    own = powers_of_bearing(bundle, row.bearing, running_of(rates)[0])
    if stage == GUIDES:
        if row.caged == 0:
            return _neighbours(rollers, row, bundle, own, min(want, 1))
        return _pockets(rollers, row, bundle, own, min(want, 1))
    return _move(rollers, rollers_of(dydt, row), row, bundle, own, min(want, 1))


def energy(y, r, bundle):
    """Return the rollers' energy [J].

    It is the kinetic and elastic energy of a row with its contacts, pockets or neighbours.
    """
    row, rollers, total = bundle.rows[r], rollers_of(y, bundle.rows[r]), 0.0
    kin = bundle.scratch[0].kinematics[0]
    for i in range(row.balls):
        total += roller_energy(rollers[i], row)
        for k in range(row.first_raceway, row.first_raceway + row.raceways):
            raceway = bundle.raceways[k]
            ring = bundle.bodies_now[raceway.body]
            if touch_roller(rollers[i], ring, row, raceway, bundle, kin) <= 0.0:
                continue
            if raceway.kind == LINE:
                total += line_energy(raceway, kin, bundle)
            else:
                total += contact_energy(raceway, kin.penetration, bundle)
        if bundle.system[0].guides_on == 0:
            continue
        if row.caged == 1:
            total += pocket_energy(rollers[i], bundle.bodies_now[row.cage], row.first_ball + i, row, bundle)
        else:
            total += neighbour_energy(rollers[i], rollers[(i + 1) % row.balls], row, bundle)
    return total


def shares(y, r, bundle, share):
    """Write each roller's largest penetration.

    It is on the ring of its row's first raceway, and 0 for none.
    """
    row, rollers, kin = bundle.rows[r], rollers_of(y, bundle.rows[r]), bundle.scratch[0].kinematics[0]
    body = bundle.raceways[row.first_raceway].body
    for i in range(row.balls):
        deepest = 0.0
        for k in range(row.first_raceway, row.first_raceway + row.raceways):
            raceway = bundle.raceways[k]
            if raceway.body == body and raceway.kind == LINE:
                delta = touch_roller(rollers[i], bundle.bodies_now[body], row, raceway, bundle, kin)
                deepest = max(deepest, delta)
        share[row.first_ball + i] = deepest
    return 1


@helper
def _show(kin, contact, sample):
    """Write what a contact under load shows."""
    sample.load = contact.load + contact.damping_force
    sample.max_pressure = contact.max_pressure
    sample.semi_axis_a, sample.semi_axis_b = contact.semi_axis_a, contact.semi_axis_b
    sample.film_central, sample.film_minimum = contact.film_central, contact.film_minimum
    sample.film_parameter, sample.asperity_share = contact.film_parameter, contact.asperity_share
    sample.film_temperature = contact.film_temperature
    sample.slip, sample.entrainment, sample.spin_velocity = kin.slip_t, kin.entrainment_t, kin.rotation_n


@helper
def _channels(roller, j, row, raceway, bundle, shorted, values, losses, rates):
    """Write the channels of one contact.

    Adds its forces and losses as the right-hand side does.
    """
    scratch, system = bundle.scratch[0], bundle.system[0]
    ring, kin = bundle.bodies_now[raceway.body], scratch.kinematics[0]
    values[:] = 0.0
    sample = values.view(CONTACT_SAMPLE)[0]
    delta = touch_roller(roller, ring, row, raceway, bundle, kin)
    if not delta < np.inf:
        return 0
    sample.contact_angle, sample.film_temperature = contact_angle(kin, raceway), raceway.oil.temperature
    touching = open_line(raceway, kin, delta, bundle)
    if touching < -0.5:
        return 0
    if delta <= 0.0:
        sample.capacitance = touching
    if delta <= -near(raceway, system):
        return 1
    if _wrench_here(raceway, j, bundle) != 1:
        return 0
    if delta > 0.0:
        _show(kin, scratch.contact[0], sample)
    _add_contact(raceway, roller, ring, j, bundle)
    losses[:] = 0.0
    _add_losses(raceway, bundle, losses_of(losses, bundle.raceways.size))
    for i in range(MECHANISMS * bundle.raceways.size):
        sample.contact_loss += losses[i]
        rates[i] += losses[i]
    if delta <= 0.0:
        return 1
    return loaded_capacitance(raceway, kin, bundle, shorted, touching, sample)


@helper
def _show_guide(rollers, j, row, bundle, force):
    """Write the force of the cage on a roller.

    Without a cage it is that of the roller after it; return 0 on a fault.
    """
    i, on_roller = j - row.first_ball, bundle.ball_wrenches[j]
    clear(on_roller)
    if row.caged == 1:
        cage = bundle.bodies_now[row.cage]
        lost = pocket_forces(rollers[i], cage, j, row, bundle, on_roller, bundle.body_wrenches[row.cage])
    else:
        k = (i + 1) % row.balls
        on_next = bundle.ball_wrenches[row.first_ball + k]
        lost = neighbour_forces(rollers[i], rollers[k], j, row, bundle, on_roller, on_next)
    store(force, on_roller.force)
    return 0 if lost < -0.5 else 1


def observe(stage, y, r, bundle, shorted, contacts, pockets, losses, rates):
    """Write a sample of rollers.

    They are those of a row; return the capacitance of its rollers [F], or -1 on a fault.

    Contacts of a roller with one ring are parallel, its rings in series.
    """
    row, rollers, total = bundle.rows[r], rollers_of(y, bundle.rows[r]), 0.0
    body = bundle.raceways[row.first_raceway].body
    for i in range(row.balls):
        j = row.first_ball + i
        if stage == POCKETS:
            if _show_guide(rollers, j, row, bundle, pockets[j]) != 1:
                return -1.0
            continue
        one, other = 0.0, 0.0
        for k in range(row.raceways):
            raceway = bundle.raceways[row.first_raceway + k]
            if _channels(rollers[i], j, row, raceway, bundle, shorted, contacts[j, k], losses, rates) != 1:
                bundle.scratch[0].fault.ball = j
                return -1.0
            found = contacts[j, k].view(CONTACT_SAMPLE)[0].capacitance
            one, other = (one + found, other) if raceway.body == body else (one, other + found)
        total += in_series(one, other)
    return total
