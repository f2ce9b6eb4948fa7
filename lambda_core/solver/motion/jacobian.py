"""Compute the block-arrow Jacobian by the chain rule.

Each ball couples to itself and to the bodies:

    J = [ [ A_1,           B_1 ],
          [      ...       ... ],
          [ C_1, ..., C_Z,  D  ] ]

Without a cage, further blocks couple neighbouring balls that touch.
B and C hold the columns and rows of the bodies that the ball touches (:mod:`lambda_core.solver.integrator.reach`).

A contact's wrench depends on the states through nine kinematic numbers; its slope with them is
costly and taken once (:mod:`.tangent`), their slopes with the states and the change of the frame are cheap.
"""

from __future__ import annotations

from lambda_core.solver.arrays.bundle import BPSI, NB, NS
from lambda_core.solver.arrays.jacobian_blocks import AFTER, BEFORE
from lambda_core.solver.cage.guide_columns import land_columns, neighbour_columns, pocket_columns
from lambda_core.solver.contact.raceway_columns import raceway_columns
from lambda_core.solver.contact.ring_waves import turning_columns
from lambda_core.solver.integrator.reach import is_split
from lambda_core.solver.layout import balls_of, helper
from lambda_core.solver.motion.block_rows import (
    ball_block,
    body_rows,
    force_map,
    neighbour_block,
    own_rows,
    shared_rows,
)
from lambda_core.solver.motion.force_elements import drag_force
from lambda_core.solver.motion.links import link_columns
from lambda_core.solver.motion.prescribed import fill_shared
from lambda_core.solver.motion.steps import add_slope, ball_step
from lambda_core.solver.motion.structures import structure_columns
from lambda_core.solver.records import BALL, ROLLERS
from lambda_core.solver.row_code import roller_code
from lambda_core.solver.vec import clear, cosine_sine


@helper
def _drag_columns(ball, row, bundle, bl):
    """Add the drag of a ball to its own block."""
    fm, near = bl.wrenches, bl.ball.view(BALL)
    clear(fm[0])
    if drag_force(ball, row, bundle, fm[0]) < -0.5:
        return 0
    for c in range(2, NB):
        if c in (3, 4):
            continue
        step = ball_step(c, True)
        near[0] = ball
        bl.ball[c] += step
        clear(fm[2])
        if drag_force(near[0], row, bundle, fm[2]) < -0.5:
            return 0
        add_slope(bl.own, c, fm[2], fm[0], step)
    return 1


@helper
def _add_part(bl, r, j):
    """Add ball j's part to the bodies.

    They belong to the slopes of the forces on the bodies, of row r.
    """
    bodies, count, part = bl.reach.bodies[r], bl.reach.count[r], bl.parts[j]
    for p in range(count):
        total = bl.shared[bodies[p]]
        for i in range(6):
            for q in range(count):
                for c in range(NS):
                    total[i, NS * bodies[q] + c] += part[p, i, NS * q + c]


@helper
def _guide_columns(balls, j, row, bundle, bl):
    """Add ball j's pocket or neighbours.

    They are its contacts with the neighbouring balls.
    """
    if row.caged == 1:
        return pocket_columns(balls[j - row.first_ball], j, row, bundle, bl)
    z, i = row.balls, j - row.first_ball
    for side in (BEFORE, AFTER):
        neighbour = balls[(i + (1 if side == AFTER else z - 1)) % z]
        if neighbour_columns(balls[i], neighbour, row, bundle, bl) != 1:
            return 0
        neighbour_block(row, bl, bl.cross[j, side])
    return 1


@helper
def _force_columns(balls, j, row, bundle, bl):
    """Add the slopes of ball j's forces.

    They are those of every force on it and of what it does to the bodies; return 1 when well.
    """
    system, ball = bundle.system[0], balls[j - row.first_ball]
    if raceway_columns(ball, j, row, bundle, bl) != 1:
        return 0
    if system.friction_on == 1:
        if system.guides_on == 1 and _guide_columns(balls, j, row, bundle, bl) != 1:
            return 0
        if row.drag_on == 1 and _drag_columns(ball, row, bundle, bl) != 1:
            return 0
    c, s = cosine_sine(ball.azimuth)
    gy, gz = row.ball_mass * system.gravity[1], row.ball_mass * system.gravity[2]
    bl.own[1, BPSI] += -gy * s + gz * c
    bl.own[2, BPSI] += -gy * c - gz * s
    return 1


@helper
def _ball_blocks(balls, j, row, bundle, bl):
    """Write the blocks A, B, C of ball j.

    It also writes the ball's part of D; return 1 when well.
    """
    reach, r = bl.reach, row.number
    bl.parts[j, :, :, :] = 0.0
    bl.own[:, :] = 0.0
    bl.to_shared[:, :] = 0.0
    bl.from_ball[:, :, :] = 0.0
    if _force_columns(balls, j, row, bundle, bl) != 1:
        return 0
    ball_block(balls[j - row.first_ball], row, bl, bl.a[j], bl.b[j])
    for p in range(reach.count[r]):
        b = reach.bodies[r, p]
        force_map(bundle.bodies[b], bundle.bodies_now[b], bl.map)
        body_rows(p, reach.index[r], bl, bl.c[j])
    return 1


@helper
def _own_part(r, bundle, bl):
    """Write the contacts' part of D.

    It is that of a row, where rows are on several bearings; return 1 when well.
    """
    reach, d_own = bl.reach, bl.d_own[r]
    for p in range(reach.count[r]):
        bl.shared[reach.bodies[r, p], :, :] = 0.0
    if bundle.system[0].guides_on == 1 and land_columns(bundle, r, bl) != 1:
        return 0
    for j in range(reach.first[r], reach.first[r + 1]):
        _add_part(bl, r, j)
    d_own[:, :] = 0.0
    for p in range(reach.count[r]):
        b = reach.bodies[r, p]
        if bundle.bodies[b].moves == 1:
            force_map(bundle.bodies[b], bundle.bodies_now[b], bl.map)
            own_rows(p, r, bl, d_own)
    return 1


@helper
def _add_own_part(r, sign, bl):
    """Add the contacts' part to D.

    It is that of a row, times a sign.
    """
    columns = bl.reach.columns[r]
    for i in range(bl.reach.width[r]):
        for k in range(bl.reach.width[r]):
            bl.d[columns[i], columns[k]] += sign * bl.d_own[r, i, k]


@helper
def _renew_own_parts(bundle, bl):
    """Renew the contacts' parts of D.

    They are those of the rows whose blocks changed; return 1 when well.

    Where a few balls are due, contacts of one bearing are to blame: the rest of D stands.
    """
    for r in range(bundle.rows.size):
        if bl.changed[r] == 1:
            _add_own_part(r, -1.0, bl)
            if _own_part(r, bundle, bl) != 1:
                return 0
            _add_own_part(r, 1.0, bl)
    return 1


def jacobian(t, y, bundle, bl):
    """Write the due balls' blocks.

    The balls are marked in bl.due at (t, y); call this right after `evaluate` at the same point.

    All are marked unless the caller has taken marks away; afterwards all are again. Uses bundle.body_wrenches of that
    evaluation for the bodies' own equations. Returns 1 when well.
    """
    system = bundle.system[0]
    if fill_shared(t, y, bundle) != 1:
        return 0
    renewed = 0
    for r in range(bundle.rows.size):
        row = bundle.rows[r]
        if row.kind == ROLLERS:
            due = roller_code(bundle.rollers, 0).jacobian(y, r, bundle, bl)
            if due < 0:
                return 0
            renewed += due
            continue
        balls = balls_of(y, row)
        for j in range(row.first_ball, row.first_ball + row.balls):
            if bl.due[j] == 0:
                continue
            bl.changed[r], bl.newer[j] = 1, 1
            renewed += 1
            if _ball_blocks(balls, j, row, bundle, bl) != 1:
                return 0
    several = is_split(bl.reach, bl.d.shape[0])
    if several and renewed < system.balls:
        bl.due[:] = 1
        return _renew_own_parts(bundle, bl)
    bl.shared[:, :, :] = 0.0
    if not several and system.guides_on == 1 and land_columns(bundle, -1, bl) != 1:
        return 0
    if link_columns(t, bundle, bl) != 1:
        return 0
    structure_columns(bundle, bl)
    turning_columns(bundle, bl)
    for r in range(bundle.rows.size):
        for j in range(bl.reach.first[r], bl.reach.first[r + 1]):
            bl.due[j] = 1
            if not several:
                _add_part(bl, r, j)
    bl.d[:, :] = 0.0
    for b in range(bundle.bodies.size):
        if bundle.bodies[b].moves == 0:
            continue
        force_map(bundle.bodies[b], bundle.bodies_now[b], bl.map)
        shared_rows(b, bundle, bl)
    if several:
        for r in range(bundle.rows.size):
            if _own_part(r, bundle, bl) != 1:
                return 0
            _add_own_part(r, 1.0, bl)
    return 1
