"""Draw the electrical capacitance of a run."""

from __future__ import annotations

import numpy as np

from lambda_core.plugins import Axis, Mark, NotApplicable, Options, Panel, RunData, Series, View, ViewData
from lambda_plugins.views.azimuth import AZIMUTH
from lambda_plugins.views.common import averaging, integration, of_ring, over_azimuth, source, spectrum, speeds, trace

_FLOOR = 1e-5  # of the largest amplitude: what is shown at most
_WIDTH = 3.5  # times the highest characteristic frequency
_STEADY = 1e-9  # relative swing below which there is no spectrum


def capacitance(run: RunData, options: Options) -> ViewData:
    """Show the capacitance of the bearing and its contacts.

    It shows the bearing over time with its spectrum, and the contacts over azimuth.
    """
    span = averaging(run)
    rows = span.rows(run["time"])
    time, values = run["time"][rows], 1e12 * run["bearing_capacitance"][rows]
    known = np.isfinite(values)
    if not known.any():
        raise NotApplicable("asperities short a rolling element at both rings in every sample: there is no capacitance")
    total = trace("bearing", 1e3 * time, np.where(known, values, np.nan), "total")
    contacts: list[Series] = []
    for ring in ("inner", "outer"):
        each = 1e12 * of_ring(run, "capacitance", ring)
        loaded = np.isfinite(each) & (of_ring(run, "load", ring) > 0.0)
        contacts += over_azimuth(run, span, np.where(loaded, each, np.nan), loaded, f"{ring} ring", ring)
    panels = [Panel("contacts under load", AZIMUTH, Axis("capacitance", "pF", low=0.0), tuple(contacts))]
    notes = [f"over {span.words}; balls in parallel, inner and outer contact of a ball in series"]
    if known.all() and np.ptp(values) > _STEADY * values.mean():
        panels.append(_spectrum(run, time, values))
        notes += integration(run, float(panels[-1].series[0].x[-1]))
    else:
        notes.append("no spectrum: the capacitance is steady, or a contact is shorted at times")
    panels.append(Panel("bearing", Axis("time", "ms"), Axis("capacitance", "pF"), (total,)))
    return ViewData("capacitance", "Electrical capacitance", source(run), tuple(panels), 2, tuple(notes))


def _spectrum(run: RunData, time: np.ndarray, values: np.ndarray) -> Panel:
    marks = speeds(run, averaging(run)).frequencies()
    limit = _WIDTH * max(marks.values())
    frequency, amplitude = spectrum(time, values)
    shown = frequency <= limit if limit > 0.0 else np.ones(frequency.size, bool)
    top = float(amplitude[shown].max())
    return Panel(
        "spectrum of the bearing's capacitance",
        Axis("frequency", "Hz", low=0.0, high=limit or None),
        Axis("amplitude", "pF", log=True, low=_FLOOR * top, high=3.0 * top),
        (Series("bearing", frequency[shown], amplitude[shown], "line", "total"),),
        tuple(Mark(name, value, "x") for name, value in marks.items() if value > 0.0),
    )


VIEWS = (
    View(
        "capacitance",
        "capacitance over time and its spectrum, contacts over azimuth",
        "result",
        capacitance,
        view_api=1,
    ),
)
