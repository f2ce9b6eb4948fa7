"""What a march of the network needs, and what it gives, as arrays with names."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.errors import SolverError
from lambda_core.electric import columns as L


@dataclass(frozen=True)
class Films:
    """Electrical contacts of one bearing over time, SI; arrays of shape (n, Z, 2), inner then outer.

    Attributes
    ----------
    time : float64[:], shape (n,)
        [s]
    capacitance, conductance : float64[:, :, :]
        [F], [S]
    film : float64[:, :, :]
        Film that decides over breakdown; 0 where there is none [m].
    spots, particles : float64[:, :, :]
        Independent spots in the contact; mean number of particles in it.
    rolled : float64[:, :, :]
        Patches of surface rolled over since the start.
    """

    time: FloatArray
    capacitance: FloatArray
    conductance: FloatArray
    film: FloatArray
    spots: FloatArray
    particles: FloatArray
    rolled: FloatArray


@dataclass(frozen=True)
class Circuit:
    """Everything around the films, SI.

    Attributes
    ----------
    winding : float
        C_wr, winding to rotor [F].
    rotor : float
        Rotor to frame: air gap and the other bearings of the machine [F].
    rings : float
        Inner to outer ring past the balls: rings, cage, seals [F].
    brush : float
        Conductance from the rotor to the frame [S].
    coating, bridge : float
        Outer ring to frame: capacitance [F] and conductance [S]; an infinite conductance joins them.
    """

    winding: float
    rotor: float
    rings: float = 0.0
    brush: float = 0.0
    coating: float = 0.0
    bridge: float = np.inf

    @property
    def insulated(self) -> bool:
        """Whether the outer ring has a potential of its own."""
        return bool(np.isfinite(self.bridge))

    def array(self) -> FloatArray:
        """Return the constants in the order of the compiled code (M_*)."""
        bridge = self.bridge if self.insulated else 0.0
        return np.array([self.winding, self.rotor, self.rings, self.brush, self.coating, bridge])


@dataclass(frozen=True)
class Strength:
    """When films break down, and what burns then, SI.

    Attributes
    ----------
    field, roughness, particle, least_voltage : float
        E_b [V/m]; sigma of the film, 0 for the deterministic field [m]; size of particles [m]; voltage below which
        nothing breaks down [V].
    resistance, fall, least_current : float
        Of an arc [Ohm], [V], [A].
    """

    field: float
    roughness: float
    particle: float
    least_voltage: float
    resistance: float
    fall: float
    least_current: float

    def array(self) -> FloatArray:
        """Return the constants in the order of the compiled code (F_*)."""
        return np.array(
            [
                self.field,
                self.roughness,
                self.particle,
                self.least_voltage,
                self.resistance,
                self.fall,
                self.least_current,
            ]
        )


@dataclass(frozen=True)
class March:
    """What came out of a march.

    Attributes
    ----------
    events : float64[:, :], shape (n, N_EVENT)
        One row per contact that broke down (columns columns.E_*), in the order of time.
    extremes : float64[:, :], shape (samples - 1, 2)
        Smallest and largest bearing voltage between samples; NaN where a discharge spans an interval [V].
    trace : float64[:, :], shape (m, 4)
        Time [s], source [V], bearing voltage [V], arc current [A] at every corner inside the window.
    total : float64[:], shape (N_TOTAL,)
        Sums (columns.T_*).
    """

    events: FloatArray
    extremes: FloatArray
    trace: FloatArray
    total: FloatArray


_FIRST_ROOM = 65536  # events that there is room for at first
_TRACE_ROOM = 20000
_loaded: list[Any] = []


def march(
    films: Films,
    circuit: Circuit,
    strength: Strength,
    source: tuple[FloatArray, FloatArray],
    *,
    seed: int = 0,
    substeps: int = 2,
    window: tuple[float, float] = (np.inf, -np.inf),
    announce: Any = None,
) -> March:
    """March the network through the times of the films, from discharge to discharge.

    Between corners of the source and changes of the capacitances the network is solved exactly by its modes. Charges
    are conserved where capacitances change (d(Cv)/dt, not C dv/dt).

    Parameters
    ----------
    source : tuple of float64[:]
        Corners of the common-mode voltage, times [s] increasing, and volts.
    seed : int
        Key of the random numbers: the same seed gives the same discharges, bit for bit.
    substeps : int
        Intervals of constant capacitance between samples.
    window : tuple of float
        Times between which every corner is recorded [s].

    Raises
    ------
    SolverError
        When the network has no capacitance somewhere, or a discharge does not end.
    """
    from lambda_core.electric.compiled import edges as code

    run = compiled(announce)
    samples, balls, _ = films.capacitance.shape
    size = balls + 2
    tables = [np.ascontiguousarray(a, dtype=np.float64) for a in _tables(films)]
    corners = [np.ascontiguousarray(a, dtype=np.float64) for a in source]
    room = _FIRST_ROOM
    while True:
        events, total = np.zeros((room, L.N_EVENT)), np.zeros(L.N_TOTAL)
        extremes, trace = np.zeros((samples - 1, 2)), np.zeros((_TRACE_ROOM, L.N_TRACE))
        status = run(
            *corners, *tables, circuit.array(), strength.array(), int(circuit.insulated), seed, substeps,
            _longest_step(films), np.zeros((code.N_WORK, size, size)), np.zeros((code.N_VECTORS, size)),
            np.zeros((code.N_HELD, balls, 2)), np.full((balls, 2), -(2**62)), np.zeros((balls, 2, 2)),
            np.zeros((2, L.N_EVENT)), np.zeros((2, 2)), np.zeros(1, dtype=np.int64), extremes, events, trace,
            np.array(window, dtype=np.float64), total,
        )  # fmt: skip
        if status != L.EVENTS_FULL:
            break
        room *= 8
    if status == L.NOT_POSITIVE:
        raise SolverError("the electric network has a node without capacitance")
    if status == L.ENDLESS:
        raise SolverError("a discharge does not end: is the least current of an arc too small?")
    extremes[~np.isfinite(extremes)] = np.nan
    return March(events[: int(total[L.T_EVENTS])].copy(), extremes, trace[: int(total[L.T_TRACE])].copy(), total)


def compiled(announce: Any) -> Any:
    """Return the compiled march, loaded once per process; it is compiled where the disk does not have it."""
    if not _loaded:
        from lambda_core.electric.compiled import edges as code
        from lambda_core.laws.kernels import compile_host

        _loaded.append(compile_host(code.march, code.march_sig, (Path(code.__file__).parent,), announce).dispatcher)
    return _loaded[0]


def _tables(films: Films) -> tuple[FloatArray, ...]:
    return (
        films.time,
        films.capacitance,
        films.conductance,
        films.film,
        films.spots,
        films.particles,
        films.rolled,
    )


def _longest_step(films: Films) -> float:
    """Return a step in which no loaded contact rolls over more than one patch [s]."""
    rate = np.abs(np.diff(films.rolled, axis=0)) / np.diff(films.time)[:, None, None]
    fastest = float(rate[films.film[:-1] > 0.0].max(initial=0.0))
    return 1.0 / fastest if fastest > 0.0 else np.inf
