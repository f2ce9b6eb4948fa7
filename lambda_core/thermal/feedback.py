"""The loop of torque and temperature: temperatures -> viscosity and clearance -> loss -> temperatures."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from lambda_core.case.thermal import Thermal
from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.errors import SolverError
from lambda_core.system.bearing import BearingModel
from lambda_core.thermal.bearing_network import BearingNetwork
from lambda_core.thermal.losses import Announce, Losses, Point
from lambda_core.thermal.network import Network

_ZERO_CELSIUS = 273.15
_PARTS = ("inner_ring", "outer_ring", "balls", "shaft", "housing")
_STAND_IN = {"shaft": "inner_ring", "housing": "outer_ring"}  # where the network has no such node
_STEPS = np.array([0.5, 0.5e-6])  # of inlet temperature [K] and clearance [m] for slopes
_NETWORK_ROUNDS = 50  # conductances to the air change as a fourth root of the temperature: some ten suffice
_NETWORK_TOLERANCE = 1e-9  # [K]
_ITERATIONS = 60
_LONGEST = 15.0  # change of a temperature in one iteration [K]
_TOLERANCE = 1e-3  # [K]


@dataclass(frozen=True)
class Gain:
    """How strongly the loop answers: temperatures that one kelvin more, once around, adds at once and for good.

    Below 1 a disturbance dies out; at 1 and above it grows by itself. With the inlet temperature and the clearance as
    the two numbers that go around, the matrix of the loop is d(found)/d(assumed).

    Attributes
    ----------
    viscosity : float
        Entry of the inlet temperature on itself: negative where the loss falls as the oil thins.
    clearance : float
        Entry of the clearance on itself: positive where a bearing that loses clearance heats up and loses more.
    loop : float
        Largest real part of the eigenvalues.
    """

    viscosity: float
    clearance: float
    loop: float

    @property
    def cause(self) -> str:
        """The part of the loop that does most to drive it up."""
        return "clearance" if self.clearance >= self.viscosity else "viscosity"


class Runaway(SolverError):
    """No steady temperatures below the limit: the loop of torque and temperature feeds itself."""

    def __init__(self, message: str, gain: Gain | None) -> None:
        super().__init__(message)
        self.gain = gain


@dataclass(frozen=True)
class Steady:
    """Steady temperatures and everything that belongs to them."""

    temperatures: FloatArray  # of the nodes [K], shape (n,)
    point: Point
    network: Network
    gain: Gain
    iterations: int


class Loop:
    """Torque and temperature of one bearing.

    Parameters
    ----------
    model : BearingModel
        Resolved.
    thermal : Thermal
        Section of its case.
    announce : callable, optional
        Called with a sentence before something is compiled.
    """

    def __init__(self, model: BearingModel, thermal: Thermal, announce: Announce = None) -> None:
        self.bearing = BearingNetwork(model, thermal)
        self.losses = Losses(model, announce)
        self.thermal, self.model = thermal, model

    def seen(self, temperatures: FloatArray) -> FloatArray:
        """Return what the contacts see of the temperatures: inlet temperature [K] and clearance [m]."""
        at = {name: float(temperatures[self.bearing.index(name)]) for name in self.bearing.names}
        warm = {part: at.get(part, at.get(_STAND_IN.get(part, ""), math.nan)) for part in _PARTS}
        mounting = self.model.mounting
        clearance = mounting.clearance(**warm) if mounting is not None else self.model.geometry.clearance
        if self.thermal.inlet == "oil":
            return np.array([at["oil"], clearance])
        return np.array([0.25 * (at["inner_ring"] + at["outer_ring"]) + 0.5 * at["balls"], clearance])

    def answer(self, point: Point, temperatures: FloatArray) -> tuple[FloatArray, Network]:
        """Return the steady temperatures under the losses of a point, from a first guess, and their network.

        Raises
        ------
        SolverError
            When the conductances to the surroundings do not settle.
        """
        for _ in range(_NETWORK_ROUNDS):
            network = self.bearing.network(point, temperatures)
            found = network.steady()
            change = float(np.abs(found - temperatures).max())
            # A bearing without a way out but thin air may overshoot absolute zero on the way.
            temperatures = np.maximum(found, 0.5 * temperatures)
            if change < _NETWORK_TOLERANCE:
                return temperatures, network
        raise SolverError(f"the thermal network does not settle: the last change is {change:.2g} K")

    def slopes(self, point: Point, temperatures: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return d(steady temperatures)/d(seen), shape (n, 2), and d(seen)/d(temperatures), shape (2, n)."""
        base, _ = self.answer(point, temperatures)
        outward = np.empty((base.size, 2))
        for k in range(2):
            moved = np.array([point.inlet, point.clearance])
            moved[k] += _STEPS[k]
            outward[:, k] = (self.answer(self.losses.at(*moved), base)[0] - base) / _STEPS[k]
        here = self.seen(temperatures)
        inward = np.stack([self.seen(temperatures + step) - here for step in np.eye(base.size)], axis=1)
        return outward, inward

    def gain(self, outward: FloatArray, inward: FloatArray) -> Gain:
        """Return the gain of the loop from its two slopes."""
        matrix = inward @ outward
        return Gain(float(matrix[0, 0]), float(matrix[1, 1]), float(np.linalg.eigvals(matrix).real.max()))

    def first_guess(self) -> FloatArray:
        """Return all nodes at the temperature that the case gives the oil, held ones at theirs, shape (n,) [K]."""
        held = self.bearing.held
        return np.where(np.isnan(held), self.model.oil.temperature, held)

    def steady(self, start: FloatArray | None = None) -> Steady:
        """Find steady temperatures.

        Newton's method on the temperatures of the nodes, T = answer(loss(seen(T))), whose Jacobian has rank two. Where
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
                point = self.losses.at(*self.seen(temperatures))
                found, network = self.answer(point, temperatures)
                outward, inward = self.slopes(point, temperatures)
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
                return Steady(found, point, network, gain, iteration)
            step = residual if gain.loop >= 1.0 else np.linalg.solve(np.eye(found.size) - outward @ inward, residual)
            temperatures = temperatures + step * min(1.0, _LONGEST / np.abs(step).max())
            free = np.isnan(self.bearing.held)
            if temperatures[free].max() > self.thermal.limit:
                raise self._beyond(temperatures, strongest or gain)
        raise SolverError(
            f"{self.model.name}: no steady temperatures after {_ITERATIONS} iterations "
            f"(the last one left {np.abs(residual).max():.2g} K)"
        )

    def _beyond(self, temperatures: FloatArray, gain: Gain) -> SolverError:
        free = np.isnan(self.bearing.held)
        hottest = int(np.argmax(np.where(free, temperatures, 0.0)))
        where = (
            f"{self.bearing.names[hottest].replace('_', ' ')} at {temperatures[hottest] - _ZERO_CELSIUS:.0f} degC is "
            f"beyond thermal.limit = {self.thermal.limit - _ZERO_CELSIUS:g} degC"
        )
        if gain.loop >= 1.0:
            return self._runaway(gain, where)
        return Runaway(
            f"{self.model.name}: no steady temperatures below the limit: {where}; the loop of torque and temperature "
            f"does not feed itself (gain {gain.loop:.2f}): the loss is too high for the ways out",
            gain,
        )

    def _runaway(self, gain: Gain, what: str) -> Runaway:
        return Runaway(f"{self.model.name}: {runaway_sentence(gain)}; {what}", gain)


def runaway_sentence(gain: Gain) -> str:
    """Say that a loop runs away and which part of it does."""
    return (
        f"thermal runaway through the {gain.cause}: the gain of the torque-temperature loop is {gain.loop:.2f} "
        f"(1 or more feeds itself; by clearance {gain.clearance:+.2f}, by viscosity {gain.viscosity:+.2f})"
    )
