"""From contacts and options to voltages and discharges."""

from __future__ import annotations

import time
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from lambda_core.case.electric import Electric
from lambda_core.domain.arrays import FloatArray
from lambda_core.electric.circuit import circuit_of
from lambda_core.electric.contacts import Contacts, films
from lambda_core.electric.march import Circuit, Films, March, Strength, compiled, march
from lambda_core.electric.sources import corners

if TYPE_CHECKING:
    from collections.abc import Mapping

    from lambda_core.electric.events import Events
    from lambda_core.electric.outcome import Outcome


@dataclass(frozen=True)
class Simulation:
    """The bearing in its circuit over a span of time.

    Attributes
    ----------
    case : str
        Name of the case.
    options : Electric
    contacts, films, circuit
        What the bearing and its circuit are.
    source : tuple of float64[:]
        Corners of the common-mode voltage: times [s], volts.
    march : March
        What came out.
    speed : float
        Of the inner ring against the outer, mean [rad/s].
    wall : float
        Wall time of the march [s].
    """

    case: str
    options: Electric
    contacts: Contacts
    films: Films
    circuit: Circuit
    source: tuple[FloatArray, FloatArray]
    march: March
    speed: float
    wall: float

    @property
    def duration(self) -> float:
        """Time that was computed [s]."""
        return float(self.films.time[-1] - self.films.time[0])

    @cached_property
    def events(self) -> Events:
        """Films that broke down, one entry each."""
        from lambda_core.electric.events import events_of

        return events_of(self)

    @cached_property
    def outcome(self) -> Outcome:
        """Voltages, discharges and impedance in the words of the machine interface."""
        from lambda_core.electric.outcome import outcome_of

        return outcome_of(self)


def strength_of(options: Electric, roughness: float) -> Strength:
    """Return when films break down and what burns then; `roughness` is the composite rms one [m]."""
    law, arc = options.breakdown, options.discharge
    return Strength(
        field=law.strength,
        roughness=0.0 if law.law == "field" else roughness,
        particle=law.particle_size,
        least_voltage=law.least_voltage,
        resistance=arc.resistance,
        fall=arc.voltage,
        least_current=arc.least_current,
    )


def simulate(
    contacts: Contacts,
    options: Electric,
    geometry: Mapping[str, float],
    *,
    case: str = "",
    window: tuple[float, float] | None = None,
    announce: Any = None,
) -> Simulation:
    """March the circuit through the contacts.

    Parameters
    ----------
    case : str
        Name of the case.
    geometry : mapping
        Geometry of the bearing by name, SI.
    window : tuple of float, optional
        Times between which every corner of the voltages is recorded [s]; default: none.

    Raises
    ------
    SolverError
        When the circuit cannot be solved.
    """
    electric = films(contacts, options)
    circuit = circuit_of(options, electric, geometry)
    begin, end = float(contacts.time[0]), float(contacts.time[-1])
    turned = contacts.inner_angle - contacts.outer_angle
    speed = float((turned[-1] - turned[0]) / (end - begin))
    source = corners(options.source, begin, end, speed)
    compiled(announce)
    started = time.perf_counter()
    found = march(
        electric,
        circuit,
        strength_of(options, contacts.roughness),
        source,
        seed=options.seed,
        window=(np.inf, -np.inf) if window is None else window,
        announce=announce,
    )
    return Simulation(case, options, contacts, electric, circuit, source, found, speed, time.perf_counter() - started)
