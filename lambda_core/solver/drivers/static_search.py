"""Run the compiled search for an equilibrium in parts."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.time_limit import check_time
from lambda_core.solver.core import Core
from lambda_core.solver.drivers.solver_context import SolverContext
from lambda_core.solver.drivers.viscosity_continuation import StaticReport
from lambda_core.solver.records import STATIC_REPORT
from lambda_core.solver.status import Status

_ITERATIONS_PER_CALL, _FEWER_PER_CALL, _ALWAYS = 50, 25, 200  # some hundredths of a second; however late it is
BEGUN = 1e-9  # iterations of a search that has begun and has done none
# Last step without friction, over the states' scales, below which only balls that carry nothing still creep along their
# grooves, nanometres an iteration: friction, which holds them, can start from there. Each part of such a search moves
# them on as far again (Brezinski and Redivo Zaglia 1991, Extrapolation Methods): half the iterations reach the end.
CREEP = 1e-4
# With friction a search near a solution has found its motion when only one ball or two still creep: parts of it move
# the state in the same direction, by less than a step each. It is moved on by as much, then by twice and more.
_SLOW, _SAME_DIRECTION, _FARTHEST = 1e-3, 0.95, 8.0


class _Search:
    """Keep what one search hands from call to call."""

    def __init__(self, compiled: Core, context: SolverContext, state: FloatArray, held: NDArray[np.int64]) -> None:
        self.report = np.zeros(1, dtype=STATIC_REPORT)
        self._last, self._trust = np.zeros(state.size), np.ones(held.size)
        self._compiled, self._context, self._state, self._held = compiled, context, state, held

    def advance(self, iterations: int) -> int:
        """Do iterations, in place; return the status.

        The first call, of none, begins the search and decides which balls the cage drives.
        """
        compiled, context = self._compiled, self._context
        status: int = compiled.solve_static(
            compiled.evaluate_pointer, compiled.jacobian_pointer, context.bundle, context.blocks, context.factors,
            self._state, 1.0 / context.scale, self._last, self._trust, self._held, self.report, iterations,
        )  # fmt: skip
        return status


class _Creep:
    """Move a state on that creeps one way.

    Solutions are the same within the tolerance of the search.
    """

    def __init__(self, scale: FloatArray) -> None:
        self._scale, self._before, self._share = scale, np.zeros(scale.size), 1.0

    def follow(self, state: FloatArray, before: FloatArray, *, is_slow: bool) -> None:
        """Move on the state that a part moved."""
        moved = (state - before) / self._scale
        along = moved @ self._before
        if is_slow and along > _SAME_DIRECTION * np.linalg.norm(moved) * np.linalg.norm(self._before):
            state += self._share * moved * self._scale
            self._share = min(2.0 * self._share, _FARTHEST)
        else:
            self._share = 1.0
        self._before = moved


def driven_at(compiled: Core, context: SolverContext, state: FloatArray) -> NDArray[np.int64]:
    """Return the balls that the cage would drive.

    The search would begin at the state.
    """
    held = np.zeros_like(context.driven)
    _Search(compiled, context, state, held).advance(0)
    return held


def attempt(
    compiled: Core,
    context: SolverContext,
    state: FloatArray,
    most: int,
    step: float,
    driven: NDArray[np.int64] | None,
) -> tuple[int, StaticReport]:
    """Run the continuation from `state`, in place.

    It runs until it ends or has done its iterations; `step` is the first one in pseudo-time [s]. Which balls the cage
    drives is known near a solution.
    """
    search = _Search(compiled, context, state, context.driven)
    report, has_friction = search.report, bool(context.bundle.system[0]["friction_on"])
    creep = _Creep(context.scale) if has_friction and driven is not None else None
    status = search.advance(0)
    report["pseudo_step"], report["iterations"] = step, BEGUN
    if driven is not None:
        context.driven[:] = driven
    while status == Status.UNFINISHED and report["iterations"][0] < most:  # a signal is heard between two calls
        done = int(report["iterations"][0])
        if done > _ALWAYS:
            check_time(f"{context.model.name}: the search for the equilibrium")
        before = state.copy()
        part = _FEWER_PER_CALL if creep and done >= _ITERATIONS_PER_CALL else _ITERATIONS_PER_CALL
        status = search.advance(min(part, most - done))
        if status != Status.UNFINISHED:
            break
        if creep:
            creep.follow(state, before, is_slow=bool(report["last_change"][0] <= _SLOW))
        elif not has_friction and report["last_change"] <= CREEP:
            state += state - before
    return status, report
