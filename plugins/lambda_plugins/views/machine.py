"""Draw orbits and bearing forces of a machine."""

from __future__ import annotations

from typing import Any

import numpy as np

from lambda_core.plugins import Axis, NotApplicable, Options, Panel, Series, View, ViewData

_POINTS = 4000  # of a line, at most


def orbit(run: Any, options: Options) -> ViewData:
    """Show orbits of the shaft at bearings and extremes.

    It shows every bearing and the place where the shaft moves most.
    """
    machine = _machine(run)
    moved = 1e6 * _thinned(machine["shaft_position"])
    lumps = np.array(machine.labels("lump"), dtype=float)
    names = machine.labels("bearing")
    seats = machine.machine["bearings"]
    places = [int(np.argmin(np.abs(lumps - float(seats[name]["position"])))) for name in names]
    most = int(np.argmax(np.hypot(*np.ptp(moved[len(moved) // 2 :, :, 1:], axis=0).T)))
    panels = []
    for i in dict.fromkeys([*places, most]):
        name = names[places.index(i)] if i in places else "largest orbit"
        line = Series("centre of the shaft", moved[:, i, 1], moved[:, i, 2], "points", "inner")
        title = f"{name}, at {1e3 * lumps[i]:.4g} mm"
        panels.append(Panel(title, Axis("y", "um"), Axis("z", "um"), (line,), shape="plane"))
    columns = min(len(panels), 3)
    notes = ("from the first moment on: the beginning is a transient out of the quasi-static equilibrium",)
    return ViewData("orbit", "Orbits of the shaft", _source(machine), tuple(panels), columns, notes)


def reactions(run: Any, options: Options) -> ViewData:
    """Show every bearing's force on the shaft over time."""
    machine = _machine(run)
    time, forces = 1e3 * _thinned(machine["time"]), _thinned(machine["reaction_force"])
    along = Axis("time", "ms", low=0.0)
    panels = tuple(
        Panel(f"along {axis}", along, Axis("force", "N"), tuple(
            Series(name, time, forces[:, i, k], "line", group=i) for i, name in enumerate(machine.labels("bearing"))
        ))
        for k, axis in enumerate("xyz")
    )  # fmt: skip
    return ViewData("reactions", "Forces of the bearings on the shaft", _source(machine), panels, 1)


def _is_machine(run: Any) -> bool:
    return bool(getattr(run, "is_machine", False))


def _machine(run: Any) -> Any:
    """Return the result of the whole machine.

    One bearing alone raises NotApplicable.
    """
    if not _is_machine(run):
        raise NotApplicable("the case is one bearing alone, not a machine with a shaft")
    return run.of_machine()


def _thinned(values: np.ndarray) -> np.ndarray:
    return values[:: max(1, len(values) // _POINTS)]


def _source(machine: Any) -> str:
    return f"{machine.case}   {30.0 / np.pi * float(machine.machine['speed']):.5g} 1/min"


VIEWS = (
    View("orbit", "orbits of the shaft of a machine", "result", orbit, offered=_is_machine, view_api=1),
    View(
        "reactions", "forces of a machine's bearings on the shaft over time", "result", reactions, offered=_is_machine,
        view_api=1,
    ),
)  # fmt: skip
