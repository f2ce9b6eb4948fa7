"""Make charts of temperatures and heat flows."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from lambda_core.analysis.thermal.report import SteadyTemperatures, TemperaturesOverTime
from lambda_core.analysis.thermal.temperature_text import elements_in, labels, part_words, shown_nodes, ways
from lambda_core.model.settings.machine_heat import is_numbered
from lambda_core.views.chart import Axis, Mark, Panel, Series, ViewData

_PARTS = ("inner_ring", "outer_ring", "balls", "oil")  # of several bearings
_ROLES = {"inner_ring": "inner", "outer_ring": "outer", "balls": "ball", "oil": "cage"}  # no cage is drawn
_OF_ONE = {"inner_ring": "inner", "outer_ring": "outer", "balls": "ball", "cage": "cage"}


def pictures(found: SteadyTemperatures | TemperaturesOverTime) -> list[ViewData]:
    """Return what there is to see: one picture."""
    return [heat_flows(found) if isinstance(found, SteadyTemperatures) else over_time(found)]


def heat_flows(found: SteadyTemperatures) -> ViewData:
    """Draw temperatures, sources and flows of heat.

    Of several bearings the picture has their parts; of one bearing every node and mechanism.
    """
    words, flows = labels(found), ways(found)
    several, along = len(found.bearings) > 1, len(found.shaft) > 1
    nodes = {words[node]: value for node, value in found.temperatures_degC.items() if not is_numbered(node)}
    heat = {words[node]: value for node, value in found.heat_W.items()}
    panels = (
        *([_along(found)] if along else []),
        _of_bearings(found) if several else _bars("temperatures", nodes, "temperature", "degC"),
        _bars("where the heat comes from", _sources(found), "power loss", "W"),
        *([] if along else [_bars("which node gets it", heat, "heat", "W")]),
        _bars("where it goes", {f"{way.source} - {way.target}": way.heat for way in flows}, "heat flow", "W"),
    )
    notes = (
        f"losses: {found.losses_from}; conductances: {found.conductances}; flows below 0.5 % of the loss are left out",
        f"gain of the torque-temperature loop {found.gain.loop:.2f}; energy residual {found.energy_residual:.1e}",
    )
    return ViewData("heat", "Temperatures and heat flows", _source(found), panels, 2, notes)


def _along(found: SteadyTemperatures) -> Panel:
    """Draw shaft temperatures as a line with points.

    The points are the parts of the bearings at their places.
    """
    at = found.temperatures_degC
    supports = tuple(Mark(name, one.position_mm, "x") for name, one in found.bearings.items())
    housing = (Mark("housing", at["housing"]),) if "housing" in at else ()
    places = np.array([place.position_mm for place in found.shaft])
    shaft = Series("shaft", places, np.array([place.temperature_degC for place in found.shaft]), "line", "total")
    parts = []
    for part in _PARTS:
        known = [one for one in found.bearings.values() if part in one.nodes]
        x = np.array([one.position_mm for one in known])
        y = np.array([at[one.nodes[part]] for one in known])
        parts.append(Series(part_words(part, elements_in(found)), x, y, "points", _ROLES[part]))
    series = (shaft, *(one for one in parts if one.x.size))
    axes = Axis("position", "mm"), Axis("temperature", "degC", least=1.0)
    return Panel("along the shaft", *axes, series, (*supports, *housing))


def _of_bearings(found: SteadyTemperatures) -> Panel:
    """Draw the parts of several bearings side by side."""
    places = np.arange(len(found.bearings), dtype=float)
    series = tuple(
        Series(
            part_words(part, elements_in(found)),
            places,
            np.array([found.temperatures_degC.get(one.nodes.get(part, ""), np.nan) for one in found.bearings.values()]),
            "bars",
            _ROLES[part],
            unlisted=True,
        )
        for part in _PARTS
    )
    return Panel("bearings", Axis("", categories=tuple(found.bearings)), Axis("temperature", "degC"), series)


def _sources(found: SteadyTemperatures) -> dict[str, float]:
    """Return the sources of heat [W].

    They are several bearings or the mechanisms of one, and what the case puts in elsewhere.
    """
    words = labels(found)
    own = {node for one in found.bearings.values() for node in one.nodes.values()} | {"ambient"}
    rest = {words[node]: value for node, value in found.heat_W.items() if value and node not in own}
    if len(found.bearings) > 1:
        return {name: one.state.power_loss_W for name, one in found.bearings.items()} | rest
    (one,) = found.bearings.values()
    return {name: value for name, value in one.losses_W.items() if value} | rest


def over_time(found: TemperaturesOverTime) -> ViewData:
    """Draw temperatures and losses over time.

    The picture also shows clearances and films of all bearings.
    """
    minutes, time, words = np.array(found.time_s) / 60.0, Axis("time", "min"), labels(found)
    one = next(iter(found.bearings.values()))
    roles = {one.nodes.get(part, part): role for part, role in (_OF_ONE | {"ambient": "reference"}).items()}
    temperatures = tuple(
        Series(
            words[node], minutes, np.array(found.temperatures_degC[node]), "line",
            roles.get(node, "") if len(found.bearings) == 1 else "",
        )
        for node in shown_nodes(found)
    )  # fmt: skip
    losses = _each("power_loss_W", found, minutes)
    panels = (
        Panel("temperatures", time, Axis("temperature", "degC", least=1.0), temperatures),
        Panel("power loss", time, Axis("power loss", "W", low=0.0), losses),
        Panel(
            "clearance in operation",
            time,
            Axis("clearance", "um", least=1.0),
            _each("clearance_um", found, minutes),
            (Mark("", 0.0),),
        ),
        Panel("smallest central film under load", time, Axis("film", "um", low=0.0), _each("film_um", found, minutes)),
    )
    notes = (f"conductances: {found.conductances}", *((found.reason,) if found.reason else ()))
    return ViewData("temperatures", "Temperatures over time", _source(found), panels, 2, notes)


def _each(name: str, found: TemperaturesOverTime, minutes: np.ndarray) -> tuple[Series, ...]:
    """Return a number of every bearing over time."""
    values: Mapping[str, Sequence[float | None]] = {key: getattr(one, name) for key, one in found.bearings.items()}
    return tuple(
        Series(key, minutes, np.array(own, dtype=float), "line", group=i, unlisted=len(values) == 1)
        for i, (key, own) in enumerate(values.items())
    )


def _bars(title: str, values: Mapping[str, float], label: str, unit: str) -> Panel:
    places = np.arange(len(values), dtype=float)
    series = Series(label, places, np.array(list(values.values())), "bars", "total", unlisted=True)
    return Panel(title, Axis("", categories=tuple(values)), Axis(label, unit), (series,))


def _source(found: SteadyTemperatures | TemperaturesOverTime) -> str:
    """Return the line below the title: what was asked about."""
    *first, last = found.headline.splitlines()
    title = next(iter(found.bearings.values())).title
    return f"{title}   {last}" if first else last
