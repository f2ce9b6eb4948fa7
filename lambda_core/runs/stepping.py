"""Step a run for co-simulation and observation.

No result file is written and nothing is averaged. As long as nobody pushes and steps need not end anywhere, the
dynamics are those of a run with the same longest step, bit for bit.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.errors import SolverError, UsageError, unknown_name
from lambda_core.model.bearing_model import BearingModel
from lambda_core.runs.record_times import next_multiple
from lambda_core.solver.drivers.coupling import MOST_ITERATIONS, MOST_ITERATIONS_PER_SECOND, Coupling, coupled_engine

if TYPE_CHECKING:
    from lambda_core.model.machine_model import MachineModel
    from lambda_core.solver.drivers.compiled_laws import Announce

# What push gives, and the direction in which the ring has to be free.
_PUSHES = {
    "force": {"force_x": "x", "force_y": "y", "force_z": "z"},
    "moment": {"moment_y": "tilt_y", "moment_z": "tilt_z"},
}


@dataclass(frozen=True)
class Step:
    """State at the end of a step.

    It may be that of a bearing or a machine.

    Attributes
    ----------
    time_s : float
        [s]
    channels : mapping of str to float64 array
        Every channel of a result file at this moment, SI: ``channels["load"]`` has shape (balls, 2). Of a machine
        those of shaft, bodies and markers.
    reactions : mapping of str to float64 array
        By body what the bearing puts on it, without its loads, weight and support: force x, y, z [N], moment x, y, z
        about its centre [N m], shape (6,). Of a machine, by bearing what it puts on the shaft.
    friction_torque_Nmm : float
        Dissipated power over the relative speed of the rings, mean over the step; NaN when they do not turn.
    bearings : mapping of str to mapping
        Of a machine, the channels of each bearing by its name.
    """

    time_s: float
    channels: Mapping[str, FloatArray]
    reactions: Mapping[str, FloatArray]
    friction_torque_Nmm: float
    bearings: Mapping[str, Mapping[str, FloatArray]] = field(default_factory=dict)

    def __getitem__(self, name: str) -> FloatArray:
        """Return one channel at this moment.

        UsageError with the nearest names when there is none.
        """
        if name not in self.channels:
            raise UsageError(unknown_name("channel", name, self.channels))
        return self.channels[name]


class Stepping(Iterator[Step]):
    """Steps of one bearing or machine.

    They end at ``solver.duration``, or at ``solver.max_duration``.

    Parameters
    ----------
    model : BearingModel or MachineModel
        Resolved model.
    interval : float, optional
        Time between steps [s]; default: that of the samples of a run, 1/100 of a cage revolution. A step ends with the
        first step of the integrator past a multiple of it; no step of the integrator is longer.
    announce : callable, optional
        Called with a sentence before something is compiled.
    exact : bool
        Steps end at the multiples themselves.
    couple : "force" or "motion"
        Who owns the inner ring's motion: this bearing, pushed by loads, or another program, which gives the poses of
        both rings and takes the reactions. A machine owns its motion.

    Attributes
    ----------
    model : BearingModel or MachineModel
    given : tuple of str
        What :meth:`give` takes.

    Raises
    ------
    UsageError
        When `interval` is no positive time, or the model cannot be coupled so.
    SolverError
        When there is no equilibrium to start from.
    """

    def __init__(
        self,
        model: BearingModel | MachineModel,
        interval: float | None = None,
        announce: Announce | None = None,
        *,
        exact: bool = False,
        couple: Coupling = "force",
    ) -> None:
        if interval is not None and not 0.0 < interval < math.inf:
            raise UsageError(f"the interval between steps is {interval:g} s: it must be positive and finite")
        if interval is not None and not exact:
            model = _in_steps(model, interval)
        self._engine = engine = coupled_engine(model, couple, announce)
        self.model: BearingModel | MachineModel = engine.model
        self.given = engine.inputs.names
        self.interval = interval or self._engine.sample_interval
        self._exact, self._end = exact, model.solver.duration or model.solver.max_duration
        self._before = self._engine.spent()

    @property
    def time_s(self) -> float:
        """Present time of the bearing [s]."""
        return self._engine.time

    def give(self, name: str, value: float, rate: float = 0.0, acceleration: float = 0.0) -> None:
        """Set a load or motion from now on.

        It holds until it is set again.

        Parameters
        ----------
        name : str
            One of :attr:`given`: ``inner_ring.force_z`` [N], ``inner_ring.x`` [m], ``inner_ring.tilt_y`` [rad],
            ``inner_ring.spin`` [rad/s].
        value, rate, acceleration : float
            Now, with its first and second derivative: ``value + rate t + acceleration t^2 / 2`` from here.

        Raises
        ------
        UsageError
            When there is no such signal, or a number is not finite.
        """
        if name not in self.given:
            raise UsageError(unknown_name("signal", name, self.given))
        if not all(map(math.isfinite, (value, rate, acceleration))):
            raise UsageError(f"{name} is given as {value:g}, {rate:g}, {acceleration:g}: all must be finite numbers")
        self._engine.inputs.give(name, value, rate, acceleration, self._engine.time)

    def push(self, force: Sequence[float] = (0.0, 0.0, 0.0), moment: Sequence[float] = (0.0, 0.0)) -> None:
        """Put a load on the inner ring.

        It adds to the loads of the case, from now on until the next call.

        Parameters
        ----------
        force : sequence of float, shape (3,)
            x, y, z [N].
        moment : sequence of float, shape (2,)
            About y and z [N m].

        Raises
        ------
        UsageError
            When a number is not finite, a load points where the inner ring cannot move, or for a machine.
        """
        if not isinstance(self.model, BearingModel):
            raise UsageError(f"a machine has several rings: give a load by its name, {', '.join(self.given[:3])} ...")
        given = {"force": force, "moment": moment}
        for name, axes in _PUSHES.items():
            values = given[name]
            if len(values) != len(axes) or not all(math.isfinite(value) for value in values):
                raise UsageError(f"a {name} on the inner ring has {len(axes)} finite numbers, not {list(values)}")
            for (load, axis), value in zip(axes.items(), values, strict=True):
                mode = self.model.inner_ring.dofs[axis].mode
                if mode == "free":
                    self.give(f"inner_ring.{load}", value)
                elif value != 0.0:
                    raise UsageError(f"the inner ring is {mode} in {axis}: a {name} there does nothing")

    def __iter__(self) -> Stepping:
        return self

    def __next__(self) -> Step:
        """Return the next step.

        SolverError when the integrator cannot go on, as :meth:`step_to`.
        """
        if self.time_s >= self._end:
            raise StopIteration
        return self._go(min(next_multiple(self.time_s, self.interval), self._end), exactly=self._exact)

    def step_to(self, time_s: float) -> Step:
        """Return the step that ends at a time.

        The caller chooses the time, and the step hits it exactly.

        Raises
        ------
        UsageError
            When the time is not ahead.
        SolverError
            When the integrator cannot go on, or gets nowhere under loads or motions that no bearing takes; the bearing
            stands where it stood before the step.
        """
        if not self.time_s < time_s < math.inf:
            raise UsageError(f"a step from {self.time_s:g} s to {time_s:g} s: it must end later than it begins")
        return self._go(time_s, exactly=True)

    def state(self) -> dict[str, NDArray[np.float64]]:
        """Return everything for a continuation from here.

        A caller can look ahead, and :meth:`restore` it.
        """
        return {**self._engine.state(samples=False), "before": np.array(self._before)}

    def restore(self, state: Mapping[str, NDArray[np.float64]]) -> None:
        """Go back to a state of :meth:`state`.

        The steps after it are the same again, bit for bit.
        """
        self._before = (float(state["before"][0]), float(state["before"][1]))
        self._engine.restore({name: part for name, part in state.items() if name != "before"})

    def _go(self, until: float, *, exactly: bool) -> Step:
        engine = self._engine
        before = engine.state(samples=False)
        try:
            self._advance(until, exactly)
            seen = engine.seen()
        except SolverError:
            engine.forget_samples()
            engine.restore(before)
            raise
        engine.forget_samples()
        loss, turned = engine.spent()
        torque = 1e3 * (loss - self._before[0]) / (turned - self._before[1]) if turned > self._before[1] else math.nan
        self._before = loss, turned
        return Step(engine.time, seen.channels, seen.reactions, torque, seen.bearings)

    def _advance(self, until: float, exactly: bool) -> None:
        """Integrate to the end of a step.

        SolverError when the integrator cannot go on or makes no progress.
        """
        engine = self._engine
        begin, before = engine.time, engine.iterations

        def astray() -> bool:
            most = MOST_ITERATIONS + MOST_ITERATIONS_PER_SECOND * (engine.time - begin)
            return engine.iterations - before > most

        advance = (engine.advance_exactly if exactly else engine.advance)(until, astray)
        if not advance.ok:
            raise SolverError(advance.message)
        if engine.time < until:
            pressure = 1e-9 * engine.seen().pressure
            raise SolverError(
                f"at t = {engine.time:.9g} s, on the way to {until:.9g} s, {engine.iterations - before} iterations are "
                f"spent (contact pressure {pressure:.3g} GPa): forces or motions that no bearing takes; are loads in "
                "N, places in m, speeds in rad/s?"
            )


def _in_steps(model: BearingModel | MachineModel, interval: float) -> BearingModel | MachineModel:
    """Return the model with limited steps.

    No step of the integrator is longer than an interval [s].
    """

    def bounded(one: BearingModel) -> BearingModel:
        return replace(one, solver=replace(one.solver, max_step=min(interval, one.solver.max_step)))

    return model.with_each(bounded)
