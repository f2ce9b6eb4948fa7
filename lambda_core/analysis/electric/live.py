"""Couple an electric circuit one-way to a running simulation."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from lambda_core.analysis.electric import columns as L
from lambda_core.analysis.electric.circuit import bearing_capacitance
from lambda_core.analysis.electric.circuit_bearing import circuit_bearings
from lambda_core.analysis.electric.circuit_integrator import UNCHARGED, CircuitSolution, joined
from lambda_core.analysis.electric.contacts import CHANNELS, Contacts, contacts_of_samples, films, turned
from lambda_core.analysis.electric.events import events_of
from lambda_core.analysis.electric.film_laws import film_laws
from lambda_core.analysis.electric.simulation import integrated_until, network_of
from lambda_core.analysis.electric.voltage_sources import corners, one_period, reach
from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.section_roles import FILMS
from lambda_core.laws.kernels import sources_key
from lambda_core.model.machine_model import MachineModel
from lambda_core.results.circuit_rows import CircuitRows, circuit_channels, discharge_channels

if TYPE_CHECKING:
    from lambda_core.model.bearing_model import BearingModel
    from lambda_core.results.reader import Result
    from lambda_core.results.run_status import Rows


class Live:
    """The circuit of one run, integrated behind its samples.

    It depends on the samples alone, not on how they are handed over: a run that goes on from a checkpoint hands over
    what it has written, and finds the circuit as it was, bit for bit. It stays behind the newest sample by as much as
    the source has to be known ahead.

    Parameters
    ----------
    model : BearingModel or MachineModel
        With a circuit; all bearings of a machine stand in it.
    announce : callable, optional
        Called with a sentence before something is compiled.
    """

    def __init__(self, model: BearingModel | MachineModel, announce: Any = None) -> None:
        self._bearings, models = circuit_bearings(model), list(model.bearing_models.values())
        self._options = self._bearings[0].options
        self._laws = film_laws(self._bearings[0].laws, self._bearings[0].contexts, announce)
        self._network = network_of(self._bearings, [one.geometry.balls for one in models], announce)
        count = len(models)
        self._columns = [channel.name for channel in circuit_channels(count)]
        self._table = [channel.name for channel in discharge_channels(count)]
        self._waiting: list[Contacts] = []  # from the last sample that was integrated to, of each bearing
        self._known: FloatArray = np.zeros((2, 0))  # times and angles of the rotor from the start, for the source
        self._rolled: list[FloatArray] = []
        self._range, self._broken = np.array([np.inf, -np.inf]), 0

    def keys(self) -> dict[str, str]:
        """Return the code hashes of the circuit.

        The keys are the names of the code that the circuit runs through.
        """
        from lambda_core.analysis.electric.compiled import switching

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

    def take(self, bearings: Mapping[str, Mapping[str, FloatArray]]) -> CircuitRows:
        """Take samples and return the circuit's new results.

        The samples map bearing -> channel -> array; the results are those since the last call.

        Raises
        ------
        SolverError
            When the circuit cannot be solved.
        """
        each = list(bearings.values())
        if not len(each[0]["time"]):
            return self._nothing()
        new = [
            contacts_of_samples(samples, one.roughness, "", of_lines=one.of_lines)
            for samples, one in zip(each, self._bearings, strict=True)
        ]
        earlier: Sequence[Contacts | None] = self._waiting or [None] * len(new)
        self._waiting = waiting = [one.after(before) for one, before in zip(new, earlier, strict=True)]
        turned_by = new[0].inner_angle - new[0].outer_angle
        self._known = np.concatenate([self._known, [new[0].time, turned_by]], axis=1)
        time = waiting[0].time
        last = integrated_until(time, reach(self._options.source))
        if last < 1:
            return self._nothing()
        part = [one.part(slice(0, last + 1)) for one in waiting]
        rolled: Sequence[FloatArray | None] = self._rolled or [None] * len(new)
        parts = [
            films(contacts, one.options, before)
            for contacts, one, before in zip(part, self._bearings, rolled, strict=True)
        ]
        known, angle = self._known
        options, origin = self._options.source, float(known[0])

        def angles(times: FloatArray) -> FloatArray:
            return turned(known, angle, times)

        source = corners(options, float(time[0]), float(time[-1]), angles, origin=origin)
        rest = UNCHARGED if self._rolled else one_period(options, origin, angles)
        solution = self._network.advance(joined(parts), source, rest=rest)
        self._rolled = [one.rolled[-1] for one in parts]
        self._waiting = [one.part(slice(last, None)) for one in waiting]
        self._broken += len(solution.events)
        low, high = np.moveaxis(solution.extremes[:, : len(part)], 2, 0)
        least, largest = self._range
        self._range = np.array(
            [np.fmin.reduce(low, axis=None, initial=least), np.fmax.reduce(high, axis=None, initial=largest)]
        )
        farads = np.stack([bearing_capacitance(one)[1:] for one in parts], axis=1)
        circuit = [time[1 : last + 1], farads, low, high]
        if len(part) > 1:
            circuit += list(solution.extremes[:, -1].T)
        else:
            circuit[1:] = [values[:, 0] for values in circuit[1:]]
        return CircuitRows(dict(zip(self._columns, circuit, strict=True)), self._discharges(solution, part))

    def _nothing(self) -> CircuitRows:
        count = len(self._bearings)
        empty = {name: np.zeros(0) for name in self._columns}
        if count > 1:
            empty |= {channel.name: np.zeros((0, count)) for channel in circuit_channels(count) if channel.dims}
        return CircuitRows(empty, {name: np.zeros(0) for name in self._table})

    def _discharges(self, solution: CircuitSolution, part: Sequence[Contacts]) -> dict[str, FloatArray]:
        """Return the rows of every breakdown.

        They are those of all bearings, in the order of the integration.
        """
        own = [events_of(solution.of(number), contacts) for number, contacts in enumerate(part)]
        found = {
            name: np.concatenate([np.asarray(getattr(events, name), dtype=np.float64) for events in own])
            for name in self._table
            if name != "bearing"
        }
        if len(own) > 1:
            found["bearing"] = np.repeat(np.arange(len(own), dtype=np.float64), [one.time.size for one in own])
            ball = solution.events[:, L.E_BALL]
            first = np.searchsorted(np.cumsum([one.ball_count for one in part]), ball, side="right")
            order = np.empty(ball.size, dtype=np.int64)
            order[np.argsort(first, kind="stable")] = np.arange(ball.size)
            found = {name: values[order] for name, values in found.items()}
        return found

    def catch_up(self, result: Result, rows: Rows) -> None:
        """Take the samples that a run has written.

        The circuit then goes on where it was.

        Raises
        ------
        ResultError
            When the circuit does not come to where it was.
        """
        from lambda_core.results.opening import ResultError

        found = self.take(
            {name: {c: one[c][: rows.samples] for c in CHANNELS} for name, one in result.bearings.items()}
        )
        if (len(found.circuit["time"]), len(found.discharges["time"])) != (rows.circuit, rows.discharges):
            raise ResultError(
                f"{result.path} cannot go on: its circuit does not reproduce the state at which it stopped; "
                "run the case again"
            )
