"""Contact identification: exact sphere in torus with ring tilt, and the velocities there.

Vectors have components along x (shaft), r (radial at the ball), t (tangential), a right-handed frame
that turns with the ball's azimuth.
"""

from __future__ import annotations

import math

import numpy as np

from lambda_core.physics.compiled.faults import report
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
    FAULT,
    INNER,
    K_ARM,
    K_AXIAL,
    K_COS,
    K_D,
    K_LIFT,
    K_N,
    K_RADIAL,
    K_RISE,
    K_S,
    K_SIN,
    K_T,
    Q_DELTA,
    Q_UT,
    Q_VN,
    Q_VS,
    Q_VT,
    Q_WN,
    Q_WS,
    Q_WT,
    R_SURFACE,
    RACEWAY_KERNELS,
    SAY,
    SAZ,
    SSIGMA,
    STHETA,
    SURFACE,
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


@helper
def axis_x(ay, az):
    """Return the x component of a unit axis from its other two."""
    return math.sqrt(max(1.0 - ay * ay - az * az, 1e-12))


@helper
def _from_axis(ball, ring, c, s):
    """Return the ring's axis, the ball's centre from the ring's, its part along the axis and that across it (x, r, t).

    c and s are cosine and sine of the ball's azimuth.
    """
    ay, az = ring[SAY], ring[SAZ]
    a0, a1, a2 = axis_x(ay, az), ay * c + az * s, -ay * s + az * c
    d0 = ball[BX] - ring[SX]
    d1 = ball[BR] - (ring[SY] * c + ring[SZ] * s)
    d2 = -(-ring[SY] * s + ring[SZ] * c)
    axial = d0 * a0 + d1 * a1 + d2 * a2
    return a0, a1, a2, d0, d1, d2, axial, d0 - axial * a0, d1 - axial * a1, d2 - axial * a2


@helper
def surface_lift(ball, ring, which, bundle, kin):
    """Look up the raceway's surface under a ball, for `contact_kinematics` to take: call it first where one is in use.

    Writes kin[K_LIFT], the height, and kin[K_RISE], its slopes with the ball centre's place along t and s; NaN when the
    law refused. In the quasi-static equilibrium raceways are nominal.
    """
    system = bundle.system[0]
    kin[K_LIFT], kin[K_RISE], kin[K_RISE + 1] = 0.0, 0.0, 0.0
    if system.surface_on[which] == 0 or system.guides_on == 0:
        return
    c, s = math.cos(ball[BPSI]), math.sin(ball[BPSI])
    ay, az = ring[SAY], ring[SAZ]
    ax, _, _, _, _, _, axial, p0, p1, p2 = _from_axis(ball, ring, c, s)
    rho = math.sqrt(p0 * p0 + p1 * p1 + p2 * p2)
    radial = rho - system.groove_circle[which]
    # Azimuth in the frame of least rotation of the tilted ring, less its spin: fixed to the raceway.
    q1, q2 = p1 * c - p2 * s, p1 * s + p2 * c
    lean = p0 + (ay * q1 + az * q2) / (1.0 + ax)
    azimuth = math.atan2(q2 - az * lean, q1 - ay * lean) - ring[STHETA]
    azimuth -= 2.0 * math.pi * math.floor(azimuth / (2.0 * math.pi) + 0.5)
    sign = -1.0 if which == INNER else 1.0
    angle, k = math.atan2(sign * axial, sign * radial), RACEWAY_KERNELS * which + R_SURFACE
    out, par = bundle.scratch[SURFACE], bundle.par[system.par_start[k] : system.par_start[k + 1]]
    out[:3] = np.nan
    if which == INNER:
        status = bundle.laws.inner.surface(azimuth, angle, par, out)
    else:
        status = bundle.laws.outer.surface(azimuth, angle, par, out)
    if status != 1 or not abs(out[0]) + abs(out[1]) + abs(out[2]) < np.inf:
        report(bundle.scratch[FAULT], R_SURFACE, status, which, azimuth, angle, 0.0, 0.0)
        kin[K_LIFT] = np.nan
        return
    kin[K_LIFT] = out[0]
    kin[K_RISE] = out[1] / rho
    kin[K_RISE + 1] = out[2] / math.sqrt(axial * axial + radial * radial)


@helper
def contact_kinematics(ball, ring, which, system, kin):
    """Identify the contact of one ball with one ring.

    Parameters
    ----------
    ball : float64[:], shape (9,)
    ring : float64[:], shape (12,)
        Shared state of the ring.
    which : int
        INNER or OUTER.
    kin : float64[:], shape (NKIN,)
        Result: q (penetration, velocities), frame, arms, contact angle. What `surface_lift` wrote is taken from it.

    Returns
    -------
    float
        Penetration [m]; velocities are written only where it is positive. NaN when the surface law refused.
    """
    c, s = math.cos(ball[BPSI]), math.sin(ball[BPSI])
    a0, a1, a2, d0, d1, d2, axial, p0, p1, p2 = _from_axis(ball, ring, c, s)
    ax, ay, az = a0, ring[SAY], ring[SAZ]
    rho = math.sqrt(p0 * p0 + p1 * p1 + p2 * p2)
    p0, p1, p2 = p0 / rho, p1 / rho, p2 / rho
    radial = rho - system.groove_circle[which]
    length = math.sqrt(axial * axial + radial * radial)
    delta = length + system.ball_radius - system.groove_radius[which] + kin[K_LIFT]
    na, nr = axial / length, radial / length
    kin[Q_DELTA] = delta
    kin[K_AXIAL], kin[K_RADIAL] = axial, radial
    kin[K_COS], kin[K_SIN] = c, s
    if delta <= 0.0:
        return delta
    n0, n1, n2 = na * a0 + nr * p0, na * a1 + nr * p1, na * a2 + nr * p2
    # t = axis x radial, s = n x t
    t0, t1, t2 = a1 * p2 - a2 * p1, a2 * p0 - a0 * p2, a0 * p1 - a1 * p0
    s0, s1, s2 = n1 * t2 - n2 * t1, n2 * t0 - n0 * t2, n0 * t1 - n1 * t0
    dist = system.ball_radius - 0.5 * delta
    # Arm of the contact's centre from the ring's centre.
    r0, r1, r2 = d0 + dist * n0, d1 + dist * n1, d2 + dist * n2
    # Angular velocity of the ring: across its axis (w) and about it (sigma).
    wy, wz = ring[SWY], ring[SWZ]
    w0 = -(wy * ay + wz * az) / ax
    w1, w2 = wy * c + wz * s, -wy * s + wz * c
    sigma = ring[SSIGMA]
    o0, o1, o2 = w0 + sigma * a0, w1 + sigma * a1, w2 + sigma * a2
    v0 = ring[SVX]
    v1 = ring[SVY] * c + ring[SVZ] * s
    v2 = -ring[SVY] * s + ring[SVZ] * c
    # Surface velocities at the contact's centre.
    b0, b1, b2 = ball[BWX], ball[BWR], ball[BWT]
    e0 = ball[BVX] + dist * (b1 * n2 - b2 * n1)
    e1 = ball[BVR] + dist * (b2 * n0 - b0 * n2)
    e2 = ball[BVT] + dist * (b0 * n1 - b1 * n0)
    g0 = v0 + o1 * r2 - o2 * r1
    g1 = v1 + o2 * r0 - o0 * r2
    g2 = v2 + o0 * r1 - o1 * r0
    f0, f1, f2 = e0 - g0, e1 - g1, e2 - g2
    kin[Q_VN] = f0 * n0 + f1 * n1 + f2 * n2
    kin[Q_VT] = f0 * t0 + f1 * t1 + f2 * t2
    kin[Q_VS] = f0 * s0 + f1 * s1 + f2 * s2
    h0, h1, h2 = b0 - o0, b1 - o1, b2 - o2
    kin[Q_WT] = h0 * t0 + h1 * t1 + h2 * t2
    kin[Q_WS] = h0 * s0 + h1 * s1 + h2 * s2
    kin[Q_WN] = h0 * n0 + h1 * n1 + h2 * n2
    # Velocity of the contact point itself: it follows the ball's centre round the ring's axis and
    # along the groove; u is the ball centre's velocity in the ring's frame without its spin.
    u0 = ball[BVX] - v0 - (w1 * d2 - w2 * d1)
    u1 = ball[BVR] - v1 - (w2 * d0 - w0 * d2)
    u2 = ball[BVT] - v2 - (w0 * d1 - w1 * d0)
    orbit = (u0 * t0 + u1 * t1 + u2 * t2) / rho
    along = (u0 * s0 + u1 * s1 + u2 * s2) / length
    x0, x1, x2 = w1 * n2 - w2 * n1, w2 * n0 - w0 * n2, w0 * n1 - w1 * n0
    ct = ball[BVX] * t0 + ball[BVR] * t1 + ball[BVT] * t2
    ct += dist * (orbit * nr + x0 * t0 + x1 * t1 + x2 * t2)
    cs = ball[BVX] * s0 + ball[BVR] * s1 + ball[BVT] * s2
    cs += dist * (along + x0 * s0 + x1 * s1 + x2 * s2)
    kin[Q_UT] = 0.5 * ((e0 + g0) * t0 + (e1 + g1) * t1 + (e2 + g2) * t2) - ct
    kin[Q_UT + 1] = 0.5 * ((e0 + g0) * s0 + (e1 + g1) * s1 + (e2 + g2) * s2) - cs
    # A raceway that rises under the ball: the penetration's own rate.
    kin[Q_VN] += kin[K_RISE] * (u0 * t0 + u1 * t1 + u2 * t2 - sigma * rho)
    kin[Q_VN] += kin[K_RISE + 1] * (u0 * s0 + u1 * s1 + u2 * s2)
    kin[K_T], kin[K_T + 1], kin[K_T + 2] = t0, t1, t2
    kin[K_S], kin[K_S + 1], kin[K_S + 2] = s0, s1, s2
    kin[K_N], kin[K_N + 1], kin[K_N + 2] = n0, n1, n2
    kin[K_D] = dist
    kin[K_ARM], kin[K_ARM + 1], kin[K_ARM + 2] = r0, r1, r2
    return delta


@helper
def contact_angle(kin, which):
    """Return the contact angle of an identified contact [rad]."""
    if which == INNER:
        return math.atan2(-kin[K_AXIAL], -kin[K_RADIAL])
    return math.atan2(kin[K_AXIAL], kin[K_RADIAL])


@helper
def apply_wrench(kin, wrench, ball_fm, ring_fm):
    """Turn a contact wrench into force and moment on ball and ring, equal and opposite.

    Parameters
    ----------
    wrench : float64[:], shape (6,)
        Force and couple on the ball at the contact's centre, axes t, s, n. On a raceway that rises along t and s the
        normal force leans by the slopes; it keeps passing through the ball's centre, on which alone the penetration
        depends.
    ball_fm : float64[:], shape (6,)
        Added to: force and moment about the ball's centre, axes x, r, t [N, N m].
    ring_fm : float64[:], shape (6,)
        Set: force and moment about the ring's centre, inertial axes x, y, z [N, N m].
    """
    d = kin[K_D]
    lean_t, lean_s = wrench[2] * kin[K_RISE], wrench[2] * kin[K_RISE + 1]
    ft, fs, mt, ms = wrench[0] + lean_t, wrench[1] + lean_s, wrench[3] + d * lean_s, wrench[4] - d * lean_t
    f0 = ft * kin[K_T] + fs * kin[K_S] + wrench[2] * kin[K_N]
    f1 = ft * kin[K_T + 1] + fs * kin[K_S + 1] + wrench[2] * kin[K_N + 1]
    f2 = ft * kin[K_T + 2] + fs * kin[K_S + 2] + wrench[2] * kin[K_N + 2]
    m0 = mt * kin[K_T] + ms * kin[K_S] + wrench[5] * kin[K_N]
    m1 = mt * kin[K_T + 1] + ms * kin[K_S + 1] + wrench[5] * kin[K_N + 1]
    m2 = mt * kin[K_T + 2] + ms * kin[K_S + 2] + wrench[5] * kin[K_N + 2]
    n0, n1, n2 = kin[K_N], kin[K_N + 1], kin[K_N + 2]
    ball_fm[0] += f0
    ball_fm[1] += f1
    ball_fm[2] += f2
    ball_fm[3] += m0 + d * (n1 * f2 - n2 * f1)
    ball_fm[4] += m1 + d * (n2 * f0 - n0 * f2)
    ball_fm[5] += m2 + d * (n0 * f1 - n1 * f0)
    r0, r1, r2 = kin[K_ARM], kin[K_ARM + 1], kin[K_ARM + 2]
    m0 = -m0 - (r1 * f2 - r2 * f1)
    m1 = -m1 - (r2 * f0 - r0 * f2)
    m2 = -m2 - (r0 * f1 - r1 * f0)
    c, s = kin[K_COS], kin[K_SIN]
    ring_fm[0], ring_fm[1], ring_fm[2] = -f0, -f1 * c + f2 * s, -f1 * s - f2 * c
    ring_fm[3], ring_fm[4], ring_fm[5] = m0, m1 * c - m2 * s, m1 * s + m2 * c
