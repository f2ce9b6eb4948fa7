"""Convert slopes of forces to rows of the Jacobian."""

from __future__ import annotations

from lambda_core.solver.arrays.bundle import BPSI, BR, BVR, BVT, BVX, BWR, BWT, BX, NB, NS, SSIGMA, SVX, SWY, SWZ
from lambda_core.solver.contact.contact_kinematics import axis_x
from lambda_core.solver.layout import helper
from lambda_core.solver.motion.equations import body_rates
from lambda_core.solver.motion.steps import body_step
from lambda_core.solver.records import BODY_STATE


@helper
def ball_block(ball, row, bl, a, b):
    """Turn force slopes into the rows of one ball."""
    r, vt, vr = ball.radius, ball.velocity[2], ball.velocity[1]
    orbit, index = vt / r, bl.reach.index[row.number]
    for i in range(6):
        inverse = 1.0 / row.ball_mass if i < 3 else 1.0 / row.ball_inertia
        for c in range(NB):
            a[BVX + i, c] = bl.own[i, c] * inverse
        for column in range(index.size):
            k = index[column]
            if k >= 0:
                b[BVX + i, k] = bl.to_shared[i, column] * inverse
    for i in range(3):
        for c in range(NB):
            a[i, c] = 0.0
        for k in range(b.shape[1]):
            b[i, k] = 0.0
    a[BX, BVX] = 1.0
    a[BR, BVR] = 1.0
    a[BPSI, BVT] = 1.0 / r
    a[BPSI, BR] = -orbit / r
    a[BVR, BVT] += 2.0 * orbit
    a[BVR, BR] -= orbit * orbit
    a[BVT, BVR] -= orbit
    a[BVT, BVT] -= vr / r
    a[BVT, BR] += vr * orbit / r
    wr, wt = ball.spin[1], ball.spin[2]
    a[BWR, BWT] += orbit
    a[BWR, BVT] += wt / r
    a[BWR, BR] -= wt * orbit / r
    a[BWT, BWR] -= orbit
    a[BWT, BVT] -= wr / r
    a[BWT, BR] += wr * orbit / r


@helper
def neighbour_block(row, bl, block):
    """Turn neighbour slopes into rows.

    They are slopes of a ball's force with the states of its neighbour; the rows belong to the first ball.
    """
    for i in range(6):
        inverse = 1.0 / row.ball_mass if i < 3 else 1.0 / row.ball_inertia
        for c in range(NB):
            block[BVX + i, c] = bl.beyond[i, c] * inverse


@helper
def force_map(body, now, m):
    """Write d(rate)/d(force, moment) of a body, (12, 6)."""
    m[:, :] = 0.0
    ay, az = now.tilt[0], now.tilt[1]
    ax = axis_x(ay, az)
    for i in range(3):
        m[SVX + i, i] = 1.0 / body.mass
    it, ip = 1.0 / body.transverse_inertia, 1.0 / body.polar_inertia
    m[SWY, 3], m[SWY, 4], m[SWY, 5] = -ax * ay * it, (1.0 - ay * ay) * it, -az * ay * it
    m[SWZ, 3], m[SWZ, 4], m[SWZ, 5] = -ax * az * it, -ay * az * it, (1.0 - az * az) * it
    m[SSIGMA, 3], m[SSIGMA, 4], m[SSIGMA, 5] = ax * ip, ay * ip, az * ip


@helper
def body_rows(p, index, bl, c_block):
    """Write d(body)/d(ball) into a block C.

    The body is at place p.
    """
    for row in range(NS):
        k = index[NS * p + row]
        if k < 0:
            continue
        for col in range(NB):
            total = 0.0
            for i in range(6):
                total += bl.map[row, i] * bl.from_ball[p, i, col]
            c_block[k, col] = total


@helper
def _own_slopes(b, bundle, bl):
    """Add a body's own slopes to D.

    They belong to body b's own equations of motion.
    """
    body, now, inputs, fm = bundle.bodies[b], bundle.bodies_now[b], bundle.inputs[b], bundle.body_wrenches[b]
    gravity, near, d = bundle.system[0].gravity, bl.body.view(BODY_STATE), bl.d
    rate, near_rate = bl.rate.view(BODY_STATE), bl.near_rate.view(BODY_STATE)
    body_rates(body, now, fm, inputs, gravity, rate[0])
    for c in range(NS):
        kc = bl.index[NS * b + c]
        if kc < 0:
            continue
        step = body_step(c, False)
        near[0] = now
        bl.body[c] += step
        body_rates(body, near[0], fm, inputs, gravity, near_rate[0])
        for row in range(NS):
            k = bl.index[NS * b + row]
            if k >= 0:
                d[k, kc] += (bl.near_rate[row] - bl.rate[row]) / step


@helper
def shared_rows(b, bundle, bl):
    """Write the rows of body b in D.

    They hold its own equations of motion and all forces on it.
    """
    d, active = bl.d, bundle.active
    for row in range(NS):
        k = bl.index[NS * b + row]
        if k < 0:
            continue
        for i in range(6):
            share = bl.map[row, i]
            if share != 0.0:
                for c in range(active.size):
                    d[k, c] += share * bl.shared[b, i, active[c]]
    _own_slopes(b, bundle, bl)


@helper
def own_rows(p, r, bl, d_own):
    """Add a body's rows to D.

    The body at place p, among what contacts of row r have of D.
    """
    bodies, index = bl.reach.bodies[r], bl.reach.index[r]
    b, columns = bodies[p], NS * bl.reach.count[r]
    for row in range(NS):
        k = index[NS * p + row]
        if k < 0:
            continue
        for i in range(6):
            share = bl.map[row, i]
            if share != 0.0:
                for c in range(columns):
                    if index[c] >= 0:
                        d_own[k, index[c]] += share * bl.shared[b, i, NS * bodies[c // NS] + c % NS]
