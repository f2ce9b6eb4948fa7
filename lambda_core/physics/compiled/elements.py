"""Force elements of the right-hand side: raceways, cage, drag."""

from __future__ import annotations

import math

import numpy as np

from lambda_core.physics.compiled.cage import (
    G_R,
    guide_force,
    guide_loss,
    land_apply,
    land_state,
    neighbour_apply,
    neighbour_state,
    pocket_apply,
    pocket_state,
)
from lambda_core.physics.compiled.faults import report
from lambda_core.physics.compiled.kinematics import apply_wrench, contact_kinematics, surface_lift
from lambda_core.physics.compiled.layout import (
    BODY_FM,
    BPSI,
    BVT,
    BWR,
    BWT,
    BWX,
    CAGE,
    FAULT,
    GUIDE,
    INNER,
    KIN,
    L_LAND,
    L_POCKET,
    NB,
    NS,
    OUT,
    P_DRAG,
    P_LAND,
    P_POCKET,
    R_DRAG,
    RING_FM,
    SCALARS,
    SHARED,
    STILL,
    WRENCH,
    helper,
    par_of,
)
from lambda_core.physics.compiled.losses import raceway_losses

_SPIN_FLOOR = 1e-3  # [rad/s] below which a ball's churning moment fades out


@helper
def clear_forces(bundle):
    """Begin the sums of forces on balls and bodies."""
    bundle.ball_fm[:, :] = 0.0
    bundle.scratch[BODY_FM : BODY_FM + 3, :6] = 0.0


@helper
def add_contact(which, ball_fm, scratch):
    """Add the wrench of a raceway contact in scratch to the forces on its ball and its ring."""
    apply_wrench(scratch[KIN], scratch[WRENCH], ball_fm, scratch[RING_FM])
    for k in range(6):
        scratch[BODY_FM + which, k] += scratch[RING_FM][k]


@helper
def raceway_forces(y, j, bundle, rates, want):
    """Add both raceway contacts of ball j; with `want`, add their losses to rates."""
    scratch = bundle.scratch
    system = bundle.system[0]
    ball = y[NB * j : NB * j + NB]
    ball_fm = bundle.ball_fm[j]
    for which in range(2):
        ring = scratch[SHARED][NS * which : NS * which + NS]
        kin = scratch[KIN]
        if system.surfaces == 1:
            surface_lift(ball, ring, which, bundle, kin)
        delta = contact_kinematics(ball, ring, which, system, kin)
        if delta <= 0.0:
            continue
        if not delta < np.inf:
            scratch[FAULT][2] = j
            return 0
        laws = bundle.laws.inner if which == INNER else bundle.laws.outer
        ok = bundle.wrench(
            which, kin, laws, bundle.par, bundle.system, bundle.grid, bundle.cells[0], scratch,
            scratch[SCALARS], scratch[WRENCH],
        )  # fmt: skip
        if ok != 1:
            scratch[FAULT][2] = j
            return 0
        add_contact(which, ball_fm, scratch)
        if want == 1 and system.friction_on == 1:
            raceway_losses(which, kin, system, bundle.grid, scratch[SCALARS], bundle.cells[0], rates)
    return 1


@helper
def drag_force(ball, bundle, ball_fm):
    """Add fluid drag and churning of one ball; returns the power lost [W], or -1 on a fault."""
    scratch = bundle.scratch
    system = bundle.system[0]
    w = math.sqrt(ball[BWX] ** 2 + ball[BWR] ** 2 + ball[BWT] ** 2)
    nu = system.eta0 / system.rho0
    scratch[OUT][:2] = np.nan
    status = bundle.laws.drag(
        ball[BVT], w, ball[BPSI], nu, system.rho0, par_of(bundle.par, system, P_DRAG), scratch[OUT]
    )
    force, moment = scratch[OUT][0], scratch[OUT][1]
    if status != 1 or not abs(force) + abs(moment) < np.inf:
        report(scratch[FAULT], R_DRAG, status, -1.0, ball[BVT], w, ball[BPSI], nu)
        return -1.0
    moment /= math.sqrt(w * w + _SPIN_FLOOR * _SPIN_FLOOR)
    ball_fm[2] -= force
    ball_fm[3] -= moment * ball[BWX]
    ball_fm[4] -= moment * ball[BWR]
    ball_fm[5] -= moment * ball[BWT]
    return force * ball[BVT] + moment * w * w


@helper
def cage_forces(y, bundle, rates, want):
    """Add pockets and lands, or ball-ball contacts when there is no cage."""
    scratch = bundle.scratch
    system = bundle.system[0]
    g, out, fault, eta0 = scratch[GUIDE], scratch[OUT], scratch[FAULT], system.eta0
    cage = scratch[SHARED][NS * CAGE : NS * CAGE + NS]
    z = system.balls
    law, par = bundle.laws.pocket, par_of(bundle.par, system, P_POCKET)
    for j in range(z):
        ball = y[NB * j : NB * j + NB]
        k = (j + 1) % z
        other = y[NB * k : NB * k + NB]
        if system.cage_on == 1:
            pocket_state(ball, cage, j, system, g)
        else:
            neighbour_state(ball, other, g)
        if guide_force(law, par, g, eta0, out, fault, -1.0) != 1:
            fault[2] = j
            return 0
        if want == 1:
            rates[L_POCKET if system.cage_on == 1 else L_LAND] += guide_loss(law, par, g, eta0, out, scratch[STILL])
        if system.cage_on == 1:
            pocket_apply(ball, cage, g, out, bundle.ball_fm[j], scratch[BODY_FM + CAGE])
        else:
            a0, a1, a2 = out[3] - g[G_R], out[4] - g[G_R + 1], out[5] - g[G_R + 2]
            neighbour_apply(ball[BPSI], a0, a1, a2, out, 1.0, bundle.ball_fm[j])
            neighbour_apply(other[BPSI], out[3], out[4], out[5], out, -1.0, bundle.ball_fm[k])
    for which in range(2):
        if system.land_on[which] == 0 or system.cage_on == 0:
            continue
        ring = scratch[SHARED][NS * which : NS * which + NS]
        law = bundle.laws.land_inner if which == INNER else bundle.laws.land_outer
        par = par_of(bundle.par, system, P_LAND + which)
        for side in range(2):
            land_state(cage, ring, (2 * side - 1) * system.land_offset, g)
            if guide_force(law, par, g, eta0, out, fault, which) != 1:
                return 0
            if want == 1:
                rates[L_LAND] += guide_loss(law, par, g, eta0, out, scratch[STILL])
            land_apply(cage, ring, g, out, scratch[BODY_FM + CAGE], scratch[BODY_FM + which])
    return 1
