"""The right-hand side: all force elements, then the equations of motion, and the powers on demand."""

from __future__ import annotations

import math

from lambda_core.physics.compiled.elements import cage_forces, clear_forces, drag_force, raceway_forces
from lambda_core.physics.compiled.layout import (
    BODY_FM,
    BPSI,
    BVR,
    BVT,
    BVX,
    CAGE,
    FAULT,
    I_ANGLE,
    I_INPUT,
    I_INPUT_ABS,
    I_X,
    L_DRAG,
    NB,
    NS,
    OUTER,
    RATE,
    SHARED,
    SSIGMA,
    helper,
)
from lambda_core.physics.compiled.motion import ball_rates, body_rates
from lambda_core.physics.compiled.timefunctions import fill_shared


@helper
def _move_ball(y, j, bundle, rates, want, dydt):
    """Add drag and weight to the forces on ball j and write its accelerations."""
    scratch, system, fm = bundle.scratch, bundle.system[0], bundle.ball_fm[j]
    ball = y[NB * j : NB * j + NB]
    if system.drag_on == 1 and system.friction_on == 1:
        lost = drag_force(ball, bundle, fm)
        if lost < -0.5:
            scratch[FAULT][2] = j
            return 0
        rates[L_DRAG] += lost
    c, s = math.cos(ball[BPSI]), math.sin(ball[BPSI])
    m, gx, gy, gz = system.ball_mass, system.gravity[0], system.gravity[1], system.gravity[2]
    wx, wr, wt = m * gx, m * (gy * c + gz * s), m * (-gy * s + gz * c)
    fm[0] += wx
    fm[1] += wr
    fm[2] += wt
    if want == 1:
        rates[I_INPUT] += wx * ball[BVX] + wr * ball[BVR] + wt * ball[BVT]
    ball_rates(ball, fm, system, dydt[NB * j : NB * j + NB])
    return 1


@helper
def _move_bodies(bundle, rates, want, dydt):
    """Write the rates of the free states of rings and cage."""
    scratch, system, active = bundle.scratch, bundle.system[0], bundle.active
    k = 0
    for b in range(3):
        if b == CAGE and system.cage_on == 0:
            continue
        body = scratch[SHARED][NS * b : NS * b + NS]
        body_rates(body, b, scratch[BODY_FM + b], bundle.channels, system, scratch[RATE], rates, want)
        while k < active.size and active[k] < NS * (b + 1):
            dydt[NB * system.balls + k] = scratch[RATE][active[k] - NS * b]
            k += 1


def evaluate(t, y, bundle, dydt, rates, want):
    """Write dy/dt; with `want` = 1 also the powers and rates of the running integrals; an entry point.

    Parameters
    ----------
    t : float
        Time [s].
    y, dydt : float64[:], shape (9 Z + n_active,)
    rates : float64[:], shape (NI,)
        Losses by mechanism [W], input power [W], its absolute value, drive power, |relative speed| [rad/s],
        position of the inner ring [m].
    want : int
        0, 1; or 2: as 1, and the raceways' share of the forces (bundle.ball_fm, scratch[BODY_FM]) and of `rates` is
        there already, left by a caller that has gone through them itself.

    Returns
    -------
    int
        1 when every kernel was well; otherwise 0 and scratch[FAULT] says which was not.
    """
    scratch = bundle.scratch
    system = bundle.system[0]
    scratch[FAULT][0] = -1.0
    fill_shared(t, y, bundle)
    z = system.balls
    if want < 2:
        clear_forces(bundle)
        rates[:] = 0.0
        for j in range(z):
            if raceway_forces(y, j, bundle, rates, want) != 1:
                return 0
    want = min(want, 1)
    if system.guides_on == 1 and cage_forces(y, bundle, rates, want) != 1:
        return 0
    for j in range(z):
        if _move_ball(y, j, bundle, rates, want, dydt) != 1:
            return 0
    _move_bodies(bundle, rates, want, dydt)
    if want == 1:
        rates[I_INPUT_ABS] = abs(rates[I_INPUT])
        rates[I_ANGLE] = abs(scratch[SHARED][SSIGMA] - scratch[SHARED][NS * OUTER + SSIGMA])
        for i in range(3):
            rates[I_X + i] = scratch[SHARED][i]
    return 1
