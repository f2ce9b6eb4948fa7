"""Find equilibria in thick oil from those in thinner oil.

In oil far below its range friction has steep plateaus, and whether the continuation finds a way between them is a
matter of luck: 5 K on it does. So the way leads through temperatures (natural-parameter continuation: Allgower and
Georg 1990, Numerical Continuation Methods, 1.1), in steps that are halved where one fails.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.errors import SolverError
from lambda_core.domain.time_limit import is_late
from lambda_core.solver.drivers.compiled_laws import derive_oils
from lambda_core.solver.drivers.solver_context import SolverContext, assemble

StaticReport = NDArray[np.void]  # a STATIC_REPORT record
_WARMER = (5.0, 10.0, 20.0, 40.0)  # where the way may begin [K]
_TRIES = 12  # steps on the way, those that fail included
_FAILURES = 12  # in all, each of which takes a second or two of two rows of balls
# Solves for the equilibrium from a state, in place, and returns its report.
Solve = Callable[[SolverContext, FloatArray], StaticReport]


def by_viscosity_continuation(
    context: SolverContext, start: FloatArray, solve: Solve
) -> tuple[FloatArray, StaticReport] | None:
    """Return the equilibrium by way of warmer oil.

    Also return its report. The result is None where no way leads there.

    Parameters
    ----------
    start : float64[:], shape (size,)
        State without friction.
    solve : callable
        Raises SolverError where it finds none.
    """
    failed = 0
    for warmer in _WARMER:
        state, left, step = start.copy(), warmer, warmer
        try:
            solve(_thinner(context, warmer), state)
        except SolverError:
            failed += 1
            if is_late():
                raise
            if failed >= _FAILURES:
                return None
            continue
        for _ in range(_TRIES):
            trial, goal = state.copy(), max(left - step, 0.0)
            try:
                report = solve(_thinner(context, goal), trial)
            except SolverError:
                failed += 1
                if is_late():
                    raise
                if failed >= _FAILURES:
                    return None
                step *= 0.5
                continue
            if goal == 0.0:
                return trial, report
            state, left, step = trial, goal, 2.0 * step
    return None


def _thinner(context: SolverContext, by: float) -> SolverContext:
    """Return the context with warmer oil [K].

    Searches note in the same place which balls the cage drives.
    """
    oil = context.model.oil
    model = dataclasses.replace(context.model, oil=dataclasses.replace(oil, temperature=oil.temperature + by))
    found = assemble(model, context.kernels, context.frame, derive_oils(model, context.kernels, context.frame))
    found.driven = context.driven
    return found
