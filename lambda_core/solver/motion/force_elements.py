"""Evaluate force elements: raceways, cage, drag."""

from __future__ import annotations

import math

import numpy as np

from lambda_core.solver.arrays.bundle import GUARD
from lambda_core.solver.arrays.fault_roles import FLUID_DRAG
from lambda_core.solver.cage.cage_waves import push_cage
from lambda_core.solver.cage.guides import (
    first_arm,
    guide_force,
    guide_loss,
    land_apply,
    land_state,
    neighbour_apply,
    neighbour_state,
    pocket_apply,
    pocket_state,
)
from lambda_core.solver.contact.contact_kinematics import apply_wrench, contact_wrenches, near, touch
from lambda_core.solver.contact.contact_states import hand_states, lost_in, state_rates
from lambda_core.solver.contact.dissipation import raceway_losses
from lambda_core.solver.contact.ring_waves import push_waves
from lambda_core.solver.faults import report
from lambda_core.solver.layout import cells_of, drag_law, grid_of, guide_law, helper, part
from lambda_core.solver.motion.bearing_sums import is_bypassed, powers_of_bearing
from lambda_core.solver.records import BATCH
from lambda_core.solver.vec import clear, increase

_SPIN_FLOOR = 1e-3  # [rad/s] below which a ball's churning moment fades out


@helper
def clear_forces(bundle):
    """Begin the sums of forces on balls and bodies."""
    for j in range(bundle.ball_wrenches.size):
        clear(bundle.ball_wrenches[j])
    for b in range(bundle.body_wrenches.size):
        clear(bundle.body_wrenches[b])


@helper
def add_contact(raceway, place, j, bundle):
    """Add a raceway contact's wrench.

    It is at a place of scratch; the forces on ball j and on the raceway's body take it.
    """
    scratch, on_body = bundle.scratch[0], bundle.body_wrenches[raceway.body]
    apply_wrench(scratch.kinematics[place], scratch.wrench[place], bundle.ball_wrenches[j], scratch.on_ring)
    increase(on_body.force, scratch.on_ring.force)
    increase(on_body.moment, scratch.on_ring.moment)
    if raceway.waves[1] > raceway.waves[0]:
        push_waves(raceway, place, bundle)


@helper
def _room(raceway, bundle):
    """Return the contacts per call of laws.

    A raceway has one where its laws read the contact's states.
    """
    if raceway.states > 0 or raceway.slots[1] > raceway.slots[0]:
        return 1
    return (bundle.cells.shape[1] - GUARD) // bundle.grid.shape[1]


@helper
def _gather(t, balls, i, row, raceway, keeps, bundle):
    """Gather contacts of a raceway.

    They start at ball i of a row, until no more are taken at once.

    Returns the next ball, or -1 on a fault, and how many contacts carry load and do not yet (records.BATCH).
    """
    scratch, ring = bundle.scratch[0], bundle.bodies_now[raceway.body]
    room, apart, closed, opened = _room(raceway, bundle), -near(raceway, bundle.system[0]), 0, 0
    while i < row.balls and closed + opened < room:
        j, kin = row.first_ball + i, scratch.kinematics[closed]
        delta = touch(balls[i], ring, raceway, bundle, kin)
        if room == 1:
            hand_states(raceway, j, bundle)
        if delta <= 0.0 and keeps and state_rates(t, raceway, j, -1.0, bundle) != 1:
            return -1, 0, 0
        i += 1
        if delta <= apart:
            continue
        if not delta < np.inf:
            scratch.fault.ball = j
            return -1, 0, 0
        place = closed if delta > 0.0 else BATCH + opened
        scratch.order[closed + opened], scratch.ball[place] = place, j
        if delta > 0.0:
            closed += 1
        else:
            scratch.kinematics[place] = scratch.kinematics[closed]
            opened += 1
    return i, closed, opened


@helper
def _add(t, place, raceway, bundle, losses, keeps, counts):
    """Add a contact to forces and losses.

    The losses take what it dissipates where that counts; return 0 on a fault.
    """
    scratch, k = bundle.scratch[0], raceway.number
    j, kin, contact = scratch.ball[place], scratch.kinematics[place], scratch.contact[place]
    add_contact(raceway, place, j, bundle)
    before = lost_in(losses, k) if keeps else 0.0
    if keeps or counts:
        cells = cells_of(bundle.cells, place % BATCH, 1, bundle.grid.shape[1])
        raceway_losses(raceway, kin, bundle.system[0], grid_of(bundle.grid), contact, cells, losses)
    if keeps and place < BATCH:
        return state_rates(t, raceway, j, max(lost_in(losses, k) - before, 0.0), bundle)
    return 1


@helper
def raceway_forces(t, balls, row, bundle, losses, want):
    """Add the raceway contacts of a row.

    With `want`, add what they dissipate to losses (layout.Losses).

    Where contacts keep states, their rates are written.
    """
    friction = bundle.system[0].friction_on == 1
    for k in range(row.first_raceway, row.first_raceway + row.raceways):
        raceway, i = bundle.raceways[k], 0
        keeps = raceway.states > 0 and friction
        while i < row.balls:
            i, closed, opened = _gather(t, balls, i, row, raceway, keeps, bundle)
            if i < 0:
                return 0
            if closed > 0 and contact_wrenches(raceway, 0, closed, bundle) != 1:
                return 0
            if opened > 0 and contact_wrenches(raceway, BATCH, opened, bundle) != 1:
                return 0
            for m in range(closed + opened):
                place = bundle.scratch[0].order[m]
                if _add(t, place, raceway, bundle, losses, keeps, want == 1 and friction) != 1:
                    return 0
    return 1


@helper
def drag_force(ball, row, bundle, on_ball):
    """Add fluid drag and churning.

    They act on one ball; return the power lost [W], or -1 on a fault.

    In motion the drag is that at the ball's azimuth, in the quasi-static equilibrium its mean over one revolution,
    from azimuths that are the same for all balls, so that equal balls have equal drag.
    """
    scratch, oil, count = bundle.scratch[0], row.oil, bundle.system[0].drag_azimuths
    out = scratch.out[:]
    w = math.sqrt(ball.spin[0] ** 2 + ball.spin[1] ** 2 + ball.spin[2] ** 2)
    nu = oil.viscosity / oil.density
    law, par = drag_law(bundle.laws.drag, row.drag_law), part(bundle.par, row.drag)
    force, moment = 0.0, 0.0
    for k in range(count):
        azimuth = ball.azimuth if count == 1 else -math.pi + 2.0 * math.pi * k / count
        out[:2] = np.nan
        status = law(ball.velocity[2], w, azimuth, nu, oil.density, par, out)
        if status != 1 or not abs(out[0]) + abs(out[1]) < np.inf:
            report(scratch.fault, FLUID_DRAG, status, -1, ball.velocity[2], w, azimuth, nu)
            return -1.0
        force += out[0]
        moment += out[1]
    force /= count
    moment /= count
    moment /= math.sqrt(w * w + _SPIN_FLOOR * _SPIN_FLOOR)
    on_ball.force[2] -= force
    on_ball.moment[0] -= moment * ball.spin[0]
    on_ball.moment[1] -= moment * ball.spin[1]
    on_ball.moment[2] -= moment * ball.spin[2]
    return force * ball.velocity[2] + moment * w * w


@helper
def cage_forces(balls, row, bundle, running, want):
    """Add the cage forces of a row.

    They are those of pockets, or ball-ball contacts when it has no cage; with `want` add their losses.
    """
    scratch, viscosity = bundle.scratch[0], row.oil.viscosity
    g, out, fault, at_rest = scratch.guide, scratch.out[:], scratch.fault, scratch.at_rest
    cage, on_cage = bundle.bodies_now[row.cage], bundle.body_wrenches[row.cage]
    law, par = guide_law(bundle.laws.guides, row.guide_law), part(bundle.par, row.pocket)
    for i in range(row.balls):
        j, k = row.first_ball + i, row.first_ball + (i + 1) % row.balls
        ball, other = balls[i], balls[k - row.first_ball]
        if row.caged == 1:
            pocket_state(ball, cage, j, row, bundle, g)
        else:
            neighbour_state(ball, other, g)
        if guide_force(law, par, g, viscosity, out, fault, -1) != 1:
            fault.ball = j
            return 0
        lost = guide_loss(law, par, g, viscosity, out, at_rest) if want == 1 else 0.0
        if row.caged == 1:
            running.pocket += lost
            pocket_apply(ball, cage, g, out, bundle.ball_wrenches[j], on_cage)
            if row.waves[1] > row.waves[0]:
                push_cage(row.waves[0], row.waves[1], -1.0, bundle)
        else:
            running.land += lost
            neighbour_apply(ball.azimuth, first_arm(g, out), out, 1.0, bundle.ball_wrenches[j])
            neighbour_apply(other.azimuth, (out[3], out[4], out[5]), out, -1.0, bundle.ball_wrenches[k])
    return 1


@helper
def land_forces(bundle, running, want):
    """Add the lands that guide cages; with `want` their losses."""
    scratch = bundle.scratch[0]
    g, out, fault = scratch.guide, scratch.out[:], scratch.fault
    for i in range(bundle.lands.size):
        land = bundle.lands[i]
        bearing = bundle.rows[land.row].bearing
        if is_bypassed(bearing, bundle, want):
            continue
        cage, ring = bundle.bodies_now[land.cage], bundle.bodies_now[land.ring]
        law, par = guide_law(bundle.laws.guides, land.law), part(bundle.par, land.parameters)
        land_state(cage, ring, land, bundle, g)
        if guide_force(law, par, g, land.viscosity, out, fault, land.number) != 1:
            return 0
        if want > 0:
            own = powers_of_bearing(bundle, bearing, running)
            own.land += guide_loss(law, par, g, land.viscosity, out, scratch.at_rest)
        land_apply(cage, ring, g, out, bundle.body_wrenches[land.cage], bundle.body_wrenches[land.ring])
        if land.waves[1] > land.waves[0]:
            push_cage(land.waves[0], land.waves[1], 1.0, bundle)
    return 1
