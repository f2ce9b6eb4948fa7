"""Make charts of temperatures and heat flows."""

from __future__ import annotations

import numpy as np

from lambda_core.analysis.thermal.report import SteadyTemperatures, TemperaturesOverTime
from lambda_core.analysis.thermal.temperature_lines import node_words
from lambda_core.views.chart import Axis, Mark, Panel, Series, ViewData

_ROLES = {"inner_ring": "inner", "outer_ring": "outer", "balls": "ball", "cage": "cage", "ambient": "reference"}


def pictures(found: SteadyTemperatures | TemperaturesOverTime) -> list[ViewData]:
    """Return what there is to see: one picture."""
    return [heat_flows(found) if isinstance(found, SteadyTemperatures) else over_time(found)]


def over_time(found: TemperaturesOverTime) -> ViewData:
    """Draw node temperatures over time.

    The picture also shows loss, clearance and film.
    """
    minutes = np.array(found.time_s) / 60.0
    time = Axis("time", "min")
    temperatures = tuple(
        Series(node_words(name, found.elements), minutes, np.array(values), "line", _ROLES.get(name, ""))
        for name, values in found.temperatures_degC.items()
    )
    clearance = Series("clearance", minutes, np.array(found.clearance_um), "line", "inner")
    film = np.array([np.nan if value is None else value for value in found.film_um])
    panels = (
        Panel("temperatures", time, Axis("temperature", "degC", least=1.0), temperatures),
        Panel(
            "power loss",
            time,
            Axis("power loss", "W", low=0.0),
            (Series("loss", minutes, np.array(found.power_loss_W), "line", "total"),),
        ),
        Panel("clearance in operation", time, Axis("clearance", "um", least=1.0), (clearance,), (Mark("", 0.0),)),
        Panel(
            "smallest central film under load",
            time,
            Axis("film", "um", low=0.0),
            (Series("film", minutes, film, "line", "ball"),),
        ),
    )
    notes = (f"conductances: {found.conductances}", *((found.reason,) if found.reason else ()))
    return ViewData("temperatures", "Temperatures over time", _source(found), panels, 2, notes)


def heat_flows(found: SteadyTemperatures) -> ViewData:
    """Draw the heat flows.

    Sources, targets, and the temperatures that drive them.
    """
    mechanisms = {name: value for name, value in found.losses_W.items() if value}
    flows = [flow for flow in found.flows if flow.heat_W >= 0.005 * found.state.power_loss_W]
    names = [f"{node_words(flow.source, found.elements)} - {node_words(flow.target, found.elements)}" for flow in flows]
    nodes = list(found.temperatures_degC)
    panels = (
        _bars("where it comes from", list(mechanisms), [float(v) for v in mechanisms.values()], "power loss", "W"),
        _bars("which node gets it", [n.replace("_", " ") for n in nodes], list(found.heat_W.values()), "heat", "W"),
        _bars("where it goes", names, [flow.heat_W for flow in flows], "heat flow", "W"),
        _bars(
            "temperatures",
            [n.replace("_", " ") for n in nodes],
            list(found.temperatures_degC.values()),
            "temperature",
            "degC",
        ),
    )
    notes = (
        f"losses: {found.losses_from}; conductances: {found.conductances}; flows below 0.5 % of the loss are left out",
        f"gain of the torque-temperature loop {found.gain.loop:.2f}; energy residual {found.energy_residual:.1e}",
    )
    return ViewData("heat", "Where the heat goes", _source(found), panels, 2, notes)


def _bars(title: str, names: list[str], values: list[float], label: str, unit: str) -> Panel:
    places = np.arange(len(names), dtype=float)
    series = Series(label, places, np.array(values), "bars", "total", unlisted=True)
    return Panel(title, Axis("", categories=tuple(names)), Axis(label, unit), (series,))


def _source(found: SteadyTemperatures | TemperaturesOverTime) -> str:
    return f"{found.title}   {found.headline.splitlines()[-1]}"
