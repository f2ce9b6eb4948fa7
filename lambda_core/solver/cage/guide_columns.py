"""Slopes of the forces of pockets, neighbouring balls and lands, by differences of their laws."""

from __future__ import annotations

from lambda_core.solver.cage.guides import (
    first_arm,
    guide_force,
    land_apply,
    land_state,
    neighbour_apply,
    neighbour_state,
    pocket_apply,
    pocket_state,
)
from lambda_core.solver.layout import NB, NS, guide_law, helper, part
from lambda_core.solver.motion.steps import add_slope, ball_step, body_step
from lambda_core.solver.records import BALL, BODY_STATE
from lambda_core.solver.vec import clear, clear_each


@helper
def _no_force(out):
    return out[0] == 0.0 and out[1] == 0.0 and out[2] == 0.0


@helper
def pocket_columns(ball, j, row, bundle, bl):
    """Add the pocket of ball j; a pocket without force is skipped."""
    scratch, viscosity, fm, p = bundle.scratch[0], row.oil.viscosity, bl.wrenches, bl.reach.place[row.number, row.cage]
    cage, g, out, fault = bundle.bodies_now[row.cage], scratch.guide, scratch.out[:], scratch.fault
    law, par = guide_law(bundle.laws.guides, row.guide_law), part(bundle.par, row.pocket)
    near_ball, near_cage = bl.ball.view(BALL), bl.body.view(BODY_STATE)
    pocket_state(ball, cage, j, row, g)
    if guide_force(law, par, g, viscosity, out, fault, -1) != 1:
        return 0
    if _no_force(out):
        return 1
    clear_each(fm)
    pocket_apply(ball, cage, g, out, fm[0], fm[1])
    for k in range(NB + NS):
        near_ball[0] = ball
        near_cage[0] = cage
        if k < NB:
            step = ball_step(k, True)
            bl.ball[k] += step
        else:
            step = body_step(k - NB, True)
            bl.body[k - NB] += step
        pocket_state(near_ball[0], near_cage[0], j, row, g)
        if guide_force(law, par, g, viscosity, out, fault, -1) != 1:
            return 0
        clear_each(fm[2:])
        pocket_apply(near_ball[0], near_cage[0], g, out, fm[2], fm[3])
        if k < NB:
            add_slope(bl.own, k, fm[2], fm[0], step)
            add_slope(bl.from_ball[p], k, fm[3], fm[1], step)
        else:
            column = NS * p + k - NB
            add_slope(bl.to_shared, column, fm[2], fm[0], step)
            add_slope(bl.parts[j, p], column, fm[3], fm[1], step)
    return 1


@helper
def neighbour_columns(ball, other, row, bundle, bl):
    """Add the ball-ball contact to the first ball's own block; the pair's coupling is left to the iteration."""
    scratch, viscosity, fm = bundle.scratch[0], row.oil.viscosity, bl.wrenches
    g, out, fault = scratch.guide, scratch.out[:], scratch.fault
    law, par = guide_law(bundle.laws.guides, row.guide_law), part(bundle.par, row.pocket)
    near_ball = bl.ball.view(BALL)
    neighbour_state(ball, other, g)
    if guide_force(law, par, g, viscosity, out, fault, -1) != 1:
        return 0
    if _no_force(out):
        return 1
    clear(fm[0])
    neighbour_apply(ball.azimuth, first_arm(g, out), out, 1.0, fm[0])
    for k in range(NB):
        step = ball_step(k, True)
        near_ball[0] = ball
        bl.ball[k] += step
        neighbour_state(near_ball[0], other, g)
        if guide_force(law, par, g, viscosity, out, fault, -1) != 1:
            return 0
        clear(fm[2])
        neighbour_apply(near_ball[0].azimuth, first_arm(g, out), out, 1.0, fm[2])
        add_slope(bl.own, k, fm[2], fm[0], step)
    return 1


@helper
def _land_columns(land, bundle, bl):
    """Add one station of a land."""
    scratch, viscosity, fm = bundle.scratch[0], land.viscosity, bl.wrenches
    cage, ring = bundle.bodies_now[land.cage], bundle.bodies_now[land.ring]
    g, out, fault = scratch.guide, scratch.out[:], scratch.fault
    law, par = guide_law(bundle.laws.guides, land.law), part(bundle.par, land.parameters)
    near_cage, near_ring = bl.body.view(BODY_STATE), bl.body2.view(BODY_STATE)
    land_state(cage, ring, land.offset, g)
    if guide_force(law, par, g, viscosity, out, fault, land.number) != 1:
        return 0
    if _no_force(out):
        return 1
    clear(fm[0])
    clear(fm[1])
    land_apply(cage, ring, g, out, fm[0], fm[1])
    for k in range(2 * NS):
        c = k % NS
        column = NS * land.cage + c if k < NS else NS * land.ring + c
        if bl.index[column] < 0:
            continue
        step = body_step(c, True)
        near_cage[0] = cage
        near_ring[0] = ring
        if k < NS:
            bl.body[c] += step
        else:
            bl.body2[c] += step
        land_state(near_cage[0], near_ring[0], land.offset, g)
        if guide_force(law, par, g, viscosity, out, fault, land.number) != 1:
            return 0
        clear(fm[2])
        clear(fm[3])
        land_apply(near_cage[0], near_ring[0], g, out, fm[2], fm[3])
        add_slope(bl.shared[land.cage], column, fm[2], fm[0], step)
        add_slope(bl.shared[land.ring], column, fm[3], fm[1], step)
    return 1


@helper
def land_columns(bundle, bl):
    """Add every land."""
    for i in range(bundle.lands.size):
        if _land_columns(bundle.lands[i], bundle, bl) != 1:
            return 0
    return 1
