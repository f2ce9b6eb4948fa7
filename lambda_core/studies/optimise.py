"""Search for the best point of a study under constraints.

A space-filling set of points first, on all workers; then COBYQA from the best of them (Ragonneau 2022, a
derivative-free trust-region method with bounds and constraints; scipy.optimize). Every evaluation is a point of the
study, so an interrupted search goes through the same points again without computing them.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from lambda_core.domain.arrays import FloatArray
from lambda_core.studies.definition import Goal
from lambda_core.views.table import StudyTable

Responses = Mapping[str, float | None]
_INSIDE = 2e-4  # of a limit's own size: how far inside it the search stays, so that its best point keeps the limit


@dataclass(frozen=True)
class Best:
    """The best point that a search has found.

    `row` counts from 0 in the study's table; None when no point keeps the constraints.
    """

    row: int | None
    value: float | None
    evaluations: int
    message: str


class _Enough(Exception):
    """The allowed number of evaluations is used up."""


def margins(goal: Goal, responses: Responses) -> list[float] | None:
    """Return the margins of a point.

    A margin to each limit is relative to the limit's size; it is None when a response is missing.
    """
    found = []
    for constraint in goal.constraints:
        value = responses.get(constraint.response)
        if value is None:
            return None
        if constraint.at_least is not None:
            found.append((value - constraint.at_least) / _size(constraint.at_least))
        if constraint.at_most is not None:
            found.append((constraint.at_most - value) / _size(constraint.at_most))
    return found


def _size(limit: float) -> float:
    return abs(limit) if limit else 1.0


def merit(goal: Goal, responses: Responses) -> float:
    """Return the value that orders points.

    The goal where all limits are kept, above everything else where not.
    """
    value, inside = responses.get(goal.response), margins(goal, responses)
    if value is None or inside is None:
        return math.inf
    short = -min([0.0, *inside])
    return goal.sign * value if short == 0.0 else 1e100 * (1.0 + short)


def search(
    goal: Goal, starts: FloatArray, found: Sequence[Responses], evaluate: Callable[[FloatArray], Responses]
) -> tuple[int, str]:
    """Search from the best of the first points.

    Return the number of evaluations and how it ended.

    Parameters
    ----------
    starts : float64[:, :], shape (points, parameters)
        Shares 0..1 of the ranges of the first points.
    found : sequence of mappings
        Their responses.
    evaluate : callable
        Responses at shares of the ranges, shape (parameters,).
    """
    from scipy.optimize import Bounds, NonlinearConstraint, minimize

    order = sorted(range(len(found)), key=lambda i: merit(goal, found[i]))
    best = order[0]
    value = found[best].get(goal.response)
    if value is None:
        return 0, "none of the first points has a result"
    scale = max(abs(value), 1e-300)
    known: dict[bytes, Responses] = {}
    count = 0

    def responses(x: FloatArray) -> Responses:
        nonlocal count
        x = np.clip(x, 0.0, 1.0)
        if x.tobytes() not in known:
            if count >= goal.evaluations:
                raise _Enough
            count += 1
            known[x.tobytes()] = evaluate(x)
        return known[x.tobytes()]

    def objective(x: FloatArray) -> float:
        answer = responses(x).get(goal.response)
        return goal.sign * answer / scale if answer is not None else 1e10

    def inside(x: FloatArray) -> FloatArray:
        answer = margins(goal, responses(x))
        return np.array(answer if answer is not None else np.full(_limits(goal), -1e10))

    limits = [NonlinearConstraint(inside, _INSIDE, np.inf)] if goal.constraints else []
    dimensions = starts.shape[1]
    try:
        end = minimize(
            objective,
            starts[best],
            method="COBYQA",
            bounds=Bounds(np.zeros(dimensions), np.ones(dimensions)),
            constraints=limits,
            options={"initial_tr_radius": 0.15, "final_tr_radius": goal.tolerance, "scale": False},
        )
    except _Enough:
        return count, f"the allowed {goal.evaluations} evaluations were used up"
    return count, str(end.message)


def _limits(goal: Goal) -> int:
    return sum((c.at_least is not None) + (c.at_most is not None) for c in goal.constraints)


def best_row(goal: Goal, table: StudyTable, message: str = "") -> Best:
    """Return the best point of a table.

    It keeps all constraints.
    """
    rows = table.rows()
    merits = [merit(goal, row) if table.states[i] in ("done", "partial") else math.inf for i, row in enumerate(rows)]
    place = int(np.argmin(merits)) if merits else 0
    if not merits or merits[place] >= 1e99:
        return Best(None, None, len(rows), message or "no point keeps the constraints")
    return Best(place, rows[place][goal.response], len(rows), message)
