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
from typing import Any, NamedTuple

import numpy as np
from numba import types

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
from lambda_core.physics.compiled.forces import body_rates, drag_force
from lambda_core.physics.compiled.kinematics import (
    apply_wrench,
    axis_x,
    contact_kinematics,
    surface_lift,
)
from lambda_core.physics.compiled.layout import (
    BODY_FM,
    BPSI,
    BR,
    BVR,
    BVT,
    BVX,
    BWR,
    BWT,
    CAGE,
    FAULT,
    GUIDE,
    INNER,
    KIN,
    KIN2,
    NB,
    NI,
    NS,
    OUT,
    P_LAND,
    P_POCKET,
    RATE,
    SAY,
    SAZ,
    SHARED,
    SSIGMA,
    STHETA,
    SVX,
    SWY,
    SWZ,
    WRENCH,
    WRENCH2,
    array1,
    array2,
    array3,
    array4,
    helper,
    iarray1,
    par_of,
)
from lambda_core.physics.compiled.tangent import wrench_at
from lambda_core.physics.compiled.timefunctions import fill_shared

_POSITION = 1e-8  # [m]
_ANGLE = 1e-7  # [rad]
_LINEAR = 1e-2  # velocities enter the kinematics linearly
_SLOW = 1e-5  # [m/s] step for laws that are called with the velocity itself
_TURN = 1e-3  # [rad/s] likewise


class Blocks(NamedTuple):
    """Jacobian blocks and workspaces."""

    a: Any  # (Z, 9, 9)
    b: Any  # (Z, 9, n_active)
    c: Any  # (Z, n_active, 9)
    d: Any  # (n_active, n_active)
    own: Any  # (6, 9) d(ball force)/d(ball)
    to_shared: Any  # (6, 36) d(ball force)/d(shared)
    from_ball: Any  # (3, 6, 9) d(body force)/d(ball)
    shared: Any  # (3, 6, 36) d(body force)/d(shared), of one ball, then summed
    parts: Any  # (Z, 3, 6, 36) the same of every ball
    reach: Any  # (Z, 3, 6, 9) d(body force)/d(ball) of every ball
    due: Any  # int64 (Z,): whether the next call renews this ball; it leaves 1 everywhere
    slope: Any  # (6, 9) d(wrench)/dq
    ball: Any  # (9,) perturbed
    body: Any  # (12,) perturbed
    body2: Any  # (12,) perturbed
    fm: Any  # (4, 6): base and perturbed force and moment of ball and body
    map: Any  # (12, 6) d(rate)/d(force, moment) of one body
    rates: Any  # (NI,) scratch
    index: Any  # int64 (36,): position among the free shared states, or -1


_BLOCK_TYPES = {
    "a": array3,
    "b": array3,
    "c": array3,
    "from_ball": array3,
    "shared": array3,
    "parts": array4,
    "reach": array4,
    "due": iarray1,
    "index": iarray1,
}
_BLOCK_TYPES.update(dict.fromkeys(("d", "own", "to_shared", "slope", "fm", "map"), array2))
blocks_t = types.NamedTuple([_BLOCK_TYPES.get(name, array1) for name in Blocks._fields], Blocks)


def make_blocks(balls: int, active: np.ndarray) -> Blocks:
    """Allocate the blocks for `balls` balls and the free shared states `active`."""
    n = active.size
    index = np.full(3 * NS, -1, dtype=np.int64)
    index[active] = np.arange(n)
    zeros = np.zeros
    return Blocks(
        zeros((balls, NB, NB)),
        zeros((balls, NB, n)),
        zeros((balls, n, NB)),
        zeros((n, n)),
        zeros((6, NB)),
        zeros((6, 3 * NS)),
        zeros((3, 6, NB)),
        zeros((3, 6, 3 * NS)),
        zeros((balls, 3, 6, 3 * NS)),
        zeros((balls, 3, 6, NB)),
        np.ones(balls, dtype=np.int64),
        zeros((6, 9)),
        zeros(NB),
        zeros(NS),
        zeros(NS),
        zeros((4, 6)),
        zeros((NS, 6)),
        zeros(NI),
        index,
    )


@helper
def _ball_step(c, direct):
    """Return the difference step of ball state c; `direct` for laws called with velocities."""
    if c < 2:
        return _POSITION
    if c == 2:
        return _ANGLE
    if not direct:
        return _LINEAR
    return _SLOW if c < 6 else _TURN


@helper
def _body_step(c, direct):
    """Return the difference step of shared state c."""
    if c < 3:
        return _POSITION
    if c < 6:
        return _ANGLE
    if not direct:
        return _LINEAR
    return _SLOW if c < 9 else _TURN


@helper
def _contact_columns(ball, ring, which, bundle, bl):
    """Add one raceway contact to the force slopes; scratch holds its kinematics and wrench."""
    scratch = bundle.scratch
    system = bundle.system[0]
    fm = bl.fm
    fm[:, :] = 0.0
    apply_wrench(scratch[KIN], scratch[WRENCH], fm[0], fm[1])
    for c in range(NB):
        step = _ball_step(c, False)
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
        step = _body_step(c, False)
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
def _raceway_columns(y, j, bundle, bl):
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


@helper
def _pocket_columns(y, j, bundle, bl):
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
            step = _ball_step(k, True)
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
            step = _body_step(c, True)
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
def _neighbour_columns(y, j, other_index, bundle, bl):
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
    neighbour_apply(
        ball[BPSI],
        out[3] - g[G_R],
        out[4] - g[G_R + 1],
        out[5] - g[G_R + 2],
        out,
        1.0,
        fm[0],
    )
    for k in range(NB):
        step = _ball_step(k, True)
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
def _drag_columns(ball, bundle, bl):
    fm = bl.fm
    fm[0, :] = 0.0
    if drag_force(ball, bundle, fm[0]) < -0.5:
        return 0
    for c in range(2, NB):
        if c in (3, 4):
            continue
        step = _ball_step(c, True)
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
def _land_columns(bundle, bl):
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
                step = _body_step(c, True)
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


@helper
def _ball_block(ball, system, bl, a, b):
    """Turn force slopes into the rows of one ball."""
    r, vt, vr = ball[BR], ball[BVT], ball[BVR]
    orbit = vt / r
    for i in range(6):
        inverse = 1.0 / system.ball_mass if i < 3 else 1.0 / system.ball_inertia
        for c in range(NB):
            a[3 + i, c] = bl.own[i, c] * inverse
        for column in range(3 * NS):
            k = bl.index[column]
            if k >= 0:
                b[3 + i, k] = bl.to_shared[i, column] * inverse
    for i in range(3):
        for c in range(NB):
            a[i, c] = 0.0
        for k in range(b.shape[1]):
            b[i, k] = 0.0
    a[0, BVX] = 1.0
    a[1, BVR] = 1.0
    a[2, BVT] = 1.0 / r
    a[2, BR] = -orbit / r
    a[4, BVT] += 2.0 * orbit
    a[4, BR] -= orbit * orbit
    a[5, BVR] -= orbit
    a[5, BVT] -= vr / r
    a[5, BR] += vr * orbit / r
    wr, wt = ball[BWR], ball[BWT]
    a[7, BWT] += orbit
    a[7, BVT] += wt / r
    a[7, BR] -= wt * orbit / r
    a[8, BWR] -= orbit
    a[8, BVT] -= wr / r
    a[8, BR] += wr * orbit / r


@helper
def _force_map(body, b, system, m):
    """Write d(rate)/d(force, moment) of a shared body, (12, 6)."""
    m[:, :] = 0.0
    ay, az = body[SAY], body[SAZ]
    ax = axis_x(ay, az)
    for i in range(3):
        m[SVX + i, i] = 1.0 / system.mass[b]
    it, ip = 1.0 / system.transverse_inertia[b], 1.0 / system.polar_inertia[b]
    m[SWY, 3], m[SWY, 4], m[SWY, 5] = -ax * ay * it, (1.0 - ay * ay) * it, -az * ay * it
    m[SWZ, 3], m[SWZ, 4], m[SWZ, 5] = -ax * az * it, -ay * az * it, (1.0 - az * az) * it
    m[SSIGMA, 3], m[SSIGMA, 4], m[SSIGMA, 5] = ax * ip, ay * ip, az * ip


@helper
def _body_rows(b, j, bundle, bl, c_block):
    """Add d(body b)/d(ball j) to the block C_j."""
    for row in range(NS):
        k = bl.index[NS * b + row]
        if k < 0:
            continue
        for col in range(NB):
            total = 0.0
            for i in range(6):
                total += bl.map[row, i] * bl.from_ball[b, i, col]
            c_block[k, col] = total


@helper
def _shared_rows(b, bundle, bl):
    """Write the rows of body b in D: its own equations of motion and all forces on it."""
    scratch = bundle.scratch
    system = bundle.system[0]
    body = scratch[SHARED][NS * b : NS * b + NS]
    fm = scratch[BODY_FM + b]
    d = bl.d
    for row in range(NS):
        k = bl.index[NS * b + row]
        if k < 0:
            continue
        for column in range(3 * NS):
            kc = bl.index[column]
            if kc >= 0:
                total = 0.0
                for i in range(6):
                    total += bl.map[row, i] * bl.shared[b, i, column]
                d[k, kc] = total
    body_rates(body, b, fm, bundle.channels, system, bl.body2, bl.rates, 0)
    for c in range(NS):
        kc = bl.index[NS * b + c]
        if kc < 0:
            continue
        step = _body_step(c, False)
        for i in range(NS):
            bl.body[i] = body[i]
        bl.body[c] += step
        body_rates(bl.body, b, fm, bundle.channels, system, scratch[RATE], bl.rates, 0)
        for row in range(NS):
            k = bl.index[NS * b + row]
            if k >= 0:
                d[k, kc] += (scratch[RATE][row] - bl.body2[row]) / step


@helper
def _keep_part(bl, j):
    """Keep what ball j adds to the slopes of the forces on the bodies."""
    for b in range(3):
        for i in range(6):
            for c in range(NB):
                bl.reach[j, b, i, c] = bl.from_ball[b, i, c]
            for c in range(3 * NS):
                bl.parts[j, b, i, c] = bl.shared[b, i, c]


@helper
def _add_part(bl, j):
    """Add what ball j adds to the slopes of the forces on the bodies."""
    for b in range(3):
        for i in range(6):
            for c in range(3 * NS):
                bl.shared[b, i, c] += bl.parts[j, b, i, c]


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
        ball = y[NB * j : NB * j + NB]
        bl.shared[:, :, :] = 0.0
        bl.own[:, :] = 0.0
        bl.to_shared[:, :] = 0.0
        bl.from_ball[:, :, :] = 0.0
        if _raceway_columns(y, j, bundle, bl) != 1:
            return 0
        if system.friction_on == 1:
            if system.guides_on == 1 and system.cage_on == 1:
                if _pocket_columns(y, j, bundle, bl) != 1:
                    return 0
            elif system.guides_on == 1:
                if _neighbour_columns(y, j, (j + 1) % z, bundle, bl) != 1:
                    return 0
                if _neighbour_columns(y, j, (j + z - 1) % z, bundle, bl) != 1:
                    return 0
            if system.drag_on == 1 and _drag_columns(ball, bundle, bl) != 1:
                return 0
        c, s = math.cos(ball[BPSI]), math.sin(ball[BPSI])
        gy, gz = (
            system.ball_mass * system.gravity[1],
            system.ball_mass * system.gravity[2],
        )
        bl.own[1, BPSI] += -gy * s + gz * c
        bl.own[2, BPSI] += -gy * c - gz * s
        _ball_block(ball, system, bl, bl.a[j], bl.b[j])
        for b in range(3):
            body = scratch[SHARED][NS * b : NS * b + NS]
            _force_map(body, b, system, bl.map)
            _body_rows(b, j, bundle, bl, bl.c[j])
        _keep_part(bl, j)
    bl.shared[:, :, :] = 0.0
    if system.guides_on == 1 and system.cage_on == 1 and _land_columns(bundle, bl) != 1:
        return 0
    for j in range(z):
        bl.due[j] = 1
        _add_part(bl, j)
    bl.d[:, :] = 0.0
    for b in range(3):
        if b == CAGE and system.cage_on == 0:
            continue
        body = scratch[SHARED][NS * b : NS * b + NS]
        _force_map(body, b, system, bl.map)
        _shared_rows(b, bundle, bl)
    return 1
