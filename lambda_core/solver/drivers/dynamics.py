"""Integrate the motion of bearings over time."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.elements import BODIES, CAGE
from lambda_core.domain.errors import SolverError
from lambda_core.model.bearing_model import BearingModel
from lambda_core.solver import records as R
from lambda_core.solver.arrays import bundle as L
from lambda_core.solver.arrays.integrator_memory import Memory, make_memory
from lambda_core.solver.core import Core, core
from lambda_core.solver.drivers.compiled_laws import Announce
from lambda_core.solver.drivers.engine import (
    FIRST_STEP,
    SMALLEST_STEP,
    WORK_PER_CALL,
    Advance,
    usual_interval,
)
from lambda_core.solver.drivers.equilibrium import Equilibrium, fault_sentence, solve
from lambda_core.solver.drivers.external_inputs import ExternalInputs, bearing_inputs, no_inputs
from lambda_core.solver.drivers.modes import ring_modes
from lambda_core.solver.drivers.observation import Scratch
from lambda_core.solver.drivers.readings import (
    BearingReadings,
    Channels,
    MachineSamples,
    ReadBearing,
    Readings,
    Seen,
    Sums,
)
from lambda_core.solver.drivers.row_cages import start_cages
from lambda_core.solver.drivers.solver_context import SolverContext
from lambda_core.solver.drivers.surface_steps import longest_step
from lambda_core.solver.drivers.tables import running
from lambda_core.solver.integrator.tableau import STAGES
from lambda_core.solver.records import CONTACT_CHANNELS
from lambda_core.solver.status import Status

CAPACITY = 512  # samples that the buffer holds
_COUNTERS = (
    "steps", "rejected", "failed", "newton_iterations", "rhs_calls", "jacobians", "ball_jacobians", "factorisations",
    "bypasses",
)  # fmt: skip
_BUFFER = ("sample_t", "sample_y")  # of the memory
# Of the blocks, what is kept from one step to the next; the rest is room to work in.
_BLOCKS = ("a", "b", "c", "d", "d_own", "changed", "newer", "cross", "shared", "parts")
# Of the factors, where the code of rollers is in this process; in another one it is elsewhere.
_ADDRESSES = "factors.rollers"
_INPUTS = ("bodies", "par", "tie_stiffness", "terms", "table")  # tables that say what moves and under what


@dataclass(frozen=True)
class MotionStart:
    """Start of a motion.

    How it is integrated and read.

    Attributes
    ----------
    context : SolverContext
    state : float64[:], shape (size,)
        At t = 0.
    readings : Readings
        What is read of the motion.
    tolerance : float
        Dimensionless; multiplies the scales of the states.
    sample_interval : float
        [s]
    longest_step : float
        [s]
    resolve : float
        Highest frequency that vibrations are followed to [Hz]; 0: averages are the answer.
    modes_until : float, optional
        Highest frequency of the modes that are reported [Hz]; by default those that are damped least are.
    inputs : ExternalInputs
        Loads and motions from another program.
    """

    context: SolverContext
    state: FloatArray
    readings: Readings
    tolerance: float
    sample_interval: float
    longest_step: float
    resolve: float = 0.0
    modes_until: float | None = None
    inputs: ExternalInputs = field(default_factory=no_inputs)


class MotionEngine:
    """The dynamics of an assembly of one or more bearings.

    The step sequence does not depend on when `advance` is called or what is sampled, so a run continued from `state` is
    the run that was never interrupted, bit for bit.

    Parameters
    ----------
    start : MotionStart
    announce : callable, optional
        Called with a sentence before something is compiled.
    capacity : int
        Samples that the buffer holds.

    Attributes
    ----------
    context : SolverContext
        Tables and memory of what moves.
    sample_interval : float
        Time between samples [s].
    inputs : ExternalInputs
        Loads and motions from another program, which may be given between two calls of :meth:`advance`.
    """

    def __init__(self, start: MotionStart, announce: Announce = None, *, capacity: int = CAPACITY) -> None:
        self._core, self.context, self._readings = core(announce), start.context, start.readings
        self.sample_interval, self.inputs, self._modes_until = start.sample_interval, start.inputs, start.modes_until
        self._memory = make_memory(
            start.state, self.context.scale, start.tolerance, self.context.bundle, capacity,
            stages=STAGES if start.resolve else 0,
        )  # fmt: skip
        control, count = self._memory.control, self._memory.count
        control["longest_step"] = start.longest_step
        control["step"] = np.minimum(FIRST_STEP, control["longest_step"])
        control["shortest_step"], control["sample_interval"] = SMALLEST_STEP, self.sample_interval
        count["stale"] = 1
        self._handle = self.context.handle(self._memory)
        self._drained: list[MachineSamples] = []
        self._readings.begin(self._memory.y, self.time)
        self._start_energy = self._energy()

    @property
    def time(self) -> float:
        """Start of the next step [s]."""
        return float(self._memory.control["time"][0])

    @property
    def iterations(self) -> int:
        """Newton iterations since the start."""
        return int(self._memory.count["newton_iterations"][0])

    @property
    def states(self) -> int:
        """Number of states."""
        return int(self._memory.y.size)

    @property
    def bearings(self) -> tuple[ReadBearing, ...]:
        """The bearings, each with its own context."""
        return self._readings.bearings

    def parts(self) -> tuple[Core, SolverContext, Memory, Scratch]:
        """Return what takes steps and reads states.

        Code that takes the steps elsewhere needs them.
        """
        return self._core, self.context, self._memory, Scratch.of(1, self.context)

    def advance(self, until: float, pause: Callable[[], bool] | None = None) -> Advance:
        """Integrate until `time` >= `until` [s].

        It stops earlier where `pause` is true; samples gather in the buffer meanwhile.

        `pause` is called some ten times a second, between two steps on the way there; when it returns True, `advance`
        returns early.
        """
        status: int = Status.UNFINISHED
        while self.time < until:
            status = int(self._core.integrate(self._handle, until, WORK_PER_CALL))
            if status == Status.BUFFER_FULL:
                self._drain()
            elif status not in (Status.OK, Status.UNFINISHED):
                break
            if self.time < until and pause is not None and pause():
                break
        if status in (Status.OK, Status.UNFINISHED, Status.BUFFER_FULL):
            return Advance(True, "")
        if status == Status.REFUSED:
            return Advance(False, fault_sentence(self.context, self.time))
        return Advance(False, f"the time step fell below {SMALLEST_STEP:g} s at t = {self.time:.6g} s")

    def advance_exactly(self, until: float, pause: Callable[[], bool] | None = None) -> Advance:
        """Integrate until `time` == `until` [s].

        Steps on the way there are cut to end at it.
        """
        self._memory.control["stop"] = until
        try:
            return self.advance(until, pause)
        finally:
            self._memory.control["stop"] = math.inf

    def all_samples(self) -> MachineSamples:
        """Return and clear the buffered samples of all bearings."""
        self._drain()
        blocks, self._drained = self._drained, []
        return self._readings.joined(blocks)

    def forget_samples(self) -> None:
        """Empty the buffer of samples."""
        self._memory.count["samples_waiting"] = 0
        self._drained.clear()

    def buffered(self) -> tuple[FloatArray, FloatArray]:
        """Return the buffered samples.

        Times and states that no one has taken yet, shapes (n,) [s] and (n, size).
        """
        n = int(self._memory.count["samples_waiting"][0])
        return self._memory.sample_t[:n].copy(), self._memory.sample_y[:n].copy()

    def _drain(self) -> None:
        """Read the buffered states."""
        times, states = self.buffered()
        if times.size:
            self._memory.count["samples_waiting"] = 0
            self._drained.append(self._readings.sampled(times, states))

    def channels_now(self, number: int = 0) -> Channels:
        """Return every channel of a bearing at `time`."""
        found = self._readings.channels(number, self.time, self._memory.y)
        return {name: values[0] for name, values in found.items()}

    def kept_states(self, number: int = 0) -> FloatArray:
        """Return the contacts' states at `time`.

        They are a bearing's states that laws of the role contact_state keep.
        """
        span, y = self.bearings[number].span, self._memory.y
        first = y.size - self.context.bundle.states.size + span.first_state
        kept: FloatArray = y[first : first + span.states].copy()
        return kept

    def spent(self) -> tuple[float, float]:
        """Return friction loss [J] and angle [rad].

        The relative angle of the rings; both since the start.
        """
        values = self._memory.integrals
        lost = sum(values[: values.size - L.NOT_LOST].tolist())
        return lost, float(running(values)["relative_speed"])

    def _energy(self) -> float:
        """Return kinetic and elastic energy at `time` [J]."""
        bundle = self.context.bundle
        powers = L.power_count(bundle)
        extra, one = np.zeros((1, powers + 2)), np.zeros((1, 1, 3))
        contacts = np.zeros((1, 1, 1, len(CONTACT_CHANNELS)))
        self._core.sample(
            self._handle, np.array([self.time]), self._memory.y.reshape(1, -1), -1.0, contacts, one,
            one.copy(), extra, np.zeros((1, bundle.shared.size)), np.zeros((1, powers)), np.zeros(self.states),
        )  # fmt: skip
        return float(extra[0, 0])  # a records.TOTALS

    def all_integrals(self) -> list[Sums]:
        """Return the running integrals of every bearing.

        They count from the start, see :meth:`BearingReadings.integrals`.
        """
        if self._readings.adds_up_samples:
            self._drain()
        return self._readings.integrals(self._memory.integrals, self._memory.y, self._energy() - self._start_energy)

    def statistics(self) -> dict[str, float]:
        """Return counters of the integrator.

        They are steps, rejected, newton_iterations, rhs_calls, jacobians and so on.

        With `steps_to_the_fourth`, the sum of the fourth powers of the steps [s4], and `iteration_work`, the work that
        early ends of Newton's iteration put in or took, counted positive [J].
        """
        counted = {name: float(self._memory.count[name][0]) for name in _COUNTERS}
        steps, rest = self._memory.control["fourth_powers"][0], running(self._memory.integrals)["iteration"]
        return {**counted, "steps_to_the_fourth": float(steps), "iteration_work": float(rest)}

    def modes(self) -> list[tuple[float, float]]:
        """Return the modes at `time`.

        Each has a frequency [Hz] and a damping ratio; rings, shaft and bodies have most of its energy.
        """
        bundle, blocks = self.context.bundle, self.context.blocks
        return ring_modes(bundle, blocks, self._memory.inertia, until=self._modes_until)

    def fingerprint(self) -> bytes:
        """Return the numbers that identify the motion.

        Another case or code has others.
        """
        tables = [getattr(self.context.bundle, name) for name in _INPUTS]
        start = [self._readings.state()["angles"], np.array([self._start_energy, self.sample_interval])]
        return b"".join(table.tobytes() for table in (*tables, *start))

    def state(self, *, samples: bool = True) -> dict[str, NDArray[np.float64]]:
        """Return everything that a continuation needs.

        It is memory, Jacobian blocks and factors, and the samples that nobody has taken yet; without `samples` no
        buffer.
        """
        waiting = int(self._memory.count["samples_waiting"][0])
        parts: dict[str, NDArray[np.float64]] = {}
        for prefix, group in self._groups().items():
            for name, array in group._asdict().items():
                if not isinstance(array, np.ndarray) or (prefix == "blocks" and name not in _BLOCKS):
                    continue
                if f"{prefix}.{name}" == _ADDRESSES:
                    continue
                if name not in _BUFFER:
                    parts[f"{prefix}.{name}"] = array.copy()
                elif samples:
                    parts[f"{prefix}.{name}"] = array[:waiting].copy()
        parts |= {f"readings.{name}": array for name, array in self._readings.state().items()}
        parts["start_energy"] = np.array([self._start_energy])
        if self.inputs.names:
            parts |= {f"given.{name}": array for name, array in self.inputs.state().items()}
        return parts

    def restore(self, state: Mapping[str, NDArray[np.float64]]) -> None:
        """Continue from what `state` returned.

        Raises
        ------
        SolverError
            When the state is of another model.
        """
        groups, read, given = self._groups(), {}, {}
        for key, saved in state.items():
            prefix, _, name = key.partition(".")
            if key == _ADDRESSES:
                continue
            if prefix == "readings":
                read[name] = saved
            elif prefix == "given":
                given[name] = saved
            elif prefix in groups:
                array = getattr(groups[prefix], name)
                if name in _BUFFER:
                    array = array[: len(saved)]
                if array.shape != saved.shape or array.dtype != saved.dtype:
                    raise SolverError(f"the checkpoint does not fit this model: {key} has shape {saved.shape}")
                array[...] = saved
        self._readings.restore(read)
        self._start_energy = float(state["start_energy"][0])
        if self.inputs.names:
            self.inputs.restore(given)

    def _groups(self) -> dict[str, Any]:
        """Return the memory of a motion.

        The keys are the names that a checkpoint has for it.
        """
        context = self.context
        return {
            "memory": self._memory, "factors": context.factors, "blocks": context.blocks,
            "condensed": context.factors.condensed,
        }  # fmt: skip


class BearingEngine(MotionEngine):
    """The dynamics of one bearing, started from its quasi-static equilibrium.

    Parameters
    ----------
    model : BearingModel
        Resolved model.
    announce : callable, optional
        Called with a sentence before something is compiled.
    equilibrium : Equilibrium, optional
        Start from this instead of solving for it.
    given : sequence of str
        Loads and motions from outside, see :mod:`lambda_core.solver.drivers.external_inputs`.
    capacity : int
        Samples that the buffer holds.

    Attributes
    ----------
    begun : Equilibrium
        That it started from.

    Raises
    ------
    SolverError
        When there is no equilibrium to start from.
    """

    def __init__(
        self,
        model: BearingModel,
        announce: Announce = None,
        equilibrium: Equilibrium | None = None,
        *,
        given: Sequence[str] = (),
        capacity: int = CAPACITY,
    ) -> None:
        self.model = model
        self.begun = equilibrium or solve(model, announce=announce, strict=False)
        super().__init__(bearing_start(self.begun, model, given), announce, capacity=capacity)

    def samples(self) -> Channels:
        """Return and clear the buffered samples."""
        return self.all_samples().bearings[0]

    def integrals(self) -> Sums:
        """Return the running integrals since the start."""
        return self.all_integrals()[0]

    def now(self) -> Channels:
        """Return every channel at `time`."""
        return self.channels_now()

    def reactions(self) -> FloatArray:
        """Return the bearing's reactions on its bodies.

        They are those of the last :meth:`now`; the array has shape (bodies, 6).

        Force x, y, z [N] and moment x, y, z about the body's centre [N m] of all contacts and force elements on it:
        without its loads, weight and support.
        """
        wrenches: FloatArray = self.context.bundle.body_wrenches[: CAGE + 1].view(np.float64).reshape(-1, 6)
        return wrenches.copy()

    def seen(self) -> Seen:
        """Return channels and reactions at `time`."""
        return Seen(self.now(), dict(zip(BODIES, self.reactions(), strict=True)), {})

    def equilibrium(self) -> Mapping[str, object]:
        """Return the quasi-static solution the run started from."""
        e = self.begun
        return {
            "contacts": e.contacts,
            "contact_channels": CONTACT_CHANNELS,
            "losses": e.losses,
            "displacement": e.displacement,
            "orbit": e.orbit,
            "converged": e.converged,
            "relative_speed": e.relative_speed,
        }


def bearing_start(equilibrium: Equilibrium, model: BearingModel, given: Sequence[str] = ()) -> MotionStart:
    """Return the start of a bearing alone.

    Parameters
    ----------
    model : BearingModel
        That of the equilibrium, maybe with other settings of solver and output.
    """
    context = equilibrium.context
    return MotionStart(
        context=context,
        state=initial_state(equilibrium),
        readings=BearingReadings(context),
        tolerance=model.solver.tolerance,
        sample_interval=model.output.interval or usual_interval(model, equilibrium.orbit),
        longest_step=min(model.solver.max_step, longest_step(context)),
        resolve=model.solver.resolve,
        inputs=bearing_inputs(context, given),
    )


def initial_state(equilibrium: Equilibrium) -> FloatArray:
    """Return the initial state of the dynamics.

    It is the equilibrium with every ball at the cage's speed.

    Each cage stands centred on its balls and turns with them; its pockets are where the balls are. That of a
    self-aligning bearing leans with the inner ring, as the rows do.
    """
    context = equilibrium.context
    model = context.model
    y = equilibrium.state.copy()
    balls = L.elements_in(context.bundle, y)
    balls["velocity"][:, 2] = equilibrium.orbit * balls["radius"]
    if model.depth.cage:
        bodies = np.zeros(context.bundle.bodies.size, R.BODY_STATE)
        shared = bodies.view(np.float64)
        shared[context.bundle.active] = context.shared_part(y)
        *_, about_y, about_z = equilibrium.displacement
        leans = (about_z, -about_y) if model.geometry.kind.on_sphere else (0.0, 0.0)
        start_cages(model, bodies, balls, equilibrium.orbit, leans)
        context.shared_part(y)[:] = shared[context.bundle.active]
    return y
