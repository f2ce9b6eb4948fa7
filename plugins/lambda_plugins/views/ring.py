"""Draw orbit and spectrum of the inner ring."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from lambda_core.domain.channels import DIMENSIONS
from lambda_core.plugins import Axis, Mark, NotApplicable, Options, Panel, RunData, Series, View, ViewData
from lambda_plugins.views.common import BODY, averaging, integration, source, spectrum, speeds, trace

_FLOOR = 1e-5  # of the largest amplitude: what is shown at most
_WIDTH = 3.5  # times the highest characteristic frequency
_TURNS = 2.0  # of the shaft, the last ones: what stands out of the orbit
_STILL = 1e-12  # [m] below this a ring does not move


def ring_orbit(run: RunData, options: Options) -> ViewData:
    """Show path and motion of the inner ring's centre.

    It shows the path across the shaft and the motion over time.
    """
    span = averaging(run)
    rows = span.rows(run["time"])
    time = 1e3 * run["time"][rows]
    place = 1e6 * run["body_position"][rows, BODY["inner"]]
    mean = place.mean(axis=0)
    away = place - mean
    last = _last_turns(run, rows)
    orbit = (
        trace("whole span", away[:, 1], away[:, 2], "reference"),
        trace(f"last {_TURNS:g} turns", away[last:, 1], away[last:, 2], "inner"),
        Series("end state", away[-1:, 1], away[-1:, 2], "points", "total"),
    )
    motion = tuple(
        trace(axis, time, away[:, index], role)
        for index, (axis, role) in enumerate(zip(DIMENSIONS["axis"], ("cage", "outer", "inner"), strict=True))
    )
    panels = (
        Panel(
            "orbit round the mean place", Axis("y", "um", least=0.01), Axis("z", "um", least=0.01), orbit, shape="plane"
        ),
        Panel("over time", Axis("time", "ms"), Axis("displacement from the mean", "um", least=0.01), motion),
    )
    places = ", ".join(f"{axis} {value:.4g}" for axis, value in zip(DIMENSIONS["axis"], mean, strict=True))
    notes = (
        f"over {span.words}; mean place: {places} um; a sample every {1e3 * np.diff(time).mean():.3g} us",
        "x along the shaft, y horizontal, z up",
    )
    return ViewData("ring-orbit", "Orbit of the inner ring", source(run), panels, 2, notes)


def _last_turns(run: RunData, rows: slice) -> int:
    """Return the start of the last turns.

    The first row, within a span, of the last turns of the rings against each other.
    """
    spin = run["body_spin_angle"][rows]
    turned = np.abs(spin[:, BODY["inner"]] - spin[:, BODY["outer"]]) / (2.0 * np.pi)
    return int(np.searchsorted(turned, turned[-1] - _TURNS)) if turned[-1] > turned[0] else 0


def ring_spectrum(run: RunData, options: Options) -> ViewData:
    """Show the amplitude spectrum of the inner ring's motion.

    It marks the characteristic frequencies.
    """
    span = averaging(run)
    rows = span.rows(run["time"])
    time, place = run["time"][rows], run["body_position"][rows, BODY["inner"]]
    marks = speeds(run, span).frequencies()
    limit = _WIDTH * max(marks.values())
    vibrations = run.summary().vibrations
    if vibrations is not None:
        limit = max(limit, vibrations.resolve_Hz)
    series = []
    for index, (axis, role) in enumerate(zip(DIMENSIONS["axis"], ("cage", "outer", "inner"), strict=True)):
        if np.ptp(place[:, index]) > _STILL:
            frequency, amplitude = spectrum(time, 1e6 * place[:, index])
            shown = frequency <= limit if limit > 0.0 else np.ones(frequency.size, bool)
            series.append(Series(axis, frequency[shown], amplitude[shown], "line", role))
    if not series:
        raise NotApplicable("the inner ring does not move in the averaging window")
    top = max(float(s.y.max()) for s in series)
    series = [s for s in series if s.y.max() > _FLOOR * top]
    lines = tuple(Mark(name, value, "x") for name, value in marks.items() if value > 0.0)
    panels = tuple(
        Panel(
            f"along {one.name}",
            Axis("frequency", "Hz", low=0.0, high=limit or None),
            Axis("amplitude", "um", log=True, low=_FLOOR * top, high=3.0 * top),
            (replace(one, unlisted=True),),
            lines,
        )
        for one in series
    )
    step = series[0].x[1] - series[0].x[0]
    values = ", ".join(f"{name} {value:.4g}" for name, value in marks.items())
    notes = (
        f"Hann window over {span.words}; x along the shaft, y horizontal, z up; a point every {step:.3g} Hz: "
        "longer runs have finer spectra (solver.average_revolutions)",
        f"characteristic frequencies of rolling without slip [Hz]: {values}",
        *integration(run, float(series[0].x[-1])),
    )
    return ViewData("ring-spectrum", "Spectrum of the inner ring's motion", source(run), panels, 1, notes)


_ORDERS = "Harris and Kotzalas, Rolling Bearing Analysis, 5th ed., vol. 1, ch. 10"
VIEWS = (
    View("ring-orbit", "orbit of the inner ring's centre", "result", ring_orbit, view_api=1),
    View(
        "ring-spectrum",
        "spectrum of the inner ring with BPFO, BPFI, BSF, FTF",
        "result",
        ring_spectrum,
        reference=_ORDERS,
        view_api=1,
    ),
)
