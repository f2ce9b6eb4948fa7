"""Slopes of the forces of both raceway contacts of a ball with its own and the rings' states."""

from __future__ import annotations

import numpy as np

from lambda_core.physics.compiled.kinematics import apply_wrench, contact_kinematics, surface_lift
from lambda_core.physics.compiled.layout import FAULT, INNER, KIN, KIN2, NB, NS, SHARED, STHETA, WRENCH, WRENCH2, helper
from lambda_core.physics.compiled.steps import ball_step, body_step
from lambda_core.physics.compiled.tangent import wrench_at


@helper
def _contact_columns(ball, ring, which, bundle, bl):
    """Add one raceway contact to the force slopes; scratch holds its kinematics and wrench."""
    scratch = bundle.scratch
    system = bundle.system[0]
    fm = bl.fm
    fm[:, :] = 0.0
    apply_wrench(scratch[KIN], scratch[WRENCH], fm[0], fm[1])
    for c in range(NB):
        step = ball_step(c, False)
        for i in range(NB):
            bl.ball[i] = ball[i]
        bl.ball[c] += step
        if system.surfaces == 1:
            surface_lift(bl.ball, ring, which, bundle, scratch[KIN2])
        if contact_kinematics(bl.ball, ring, which, system, scratch[KIN2]) <= 0.0:
            # The step leaves a lightly loaded contact, which deserves its stiffness all the same: step back instead.
            step = -step
            bl.ball[c] = ball[c] + step
            if system.surfaces == 1:
                surface_lift(bl.ball, ring, which, bundle, scratch[KIN2])
            if contact_kinematics(bl.ball, ring, which, system, scratch[KIN2]) <= 0.0:
                continue
        wrench_at(scratch[KIN2], scratch[KIN], scratch[WRENCH], bl.slope, scratch[WRENCH2])
        fm[2, :] = 0.0
        apply_wrench(scratch[KIN2], scratch[WRENCH2], fm[2], fm[3])
        for i in range(6):
            bl.own[i, c] += (fm[2, i] - fm[0, i]) / step
            bl.from_ball[which, i, c] += (fm[3, i] - fm[1, i]) / step
    for c in range(NS):
        column = NS * which + c
        if bl.index[column] < 0 or (c == STHETA and system.surface_on[which] == 0):
            continue
        step = body_step(c, False)
        for i in range(NS):
            bl.body[i] = ring[i]
        bl.body[c] += step
        if system.surfaces == 1:
            surface_lift(ball, bl.body, which, bundle, scratch[KIN2])
        if contact_kinematics(ball, bl.body, which, system, scratch[KIN2]) <= 0.0:
            step = -step
            bl.body[c] = ring[c] + step
            if system.surfaces == 1:
                surface_lift(ball, bl.body, which, bundle, scratch[KIN2])
            if contact_kinematics(ball, bl.body, which, system, scratch[KIN2]) <= 0.0:
                continue
        wrench_at(scratch[KIN2], scratch[KIN], scratch[WRENCH], bl.slope, scratch[WRENCH2])
        fm[2, :] = 0.0
        apply_wrench(scratch[KIN2], scratch[WRENCH2], fm[2], fm[3])
        for i in range(6):
            bl.to_shared[i, column] += (fm[2, i] - fm[0, i]) / step
            bl.shared[which, i, column] += (fm[3, i] - fm[1, i]) / step


@helper
def raceway_columns(y, j, bundle, bl):
    scratch = bundle.scratch
    system = bundle.system[0]
    ball = y[NB * j : NB * j + NB]
    for which in range(2):
        ring = scratch[SHARED][NS * which : NS * which + NS]
        if system.surfaces == 1:
            surface_lift(ball, ring, which, bundle, scratch[KIN])
        delta = contact_kinematics(ball, ring, which, system, scratch[KIN])
        if delta <= 0.0:
            continue
        if not delta < np.inf:
            scratch[FAULT][2] = j
            return 0
        laws = bundle.laws.inner if which == INNER else bundle.laws.outer
        ok = bundle.tangent(
            which, scratch[KIN], laws, bundle.par, bundle.system, bundle.grid, bundle.cells,
            scratch, bl.slope,
        )  # fmt: skip
        if ok != 1:
            scratch[FAULT][2] = j
            return 0
        _contact_columns(ball, ring, which, bundle, bl)
    return 1
