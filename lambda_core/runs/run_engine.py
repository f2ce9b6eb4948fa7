"""Adapt the dynamics of bearings and machines to runs."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, Protocol

import numpy as np
from numpy.typing import NDArray

from lambda_core.domain.channels import Channel
from lambda_core.domain.elements import ALONE
from lambda_core.model.laws.state_channels import element_channels, result_channels
from lambda_core.results.samples import TIME, RunChannels, Samples

if TYPE_CHECKING:
    from lambda_core.solver.drivers.dynamics import MotionEngine
    from lambda_core.solver.drivers.engine import Advance

# Of shaft and bodies; bearings have their own.
MACHINE_CHANNELS = (
    Channel("shaft_position", ("lump", "axis"), "m", "displacement of the shaft at every lump"),
    Channel("shaft_tilt", ("lump", "tilt"), "rad", "tilt of the shaft at every lump about y and z"),
    Channel("shaft_twist", ("lump",), "rad", "turn of the shaft at every lump beyond that of the coupling"),
    Channel("body_position", ("body", "axis"), "m", "displacement of every other body"),
    Channel("body_tilt", ("body", "axis"), "rad", "rotation of every other body about x, y and z"),
    Channel("marker_position", ("marker", "axis"), "m", "displacement of every named place"),
    Channel("reaction_force", ("bearing", "axis"), "N", "force of every bearing on the shaft"),
    Channel("reaction_moment", ("bearing", "axis"), "N m", "moment of every bearing on the shaft about its centre"),
    Channel("power_loss", (), "W", "power that all bearings dissipate"),
    *element_channels("connection", "connection by a law"),
)


class RunEngine(Protocol):
    """Dynamics of a machine for the run loop.

    It has one or more bearings.

    The step sequence does not depend on when `advance` is called or what is sampled, so a
    run continued from `state` is the run that was never interrupted, bit for bit.
    """

    @property
    def channels(self) -> RunChannels:
        """Return what every sample carries."""

    @property
    def time(self) -> float:
        """Return the start of the next step [s]."""

    @property
    def sample_interval(self) -> float:
        """Return the time between samples [s]."""

    def advance(self, until: float, pause: Callable[[], bool] | None = None) -> Advance:
        """Integrate until `time` >= `until` [s].

        It stops earlier where `pause` is true; samples gather meanwhile.
        """

    def samples(self) -> Samples:
        """Return and clear the buffered samples."""

    def integrals(self) -> dict[str, dict[str, float]]:
        """Return the running integrals by bearing.

        See :class:`BearingReadings`.
        """

    def statistics(self) -> dict[str, float]:
        """Return counters of the integrator.

        They count from the start and include those of a restored state.
        """

    def modes(self) -> list[tuple[float, float]]:
        """Return the modes at `time`.

        Each has a frequency [Hz] and a damping ratio.
        """

    def state(self) -> dict[str, NDArray[np.float64]]:
        """Return everything that a continuation needs."""

    def restore(self, state: Mapping[str, NDArray[np.float64]]) -> None:
        """Continue from what `state` returned."""


class BearingsInMotion:
    """Dynamics of one or more bearings for the run loop."""

    def __init__(self, engine: MotionEngine) -> None:
        self._engine = engine
        self._names = [one.name or ALONE for one in engine.bearings]
        models = [one.context.model for one in engine.bearings]
        each = {n: without_time(result_channels(model)) for n, model in zip(self._names, models, strict=True)}
        is_alone = not engine.bearings[0].name
        self.channels = RunChannels(() if is_alone else MACHINE_CHANNELS, each)
        self.advance, self.statistics, self.modes = engine.advance, engine.statistics, engine.modes
        self.state, self.restore, self.sample_interval = engine.state, engine.restore, engine.sample_interval

    @property
    def time(self) -> float:
        """Start of the next step [s]."""
        return self._engine.time

    def samples(self) -> Samples:
        """Return and clear the buffered samples."""
        found = self._engine.all_samples()
        time = (found.machine or found.bearings[0])[TIME]
        return Samples(time, found.machine, dict(zip(self._names, found.bearings, strict=True)))

    def integrals(self) -> dict[str, dict[str, float]]:
        """Return the running integrals of every bearing by its name."""
        return dict(zip(self._names, self._engine.all_integrals(), strict=True))


def without_time(channels: tuple[Channel, ...]) -> tuple[Channel, ...]:
    """Return channels except the time.

    All channels of a run share the time.
    """
    return tuple(channel for channel in channels if channel.name != TIME)
