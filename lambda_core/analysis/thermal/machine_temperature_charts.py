"""Draw the temperatures of a machine."""

from __future__ import annotations

import numpy as np

from lambda_core.analysis.thermal.machine_temperature_report import MachineTemperatures, MachineTemperaturesOverTime
from lambda_core.analysis.thermal.machine_temperature_text import elements_in, ways
from lambda_core.analysis.thermal.temperature_lines import node_words
from lambda_core.views.chart import Axis, Mark, Panel, Series, ViewData

_ROLES = {"inner_ring": "inner", "outer_ring": "outer", "balls": "ball", "oil": "cage"}  # no cage is drawn
_SHOWN = ("inner_ring", "outer_ring", "balls", "oil")


def pictures(found: MachineTemperatures | MachineTemperaturesOverTime) -> list[ViewData]:
    """Return what there is to see: one picture."""
    return [along_shaft(found) if isinstance(found, MachineTemperatures) else over_time(found)]


def along_shaft(found: MachineTemperatures) -> ViewData:
    """Draw temperatures along the shaft.

    The picture also shows them by bearing, with losses and heat flows.
    """
    at, names = found.temperatures_degC, list(found.bearings)
    supports = tuple(Mark(name, found.bearings[name].position_mm, "x") for name in names)
    housing = (Mark("housing", at["housing"]),) if "housing" in at else ()
    flows = ways(found)
    heat = {name: value for name, value in found.heat_W.items() if value and not _is_bearing(name, names)}
    losses = {**{name: found.bearings[name].state.power_loss_W for name in names}, **heat}
    panels = (
        Panel(
            "along the shaft",
            Axis("position", "mm"),
            Axis("temperature", "degC", least=1.0),
            _along(found),
            (*supports, *housing),
        ),
        Panel("bearings", Axis("", categories=tuple(names)), Axis("temperature", "degC"), _nodes(found)),
        _bars("where the heat comes from", list(losses), list(losses.values())),
        _bars("where it goes", [f"{a} - {b}" for a, b, _ in flows], [value for _, _, value in flows]),
    )
    notes = (
        f"conductances: {found.conductances}; flows below 0.5 % of the loss are left out",
        f"gain of the torque-temperature loop {found.gain.loop:.2f}; energy residual {found.energy_residual:.1e}",
    )
    return ViewData("machine-temperatures", "Temperatures of a machine", _source(found), panels, 2, notes)


def _along(found: MachineTemperatures) -> tuple[Series, ...]:
    """Draw shaft temperatures as a line with points.

    The points are the parts of the bearings at their places.
    """
    shaft = Series(
        "shaft",
        np.array([place.position_mm for place in found.shaft]),
        np.array([place.temperature_degC for place in found.shaft]),
        "line",
        "total",
    )
    at = found.temperatures_degC
    parts = []
    for part in _SHOWN:
        known = [name for name in found.bearings if f"{name}.{part}" in at]
        x = np.array([found.bearings[name].position_mm for name in known])
        y = np.array([at[f"{name}.{part}"] for name in known])
        parts.append(Series(node_words(part, elements_in(found)), x, y, "points", _ROLES[part]))
    return (shaft, *(series for series in parts if series.x.size)) if found.shaft else tuple(parts)


def _nodes(found: MachineTemperatures) -> tuple[Series, ...]:
    names, at = list(found.bearings), found.temperatures_degC
    places = np.arange(len(names), dtype=float)
    return tuple(
        Series(
            node_words(part, elements_in(found)),
            places,
            np.array([at.get(f"{name}.{part}", np.nan) for name in names]),
            "bars",
            _ROLES[part],
            unlisted=True,
        )
        for part in _SHOWN
    )


def over_time(found: MachineTemperaturesOverTime) -> ViewData:
    """Draw temperatures and losses over time.

    The picture also shows clearances and films of all bearings.
    """
    minutes = np.array(found.time_s) / 60.0
    time = Axis("time", "min")
    at = found.temperatures_degC
    shown = [f"{name}.{part}" for name in found.bearings for part in ("inner_ring", "outer_ring", "oil")]
    lines = tuple(
        Series(node.replace("_", " "), minutes, np.array(at[node]), "line")
        for node in (*shown, "housing")
        if node in at
    )
    losses = {name: one.power_loss_W for name, one in found.bearings.items()}
    clearances = {name: one.clearance_um for name, one in found.bearings.items()}
    films = {
        name: [np.nan if value is None else value for value in one.film_um] for name, one in found.bearings.items()
    }
    panels = (
        Panel("temperatures", time, Axis("temperature", "degC", least=1.0), lines),
        Panel("power loss", time, Axis("power loss", "W", low=0.0), _each(losses, minutes)),
        Panel(
            "clearance in operation",
            time,
            Axis("clearance", "um", least=1.0),
            _each(clearances, minutes),
            (Mark("", 0.0),),
        ),
        Panel("smallest central film under load", time, Axis("film", "um", low=0.0), _each(films, minutes)),
    )
    notes = (f"conductances: {found.conductances}", *((found.reason,) if found.reason else ()))
    title = "Temperatures of a machine over time"
    return ViewData("machine-warm-up", title, _source(found), panels, 2, notes)


def _each(values: dict[str, list[float]], minutes: np.ndarray) -> tuple[Series, ...]:
    return tuple(Series(name, minutes, np.array(one), "line", group=i) for i, (name, one) in enumerate(values.items()))


def _bars(title: str, names: list[str], values: list[float]) -> Panel:
    places = np.arange(len(names), dtype=float)
    series = Series("heat", places, np.array(values), "bars", "total", unlisted=True)
    return Panel(title, Axis("", categories=tuple(names)), Axis("heat flow", "W"), (series,))


def _is_bearing(node: str, names: list[str]) -> bool:
    """Tell whether a node belongs to a bearing.

    It may also take what dampers of a bearing lose.
    """
    return node == "ambient" or any(node.startswith(f"{name}.") for name in names)


def _source(found: MachineTemperatures | MachineTemperaturesOverTime) -> str:
    bearings = ", ".join(f"{name} {one.title.split(' (')[0]}" for name, one in found.bearings.items())
    return f"{found.case}   {found.speed_rpm:.5g} 1/min   {bearings}"
