"""Energy over one step: what loads and drives give, what the scheme itself takes.

The step solves D(y) = f(y), where D(u) = (u_n - base)/gamma is the difference quotient of the BDF. Energies are of
second order in the states, D(E) = grad E . D(y) but for squares of differences (_dissipated). So the running integrals
W are advanced by D(W) = P, with the powers P that the step's own equations of motion transfer: then work, losses and
the energy of the states part by small squares alone. By the trapezium rule they part by a speed times its local error.
"""

from __future__ import annotations

import math

from lambda_core.physics.compiled.layout import (
    BODY_FM,
    BPSI,
    BVR,
    BVT,
    BVX,
    BWX,
    CH_FORCE,
    CH_MOMENT,
    CH_MOTION,
    I_DRIVE,
    I_INPUT,
    I_INPUT_ABS,
    NB,
    NI,
    NL,
    NS,
    PRESCRIBED,
    SAY,
    SAZ,
    SHARED,
    SSIGMA,
    SVX,
    SWY,
    helper,
)
from lambda_core.physics.compiled.memory import BDF_BACK, BDF_GAMMA, H1, LEAK_FLOOR, LOST, TOLERANCE, T

# Shares of the energy that flows, over the tolerance, which a step may lose.
_LEAK = 0.4  # for good, twice (scheme and iteration): together a fifth below what a balance may miss
_SCATTER = 5.0  # with either sign: cancels from step to step but for single events, which this bounds
_OF_BDF = 0.7  # share of the BDF's error in its distance from the trapezium rule, 2/9 of 2/9 + 1/12


@helper
def _quotient(mem, shared, k):
    """Return D(shared[k])."""
    back = mem.control[BDF_BACK]
    base = mem.shared[k] + back * (mem.shared[k] - mem.shared1[k])
    return (shared[k] - base) / mem.control[BDF_GAMMA]


@helper
def _work_of_motions(bundle, mem):
    """Add to the input what differences of prescribed motions differ by from their derivatives.

    A ring that is led has the kinetic power m v D(v), and a force F on it does the work F D(x): not m v dv/dt and F v,
    where a motion has a corner or changes fast. Translation, tilt, spin.
    """
    system, channels, shared, rates = bundle.system[0], bundle.channels, bundle.scratch[SHARED], mem.rates
    for b in range(3):
        o, d = NS * b, 6 * b
        fm = bundle.scratch[BODY_FM + b]
        for i in range(3):
            if system.mode[d + i] == PRESCRIBED:
                v = shared[o + SVX + i]
                force = fm[i] - system.stiffness[d + i] * shared[o + i]
                off = _quotient(mem, shared, o + SVX + i) - channels[CH_MOTION + d + i, 2]
                rates[I_INPUT] += system.mass[b] * v * off - force * (_quotient(mem, shared, o + i) - v)
        # A tilt (phi_y, phi_z) turns the axis to (1, phi_z, -phi_y).
        for i in range(2):
            if system.mode[d + 3 + i] == PRESCRIBED:
                axis, sign = (o + SAZ, -1.0) if i == 0 else (o + SAY, 1.0)
                w = shared[o + SWY + i]
                moment = fm[4 + i] - system.stiffness[d + 3 + i] * sign * shared[axis]
                off = _quotient(mem, shared, o + SWY + i) - channels[CH_MOTION + d + 3 + i, 2]
                inertia = system.transverse_inertia[b]
                rates[I_INPUT] += inertia * w * off - moment * (sign * _quotient(mem, shared, axis) - w)
        if system.mode[d + 5] == PRESCRIBED:
            off = _quotient(mem, shared, o + SSIGMA) - channels[CH_MOTION + d + 5, 1]
            drive = system.polar_inertia[b] * shared[o + SSIGMA] * off
            rates[I_INPUT] += drive
            rates[I_DRIVE] += drive


@helper
def _work_of_loads(bundle, mem):
    """Return what the last Newton correction changes of the power of loads and weights on what is free [W]."""
    system, channels, move = bundle.system[0], bundle.channels, mem.last_move
    tail, power = NB * system.balls, 0.0
    gx, gy, gz = system.gravity[0], system.gravity[1], system.gravity[2]
    for j in range(system.balls):
        i = NB * j
        c, s = math.cos(mem.new[i + BPSI]), math.sin(mem.new[i + BPSI])
        along = gx * move[i + BVX] + (gy * c + gz * s) * move[i + BVR] + (gz * c - gy * s) * move[i + BVT]
        power += system.ball_mass * along
    for i in range(tail, mem.new.size):
        b, c = bundle.active[i - tail] // NS, bundle.active[i - tail] % NS
        if c >= SVX and c < SWY:
            load = channels[CH_FORCE + 3 * b + c - SVX, 0] + system.mass[b] * system.gravity[c - SVX]
            power += load * move[i]
        elif c >= SWY:
            axis = 0 if c == SSIGMA else c - SWY + 1
            power += channels[CH_MOMENT + 3 * b + axis, 0] * move[i]
    return power


@helper
def _residual_work(bundle, mem):
    """Return power of the residual D(y) - f at the last iterate [W], how much of it leads rings, and the spins' share.

    Creep is stiff: within the error allowed per step the tractions of an iterate may be off by more than themselves,
    and what the step accelerates the balls by, D(v), is not f. The difference is a force R on each ball (moment M)
    that came from the rings. A ring that is led and whose surface moves at u gave at most (|R| + |M|/r) |u|; the
    rest is nobody's work.
    """
    system, shared, gamma = bundle.system[0], bundle.scratch[SHARED], mem.control[BDF_GAMMA]
    tail, power, force = NB * system.balls, 0.0, 0.0
    for i in range(mem.new.size):
        if mem.inertia[i] > 0.0:
            off = mem.inertia[i] * ((mem.new[i] - mem.base[i]) / gamma - mem.slope[i])
            power += mem.new[i] * off
            if i < tail:
                force += abs(off) if i % NB < BWX else abs(off) / system.ball_radius
    speed, spin = 0.0, 0.0
    for b in range(2):
        for i in range(3):
            if system.mode[6 * b + i] == PRESCRIBED:
                speed += abs(shared[NS * b + SVX + i])
        if system.mode[6 * b + 5] == PRESCRIBED:
            spin += abs(shared[NS * b + SSIGMA]) * system.groove_circle[b]
    most = force * (speed + spin)
    return power, min(max(power, -most), most), spin / (speed + spin + 1e-300)


@helper
def _excess(mem, h, energy, share):
    """Return an energy over what a step may lose: `share` tolerances of what flows, or the floor.

    What flows is put in or dissipated, whichever is more, now or on the average so far.
    """
    control, rates, integrals = mem.control, mem.rates, mem.integrals
    lost, all_lost = 0.0, 0.0
    for i in range(NL):
        lost += rates[i]
        all_lost += integrals[i]
    flow = max(lost, rates[I_INPUT_ABS])
    if control[T] > 0.0:
        flow = max(flow, max(all_lost, integrals[I_INPUT_ABS]) / control[T])
    return abs(energy) / (share * control[TOLERANCE] * h * flow + control[LEAK_FLOOR])


@helper
def leak_of_iterate(bundle, mem, h):
    """Return the energy that the Newton iteration leaves unaccounted for, over what a step may lose.

    The powers are those of the last iterate: off by the work of its forces on the last correction at most, and by
    what of the residual's work is nobody's.
    """
    power, led, _ = _residual_work(bundle, mem)
    off = abs(power - led)
    for i in range(mem.new.size):
        off += abs(mem.inertia[i] * mem.slope[i] * mem.last_move[i])
    return _excess(mem, h, h * off, _LEAK)


@helper
def settle(bundle, mem):
    """Bring positions and powers from the last iterate to the step's result.

    A matrix factored for another gamma leaves D(x) - v, next to nothing; times the forces in the contacts it is energy.
    Loads, and what leads or drives rings: see _work_of_loads, _work_of_motions, _residual_work.
    """
    gamma, rates = mem.control[BDF_GAMMA], mem.rates
    for i in range(mem.new.size):
        p = mem.place[i]
        if p >= 0:
            mem.new[p] = mem.base[p] + gamma * mem.new[i]
    _work_of_motions(bundle, mem)
    _, led, share = _residual_work(bundle, mem)
    rates[I_INPUT] += led + _work_of_loads(bundle, mem)
    rates[I_DRIVE] += led * share
    rates[I_INPUT_ABS] = abs(rates[I_INPUT])


@helper
def _dissipated(mem, h):
    """Return the kinetic energy that the scheme itself dissipates in this step [J].

    With base = u_1 + a (u_1 - u_2) and d_k = u - u_k, gamma [D(u^2) - 2 u D(u)] = a d_2^2 - (1 + a) d_1^2: a difference
    of two norms, which the next steps give back, and a w e^2, e = d_1/w - (u_1 - u_2), w the ratio of the steps; all
    steps together lose that over 1 - a (equal steps: Hairer and Wanner 1996, Solving ODEs II, V.6).
    """
    w, back = h / mem.control[H1], mem.control[BDF_BACK]
    total = 0.0
    for i in range(mem.new.size):
        e = (mem.new[i] - mem.y[i]) / w - (mem.y[i] - mem.y1[i])
        total += mem.inertia[i] * e * e
    return 0.5 * w * back / (1.0 - back) * total


@helper
def _quadrature(mem, h):
    """Return the error of the dissipated energy in this step [J]: the BDF's increment against the trapezium's.

    Of the third derivative times h^3 the one misses (1 + w)^2/(6 w (1 + 2 w)), 2/9 in equal steps, the other -1/12.
    """
    lost, grown = 0.0, 0.0
    for i in range(NL):
        lost += mem.rates[i]
        grown += mem.integrals[i] - mem.integrals1[i]
    grown = mem.control[BDF_BACK] * grown + mem.control[BDF_GAMMA] * lost
    return _OF_BDF * (grown - 0.5 * h * (lost + mem.control[LOST]))


@helper
def leak_of_step(mem, h):
    """Return the energy that the scheme loses in this step, over what a step may lose.

    What is dissipated adds up; errors of quadrature have either sign.
    """
    return max(_excess(mem, h, _dissipated(mem, h), _LEAK), _excess(mem, h, _quadrature(mem, h), _SCATTER))


@helper
def add_to_integrals(mem):
    """Advance the running integrals by D(W) = P."""
    back, gamma = mem.control[BDF_BACK], mem.control[BDF_GAMMA]
    for i in range(NI):
        grown = back * (mem.integrals[i] - mem.integrals1[i]) + gamma * mem.rates[i]
        mem.integrals1[i] = mem.integrals[i]
        mem.integrals[i] += grown
    mem.control[LOST] = 0.0
    for i in range(NL):
        mem.control[LOST] += mem.rates[i]
