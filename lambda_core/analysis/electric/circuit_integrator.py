"""Define the input and output arrays of the circuit integrator."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, fields
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np

from lambda_core.analysis.electric import columns as L
from lambda_core.analysis.electric.film_laws import FilmLaw
from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.errors import SolverError
from lambda_core.laws.pack import pack


@dataclass(frozen=True)
class Films:
    """Electrical contacts of bearings over time, SI.

    The arrays have shape (n, Z, 2), with the inner ring first.

    Attributes
    ----------
    time : float64[:], shape (n,)
        [s]
    capacitance, conductance : float64[:, :, :]
        [F], [S]
    film, thinnest : float64[:, :, :]
        Central film where it may break down, 0 elsewhere, and its minimum [m].
    area : float64[:, :, :]
        Hertzian area [m2].
    rolled : float64[:, :, :]
        Patches of surface rolled over since the start.
    """

    time: FloatArray
    capacitance: FloatArray
    conductance: FloatArray
    film: FloatArray
    thinnest: FloatArray
    area: FloatArray
    rolled: FloatArray

    def part(self, rows: slice) -> Films:
        """Return a stretch of the samples."""
        return Films(**{f.name: getattr(self, f.name)[rows] for f in fields(self)})


def joined(films: Sequence[Films]) -> Films:
    """Return the contacts of several bearings together.

    The times are the same; the balls of each bearing follow those before.
    """
    parts = {
        f.name: np.concatenate([getattr(each, f.name) for each in films], axis=1)
        for f in fields(Films)
        if f.name != "time"
    }
    return Films(time=films[0].time, **parts)


@dataclass(frozen=True)
class Surroundings:
    """Everything around the films of one bearing, SI.

    Attributes
    ----------
    rings : float
        Inner to outer ring past the balls: rings, seals [F].
    coating, bridge : float
        Outer ring to frame: capacitance [F] and conductance [S]; an infinite conductance joins them.
    pocket, cage_inner, cage_outer : float
        Of a cage that conducts against each ball, the inner and the outer ring [F]; pocket 0: there is none.
    """

    rings: float = 0.0
    coating: float = 0.0
    bridge: float = np.inf
    pocket: float = 0.0
    cage_inner: float = 0.0
    cage_outer: float = 0.0

    @property
    def insulated(self) -> bool:
        """True if the outer ring has its own potential."""
        return bool(np.isfinite(self.bridge))


@dataclass(frozen=True)
class Circuit:
    """Everything around the films of a shaft's bearings, SI.

    Attributes
    ----------
    winding : float
        C_wr, winding to rotor [F].
    rotor : float
        Rotor to frame: air gap, and bearings that are given by their capacitance alone [F].
    bearings : tuple of Surroundings
        Between the rotor and the frame.
    brush : float
        Conductance from the rotor to the frame [S].
    twins : float
        For each bearing, further ones that are like it, rotor to frame, by their capacitance alone.
    """

    winding: float
    rotor: float
    bearings: tuple[Surroundings, ...] = (Surroundings(),)
    brush: float = 0.0
    twins: float = 0.0

    def constants(self) -> L.CircuitConstants:
        """Return what the compiled integrator reads of rotor and frame."""
        return L.CircuitConstants(self.winding, self.rotor, self.brush, self.twins)

    def bearing_constants(self, strengths: Sequence[Strength]) -> L.BearingConstants:
        """Return what the compiled integrator reads of the bearings."""
        values: dict[str, list[float]] = {name: [] for name in L.BearingConstants._fields}
        for bearing, strength in zip(self.bearings, strengths, strict=True):
            for name in ("rings", "coating", "pocket", "cage_inner", "cage_outer"):
                values[name].append(getattr(bearing, name))
            values["bridge"].append(bearing.bridge if bearing.insulated else 0.0)
            values["roughness"].append(strength.roughness)
            values["least"].append(strength.least_voltage)
        return L.BearingConstants(**{name: np.array(row, dtype=np.float64) for name, row in values.items()})

    def wiring(self, balls: Sequence[int]) -> L.Wiring:
        """Return the nodes of the bearings; `balls` are theirs."""
        insulated = np.array([b.insulated for b in self.bearings])
        ring = np.append(np.where(insulated, np.cumsum(insulated), L.GROUND), L.GROUND)
        bearing = np.repeat(np.arange(len(balls)), balls)
        return L.Wiring(*(a.astype(np.int64) for a in (bearing, ring[bearing], ring)))


@dataclass(frozen=True)
class Strength:
    """Laws of breakdown and discharge.

    Attributes
    ----------
    breakdown, discharge : FilmLaw
        Laws of these roles.
    roughness, least_voltage : float
        Composite rms roughness [m]; voltage below which nothing breaks down [V].
    """

    breakdown: FilmLaw
    discharge: FilmLaw
    roughness: float
    least_voltage: float


@dataclass(frozen=True)
class BearingSolution:
    """Solution of one bearing.

    Attributes
    ----------
    events : float64[:, :], shape (n, N_EVENT)
        One row per contact that broke down (columns columns.E_*), in the order of time.
    extremes : float64[:, :], shape (samples - 1, 2)
        Smallest and largest bearing voltage between samples; NaN where a discharge spans an interval [V].
    trace : float64[:, :], shape (m, 4)
        Time [s], source [V], bearing voltage [V], arc current [A] at every corner inside the window.
    total : float64[:], shape (N_TOTAL,)
        Sums over this stretch of the whole circuit (columns.T_*).
    arc_energy : float
        Heat of the arcs in this bearing [J].
    """

    events: FloatArray
    extremes: FloatArray
    trace: FloatArray
    total: FloatArray
    arc_energy: float


@dataclass(frozen=True)
class CircuitSolution:
    """Result of an integration.

    Attributes
    ----------
    events : float64[:, :], shape (n, N_EVENT)
        As of one bearing, but balls are counted through all bearings.
    extremes : float64[:, :, :], shape (samples - 1, bearings + 1, 2)
        Smallest and largest voltage between samples: of each bearing, and behind them of the shaft [V].
    trace : float64[:, :], shape (m, N_TRACE + bearings + 1)
        Time [s], source [V], arc current [A], then voltages [V] in the order of `extremes`.
    total : float64[:], shape (N_TOTAL,)
        Sums over this stretch (columns.T_*).
    balls : tuple of int
        Of each bearing.
    """

    events: FloatArray
    extremes: FloatArray
    trace: FloatArray
    total: FloatArray
    balls: tuple[int, ...]

    def of(self, bearing: int, times: FloatArray | None = None) -> BearingSolution:
        """Return the solution of one bearing, by number.

        `times` are its samples where they are its own.
        """
        first = sum(self.balls[:bearing])
        ball = self.events[:, L.E_BALL]
        own = (ball >= first) & (ball < first + self.balls[bearing])
        events = self.events[own].copy()
        events[:, L.E_BALL] -= first
        if times is not None:
            interval = np.searchsorted(times, events[:, L.E_TIME], side="right") - 1
            events[:, L.E_SAMPLE] = np.clip(interval, 0, times.size - 2)
        trace = self.trace[:, [0, 1, L.N_TRACE + bearing, 2]]
        heat = self.total[L.T_ARC] if len(self.balls) == 1 else events[:, L.E_ENERGY].sum()
        return BearingSolution(events, self.extremes[:, bearing], trace, self.total, float(heat))


Corners = tuple[FloatArray, FloatArray]  # times [s], volts
UNCHARGED: Corners = (np.zeros(0), np.zeros(0))
_STRETCH = 64  # samples that are integrated at once
_FIRST_ROOM = 4096  # events that there is room for at first
_TRACE_ROOM = 20000
_SUMS = slice(L.T_SOURCE, L.T_ARC_CHARGE + 1)
_loaded: list[Any] = []


class Network:
    """Network of a shaft's bearings.

    It is integrated stretch by stretch, as samples come.

    Between corners of the source and changes of the capacitances the network is solved exactly by its modes. Charges
    are conserved where capacitances change (d(Cv)/dt, not C dv/dt). However the samples are cut into stretches, what
    comes out is the same, bit for bit.

    Parameters
    ----------
    circuit : Circuit
        What surrounds the films.
    strengths : sequence of Strength
        When the films of each bearing break down; all by the same two laws.
    balls : sequence of int
        Of each bearing.
    seed : int
        Key of the random numbers: the same seed gives the same discharges, bit for bit.
    substeps : int
        Intervals of constant capacitance between samples.
    announce : callable, optional
        Called with a sentence before something is compiled.
    """

    def __init__(
        self,
        circuit: Circuit,
        strengths: Sequence[Strength],
        balls: Sequence[int],
        *,
        seed: int = 0,
        substeps: int = 2,
        announce: Any = None,
    ) -> None:
        self._run = integrator_code(announce)
        self._circuit, self._strength, self._seed, self._substeps = circuit, strengths[0], seed, substeps
        self._balls, count = tuple(balls), sum(balls)
        self._bearings, self._wiring = circuit.bearing_constants(strengths), circuit.wiring(balls)
        self._breaks, self._arcs = (
            np.ascontiguousarray(np.concatenate([law.par for law in laws]))
            for laws in zip(*((s.breakdown, s.discharge) for s in strengths), strict=True)
        )
        size = count + 1 + len(self._balls)
        self._nodes = L.Nodes(*np.zeros((len(L.Nodes._fields), size)))
        self._total = np.zeros(L.N_TOTAL)
        self._workspace = (
            L.Part(*np.zeros((len(L.Part._fields), size, size))),
            L.PartNodes(*np.zeros((len(L.PartNodes._fields), size))),
            L.Held(*np.zeros((len(L.Held._fields), count, 2))),
            L.Channels(*np.zeros((len(L.Channels._fields), 2))),
            np.zeros((count, 2), dtype=np.int64),  # known
            np.zeros((count, 2)),  # drawn
            np.zeros(1),  # break_out
            np.zeros(3),  # arc_out
            np.zeros((2, L.N_EVENT)),  # rows
            np.zeros(2 + len(self._balls)),  # stand, and the voltages that a discharge began at
            np.zeros((2, size), dtype=np.int64),  # members
        )
        # On the source; whether a discharge watches other films; rings of its ball; bearings whose voltage has risen.
        self._place = np.zeros(4 + len(self._balls), dtype=np.int64)
        self._full = L.FullNetwork(*np.zeros((len(L.FullNetwork._fields), size, size)))
        self._room = _FIRST_ROOM
        self._began = False

    @property
    def circuit(self) -> Circuit:
        """Circuit around the films."""
        return self._circuit

    @property
    def substeps(self) -> int:
        """Intervals of constant capacitance between samples."""
        return self._substeps

    def held(self) -> dict[str, Any]:
        """Return the compiled integrator's arguments by name.

        They are its workspace, state and laws.
        """
        names = ["part", "own", "held", "state", "known", "drawn", "break_out", "arc_out", "rows", "stand", "members"]
        breaks, arcs = self._strength.breakdown, self._strength.discharge
        return {
            "break_law": breaks.kernel.pointer, "break_par": self._breaks,
            "arc_law": arcs.kernel.pointer, "arc_par": self._arcs, "bearings": self._bearings, "wiring": self._wiring,
            "full": self._full, "nodes": self._nodes, "place": self._place, "total": self._total,
            **dict(zip(names, self._workspace, strict=True)),
        }  # fmt: skip

    @property
    def time(self) -> float:
        """Time that the network has reached [s].

        It is the end of its last stretch, or of a discharge that went on beyond it.
        """
        return float(self._total[L.T_TIME])

    def advance(
        self,
        films: Films,
        source: Corners,
        window: tuple[float, float] = (np.inf, -np.inf),
        rest: Corners = UNCHARGED,
    ) -> CircuitSolution:
        """Integrate through the times of the films.

        The integration goes from discharge to discharge.

        Parameters
        ----------
        films : Films
            Of all bearings (:func:`joined`). Of the first stretch, or from the last sample of the stretch before on.
        source : tuple of float64[:]
            Corners of the common-mode voltage, times [s] increasing, and volts.
        window : tuple of float
            Times between which every corner is recorded [s].
        rest : tuple of float64[:]
            One period of the source, in the first stretch: the network begins with the charges that such periods
            bring back. Default: it begins uncharged.

        Raises
        ------
        SolverError
            When the network has no capacitance somewhere, a discharge does not end, or a law refuses a contact.
        """
        before = self._total.copy()
        self._total[L.T_BEGAN] = self.time if self._began else films.time[0]
        cuts = [*range(0, films.time.size - 1, _STRETCH), films.time.size - 1]
        parts = [
            self._stretch(films.part(slice(cut, end + 1)), source, np.array(window, dtype=np.float64), rest, cut)
            for cut, end in pairwise(cuts)
        ]
        events, extremes, trace = (np.concatenate(kind) for kind in zip(*parts, strict=True))
        total = self._total.copy()
        total[_SUMS] -= before[_SUMS]
        total[L.T_EVENTS], total[L.T_TRACE] = events.shape[0], trace.shape[0]
        if before[L.T_TIME] > 0.0 or before[L.T_SEGMENTS] > 0.0:
            total[L.T_STORED_0], total[L.T_CHARGE_0] = before[L.T_STORED], before[L.T_CHARGE]
        return CircuitSolution(events, extremes, trace, total, self._balls)

    def _stretch(
        self, films: Films, source: Corners, window: FloatArray, rest: Corners, first: int
    ) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Integrate through few samples.

        Repeat it where there was too little room; return events, extremes, record.
        """
        before, charge, potential = self._total.copy(), self._nodes.charge.copy(), self._nodes.potential.copy()
        while True:
            voltages = len(self._balls) + 1
            events, extremes = np.empty((self._room, L.N_EVENT)), np.empty((films.time.size - 1, voltages, 2))
            trace = np.empty((_TRACE_ROOM if window[0] <= window[1] else 0, L.N_TRACE + voltages))
            self._total[:], self._nodes.charge[:], self._nodes.potential[:] = before, charge, potential
            self._total[L.T_EVENTS] = self._total[L.T_TRACE] = 0.0
            self._place[0] = np.searchsorted(source[0][1:-1], self.time if self._began else films.time[0], side="right")
            status = self._integrate(films, rest, source, extremes, events, trace, window)
            if status != L.EVENTS_FULL:
                break
            self._room *= 8
        if status != L.OK:
            raise SolverError(self._fault(status))
        self._began = True
        extremes[~np.isfinite(extremes)] = np.nan
        events = events[: int(self._total[L.T_EVENTS])].copy()
        events[:, L.E_SAMPLE] += first
        return events, extremes, trace[: int(self._total[L.T_TRACE])].copy()

    def _integrate(
        self, films: Films, rest: Corners, source: Corners, extremes: FloatArray, events: FloatArray,
        trace: FloatArray, window: FloatArray,
    ) -> int:  # fmt: skip
        """Call the compiled integrator; return its status."""
        strength = self._strength
        corners = (np.ascontiguousarray(a, dtype=np.float64) for a in (*rest, *source, films.time))
        tables = L.Tables(*(np.ascontiguousarray(getattr(films, name), dtype=np.float64) for name in L.Tables._fields))
        breaks, arcs = strength.breakdown, strength.discharge
        status = self._run(
            int(not self._began), *corners, tables, self._circuit.constants(), self._bearings, self._wiring,
            breaks.kernel.pointer, self._breaks, arcs.kernel.pointer, self._arcs,
            self._seed, self._substeps, self._full, self._nodes, *self._workspace, self._place,
            extremes, events, trace, window, self._total,
        )  # fmt: skip
        return int(status)

    def _fault(self, status: int) -> str:
        """Say why the integration ended."""
        if status == L.NOT_POSITIVE:
            return "the electric network has a node without capacitance"
        if status == L.ENDLESS:
            return "a discharge does not end: is the least current of an arc too small?"
        law = (self._strength.breakdown if status == L.NO_VOLTAGE else self._strength.discharge).law
        if status == L.ARC_STARVED:
            return f"{law.label}: its least current needs more voltage than a film broke down at"
        code = int(self._total[L.T_STATUS])
        return f"{law.label} refuses a contact at t = {self.time:.6g} s: {law.errors.get(code, f'status {code}')}"


def integrate(
    films: Sequence[Films],
    circuit: Circuit,
    strengths: Sequence[Strength],
    source: Corners,
    *,
    seed: int = 0,
    substeps: int = 2,
    window: tuple[float, float] = (np.inf, -np.inf),
    rest: Corners = UNCHARGED,
    announce: Any = None,
) -> CircuitSolution:
    """Integrate a network through the films' times.

    See :class:`Network`.
    """
    balls = [each.film.shape[1] for each in films]
    network = Network(circuit, strengths, balls, seed=seed, substeps=substeps, announce=announce)
    return network.advance(joined(films), source, window, rest)


def integrator_code(announce: Any) -> Any:
    """Return the compiled integrator for calls from Python.

    It comes from the pack of the installation where there is one.
    """
    packed = pack()
    return packed.unit("circuit") if packed else compiled(announce)


def compiled(announce: Any) -> Any:
    """Return the compiled integrator.

    A process loads it once; it is compiled where the disk does not have it.
    """
    if not _loaded:
        from lambda_core.laws.jit.unstable import know_pointers

        know_pointers()

        from lambda_core.analysis.electric.compiled import switching as code
        from lambda_core.laws.kernels import compile_host

        _loaded.append(
            compile_host(code.integrate, code.integrate_sig, (Path(code.__file__).parent,), announce).dispatcher
        )
    return _loaded[0]
