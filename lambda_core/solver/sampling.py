"""Compute contact channels and energies of a sample.

It runs off the hot path.
"""

from __future__ import annotations

import numpy as np

from lambda_core.solver.arrays.bundle import MECHANISMS
from lambda_core.solver.cage.guides import guide_force, land_state, pocket_apply, pocket_state
from lambda_core.solver.contact.contact_capacitance import (
    bulk_permittivity,
    contact_capacitance,
    open_capacitance,
    touching_film,
)
from lambda_core.solver.contact.contact_kinematics import axis_x, contact_angle, contact_wrench, near, touch
from lambda_core.solver.contact.contact_states import hand_states
from lambda_core.solver.contact.dissipation import raceway_losses
from lambda_core.solver.integrator.memory import evaluate_t
from lambda_core.solver.layout import (
    array1,
    array2,
    array3,
    array4,
    balls_of,
    bundle_t,
    cells_of,
    f8,
    grid_of,
    guide_law,
    helper,
    i8,
    losses_of,
    part,
    raceway_laws,
)
from lambda_core.solver.motion.energy import stored_energy
from lambda_core.solver.motion.force_elements import add_contact, clear_forces
from lambda_core.solver.motion.prescribed import fill_shared
from lambda_core.solver.records import CONTACT_SAMPLE, ROLLERS, TOTALS
from lambda_core.solver.row_code import POCKETS, RACEWAYS, roller_code
from lambda_core.solver.vec import clear, combine_onto, dot, store

_TOTALS = len(TOTALS.names or ())
observe_sig = i8(array1, array2, bundle_t, evaluate_t, f8, array4, array3, array3, array2, array2, array2, array1)


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
def _light_capacitance(delta, kin, raceway, j, laws, bundle):
    """Return the capacitance [F] of light contacts.

    It is that of an open contact, the least one of a light contact, or 0 of others; -1 on a fault.

    Open contacts come no closer than the film that the oil would leave where they touched, so that capacitance is
    continuous where they do. Beyond the reach of the kinematics the film counts for nothing.
    """
    if delta >= raceway.roughness:
        return 0.0
    film = 0.0
    if delta > -raceway.reach:
        hand_states(raceway, j, bundle)
        film = touching_film(raceway, kin, bundle)
        if film < -0.5:
            return -1.0
    return open_capacitance(raceway, max(-delta, film), bulk_permittivity(raceway, laws, bundle))


@helper
def _raceway_channels(ball, j, raceway, bundle, shorted, values, losses, rates):
    """Write the channels of one contact.

    Zeros and the gap's capacitance when it is open.

    Adds its forces to those of ball and ring and its losses to `rates`, as the right-hand side does.
    """
    scratch, system = bundle.scratch[0], bundle.system[0]
    laws = raceway_laws(bundle.laws.raceways, raceway.laws)
    ring, kin, contact = bundle.bodies_now[raceway.body], scratch.kinematics[0], scratch.contact[0]
    values[:] = 0.0
    sample = values.view(CONTACT_SAMPLE)[0]
    delta = touch(ball, ring, raceway, bundle, kin)
    if not delta < np.inf:
        return 0
    sample.contact_angle = contact_angle(kin, raceway)
    sample.film_temperature = raceway.oil.temperature
    touching = _light_capacitance(delta, kin, raceway, j, laws, bundle)
    if touching < -0.5:
        return 0
    if delta <= 0.0:
        sample.capacitance = touching
    if delta <= -near(raceway, system):
        return 1
    hand_states(raceway, j, bundle)
    if contact_wrench(raceway, 0, bundle) != 1:
        return 0
    if delta > 0.0:
        _show(kin, contact, sample)
    add_contact(raceway, 0, j, bundle)
    losses[:] = 0.0
    named, cells = losses_of(losses, bundle.raceways.size), cells_of(bundle.cells, 0, 1, bundle.grid.shape[1])
    grid = grid_of(bundle.grid)
    raceway_losses(raceway, kin, system, grid, contact, cells, named)
    for i in range(MECHANISMS * bundle.raceways.size):
        sample.contact_loss += losses[i]
        rates[i] += losses[i]
    if delta <= 0.0:
        return 1
    return contact_capacitance(raceway, kin, laws, bundle, grid, cells, shorted, touching, sample)


@helper
def _pocket_forces(balls, row, bundle, pockets):
    """Write the pocket forces on balls.

    The balls are those of a row.
    """
    scratch, cage, on_cage = bundle.scratch[0], bundle.bodies_now[row.cage], bundle.body_wrenches[row.cage]
    g, out = scratch.guide, scratch.out[:]
    law, par = guide_law(bundle.laws.guides, row.guide_law), part(bundle.par, row.pocket)
    for j in range(row.first_ball, row.first_ball + row.balls):
        ball = balls[j - row.first_ball]
        pocket_state(ball, cage, j, row, bundle, g)
        if guide_force(law, par, g, row.oil.viscosity, out, scratch.fault, -1) != 1:
            return 0
        on_ball = bundle.ball_wrenches[j]
        clear(on_ball)
        pocket_apply(ball, cage, g, out, on_ball, on_cage)
        store(pockets[j], on_ball.force)
    return 1


@helper
def _land_forces(bundle, forces):
    """Add the forces of the lands on their cages."""
    scratch = bundle.scratch[0]
    g, out = scratch.guide, scratch.out[:]
    for i in range(bundle.lands.size):
        land = bundle.lands[i]
        law, par = guide_law(bundle.laws.guides, land.law), part(bundle.par, land.parameters)
        land_state(bundle.bodies_now[land.cage], bundle.bodies_now[land.ring], land, bundle, g)
        if guide_force(law, par, g, land.viscosity, out, scratch.fault, land.number) != 1:
            return 0
        force = forces[land.number]
        store(force, combine_onto(force, (out[0], out[1], out[2]), g.axial, g.radial, g.tangential))
    return 1


@helper
def _contact_channels(balls, row, bundle, shorted, contacts, losses, rates):
    """Write the raceway contacts' channels.

    They are those of a row; return the capacitance of its balls, or -1.

    Contacts of a ball with one ring are parallel, its rings in series; raceways of a ring follow each other.
    """
    total = 0.0
    for j in range(row.first_ball, row.first_ball + row.balls):
        series, parallel = 0.0, 0.0
        for k in range(row.raceways):
            raceway, values = bundle.raceways[row.first_raceway + k], contacts[j, k]
            if _raceway_channels(balls[j - row.first_ball], j, raceway, bundle, shorted, values, losses, rates) != 1:
                bundle.scratch[0].fault.ball = j
                return -1.0
            parallel += values.view(CONTACT_SAMPLE)[0].capacitance
            if k + 1 < row.raceways and bundle.raceways[row.first_raceway + k + 1].body == raceway.body:
                continue
            series += 1.0 / parallel if parallel > 0.0 else np.inf
            parallel = 0.0
        total += 1.0 / series
    return total


@helper
def _observe_one(t, y, bundle, shorted, contacts, pockets, lands, extra, rates):
    """Write what one sample shows; see observe."""
    totals, losses = extra[:_TOTALS].view(TOTALS)[0], extra[_TOTALS : _TOTALS + MECHANISMS * bundle.raceways.size]
    bundle.scratch[0].fault.role = -1
    totals.stored_energy = stored_energy(t, y, bundle)
    if fill_shared(t, y, bundle) != 1:
        return 0
    pockets[:, :] = 0.0
    lands[:, :] = 0.0
    for r in range(bundle.rows.size):
        row = bundle.rows[r]
        if row.kind == ROLLERS:
            code = roller_code(bundle.rollers, 0)
            if code.observe(POCKETS, y, r, bundle, shorted, contacts, pockets, losses, rates) < 0.0:
                return 0
        elif row.caged == 1 and _pocket_forces(balls_of(y, row), row, bundle, pockets) != 1:
            return 0
    if _land_forces(bundle, lands) != 1:
        return 0
    clear_forces(bundle)
    rates[:] = 0.0
    totals.capacitance = 0.0
    for r in range(bundle.rows.size):
        row = bundle.rows[r]
        if row.kind == ROLLERS:
            code = roller_code(bundle.rollers, 0)
            found = code.observe(RACEWAYS, y, r, bundle, shorted, contacts, pockets, losses, rates)
        else:
            found = _contact_channels(balls_of(y, row), row, bundle, shorted, contacts, losses, rates)
        if found < 0.0:
            return 0
        totals.capacitance += found
    return 1


def observe(times, states, bundle, evaluate, shorted, contacts, pockets, lands, extra, shared, rates, dydt):
    """Write what samples show; an entry point.

    Parameters
    ----------
    times : float64[:], shape (n,)
    states : float64[:, :], shape (at least n, size)
    evaluate : pointer
        The right-hand side.
    shorted : float
        Film parameter below which a contact counts as touching metal; below zero the stored energy alone is written.
    contacts : float64[:, :, :, :], shape (n, Z, raceways of a row, 16)
        CONTACT_CHANNELS, records.CONTACT_SAMPLE.
    pockets : float64[:, :, :], shape (n, Z, 3)
        Force of the cage on each ball, axes x, r, t [N].
    lands : float64[:, :, :], shape (n, 2, 3)
        Force of each ring's land on the cage, inertial [N].
    extra : float64[:, :], shape (n, powers + 2)
        A records.TOTALS; the rest is a workspace.
    shared : float64[:, :], shape (n, 12 bodies)
        The whole shared state.
    rates : float64[:, :], shape (n, powers)
        Losses [W] and the rates of the other running integrals.
    dydt : float64[:], shape (size,)
        Workspace.

    Returns
    -------
    int
        1 when every kernel was well; otherwise 0 and scratch.fault says which was not.
    """
    for i in range(times.size):
        y = states[i]
        totals = extra[i, :_TOTALS].view(TOTALS)[0]
        if shorted < 0.0:
            totals.stored_energy = stored_energy(times[i], y, bundle)
            continue
        if _observe_one(times[i], y, bundle, shorted, contacts[i], pockets[i], lands[i], extra[i], rates[i]) != 1:
            return 0
        if evaluate(times[i], y, bundle, dydt, rates[i], 2) != 1:
            return 0
        for k in range(bundle.shared.size):
            shared[i, k] = bundle.shared[k]
        ay, az = bundle.bodies_now[0].tilt[0], bundle.bodies_now[0].tilt[1]
        totals.torque = -dot(bundle.body_wrenches[0].moment, (axis_x(ay, az), ay, az))
    return 1
