"""Define the protocol between the run loop and the dynamics."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from lambda_core.domain.channels import Channel
from lambda_core.solver.status import Status
from lambda_core.system.bearing import BearingModel
from lambda_core.system.law_context import max_speed
from lambda_core.system.resolve_solver import SAMPLES_PER_PERIOD

# Enough for ball passes and pocket impacts; each sample costs about three right-hand sides.
SAMPLES_PER_REVOLUTION = 100.0
_MUCH_FASTER = 1.5  # a planned cage speed over that at the start, from which on it counts
_SPIN_FOR_SAMPLES = 1.0  # [rad/s] slowest cage speed that the default sampling interval is made for
FIRST_STEP, SMALLEST_STEP = 1e-7, 1e-14  # [s]
WORK_PER_CALL = 500  # Newton iterations: some hundredths of a second


@dataclass(frozen=True)
class Advance:
    """How one call of :meth:`Engine.advance` ended."""

    ok: bool
    message: str  # a sentence with model, distribution, ball, ring, time and inputs when not ok


def usual_interval(model: BearingModel, orbit: float) -> float:
    """Return the time between samples where none is asked for [s].

    Parameters
    ----------
    model : BearingModel
        With its planned speed, and what is followed.
    orbit : float
        Speed of the cage at the start [rad/s].
    """
    start, g, resolve = abs(orbit), model.geometry, model.solver.resolve
    planned = 0.5 * (1.0 - g.ball_diameter / g.pitch_diameter) * max_speed(model)
    cage_speed = max(start if planned < _MUCH_FASTER * start else planned, _SPIN_FOR_SAMPLES)
    interval = 2.0 * math.pi / cage_speed / SAMPLES_PER_REVOLUTION
    return min(interval, 1.0 / (SAMPLES_PER_PERIOD * resolve)) if resolve else interval


class Timed(Protocol):
    """Something that integrates over time."""

    @property
    def time(self) -> float:
        """Return the start of the next step [s]."""


def drive(
    integrate: Callable[[float], int], engine: Timed, until: float, pause: Callable[[], bool] | None,
    drain: Callable[[], None], fault: Callable[[], str],
) -> Advance:  # fmt: skip
    """Call the compiled integrator until `engine.time` >= `until` [s] or `pause` says so.

    Parameters
    ----------
    integrate : callable
        Takes steps up to a time, for some hundredths of a second; returns a Status.
    drain : callable
        Empties the buffer of samples.
    fault : callable
        Says which law refused.
    """
    status: int = Status.UNFINISHED
    while engine.time < until:
        status = integrate(until)
        if status == Status.BUFFER_FULL:
            drain()
        elif status not in (Status.OK, Status.UNFINISHED):
            break
        if engine.time < until and pause is not None and pause():
            break
    if status in (Status.OK, Status.UNFINISHED, Status.BUFFER_FULL):
        return Advance(True, "")
    if status == Status.REFUSED:
        return Advance(False, fault())
    return Advance(False, f"the time step fell below {SMALLEST_STEP:g} s at t = {engine.time:.6g} s")


class Engine(Protocol):
    """The dynamics of one bearing, started from its quasi-static equilibrium.

    The step sequence does not depend on when `advance` is called or what is sampled, so a
    run continued from `state` is the run that was never interrupted, bit for bit.
    """

    @property
    def channels(self) -> tuple[Channel, ...]:
        """Return what every sample carries."""

    @property
    def time(self) -> float:
        """Return the start of the next step [s]."""

    @property
    def sample_interval(self) -> float:
        """Return the time between samples [s]; by default 1/SAMPLES_PER_REVOLUTION of a nominal cage revolution."""

    def advance(self, until: float, pause: Callable[[], bool] | None = None) -> Advance:
        """Integrate until `time` >= `until` [s]; samples gather in the buffer meanwhile.

        `pause` is called some ten times a second, between two steps on the way there; when it returns True, `advance`
        returns early.
        """

    def samples(self) -> dict[str, NDArray[np.float64]]:
        """Return and clear the buffered samples: channel -> array, first axis is time."""

    def integrals(self) -> dict[str, float]:
        """Return running time integrals from t = 0.

        ``loss.<name>`` for each of LOSSES [J], ``input`` (all external work) [J], ``input_abs``
        (its absolute value) [J], ``drive`` (work of the spin drives) [J], ``stored`` (kinetic and
        elastic energy now minus at the start) [J], ``relative_angle`` (integral of |Omega_i - Omega_o|) [rad],
        ``cage_angle`` (mean cage angle relative to the outer ring; mean of the balls when the cage is off) [rad],
        ``inner_angle`` (inner ring spin angle relative to the outer) [rad],
        ``x``, ``y``, ``z`` (integral of the inner ring's position) [m s].
        """

    def statistics(self) -> dict[str, float]:
        """Return counters: steps, rejected, newton_iterations, rhs_calls, jacobians, factorisations.

        With `steps_to_the_fourth`, the sum of the fourth powers of the steps [s4], and `iteration_work`, the work that
        early ends of Newton's iteration put in or took, counted positive [J].
        """

    def modes(self) -> list[tuple[float, float]]:
        """Return frequency [Hz] and damping ratio of the modes of the rings at `time`."""

    def state(self) -> dict[str, NDArray[np.float64]]:
        """Return everything that a continuation needs."""

    def restore(self, state: Mapping[str, NDArray[np.float64]]) -> None:
        """Continue from what `state` returned."""

    def equilibrium(self) -> Mapping[str, object]:
        """Return the quasi-static solution the run started from (see physics.equilibrium)."""
