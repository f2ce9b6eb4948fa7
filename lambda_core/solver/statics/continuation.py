"""Solve the equilibrium by pseudo-transient continuation.

The forces are those of the dynamic model.

Every ball stays at its azimuth. Unknowns: axial and radial position, orbital speed and spin
vector of each ball, position and tilt of the free rings. Positions follow their accelerations like an overdamped
system, speeds follow theirs; implicit Euler with a step that grows as the residual falls turns into
Newton's method at the end (Kelley and Keyes 1998, SIAM J. Numer. Anal. 35, 508).
Centrifugal force and gyroscopic moment are those of the equations of motion.
"""

from __future__ import annotations

import math

import numpy as np

from lambda_core.solver.arrays.bundle import BR, BVT, BWR, BWT, BWX, BX, MECHANISMS, NB, RUNNING_SIZE
from lambda_core.solver.contact.contact_kinematics import touch
from lambda_core.solver.integrator.arrow import arrow_factor, arrow_solve
from lambda_core.solver.integrator.blocks import blocks_t, factors_t
from lambda_core.solver.integrator.memory import evaluate_t, jacobian_t
from lambda_core.solver.layout import array1, balls_of, bundle_t, first_of, helper, i8, iarray1, table_t
from lambda_core.solver.records import ROLLERS, STATIC_REPORT
from lambda_core.solver.row_code import roller_code
from lambda_core.solver.statics.pseudo_transient import mask, residual
from lambda_core.solver.status import Status

report_t = table_t(STATIC_REPORT)
solve_static_sig = i8(
    evaluate_t, jacobian_t, bundle_t, blocks_t, factors_t, array1, array1, array1, array1, iarray1, report_t, i8
)
_LARGEST_MOVE = 0.2  # of the states' scales (10 um) per iteration, so that no iterate jumps through a contact
_LARGEST_CHANGE = 0.1  # of a ball's rolling speeds per iteration
_DOUBT, _TRUST = 0.4, 1.3  # change of that limit, ball by ball, where a step undoes the one before and where not
_FIRST_STEP, _LAST_STEP = 1e-6, 1e6  # [s] of pseudo-time
_CONVERGED = 1e-7  # last Newton step over the states' scales
_TOLERATED_RISE = 1.5
_CALM = 0.1  # shortening of the pseudo-time step when a step undoes the one before
_GRIP = 0.02  # share of the largest ball load below which the cage sets a ball's orbital speed


@helper
def _load_shares(y, bundle, share):
    """Write each ball's share of the load.

    It is that on the ring of its row's first raceway, over the largest one.
    """
    kin = bundle.scratch[0].kinematics[0]
    largest = 1e-300
    for r in range(bundle.rows.size):
        row = bundle.rows[r]
        if row.kind == ROLLERS:
            roller_code(bundle.rollers, 0).shares(y, r, bundle, share)
            for j in range(row.first_ball, row.first_ball + row.balls):
                largest = max(largest, share[j])
            continue
        balls, body = balls_of(y, row), bundle.raceways[row.first_raceway].body
        for j in range(row.first_ball, row.first_ball + row.balls):
            share[j] = 0.0
            for k in range(row.first_raceway, row.first_raceway + row.raceways):
                raceway = bundle.raceways[k]
                if raceway.body == body:
                    delta = touch(balls[j - row.first_ball], bundle.bodies_now[body], raceway, bundle, kin)
                    share[j] = max(share[j], delta)
            largest = max(largest, share[j])
    for j in range(share.size):
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
def _orbit(y, bundle, share, held):
    """Return the mean orbital speed of loaded balls.

    Weighted by load, of the balls that hold themselves.
    """
    total, weight = 0.0, 0.0
    for r in range(bundle.rows.size):
        row = bundle.rows[r]
        for j in range(row.first_ball, row.first_ball + row.balls):
            if not held[j]:
                first = first_of(row, j)
                total += share[j] * y[first + BVT] / y[first + BR]
                weight += share[j]
    first = bundle.rows[0].first_state
    return total / weight if weight > 0.0 else y[first + BVT] / y[first + BR]


@helper
def _merit(v, weight):
    """Return the weighted root mean square of v."""
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
def _learn(step, last, weight, trust, bundle):
    """Adapt the limit of a ball.

    Narrower where its speeds jump to and fro, wider again where they do not.

    A ball that carries next to nothing rolls within a slip of micrometres per second of a sign-like friction; steps
    that are halved find that slip like a bisection, whatever the other balls do.
    """
    for r in range(bundle.rows.size):
        row = bundle.rows[r]
        for j in range(row.first_ball, row.first_ball + row.balls):
            first, dot, size, size_last = first_of(row, j), 0.0, 0.0, 0.0
            for i in range(first + BVT, first + BWT + 1):
                w2 = weight[i] * weight[i]
                dot += w2 * step[i] * last[i]
                size += w2 * step[i] * step[i]
                size_last += w2 * last[i] * last[i]
            back = dot < -0.25 * math.sqrt(size * size_last)
            trust[j] = _DOUBT * trust[j] if back else min(1.0, _TRUST * trust[j])


@helper
def _spin_in(y, first):
    """Return the largest component of a spin.

    The states of the element begin at `first`.
    """
    return max(abs(y[first + BWX]), abs(y[first + BWR]), abs(y[first + BWT]))


@helper
def _clip_speeds(step, speed, spin, trust, bundle):
    """Shorten the change of balls' speeds.

    They are shortened to a share of rolling; tell whether any was too long.

    On a plateau of friction the slope is next to nothing and Newton's method would leave for speeds from which no way
    leads back. Ball by ball, so that one of them does not keep the others waiting.
    """
    clipped = False
    for r in range(bundle.rows.size):
        row = bundle.rows[r]
        for j in range(row.first_ball, row.first_ball + row.balls):
            first, limit = first_of(row, j), trust[j] * _LARGEST_CHANGE
            share = limit * speed / (abs(step[first + BVT]) + 1e-300)
            share = min(1.0, limit * spin / (_spin_in(step, first) + 1e-300), share)
            if share < 1.0:
                clipped = True
                for i in range(BVT, BWT + 1):
                    step[first + i] *= share
    return clipped


@helper
def _largest_move(step, weight, bundle):
    """Return the largest move.

    It is the change of a position or tilt over its scale.
    """
    largest = 0.0
    for r in range(bundle.rows.size):
        row = bundle.rows[r]
        for j in range(row.first_ball, row.first_ball + row.balls):
            first = first_of(row, j)
            for i in range(first + BX, first + BR + 1):
                largest = max(largest, abs(step[i]) * weight[i])
            for i in range(first + NB, first + row.size):
                largest = max(largest, abs(step[i]) * weight[i])
    for i in range(bundle.system[0].tail, step.size):
        largest = max(largest, abs(step[i]) * weight[i])
    return largest


@helper
def _speeds(y, bundle, report):
    """Write the balls' largest speed and spin.

    Their least values let a ball that rests start to move.
    """
    report.speed, report.spin = 1e-3, 1e-1
    for r in range(bundle.rows.size):
        row = bundle.rows[r]
        for j in range(row.first_ball, row.first_ball + row.balls):
            first = first_of(row, j)
            report.speed = max(report.speed, abs(y[first + BVT]))
            report.spin = max(report.spin, _spin_in(y, first))


def solve_static(evaluate, jacobian, bundle, bl, fa, y, weight, last, trust, held, reports, max_iterations):
    """Find the equilibrium from y, in place.

    Nobody hears a signal meanwhile, so it is done in parts.

    Parameters
    ----------
    y : float64[:], shape (9 Z + n_active,)
        Start and result.
    weight : float64[:]
        1 / scale of each state; the last Newton step is measured with it.
    last : float64[:], shape (9 Z + n_active,)
        The last step, for the next call.
    trust : float64[:], shape (Z,)
        Limit on the change of each ball's speeds over its largest, likewise; 1 at the first call.
    held : int64[:], shape (Z,)
        Balls that the cage drives, likewise.
    reports : STATIC_REPORT record, shape (1,)
        How far it has come; zeros at the first call.
    max_iterations : int
        Of this call.

    Returns
    -------
    int
        A Status: OK, UNFINISHED, NOT_CONVERGED (no step is short enough), REFUSED (see scratch.fault).
    """
    system, scratch, report = bundle.system[0], bundle.scratch[0], reports[0]
    n = y.size
    dydt, f, step, trial = np.zeros(n), np.zeros(n), np.zeros(n), np.zeros(n)
    rates = np.zeros(MECHANISMS * bundle.raceways.size + RUNNING_SIZE)
    new, share = np.zeros(n), np.zeros(system.balls)
    if evaluate(0.0, y, bundle, dydt, rates, 0) != Status.OK:
        return Status.REFUSED
    _load_shares(y, bundle, share)
    if report.iterations == 0.0:
        report.pseudo_step = _FIRST_STEP
        _hold(share, held)
        _speeds(y, bundle, report)
    dt, speed, spin = report.pseudo_step, report.speed, report.spin
    orbit = _orbit(y, bundle, share, held)
    residual(bundle, bl.index, y, dydt, held, orbit, f)
    merit = _merit(f, weight)
    for _ in range(max_iterations):
        if jacobian(0.0, y, bundle, bl) != Status.OK:
            return Status.REFUSED
        mask(bundle, bl, held)
        tries = 0
        while True:
            for i in range(n):
                step[i] = dt * f[i]
            if arrow_factor(bl, 1.0, dt, fa) == 1:
                arrow_solve(bl, fa, step)
                size = _merit(step, weight)
                clipped = system.friction_on == 1 and size > _CONVERGED
                clipped = clipped and _clip_speeds(step, speed, spin, trust, bundle)
                shrink = min(1.0, _LARGEST_MOVE / (_largest_move(step, weight, bundle) + 1e-300))
                for i in range(n):
                    trial[i] = y[i] + shrink * step[i]
                if size < np.inf and evaluate(0.0, trial, bundle, dydt, rates, 0) == Status.OK:
                    _load_shares(trial, bundle, share)
                    orbit = _orbit(trial, bundle, share, held)
                    residual(bundle, bl.index, trial, dydt, held, orbit, new)
                    found = _merit(new, weight)
                    # Overdamped motion may pass through states of larger residual, but not by much.
                    if found < _TOLERATED_RISE * merit or dt <= _FIRST_STEP or size < _CONVERGED:
                        break
            dt *= 0.2
            tries += 1
            if tries > 20:
                return Status.REFUSED if scratch.fault.role >= 0 else Status.NOT_CONVERGED
        gain = merit / (found + 1e-300)
        merit = found
        turned = size > _CONVERGED and not clipped and _turned_back(step, last, weight)
        if size > _CONVERGED:  # below it steps turn round by rounding alone
            _learn(step, last, weight, trust, bundle)
        for i in range(n):
            y[i] = trial[i]
            f[i] = new[i]
            last[i] = step[i]
        report.iterations += 1.0
        report.last_change, report.orbit = size, orbit
        if dt >= 1.0 and size < _CONVERGED and shrink == 1.0 and not clipped:
            return Status.OK
        if turned:
            dt *= _CALM
        elif shrink == 1.0 and not clipped:
            dt = min(_LAST_STEP, dt * max(0.5, min(5.0, 2.0 * gain)))
        report.pseudo_step = dt
    return Status.UNFINISHED
