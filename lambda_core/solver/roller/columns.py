"""Compute Jacobian blocks of rollers.

An entry point of its own, called by pointer.

The wrench of a line depends on the states through thirteen kinematic numbers (records.LINE_DRIVERS), that of a rib
through the first nine. Its slopes with them are differences of the whole contact, taken once; their slopes with the
states are differences of the kinematics. Forces of pockets and the equations of motion are differenced as they are.
"""

from __future__ import annotations

import math

import numpy as np

from lambda_core.solver.arrays.bundle import BPSI, BVT, NB, NR, NS, STHETA, SVY, SVZ, SY, SZ
from lambda_core.solver.arrays.jacobian_blocks import AFTER, BEFORE
from lambda_core.solver.contact.contact_kinematics import near
from lambda_core.solver.contact.ring_waves import add_push_slope, push_slopes, wave_pushes
from lambda_core.solver.layout import helper
from lambda_core.solver.motion.block_rows import force_map
from lambda_core.solver.motion.steps import add_slope, ball_step, body_step
from lambda_core.solver.records import BODY_STATE, DRIVERS, LINE, ROLLER
from lambda_core.solver.roller.kinematics import apply_roller_wrench
from lambda_core.solver.roller.motion import roller_rates
from lambda_core.solver.roller.neighbours import neighbour_forces
from lambda_core.solver.roller.pocket import pocket_forces
from lambda_core.solver.roller.rows import roller_drag, roller_wrench, rollers_of, touch_roller
from lambda_core.solver.vec import clear, clear_each, store

_TILT = 1e-7  # [rad]
_RELATIVE = 1e-5  # relative step of what laws depend on, but at least the smallest one
_LEAST = (1e-11, 1e-6, 1e-7, 1e-7, 1e-5, 1e-5, 1e-5, 1e-7, 1e-7, 1e-9, 1e-5, 1e-5, 1e-7)  # as LINE_DRIVERS
_LEAST_STEPS = np.array(_LEAST)
_OF_A_POINT = len(DRIVERS)


@helper
def _step(c, direct):
    """Return the difference step of roller state c."""
    return ball_step(c, direct) if c < NB else _TILT


@helper
def _drivers(kin):
    """Return the drivers of a contact's wrench.

    They have the order of records.LINE_DRIVERS.
    """
    return (
        kin.penetration, kin.normal_velocity, kin.slip_t, kin.slip_s, kin.rotation_t, kin.rotation_s, kin.rotation_n,
        kin.entrainment_t, kin.entrainment_s, kin.line_tilt, kin.line_tilt_rate, kin.entrainment_slope, kin.line_skew,
    )  # fmt: skip


@helper
def _shift(kin, i, step):
    """Change one of what a contact's wrench depends on."""
    if i == 0:
        kin.penetration += step
    elif i == 1:
        kin.normal_velocity += step
    elif i == 2:
        kin.slip_t += step
    elif i == 3:
        kin.slip_s += step
    elif i == 4:
        kin.rotation_t += step
    elif i == 5:
        kin.rotation_s += step
    elif i == 6:
        kin.rotation_n += step
    elif i == 7:
        kin.entrainment_t += step
    elif i == 8:
        kin.entrainment_s += step
    elif i == 9:
        kin.line_tilt += step
    elif i == 10:
        kin.line_tilt_rate += step
    elif i == 11:
        kin.entrainment_slope += step
    else:
        kin.line_skew += step


@helper
def _tangent(raceway, bundle, bl):
    """Write the wrench and its slopes.

    The contact is in scratch, with the drivers; return 0 on a fault.
    """
    scratch = bundle.scratch[0]
    kin, near_kin, base, changed = scratch.kinematics[0], scratch.kinematics[1], scratch.wrench[0], scratch.wrench[1]
    if roller_wrench(raceway, 0, bundle) != 1:
        return 0
    values = _drivers(kin)
    for i in range(bl.drivers.shape[0]):
        bl.drivers[i, :] = 0.0
        if raceway.kind != LINE and i >= _OF_A_POINT:
            continue
        if bundle.system[0].friction_on == 0 and i not in (0, 9, 12):
            continue
        step = _RELATIVE * abs(values[i]) + _LEAST_STEPS[i]
        scratch.kinematics[1] = scratch.kinematics[0]
        _shift(near_kin, i, step)
        if roller_wrench(raceway, 1, bundle) != 1:
            return 0
        for k in range(3):
            bl.drivers[i, k] = (changed.force[k] - base.force[k]) / step
            bl.drivers[i, 3 + k] = (changed.moment[k] - base.moment[k]) / step
    return 1


@helper
def _wrench_near(values, kin, base, drivers, wrench):
    """Write the wrench to first order.

    It holds at the kinematics `kin`; `values` are the drivers of `base`.
    """
    store(wrench.force, base.force)
    store(wrench.moment, base.moment)
    now = _drivers(kin)
    for i in range(drivers.shape[0]):
        change = now[i] - values[i]
        for k in range(3):
            wrench.force[k] += drivers[i, k] * change
            wrench.moment[k] += drivers[i, 3 + k] * change


@helper
def _contact_columns(roller, j, ring, raceway, row, bundle, bl):
    """Add one contact to the force slopes.

    The roller is j; scratch holds the contact and bl.drivers the slopes of its wrench.
    """
    scratch, p = bundle.scratch[0], bl.reach.place[row.number, raceway.body]
    index, on_ring, values = bl.reach.index[row.number], bl.parts[j, p], _drivers(scratch.kinematics[0])
    kin, wrench, fm, bends = scratch.kinematics[1], scratch.wrench[1], bl.wrenches, raceway.waves[1] > raceway.waves[0]
    near_roller, near_ring = bl.roller.view(ROLLER), bl.body.view(BODY_STATE)
    clear(fm[0])
    apply_roller_wrench(scratch.kinematics[0], roller, ring, scratch.wrench[0], fm[0], fm[1])
    if bends:
        wave_pushes(raceway, scratch.kinematics[0], scratch.wrench[0], bl.pushes[0])
    for c in range(NR + NS):
        column = NS * p + c - NR
        if c >= NR and (index[column] < 0 or (c - NR == STHETA and not bends)):
            continue
        near_roller[0] = roller
        near_ring[0] = ring
        step = _step(c, False) if c < NR else body_step(c - NR, False)
        if c < NR:
            bl.roller[c] += step
        else:
            bl.body[c - NR] += step
        touch_roller(near_roller[0], near_ring[0], row, raceway, bundle, kin)
        _wrench_near(values, kin, scratch.wrench[0], bl.drivers, wrench)
        clear(fm[2])
        apply_roller_wrench(kin, near_roller[0], near_ring[0], wrench, fm[2], fm[3])
        if c < NR:
            add_slope(bl.own, c, fm[2], fm[0], step)
            add_slope(bl.from_ball[p], c, fm[3], fm[1], step)
        else:
            add_slope(bl.to_shared, column, fm[2], fm[0], step)
            add_slope(on_ring, column, fm[3], fm[1], step)
        if bends and c < NR:
            push_slopes(raceway, row.number, bundle, bl.from_ball, c, step, bl)
        elif bends:
            push_slopes(raceway, row.number, bundle, bl.parts[j], column, step, bl)


@helper
def _wave_columns(roller, j, ring, raceway, row, bundle, bl):
    """Add the waves' effect on a contact.

    Call it after _contact_columns, whose wrenches and pushes it takes.
    """
    scratch, r = bundle.scratch[0], row.number
    p, values, fm = bl.reach.place[r, raceway.body], _drivers(scratch.kinematics[0]), bl.wrenches
    kin, wrench = scratch.kinematics[1], scratch.wrench[1]
    for i in range(raceway.waves[0], raceway.waves[1]):
        body = bundle.waves[i].body
        first = NS * bl.reach.place[r, body]
        for c in (SY, SZ, SVY, SVZ):
            kept, step = bundle.shared[NS * body + c], body_step(c, False)
            bundle.shared[NS * body + c] = kept + step
            touch_roller(roller, ring, row, raceway, bundle, kin)
            bundle.shared[NS * body + c] = kept
            _wrench_near(values, kin, scratch.wrench[0], bl.drivers, wrench)
            clear(fm[2])
            apply_roller_wrench(kin, roller, ring, wrench, fm[2], fm[3])
            add_slope(bl.to_shared, first + c, fm[2], fm[0], step)
            add_slope(bl.parts[j, p], first + c, fm[3], fm[1], step)
            push_slopes(raceway, r, bundle, bl.parts[j], first + c, step, bl)


@helper
def _raceway_columns(roller, j, row, bundle, bl):
    """Add roller j's raceway contacts.

    They go to the force slopes; return 0 on a fault.
    """
    scratch = bundle.scratch[0]
    for k in range(row.first_raceway, row.first_raceway + row.raceways):
        raceway = bundle.raceways[k]
        ring = bundle.bodies_now[raceway.body]
        delta = touch_roller(roller, ring, row, raceway, bundle, scratch.kinematics[0])
        if delta <= -near(raceway, bundle.system[0]):
            continue
        if not delta < np.inf or _tangent(raceway, bundle, bl) != 1:
            scratch.fault.ball = j
            return 0
        _contact_columns(roller, j, ring, raceway, row, bundle, bl)
        if raceway.waves[1] > raceway.waves[0]:
            _wave_columns(roller, j, ring, raceway, row, bundle, bl)
    return 1


@helper
def _no_force(wrench):
    return wrench.force[0] == 0.0 and wrench.force[1] == 0.0 and wrench.force[2] == 0.0


@helper
def _pocket_columns(roller, j, row, bundle, bl):
    """Add the pocket of roller j.

    A pocket without force is skipped. Return 0 on a fault.
    """
    fm, p, cage = bl.wrenches, bl.reach.place[row.number, row.cage], bundle.bodies_now[row.cage]
    near_roller, near_cage = bl.roller.view(ROLLER), bl.body.view(BODY_STATE)
    clear_each(fm)
    if pocket_forces(roller, cage, j, row, bundle, fm[0], fm[1]) < -0.5:
        return 0
    if _no_force(fm[0]):
        return 1
    _keep_pushes(row, bundle, bl.pushes[0])
    for c in range(NR + NS):
        near_roller[0] = roller
        near_cage[0] = cage
        step = _step(c, True) if c < NR else body_step(c - NR, True)
        if c < NR:
            bl.roller[c] += step
        else:
            bl.body[c - NR] += step
        clear_each(fm[2:])
        if pocket_forces(near_roller[0], near_cage[0], j, row, bundle, fm[2], fm[3]) < -0.5:
            return 0
        if c < NR:
            add_slope(bl.own, c, fm[2], fm[0], step)
            add_slope(bl.from_ball[p], c, fm[3], fm[1], step)
            _pocket_pushes(row, bundle, bl.from_ball, c, step, bl)
        else:
            add_slope(bl.to_shared, NS * p + c - NR, fm[2], fm[0], step)
            add_slope(bl.parts[j, p], NS * p + c - NR, fm[3], fm[1], step)
            _pocket_pushes(row, bundle, bl.parts[j], NS * p + c - NR, step, bl)
    return _pocket_waves(roller, cage, j, row, bundle, bl)


@helper
def _keep_pushes(row, bundle, pushes):
    """Copy the last pocket's pushes on the waves."""
    for i in range(2 * (row.waves[1] - row.waves[0])):
        pushes[i] = bundle.scratch[0].pushes[0, i]


@helper
def _pocket_pushes(row, bundle, slopes, column, step, bl):
    """Add a pocket's slope on the waves of its cage."""
    _keep_pushes(row, bundle, bl.pushes[1])
    for i in range(row.waves[1] - row.waves[0]):
        p = bl.reach.place[row.number, bundle.waves[row.waves[0] + i].body]
        add_push_slope(slopes[p], i, column, step, bl.pushes)


@helper
def _pocket_waves(roller, cage, j, row, bundle, bl):
    """Add the waves' effect on the pocket of roller j.

    They are those of an elastic cage. Return 0 on a fault.
    """
    fm, p = bl.wrenches, bl.reach.place[row.number, row.cage]
    for i in range(row.waves[0], row.waves[1]):
        body = bundle.waves[i].body
        first = NS * bl.reach.place[row.number, body]
        for c in (SY, SZ, SVY, SVZ):
            kept, step = bundle.shared[NS * body + c], body_step(c, True)
            bundle.shared[NS * body + c] = kept + step
            clear_each(fm[2:])
            lost = pocket_forces(roller, cage, j, row, bundle, fm[2], fm[3])
            bundle.shared[NS * body + c] = kept
            if lost < -0.5:
                return 0
            add_slope(bl.to_shared, first + c, fm[2], fm[0], step)
            add_slope(bl.parts[j, p], first + c, fm[3], fm[1], step)
            _pocket_pushes(row, bundle, bl.parts[j], first + c, step, bl)
    return 1


@helper
def _neighbour_columns(roller, other, j, row, bundle, bl):
    """Add the contact with a neighbour to roller j's slopes.

    Slopes with the other's states go into bl.beyond; return 0 on a fault.
    """
    fm, near = bl.wrenches, bl.roller.view(ROLLER)
    bl.beyond[:, :] = 0.0
    clear_each(fm)
    if neighbour_forces(roller, other, j, row, bundle, fm[0], fm[1]) < -0.5:
        return 0
    if _no_force(fm[0]):
        return 1
    for k in range(2 * NR):
        c = k % NR
        step = _step(c, True)
        near[0] = roller if k < NR else other
        bl.roller[c] += step
        clear_each(fm[2:])
        if k < NR:
            lost = neighbour_forces(near[0], other, j, row, bundle, fm[2], fm[3])
        else:
            lost = neighbour_forces(roller, near[0], j, row, bundle, fm[2], fm[3])
        if lost < -0.5:
            return 0
        add_slope(bl.own if k < NR else bl.beyond, c, fm[2], fm[0], step)
    return 1


@helper
def _neighbour_block(bl, block):
    """Turn slopes with a neighbour's states into a roller's rows."""
    for k in range(NR):
        for c in range(NR):
            total = 0.0
            for i in range(6):
                total += bl.roller_map[k, i] * bl.beyond[i, c]
            block[k, c] = total


@helper
def _guide_columns(rollers, j, row, bundle, bl):
    """Add the pocket or the neighbours of roller j.

    Return 0 on a fault.
    """
    z, i = row.balls, j - row.first_ball
    if row.caged == 1:
        return _pocket_columns(rollers[i], j, row, bundle, bl)
    for side in (BEFORE, AFTER):
        other = rollers[(i + (1 if side == AFTER else z - 1)) % z]
        if _neighbour_columns(rollers[i], other, j, row, bundle, bl) != 1:
            return 0
        _neighbour_block(bl, bl.cross[j, side])
    return 1


@helper
def _drag_columns(roller, row, bundle, bl):
    """Add a roller's drag to its block.

    Return 0 on a fault.
    """
    fm, near_roller = bl.wrenches, bl.roller.view(ROLLER)
    clear(fm[0])
    if roller_drag(roller, row, bundle, fm[0]) < -0.5:
        return 0
    for c in range(BVT, NB):
        step = ball_step(c, True)
        near_roller[0] = roller
        bl.roller[c] += step
        clear(fm[2])
        if roller_drag(near_roller[0], row, bundle, fm[2]) < -0.5:
            return 0
        add_slope(bl.own, c, fm[2], fm[0], step)
    return 1


@helper
def _write_map(roller, j, row, bundle, bl):
    """Write the rates of roller j and their slopes.

    They come with forces and moments, in which they are linear.
    """
    wrench, here, there = bundle.ball_wrenches[j], bl.moved[0].view(ROLLER), bl.moved[1].view(ROLLER)
    roller_rates(roller, wrench, row, here[0])
    for i in range(6):
        _push(wrench, i, 1.0)
        roller_rates(roller, wrench, row, there[0])
        _push(wrench, i, -1.0)
        for k in range(NR):
            bl.roller_map[k, i] = bl.moved[1, k] - bl.moved[0, k]


@helper
def _equation_rows(roller, j, row, bundle, bl, a, b):
    """Turn force slopes into roller j's rows.

    The slopes of its own equations of motion are added; call this after _write_map.
    """
    wrench, near_roller, index = bundle.ball_wrenches[j], bl.roller.view(ROLLER), bl.reach.index[row.number]
    there = bl.moved[1].view(ROLLER)
    for c in range(NR):
        near_roller[0] = roller
        step = _step(c, False)
        bl.roller[c] += step
        roller_rates(near_roller[0], wrench, row, there[0])
        for k in range(NR):
            total = (bl.moved[1, k] - bl.moved[0, k]) / step
            for i in range(6):
                total += bl.roller_map[k, i] * bl.own[i, c]
            a[k, c] = total
    for k in range(NR):
        for column in range(index.size):
            if index[column] >= 0:
                total = 0.0
                for i in range(6):
                    total += bl.roller_map[k, i] * bl.to_shared[i, column]
                b[k, index[column]] = total


@helper
def _push(wrench, i, amount):
    """Add to one component of a wrench."""
    if i < 3:
        wrench.force[i] += amount
    else:
        wrench.moment[i - 3] += amount


@helper
def _body_rows(p, index, bl, c_block):
    """Write d(body)/d(roller) into a block C.

    The body is at place p.
    """
    for row in range(NS):
        k = index[NS * p + row]
        if k < 0:
            continue
        for column in range(NR):
            total = 0.0
            for i in range(6):
                total += bl.map[row, i] * bl.from_ball[p, i, column]
            c_block[k, column] = total


@helper
def _blocks(rollers, j, row, bundle, bl):
    """Write the blocks A, B, C of roller j.

    It also writes the roller's part of D; return 0 on a fault.
    """
    reach, r, system, roller = bl.reach, row.number, bundle.system[0], rollers[j - row.first_ball]
    bl.parts[j, :, :, :] = 0.0
    bl.own[:, :] = 0.0
    bl.to_shared[:, :] = 0.0
    bl.from_ball[:, :, :] = 0.0
    _write_map(roller, j, row, bundle, bl)
    if _raceway_columns(roller, j, row, bundle, bl) != 1:
        return 0
    if system.friction_on == 1:
        if system.guides_on == 1 and _guide_columns(rollers, j, row, bundle, bl) != 1:
            return 0
        if row.drag_on == 1 and _drag_columns(roller, row, bundle, bl) != 1:
            return 0
    c, s = math.cos(roller.azimuth), math.sin(roller.azimuth)
    gy, gz = row.ball_mass * system.gravity[1], row.ball_mass * system.gravity[2]
    bl.own[1, BPSI] += -gy * s + gz * c
    bl.own[2, BPSI] += -gy * c - gz * s
    _equation_rows(roller, j, row, bundle, bl, bl.a[j], bl.b[j])
    for p in range(reach.count[r]):
        body = reach.bodies[r, p]
        force_map(bundle.bodies[body], bundle.bodies_now[body], bl.map)
        _body_rows(p, reach.index[r], bl, bl.c[j])
    return 1


def jacobian(y, r, bundle, bl):
    """Write the due rollers' blocks.

    The rollers are those of a row; return how many, or -1 on a fault.
    """
    row, rollers, due = bundle.rows[r], rollers_of(y, bundle.rows[r]), 0
    for i in range(row.balls):
        j = row.first_ball + i
        if bl.due[j] == 0:
            continue
        bl.changed[r], bl.newer[j] = 1, 1
        due += 1
        if _blocks(rollers, j, row, bundle, bl) != 1:
            return -1
    return due
