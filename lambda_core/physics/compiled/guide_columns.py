"""Slopes of the forces of pockets, neighbouring balls and lands, by differences of their laws."""

from __future__ import annotations

from lambda_core.physics.compiled.cage import (
    G_R,
    guide_force,
    land_apply,
    land_state,
    neighbour_apply,
    neighbour_state,
    pocket_apply,
    pocket_state,
)
from lambda_core.physics.compiled.layout import (
    BPSI,
    CAGE,
    FAULT,
    GUIDE,
    INNER,
    NB,
    NS,
    OUT,
    P_LAND,
    P_POCKET,
    SHARED,
    helper,
    par_of,
)
from lambda_core.physics.compiled.steps import ball_step, body_step


@helper
def pocket_columns(y, j, bundle, bl):
    """Add the pocket of ball j; a pocket without force is skipped."""
    scratch = bundle.scratch
    system = bundle.system[0]
    ball = y[NB * j : NB * j + NB]
    cage = scratch[SHARED][NS * CAGE : NS * CAGE + NS]
    law, par, g, out, fm = (
        bundle.laws.pocket,
        par_of(bundle.par, system, P_POCKET),
        scratch[GUIDE],
        scratch[OUT],
        bl.fm,
    )
    pocket_state(ball, cage, j, system, g)
    if guide_force(law, par, g, system.eta0, out, scratch[FAULT], -1.0) != 1:
        return 0
    if out[0] == 0.0 and out[1] == 0.0 and out[2] == 0.0:
        return 1
    fm[:, :] = 0.0
    pocket_apply(ball, cage, g, out, fm[0], fm[1])
    for k in range(NB + NS):
        fm[2, :] = 0.0
        fm[3, :] = 0.0
        if k < NB:
            step = ball_step(k, True)
            for i in range(NB):
                bl.ball[i] = ball[i]
            bl.ball[k] += step
            pocket_state(bl.ball, cage, j, system, g)
            if guide_force(law, par, g, system.eta0, out, scratch[FAULT], -1.0) != 1:
                return 0
            pocket_apply(bl.ball, cage, g, out, fm[2], fm[3])
            for i in range(6):
                bl.own[i, k] += (fm[2, i] - fm[0, i]) / step
                bl.from_ball[CAGE, i, k] += (fm[3, i] - fm[1, i]) / step
        else:
            c = k - NB
            column = NS * CAGE + c
            step = body_step(c, True)
            for i in range(NS):
                bl.body[i] = cage[i]
            bl.body[c] += step
            pocket_state(ball, bl.body, j, system, g)
            if guide_force(law, par, g, system.eta0, out, scratch[FAULT], -1.0) != 1:
                return 0
            pocket_apply(ball, bl.body, g, out, fm[2], fm[3])
            for i in range(6):
                bl.to_shared[i, column] += (fm[2, i] - fm[0, i]) / step
                bl.shared[CAGE, i, column] += (fm[3, i] - fm[1, i]) / step
    return 1


@helper
def neighbour_columns(y, j, other_index, bundle, bl):
    """Add the ball-ball contact to ball j's own block; the pair's coupling is left to the iteration."""
    scratch = bundle.scratch
    system = bundle.system[0]
    ball = y[NB * j : NB * j + NB]
    other = y[NB * other_index : NB * other_index + NB]
    law, par, g, out, fm = (
        bundle.laws.pocket,
        par_of(bundle.par, system, P_POCKET),
        scratch[GUIDE],
        scratch[OUT],
        bl.fm,
    )
    neighbour_state(ball, other, g)
    if guide_force(law, par, g, system.eta0, out, scratch[FAULT], -1.0) != 1:
        return 0
    if out[0] == 0.0 and out[1] == 0.0 and out[2] == 0.0:
        return 1
    fm[:, :] = 0.0
    neighbour_apply(ball[BPSI], out[3] - g[G_R], out[4] - g[G_R + 1], out[5] - g[G_R + 2], out, 1.0, fm[0])
    for k in range(NB):
        step = ball_step(k, True)
        for i in range(NB):
            bl.ball[i] = ball[i]
        bl.ball[k] += step
        neighbour_state(bl.ball, other, g)
        if guide_force(law, par, g, system.eta0, out, scratch[FAULT], -1.0) != 1:
            return 0
        fm[2, :] = 0.0
        a0, a1, a2 = out[3] - g[G_R], out[4] - g[G_R + 1], out[5] - g[G_R + 2]
        neighbour_apply(bl.ball[BPSI], a0, a1, a2, out, 1.0, fm[2])
        for i in range(6):
            bl.own[i, k] += (fm[2, i] - fm[0, i]) / step
    return 1


@helper
def land_columns(bundle, bl):
    scratch = bundle.scratch
    system = bundle.system[0]
    cage = scratch[SHARED][NS * CAGE : NS * CAGE + NS]
    g, out, fm = scratch[GUIDE], scratch[OUT], bl.fm
    for which in range(2):
        if system.land_on[which] == 0:
            continue
        ring = scratch[SHARED][NS * which : NS * which + NS]
        law = bundle.laws.land_inner if which == INNER else bundle.laws.land_outer
        par = par_of(bundle.par, system, P_LAND + which)
        for side in range(2):
            offset = (2 * side - 1) * system.land_offset
            land_state(cage, ring, offset, g)
            if guide_force(law, par, g, system.eta0, out, scratch[FAULT], which) != 1:
                return 0
            if out[0] == 0.0 and out[1] == 0.0 and out[2] == 0.0:
                continue
            fm[:, :] = 0.0
            land_apply(cage, ring, g, out, fm[0], fm[1])
            for k in range(2 * NS):
                c = k % NS
                column = NS * CAGE + c if k < NS else NS * which + c
                if bl.index[column] < 0:
                    continue
                step = body_step(c, True)
                for i in range(NS):
                    bl.body[i] = cage[i]
                    bl.body2[i] = ring[i]
                if k < NS:
                    bl.body[c] += step
                else:
                    bl.body2[c] += step
                land_state(bl.body, bl.body2, offset, g)
                if guide_force(law, par, g, system.eta0, out, scratch[FAULT], which) != 1:
                    return 0
                fm[2, :] = 0.0
                fm[3, :] = 0.0
                land_apply(bl.body, bl.body2, g, out, fm[2], fm[3])
                for i in range(6):
                    bl.shared[CAGE, i, column] += (fm[2, i] - fm[0, i]) / step
                    bl.shared[which, i, column] += (fm[3, i] - fm[1, i]) / step
    return 1
