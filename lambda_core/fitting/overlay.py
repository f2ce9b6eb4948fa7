"""Add measured series to pictures."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from lambda_core.analysis.band.quantities import CONDITIONS, Condition, Measured, Vocabulary, error_quantity
from lambda_core.domain.errors import UsageError
from lambda_core.domain.units import from_si, units_of
from lambda_core.domain.written_values import quantities
from lambda_core.fitting.measurements import Measurements, read_measurements
from lambda_core.model.settings.resolve_thermal import OWN_NODES
from lambda_core.views.chart import Axis, Panel, Series, ViewData

if TYPE_CHECKING:
    from lambda_core.results.reader import Result

_MOST = 200_000  # lines
_PLAIN = ("ratio", "-")  # quantity and unit of an axis without one
_WARM_UP = '"time [min],outer ring temperature [degC]"'
NORMAL = 1.959963984540054  # standard deviations of a normal distribution within which 95 % lie
BARS = "bars: 95 % of the error of measurement"


def pictures_of_case(result: Result, measured: str | Path, bearing: str | None = None) -> list[ViewData]:
    """Return pictures of a run's case over measured conditions.

    A run is one point: for a torque over speed it is the curve of its case, for temperatures over time their warm-up.
    Empty where the file holds neither.
    """
    from lambda_core.analysis.thermal.api import thermal_pictures, warm_up
    from lambda_core.case.case_io import toml_tables
    from lambda_core.studies.speed_curve import stribeck, stribeck_picture

    head, case = header_of(measured), toml_tables(result.case_toml, str(result.path))
    if "speed" in head and any(name in head for name in ("torque", "film parameter")):
        return [stribeck_picture(stribeck(case, bearing=bearing, band=True))]
    if "time" not in head or "temperature" not in head:
        return []
    nodes = [f"{node.replace('_', ' ')} temperature" for node in OWN_NODES if node != "ambient"]
    words = {name: Measured("", "temperature", "degC", is_signed=True) for name in nodes}
    data = read_measurements(measured, Vocabulary({"time": Condition("", "time", "time")}, words, _WARM_UP, _MOST))
    last = float(data.conditions["time"].max()) if "time" in data.conditions else 0.0
    if not last > 0.0:
        raise UsageError(f"{data.name}: the times of a warm-up begin at 0 and rise")
    return thermal_pictures(warm_up(case, last))


def header_of(measured: str | Path) -> str:
    """Return a file's first line that is no comment.

    It is in small letters, and empty where there is none.
    """
    path = Path(measured)
    if not path.is_file():
        return ""
    with path.open(encoding="utf-8", errors="replace") as file:
        return next((line.casefold() for line in file if line.strip() and not line.lstrip().startswith("#")), "")


def overlaid(pictures: Sequence[ViewData], measured: str | Path) -> list[ViewData]:
    """Add a measured series to pictures.

    Every picture that has axes for it gets it.
    """
    panels = [panel for picture in pictures for panel in picture.panels if isinstance(panel, Panel)]
    words = _vocabulary(panels)
    data = read_measurements(measured, words)
    found = []
    for picture in pictures:
        drawn = tuple(_drawn(panel, data) if isinstance(panel, Panel) else panel for panel in picture.panels)
        if any(new is not old for new, old in zip(drawn, picture.panels, strict=True)):
            found.append(replace(picture, panels=drawn, notes=(*picture.notes, f"measured: {data.name}")))
    if not found:
        over = " or ".join(f'"{name}"' for name in words.conditions)
        raise UsageError(f"{data.name}: no picture has {', '.join(data.measured)} over what is given: {over} is needed")
    return found


def _vocabulary(panels: Iterable[Panel]) -> Vocabulary:
    """Return the names of columns that panels have axes for."""
    conditions: dict[str, Condition] = {}
    measured: dict[str, Measured] = {}
    example = ""
    for panel in panels:
        x, y = _physical(panel.x), _physical(panel.y)
        if x is None or y is None:
            continue
        across, up = _across(panel), _up(panel)
        conditions |= {name: Condition("", x[0], error_quantity(x[0])) for name in across}
        for name in up:
            measured.setdefault(name, Measured("", *y, is_signed=True))
        example = example or f'"{across[0]} [{x[1]}],{next(iter(up))} [{y[1]}]"'
    for name in measured:
        conditions.pop(name, None)
    if not example:
        raise UsageError(
            "these pictures have no axes for a measured series: name a view with a value over time or speed"
        )
    return Vocabulary(conditions, measured, example, _MOST)


def _physical(axis: Axis) -> tuple[str, str] | None:
    """Return quantity and unit of an axis.

    None for one of names or of a unit that no file has.
    """
    if axis.categories or not axis.label:
        return None
    if not axis.unit:
        return _PLAIN
    known = sorted(one for one in quantities(f"1 {axis.unit}") if axis.unit in units_of(one))
    return (known[0], axis.unit) if known else None


def _across(panel: Panel) -> list[str]:
    """Return the names of the horizontal axis.

    They are its label and, for an option of a case, its name in a fit.
    """
    label = panel.x.label.casefold()
    return [*(name for name, one in CONDITIONS.items() if one.path == label), label]


def _up(panel: Panel) -> dict[str, str]:
    """Return the names of the vertical axis.

    Each name has the line that it belongs to.
    """
    label = panel.y.label.casefold()
    lines = {f"{one.name.casefold()} {label}": one.name for one in panel.series if one.name and not one.unlisted}
    return {label: "", **lines}


def _drawn(panel: Panel, data: Measurements) -> Panel:
    """Return a panel with its measured points."""
    x, y = _physical(panel.x), _physical(panel.y)
    if x is None or y is None:
        return panel
    at = next((data.conditions[name] for name in _across(panel) if name in data.conditions), None)
    if at is None:
        return panel
    places = np.array([from_si(float(one), *x) for one in at])
    more = []
    for name, line in _up(panel).items():
        values = data.measured.get(name)
        if values is None:
            continue
        known = np.isfinite(values)
        error = data.deviations(name)
        low, high = (None, None) if error is None else ((values + sign * NORMAL * error)[known] for sign in (-1.0, 1.0))
        words = f"{line}, measured" if line else f"measured, {data.name}"
        role = next((one.role for one in panel.series if one.name == line and one.role), "measured")
        band = BARS if error is not None else ""
        more.append(Series(words, places[known], values[known], "points", role, low, high, band))
    return replace(panel, series=(*panel.series, *more)) if more else panel
