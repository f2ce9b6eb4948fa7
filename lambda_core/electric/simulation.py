"""From contacts and options to voltages and discharges."""

from __future__ import annotations

import time
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from lambda_core.case.electric import Electric
from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.errors import UsageError
from lambda_core.electric.circuit import circuit_of
from lambda_core.electric.circuit_integrator import UNCHARGED, Circuit, CircuitSolution, Films, Network, Strength
from lambda_core.electric.contacts import Contacts, films
from lambda_core.electric.film_laws import FilmLaw, film_laws
from lambda_core.electric.voltage_sources import corners, one_period, reach

if TYPE_CHECKING:
    from lambda_core.electric.circuit_bearing import CircuitBearing
    from lambda_core.electric.events import Events
    from lambda_core.electric.outcome import Outcome


@dataclass(frozen=True)
class Simulation:
    """The bearing in its circuit over a span of time.

    Attributes
    ----------
    bearing : CircuitBearing
        The bearing and the section of its case.
    contacts, films, circuit
        What the bearing and its circuit are.
    source : tuple of float64[:]
        Corners of the common-mode voltage: times [s], volts.
    solution : CircuitSolution
        What came out.
    speed : float
        Of the inner ring against the outer, mean [rad/s].
    wall : float
        Wall time of the integration [s].
    """

    bearing: CircuitBearing
    contacts: Contacts
    films: Films
    circuit: Circuit
    source: tuple[FloatArray, FloatArray]
    solution: CircuitSolution
    speed: float
    wall: float

    @property
    def case(self) -> str:
        """Name of the case."""
        return self.bearing.case

    @property
    def options(self) -> Electric:
        """Section of the case."""
        return self.bearing.options

    @property
    def duration(self) -> float:
        """Time that was computed [s]."""
        return float(self.films.time[-1] - self.films.time[0])

    @cached_property
    def events(self) -> Events:
        """Films that broke down, one entry each."""
        from lambda_core.electric.events import events_of

        return events_of(self.solution, self.contacts)

    @cached_property
    def outcome(self) -> Outcome:
        """Voltages, discharges and impedance in the words of the machine interface."""
        from lambda_core.electric.outcome import outcome_of

        return outcome_of(self)


def strength_of(laws: tuple[FilmLaw, FilmLaw], options: Electric, roughness: float) -> Strength:
    """Return when films break down and what burns then; `roughness` is the composite rms one [m]."""
    return Strength(*laws, roughness, options.breakdown.least_voltage)


def simulate(
    contacts: Contacts,
    bearing: CircuitBearing,
    *,
    settled: float | None = None,
    window: tuple[float, float] | None = None,
    announce: Any = None,
) -> Simulation:
    """Integrate the circuit through the contacts.

    Parameters
    ----------
    bearing : CircuitBearing
        Its circuit, and what laws may know of it.
    settled : float, optional
        Time from which on is counted [s]; the circuit is integrated from the first sample on all the same, so that
        it is the one that a run computes with the motion. The samples are those of a run then, and the integration
        ends as far before the last as the source needs. Default: everything is counted.
    window : tuple of float, optional
        Times between which every corner of the voltages is recorded [s]; default: none.

    Raises
    ------
    UsageError
        When fewer than two samples are left.
    SolverError
        When the circuit cannot be solved.
    """
    options = bearing.options
    last, first = contacts.time.size, 0
    if settled is not None:
        last = integrated_until(contacts.time, reach(options.source)) + 1
        first = int(np.searchsorted(contacts.time, settled))
        if last - first < 2:
            raise UsageError(f"{contacts.origin}: too short: fewer than two samples are left from {settled:.4g} s on")
    electric, circuit = films(contacts, options), circuit_of(options, bearing.geometry)
    begin, end = float(contacts.time[0]), float(contacts.time[-1])
    laws = film_laws(bearing.laws, bearing.contexts, announce)
    network = Network(
        circuit,
        strength_of(laws, options, contacts.roughness),
        electric.film.shape[1],
        seed=options.seed,
        announce=announce,
    )
    source = corners(options.source, begin, end + reach(options.source), contacts.turned)
    rest = one_period(options.source, begin, contacts.turned)
    started, spent = time.perf_counter(), float(electric.time[first] - begin)
    if first > 0:
        network.advance(electric.part(slice(0, first + 1)), source, rest=rest)
    rows = slice(first, last)
    recorded = (np.inf, -np.inf) if window is None else window
    found = network.advance(electric.part(rows), source, recorded, rest if first == 0 else UNCHARGED)
    wall = time.perf_counter() - started
    contacts, electric = contacts.part(rows), electric.part(rows)
    length = float(electric.time[-1] - electric.time[0])
    angle = contacts.inner_angle - contacts.outer_angle
    speed = float((angle[-1] - angle[0]) / length)
    return Simulation(bearing, contacts, electric, circuit, source, found, speed, wall * length / (length + spent))


def integrated_until(time: FloatArray, margin: float) -> int:
    """Return the last sample that a run's circuit is integrated to: `margin` [s] before the newest."""
    return int(np.searchsorted(time, time[-1] - margin, side="right")) - 1
