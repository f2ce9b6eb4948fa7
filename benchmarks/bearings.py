"""Measure the cost over the number of bearings.

All bearings sit on one shaft.
"""

from __future__ import annotations

import numpy as np

from benchmarks.cases import MIDDLE
from benchmarks.handle import Handle
from benchmarks.parts import trajectory, unit_costs
from benchmarks.scaling import exponent
from benchmarks.shaft import on_a_shaft, together
from benchmarks.tables import Cell, Section, Table, Target
from benchmarks.timing import Effort
from lambda_core.solver.drivers.equilibrium import solve

BEARINGS = (1, 2, 3, 6)
BEARINGS_QUICK = (1, 6)
_STATES = 3  # along the way, at which the parts are timed
_PARTS = ("rhs", "jacobian", "factor", "solve")


def measure(effort: Effort) -> Section:
    """Time a step for different bearing counts.

    With one bearing and with more, all at the states of the single one.
    """
    start = solve(MIDDLE.model())
    times, states = trajectory(start.context.model, start, _STATES)
    counts = BEARINGS_QUICK if effort.quick else BEARINGS
    costs, shared = [], []
    for count in counts:
        context = on_a_shaft(start.context, [0.0] * count)
        same = np.array([together(start.context, [y] * count) for y in states])
        cost = unit_costs(Handle(context), times, same)
        costs.append([1e6 * cost[name] for name in _PARTS])
        shared.append(context.bundle.active.size)
    rows: list[tuple[Cell, ...]] = [
        (count, n, *cost, *(value / one / count for value, one in zip(cost, costs[0], strict=True)))
        for count, n, cost in zip(counts, shared, costs, strict=True)
    ]
    sizes = [float(count) for count in counts]
    powers = [exponent(sizes, [cost[k] for cost in costs]) for k in range(len(_PARTS))]
    rows.append(("exponent", None, *powers, None, None, None, None))
    names = ("right-hand side", "Jacobian", "factorisation", "solve")
    table = Table(
        f"Bearings on one shaft, {MIDDLE.name}",
        ("bearings", "shared states", *(f"{name} us" for name in names), *(f"{name} per bearing" for name in names)),
        tuple(rows),
        ("Equal bearings on one body, each in the state of the single one. Per bearing: over the cost of one alone.",),
    )
    totals = [sum(cost) for cost in costs]
    target = Target("cost of a Newton iteration over number of bearings, exponent", "-", exponent(sizes, totals), 1.1)
    return Section("bearings", (table,), (target,))
