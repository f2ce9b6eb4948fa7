"""Quasi-static equilibrium on the dynamic model's own forces, by pseudo-transient continuation.

Every ball stays at its azimuth. Unknowns: axial and radial position, orbital speed and spin
vector of each ball, position and tilt of the free rings. Positions follow their accelerations like an overdamped
system, speeds follow theirs; implicit Euler with a step that grows as the residual falls turns into
Newton's method at the end (Kelley and Keyes 1998, SIAM J. Numer. Anal. 35, 508).
Centrifugal force and gyroscopic moment are those of the equations of motion.
"""

from __future__ import annotations

import math

import numpy as np

from lambda_core.physics.compiled.arrow import arrow_factor, arrow_solve, factors_t
from lambda_core.physics.compiled.blocks import blocks_t
from lambda_core.physics.compiled.kinematics import contact_kinematics
from lambda_core.physics.compiled.layout import (
    BR,
    BVT,
    FAULT,
    INNER,
    KIN,
    NB,
    NI,
    NS,
    SHARED,
    array1,
    bundle_t,
    helper,
    i8,
)
from lambda_core.physics.compiled.memory import evaluate_t, jacobian_t
from lambda_core.physics.compiled.pseudo_transient import mask, residual

settle_sig = i8(evaluate_t, jacobian_t, bundle_t, blocks_t, factors_t, array1, array1, array1, i8)
_LARGEST_MOVE = 0.2  # of the states' scales (10 um) per iteration, so that no iterate jumps through a contact
_LARGEST_CHANGE = 0.1  # of a ball's rolling speeds per iteration
_FIRST_STEP, _LAST_STEP = 1e-6, 1e6  # [s] of pseudo-time
_CONVERGED = 1e-7  # last Newton step over the states' scales
_TOLERATED_RISE = 1.5
_CALM = 0.1  # shortening of the pseudo-time step when a step undoes the one before
_GRIP = 0.02  # share of the largest ball load below which the cage sets a ball's orbital speed


@helper
def _load_shares(y, bundle, share):
    """Write the load of each ball on the inner ring over the largest one."""
    scratch = bundle.scratch
    balls = bundle.system[0].balls
    ring = scratch[SHARED][NS * INNER : NS * INNER + NS]
    largest = 1e-300
    for j in range(balls):
        share[j] = max(0.0, contact_kinematics(y[NB * j : NB * j + NB], ring, INNER, bundle.system[0], scratch[KIN]))
        largest = max(largest, share[j])
    for j in range(balls):
        share[j] = (share[j] / largest) ** 1.5


@helper
def _hold(share, held):
    """Mark the balls that the cage drives.

    A ball finds its own orbital speed where the inner ring grips it. One that carries little cannot hold
    itself against gravity and drag, in a bearing the cage does that. Decided once, at the start: a ball at the
    limit would be gripped and lost in turn.
    """
    for j in range(share.size):
        held[j] = share[j] < _GRIP


@helper
def _orbit(y, share, held):
    """Return the load-weighted mean orbital speed of the balls that hold themselves."""
    total, weight = 0.0, 0.0
    for j in range(share.size):
        if not held[j]:
            total += share[j] * y[NB * j + BVT] / y[NB * j + BR]
            weight += share[j]
    return total / weight if weight > 0.0 else y[BVT] / y[BR]


@helper
def _merit(v, weight):
    """Return the root mean square of v measured with the weights."""
    total = 0.0
    for i in range(v.size):
        total += (v[i] * weight[i]) ** 2
    return math.sqrt(total / v.size)


@helper
def _turned_back(step, last, weight):
    """Tell whether a step undoes most of the one before.

    Friction is nearly a sign function of slip: from one of its plateaus Newton's method jumps to the other and back for
    ever, unless the step is so short that it ends in between.
    """
    dot, size, size_last = 0.0, 0.0, 0.0
    for i in range(step.size):
        w2 = weight[i] * weight[i]
        dot += w2 * step[i] * last[i]
        size += w2 * step[i] * step[i]
        size_last += w2 * last[i] * last[i]
    return dot < -0.5 * math.sqrt(size * size_last) and size > 0.25 * size_last


@helper
def _clip_speeds(step, speed, spin, balls):
    """Shorten the change of each ball's speeds to a share of rolling; tell whether any was too long.

    On a plateau of friction the slope is next to nothing and Newton's method would leave for speeds from which no way
    leads back. Ball by ball, so that one of them does not keep the others waiting.
    """
    clipped = False
    for j in range(balls):
        o = NB * j
        turn = max(abs(step[o + 6]), abs(step[o + 7]), abs(step[o + 8]))
        share = min(
            1.0, _LARGEST_CHANGE * spin / (turn + 1e-300), _LARGEST_CHANGE * speed / (abs(step[o + BVT]) + 1e-300)
        )
        if share < 1.0:
            clipped = True
            for i in range(BVT, NB):
                step[o + i] *= share
    return clipped


@helper
def _largest_move(step, weight, balls):
    """Return the largest change of a position or tilt over its scale."""
    largest = 0.0
    for j in range(balls):
        for i in range(2):
            largest = max(largest, abs(step[NB * j + i]) * weight[NB * j + i])
    for i in range(NB * balls, step.size):
        largest = max(largest, abs(step[i]) * weight[i])
    return largest


def settle(evaluate, jacobian, bundle, bl, fa, y, weight, report, max_iterations):
    """Find the equilibrium from the state y, in place.

    Parameters
    ----------
    y : float64[:], shape (9 Z + n_active,)
        Start and result.
    weight : float64[:]
        1 / scale of each state; the last Newton step is measured with it.
    report : float64[:], shape (4,)
        Iterations, size of the last step, pseudo-time step, mean orbital speed [rad/s].

    Returns
    -------
    int
        1 converged, 0 not, -1 a kernel refused (scratch[FAULT]).
    """
    system, scratch = bundle.system[0], bundle.scratch
    n = y.size
    dydt, f, step, trial, rates = (np.zeros(n), np.zeros(n), np.zeros(n), np.zeros(n), np.zeros(NI))
    held, share = np.zeros(system.balls, dtype=np.bool_), np.zeros(system.balls)
    last = np.zeros(n)
    new, dt = np.zeros(n), _FIRST_STEP
    if evaluate(0.0, y, bundle, dydt, rates, 0) != 1:
        return -1
    _load_shares(y, bundle, share)
    _hold(share, held)
    orbit = _orbit(y, share, held)
    residual(bundle, bl.index, y, dydt, held, orbit, f)
    merit = _merit(f, weight)
    speed, spin = 1e-3, 1e-1  # of a ball that rests, so that it can start to move
    for j in range(system.balls):
        speed = max(speed, abs(y[NB * j + BVT]))
        spin = max(spin, abs(y[NB * j + 6]), abs(y[NB * j + 7]), abs(y[NB * j + 8]))
    for iteration in range(max_iterations):
        if jacobian(0.0, y, bundle, bl) != 1:
            return -1
        mask(bundle, bl, held)
        tries = 0
        while True:
            for i in range(n):
                step[i] = dt * f[i]
            if arrow_factor(bl, 1.0, dt, fa) == 1:
                arrow_solve(fa, step)
                size = _merit(step, weight)
                clipped = system.friction_on == 1 and _clip_speeds(step, speed, spin, system.balls)
                shrink = min(1.0, _LARGEST_MOVE / (_largest_move(step, weight, system.balls) + 1e-300))
                for i in range(n):
                    trial[i] = y[i] + shrink * step[i]
                if size < np.inf and evaluate(0.0, trial, bundle, dydt, rates, 0) == 1:
                    _load_shares(trial, bundle, share)
                    orbit = _orbit(trial, share, held)
                    residual(bundle, bl.index, trial, dydt, held, orbit, new)
                    found = _merit(new, weight)
                    # Overdamped motion may pass through states of larger residual, but not by much.
                    if found < _TOLERATED_RISE * merit or dt <= _FIRST_STEP or size < _CONVERGED:
                        break
            dt *= 0.2
            tries += 1
            if tries > 20:
                return -1 if scratch[FAULT, 0] >= 0.0 else 0
        gain = merit / (found + 1e-300)
        merit = found
        turned = size > _CONVERGED and _turned_back(step, last, weight)
        for i in range(n):
            y[i] = trial[i]
            f[i] = new[i]
            last[i] = step[i]
        report[0], report[1], report[2], report[3] = iteration + 1.0, size, dt, orbit
        if dt >= 1.0 and size < _CONVERGED and shrink == 1.0 and not clipped:
            return 1
        if turned:
            dt *= _CALM
        elif shrink == 1.0 and not clipped:
            dt = min(_LAST_STEP, dt * max(0.5, min(5.0, 2.0 * gain)))
    return 0
