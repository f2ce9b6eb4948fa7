"""Solve the loop of temperatures, viscosity, clearance and loss.

It is the same for one bearing and for all bearings of a machine.
"""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Protocol

import numpy as np

from lambda_core.analysis.thermal.losses import Point
from lambda_core.analysis.thermal.machine_network import MachineNetwork
from lambda_core.analysis.thermal.network import Network
from lambda_core.case.thermal import Thermal
from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.errors import SolverError
from lambda_core.model.bearing_model import BearingModel

if TYPE_CHECKING:
    from lambda_core.model.machine_model import MachineModel

_ZERO_CELSIUS = 273.15
PARTS = ("inner_ring", "outer_ring", "balls", "shaft", "housing")
_STAND_IN = {"shaft": "inner_ring", "housing": "outer_ring"}  # where the network has no such node
INLET_STEP, LENGTH_STEP = 0.5, 0.5e-6  # of inlet temperatures [K], of clearances and growth [m], for slopes
_NETWORK_ROUNDS = 50  # conductances to the air change as a fourth root of the temperature: some ten suffice
_UNDAMPED = 15  # after them each round goes half way: in red heat, radiation swings the temperatures to and fro
_NETWORK_TOLERANCE = 1e-9  # [K]
_ITERATIONS = 60
_LONGEST = 15.0  # change of a temperature in one iteration [K]
_TOLERANCE = 1e-3  # [K]


@dataclass(frozen=True)
class Gain:
    """Gain of the torque-temperature loop.

    It is the answer to one kelvin more, as the first increment of temperatures and the sum of all.

    Below 1 a disturbance dies out; at 1 and above it grows by itself. With the inlet temperatures and the clearances
    as the numbers that go around, the matrix of the loop is d(found)/d(assumed).

    Attributes
    ----------
    viscosity : float
        Entry of an inlet temperature on itself: negative where the loss falls as the oil thins; the largest one.
    clearance : float
        Entry of a clearance on itself: positive where a bearing that loses clearance heats up and loses more; in a
        machine also of the growth of shaft and housing; the largest one.
    loop : float
        Largest real part of the eigenvalues.
    """

    viscosity: float
    clearance: float
    loop: float

    @property
    def cause(self) -> str:
        """Largest contribution to the loop's gain."""
        return "clearance" if self.clearance >= self.viscosity else "viscosity"


class Runaway(SolverError):
    """Runaway of torque and temperature.

    The loop has no steady temperatures below the limit.
    """

    def __init__(self, message: str, gain: Gain | None) -> None:
        super().__init__(message)
        self.gain = gain


@dataclass(frozen=True)
class Steady:
    """Steady temperatures and everything that belongs to them.

    Attributes
    ----------
    temperatures : float64[:], shape (n,)
        Of the nodes [K].
    points : tuple of Point
        Of each bearing.
    network : Network
        With the heat and the conductances there.
    gain : Gain
        Of the loop.
    iterations : int
        Of Newton's method.
    outward, inward : float64[:, :], shapes (n, m) and (m, n)
        d(temperatures)/d(seen) and d(seen)/d(temperatures), see :meth:`Loop.slopes`.
    """

    temperatures: FloatArray
    points: tuple[Point, ...]
    network: Network
    gain: Gain
    iterations: int
    outward: FloatArray
    inward: FloatArray


def clearance_at(model: BearingModel, at: Mapping[str, float]) -> float:
    """Return the operating clearance of a bearing [m].

    It holds at temperatures of its own nodes [K].
    """
    warm = {part: at.get(part, at.get(_STAND_IN.get(part, ""), math.nan)) for part in PARTS}
    return model.mounting.clearance(**warm) if model.mounting is not None else model.geometry.clearance


def degrees(temperature: float) -> str:
    """Write a temperature [K] as in a case."""
    return f"{temperature - _ZERO_CELSIUS:.4f} degC"


def stated_clearance(models: Iterable[BearingModel]) -> list[str]:
    """Return the assumption about clearances that no fit changes."""
    stated = any(model.mounting is not None and not model.mounting.shaft for model in models)
    return ["the stated clearance is that of the mounted bearing at the reference temperature"] if stated else []


def inlet_at(thermal: Thermal, at: Mapping[str, float]) -> float:
    """Return the oil's inlet temperature at contacts [K]."""
    if thermal.inlet == "oil":
        return at["oil"]
    return 0.25 * (at["inner_ring"] + at["outer_ring"]) + 0.5 * at["balls"]


class OnShaft(Protocol):
    """A bearing on a shaft."""

    @property
    def name(self) -> str:
        """Name in the machine."""

    @property
    def model(self) -> BearingModel:
        """The bearing."""

    @property
    def position(self) -> float:
        """Place on the shaft [m]."""


class Loop(ABC):
    """Torque and temperature of the bearings in one network.

    Parameters
    ----------
    name : str
        Of the case.
    nodes : MachineNetwork
        The network.
    thermal : Thermal
        Section of the case.
    oil : float
        Temperature of all nodes that the search starts with [K].

    Attributes
    ----------
    bearings : tuple of OnShaft
        From left to right.
    shaft : tuple of (str, float)
        Nodes of the shaft and their places [m].
    speed : float
        Of the shaft at t = 0 [rad/s].
    of_network, of_case : list of str
        Assumptions.
    """

    bearings: tuple[OnShaft, ...]
    shaft: tuple[tuple[str, float], ...]
    speed: float
    of_network: list[str]
    of_case: Sequence[str]

    def __init__(self, name: str, nodes: MachineNetwork, thermal: Thermal, oil: float) -> None:
        self.name, self.nodes, self.thermal, self._oil = name, nodes, thermal, oil
        self.steps = np.array([INLET_STEP, LENGTH_STEP])

    @abstractmethod
    def seen(self, temperatures: FloatArray) -> FloatArray:
        """Return what the contacts see of the temperatures, shape (m,).

        First the inlet temperature of each bearing [K], then the lengths that temperatures change [m].
        """

    @abstractmethod
    def solved(self, seen: FloatArray) -> tuple[Point, ...]:
        """Solve the quasi-static points and return one for each bearing.

        Raises
        ------
        SolverError
            When there is no equilibrium there, with the place.
        """

    def solved_near(self, seen: FloatArray, *, is_followed: bool = False) -> tuple[Point, ...]:
        """Solve the points near the last ones; see :meth:`solved`.

        Those that are followed are the last ones from then on.
        """
        del is_followed
        return self.solved(seen)

    @abstractmethod
    def points_of(self, model: BearingModel | MachineModel) -> tuple[Point, ...]:
        """Return each bearing's point at a model's own temperatures."""

    @abstractmethod
    def grown(self, at: Mapping[str, float]) -> FloatArray:
        """Return the shaft's growth beyond the housing [m].

        There is one value for each bearing, at temperatures of the nodes [K].
        """

    @abstractmethod
    def model_at(self, found: Steady, sentence: str = "", *, is_static: bool = True) -> BearingModel | MachineModel:
        """Return the model at found temperatures.

        Its case has them, and says so in a sentence.

        Parameters
        ----------
        is_static : bool
            Whether the model is for an equilibrium, which needs no end in time.
        """

    @abstractmethod
    def words(self, found: Steady) -> str:
        """Return the temperatures that count [degC]."""

    def sentence(self, found: Steady) -> str:
        """Say which temperatures were found."""
        return f"temperatures found by the thermal network ({self.thermal.conductances}): {self.words(found)} degC"

    @abstractmethod
    def headline(self, points: Sequence[Point]) -> str:
        """Return the lines that say what has these points."""

    @property
    @abstractmethod
    def count(self) -> int:
        """Quasi-static points that were solved."""

    @abstractmethod
    def nodes_with(self, change: Callable[[Thermal], Thermal]) -> MachineNetwork:
        """Return the network with a changed section of the case."""

    @property
    @abstractmethod
    def usual_area(self) -> float:
        """Outer surface of a usual housing [m2]."""

    def answer(
        self, points: Sequence[Point], temperatures: FloatArray, nodes: MachineNetwork | None = None
    ) -> tuple[FloatArray, Network]:
        """Return the steady temperatures under given losses.

        The points give the losses; the search starts from a first guess, with their network.

        Parameters
        ----------
        nodes : MachineNetwork, optional
            Other conductances than those of the loop.

        Raises
        ------
        SolverError
            When the conductances to the surroundings do not settle.
        """
        for completed in range(_NETWORK_ROUNDS):
            network = (nodes or self.nodes).network(points, temperatures)
            found = network.steady()
            change = float(np.abs(found - temperatures).max())
            if completed >= _UNDAMPED:
                found = 0.5 * (found + temperatures)
            # A bearing without a way out but thin air may overshoot absolute zero on the way.
            temperatures = np.maximum(found, 0.5 * temperatures)
            if change < _NETWORK_TOLERANCE:
                return temperatures, network
        raise SolverError(f"the thermal network does not settle: the last change is {change:.2g} K")

    def slopes(
        self, seen: FloatArray, points: Sequence[Point], temperatures: FloatArray
    ) -> tuple[FloatArray, FloatArray]:
        """Return the slopes of steady temperatures and inputs.

        They are d(steady temperatures)/d(seen), shape (n, m), and d(seen)/d(temperatures), shape (m, n).
        """
        base, _ = self.answer(points, temperatures)
        outward = np.empty((base.size, seen.size))
        for k, step in enumerate(self.steps):
            moved = seen.copy()
            moved[k] += step
            outward[:, k] = (self.answer(self.solved_near(moved), base)[0] - base) / step
        return outward, self.inward(temperatures)

    def inward(self, temperatures: FloatArray) -> FloatArray:
        """Return d(seen)/d(temperatures), shape (m, n)."""
        here = self.seen(temperatures)
        return np.stack([self.seen(temperatures + step) - here for step in np.eye(temperatures.size)], axis=1)

    def gain(self, outward: FloatArray, inward: FloatArray) -> Gain:
        """Return the gain of the loop from its two slopes."""
        matrix, bearings = inward @ outward, len(self.nodes.bearings)
        own = np.diag(matrix)
        loop = float(np.linalg.eigvals(matrix).real.max())
        return Gain(float(own[:bearings].max()), float(own[bearings:].max()), loop)

    def first_guess(self) -> FloatArray:
        """Return the first guess of all temperatures [K].

        It is the case's oil temperature, and held nodes have theirs; the array has shape (n,).
        """
        held = self.nodes.held
        return np.where(np.isnan(held), self._oil, held)

    def steady(self, start: FloatArray | None = None) -> Steady:
        """Find steady temperatures.

        Newton's method on the temperatures of the nodes, T = answer(loss(seen(T))), whose Jacobian beyond the identity
        has the rank of what is seen. Where
        the gain of the loop is 1 or more Newton's step would lead to an unstable state; there the temperatures go
        where the bearing itself would go.

        Raises
        ------
        Runaway
            When temperatures pass the limit, or the state found is unstable; with the gain that caused it.
        SolverError
            When a point has no equilibrium, or the iteration does not end.
        """
        temperatures = self.first_guess() if start is None else start.copy()
        strongest: Gain | None = None
        for iteration in range(1, _ITERATIONS + 1):
            try:
                seen = self.seen(temperatures)
                points = self.solved(seen)
                found, network = self.answer(points, temperatures)
                outward, inward = self.slopes(seen, points, temperatures)
            except Runaway:
                raise
            except SolverError as error:
                if strongest is not None and strongest.loop >= 1.0:
                    raise self._runaway(strongest, f"the last point that was tried: {error}") from error
                raise
            gain = self.gain(outward, inward)
            if gain.loop >= 1.0 and (strongest is None or strongest.loop < 1.0):
                strongest = gain
            residual = found - temperatures
            if np.abs(residual).max() < _TOLERANCE:
                if gain.loop >= 1.0:
                    raise self._runaway(gain, "the only steady state that was found is unstable")
                return Steady(found, points, network, gain, iteration, outward, inward)
            step = residual if gain.loop >= 1.0 else np.linalg.solve(np.eye(found.size) - outward @ inward, residual)
            temperatures = temperatures + step * min(1.0, _LONGEST / np.abs(step).max())
            free = np.isnan(self.nodes.held)
            if temperatures[free].max() > self.thermal.limit:
                raise self._beyond(temperatures, strongest or gain)
        raise SolverError(
            f"{self.name}: no steady temperatures after {_ITERATIONS} iterations "
            f"(the last one left {np.abs(residual).max():.2g} K)"
        )

    def _beyond(self, temperatures: FloatArray, gain: Gain) -> SolverError:
        free = np.isnan(self.nodes.held)
        hottest = int(np.argmax(np.where(free, temperatures, 0.0)))
        where = (
            f"{self.nodes.names[hottest].replace('_', ' ')} at {temperatures[hottest] - _ZERO_CELSIUS:.0f} degC is "
            f"beyond thermal.limit = {self.thermal.limit - _ZERO_CELSIUS:g} degC"
        )
        if gain.loop >= 1.0:
            return self._runaway(gain, where)
        return Runaway(
            f"{self.name}: no steady temperatures below the limit: {where}; the loop of torque and temperature "
            f"does not feed itself (gain {gain.loop:.2f}): the loss is too high for the ways out",
            gain,
        )

    def _runaway(self, gain: Gain, what: str) -> Runaway:
        return Runaway(f"{self.name}: {runaway_sentence(gain)}; {what}", gain)


def runaway_sentence(gain: Gain) -> str:
    """Return the sentence about a runaway.

    It names the part of the loop that causes it.
    """
    return (
        f"thermal runaway through the {gain.cause}: the gain of the torque-temperature loop is {gain.loop:.2f} "
        f"(1 or more feeds itself; by clearance {gain.clearance:+.2f}, by viscosity {gain.viscosity:+.2f})"
    )
