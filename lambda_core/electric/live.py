"""Couple an electric circuit one-way to a running simulation."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.section_roles import FILMS
from lambda_core.electric.circuit import bearing_capacitance
from lambda_core.electric.circuit_bearing import of_model
from lambda_core.electric.circuit_integrator import UNCHARGED
from lambda_core.electric.contacts import CHANNELS, Contacts, contacts_of_samples, films, turned
from lambda_core.electric.events import events_of
from lambda_core.electric.film_laws import film_laws
from lambda_core.electric.simulation import integrated_until, network_of
from lambda_core.electric.voltage_sources import corners, one_period, reach
from lambda_core.laws.kernels import sources_key
from lambda_core.results.circuit_rows import CIRCUIT, DISCHARGES, CircuitRows

if TYPE_CHECKING:
    from lambda_core.results.reader import Result
    from lambda_core.results.run_status import Rows
    from lambda_core.system.bearing import BearingModel


_NOTHING = CircuitRows({c.name: np.zeros(0) for c in CIRCUIT}, {c.name: np.zeros(0) for c in DISCHARGES})


class Live:
    """The circuit of one run, integrated behind its samples.

    It depends on the samples alone, not on how they are handed over: a run that goes on from a checkpoint hands over
    what it has written, and finds the circuit as it was, bit for bit. It stays behind the newest sample by as much as
    the source has to be known ahead.

    Parameters
    ----------
    model : BearingModel
        With a circuit.
    announce : callable, optional
        Called with a sentence before something is compiled.
    """

    def __init__(self, model: BearingModel, announce: Any = None) -> None:
        bearing = of_model(model)
        self._options = bearing.options
        self._laws = film_laws(bearing.laws, bearing.contexts, announce)
        self._roughness = bearing.roughness
        self._network = network_of([bearing], [model.geometry.balls], announce)
        self._waiting: Contacts | None = None  # from the last sample that was integrated to
        self._known: FloatArray = np.zeros((2, 0))  # times and angles of the rotor from the start, for the source
        self._rolled: FloatArray | None = None
        self._range, self._broken = np.array([np.inf, -np.inf]), 0

    def keys(self) -> dict[str, str]:
        """Return names and hashes of the code that the circuit runs through."""
        from lambda_core.electric.compiled import switching

        found = {f"{film}/{law.law.role}/{law.law.name}": law.kernel.key for law in self._laws for film in FILMS}
        return {**found, "electric": sources_key(Path(switching.__file__).parent)}

    @property
    def voltage(self) -> tuple[float, float] | None:
        """Smallest and largest voltage of the bearing so far [V]."""
        low, high = self._range
        return (float(low), float(high)) if low <= high else None

    @property
    def rate(self) -> float | None:
        """Films that broke down per second so far."""
        return self._broken / self._network.time if self._network.time > 0.0 else None

    def take(self, samples: Mapping[str, FloatArray]) -> CircuitRows:
        """Take samples, channel -> array; return what the circuit has done since it was last asked.

        Raises
        ------
        SolverError
            When the circuit cannot be solved.
        """
        if not len(samples["time"]):
            return _NOTHING
        new = contacts_of_samples(samples, self._roughness, "")
        self._waiting = waiting = new.after(self._waiting)
        self._known = np.concatenate([self._known, [new.time, new.inner_angle - new.outer_angle]], axis=1)
        last = integrated_until(waiting.time, reach(self._options.source))
        if last < 1:
            return _NOTHING
        part = waiting.part(slice(0, last + 1))
        parts = films(part, self._options, self._rolled)
        known, angle = self._known
        options, origin = self._options.source, float(known[0])

        def angles(times: FloatArray) -> FloatArray:
            return turned(known, angle, times)

        source = corners(options, float(part.time[0]), float(waiting.time[-1]), angles, origin=origin)
        rest = one_period(options, origin, angles) if self._rolled is None else UNCHARGED
        solution = self._network.advance(parts, source, rest=rest).of(0)
        events = events_of(solution, part)
        self._rolled, self._waiting = parts.rolled[-1], waiting.part(slice(last, None))
        self._broken += events.time.size
        low, high = solution.extremes.T
        least, largest = self._range
        self._range = np.array([np.fmin.reduce(low, initial=least), np.fmax.reduce(high, initial=largest)])
        circuit = (part.time[1:], bearing_capacitance(parts)[1:], *solution.extremes.T)
        return CircuitRows(
            {channel.name: values for channel, values in zip(CIRCUIT, circuit, strict=True)},
            {channel.name: np.asarray(getattr(events, channel.name), dtype=np.float64) for channel in DISCHARGES},
        )

    def catch_up(self, result: Result, rows: Rows) -> None:
        """Take the samples that a run has written, so that the circuit goes on where it stood.

        Raises
        ------
        ResultError
            When the circuit does not come to where it was.
        """
        from lambda_core.results.opening import ResultError

        found = self.take({name: result[name][: rows.samples] for name in CHANNELS})
        if (len(found.circuit["time"]), len(found.discharges["time"])) != (rows.circuit, rows.discharges):
            raise ResultError(f"{result.path} cannot go on: its circuit does not come to the state that it was left in")
