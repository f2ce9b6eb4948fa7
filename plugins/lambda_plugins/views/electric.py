"""Draw the bearing currents of a run."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from pydantic import Field

from lambda_core.plugins import Axis, NotApplicable, Options, Panel, Series, View, ViewData

if TYPE_CHECKING:
    from lambda_core.analysis.electric.simulation import Simulation

_SHOWN = 3e-4  # of the bearing voltage, edge by edge [s]
_FREQUENCIES = np.geomspace(1e2, 1e7, 51)


class Seed(Options):
    """Seed of the discharges."""

    seed: int = Field(1, ge=0, description="key of the random numbers")


def _simulation(run: Any, *overrides: str, window: bool = False) -> Simulation:
    """Compute the circuit of a run whose case has one."""
    from lambda_core.analysis.electric.case_or_run import electric_of_run, options_of_run, settled_from

    if options_of_run(run) is None:
        raise NotApplicable("the case has no section electric: --set electric.seed=1 puts the defaults in")
    start = settled_from(run)
    return electric_of_run(run, overrides, window=(start, start + _SHOWN) if window else None)


def _in_a_machine(run: Any) -> bool:
    """Tell whether the case of a run has a circuit."""
    from lambda_core.analysis.electric.case_or_run import options_of_run

    return options_of_run(run) is not None


def _source(run: Any, found: Simulation) -> str:
    return f"{run.title}   {found.outcome.source}"


def voltage(run: Any, options: Seed) -> ViewData:
    """Show the voltage between the rings with every discharge.

    Edge by edge, and its range over the whole span.
    """
    found = _simulation(run, f"electric.seed={options.seed}", window=True)
    trace, events = found.solution.trace, found.events
    begin = found.time[0]
    close = Panel(
        "edge by edge",
        Axis("time", "us"),
        Axis("bearing voltage", "V"),
        (Series("inner against outer ring", 1e6 * (trace[:, 0] - begin), trace[:, 2], "line", "total"),),
    )
    middle = 1e3 * 0.5 * (found.time[1:] + found.time[:-1])
    low, high = found.solution.extremes.T
    step = max(1, events.time.size // 3000)
    span = Panel(
        "whole span",
        Axis("time", "ms"),
        Axis("bearing voltage", "V"),
        (
            Series("range", middle, 0.5 * (low + high), "line", "total", low, high, "smallest to largest"),
            Series("breakdowns", 1e3 * events.time[::step], events.bearing_voltage[::step], "points", "reference"),
        ),
    )
    notes = (f"{found.outcome.discharges_per_s:.4g} discharges per second; {found.contacts.origin}",)
    return ViewData("bearing-voltage", "Bearing voltage", _source(run, found), (close, span), 1, notes)


def discharges(run: Any, options: Seed) -> ViewData:
    """Show breakdowns of the raceways with voltages and energies.

    It shows the share of breakdowns over each raceway, and the size of voltages and energies.
    """
    found = _simulation(run, f"electric.seed={options.seed}")
    outcome = found.outcome
    if outcome.voltage_histogram is None or outcome.energy_histogram is None:
        raise NotApplicable("nothing discharges through the bearing in this span")
    rose = []
    for ring, shares in (("inner", outcome.sector_share_inner), ("outer", outcome.sector_share_outer)):
        angle = (np.arange(len(shares)) + 0.5) * 360.0 / len(shares)
        closed = np.append(angle, angle[0] + 360.0), 100.0 * np.append(shares, shares[0])
        rose.append(Series(f"{ring} ring", *closed, "line", ring))
    panels = [
        Panel("share per 10 degrees", Axis("raceway", "deg"), Axis("share", "%", low=0.0), tuple(rose), shape="polar")
    ]
    for name, histogram in (("voltage", outcome.voltage_histogram), ("energy", outcome.energy_histogram)):
        edges = np.array(histogram.edges)
        counts = Series(
            "discharges", 0.5 * (edges[1:] + edges[:-1]), np.array(histogram.counts, float), "bars", "total"
        )
        panels.append(Panel(name, Axis(name, histogram.unit), Axis("discharges", low=0.0), (counts,)))
    notes = ("angles from +y towards +z, turning with the ring; voltage of the bearing, heat in both films of a ball",)
    return ViewData("discharges", "Discharges", _source(run, found), tuple(panels), 3, notes)


def impedance(run: Any, options: Options) -> ViewData:
    """Show the impedance between the rings over frequency.

    A meter measures it so while the bearing turns.
    """
    from lambda_core.analysis.electric.circuit import impedance as meter

    found = _simulation(run)
    values = meter(found.films, found.circuit.bearings[found.number], _FREQUENCIES)
    size, phase = 1e-3 * np.abs(values), np.degrees(np.angle(values))
    frequency = Axis("frequency", "Hz", log=True)
    magnitude = Series(
        "magnitude", _FREQUENCIES, size.mean(axis=0), "line", "total", size.min(axis=0), size.max(axis=0), "over time"
    )
    angle = Series("phase", _FREQUENCIES, phase.mean(axis=0), "line", "total")
    panels = (
        Panel("magnitude", frequency, Axis("impedance", "kOhm", log=True), (magnitude,)),
        Panel("phase", frequency, Axis("phase", "deg", least=10.0), (angle,)),
    )
    return ViewData("impedance", "Impedance of the bearing", _source(run, found), panels, 2, (found.contacts.origin,))


_TITLES = {
    "bearing-voltage": "voltage between the rings in an electric machine, with discharges",
    "discharges": "discharges over the raceways, their voltages and energies",
    "impedance": "impedance between the rings over frequency",
}
_PARTS: tuple[tuple[str, Any, type[Options]], ...] = (
    ("bearing-voltage", voltage, Seed),
    ("discharges", discharges, Seed),
    ("impedance", impedance, Options),
)
VIEWS = tuple(
    View(name, _TITLES[name], "result", data, options, offered=_in_a_machine, view_api=1)
    for name, data, options in _PARTS
)
