"""Compute energy stored in motion, contacts and supports."""

from __future__ import annotations

import numpy as np

from lambda_core.laws.jit.binding import STRIDE
from lambda_core.solver.cage.guides import (
    GAUSS_NODES,
    GAUSS_WEIGHTS,
    guide_energy,
    land_state,
    neighbour_state,
    pocket_state,
)
from lambda_core.solver.contact.contact_kinematics import axis_x, touch
from lambda_core.solver.layout import balls_of, guide_law, helper, of, part, raceway_laws
from lambda_core.solver.motion.prescribed import fill_shared
from lambda_core.solver.motion.structures import structure_energy
from lambda_core.solver.records import ROLLERS
from lambda_core.solver.row_code import roller_code
from lambda_core.solver.vec import length


@helper
def contact_energy(raceway, delta, bundle):
    """Return a raceway contact's elastic energy [J].

    It holds at penetration delta.

    With delta u^2 for the penetration, eight points are exact for a power law of exponent 3/2.
    """
    scratch, n, total = bundle.scratch[0], GAUSS_NODES.size, 0.0
    out, law = scratch.out[:], raceway_laws(bundle.laws.raceways, raceway.laws).normal_contact
    for i in range(n):
        scratch.lanes.delta[i] = delta * GAUSS_NODES[i] * GAUSS_NODES[i]
    law(
        of(scratch.lanes.delta, 0, n), raceway.radius_x, raceway.radius_y, raceway.modulus,
        part(bundle.par, raceway.parameters.normal_contact), of(out, 0, STRIDE * n),
    )  # fmt: skip
    for i in range(n):
        total += GAUSS_WEIGHTS[i] * out[STRIDE * i] * 2.0 * delta * GAUSS_NODES[i]
    return total


@helper
def _ball_energy(ball, row):
    """Return the kinetic energy of a ball [J]."""
    v2 = ball.velocity[0] ** 2 + ball.velocity[1] ** 2 + ball.velocity[2] ** 2
    w2 = ball.spin[0] ** 2 + ball.spin[1] ** 2 + ball.spin[2] ** 2
    return 0.5 * row.ball_mass * v2 + 0.5 * row.ball_inertia * w2


@helper
def _raceway_energy(ball, raceway, bundle):
    """Return a ball's elastic energy [J].

    It is that of its contact with a raceway.
    """
    ring, kin = bundle.bodies_now[raceway.body], bundle.scratch[0].kinematics[0]
    if touch(ball, ring, raceway, bundle, kin) > 0.0:
        return contact_energy(raceway, kin.penetration, bundle)
    return 0.0


@helper
def _guide_energy(balls, j, row, bundle):
    """Return a ball's elastic energy of guidance [J].

    It is in its pocket, or with the next ball where there is no cage.
    """
    i = j - row.first_ball
    scratch, ball, start = bundle.scratch[0], balls[i], 0.0
    g = scratch.guide
    if row.caged == 1:
        pocket_state(ball, bundle.bodies_now[row.cage], j, row, bundle, g)
    else:
        neighbour_state(ball, balls[(i + 1) % row.balls], g)
        start = max(1.0, 2.0 * row.ball_radius / length(g.place))
    law, par = guide_law(bundle.laws.guides, row.guide_law), part(bundle.par, row.pocket)
    return guide_energy(law, par, g, row.oil.viscosity, scratch.out[:], scratch.at_rest, start)


@helper
def _body_energy(body, now):
    """Return a body's energy [J].

    It is its kinetic energy and the elastic energy of its supports.
    """
    ay, az = now.tilt[0], now.tilt[1]
    wy, wz, sigma = now.tilt_velocity[0], now.tilt_velocity[1], now.spin
    wx = -(wy * ay + wz * az) / axis_x(ay, az)
    v2 = now.velocity[0] ** 2 + now.velocity[1] ** 2 + now.velocity[2] ** 2
    energy = 0.5 * body.mass * v2 + 0.5 * body.polar_inertia * sigma * sigma
    energy += 0.5 * body.transverse_inertia * (wx * wx + wy * wy + wz * wz)
    for i in range(3):
        energy += 0.5 * body.stiffness[i] * now.position[i] * now.position[i]
    energy += 0.5 * body.stiffness[3] * az * az + 0.5 * body.stiffness[4] * ay * ay
    return energy


@helper
def _land_energy(land, bundle):
    """Return a land station's elastic energy [J]."""
    scratch = bundle.scratch[0]
    law, par = guide_law(bundle.laws.guides, land.law), part(bundle.par, land.parameters)
    land_state(bundle.bodies_now[land.cage], bundle.bodies_now[land.ring], land, bundle, scratch.guide)
    return guide_energy(law, par, scratch.guide, land.viscosity, scratch.out[:], scratch.at_rest, 0.0)


@helper
def stored_energy(t, y, bundle):
    """Return kinetic plus elastic energy [J].

    It covers all bodies, contacts and supports.
    """
    system = bundle.system[0]
    if fill_shared(t, y, bundle) != 1:
        return np.nan
    total = 0.0
    for r in range(bundle.rows.size):
        row = bundle.rows[r]
        if row.kind == ROLLERS:
            total += roller_code(bundle.rollers, 0).energy(y, r, bundle)
            continue
        balls = balls_of(y, row)
        for i in range(row.balls):
            total += _ball_energy(balls[i], row)
            for k in range(row.first_raceway, row.first_raceway + row.raceways):
                total += _raceway_energy(balls[i], bundle.raceways[k], bundle)
            if system.guides_on == 1:
                total += _guide_energy(balls, row.first_ball + i, row, bundle)
    for b in range(bundle.bodies.size):
        if bundle.bodies[b].moves == 1:
            total += _body_energy(bundle.bodies[b], bundle.bodies_now[b])
    if system.guides_on == 1:
        for i in range(bundle.lands.size):
            total += _land_energy(bundle.lands[i], bundle)
    return total + structure_energy(bundle)
