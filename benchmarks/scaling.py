"""Measure the cost over balls and contact cells."""

from __future__ import annotations

import numpy as np

from benchmarks.cases import MIDDLE, with_balls
from benchmarks.handle import Handle
from benchmarks.parts import GRIDS, trajectory, unit_costs
from benchmarks.passage import Horizon, passage, wall
from benchmarks.tables import Cell, Section, Table, Target
from benchmarks.timing import Effort
from lambda_core import api
from lambda_core.model.bearing_model import BearingModel
from lambda_core.solver.drivers.equilibrium import solve

BALLS = (7, 9, 12, 16, 20, 25)
BALLS_QUICK = (7, 25)
_STATES = 3


def exponent(sizes: list[float], costs: list[float]) -> float:
    """Return p of the least-squares fit cost ~ size^p."""
    return float(np.polyfit(np.log(sizes), np.log(costs), 1)[0])


def _cost(model: BearingModel, effort: Effort) -> tuple[dict[str, float], float, float]:
    """Return the costs of a step's parts [s].

    Also wall seconds and steps per simulated second.
    """
    start = solve(model)
    horizon = Horizon(0.0, 1.0)
    repeats = [passage(model, start, horizon) for _ in range(effort.repeats)]
    times, states = trajectory(model, start, _STATES)
    parts = unit_costs(Handle(start.context), times, states)
    one = repeats[0]
    return parts, wall(repeats) / one.simulated, one.statistics["steps"] / one.simulated


def measure(effort: Effort) -> Section:
    """Fit exponents over balls; compare grids."""
    counts = BALLS_QUICK if effort.quick else BALLS
    rows: list[tuple[Cell, ...]] = []
    columns: list[list[float]] = [[] for _ in range(6)]
    for count in counts:
        parts, per_second, steps = _cost(with_balls(count), effort)
        values = [1e6 * parts["rhs"], 1e6 * parts["jacobian"], 1e6 * (parts["factor"] + parts["solve"])]
        values += [steps, 1e6 * per_second / steps, per_second]
        for column, value in zip(columns, values, strict=True):
            column.append(value)
        rows.append((count, *values))
    sizes = [float(count) for count in counts]
    powers = [exponent(sizes, column) for column in columns]
    rows.append(("exponent", *powers))
    balls = Table(
        "Number of balls",
        ("balls", "right-hand side us", "Jacobian us", "factor + solve us", "steps/s", "wall us/step", "wall s/s"),
        tuple(rows),
        (
            f"The balls of the 6319 on a pitch diameter that grows with their number, load per ball and orbital speed "
            f"those of {MIDDLE.name}; one cage revolution. Exponents are least-squares fits.",
        ),
    )
    target = Target("cost of a simulated second over number of balls, exponent", "-", powers[-1], 1.1)
    return Section("scaling", (balls, _grids(effort)), (target,))


def _grids(effort: Effort) -> Table:
    """Compare the cost of a simulated second between grids."""
    rows: list[tuple[Cell, ...]] = []
    base = 0.0
    for number_of_rows, strips in GRIDS[1:3] if effort.quick else GRIDS:
        model = api.check(MIDDLE.case, (f"depth.strips={strips}", f"depth.rows={number_of_rows}"))
        start = solve(model)
        repeats = [passage(model, start, Horizon(0.0, 1.0)) for _ in range(effort.repeats)]
        one = repeats[0]
        seconds = wall(repeats) / one.simulated
        base = seconds if (number_of_rows, strips) == GRIDS[1] else base
        rows.append(
            (f"{number_of_rows}x{strips}", number_of_rows * strips, one.statistics["steps"] / one.simulated, seconds)
        )
    final = tuple((*row, seconds / base) for row in rows for seconds in (float(row[3] or 0.0),))
    return Table(f"Cells of a contact, {MIDDLE.name}", ("grid", "cells", "steps/s", "wall s/s", "times 1x31"), final)
