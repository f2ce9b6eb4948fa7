"""Integrate vibrations by ESDIRK4(3)6L[2]SA.

It has order 4 and uses the arrow structure and iteration of the BDF.

What a BDF of order 2 takes of a swing in a step is (w h)^4/4 of its amplitude and (w h)^2/3 of its frequency, so that
it needs 51 steps per period for 0.5 % of the frequency; this formula needs four, and leaves the amplitude alone.
Each implicit stage is a step of the form new = base + gamma f(new), which newton.solve_step solves.

The running integrals W advance by the weights of the formula, with the powers that each stage's own equations of
motion transfer: work, losses and energy then part by what the scheme itself takes (stage_balance.leak_of_stages),
which is known, and by the error of quadrature of elastic energies, which is of the order of the formula.
"""

from __future__ import annotations

from lambda_core.solver.integrator.correction import norm
from lambda_core.solver.integrator.newton import solve_step
from lambda_core.solver.integrator.stage_balance import add_turn_over, leak_of_stages, settle_prescribed
from lambda_core.solver.integrator.stepping import take_steps
from lambda_core.solver.integrator.tableau import ERROR, GAMMA, NODES, STAGES, WEIGHTS, A
from lambda_core.solver.layout import helper
from lambda_core.solver.status import Status

_ORDER = -0.25  # power of the error that the step follows: the embedded formula is of order 3
_START, _LATE = STAGES, STAGES + 1  # rows of mem.stages: slopes at the start of the last step, and at a later stage
_LATER = 3  # that stage
# Rows of slopes through which a stage's is extrapolated: near it, and far enough apart not to amplify their errors.
_THROUGH = ((0, 0, 0), (_START, _LATE, 0), (_START, 0, 1), (_START, 0, 1), (_START, 0, 3), (0, 3, 4))


@helper
def _put(table, row, values):
    """Write values into a row.

    A slice would be copied with memory of its own.
    """
    for i in range(values.size):
        table[row, i] = values[i]


@helper
def _begin(evaluate, bundle, mem):
    """Write the start's slopes and shared state.

    The slopes are those of the first stage.
    """
    if evaluate(mem.control[0].time, mem.y, bundle, mem.slope, mem.rates, 1) != Status.OK:
        return Status.REFUSED
    _put(mem.stages, 0, mem.slope)
    _put(mem.stage_rates, 0, mem.rates)
    for i in range(mem.shared.size):
        mem.shared[i], mem.stage_shared[0, i] = bundle.shared[i], bundle.shared_rates[i]
    return Status.OK


@helper
def _node(row, ratio):
    """Return the time of a slopes' row.

    It is in steps from the start of the current step; `ratio` relates it to the last step.
    """
    if row < STAGES:
        return NODES[row]
    return -1.0 / ratio if row == _START else (NODES[_LATER] - 1.0) / ratio


@helper
def _guess(mem, stage, ratio):
    """Return rows and weights of extrapolation.

    They are for a stage's slope (Lagrange).
    """
    if mem.count[0].history == 0:
        return 0, 0, 0, 1.0, 0.0, 0.0
    i, j, k = _THROUGH[stage]
    x, a, b, c = NODES[stage], _node(i, ratio), _node(j, ratio), _node(k, ratio)
    first = (x - b) * (x - c) / ((a - b) * (a - c))
    second = (x - a) * (x - c) / ((b - a) * (b - c))
    return i, j, k, first, second, 1.0 - first - second


@helper
def _prepare(mem, stage, h):
    """Write a stage's base, gamma and guess.

    Its iteration begins at the guess.
    """
    control, stages = mem.control[0], mem.stages
    gamma = GAMMA * h
    control.gamma = gamma
    for i in range(mem.base.size):
        mem.base[i] = mem.y[i]
    for i in range(mem.shared.size):
        mem.shared_base[i] = mem.shared[i]
    for j in range(stage):
        weight = h * A[stage, j]
        for i in range(mem.base.size):
            mem.base[i] += weight * stages[j, i]
        for i in range(mem.shared.size):
            mem.shared_base[i] += weight * mem.stage_shared[j, i]
    a, b, c, first, second, third = _guess(mem, stage, h / (control.last_step + 1e-300))
    for i in range(mem.base.size):
        slope = first * stages[a, i] + second * stages[b, i] + third * stages[c, i]
        mem.predicted[i] = mem.base[i] + gamma * slope


@helper
def _keep(bundle, mem, stage):
    """Keep a solved stage's slopes and powers."""
    gamma = mem.control[0].gamma
    for i in range(mem.new.size):
        mem.stages[stage, i] = (mem.new[i] - mem.base[i]) / gamma
    for i in range(mem.shared.size):
        mem.stage_shared[stage, i] = (bundle.shared[i] - mem.shared_base[i]) / gamma
    _put(mem.stage_rates, stage, mem.rates)


@helper
def _attempt(evaluate, jacobian, h, bundle, bl, fa, mem):
    """Try a step; see stepping.take_steps."""
    for stage in range(1, STAGES):
        _prepare(mem, stage, h)
        t = mem.control[0].time + NODES[stage] * h
        outcome = solve_step(evaluate, jacobian, t, h, 0, bundle, bl, fa, mem)
        if outcome != Status.OK:
            return outcome, 0.0, _ORDER
        _keep(bundle, mem, stage)
    for i in range(mem.change.size):
        total = 0.0
        for j in range(STAGES):
            total += ERROR[j] * mem.stages[j, i]
        mem.change[i] = h * total
    error = norm(mem.change, mem.weight)
    return outcome, max(error, leak_of_stages(mem, h)), _ORDER


@helper
def _interpolate(mem, t, h, at, row):
    """Write the state at `at`.

    The time lies in (t - h, t]; places and slopes at the ends of this step and the last one are used.

    Newton's form with double nodes (Hermite), of order 5 where there is a last step, 3 in the first.
    """
    h1, known = mem.control[0].last_step, mem.count[0].history > 0
    out, stages = mem.sample_y[row], mem.stages
    x = at - t
    for i in range(out.size):
        end, begin = stages[STAGES - 1, i], stages[0, i]
        d = (mem.new[i] - mem.y[i]) / h
        e, s = (end - d) / h, (d - begin) / h  # [t, t, b], [t, b, b] with b = t - h
        third = (e - s) / h  # [t, t, b, b]
        out[i] = mem.new[i] + x * (end + x * (e + (x + h) * third))
        if known:
            d1 = (mem.y[i] - mem.y1[i]) / h1
            e1 = (begin - d1) / h1  # [b, b, a] with a = b - h1
            s1 = (d1 - stages[_START, i]) / h1  # [b, a, a]
            f1 = (s - e1) / (h + h1)  # [t, b, b, a]
            g1 = (e1 - s1) / h1  # [b, b, a, a]
            fourth = (third - f1) / (h + h1)  # [t, t, b, b, a]
            other = (f1 - g1) / (h + h1)  # [t, b, b, a, a]
            fifth = (fourth - other) / (h + h1)
            out[i] += x * x * (x + h) * (x + h) * (fourth + (x + h + h1) * fifth)


@helper
def _shift(bundle, mem, h):
    """Make the new point current.

    The integrals change with it.
    """
    stages, last = mem.stages, STAGES - 1
    add_turn_over(mem, h)
    for j in range(STAGES):
        weight = h * WEIGHTS[j]
        for i in range(mem.integrals.size):
            mem.integrals[i] += weight * mem.stage_rates[j, i]
    settle_prescribed(bundle, mem, h)
    _put(mem.stage_rates, 0, mem.stage_rates[last])
    for i in range(mem.shared.size):
        mem.shared[i], mem.stage_shared[0, i] = bundle.shared[i], mem.stage_shared[last, i]
    for i in range(mem.y.size):
        mem.y1[i], mem.y[i] = mem.y[i], mem.new[i]
        stages[_START, i], stages[_LATE, i], stages[0, i] = stages[0, i], stages[_LATER, i], stages[last, i]


def advance(evaluate, jacobian, until, max_work, bundle, bl, fa, mem):
    """Take steps; see stepping.take_steps."""
    return take_steps(_begin, _attempt, _interpolate, _shift, evaluate, jacobian, until, max_work, bundle, bl, fa, mem)
