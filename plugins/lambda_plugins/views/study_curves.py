"""Draw responses of a study over one parameter.

Methods that answer the same question share their axes.
"""

from __future__ import annotations

from typing import Literal

import numpy as np

from lambda_core.plugins import Axis, Column, NotApplicable, Panel, Series, StudyTable, ViewData
from lambda_plugins.views.study_table import (
    Curves,
    axis_of,
    numeric_parameters,
    positions,
    responses,
    rows_by_label,
    source_line,
    varied,
)

_CURVES = 9  # curves in a panel
_ROUNDING = 1e-3  # smallest range of an axis, over the largest value
# The response of a comparison method to each response of the solver.
_SAME: dict[str, str] = {"friction/total": "friction_torque_Nmm"}


def study_curves(table: StudyTable, options: Curves) -> ViewData:
    """Show every response over one parameter.

    It has a curve for each combination of the others.
    """
    candidates = [*numeric_parameters(table), *varied(table)]
    if not candidates:
        raise NotApplicable("no parameter varies in this study")
    x = table.parameter(options.x) if options.x else candidates[0]
    groups = rows_by_label(table, x)
    sampled = len(groups) > 0.5 * len(table)
    if not sampled and len(groups) > _CURVES:
        step = (len(groups) - 1) / (_CURVES - 1)
        kept = {round(index * step) for index in range(_CURVES)}
        groups = {label: rows for index, (label, rows) in enumerate(groups.items()) if index in kept}
    panels, compared = [], False
    for alike in _by_question(responses(table, options.response)):
        several = len(alike) > 1
        compared = compared or several
        series: list[Series] = []
        for column in alike:
            who = _who(column, table) if several else ""
            if sampled:
                series.append(Series(who or "points", positions(x), column.numbers(), "points", unlisted=not who))
            else:
                series += (
                    _curve(x, column, rows, ", ".join(filter(None, (who, label)))) for label, rows in groups.items()
                )
        panels.append(Panel("", axis_of(x), Axis(_label(alike[0]), alike[0].unit, least=_least(alike)), tuple(series)))
    notes = [f"all other parameters vary too: {', '.join(_others(table, x))}"] if sampled and _others(table, x) else []
    if compared and table.mode == "quasi-static":
        notes.append("the quasi-static solution has no cage")
    if any(one.low is not None for panel in panels for one in panel.series):
        notes.append("shaded: 90 % model band")
    return ViewData("study-curves", "Responses over a parameter", source_line(table), tuple(panels), 2, tuple(notes))


def _least(columns: list[Column]) -> float:
    """Return the range of rounding.

    Values whose difference is smaller count as equal.
    """
    sizes = [np.abs(column.numbers()[np.isfinite(column.numbers())]) for column in columns]
    return _ROUNDING * max((float(size.max()) for size in sizes if size.size), default=0.0)


def _by_question(columns: list[Column]) -> list[list[Column]]:
    """Return the responses in groups.

    A group answers one question in one unit.
    """
    found: dict[tuple[str, str], list[Column]] = {}
    for column in columns:
        row = column.name.partition("/")[2]
        found.setdefault((_SAME.get(row, row or column.name), column.unit), []).append(column)
    return list(found.values())


def _who(column: Column, table: StudyTable) -> str:
    method = column.name.partition("/")[0]
    own = "simulation" if table.mode == "dynamic" else "quasi-static"
    return own if method == column.name else {"skf": "SKF", "schaeffler": "Schaeffler"}.get(method, method)


def _label(column: Column) -> str:
    return column.label.rpartition("/")[2] if column.label == column.name else column.label


def _others(table: StudyTable, x: Column) -> list[str]:
    return [column.label for column in varied(table) if column.name != x.name]


def _curve(x: Column, response: Column, rows: list[int], label: str) -> Series:
    places, values = positions(x)[rows], response.numbers()[rows]
    order = np.argsort(places)
    style: Literal["line", "points"] = "line" if x.numeric else "points"
    low, high = response.ends()[rows][order].T if response.band else (None, None)
    band = "90 % model band" if response.band else ""
    return Series(label or response.label, places[order], values[order], style, "", low, high, band, unlisted=not label)
