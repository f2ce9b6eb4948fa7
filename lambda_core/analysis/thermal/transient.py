"""Integrate temperatures over time."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from lambda_core.analysis.thermal.feedback import Gain, Loop
from lambda_core.analysis.thermal.losses import LossMap, Point
from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.errors import SolverError

Points = tuple[Point, ...]
PointsAt = Callable[[float, FloatArray], Points]

MOMENTS = 181  # that are kept: as a square, closer together at the start
_RELATIVE, _ABSOLUTE = 1e-5, 1e-3  # tolerances of the integrator; absolute [K]
_FIRST_STEP = 1.0  # between the first two solved points of a machine [s]
_AGREED = 1e-4  # change of the losses at the end of a step that needs no further round
_ROUNDS, _HALVINGS, _GROWTH = 4, 30, 2.0


@dataclass(frozen=True)
class Course:
    """Temperatures over time.

    Attributes
    ----------
    time : float64[:], shape (m,)
        [s].
    temperatures : float64[:, :], shape (m, n)
        Of the nodes [K].
    points : tuple of tuple of Point
        Quasi-static points of the bearings at these times.
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
    points: tuple[Points, ...]
    put_in: float
    taken_out: float
    stored: float
    beyond_limit: bool
    gain: Gain | None
    solved: int

    @property
    def residual(self) -> float:
        """Relative energy residual.

        (put in - taken out - stored) over what was put in.
        """
        missing = self.put_in - self.taken_out - self.stored
        return missing / self.put_in if self.put_in > 0.0 else 0.0


class _Balance:
    """Right-hand side of the thermal equations.

    Temperatures of the free nodes, then the heat put in and taken out so far.
    """

    def __init__(self, loop: Loop, first: Points) -> None:
        self.loop = loop
        self.start = loop.nodes.start()
        self.free = np.isnan(loop.nodes.held)
        self.capacity = loop.nodes.capacities(first)[self.free]

    @property
    def state(self) -> FloatArray:
        """The state at the start."""
        return np.concatenate([self.start[self.free], [0.0, 0.0]])

    def temperatures(self, state: FloatArray) -> FloatArray:
        """Return the temperatures of all nodes at a state [K]."""
        found = self.loop.nodes.held.copy()
        found[self.free] = state[: self.capacity.size]
        return found

    def rates(self, points_at: PointsAt) -> Callable[[float, FloatArray], FloatArray]:
        """Return the rates with the points.

        They hold at a time and temperatures.
        """

        def rate(time: float, state: FloatArray) -> FloatArray:
            temperatures = self.temperatures(state)
            network = self.loop.nodes.network(points_at(time, temperatures), temperatures)
            storing = network.storing(temperatures)[self.free]
            flows = [float(network.heat.sum()), network.leaving(temperatures)]
            return np.concatenate([storing / self.capacity, flows])

        return rate

    def limit(self, time: float, state: FloatArray) -> float:
        """Return the hottest node's margin to the limit [K]."""
        return float(self.loop.thermal.limit - state[: self.capacity.size].max())

    limit.terminal = True  # type: ignore[attr-defined]


def _integrated(
    balance: _Balance, points_at: PointsAt, span: tuple[float, float], state: FloatArray, times: FloatArray
) -> Any:
    """Integrate over a span [s] with LSODA.

    It uses backward differences where the problem is stiff (Hindmarsh 1983, Petzold 1983).
    """
    from scipy.integrate import solve_ivp

    count = balance.capacity.size
    scales = np.concatenate([np.full(count, _ABSOLUTE), np.full(2, _ABSOLUTE * balance.capacity.sum())])
    name = balance.loop.name
    try:
        found = solve_ivp(
            balance.rates(points_at), span, state, "LSODA", times, events=balance.limit, rtol=_RELATIVE, atol=scales
        )
    except SolverError as error:
        raise SolverError(f"{name}: the warm-up ended: {error}") from error
    if found.status < 0:
        raise SolverError(f"{name}: the warm-up ended at t = {found.t[-1]:.4g} s: {found.message}")
    return found


def _with_limit(found: Any) -> tuple[FloatArray, FloatArray]:
    """Return an integration with its limits.

    Times and states, with those at which the limit was passed.
    """
    time, states = np.asarray(found.t), np.asarray(found.y).T
    if found.status == 1 and found.t_events and found.y_events:
        kept = [states] if time.size else []  # none where the limit is passed before the first wanted time
        time, states = np.append(time, found.t_events[0]), np.vstack([*kept, *found.y_events[0]])
    return time, states


def _moments(duration: float) -> FloatArray:
    return duration * np.linspace(0.0, 1.0, MOMENTS) ** 2


def _course(
    balance: _Balance, time: FloatArray, states: FloatArray, points: tuple[Points, ...], *, is_beyond: bool
) -> Course:
    loop, count = balance.loop, balance.capacity.size
    rise = states[-1, :count] - states[0, :count]
    return Course(
        time=time,
        temperatures=np.array([balance.temperatures(state) for state in states]),
        points=points,
        put_in=float(states[-1, count]),
        taken_out=float(states[-1, count + 1]),
        stored=float(balance.capacity @ rise),
        beyond_limit=is_beyond,
        gain=_gain_at(loop, balance.temperatures(states[-1])) if is_beyond else None,
        solved=loop.count,
    )


def warm_up(loop: Loop, duration: float) -> Course:
    """Integrate the temperatures of bearings.

    The integration starts with the temperatures of the case and covers a time.

    Parameters
    ----------
    loop : Loop
        Torque and temperature of the bearings.
    duration : float
        [s].

    Raises
    ------
    SolverError
        When a point on the way has no equilibrium, or the integrator cannot go on, with the time reached.
    CaseError
        When a further node of the case has no heat capacity.
    """
    of_grid = loop.seen(loop.nodes.start()).size == 2
    return _on_grid(loop, duration) if of_grid else _along_course(loop, duration)


def _on_grid(loop: Loop, duration: float) -> Course:
    """Follow a bearing that sees one inlet and one clearance.

    Losses between solved quasi-static points are interpolated (:class:`LossMap`).
    """
    start = loop.seen(loop.nodes.start())
    known = LossMap(lambda *seen: loop.solved(np.array(seen))[0], *start.tolist())
    balance = _Balance(loop, (known.at(*start.tolist()),))

    def points_at(_: float, temperatures: FloatArray) -> Points:
        return (known.at(*loop.seen(temperatures).tolist()),)

    found = _integrated(balance, points_at, (0.0, duration), balance.state, _moments(duration))
    time, states = _with_limit(found)
    points = tuple(points_at(0.0, balance.temperatures(state)) for state in states)
    return _course(balance, time, states, points, is_beyond=found.status == 1)


def _along_course(loop: Loop, duration: float) -> Course:
    """Follow bearings that see more.

    What several bearings see has too many dimensions for a grid. Points are solved along the course instead: between
    two of them, a cell of :class:`LossMap` apart at most, losses are linear in time, and the later one is solved again
    until it is that of the temperatures at its time.
    """
    seen = loop.seen(loop.nodes.start())
    points = loop.solved(seen)
    balance = _Balance(loop, points)
    bearings = len(points)
    cells = np.array([LossMap.INLET] * bearings + [LossMap.CLEARANCE] * (seen.size - bearings))
    moments, time, state = _moments(duration), 0.0, balance.state
    times, states, kept = [np.array([0.0])], [state[None]], [points]
    step, is_beyond = min(_FIRST_STEP, duration), False
    while time < duration and not is_beyond:
        done = _step(balance, (time, min(time + step, duration)), state, seen, points, cells, moments)
        more, reached = _with_limit(done.found)
        is_beyond = done.found.status == 1
        inside = (more > time) & ((more < done.end) | np.isin(more, moments) | is_beyond)
        times.append(more[inside])
        states.append(reached[inside])
        kept += [_between(points, done.points, (t - time) / (done.end - time)) for t in more[inside].tolist()]
        used, time = done.end - time, done.end
        state, seen, points = reached[-1], done.seen, done.points
        step = used * min(_GROWTH, 0.8 / max(done.size, 1e-3))
    return _course(balance, np.concatenate(times), np.vstack(states), tuple(kept), is_beyond=is_beyond)


@dataclass(frozen=True)
class _Step:
    """A step of the course of a machine."""

    found: Any  # of the integrator
    end: float  # [s]
    seen: FloatArray  # at the end
    points: Points  # there
    size: float  # change of what is seen, in cells


def _step(
    balance: _Balance, span: tuple[float, float], state: FloatArray, seen: FloatArray, points: Points,
    cells: FloatArray, moments: FloatArray,
) -> _Step:  # fmt: skip
    """Return a step over a span [s].

    It returns only the first part where more than a cell would be passed.
    """
    loop, (begin, end) = balance.loop, span
    for _ in range(_HALVINGS):
        later = points
        times = np.append(moments[(moments > begin) & (moments < end)], end)
        for _ in range(_ROUNDS):

            def points_at(time: float, _: FloatArray, later: Points = later, end: float = end) -> Points:
                return _between(points, later, (time - begin) / (end - begin))

            found = _integrated(balance, points_at, (begin, end), state, times)
            _, reached = _with_limit(found)
            now = loop.seen(balance.temperatures(reached[-1]))
            size = float((np.abs(now - seen) / cells).max())
            if found.status == 1:
                return _Step(found, end, now, later, size)
            if size > 1.0:
                break
            before, later = later, loop.solved_near(now, is_followed=True)
            if max(abs(b.power - a.power) for a, b in zip(before, later, strict=True)) <= _AGREED * _power(later):
                return _Step(found, end, now, later, size)
        end = 0.5 * (begin + end)
    raise SolverError(f"{loop.name}: the warm-up ended at t = {begin:.4g} s: its losses change without bound")


def _power(points: Points) -> float:
    return sum(point.power for point in points)


def _between(one: Points, other: Points, share: float) -> Points:
    return tuple(a.towards(b, share) for a, b in zip(one, other, strict=True))


def _gain_at(loop: Loop, temperatures: FloatArray) -> Gain | None:
    """Return the gain of the loop at temperatures.

    None where no point can be solved near them.
    """
    try:
        seen = loop.seen(temperatures)
        return loop.gain(*loop.slopes(seen, loop.solved(seen), temperatures))
    except SolverError:
        return None


def rise_time(course: Course, node: int, share: float) -> float:
    """Return the rise time of a node [s].

    It has then done a share of its change between start and end; NaN where it changes by < 0.1 K.
    """
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
