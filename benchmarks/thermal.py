"""Time a warm-up; compare losses with ISO 15312."""

from __future__ import annotations

import math
import statistics
import time
from contextlib import closing
from typing import NamedTuple

from benchmarks.tables import Cell, Section, Table, Target
from benchmarks.timing import Effort
from lambda_core import api
from lambda_core.analysis.thermal import iso15312
from lambda_core.catalogue.protocol import BearingRow
from lambda_core.domain.channels import LOSSES
from lambda_core.domain.errors import LambdaError
from lambda_core.solver.drivers.equilibrium import solve
from lambda_core.studies.job import kernels_of

SERIES = ("60", "62", "63", "64", "618", "619")
OIL = "mineral-vg32"  # the standard's mineral oil, 12 mm2/s at 70 degC
HOUR = 3600.0


class Ratio(NamedTuple):
    """One bearing at its reference speed.

    The printed one, under the conditions of ISO 15312.
    """

    series: str
    without_drag: float  # loss over q_r A_r
    with_drag: float
    viscosity: float  # [m2/s]


def population(every: int = 1) -> tuple[list[Ratio], int]:
    """Return the ratios of SKF's bearings.

    With a printed reference speed, and how many had no answer.

    No answer: no equilibrium, or an inner geometry that the catalogue does not decide.
    """
    with closing(api.catalogue()) as catalogue:
        rows = [row for row in catalogue.bearings("SKF", 1000) if row.reference_speed and row.series in SERIES]
    found, failed = list[Ratio](), 0
    for row in rows[::every]:
        try:
            found.append(_ratio(row))
        except LambdaError:
            failed += 1
    return found, failed


def _ratio(row: BearingRow) -> Ratio:
    speed, rating = row.reference_speed, row.static_rating
    assert speed is not None
    assert rating is not None
    case = {
        "name": "reference",
        "bearing": {"designation": row.designation, "maker": row.maker},
        "lubricant": {"name": OIL, "temperature": "70 degC"},
        "loads": {"radial": f"{iso15312.LOAD_SHARE * rating.value!r} N"},
        "operation": {"speed": f"{speed.value!r} rad/s"},
        "depth": {"cage": False},
    }
    model = api.check(case)
    equilibrium = solve(model, kernels_of(model))
    losses = dict(zip(LOSSES, equilibrium.losses.tolist(), strict=True))
    total, g = sum(losses.values()), model.geometry
    area = iso15312.reference_area(g.bore_diameter, g.outside_diameter, g.width)
    emitted = iso15312.heat_flow_density(area) * area
    oil = equilibrium.context.oil
    return Ratio(row.series, (total - losses["drag"]) / emitted, total / emitted, oil.viscosity / oil.density)


def _spread(values: list[float]) -> tuple[Cell, ...]:
    """Return the median and the 5 and 95 % quantiles."""
    ordered = sorted(values)
    last = len(ordered) - 1
    low, high = (ordered[round(share * last)] for share in (0.05, 0.95))
    return statistics.median(ordered), low, high


def warm_up_seconds(repeats: int) -> tuple[float, int]:
    """Return a warm-up's wall time [s] and points.

    The best of an hour of the 6319, and how many points it solved.
    """
    api.warm_up("6319-cp10-1500", 1.0)  # what a process loads once is not the course's
    best, points = math.inf, 0
    for _ in range(repeats):
        started = time.perf_counter()
        points = api.warm_up("6319-cp10-1500", HOUR).points_solved
        best = min(best, time.perf_counter() - started)
    return best, points


def measure(effort: Effort) -> Section:
    """Time an hour of warm-up.

    Compare losses at printed reference speeds with the reference heat flow.
    """
    seconds, points = warm_up_seconds(effort.pick(1, 3))
    ratios, failed = population(effort.pick(8, 1))
    rows: list[tuple[Cell, ...]] = [
        (name, len(part), *_spread([r.without_drag for r in part]), statistics.median(r.with_drag for r in part))
        for name in ("all", *SERIES)
        if (part := [r for r in ratios if name in ("all", r.series)])
    ]
    table = Table(
        "Loss at printed reference speeds over q_r A_r of ISO 15312",
        ("series", "bearings", "median without drag", "5 %", "95 %", "median with drag"),
        tuple(rows),
        (
            f"SKF's bearings, quasi-static, 5 % of C0 radial, {OIL} at 70 degC "
            f"({1e6 * ratios[0].viscosity:.3g} mm2/s; the standard: 12); {failed} of undecided geometry left out.",
        ),
    )
    clock = Table("An hour of warm-up, 6319", ("what", "s"), ((f"{points} quasi-static points", seconds),))
    return Section("thermal", (clock, table), (Target("an hour of warm-up", "s", seconds, 15.0),))
