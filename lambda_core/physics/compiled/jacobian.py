"""Jacobian of the right-hand side in block-arrow form, by the chain rule through the stages.

Each ball couples only to itself and to the shared bodies:

    J = [[A_1,           B_1],
         [     ...       ...],
         [C_1, ..., C_Z,  D ]]

A contact's wrench depends on the states through nine kinematic numbers q; its slope d(wrench)/dq is
costly and taken once (:mod:`.tangent`), dq/d(state) and the change of the frame are cheap.
"""

from __future__ import annotations

import math

from lambda_core.physics.compiled.block_rows import ball_block, body_rows, force_map, shared_rows
from lambda_core.physics.compiled.elements import drag_force
from lambda_core.physics.compiled.guide_columns import land_columns, neighbour_columns, pocket_columns
from lambda_core.physics.compiled.layout import BPSI, CAGE, NB, NS, SHARED, helper
from lambda_core.physics.compiled.raceway_columns import raceway_columns
from lambda_core.physics.compiled.steps import ball_step
from lambda_core.physics.compiled.timefunctions import fill_shared


@helper
def _drag_columns(ball, bundle, bl):
    fm = bl.fm
    fm[0, :] = 0.0
    if drag_force(ball, bundle, fm[0]) < -0.5:
        return 0
    for c in range(2, NB):
        if c in (3, 4):
            continue
        step = ball_step(c, True)
        for i in range(NB):
            bl.ball[i] = ball[i]
        bl.ball[c] += step
        fm[2, :] = 0.0
        if drag_force(bl.ball, bundle, fm[2]) < -0.5:
            return 0
        for i in range(6):
            bl.own[i, c] += (fm[2, i] - fm[0, i]) / step
    return 1


@helper
def _keep_part(bl, j):
    """Keep what ball j adds to the slopes of the forces on the bodies."""
    for b in range(3):
        for i in range(6):
            for c in range(3 * NS):
                bl.parts[j, b, i, c] = bl.shared[b, i, c]


@helper
def _add_part(bl, j):
    """Add what ball j adds to the slopes of the forces on the bodies."""
    for b in range(3):
        for i in range(6):
            for c in range(3 * NS):
                bl.shared[b, i, c] += bl.parts[j, b, i, c]


@helper
def _force_columns(y, j, bundle, bl):
    """Add the slopes of every force on ball j, and of what it does to the bodies; returns 1 when well."""
    system = bundle.system[0]
    z, ball = system.balls, y[NB * j : NB * j + NB]
    if raceway_columns(y, j, bundle, bl) != 1:
        return 0
    if system.friction_on == 1:
        if system.guides_on == 1 and system.cage_on == 1:
            if pocket_columns(y, j, bundle, bl) != 1:
                return 0
        elif system.guides_on == 1:
            if neighbour_columns(y, j, (j + 1) % z, bundle, bl) != 1:
                return 0
            if neighbour_columns(y, j, (j + z - 1) % z, bundle, bl) != 1:
                return 0
        if system.drag_on == 1 and _drag_columns(ball, bundle, bl) != 1:
            return 0
    c, s = math.cos(ball[BPSI]), math.sin(ball[BPSI])
    gy, gz = system.ball_mass * system.gravity[1], system.ball_mass * system.gravity[2]
    bl.own[1, BPSI] += -gy * s + gz * c
    bl.own[2, BPSI] += -gy * c - gz * s
    return 1


def jacobian(t, y, bundle, bl):
    """Write the blocks of the balls marked in bl.due at (t, y); call right after `evaluate` at the same point.

    All are marked unless the caller has taken marks away; afterwards all are again. Uses scratch[BODY_FM] of that
    evaluation for the bodies' own equations. Returns 1 when well.
    """
    scratch = bundle.scratch
    system = bundle.system[0]
    z = system.balls
    fill_shared(t, y, bundle)
    for j in range(z):
        if bl.due[j] == 0:
            continue
        bl.shared[:, :, :] = 0.0
        bl.own[:, :] = 0.0
        bl.to_shared[:, :] = 0.0
        bl.from_ball[:, :, :] = 0.0
        if _force_columns(y, j, bundle, bl) != 1:
            return 0
        ball_block(y[NB * j : NB * j + NB], system, bl, bl.a[j], bl.b[j])
        for b in range(3):
            body = scratch[SHARED][NS * b : NS * b + NS]
            force_map(body, b, system, bl.map)
            body_rows(b, j, bundle, bl, bl.c[j])
        _keep_part(bl, j)
    bl.shared[:, :, :] = 0.0
    if system.guides_on == 1 and system.cage_on == 1 and land_columns(bundle, bl) != 1:
        return 0
    for j in range(z):
        bl.due[j] = 1
        _add_part(bl, j)
    bl.d[:, :] = 0.0
    for b in range(3):
        if b == CAGE and system.cage_on == 0:
            continue
        body = scratch[SHARED][NS * b : NS * b + NS]
        force_map(body, b, system, bl.map)
        shared_rows(b, bundle, bl)
    return 1
