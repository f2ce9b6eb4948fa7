"""Temperatures over time: the network with the losses of the quasi-static point at every moment."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.errors import SolverError
from lambda_core.thermal.feedback import Gain, Loop
from lambda_core.thermal.losses import LossMap, Point

MOMENTS = 181  # that are kept: as a square, closer together at the start
_RELATIVE, _ABSOLUTE = 1e-5, 1e-3  # tolerances of the integrator; absolute [K]


@dataclass(frozen=True)
class Course:
    """What the temperatures do over time.

    Attributes
    ----------
    time : float64[:], shape (m,)
        [s].
    temperatures : float64[:, :], shape (m, n)
        Of the nodes [K].
    points : tuple of Point
        Quasi-static points at these times.
    put_in, taken_out, stored : float
        Heat from the losses and the case, through the held nodes, and in the free ones [J].
    beyond_limit : bool
        Whether a node passed the limit: then the course ends there.
    gain : Gain or None
        Of the loop at that end.
    solved : int
        Quasi-static points that were solved.
    """

    time: FloatArray
    temperatures: FloatArray
    points: tuple[Point, ...]
    put_in: float
    taken_out: float
    stored: float
    beyond_limit: bool
    gain: Gain | None
    solved: int

    @property
    def residual(self) -> float:
        """(put in - taken out - stored) over what was put in."""
        missing = self.put_in - self.taken_out - self.stored
        return missing / self.put_in if self.put_in > 0.0 else 0.0


class _Balance:
    """Right-hand side: temperatures of the free nodes, then the heat put in and taken out so far."""

    def __init__(self, loop: Loop, start: FloatArray) -> None:
        self.loop, self.start = loop, start
        self.map = LossMap(loop.losses, *(float(v) for v in loop.seen(start)))
        self.free = np.isnan(loop.bearing.held)
        density = self.map.at(*loop.seen(start))["density"]
        self.capacity = loop.bearing.capacities(density)[self.free]

    def temperatures(self, state: FloatArray) -> FloatArray:
        """Return the temperatures of all nodes at a state [K]."""
        found = self.loop.bearing.held.copy()
        found[self.free] = state[: self.capacity.size]
        return found

    def point(self, state: FloatArray) -> Point:
        """Return the quasi-static point at a state."""
        return self.map.at(*self.loop.seen(self.temperatures(state)))

    def __call__(self, time: float, state: FloatArray) -> FloatArray:
        temperatures = self.temperatures(state)
        network = self.loop.bearing.network(self.point(state), temperatures)
        storing = network.storing(temperatures)[self.free]
        flows = [float(network.heat.sum()), network.leaving(temperatures)]
        return np.concatenate([storing / self.capacity, flows])

    def limit(self, time: float, state: FloatArray) -> float:
        """Return how far the hottest node is below the limit [K]."""
        return float(self.loop.thermal.limit - state[: self.capacity.size].max())

    limit.terminal = True  # type: ignore[attr-defined]


def warm_up(loop: Loop, duration: float) -> Course:
    """Integrate the temperatures from the start of the case over a time.

    LSODA (Hindmarsh 1983, Petzold 1983: backward differences where the problem is stiff) on the energy balance of the
    nodes; losses between solved quasi-static points are interpolated (:class:`LossMap`).

    Parameters
    ----------
    loop : Loop
        Torque and temperature of the bearing.
    duration : float
        [s].

    Raises
    ------
    SolverError
        When a point on the way has no equilibrium, or the integrator cannot go on, with the time reached.
    CaseError
        When a further node of the case has no heat capacity.
    """
    from scipy.integrate import solve_ivp

    start = loop.bearing.start()
    balance = _Balance(loop, start)
    count = balance.capacity.size
    state = np.concatenate([start[balance.free], [0.0, 0.0]])
    times = duration * np.linspace(0.0, 1.0, MOMENTS) ** 2
    scales = np.concatenate([np.full(count, _ABSOLUTE), np.full(2, _ABSOLUTE * balance.capacity.sum())])
    try:
        found = solve_ivp(
            balance, (0.0, duration), state, "LSODA", times, events=balance.limit, rtol=_RELATIVE, atol=scales
        )
    except SolverError as error:
        raise SolverError(f"{loop.model.name}: the warm-up ended: {error}") from error
    if found.status < 0:
        raise SolverError(f"{loop.model.name}: the warm-up ended at t = {found.t[-1]:.4g} s: {found.message}")
    time, states = np.asarray(found.t), np.asarray(found.y).T
    beyond = bool(found.status == 1)
    if beyond and found.t_events and found.y_events:
        time, states = np.append(time, found.t_events[0]), np.vstack([states, *found.y_events[0]])
    rise = states[-1, :count] - states[0, :count]
    return Course(
        time=time,
        temperatures=np.array([balance.temperatures(state) for state in states]),
        points=tuple(balance.point(state) for state in states),
        put_in=float(states[-1, count]),
        taken_out=float(states[-1, count + 1]),
        stored=float(balance.capacity @ rise),
        beyond_limit=beyond,
        gain=_gain_at(loop, balance.temperatures(states[-1])) if beyond else None,
        solved=loop.losses.count,
    )


def _gain_at(loop: Loop, temperatures: FloatArray) -> Gain | None:
    """Return the gain of the loop at temperatures; None where no point can be solved near them."""
    try:
        point = loop.losses.at(*loop.seen(temperatures))
        return loop.gain(*loop.slopes(point, temperatures))
    except SolverError:
        return None


def rise_time(course: Course, node: int, share: float) -> float:
    """Return when a node has done a share of its change between start and end [s]; NaN where it changes by < 0.1 K."""
    values = course.temperatures[:, node]
    change = float(values[-1] - values[0])
    if abs(change) < 0.1:
        return math.nan
    done = (values - values[0]) / change
    k = int(np.argmax(done >= share))
    if k == 0:
        return 0.0
    part = (share - done[k - 1]) / (done[k] - done[k - 1])
    return float(course.time[k - 1] + part * (course.time[k] - course.time[k - 1]))
