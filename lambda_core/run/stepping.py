"""A run step by step, for programs that look at every step or push the inner ring: co-simulation.

No result file is written and nothing is averaged. As long as nobody pushes, the dynamics are those of a run with the
same longest step, bit for bit.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.channels import LOSSES
from lambda_core.domain.errors import SolverError, UsageError, unknown_name
from lambda_core.run.record_times import next_multiple
from lambda_core.solver.drivers.dynamics import BearingEngine

if TYPE_CHECKING:
    from lambda_core.solver.drivers.compiled_laws import Announce
    from lambda_core.system.bearing import BearingModel

_AXES = {"force": ("x", "y", "z"), "moment": ("tilt_y", "tilt_z")}  # what has to be free to be pushed


@dataclass(frozen=True)
class Step:
    """Where a bearing stands at the end of a step.

    Attributes
    ----------
    time_s : float
        [s]
    channels : mapping of str to float64 array
        Every channel of a result file at this moment, SI: ``channels["load"]`` has shape (balls, 2).
    friction_torque_Nmm : float
        Dissipated power over the relative speed of the rings, mean over the step; NaN when they do not turn.
    """

    time_s: float
    channels: Mapping[str, FloatArray]
    friction_torque_Nmm: float

    def __getitem__(self, name: str) -> FloatArray:
        """Return one channel at this moment; UsageError with the nearest names when there is none."""
        if name not in self.channels:
            raise UsageError(unknown_name("channel", name, self.channels))
        return self.channels[name]


class Stepping(Iterator[Step]):
    """The steps of one bearing; an iterator that ends at ``solver.duration``, or at ``solver.max_duration``.

    Parameters
    ----------
    model : BearingModel
        Resolved model.
    interval : float, optional
        Time between steps [s]; default: that of the samples of a run, 1/100 of a cage revolution. A step ends with the
        first step of the integrator past a multiple of it; no step of the integrator is longer.
    announce : callable, optional
        Called with a sentence before something is compiled.

    Raises
    ------
    UsageError
        When `interval` is no positive time.
    SolverError
        When there is no equilibrium to start from.
    """

    def __init__(self, model: BearingModel, interval: float | None = None, announce: Announce | None = None) -> None:
        if interval is not None and not 0.0 < interval < math.inf:
            raise UsageError(f"{interval:g} s between steps is no time: give a positive number of seconds")
        if interval is not None and interval < model.solver.max_step:
            model = replace(model, solver=replace(model.solver, max_step=interval))
        self.model = model
        self._engine = BearingEngine(model, announce, pushed=True)
        self._load = self._engine.external_load
        self.interval = interval or self._engine.sample_interval
        self._end = model.solver.duration or model.solver.max_duration
        self._before = self._spent()

    @property
    def time_s(self) -> float:
        """Where the bearing stands [s]."""
        return self._engine.time

    def push(self, force: Sequence[float] = (0.0, 0.0, 0.0), moment: Sequence[float] = (0.0, 0.0)) -> None:
        """Put a load on the inner ring, beside those of the case, from now on until the next call.

        Parameters
        ----------
        force : sequence of float, shape (3,)
            x, y, z [N].
        moment : sequence of float, shape (2,)
            About y and z [N m].

        Raises
        ------
        UsageError
            When a number is not finite, or a load points where the inner ring cannot move.
        """
        given = {"force": force, "moment": moment}
        for name, axes in _AXES.items():
            values = given[name]
            if len(values) != len(axes) or not all(math.isfinite(value) for value in values):
                raise UsageError(f"a {name} on the inner ring has {len(axes)} finite numbers, not {list(values)}")
            for axis, value in zip(axes, values, strict=True):
                mode = self.model.inner_ring.dofs[axis].mode
                if value != 0.0 and mode != "free":
                    raise UsageError(f"the inner ring is {mode} in {axis}: a {name} there does nothing")
        self._load[:] = [*force, *moment]

    def __iter__(self) -> Stepping:
        return self

    def __next__(self) -> Step:
        """Return the next step; SolverError when the integrator cannot go on."""
        engine = self._engine
        if engine.time >= self._end:
            raise StopIteration
        advance = engine.advance(min(next_multiple(engine.time, self.interval), self._end))
        if not advance.ok:
            raise SolverError(advance.message)
        channels = engine.now()
        engine.forget_samples()
        loss, turned = self._spent()
        torque = 1e3 * (loss - self._before[0]) / (turned - self._before[1]) if turned > self._before[1] else math.nan
        self._before = loss, turned
        return Step(engine.time, channels, torque)

    def _spent(self) -> tuple[float, float]:
        """Return the dissipated energy [J] and the relative angle of the rings [rad] since the start."""
        integrals = self._engine.integrals()
        return sum(integrals[f"loss.{name}"] for name in LOSSES), integrals["relative_angle"]
