"""Time quasi-static operating points as a study solves them."""

from __future__ import annotations

import statistics
from functools import partial

from benchmarks.cases import MIDDLE, Point
from benchmarks.tables import Section, Table, Target
from benchmarks.timing import Effort, best
from lambda_core.model.bearing_model import BearingModel
from lambda_core.results.quasistatic import QuasiStatic, quasistatic_of
from lambda_core.solver.drivers.compiled_laws import Kernels
from lambda_core.solver.drivers.equilibrium import solve
from lambda_core.studies.job import Task, work

LOADS = (4, 8, 16, 24)  # kN
SPEEDS = (500, 1500, 3000, 6000)  # 1/min


def measure(effort: Effort) -> Section:
    """Time every point of a map.

    Of load and speed, several times over.
    """
    model = MIDDLE.model()
    kernels = Kernels(model)
    points = [(load, speed) for load in LOADS for speed in SPEEDS]
    if effort.quick:
        points = points[:: len(SPEEDS) + 1]
    solving, total = [], []
    for load, speed in points:
        changes = (f"loads.radial={load} kN", f"operation.speed={speed} rpm")
        task = Task(0, model.case_toml, changes, "quasi-static", ("friction_torque_Nmm",), "")
        outcome = work(task)  # what the first point of a process loads is not a point's cost
        if outcome.state != "done":
            raise RuntimeError(f"{changes}: {outcome.reason}")
        point = Point("", MIDDLE.case, changes).model()
        solving.append(best(partial(_solve, point, kernels), effort.repeats))
        total.append(best(partial(work, task), effort.repeats))
    table = Table(
        "Quasi-static operating point with friction, 6319",
        ("part", "median ms", "slowest ms"),
        (
            ("equilibrium and its numbers", 1e3 * statistics.median(solving), 1e3 * max(solving)),
            ("the same with reading and resolving the case", 1e3 * statistics.median(total), 1e3 * max(total)),
        ),
        (f"{len(points)} points: {LOADS[0]} to {LOADS[-1]} kN radial, {SPEEDS[0]} to {SPEEDS[-1]} 1/min.",),
    )
    target = Target("quasi-static point with friction, after warm-up", "ms", 1e3 * statistics.median(solving), 20.0)
    return Section("operating-point", (table,), (target,))


def _solve(model: BearingModel, kernels: Kernels) -> QuasiStatic:
    return quasistatic_of(solve(model, kernels))
