"""The dynamics of one bearing: the compiled integrator behind the Engine protocol."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.channels import LOSSES, SHORTED
from lambda_core.domain.elements import CAGE
from lambda_core.domain.errors import SolverError
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
    drive,
    usual_interval,
)
from lambda_core.solver.drivers.equilibrium import Equilibrium, fault_sentence, solve
from lambda_core.solver.drivers.given import make_room
from lambda_core.solver.drivers.modes import ring_modes
from lambda_core.solver.drivers.observation import Scratch, channels_of
from lambda_core.solver.drivers.ring_values import losses_by_ring
from lambda_core.solver.drivers.solver_context import SolverContext
from lambda_core.solver.drivers.surface_steps import longest_step
from lambda_core.solver.drivers.tables import running
from lambda_core.solver.integrator.tableau import STAGES
from lambda_core.solver.records import CONTACT_CHANNELS
from lambda_core.system.bearing import BearingModel
from lambda_core.system.state_channels import result_channels

_CAPACITY = 512
_COUNTERS = (
    "steps",
    "rejected",
    "failed",
    "newton_iterations",
    "rhs_calls",
    "jacobians",
    "ball_jacobians",
    "factorisations",
)
_BUFFER = ("sample_t", "sample_y")  # of the memory


class BearingEngine:
    """Dynamics of one bearing, started from its quasi-static equilibrium.

    Parameters
    ----------
    model : BearingModel
        Resolved model.
    announce : callable, optional
        Called with a sentence before something is compiled.
    equilibrium : Equilibrium, optional
        Start from this instead of solving for it.

    given : sequence of str
        Loads and motions from outside, see :mod:`lambda_core.solver.drivers.given`.
    capacity : int
        Samples that the buffer holds.

    Attributes
    ----------
    channels : tuple of Channel
        What every sample carries.
    given : records.TERM[:]
        One row for each of the signals from outside, which may be written to between two calls of :meth:`advance`.

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
        capacity: int = _CAPACITY,
    ) -> None:
        self.model = model
        self.channels = result_channels(model)
        self._equilibrium = equilibrium or solve(model, announce=announce, strict=False)
        self._core = core(announce)
        self._context = self._equilibrium.context
        self.given = make_room(self._context, given)
        self._balls = model.geometry.balls
        start = initial_state(self._equilibrium)
        self._memory = make_memory(
            start,
            self._context.scale,
            model.solver.tolerance,
            self._context.bundle,
            capacity,
            stages=STAGES if model.solver.resolve else 0,
        )
        self.sample_interval = model.output.interval or usual_interval(model, self._equilibrium.orbit)
        control, count = self._memory.control, self._memory.count
        control["longest_step"] = min(model.solver.max_step, longest_step(self._context))
        control["step"] = np.minimum(FIRST_STEP, control["longest_step"])
        control["shortest_step"] = SMALLEST_STEP
        control["sample_interval"] = self.sample_interval
        count["stale"] = 1
        self._handle = self._context.handle(self._memory)
        self._scratch = Scratch.of(1, self._context)
        self._start_angles = self._angles()
        self._start_energy = self._stored(0.0, start)
        self._drained: list[dict[str, FloatArray]] = []

    @property
    def time(self) -> float:
        """Start of the next step [s]."""
        return float(self._memory.control["time"][0])

    @property
    def iterations(self) -> int:
        """Newton iterations since the start."""
        return int(self._memory.count["newton_iterations"][0])

    def parts(self) -> tuple[Core, SolverContext, Memory, Scratch]:
        """Return what takes steps and looks at states, for code that is to do so elsewhere."""
        return self._core, self._context, self._memory, self._scratch

    @property
    def kernel_keys(self) -> dict[str, str]:
        """Hash of everything each kernel reaches."""
        return self._context.kernels.keys()

    def advance(self, until: float, pause: Callable[[], bool] | None = None) -> Advance:
        """Integrate until `time` >= `until` [s] or `pause` says so; samples gather in the buffer meanwhile."""

        def integrate(end: float) -> int:
            return int(self._core.integrate(self._handle, end, WORK_PER_CALL))

        return drive(integrate, self, until, pause, self._drain, lambda: fault_sentence(self._context, self.time))

    def advance_exactly(self, until: float, pause: Callable[[], bool] | None = None) -> Advance:
        """Integrate until `time` == `until` [s]: steps on the way there are cut to end at it."""
        self._memory.control["stop"] = until
        try:
            return self.advance(until, pause)
        finally:
            self._memory.control["stop"] = math.inf

    def samples(self) -> dict[str, FloatArray]:
        """Return and clear the buffered samples: channel -> array, first axis is time."""
        self._drain()
        blocks, self._drained = self._drained, []
        if not blocks:
            blocks = [self._observe(np.zeros(0), self._memory.sample_y)]
        return {c.name: np.concatenate([block[c.name] for block in blocks]) for c in self.channels}

    def now(self) -> dict[str, FloatArray]:
        """Return every channel at `time`."""
        found = self._observe(np.array([self.time]), self._memory.y.reshape(1, -1))
        return {name: values[0] for name, values in found.items()}

    def reactions(self) -> FloatArray:
        """Return what the bearing puts on its bodies where :meth:`now` looked last, shape (bodies, 6).

        Force x, y, z [N] and moment x, y, z about the body's centre [N m] of all contacts and force elements on it:
        without its loads, weight and support.
        """
        wrenches: FloatArray = self._context.bundle.body_wrenches[: CAGE + 1].view(np.float64).reshape(-1, 6)
        return wrenches.copy()

    def forget_samples(self) -> None:
        """Empty the buffer of samples without looking at them."""
        self._memory.count["samples_waiting"] = 0
        self._drained.clear()

    def buffered(self) -> tuple[FloatArray, FloatArray]:
        """Return times and states of the samples that no one has taken yet, shapes (n,) [s] and (n, size)."""
        n = int(self._memory.count["samples_waiting"][0])
        return self._memory.sample_t[:n].copy(), self._memory.sample_y[:n].copy()

    def _drain(self) -> None:
        """Turn buffered states into channels."""
        n = int(self._memory.count["samples_waiting"][0])
        if n:
            self._drained.append(self._observe(self._memory.sample_t[:n].copy(), self._memory.sample_y))
            self._memory.count["samples_waiting"] = 0

    def _stored(self, t: float, y: FloatArray) -> float:
        scratch = self._scratch
        self._core.sample(self._handle, np.array([t]), y.reshape(1, -1), -1.0, *scratch)
        return float(scratch.extra[0, 0])  # a records.TOTALS

    def integrals(self) -> dict[str, float]:
        """Return running time integrals from t = 0 (see the Engine protocol)."""
        values = self._memory.integrals
        so_far, now = running(values), self._angles()
        losses = losses_by_ring(self.model.geometry, values[: -L.BESIDE_LOSSES])
        result = {f"loss.{name}": float(losses[i]) for i, name in enumerate(LOSSES)}
        stored = self._stored(self.time, self._memory.y) - self._start_energy
        result.update(
            input=float(so_far["input"]),
            input_abs=float(so_far["input_abs"]),
            drive=float(so_far["drive"]),
            stored=float(stored),
            relative_angle=float(so_far["relative_speed"]),
            cage_angle=now[0] - self._start_angles[0],
            inner_angle=now[1] - self._start_angles[1],
            **dict(zip("xyz", so_far["position"].tolist(), strict=True)),
        )
        return result

    def statistics(self) -> dict[str, float]:
        """Return counters of the integrator."""
        counted = {name: float(self._memory.count[name][0]) for name in _COUNTERS}
        steps, rest = self._memory.control["fourth_powers"][0], running(self._memory.integrals)["iteration"]
        return {**counted, "steps_to_the_fourth": float(steps), "iteration_work": float(rest)}

    def ring_modes(self) -> list[tuple[float, float]]:
        """Return frequency [Hz] and damping ratio of the modes of the rings at `time`."""
        return ring_modes(self._context.bundle, self._context.blocks, self._memory.inertia)

    def state(self, *, samples: bool = True) -> dict[str, NDArray[np.float64]]:
        """Return everything that a continuation needs: memory, Jacobian blocks, factors.

        Without `samples` the buffer of those that nobody has taken yet is left out.
        """
        parts: dict[str, NDArray[np.float64]] = {}
        for prefix, group in (("memory", self._memory), ("factors", self._context.factors)):
            for name, array in zip(group._fields, group, strict=True):
                # what is no array is of several bearings
                if isinstance(array, np.ndarray) and (samples or name not in _BUFFER):
                    parts[f"{prefix}.{name}"] = array.copy()
        for name in ("a", "b", "c", "d", "cross", "shared", "parts"):
            parts[f"blocks.{name}"] = getattr(self._context.blocks, name).copy()
        parts["start"] = np.array([*self._start_angles, self._start_energy])
        if self.given.size:
            parts["given"] = self.given.view(np.float64).copy()
        return parts

    def restore(self, state: Mapping[str, NDArray[np.float64]]) -> None:
        """Continue from what `state` returned.

        Raises
        ------
        SolverError
            When the state is of another model.
        """
        groups = {"memory": self._memory, "factors": self._context.factors, "blocks": self._context.blocks}
        for key, saved in state.items():
            if key == "start":
                self._start_angles, self._start_energy = (float(saved[0]), float(saved[1])), float(saved[2])
                continue
            if key == "given":
                self.given.view(np.float64)[:] = saved
                continue
            group, name = key.split(".")
            array = getattr(groups[group], name)
            if array.shape != saved.shape or array.dtype != saved.dtype:
                raise SolverError(f"the checkpoint does not fit this model: {key} has shape {saved.shape}")
            array[...] = saved

    def equilibrium(self) -> Mapping[str, object]:
        """Return the quasi-static solution the run started from."""
        e = self._equilibrium
        return {
            "contacts": e.contacts,
            "contact_channels": CONTACT_CHANNELS,
            "losses": e.losses,
            "displacement": e.displacement,
            "orbit": e.orbit,
            "converged": e.converged,
            "relative_speed": e.relative_speed,
        }

    def _angles(self) -> tuple[float, float]:
        """Return cage angle (mean of the balls when there is no cage) and inner spin angle, to the outer ring [rad]."""
        bundle = self._context.bundle
        bodies, tail = np.zeros(bundle.bodies.size, R.BODY_STATE), L.NB * self._balls
        bodies.view(np.float64)[bundle.active] = self._context.shared_part(self._memory.y)
        inner, outer, cage = (float(angle) for angle in bodies["angle"][: CAGE + 1])
        if not self.model.depth.cage:
            cage = float(np.mean(self._memory.y[:tail].view(R.BALL)["azimuth"]))
        return cage - outer, inner - outer

    def _observe(self, times: FloatArray, states: FloatArray) -> dict[str, FloatArray]:
        """Return every channel at n points: channel -> array, first axis is time."""
        scratch = Scratch.of(times.size, self._context)
        ok = self._core.sample(self._handle, times, states, SHORTED, *scratch)
        return channels_of(ok, self._context, times, states, scratch)


def initial_state(equilibrium: Equilibrium) -> FloatArray:
    """Return the state that the dynamics start from: equilibrium with every ball at the cage's speed.

    The cage stands centred on the balls and turns with them; its pockets are where the balls are. That of a
    self-aligning bearing leans with the inner ring, as the rows do.
    """
    context = equilibrium.context
    model = context.model
    z = model.geometry.balls
    y = equilibrium.state.copy()
    balls = y[: L.NB * z].view(R.BALL)
    balls["velocity"][:, 2] = equilibrium.orbit * balls["radius"]
    if model.depth.cage:
        bodies = np.zeros(context.bundle.bodies.size, R.BODY_STATE)
        shared, cage = bodies.view(np.float64), bodies[CAGE : CAGE + 1]
        shared[context.bundle.active] = context.shared_part(y)
        cage.view(np.float64)[:] = 0.0
        cage["position"][0, 0] = float(np.mean(balls["x"]))
        cage["angle"], cage["spin"] = balls["azimuth"][0], equilibrium.orbit
        if model.geometry.self_aligning:
            *_, about_y, about_z = equilibrium.displacement
            cage["tilt"][0] = about_z, -about_y
        context.shared_part(y)[:] = shared[context.bundle.active]
    return y
