"""A run of a shaft as data to draw: its orbits, and the reactions over time."""

from __future__ import annotations

import numpy as np

from lambda_core.shaft.whole_file import WholeFile
from lambda_core.views.chart import Axis, Panel, Series, ViewData

_POINTS = 4000  # of a line, at most


def motion_pictures(found: WholeFile) -> list[ViewData]:
    """Return the orbits of the shaft at every bearing and where it moves most, and the reactions over time."""
    channels = found.channels()
    step = max(1, len(channels["time"]) // _POINTS)
    time = 1e3 * channels["time"][::step]
    moved = 1e6 * channels["shaft_position"][::step]
    source = f"{found.case}   {30.0 / np.pi * found.speed:.5g} 1/min"
    return [_orbits(found, moved, source), _reactions(found, time, channels["reaction_force"][::step], source)]


def _orbits(found: WholeFile, moved: np.ndarray, source: str) -> ViewData:
    places = [int(np.argmin(np.abs(found.lump_positions - x))) for x in found.bearing_positions]
    most = int(np.argmax(np.hypot(*np.ptp(moved[len(moved) // 2 :, :, 1:], axis=0).T)))
    panels = []
    for i in dict.fromkeys([*places, most]):
        name = found.bearings[places.index(i)] if i in places else "largest orbit"
        line = Series("centre of the shaft", moved[:, i, 1], moved[:, i, 2], "points", "inner")
        title = f"{name}, at {1e3 * found.lump_positions[i]:.4g} mm"
        panels.append(Panel(title, Axis("y", "um"), Axis("z", "um"), (line,), shape="plane"))
    columns = min(len(panels), 3)
    notes = ("from the first moment on: the beginning is a transient out of the quasi-static equilibrium",)
    return ViewData("orbit", "Orbits of the shaft", source, tuple(panels), columns, notes)


def _reactions(found: WholeFile, time: np.ndarray, forces: np.ndarray, source: str) -> ViewData:
    along = Axis("time", "ms", low=0.0)
    panels = tuple(
        Panel(f"along {axis}", along, Axis("force", "N"), tuple(
            Series(name, time, forces[:, i, k], "line", group=i) for i, name in enumerate(found.bearings)
        ))
        for k, axis in enumerate("xyz")
    )  # fmt: skip
    return ViewData("reactions", "Forces of the bearings on the shaft", source, panels, 1)
