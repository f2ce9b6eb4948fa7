"""Differentiate forces of raceway contacts."""

from __future__ import annotations

import numpy as np

from lambda_core.solver.arrays.bundle import NB, NS, STHETA, SVY, SVZ, SY, SZ
from lambda_core.solver.contact.contact_kinematics import apply_wrench, near, touch
from lambda_core.solver.contact.contact_states import hand_states
from lambda_core.solver.contact.ring_waves import push_slopes, wave_pushes
from lambda_core.solver.contact.tangent import wrench_at
from lambda_core.solver.layout import helper, raceway_laws
from lambda_core.solver.motion.steps import add_slope, ball_step, body_step
from lambda_core.solver.records import BALL, BODY_STATE
from lambda_core.solver.vec import clear


@helper
def _wrenches_near(scratch, bl):
    """Write the wrenches at neighbouring kinematics.

    The wrenches act on ball and ring.
    """
    kin, wrench = scratch.kinematics[1], scratch.wrench[1]
    wrench_at(kin, scratch.kinematics[0], scratch.wrench[0], bl.slope[0], wrench)
    clear(bl.wrenches[2])
    apply_wrench(kin, wrench, bl.wrenches[2], bl.wrenches[3])


@helper
def _contact_columns(ball, j, ring, raceway, row, bundle, bl):
    """Add one raceway contact to the slopes.

    The force slopes of ball j; scratch holds its kinematics and wrench.
    """
    scratch, p = bundle.scratch[0], bl.reach.place[row.number, raceway.body]
    apart = -near(raceway, bundle.system[0])
    index, on_ring = bl.reach.index[row.number], bl.parts[j, p]
    kin, fm = scratch.kinematics[1], bl.wrenches
    near_ball, near_ring = bl.ball.view(BALL), bl.body.view(BODY_STATE)
    clear(fm[0])
    clear(fm[1])
    apply_wrench(scratch.kinematics[0], scratch.wrench[0], fm[0], fm[1])
    for c in range(NB):
        step = ball_step(c, False)
        near_ball[0] = ball
        bl.ball[c] += step
        if touch(near_ball[0], ring, raceway, bundle, kin) <= apart:
            # The step leaves a lightly loaded contact, which deserves its stiffness all the same: step back instead.
            near_ball[0] = ball
            step = -step
            bl.ball[c] += step
            if touch(near_ball[0], ring, raceway, bundle, kin) <= apart:
                continue
        _wrenches_near(scratch, bl)
        add_slope(bl.own, c, fm[2], fm[0], step)
        add_slope(bl.from_ball[p], c, fm[3], fm[1], step)
    for c in range(NS):
        column = NS * p + c
        if index[column] < 0 or (c == STHETA and raceway.surface_on == 0 and raceway.waves[0] == raceway.waves[1]):
            continue
        step = body_step(c, False)
        near_ring[0] = ring
        bl.body[c] += step
        if touch(ball, near_ring[0], raceway, bundle, kin) <= apart:
            near_ring[0] = ring
            step = -step
            bl.body[c] += step
            if touch(ball, near_ring[0], raceway, bundle, kin) <= apart:
                continue
        _wrenches_near(scratch, bl)
        add_slope(bl.to_shared, column, fm[2], fm[0], step)
        add_slope(on_ring, column, fm[3], fm[1], step)


@helper
def _wave_columns(ball, j, ring, raceway, row, bundle, bl):
    """Add the waves' effect on a contact.

    They are those of an elastic ring; also what changes the contact's push on them.
    """
    scratch, r = bundle.scratch[0], row.number
    p, kin, fm = bl.reach.place[r, raceway.body], scratch.kinematics[1], bl.wrenches
    near_ball, near_ring = bl.ball.view(BALL), bl.body.view(BODY_STATE)
    wave_pushes(raceway, scratch.kinematics[0], scratch.wrench[0], bl.pushes[0])
    for c in range(NB + NS):
        if c >= NB and bl.reach.index[r, NS * p + c - NB] < 0:
            continue
        step = ball_step(c, False) if c < NB else body_step(c - NB, False)
        for _ in range(2):
            near_ball[0] = ball
            near_ring[0] = ring
            if c < NB:
                bl.ball[c] += step
            else:
                bl.body[c - NB] += step
            if touch(near_ball[0], near_ring[0], raceway, bundle, kin) > -near(raceway, bundle.system[0]):
                _wrenches_near(scratch, bl)
                if c < NB:
                    push_slopes(raceway, r, bundle, bl.from_ball, c, step, bl)
                else:
                    push_slopes(raceway, r, bundle, bl.parts[j], NS * p + c - NB, step, bl)
                break
            step = -step
    for i in range(raceway.waves[0], raceway.waves[1]):
        body = bundle.waves[i].body
        first = NS * bl.reach.place[r, body]
        for c in (SY, SZ, SVY, SVZ):
            kept, step = bundle.shared[NS * body + c], body_step(c, False)
            for _ in range(2):
                bundle.shared[NS * body + c] = kept + step
                touches = touch(ball, ring, raceway, bundle, kin) > -near(raceway, bundle.system[0])
                bundle.shared[NS * body + c] = kept
                if touches:
                    _wrenches_near(scratch, bl)
                    add_slope(bl.to_shared, first + c, fm[2], fm[0], step)
                    add_slope(bl.parts[j, p], first + c, fm[3], fm[1], step)
                    push_slopes(raceway, r, bundle, bl.parts[j], first + c, step, bl)
                    break
                step = -step


@helper
def raceway_columns(ball, j, row, bundle, bl):
    """Add ball j's raceway contacts to the slopes.

    The slopes are those of forces.
    """
    scratch = bundle.scratch[0]
    kin = scratch.kinematics[0]
    for k in range(row.first_raceway, row.first_raceway + row.raceways):
        raceway = bundle.raceways[k]
        ring = bundle.bodies_now[raceway.body]
        delta = touch(ball, ring, raceway, bundle, kin)
        if delta <= -near(raceway, bundle.system[0]):
            continue
        if not delta < np.inf:
            scratch.fault.ball = j
            return 0
        hand_states(raceway, j, bundle)
        laws = raceway_laws(bundle.laws.raceways, raceway.laws)
        ok = bundle.tangent(
            raceway, laws, bundle.par, bundle.system[0], bundle.grid, bundle.cells, scratch, bl.slope[0]
        )
        if ok != 1:
            scratch.fault.ball = j
            return 0
        _contact_columns(ball, j, ring, raceway, row, bundle, bl)
        if raceway.waves[1] > raceway.waves[0]:
            _wave_columns(ball, j, ring, raceway, row, bundle, bl)
    return 1
