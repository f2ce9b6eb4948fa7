"""Contacts of the cage with balls (pockets) and rings (lands); ball with ball when there is no cage."""

from __future__ import annotations

import math

import numpy as np

from lambda_core.physics.compiled.faults import report
from lambda_core.physics.compiled.kinematics import axis_x
from lambda_core.physics.compiled.layout import (
    BPSI,
    BR,
    BVR,
    BVT,
    BVX,
    BWR,
    BWT,
    BWX,
    BX,
    R_CAGE,
    SAY,
    SAZ,
    SSIGMA,
    STHETA,
    SVX,
    SVY,
    SVZ,
    SWY,
    SWZ,
    SX,
    SY,
    SZ,
    helper,
)

# Rows of a guide record: r, v_rel, omega_rel (in the frame), frame axes (3x3, inertial), origin.
G_R, G_V, G_W, G_E1, G_E2, G_E3, G_O = 0, 3, 6, 9, 12, 15, 18

# Gauss-Legendre, 8 points on 0..1.
GAUSS_NODES = np.polynomial.legendre.leggauss(8)[0] * 0.5 + 0.5
GAUSS_WEIGHTS = np.polynomial.legendre.leggauss(8)[1] * 0.5
_PARTS = 10  # of the way of an elastic contact, each half as long as the next: laws bend near first touch


@helper
def _body_rates(body):
    """Return axis and angular velocity of a shared body, inertial: (a, omega), six floats."""
    ay, az = body[SAY], body[SAZ]
    ax = axis_x(ay, az)
    wx = -(body[SWY] * ay + body[SWZ] * az) / ax
    s = body[SSIGMA]
    return ax, ay, az, wx + s * ax, body[SWY] + s * ay, body[SWZ] + s * az


@helper
def _frame(ax, ay, az, phi, g):
    """Write axis, radial and tangential unit vectors of a body at angle phi about its axis."""
    c1 = 1.0 + ax
    y0, y1, y2 = -ay, 1.0 - ay * ay / c1, -ay * az / c1
    z0, z1, z2 = -az, -ay * az / c1, 1.0 - az * az / c1
    c, s = math.cos(phi), math.sin(phi)
    g[G_E1], g[G_E1 + 1], g[G_E1 + 2] = ax, ay, az
    g[G_E2], g[G_E2 + 1], g[G_E2 + 2] = (c * y0 + s * z0, c * y1 + s * z1, c * y2 + s * z2)
    g[G_E3], g[G_E3 + 1], g[G_E3 + 2] = (-s * y0 + c * z0, -s * y1 + c * z1, -s * y2 + c * z2)


@helper
def _project(g, row, v0, v1, v2):
    """Write the components of an inertial vector along the frame's axes."""
    for k in range(3):
        e = G_E1 + 3 * k
        g[row + k] = v0 * g[e] + v1 * g[e + 1] + v2 * g[e + 2]


@helper
def pocket_state(ball, cage, j, system, g):
    """Write position and velocity of ball j relative to its pocket, in the pocket's frame."""
    ax, ay, az, o0, o1, o2 = _body_rates(cage)
    _frame(ax, ay, az, cage[STHETA] + 2.0 * math.pi * j / system.balls, g)
    c, s = math.cos(ball[BPSI]), math.sin(ball[BPSI])
    # Ball from the cage's centre.
    d0, d1, d2 = ball[BX] - cage[SX], ball[BR] * c - cage[SY], ball[BR] * s - cage[SZ]
    for k in range(3):
        g[G_O + k] = system.pocket_circle * g[G_E2 + k]
    _project(g, G_R, d0 - g[G_O], d1 - g[G_O + 1], d2 - g[G_O + 2])
    v1, v2 = ball[BVR] * c - ball[BVT] * s, ball[BVR] * s + ball[BVT] * c
    _project(
        g,
        G_V,
        ball[BVX] - cage[SVX] - (o1 * d2 - o2 * d1),
        v1 - cage[SVY] - (o2 * d0 - o0 * d2),
        v2 - cage[SVZ] - (o0 * d1 - o1 * d0),
    )
    w1, w2 = ball[BWR] * c - ball[BWT] * s, ball[BWR] * s + ball[BWT] * c
    _project(g, G_W, ball[BWX] - o0, w1 - o1, w2 - o2)


@helper
def land_state(cage, ring, offset, g):
    """Write the position of a station of the cage's axis relative to the ring's, and its velocity."""
    ax, ay, az, o0, o1, o2 = _body_rates(cage)
    bx, by, bz, p0, p1, p2 = _body_rates(ring)
    _frame(bx, by, bz, 0.0, g)
    c0, c1, c2 = cage[SX] - ring[SX], cage[SY] - ring[SY], cage[SZ] - ring[SZ]
    h0, h1, h2 = offset * ax, offset * ay, offset * az
    g[G_O], g[G_O + 1], g[G_O + 2] = offset * bx, offset * by, offset * bz
    _project(g, G_R, c0 + h0 - g[G_O], c1 + h1 - g[G_O + 1], c2 + h2 - g[G_O + 2])
    e0, e1, e2 = c0 + h0, c1 + h1, c2 + h2
    _project(
        g,
        G_V,
        cage[SVX] + (o1 * h2 - o2 * h1) - ring[SVX] - (p1 * e2 - p2 * e1),
        cage[SVY] + (o2 * h0 - o0 * h2) - ring[SVY] - (p2 * e0 - p0 * e2),
        cage[SVZ] + (o0 * h1 - o1 * h0) - ring[SVZ] - (p0 * e1 - p1 * e0),
    )
    _project(g, G_W, o0 - p0, o1 - p1, o2 - p2)


@helper
def guide_force(law, par, g, eta0, out, fault, which):
    """Call a cage law on a guide record: out = force[3], point[3] in the frame; 1 when well."""
    out[:6] = np.nan
    status = law(g[G_R : G_R + 3], g[G_V : G_V + 3], g[G_W : G_W + 3], eta0, par, out)
    total = 0.0
    for i in range(6):
        total += abs(out[i])
    if status != 1 or not total < np.inf:
        return report(fault, R_CAGE, status, which, g[G_R], g[G_R + 1], g[G_R + 2], g[G_V])
    return 1


@helper
def guide_loss(law, par, g, eta0, out, still):
    """Return the power dissipated in a cage contact [W]: all work less that of the elastic force.

    The elastic force is the law's force at rest. Call after guide_force, whose result `out` keeps.
    """
    # A contact that leaves too fast to push back has no force, but loses its elastic energy all the same.
    f0, f1, f2 = out[0], out[1], out[2]
    q0, q1, q2 = out[3] - g[G_R], out[4] - g[G_R + 1], out[5] - g[G_R + 2]
    w0, w1, w2 = g[G_W], g[G_W + 1], g[G_W + 2]
    p0, p1, p2 = out[3], out[4], out[5]
    v0 = g[G_V] + w1 * q2 - w2 * q1
    v1 = g[G_V + 1] + w2 * q0 - w0 * q2
    v2 = g[G_V + 2] + w0 * q1 - w1 * q0
    still[:] = 0.0
    for k in range(3):
        still[k] = g[G_R + k]
    law(still[0:3], still[3:6], still[6:9], eta0, par, out)
    elastic = out[0] * g[G_V] + out[1] * g[G_V + 1] + out[2] * g[G_V + 2]
    out[0], out[1], out[2], out[3], out[4], out[5] = f0, f1, f2, p0, p1, p2
    return elastic - (f0 * v0 + f1 * v1 + f2 * v2)


@helper
def _force_at_rest(law, par, g, share, eta0, out, still):
    """Write the law's force at rest at `share` of the way to the record's place; returns its component along r."""
    still[:] = 0.0
    for k in range(3):
        still[k] = share * g[G_R + k]
    law(still[0:3], still[3:6], still[6:9], eta0, par, out)
    return out[0] * g[G_R] + out[1] * g[G_R + 1] + out[2] * g[G_R + 2]


@helper
def guide_energy(law, par, g, eta0, out, still, start):
    """Return the elastic energy of a cage contact [J]: work against the force at rest on the way to its place r.

    The way begins at `start` r, where there is no force: 0 in a pocket, beyond first touch for two balls. First
    touch is found by bisection, since the play is often a hundred times the penetration.
    """
    if _force_at_rest(law, par, g, 1.0, eta0, out, still) == 0.0:
        return 0.0
    free, pressed = start, 1.0
    for _ in range(40):
        middle = 0.5 * (free + pressed)
        if _force_at_rest(law, par, g, middle, eta0, out, still) == 0.0:
            free = middle
        else:
            pressed = middle
    total, end = 0.0, 1.0
    for part in range(_PARTS):
        begin = 0.5 * (free + end) if part < _PARTS - 1 else free
        for i in range(GAUSS_NODES.size):
            share = begin + GAUSS_NODES[i] * (end - begin)
            total -= GAUSS_WEIGHTS[i] * (end - begin) * _force_at_rest(law, par, g, share, eta0, out, still)
        end = begin
    return total


@helper
def pocket_apply(ball, cage, g, out, ball_fm, cage_fm):
    """Add the force of a pocket to ball (axes x, r, t) and cage (inertial), equal and opposite."""
    c, s = math.cos(ball[BPSI]), math.sin(ball[BPSI])
    f0 = out[0] * g[G_E1] + out[1] * g[G_E2] + out[2] * g[G_E3]
    f1 = out[0] * g[G_E1 + 1] + out[1] * g[G_E2 + 1] + out[2] * g[G_E3 + 1]
    f2 = out[0] * g[G_E1 + 2] + out[1] * g[G_E2 + 2] + out[2] * g[G_E3 + 2]
    # Point of action from the cage's centre, then from the ball's.
    p0 = g[G_O] + out[3] * g[G_E1] + out[4] * g[G_E2] + out[5] * g[G_E3]
    p1 = g[G_O + 1] + out[3] * g[G_E1 + 1] + out[4] * g[G_E2 + 1] + out[5] * g[G_E3 + 1]
    p2 = g[G_O + 2] + out[3] * g[G_E1 + 2] + out[4] * g[G_E2 + 2] + out[5] * g[G_E3 + 2]
    b0 = p0 - (ball[BX] - cage[SX])
    b1 = p1 - (ball[BR] * c - cage[SY])
    b2 = p2 - (ball[BR] * s - cage[SZ])
    m0, m1, m2 = b1 * f2 - b2 * f1, b2 * f0 - b0 * f2, b0 * f1 - b1 * f0
    ball_fm[0] += f0
    ball_fm[1] += f1 * c + f2 * s
    ball_fm[2] += -f1 * s + f2 * c
    ball_fm[3] += m0
    ball_fm[4] += m1 * c + m2 * s
    ball_fm[5] += -m1 * s + m2 * c
    cage_fm[0] -= f0
    cage_fm[1] -= f1
    cage_fm[2] -= f2
    cage_fm[3] -= p1 * f2 - p2 * f1
    cage_fm[4] -= p2 * f0 - p0 * f2
    cage_fm[5] -= p0 * f1 - p1 * f0


@helper
def land_apply(cage, ring, g, out, cage_fm, ring_fm):
    """Add the force of a land to cage and ring (inertial), equal and opposite."""
    f0 = out[0] * g[G_E1] + out[1] * g[G_E2] + out[2] * g[G_E3]
    f1 = out[0] * g[G_E1 + 1] + out[1] * g[G_E2 + 1] + out[2] * g[G_E3 + 1]
    f2 = out[0] * g[G_E1 + 2] + out[1] * g[G_E2 + 2] + out[2] * g[G_E3 + 2]
    p0 = g[G_O] + out[3] * g[G_E1] + out[4] * g[G_E2] + out[5] * g[G_E3]
    p1 = g[G_O + 1] + out[3] * g[G_E1 + 1] + out[4] * g[G_E2 + 1] + out[5] * g[G_E3 + 1]
    p2 = g[G_O + 2] + out[3] * g[G_E1 + 2] + out[4] * g[G_E2 + 2] + out[5] * g[G_E3 + 2]
    c0, c1, c2 = (p0 + ring[SX] - cage[SX], p1 + ring[SY] - cage[SY], p2 + ring[SZ] - cage[SZ])
    cage_fm[0] += f0
    cage_fm[1] += f1
    cage_fm[2] += f2
    cage_fm[3] += c1 * f2 - c2 * f1
    cage_fm[4] += c2 * f0 - c0 * f2
    cage_fm[5] += c0 * f1 - c1 * f0
    ring_fm[0] -= f0
    ring_fm[1] -= f1
    ring_fm[2] -= f2
    ring_fm[3] -= p1 * f2 - p2 * f1
    ring_fm[4] -= p2 * f0 - p0 * f2
    ring_fm[5] -= p0 * f1 - p1 * f0


@helper
def neighbour_state(ball, other, g):
    """Write position and velocity of a ball relative to its neighbour, axes of the inertial frame."""
    g[:] = 0.0
    g[G_E1], g[G_E2 + 1], g[G_E3 + 2] = 1.0, 1.0, 1.0
    c, s = math.cos(ball[BPSI]), math.sin(ball[BPSI])
    d, e = math.cos(other[BPSI]), math.sin(other[BPSI])
    r0 = ball[BX] - other[BX]
    r1 = ball[BR] * c - other[BR] * d
    r2 = ball[BR] * s - other[BR] * e
    o0 = other[BWX]
    o1, o2 = other[BWR] * d - other[BWT] * e, other[BWR] * e + other[BWT] * d
    g[G_R], g[G_R + 1], g[G_R + 2] = r0, r1, r2
    g[G_V] = ball[BVX] - other[BVX] - (o1 * r2 - o2 * r1)
    g[G_V + 1] = ball[BVR] * c - ball[BVT] * s - (other[BVR] * d - other[BVT] * e) - (o2 * r0 - o0 * r2)
    g[G_V + 2] = ball[BVR] * s + ball[BVT] * c - (other[BVR] * e + other[BVT] * d) - (o0 * r1 - o1 * r0)
    g[G_W] = ball[BWX] - o0
    g[G_W + 1] = ball[BWR] * c - ball[BWT] * s - o1
    g[G_W + 2] = ball[BWR] * s + ball[BWT] * c - o2


@helper
def neighbour_apply(psi, arm0, arm1, arm2, out, sign, ball_fm):
    """Add a ball-ball force (inertial, times sign) acting at `arm` from the ball's centre."""
    c, s = math.cos(psi), math.sin(psi)
    f0, f1, f2 = sign * out[0], sign * out[1], sign * out[2]
    m0, m1, m2 = arm1 * f2 - arm2 * f1, arm2 * f0 - arm0 * f2, arm0 * f1 - arm1 * f0
    ball_fm[0] += f0
    ball_fm[1] += f1 * c + f2 * s
    ball_fm[2] += -f1 * s + f2 * c
    ball_fm[3] += m0
    ball_fm[4] += m1 * c + m2 * s
    ball_fm[5] += -m1 * s + m2 * c
