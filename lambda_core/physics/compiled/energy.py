"""Energy that is stored in motion, contacts and supports."""

from __future__ import annotations

import math

from lambda_core.physics.compiled.cage import (
    GAUSS_NODES,
    GAUSS_WEIGHTS,
    guide_energy,
    land_state,
    neighbour_state,
    pocket_state,
)
from lambda_core.physics.compiled.kinematics import axis_x, contact_kinematics, surface_lift
from lambda_core.physics.compiled.layout import (
    BVR,
    BVT,
    BVX,
    BWR,
    BWT,
    BWX,
    CAGE,
    GUIDE,
    INNER,
    KIN,
    NB,
    NS,
    OUT,
    P_LAND,
    P_POCKET,
    Q_DELTA,
    R_NORMAL,
    RACEWAY_KERNELS,
    SAY,
    SAZ,
    SHARED,
    SSIGMA,
    STILL,
    SVX,
    SWY,
    SWZ,
    helper,
    par_of,
)
from lambda_core.physics.compiled.timefunctions import fill_shared


@helper
def _contact_energy(which, delta, bundle):
    """Return the elastic energy of a raceway contact at penetration delta [J].

    With delta u^2 for the penetration, eight points are exact for a power law of exponent 3/2.
    """
    scratch = bundle.scratch
    system = bundle.system[0]
    laws = bundle.laws.inner if which == INNER else bundle.laws.outer
    par = bundle.par
    total = 0.0
    for i in range(GAUSS_NODES.size):
        u = GAUSS_NODES[i]
        laws.normal_contact(
            delta * u * u, system.radius_x[which], system.radius_y[which], system.e_eff[which],
            par_of(par, system, RACEWAY_KERNELS * which + R_NORMAL), scratch[OUT],
        )  # fmt: skip
        total += GAUSS_WEIGHTS[i] * scratch[OUT][0] * 2.0 * delta * u
    return total


@helper
def _kinetic_body(body, b, system):
    ay, az = body[SAY], body[SAZ]
    ax = axis_x(ay, az)
    wy, wz, sigma = body[SWY], body[SWZ], body[SSIGMA]
    wx = -(wy * ay + wz * az) / ax
    v2 = body[SVX] ** 2 + body[SVX + 1] ** 2 + body[SVX + 2] ** 2
    energy = 0.5 * system.mass[b] * v2 + 0.5 * system.polar_inertia[b] * sigma * sigma
    energy += 0.5 * system.transverse_inertia[b] * (wx * wx + wy * wy + wz * wz)
    for i in range(3):
        energy += 0.5 * system.stiffness[6 * b + i] * body[i] * body[i]
    energy += 0.5 * system.stiffness[6 * b + 3] * az * az + 0.5 * system.stiffness[6 * b + 4] * ay * ay
    return energy


@helper
def stored_energy(t, y, bundle):
    """Return kinetic plus elastic energy of all bodies, contacts and supports [J]."""
    scratch = bundle.scratch
    system, out = bundle.system[0], scratch[OUT]
    fill_shared(t, y, bundle)
    total = 0.0
    cage = scratch[SHARED][NS * CAGE : NS * CAGE + NS]
    for j in range(system.balls):
        ball = y[NB * j : NB * j + NB]
        v2 = ball[BVX] ** 2 + ball[BVR] ** 2 + ball[BVT] ** 2
        w2 = ball[BWX] ** 2 + ball[BWR] ** 2 + ball[BWT] ** 2
        total += 0.5 * system.ball_mass * v2 + 0.5 * system.ball_inertia * w2
        for which in range(2):
            ring = scratch[SHARED][NS * which : NS * which + NS]
            if system.surfaces == 1:
                surface_lift(ball, ring, which, bundle, scratch[KIN])
            if contact_kinematics(ball, ring, which, system, scratch[KIN]) > 0.0:
                total += _contact_energy(which, scratch[KIN][Q_DELTA], bundle)
        if system.guides_on == 1:
            g, law, par = (scratch[GUIDE], bundle.laws.pocket, par_of(bundle.par, system, P_POCKET))
            start = 0.0
            if system.cage_on == 1:
                pocket_state(ball, cage, j, system, g)
            else:
                k = (j + 1) % system.balls
                neighbour_state(ball, y[NB * k : NB * k + NB], g)
                apart = math.sqrt(g[0] ** 2 + g[1] ** 2 + g[2] ** 2)
                start = max(1.0, 2.0 * system.ball_radius / apart)
            total += guide_energy(law, par, g, system.eta0, out, scratch[STILL], start)
    for b in range(3):
        if b != CAGE or system.cage_on == 1:
            total += _kinetic_body(scratch[SHARED][NS * b : NS * b + NS], b, system)
    if system.cage_on == 1 and system.guides_on == 1:
        for which in range(2):
            if system.land_on[which] == 0:
                continue
            law = bundle.laws.land_inner if which == INNER else bundle.laws.land_outer
            par = par_of(bundle.par, system, P_LAND + which)
            ring = scratch[SHARED][NS * which : NS * which + NS]
            for side in range(2):
                land_state(cage, ring, (2 * side - 1) * system.land_offset, scratch[GUIDE])
                total += guide_energy(law, par, scratch[GUIDE], system.eta0, out, scratch[STILL], 0.0)
    return total
