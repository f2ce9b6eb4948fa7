"""Differentiate forces of pockets, neighbours and lands."""

from __future__ import annotations

from lambda_core.solver.arrays.bundle import NB, NS, SVY, SVZ, SY, SZ
from lambda_core.solver.cage.cage_waves import guide_pushes
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
from lambda_core.solver.contact.ring_waves import add_push_slope
from lambda_core.solver.layout import guide_law, helper, part
from lambda_core.solver.motion.steps import add_slope, ball_step, body_step
from lambda_core.solver.records import BALL, BODY_STATE
from lambda_core.solver.vec import clear, clear_each


@helper
def _no_force(out):
    return out[0] == 0.0 and out[1] == 0.0 and out[2] == 0.0


@helper
def pocket_columns(ball, j, row, bundle, bl):
    """Add the pocket of ball j.

    A pocket without force is skipped.
    """
    scratch, viscosity, fm, p = bundle.scratch[0], row.oil.viscosity, bl.wrenches, bl.reach.place[row.number, row.cage]
    cage, g, out, fault = bundle.bodies_now[row.cage], scratch.guide, scratch.out[:], scratch.fault
    law, par = guide_law(bundle.laws.guides, row.guide_law), part(bundle.par, row.pocket)
    near_ball, near_cage = bl.ball.view(BALL), bl.body.view(BODY_STATE)
    pocket_state(ball, cage, j, row, bundle, g)
    if guide_force(law, par, g, viscosity, out, fault, -1) != 1:
        return 0
    if _no_force(out):
        return 1
    clear_each(fm)
    pocket_apply(ball, cage, g, out, fm[0], fm[1])
    guide_pushes(row.waves[0], row.waves[1], g, out, -1.0, bl.pushes[0])
    for k in range(NB + NS):
        near_ball[0] = ball
        near_cage[0] = cage
        if k < NB:
            step = ball_step(k, True)
            bl.ball[k] += step
        else:
            step = body_step(k - NB, True)
            bl.body[k - NB] += step
        pocket_state(near_ball[0], near_cage[0], j, row, bundle, g)
        if guide_force(law, par, g, viscosity, out, fault, -1) != 1:
            return 0
        clear_each(fm[2:])
        pocket_apply(near_ball[0], near_cage[0], g, out, fm[2], fm[3])
        if k < NB:
            add_slope(bl.own, k, fm[2], fm[0], step)
            add_slope(bl.from_ball[p], k, fm[3], fm[1], step)
            _pocket_pushes(row, bundle, bl.from_ball, k, step, bl)
        else:
            column = NS * p + k - NB
            add_slope(bl.to_shared, column, fm[2], fm[0], step)
            add_slope(bl.parts[j, p], column, fm[3], fm[1], step)
            _pocket_pushes(row, bundle, bl.parts[j], column, step, bl)
    return _pocket_waves(ball, cage, j, row, law, par, bundle, bl)


@helper
def _pocket_pushes(row, bundle, slopes, column, step, bl):
    """Add a pocket's slope on the waves.

    Change over a step of its push on its cage's waves, to one column of their force slopes.
    """
    guide_pushes(row.waves[0], row.waves[1], bundle.scratch[0].guide, bundle.scratch[0].out[:], -1.0, bl.pushes[1])
    for i in range(row.waves[1] - row.waves[0]):
        p = bl.reach.place[row.number, bundle.waves[row.waves[0] + i].body]
        add_push_slope(slopes[p], i, column, step, bl.pushes)


@helper
def _pocket_waves(ball, cage, j, row, law, par, bundle, bl):
    """Add the waves' effect on ball j's pocket.

    They are those of an elastic cage.
    """
    scratch, fm, p = bundle.scratch[0], bl.wrenches, bl.reach.place[row.number, row.cage]
    g, out = scratch.guide, scratch.out[:]
    for i in range(row.waves[0], row.waves[1]):
        body = bundle.waves[i].body
        first = NS * bl.reach.place[row.number, body]
        for c in (SY, SZ, SVY, SVZ):
            kept, step = bundle.shared[NS * body + c], body_step(c, True)
            bundle.shared[NS * body + c] = kept + step
            pocket_state(ball, cage, j, row, bundle, g)
            bundle.shared[NS * body + c] = kept
            if guide_force(law, par, g, row.oil.viscosity, out, scratch.fault, -1) != 1:
                return 0
            clear_each(fm[2:])
            pocket_apply(ball, cage, g, out, fm[2], fm[3])
            add_slope(bl.to_shared, first + c, fm[2], fm[0], step)
            add_slope(bl.parts[j, p], first + c, fm[3], fm[1], step)
            _pocket_pushes(row, bundle, bl.parts[j], first + c, step, bl)
    return 1


@helper
def neighbour_columns(ball, other, row, bundle, bl):
    """Add the ball-ball contact to the slopes.

    Slopes with the first ball's own states go here; those with the other's states go into bl.beyond.
    """
    scratch, viscosity, fm = bundle.scratch[0], row.oil.viscosity, bl.wrenches
    g, out, fault = scratch.guide, scratch.out[:], scratch.fault
    law, par = guide_law(bundle.laws.guides, row.guide_law), part(bundle.par, row.pocket)
    near_ball = bl.ball.view(BALL)
    bl.beyond[:, :] = 0.0
    neighbour_state(ball, other, g)
    if guide_force(law, par, g, viscosity, out, fault, -1) != 1:
        return 0
    if _no_force(out):
        return 1
    clear(fm[0])
    neighbour_apply(ball.azimuth, first_arm(g, out), out, 1.0, fm[0])
    for k in range(2 * NB):
        c = k % NB
        step = ball_step(c, True)
        near_ball[0] = ball if k < NB else other
        bl.ball[c] += step
        clear(fm[2])
        if k < NB:
            neighbour_state(near_ball[0], other, g)
        else:
            neighbour_state(ball, near_ball[0], g)
        if guide_force(law, par, g, viscosity, out, fault, -1) != 1:
            return 0
        azimuth = near_ball[0].azimuth if k < NB else ball.azimuth
        neighbour_apply(azimuth, first_arm(g, out), out, 1.0, fm[2])
        add_slope(bl.own if k < NB else bl.beyond, c, fm[2], fm[0], step)
    return 1


@helper
def _land_columns(land, bundle, bl):
    """Add one station of a land."""
    scratch, viscosity, fm = bundle.scratch[0], land.viscosity, bl.wrenches
    cage, ring = bundle.bodies_now[land.cage], bundle.bodies_now[land.ring]
    g, out, fault = scratch.guide, scratch.out[:], scratch.fault
    law, par = guide_law(bundle.laws.guides, land.law), part(bundle.par, land.parameters)
    near_cage, near_ring = bl.body.view(BODY_STATE), bl.body2.view(BODY_STATE)
    land_state(cage, ring, land, bundle, g)
    if guide_force(law, par, g, viscosity, out, fault, land.number) != 1:
        return 0
    if _no_force(out):
        return 1
    clear(fm[0])
    clear(fm[1])
    land_apply(cage, ring, g, out, fm[0], fm[1])
    guide_pushes(land.waves[0], land.waves[1], g, out, 1.0, bl.pushes[0])
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
        land_state(near_cage[0], near_ring[0], land, bundle, g)
        if guide_force(law, par, g, viscosity, out, fault, land.number) != 1:
            return 0
        clear(fm[2])
        clear(fm[3])
        land_apply(near_cage[0], near_ring[0], g, out, fm[2], fm[3])
        _land_slopes(land, bundle, column, step, bl)
    return _land_waves(land, cage, ring, law, par, bundle, bl)


@helper
def _land_slopes(land, bundle, column, step, bl):
    """Add a land's force slopes to one column.

    They are changes over a step, on cage, ring and the cage's waves.
    """
    fm = bl.wrenches
    add_slope(bl.shared[land.cage], column, fm[2], fm[0], step)
    add_slope(bl.shared[land.ring], column, fm[3], fm[1], step)
    guide_pushes(land.waves[0], land.waves[1], bundle.scratch[0].guide, bundle.scratch[0].out[:], 1.0, bl.pushes[1])
    for i in range(land.waves[1] - land.waves[0]):
        add_push_slope(bl.shared[bundle.waves[land.waves[0] + i].body], i, column, step, bl.pushes)


@helper
def _land_waves(land, cage, ring, law, par, bundle, bl):
    """Add the waves' effect on a land.

    They are those of an elastic cage.
    """
    scratch, fm = bundle.scratch[0], bl.wrenches
    g, out = scratch.guide, scratch.out[:]
    for i in range(land.waves[0], land.waves[1]):
        body = bundle.waves[i].body
        for c in (SY, SZ, SVY, SVZ):
            kept, step = bundle.shared[NS * body + c], body_step(c, True)
            bundle.shared[NS * body + c] = kept + step
            land_state(cage, ring, land, bundle, g)
            bundle.shared[NS * body + c] = kept
            if guide_force(law, par, g, land.viscosity, out, scratch.fault, land.number) != 1:
                return 0
            clear(fm[2])
            clear(fm[3])
            land_apply(cage, ring, g, out, fm[2], fm[3])
            _land_slopes(land, bundle, NS * body + c, step, bl)
    return 1


@helper
def land_columns(bundle, row, bl):
    """Add every land of a row.

    A `row` of -1 takes all rows of balls.
    """
    for i in range(bundle.lands.size):
        if row >= 0 and bundle.lands[i].row != row:
            continue
        if _land_columns(bundle.lands[i], bundle, bl) != 1:
            return 0
    return 1
