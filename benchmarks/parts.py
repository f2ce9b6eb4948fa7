"""Measure the parts of an evaluation and of a run.

It varies the grid of an evaluation, and splits the wall time of a simulated second.
"""

from __future__ import annotations

import math
import tempfile
from pathlib import Path

import numpy as np

from benchmarks.cases import MIDDLE
from benchmarks.handle import Handle
from benchmarks.passage import Horizon, passage, wall
from benchmarks.tables import Cell, Section, Table
from benchmarks.timing import Effort, per_call
from lambda_core import api
from lambda_core.domain.arrays import FloatArray
from lambda_core.model.bearing_model import BearingModel
from lambda_core.runs.record_times import RECORDS_PER_REVOLUTION
from lambda_core.solver.drivers.dynamics import BearingEngine
from lambda_core.solver.drivers.engine import SAMPLES_PER_REVOLUTION
from lambda_core.solver.drivers.equilibrium import Equilibrium, solve

GRIDS = ((1, 15), (1, 31), (11, 21), (21, 41))  # rows, strips
DEFAULT_GRID = (1, 31)
_GAMMA = 3e-5  # [s] of a typical step
Row = tuple[Cell, ...]
_STATES = 8  # along the way, at which the parts are timed


def trajectory(model: BearingModel, start: Equilibrium, count: int) -> tuple[FloatArray, FloatArray]:
    """Return `count` points of a cage revolution.

    Times (count,) [s], states (count, size).
    """
    engine = BearingEngine(model, equilibrium=start)
    turn = _turn(start)
    times, states = [], []
    for k in range(count):
        engine.advance(turn * (k + 1) / count)
        times.append(engine.time)
        states.append(engine.state()["memory.y"])
    return np.array(times), np.array(states)


def unit_costs(handle: Handle, times: FloatArray, states: FloatArray) -> dict[str, float]:
    """Return the mean time of each part [s].

    It is compiled, over states of a trajectory.
    """
    found: dict[str, list[float]] = {"rhs": [], "jacobian": [], "factor": [], "solve": []}
    for t, y in zip(times, states, strict=True):
        handle.settle_at(float(t), y, _GAMMA)
        found["rhs"].append(per_call(lambda n, t=t: handle.repeat_slope(n, t)))  # type: ignore[misc]
        found["jacobian"].append(per_call(lambda n, t=t: handle.repeat_jacobian(n, t)))  # type: ignore[misc]
        found["factor"].append(per_call(lambda n: handle.repeat_factor(n, _GAMMA)))
        found["solve"].append(per_call(handle.repeat_solve))
    return {name: float(np.mean(values)) for name, values in found.items()}


def measure(effort: Effort) -> Section:
    """Time the parts of a step.

    And their sum.
    """
    rows: list[Row] = []
    costs: dict[str, float] = {}
    for number_of_rows, strips in GRIDS:
        model = api.check(MIDDLE.case, (f"depth.strips={strips}", f"depth.rows={number_of_rows}"))
        start = solve(model)
        times, states = trajectory(model, start, effort.pick(2, _STATES))
        handle = Handle(start.context)
        cost = unit_costs(handle, times, states)
        if (number_of_rows, strips) == DEFAULT_GRID:
            costs = cost
        contacts = _contacts(start)
        rows.append((f"{number_of_rows}x{strips}", contacts, *(1e6 * value for value in cost.values())))
    table = Table(
        f"One evaluation, {MIDDLE.name}",
        ("grid", "contacts under load", "right-hand side us", "Jacobian us", "factorisation us", "solve us"),
        tuple(rows),
        ("Compiled loops at states of one cage revolution, without calls from Python.",),
    )
    return Section("parts", (table, _profile(effort, costs)))


def _contacts(start: Equilibrium) -> int:
    """Return how many ball - raceway contacts carry load."""
    return int(np.sum(start.contacts[:, :, 0] > 0.0))


def _profile(effort: Effort, costs: dict[str, float]) -> Table:
    """Split the time of a simulated second into its parts."""
    model = MIDDLE.model()
    start = solve(model)
    horizon = Horizon(0.0, effort.pick(1, 3))
    plain, sampled = [], []
    for _ in range(effort.repeats):
        plain.append(passage(model, start, horizon, samples=False))
        sampled.append(passage(model, start, horizon))
    one = plain[0]
    compiled, total = wall(plain) / one.simulated, wall(sampled) / one.simulated
    counts = {key: value / one.simulated for key, value in one.statistics.items()}
    parts = {
        "right-hand sides": (counts["rhs_calls"], costs["rhs"]),
        "Jacobians": (counts["jacobians"], costs["jacobian"]),
        "factorisations": (counts["factorisations"], costs["factor"]),
        "solves": (counts["newton_iterations"], costs["solve"]),
    }
    known = sum(count * cost for count, cost in parts.values())
    rows: list[Row] = [(name, count, 1e6 * cost, count * cost) for name, (count, cost) in parts.items()]
    rows.append(("step control, norms, copies", counts["steps"], None, compiled - known))
    rows.append(("samples turned into channels", SAMPLES_PER_REVOLUTION / _turn(start), None, total - compiled))
    rows.append(("integration", None, None, total))
    rows += _around(model, start, effort, one.simulated, total, compiled / counts["steps"])
    return Table(
        f"Where a simulated second goes, {MIDDLE.name}",
        ("part", "per simulated s", "us each", "wall s/s"),
        tuple(rows),
        ("Counts of the integrator times the costs above; the rest is the difference to the measured wall time.",),
    )


def _turn(start: Equilibrium) -> float:
    """Return the time of one cage revolution [s]."""
    return 2.0 * math.pi / abs(start.orbit)


def _around(
    model: BearingModel, start: Equilibrium, effort: Effort, duration: float, total: float, step: float
) -> list[Row]:
    """Return the cost around the integration.

    A run adds it: `step` is the time of one step [s], which a call takes at least.
    """
    engine = BearingEngine(model, equilibrium=start)
    records = RECORDS_PER_REVOLUTION / _turn(start)
    record = per_call(lambda n: [engine.integrals() for _ in range(n)])
    call = max(per_call(lambda n: [engine.advance(math.nextafter(engine.time, 1.0)) for _ in range(n)]) - step, 0.0)
    timed = api.check(MIDDLE.case, (f"solver.duration={duration:.6g} s",))
    with tempfile.TemporaryDirectory() as folder:
        found = [api.run(timed, out=Path(folder) / f"{k}.h5").summary() for k in range(effort.repeats)]
    run = min(summary.wall_per_simulated_second or 0.0 for summary in found)
    left = run - total - records * (record + call)
    return [
        ("records: reading the running integrals", records, 1e6 * record, records * record),
        ("records: calls from Python into the integrator", records, 1e6 * call, records * call),
        ("result file, checkpoints, progress", None, None, left),
        ("complete run", None, None, run),
    ]
