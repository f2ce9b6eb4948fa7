"""Draw the shape and waves of elastic rings."""

from __future__ import annotations

import re

import numpy as np
from numpy.typing import NDArray

from lambda_core.plugins import Axis, NotApplicable, Options, Panel, RunData, View, ViewData
from lambda_plugins.views.common import BODY, averaging, source, trace

_NAME = re.compile(r"(inner|outer|cage)(?:_ring)?_waves_(\d+)")
_PLACES = 361  # round a ring
_DRAWN = 0.25  # of the ring's radius: how far the largest displacement is drawn
Orders = dict[int, NDArray[np.float64]]


def ring_shape(run: RunData, options: Options) -> ViewData:
    """Show the shape and the waves of rings and cage.

    It enlarges the displacements at the end of the run, and shows the size of every wave over time.
    """
    found = _waves(run)
    if not found:
        raise NotApplicable("no part of this run is elastic: [elastic.outer_ring] in the case makes one so")
    around = np.linspace(0.0, 2.0 * np.pi, _PLACES)
    ends = {ring: _shape({n: a[-1] for n, a in orders.items()}, around) for ring, orders in found.items()}
    panels = [_bent(run, ring, shape, around) for ring, shape in ends.items()]
    span = averaging(run)
    rows = span.rows(run["time"])
    time = 1e3 * run["time"][rows]
    for ring, orders in found.items():
        lines = [trace(f"{n} waves", time, 1e6 * np.hypot(*amplitudes[rows].T)) for n, amplitudes in orders.items()]
        panels.append(Panel(f"waves of the {_part(ring)}", Axis("time", "ms"), Axis("amplitude", "um"), tuple(lines)))
    notes = (
        "shape at the end of the run, seen along the shaft: y to the right, z up; displacements drawn larger, outwards",
        f"waves over {span.words}",
    )
    return ViewData("ring-shape", "Shape of the elastic parts", source(run), tuple(panels), 2, notes)


def _waves(run: RunData) -> dict[str, Orders]:
    """Return the wave amplitudes of every part.

    They are ordered by the number of waves, shape (n, 2) [m].
    """
    found: dict[str, Orders] = {}
    for channel in run.channels:
        if match := _NAME.fullmatch(channel.name):
            found.setdefault(match[1], {})[int(match[2])] = run[channel.name]
    return {part: found[part] for part in BODY if part in found}


def _part(name: str) -> str:
    """Return a ring or the cage in words."""
    return name if name == "cage" else f"{name} ring"


def _shape(orders: Orders, azimuths: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the outward displacement of a part [m].

    The azimuths are in its own frame.
    """
    total = np.zeros(azimuths.size)
    for n, (cosine, sine) in orders.items():
        total += cosine * np.cos(n * azimuths) + sine * np.sin(n * azimuths)
    return total


def _bent(run: RunData, ring: str, shape: NDArray[np.float64], around: NDArray[np.float64]) -> Panel:
    """Return a part, round and bent.

    Its largest displacement is drawn as a quarter of its radius.
    """
    geometry = run.model["geometry"]
    radius = 0.5e3 * float(geometry["pitch_diameter" if ring == "cage" else f"race_diameter_{ring}"])
    largest = float(np.abs(shape).max())
    bent = radius * (1.0 + _DRAWN * shape / (largest or 1.0))
    turned = around + float(run["body_spin_angle"][-1, BODY[ring]])
    return Panel(
        f"{_part(ring)}: {1e6 * shape.max():.3g} um outwards, {-1e6 * shape.min():.3g} um inwards",
        Axis("y", "mm"),
        Axis("z", "mm"),
        (
            trace("round", radius * np.cos(around), radius * np.sin(around), "reference"),
            trace("bent", bent * np.cos(turned), bent * np.sin(turned), ring),
        ),
        shape="plane",
    )


def _is_elastic(run: RunData) -> bool:
    """Tell whether a run has an elastic part."""
    return any(_NAME.fullmatch(channel.name) for channel in run.channels)


VIEWS = (
    View(
        "ring-shape", "how elastic rings and cage bend, and their waves over time", "result", ring_shape,
        offered=_is_elastic, view_api=1,
    ),
)  # fmt: skip
