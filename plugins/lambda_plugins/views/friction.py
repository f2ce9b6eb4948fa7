"""Draw the parts and the convergence of the friction torque."""

from __future__ import annotations

import math

import numpy as np

from lambda_core.domain.channels import LOSSES
from lambda_core.plugins import Axis, FloatArray, Mark, NotApplicable, Options, Panel, RunData, Series, View, ViewData
from lambda_core.results.averages import COLUMNS, torque_by_revolution
from lambda_plugins.views.common import averaging, source

PER_RING = ("sliding", "spin", "rolling", "hysteresis", "boundary", "damping")
REST = ("cage", "drag", "bending")
_LOSS = [COLUMNS.index(f"loss.{name}") for name in LOSSES]
_ANGLE, _TIME = COLUMNS.index("relative_angle"), COLUMNS.index("time")


def friction_breakdown(run: RunData, options: Options) -> ViewData:
    """Show the friction torque by mechanism and ring.

    It is the mean of the averaging window.
    """
    summary = run.summary()
    parts = summary.friction_breakdown_Nmm
    total = summary.friction_torque_Nmm
    if total is None:
        raise NotApplicable("the rings do not turn against each other: there is no friction torque")
    neighbour, what = "cage", "cage: pockets and lands (neighbours against each other without cage)"
    if summary.full_complement:
        neighbour, what = "neighbours", "neighbours: rollers against each other"
    places = np.arange(len(PER_RING) + len(REST), dtype=float)
    series = []
    for ring in ("inner", "outer"):
        values = np.full(places.size, np.nan)
        values[: len(PER_RING)] = [parts[f"{name}_{ring}"] or 0.0 for name in PER_RING]
        series.append(Series(f"{ring} ring", places, values, "bars", ring))
    rest = np.full(places.size, np.nan)
    rest[len(PER_RING) :] = [parts[name] or 0.0 for name in REST]
    series.append(Series("elsewhere", places, rest, "bars", "cage"))
    panel = Panel(
        f"total {total:.4g} N mm",
        Axis("", categories=(*PER_RING, neighbour, *REST[1:])),
        Axis("friction torque", "N mm", low=0.0),
        tuple(series),
        stacked=True,
    )
    notes = (
        f"dissipated power over |Omega_i - Omega_o|, mean over {averaging(run).words}",
        f"{what}; drag: fluid on the elements",
    )
    return ViewData("friction-breakdown", "Friction torque by mechanism", source(run), (panel,), 1, notes)


def _over_records(rows: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return middle times and friction torque between records.

    They are in ms and N mm.
    """
    growth = np.diff(rows, axis=0)
    with np.errstate(divide="ignore", invalid="ignore"):
        torque = 1e3 * growth[:, _LOSS].sum(axis=1) / growth[:, _ANGLE]
    return 1e3 * 0.5 * (rows[1:, _TIME] + rows[:-1, _TIME]), torque


def convergence(run: RunData, options: Options) -> ViewData:
    """Show the friction torque over time and its mean.

    It shows the means of whole cage revolutions, and the confidence of their mean.
    """
    summary = run.summary()
    records, turns = run.integrals(), run.revolutions()
    if records.shape[0] < 2 or summary.friction_torque_Nmm is None:
        raise NotApplicable("no friction torque is recorded yet")
    time, torque = _over_records(records)
    mean = summary.friction_torque_Nmm
    half = summary.friction_torque_ci_Nmm if summary.friction_torque_ci_Nmm is not None else math.nan
    series = [Series("between two records", time, torque, "line", "reference")]
    if turns.shape[0] > 1:
        middle = 0.5e3 * (turns[1:, _TIME] + turns[:-1, _TIME])
        series.append(Series("one cage revolution", middle, 1e3 * torque_by_revolution(turns), "points", "inner"))
    span = averaging(run)
    ends = np.array([1e3 * span.start, float(time[-1])])
    found = f"{mean:.5g} N mm" + (f" ± {half:.2g}" if math.isfinite(half) else "")
    low, high = np.full(2, mean - half), np.full(2, mean + half)
    series.append(Series(f"mean {found}", ends, np.full(2, mean), "line", "total", low, high, "95 % confidence"))
    marks = (Mark("averaged from here", 1e3 * span.start, "x"),) if span.start > 0.0 else ()
    panel = Panel(
        "converged" if summary.converged else "not converged",
        Axis("time", "ms"),
        Axis("friction torque", "N mm"),
        tuple(series),
        marks,
    )
    notes = tuple(summary.reasons) or (f"mean over {span.words}",)
    return ViewData("convergence", "Convergence of the friction torque", source(run), (panel,), 1, notes)


VIEWS = (
    View("friction-breakdown", "friction torque by mechanism and ring", "result", friction_breakdown, view_api=1),
    View("convergence", "friction torque over time with the confidence of its mean", "result", convergence, view_api=1),
)
