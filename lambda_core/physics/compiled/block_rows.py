"""From slopes of forces to rows of the Jacobian: equations of motion of balls and shared bodies."""

from __future__ import annotations

from lambda_core.physics.compiled.kinematics import axis_x
from lambda_core.physics.compiled.layout import (
    BODY_FM,
    BR,
    BVR,
    BVT,
    BVX,
    BWR,
    BWT,
    NB,
    NS,
    RATE,
    SAY,
    SAZ,
    SHARED,
    SSIGMA,
    SVX,
    SWY,
    SWZ,
    helper,
)
from lambda_core.physics.compiled.motion import body_rates
from lambda_core.physics.compiled.steps import body_step


@helper
def ball_block(ball, system, bl, a, b):
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
def force_map(body, b, system, m):
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
def body_rows(b, j, bundle, bl, c_block):
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
def shared_rows(b, bundle, bl):
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
        step = body_step(c, False)
        for i in range(NS):
            bl.body[i] = body[i]
        bl.body[c] += step
        body_rates(bl.body, b, fm, bundle.channels, system, scratch[RATE], bl.rates, 0)
        for row in range(NS):
            k = bl.index[NS * b + row]
            if k >= 0:
                d[k, kc] += (scratch[RATE][row] - bl.body2[row]) / step
