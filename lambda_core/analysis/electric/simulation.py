"""Compute voltages and discharges from contacts and options."""

from __future__ import annotations

import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from lambda_core.analysis.electric.circuit import bearing_capacitance, circuit_of, surroundings
from lambda_core.analysis.electric.circuit_integrator import (
    UNCHARGED,
    BearingSolution,
    Circuit,
    CircuitSolution,
    Corners,
    Films,
    Network,
    Strength,
    joined,
)
from lambda_core.analysis.electric.contacts import Contacts, films
from lambda_core.analysis.electric.film_laws import FilmLaw, film_laws
from lambda_core.analysis.electric.voltage_sources import corners, one_period, reach
from lambda_core.case.electric import Electric
from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.errors import UsageError

if TYPE_CHECKING:
    from lambda_core.analysis.electric.circuit_bearing import CircuitBearing
    from lambda_core.analysis.electric.events import Events
    from lambda_core.analysis.electric.outcome import MachineOutcome, Outcome


@dataclass(frozen=True)
class Simulation:
    """One bearing in its circuit over a span of time.

    Attributes
    ----------
    bearing : CircuitBearing
        The bearing and the section of its case.
    contacts, films, circuit
        What the bearing and the circuit of its shaft are.
    number : int
        Of the bearing in the circuit.
    time : float64[:]
        Samples of all bearings in the circuit, between which the solution has extremes [s].
    capacitances : tuple of float
        Mean of the balls of each bearing in the circuit [F].
    source : tuple of float64[:]
        Corners of the common-mode voltage: times [s], volts.
    solution : BearingSolution
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
    number: int
    time: FloatArray
    capacitances: tuple[float, ...]
    source: Corners
    solution: BearingSolution
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
        return float(self.time[-1] - self.time[0])

    @cached_property
    def events(self) -> Events:
        """Films that broke down, one entry each."""
        from lambda_core.analysis.electric.events import events_of

        return events_of(self.solution, self.contacts)

    @cached_property
    def outcome(self) -> Outcome:
        """Outcome in the words of the interface.

        It consists of voltages, discharges and impedance.
        """
        from lambda_core.analysis.electric.outcome import outcome_of

        return outcome_of(self)


@dataclass(frozen=True)
class CircuitSimulation:
    """All bearings of a shaft in one circuit.

    The simulation covers a span of time.

    Attributes
    ----------
    bearings : mapping of str to Simulation
        The same circuit as each bearing sees it, by name.
    solution : CircuitSolution
        What came out for all of them.
    """

    bearings: Mapping[str, Simulation]
    solution: CircuitSolution

    @cached_property
    def outcome(self) -> MachineOutcome:
        """Outcome of shaft and bearings.

        It consists of voltages and discharges in the words of the interface.
        """
        from lambda_core.analysis.electric.outcome import machine_outcome

        return machine_outcome(self)

    @property
    def first(self) -> Simulation:
        """First bearing.

        It is the only one where there are no others.
        """
        return next(iter(self.bearings.values()))


def strength_of(laws: tuple[FilmLaw, FilmLaw], options: Electric, roughness: float) -> Strength:
    """Return the breakdown and discharge laws.

    `roughness` is the composite rms one [m].
    """
    return Strength(*laws, roughness, options.breakdown.least_voltage)


def network_of(bearings: Sequence[CircuitBearing], balls: Sequence[int], announce: Any = None) -> Network:
    """Return the network of the bearings of a shaft, uncharged."""
    options = bearings[0].options
    strengths = [strength_of(film_laws(b.laws, b.contexts, announce), b.options, b.roughness) for b in bearings]
    circuit = circuit_of(options, [surroundings(b.options, b.geometry) for b in bearings])
    return Network(circuit, strengths, balls, seed=options.seed, announce=announce)


def simulate(
    contacts: Contacts,
    bearing: CircuitBearing,
    *,
    settled: float | None = None,
    window: tuple[float, float] | None = None,
    announce: Any = None,
) -> Simulation:
    """Integrate the circuit of a bearing alone; see :func:`simulate_circuit`."""
    return simulate_circuit([contacts], [bearing], settled=settled, window=window, announce=announce).first


def simulate_circuit(
    contacts: Sequence[Contacts],
    bearings: Sequence[CircuitBearing],
    *,
    settled: float | None = None,
    window: tuple[float, float] | None = None,
    announce: Any = None,
) -> CircuitSimulation:
    """Integrate the circuit of a shaft's bearings through their contacts.

    Parameters
    ----------
    contacts : sequence of Contacts
        Of each bearing, over the same span of time.
    bearings : sequence of CircuitBearing
        Source, machine, brush, seed and duration are those of the first.
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
    if window is not None and not window[0] < window[1]:
        raise UsageError(f"window = {window} is not allowed: the first time must be before the second [s]")
    options = bearings[0].options
    electric = [films(each, b.options) for each, b in zip(contacts, bearings, strict=True)]
    together = joined(at_common_times(electric))
    times = together.time
    last, first = times.size, 0
    if settled is not None:
        last = integrated_until(times, reach(options.source)) + 1
        first = int(np.searchsorted(times, settled))
        if last - first < 2:
            origin = contacts[0].origin
            raise UsageError(
                f"{origin}: too short: fewer than two samples are left from {settled:.4g} s on; simulate longer"
            )
    network = network_of(bearings, [each.film.shape[1] for each in electric], announce)
    begin, end = float(times[0]), float(times[-1])
    source = corners(options.source, begin, end + reach(options.source), contacts[0].turned)
    rest = one_period(options.source, begin, contacts[0].turned)
    started, spent = time.perf_counter(), float(times[first] - begin)
    if first > 0:
        network.advance(together.part(slice(0, first + 1)), source, rest=rest)
    rows = slice(first, last)
    recorded = (np.inf, -np.inf) if window is None else window
    found = network.advance(together.part(rows), source, recorded, rest if first == 0 else UNCHARGED)
    wall = time.perf_counter() - started
    times = times[rows]
    length = float(times[-1] - times[0])
    wall *= length / (length + spent)
    if settled is not None:  # bearings of a run have the same samples
        contacts, electric = [each.part(rows) for each in contacts], [each.part(rows) for each in electric]
    capacitances = tuple(float(bearing_capacitance(each).mean()) for each in electric)
    views = {}
    for number, (bearing, mine, each) in enumerate(zip(bearings, contacts, electric, strict=True)):
        angle = mine.inner_angle - mine.outer_angle
        speed = float((angle[-1] - angle[0]) / (mine.time[-1] - mine.time[0]))
        solution = found.of(number, None if np.array_equal(mine.time, times) else mine.time)
        views[bearing.name] = Simulation(
            bearing, mine, each, network.circuit, number, times, capacitances, source, solution, speed, wall
        )
    return CircuitSimulation(views, found)


def at_common_times(each: Sequence[Films]) -> list[Films]:
    """Return the films of bearings at common times.

    The times are all of their times; films are linear between samples.

    Between a sample with a film that may break down and one without there is none, as in the integration.
    """
    first = each[0].time
    if all(np.array_equal(films_.time, first) for films_ in each):
        return list(each)
    times = np.unique(np.concatenate([films_.time for films_ in each]))
    stop = min(float(films_.time[-1]) for films_ in each)
    times = times[(times >= max(float(films_.time[0]) for films_ in each)) & (times <= stop)]
    times = times[np.append(True, np.diff(times) > _APART * (stop - times[0]))]
    return [_resampled(films_, times) for films_ in each]


_APART = 1e-12  # of the span: sample times nearer than this are one


def _resampled(given: Films, times: FloatArray) -> Films:
    i = np.clip(np.searchsorted(given.time, times, side="right") - 1, 0, given.time.size - 2)
    share = ((times - given.time[i]) / (given.time[i + 1] - given.time[i]))[:, None, None]

    def at(values: FloatArray) -> FloatArray:
        return np.asarray((1.0 - share) * values[i] + share * values[i + 1])

    closed = (given.film[i] <= 0.0) | (given.film[i + 1] <= 0.0)
    ends = np.where(share <= 0.0, given.film[i], given.film[i + 1])
    between = np.where(closed, 0.0, at(given.film))
    film = np.where((share <= 0.0) | (share >= 1.0), ends, between)
    return Films(
        time=times,
        capacitance=at(given.capacitance),
        conductance=at(given.conductance),
        film=film,
        thinnest=at(given.thinnest),
        area=at(given.area),
        rolled=at(given.rolled),
    )


def integrated_until(time: FloatArray, margin: float) -> int:
    """Return the last sample for a run's circuit.

    It is `margin` [s] before the newest.
    """
    return int(np.searchsorted(time, time[-1] - margin, side="right")) - 1
