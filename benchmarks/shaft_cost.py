"""Measure a shaft run against its bearings alone.

The bearings alone run under the loads that they have on the shaft.
"""

from __future__ import annotations

import tomllib
from collections.abc import Callable, Mapping

from benchmarks.tables import Cell, Section, Table, Target
from benchmarks.timing import Effort, now, sum_of_minima
from lambda_core.analysis.rotor.bearing_alone import alone_under_load
from lambda_core.model.machine_templates import shaft_text
from lambda_core.model.resolve_machine import resolve_machine
from lambda_core.solver.drivers.dynamics import BearingEngine
from lambda_core.solver.drivers.machine_motion import MachineEngine, machine_engine

CHANGES = ("discs.wheel.unbalance=50 g mm",)  # of the case that `init --template geared-shaft` writes
MOST = 1.3  # times the sum
_PIECES = 100  # short ones: of each a repeat is found that nothing else on the machine held up
_MILLISECONDS, _MILLISECONDS_QUICK = 200, 40
_REPEATS = 5
_COUNTED = ("steps", "newton_iterations", "bypasses", "jacobians", "ball_jacobians", "factorisations")
MACHINE = "machine"
Engine = MachineEngine | BearingEngine
Passage = tuple[tuple[float, ...], Mapping[str, float]]  # time of each piece [s], counters


def starts(changes: tuple[str, ...] = CHANGES) -> dict[str, Callable[[], Engine]]:
    """Return the starts of machine and bearings.

    Each bearing alone, by name.
    """
    model = resolve_machine(tomllib.loads(shaft_text("geared-shaft", "machine")), changes)
    first = machine_engine(model)
    found: dict[str, Callable[[], Engine]] = {MACHINE: lambda: machine_engine(model)}
    for i, part in enumerate(first.bearings):
        alone = alone_under_load(model, first.start.state, i)
        found[part.name] = lambda alone=alone: BearingEngine(alone)  # type: ignore[misc]
    return found


def passage(engine: Engine, duration: float) -> Passage:
    """Integrate for `duration` [s].

    Samples wait in the buffer, nothing of Python but a call for each piece.
    """
    pieces = []
    for k in range(_PIECES):
        began = now()
        done = engine.advance(duration * (k + 1) / _PIECES)
        pieces.append(now() - began)
        if not done.ok:
            raise RuntimeError(done.message)
    return tuple(pieces), engine.statistics()


def measure(effort: Effort) -> Section:
    """Time the machine and its bearings.

    In turn, piece by piece; of each piece the shortest repeat counts.
    """
    duration = 1e-3 * effort.pick(_MILLISECONDS_QUICK, _MILLISECONDS)
    ways = starts()
    found: dict[str, list[Passage]] = {name: [] for name in ways}
    for _ in range(effort.pick(effort.repeats, _REPEATS)):
        for name, start in ways.items():
            found[name].append(passage(start(), duration))
    seconds = {name: sum_of_minima([pieces for pieces, _ in passages]) for name, passages in found.items()}
    bearings, rows = len(ways) - 1, []
    for name, passages in found.items():
        counts = [int(passages[0][1].get(key, 0)) for key in _COUNTED]
        evaluated = counts[1] * (bearings if name == MACHINE else 1) - counts[2]
        cells: tuple[Cell, ...] = (name, *counts, evaluated, 1e3 * seconds[name], 1e6 * seconds[name] / evaluated)
        rows.append(cells)
    table = Table(
        f"A machine and its bearings alone, 6208 and 6206, {1e3 * duration:.0f} ms",
        (
            "what", "steps", "Newton iterations", "bypasses", "Jacobians", "of single balls", "factorisations",
            "bearings evaluated", "ms", "us per bearing evaluated",
        ),
        tuple(rows),
        ("The template geared-shaft with 50 g mm at its wheel; alone under the loads of the machine's equilibrium.",),
    )  # fmt: skip
    ratio = seconds[MACHINE] / sum(value for name, value in seconds.items() if name != MACHINE)
    return Section("shaft_cost", (table,), (Target("a machine over the sum of its bearings", "-", ratio, MOST),))
