"""Show responses of a study over its parameters."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from lambda_core.plugins import (
    Axis,
    Column,
    Field,
    FloatArray,
    Mark,
    NotApplicable,
    Panel,
    Series,
    StudyTable,
    View,
    ViewData,
)
from lambda_core.studies.effects import Sensitivity, sensitivities
from lambda_plugins.views.friction import PER_RING, REST
from lambda_plugins.views.study_curves import study_curves
from lambda_plugins.views.study_table import (
    BREAKDOWN,
    STEADINESS,
    Along,
    Curves,
    Surface,
    Threshold,
    Which,
    axis_of,
    numeric_parameters,
    responses,
    rows_by_label,
    source_line,
    varied,
)

_MECHANISMS = (*PER_RING, *REST)


def _surface(
    table: StudyTable, options: Surface, response: Column
) -> tuple[Column, Column, FloatArray, FloatArray, FloatArray]:
    """Return the mesh of one response.

    The mesh is over its two parameters.

    A crossed study fills the mesh as it is; points scattered over these two parameters are interpolated linearly
    between neighbours. Where a third parameter varies there is no map: neighbours would differ for a reason that it
    does not show.
    """
    numeric = numeric_parameters(table)
    x = table.parameter(options.x) if options.x else (numeric[0] if numeric else None)
    y = table.parameter(options.y) if options.y else next((c for c in numeric if x is None or c.name != x.name), None)
    if x is None or y is None:
        raise NotApplicable("a map needs two numeric parameters that vary")
    px, py, values = x.numbers(), y.numbers(), response.numbers()
    extra = [c.label for c in varied(table) if c.name not in (x.name, y.name)]
    if extra:
        raise NotApplicable(
            f"a map shows two parameters, and {', '.join(extra)} varies too: what differs would not be due to the two; "
            "cross two parameters with the others fixed, or look at study-curves"
        )
    gx, gy = np.unique(px), np.unique(py)
    if gx.size * gy.size == len(table):
        mesh = np.full((gx.size, gy.size), np.nan)
        mesh[np.searchsorted(gx, px), np.searchsorted(gy, py)] = values
        return x, y, *np.meshgrid(gx, gy, indexing="ij"), mesh
    return x, y, *_interpolated(px, py, values)


def _interpolated(px: FloatArray, py: FloatArray, values: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
    from scipy.interpolate import griddata
    from scipy.spatial import QhullError

    known = np.isfinite(values)
    if known.sum() < 4:
        raise NotApplicable("too few points have a result for a map")
    gx, gy = np.linspace(px.min(), px.max(), 61), np.linspace(py.min(), py.max(), 61)
    mesh_x, mesh_y = np.meshgrid(gx, gy, indexing="ij")
    try:
        mesh = griddata((px[known], py[known]), values[known], (mesh_x, mesh_y), rescale=True)
    except QhullError:
        raise NotApplicable("the points lie on a line: a map needs two parameters that vary by themselves") from None
    return mesh_x, mesh_y, mesh


def study_map(table: StudyTable, options: Surface) -> ViewData:
    """Show responses as a surface over two parameters."""
    panels = []
    for response in responses(table, options.response):
        x, y, mesh_x, mesh_y, mesh = _surface(table, options, response)
        finite = mesh[np.isfinite(mesh)]
        if finite.size < 4 or np.ptp(finite) == 0.0:
            continue
        levels = _levels(float(finite.min()), float(finite.max()))
        field = Field(response.label, response.unit, mesh_x, mesh_y, mesh, levels=levels)
        panels.append(Panel("", axis_of(x), axis_of(y), _failed(table, x, y), (), field))
    if not panels:
        raise NotApplicable("no response varies over the points that have a result")
    notes = ("crosses: points without a result",) if any(panel.series for panel in panels) else ()
    if table.design != "crossed":
        notes = (*notes, f"interpolated linearly between {len(table)} scattered points")
    return ViewData("study-map", "Responses over two parameters", source_line(table), tuple(panels), 2, notes)


def _failed(table: StudyTable, x: Column, y: Column) -> tuple[Series, ...]:
    rows = [row for row, state in enumerate(table.states) if state == "failed"]
    if not rows:
        return ()
    return (Series("failed", x.numbers()[rows], y.numbers()[rows], "points", "reference"),)


def _levels(low: float, high: float) -> tuple[float, ...]:
    """Return round values between two ends for contour lines."""
    rough = (high - low) / 7.0
    power = 10.0 ** np.floor(np.log10(rough))
    step = min((m * power for m in (1.0, 2.0, 2.5, 5.0, 10.0)), key=lambda s: abs(s - rough))
    return tuple(float(value) for value in np.arange(np.ceil(low / step), np.floor(high / step) + 1.0) * step)


def friction_stack(table: StudyTable, options: Along) -> ViewData:
    """Show stacked friction torque by mechanism over one parameter."""
    parts = [c for c in table.responses if c.name.startswith(BREAKDOWN) and np.isfinite(c.numbers()).any()]
    if not parts:
        raise NotApplicable('the study has no responses "friction_breakdown_Nmm": ask for them')
    numeric = numeric_parameters(table)
    if not numeric:
        raise NotApplicable("no numeric parameter varies in this study")
    x = table.parameter(options.x) if options.x else numeric[0]
    groups = rows_by_label(table, x)
    if len(groups) > 0.5 * len(table):
        raise NotApplicable("the points are scattered: a stack needs values along one parameter")
    panels = []
    shown = list(groups.items())
    left_out = sum(not _has_result(parts, row) for row in range(len(table)))
    for label, group in shown if len(shown) <= 4 else [shown[0], shown[len(shown) // 2], shown[-1]]:
        rows = [row for row in group if _has_result(parts, row)]
        if len(rows) < 2:
            continue
        places = x.numbers()[rows]
        order = np.argsort(places)
        merged: dict[str, FloatArray] = {}
        for part in parts:
            name = part.name.removeprefix(BREAKDOWN).removesuffix("_inner").removesuffix("_outer")
            values = np.nan_to_num(part.numbers()[rows][order])
            merged[name] = merged.get(name, 0.0) + values
        total = sum(merged.values())
        series = tuple(
            Series(name, places[order], values, "area", group=_MECHANISMS.index(name))
            for name, values in merged.items()
            if values.max() > 1e-3 * np.max(total)
        )
        panels.append(
            Panel(
                label or "friction torque",
                axis_of(x),
                Axis("friction torque", parts[0].unit, low=0.0),
                series,
                stacked=True,
            )
        )
    if not panels:
        raise NotApplicable("fewer than two points along the parameter have a result")
    notes = (f"{left_out} points without a result are left out",) if left_out else ()
    return ViewData("friction-stack", "Friction torque by mechanism", source_line(table), _levelled(panels), 2, notes)


def _has_result(parts: list[Column], row: int) -> bool:
    return any(part.values[row] is not None for part in parts)


def _levelled(panels: list[Panel]) -> tuple[Panel, ...]:
    """Give stacked panels one height.

    A reader can then compare them.
    """
    top = 1.05 * max(float(np.sum([s.y for s in panel.series], axis=0).max()) for panel in panels)
    return tuple(replace(panel, y=replace(panel.y, high=top)) for panel in panels)


def sensitivity(table: StudyTable, options: Which) -> ViewData:
    """Show the influence of each parameter on each response."""
    panels = []
    for response in responses(table, options.response):
        found = sensitivities(table, response.name)
        panels.append(_tornado(response, found))
    notes = (_EXPLAINED[found.kind], *found.notes)
    return ViewData("sensitivity", "Sensitivities", source_line(table), tuple(panels), 2, notes)


_EXPLAINED = {
    "sobol": "Sobol' indices: share of the response's variance that a parameter brings alone (first order) and with "
    "all its interactions (total)",
    "regression": "standardised regression: change of the response, in its standard deviations, by one standard "
    "deviation of the parameter; rank: Spearman's correlation",
}


def _tornado(response: Column, found: Sensitivity) -> Panel:
    places = np.arange(len(found.parameters), dtype=float)
    first, second = found.names
    series = (
        Series(first, places, np.array(found.first), "bars", "inner"),
        Series(second, places, np.array(found.second), "bars", "outer"),
    )
    title = response.label + (f"\nlinear part {100.0 * found.fit:.3g} %" if found.fit is not None else "")
    return Panel(title, Axis("", categories=found.labels), Axis("sensitivity"), series, (Mark("", 0.0),))


def stability_map(table: StudyTable, options: Threshold) -> ViewData:
    """Show the region where a measure of unsteadiness is small.

    Below a limit, over two parameters.
    """
    if options.response == STEADINESS and STEADINESS not in table.units():
        raise NotApplicable(f'the study has no response "{options.response}": choose another with response=NAME')
    response = table.response(options.response)
    x, y, mesh_x, mesh_y, mesh = _surface(table, options, response)
    if not np.isfinite(mesh).any():
        raise NotApplicable("no point of this study has a result yet")
    px, py, values = x.numbers(), y.numbers(), response.numbers()
    series = (
        *_judged("stable", px, py, values <= options.limit, "inner"),
        *_judged("unstable", px, py, values > options.limit, "outer"),
        *_failed(table, x, y),
    )
    field = Field(
        response.label,
        response.unit,
        mesh_x,
        mesh_y,
        mesh,
        mesh - options.limit,
        f"limit {options.limit:g} {response.unit}".rstrip(),
    )
    panel = Panel("", axis_of(x), axis_of(y), series, (), field)
    return ViewData(
        "stability-map",
        "Stability",
        source_line(table),
        (panel,),
        1,
        (f"stable: {response.label} <= {options.limit:g}",),
    )


def _judged(name: str, x: FloatArray, y: FloatArray, chosen: NDArray[np.bool_], role: str) -> tuple[Series, ...]:
    return (Series(name, x[chosen], y[chosen], "points", role),) if chosen.any() else ()


VIEWS = (
    View("study-curves", "responses over one parameter", "study", study_curves, Curves, view_api=1),
    View("study-map", "responses as surfaces over two parameters", "study", study_map, Surface, view_api=1),
    View(
        "friction-stack",
        "friction by mechanism, stacked over one parameter",
        "study",
        friction_stack,
        Along,
        view_api=1,
    ),
    View("sensitivity", "how much each parameter decides each response", "study", sensitivity, Which, view_api=1),
    View(
        "stability-map",
        "where a measure of unsteadiness stays below a limit",
        "study",
        stability_map,
        Threshold,
        view_api=1,
    ),
)
