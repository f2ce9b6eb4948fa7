"""Draw measured and predicted values and their residuals."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.units import UNITS, from_si
from lambda_core.views.chart import Axis, Mark, Panel, Series, ViewData

if TYPE_CHECKING:
    from lambda_core.fitting.report import FitReport, FittedPoint

_LIMIT = 2.0  # standardised residual between whose marks 95 % of the points lie
_DECADES = 100.0  # largest over smallest value, from which an axis is logarithmic
_UNITS = {"speed": "1/min", "radial load": "kN", "axial load": "kN"}


def fit_pictures(report: FitReport) -> list[ViewData]:
    """Return a picture of values and of residuals.

    Values have one panel per quantity, residuals one panel per condition.
    """
    quantities = list(dict.fromkeys(point.quantity for point in report.points))
    values = tuple(_values(report, quantity) for quantity in quantities)
    names = [name for name in report.points[0].conditions if _moves(report, name)]
    residuals = tuple(_residuals(report, name) for name in names)
    source = f"{report.title}, {report.file}"
    note = "bands: 95 % of the prediction, laws taken as exact; points: measured values"
    pictures = [ViewData("fit", "Measured and predicted values", source, values, 1, (note, report.sentence))]
    if residuals:
        note = "measured less predicted value over its standard deviation; a pattern means a wrong or missing law"
        pictures.append(ViewData("residuals", "Residuals of the fit", source, residuals, 1, (note,)))
    return pictures


def _values(report: FitReport, quantity: str) -> Panel:
    """Return measured and predicted values.

    They are plotted over the first condition that varies; each set of the others has a line.
    """
    points = [point for point in report.points if point.quantity == quantity]
    names = [name for name in points[0].conditions if _moves(report, name)]
    first = names[0] if names else ""
    axis = _axis(report, first) if first else Axis("point")
    x = _column(report, points, first) if first else np.arange(1.0, 1.0 + len(points))
    groups: dict[tuple[str, ...], list[int]] = {}
    for index, point in enumerate(points):
        key = tuple(_shown(report, name, point.conditions[name]) for name in names[1:] if "temperature" not in name)
        groups.setdefault(key, []).append(index)
    series: list[Series] = []
    for number, (key, rows) in enumerate(groups.items(), 1):
        order = sorted(rows, key=lambda row: float(x[row]))
        chosen = [points[row] for row in order]
        at, label = x[order], ", ".join(key) or quantity
        predicted = np.array([point.predicted for point in chosen])
        low, high = (np.array([point.band[end] for point in chosen]) for end in (0, 1))
        series.append(Series(label, at, predicted, "line", low=low, high=high, band="95 % band", group=number))
        measured = np.array([point.measured for point in chosen])
        series.append(Series(f"{label}, measured", at, measured, "points", group=number, unlisted=True))
    return Panel(quantity, axis, Axis(quantity, points[0].unit), tuple(series))


def _residuals(report: FitReport, name: str) -> Panel:
    x = _column(report, report.points, name)
    y = np.array([point.standardised_residual for point in report.points])
    marks = tuple(Mark("", value) for value in (-_LIMIT, _LIMIT))
    series = Series(name, x, y, "points", unlisted=True)
    return Panel("", _axis(report, name), Axis("residual", "standard deviations"), (series,), marks)


def _moves(report: FitReport, name: str) -> bool:
    return len({point.conditions[name] for point in report.points}) > 1


def _unit(name: str, quantity: str) -> str:
    return _UNITS.get(name, next(iter(UNITS[quantity])))


def _axis(report: FitReport, name: str) -> Axis:
    unit, column = _unit(name, report.condition_quantities[name]), _column(report, report.points, name)
    return Axis(name, unit, log=bool(column.min() > 0.0 and column.max() >= _DECADES * column.min()))


def _column(report: FitReport, points: list[FittedPoint], name: str) -> FloatArray:
    quantity = report.condition_quantities[name]
    unit = _unit(name, quantity)
    return np.array([from_si(point.conditions[name], quantity, unit) for point in points])


def _shown(report: FitReport, name: str, value: float) -> str:
    quantity = report.condition_quantities[name]
    unit = _unit(name, quantity)
    number = from_si(value, quantity, unit)
    return f"{name} {number:.4g} {unit}" if math.isfinite(number) else name
