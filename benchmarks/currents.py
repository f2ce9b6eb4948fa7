"""Time the circuit, a risk map and their balances."""

from __future__ import annotations

from benchmarks.tables import Section, Table, Target
from benchmarks.timing import Effort, best, now
from lambda_core import api
from lambda_core.analysis.electric.circuit_bearing import circuit_bearings
from lambda_core.analysis.electric.contacts import contacts_of_equilibria, equilibria
from lambda_core.analysis.electric.simulation import simulate

CASE = "6208-axial-1300"  # 2750 1/min
RADIAL = ("loads.axial=0 N", "loads.radial=2 kN")
SMOOTH, SLOW = "surface.roughness=0.1 um", "operation.speed=500 rpm"
# 10 kHz inverter with 800 V unless said; 0.16 um rough unless said.
SITUATIONS: tuple[tuple[str, tuple[str, ...]], ...] = (
    ("0.1 um, 400 V: nothing discharges", (SMOOTH, "electric.inverter.dc_link=400 V")),
    ("0.1 um", (SMOOTH,)),
    ("0.1 um, 500 1/min: every edge discharges", (SMOOTH, SLOW)),
    ("default", ()),
    ("500 1/min: metal bridges some films", (SLOW,)),
)


def one_second(changes: tuple[str, ...], repeats: int) -> tuple[float, float, float, float, float]:
    """Return a simulated second's cost and results.

    Wall time [s]; in it discharges through a ball and breakdowns of one film; residuals of energy and charge.
    """
    model = api.check(CASE, [*RADIAL, "electric.duration=1 s", *changes])
    contacts, bearing = contacts_of_equilibria(equilibria(model), 1.0), circuit_bearings(model)[0]
    found = simulate(contacts, bearing)  # what a process loads once is not the circuit's
    seconds = best(lambda: simulate(contacts, bearing), repeats)
    outcome = found.outcome
    breakdowns = outcome.discharges, outcome.partial_discharges
    return seconds, *breakdowns, abs(outcome.energy_residual), abs(outcome.charge_residual)


def map_seconds(points: str) -> float:
    """Return the wall time of a map [s].

    Over speed and temperature on two cores.
    """
    started = now()
    api.electric_map(CASE, RADIAL, points=points, workers=2)
    return now() - started


def measure(effort: Effort) -> Section:
    """Time a circuit second and a map.

    A second of a 6208 on a 10 kHz inverter, a map of 200 points.
    """
    rows = [(words, *one_second(changes, effort.repeats)) for words, changes in SITUATIONS]
    table = Table(
        "One simulated second of a 6208 at 2750 1/min, 2 kN radial, 0.16 um rough, on a 10 kHz inverter of 800 V",
        ("circuit", "s", "discharges", "through one film", "energy residual", "charge residual"),
        tuple(rows),
        ("Quasi-static films at twelve positions of the balls; the time is that of the circuit alone.",),
    )
    points = "5x4" if effort.quick else "20x10"
    seconds = map_seconds(points)
    chart = Table(
        "Risk map",
        ("points", "s"),
        ((points, seconds),),
        ("Two processes, their start included; each point resolves its case.",),
    )
    targets = [
        Target("circuit per simulated second", "s", max(row[1] for row in rows), 0.3),
        Target("energy residual with arcs", "", max(row[4] for row in rows[1:]), 1e-6),
        Target("energy residual without arcs", "", rows[0][4], 1e-9),
        Target("map of 200 points", "s", seconds * (10.0 if effort.quick else 1.0), 60.0),
    ]
    return Section("currents", (table, chart), tuple(targets))
