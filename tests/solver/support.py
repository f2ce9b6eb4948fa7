"""Access the layout of the compiled core in one place."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from functools import cache

import numpy as np
from numpy.typing import NDArray

from lambda_core import api
from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.channels import LOSSES
from lambda_core.model.bearing_model import BearingModel
from lambda_core.model.laws.law_context import ContactFrame
from lambda_core.solver.arrays import bundle as L
from lambda_core.solver.arrays import integrator_memory as M
from lambda_core.solver.core import core
from lambda_core.solver.drivers.compiled_laws import Kernels, derive_oils
from lambda_core.solver.drivers.equilibrium import fault_sentence
from lambda_core.solver.drivers.modes import dense
from lambda_core.solver.drivers.observation import observe
from lambda_core.solver.drivers.solver_context import SolverContext, assemble
from lambda_core.solver.drivers.tables import running
from lambda_core.solver.integrator.tableau import STAGES
from lambda_core.solver.status import Status

CASE = "6319-cp10-1500"
ALL_FREE = tuple(
    f"bodies.outer_ring.{dof}=free" for dof in ("x", "y", "z", "tilt_y", "tilt_z", "spin")
)  # both rings and the cage move in every direction
NO_FIELD = ("gravity.z=0 m/s2", "models.fluid_drag=none")  # nothing but internal forces


@dataclass(frozen=True)
class Evaluation:
    """One evaluation of the right-hand side."""

    dydt: FloatArray
    losses: dict[str, float]  # by mechanism [W]
    input_power: float  # [W]
    drive_power: float  # [W]
    ball_forces: FloatArray  # (Z, 6), axes x, r, t
    body_forces: FloatArray  # (3, 6), inertial axes, moments about each body's centre


@dataclass
class State:
    """A state vector with named parts; `vector` packs it."""

    balls: FloatArray  # (Z, 9)
    shared: FloatArray  # (bodies, 12); what is not free is ignored

    def copy(self) -> State:
        return State(self.balls.copy(), self.shared.copy())


@dataclass
class Machine:
    """Model on the compiled core.

    It is evaluated at states of the test's choice.
    """

    model: BearingModel
    angle: float = 0.0  # contact angle at which the contacts' radii are frozen [rad]
    context: SolverContext = field(init=False)

    def __post_init__(self) -> None:
        kernels = Kernels(self.model)
        frame = ContactFrame((self.angle, self.angle), (1000.0, 1000.0))
        self.context = assemble(self.model, kernels, frame, derive_oils(self.model, kernels, frame))

    @property
    def count(self) -> int:
        return self.model.geometry.ball_count

    @property
    def active(self) -> NDArray[np.int64]:
        """Indices of the free shared states.

        In the flat (3, 12) array.
        """
        return np.asarray(self.context.bundle.active)

    def constant(self, name: str) -> FloatArray:
        """Return a constant by its name.

        In the records: of the row of balls, or of each raceway or body.
        """
        bundle = self.context.bundle
        if name in bundle.bodies.dtype.names:
            return np.array(bundle.bodies[name])
        for table in (bundle.system, bundle.rows):
            if name in table.dtype.names:
                return np.array(table[name][0])
        return np.array(bundle.raceways[name])

    def vector(self, state: State) -> FloatArray:
        return np.concatenate([state.balls.ravel(), state.shared.ravel()[self.active], self.context.bundle.states])

    def state(self, y: FloatArray) -> State:
        shared = np.zeros(self.context.bundle.shared.size)
        shared[self.active] = self.context.shared_part(y)
        return State(y[: L.NB * self.count].reshape(-1, L.NB).copy(), shared.reshape(-1, L.NS))

    def at_rest(self, azimuth: float = 0.0) -> State:
        """Return a centred state at rest.

        Balls are in the middle of the play.
        """
        z, g = self.count, self.model.geometry
        balls, shared = np.zeros((z, L.NB)), np.zeros((self.context.bundle.bodies.size, L.NS))
        balls[:, L.BR] = 0.5 * g.pitch_diameter
        balls[:, L.BPSI] = azimuth + 2.0 * np.pi * np.arange(z) / z
        shared[2, L.STHETA] = azimuth
        return State(balls, shared)

    def evaluate(self, y: FloatArray, t: float = 0.0, want: int = 1) -> Evaluation:
        bundle = self.context.bundle
        dydt, rates = np.full(y.size, np.nan), np.zeros(L.power_count(bundle))
        ok = core().evaluate(t, y, bundle, dydt, rates, want)
        assert ok == 1, fault_sentence(self.context)
        losses = dict(zip((*LOSSES, "support"), rates[: -L.NOT_DISSIPATED].tolist(), strict=True))
        bodies, balls = (w.view(np.float64).reshape(-1, 6).copy() for w in (bundle.body_wrenches, bundle.ball_wrenches))
        powers = running(rates)
        return Evaluation(dydt, losses, float(powers["input"]), float(powers["drive"]), balls, bodies)

    def observe(self, y: FloatArray, t: float = 0.0) -> dict[str, FloatArray]:
        """Return every channel at one state, first axis dropped."""
        channels = observe(core(), self.context, np.array([t]), y.reshape(1, -1))
        return {name: values[0] for name, values in channels.items()}

    def stored(self, y: FloatArray, t: float = 0.0) -> float:
        """Return kinetic plus elastic energy [J]."""
        return float(self.observe(y, t)["stored_energy"])

    def jacobian(self, y: FloatArray, t: float = 0.0) -> FloatArray:
        """Return the block-arrow Jacobian as a dense matrix."""
        bundle, blocks = self.context.bundle, self.context.blocks
        self.evaluate(y, t, want=0)
        assert core().jacobian(t, y, bundle, blocks) == 1, fault_sentence(self.context)
        return dense(blocks)

    @contextmanager
    def frictionless(self) -> Iterator[None]:
        """Leave only the raceways' normal forces.

        Of a model whose cage contacts are none.
        """
        system = self.context.bundle.system[0]
        system["friction_on"] = 0
        try:
            yield
        finally:
            system["friction_on"] = 1

    def shared_state(self, y: FloatArray, t: float) -> FloatArray:
        """Return the whole shared state (bodies, 12), prescribed motions included."""
        self.evaluate(y, t, want=0)
        return np.array(self.context.bundle.shared).reshape(-1, L.NS)


def time_function(m: Machine, kind: str, body: int, component: int, t: float) -> FloatArray:
    """Return a time function's value and derivatives.

    Two derivatives of a load or motion at time t, as compiled code reads them.
    """
    m.evaluate(m.vector(m.at_rest()), t, want=0)
    return np.array(m.context.bundle.inputs[kind][body, component].tolist())


@dataclass(frozen=True)
class Motion:
    """Motion that the integrator wrote."""

    times: FloatArray  # (n,)
    states: FloatArray  # (n, size)
    steps: int

    def ball(self, j: int) -> FloatArray:
        """Return the states of one ball, (n, 9)."""
        return self.states[:, L.NB * j : L.NB * (j + 1)]


def integrate(
    m: Machine,
    y: FloatArray,
    duration: float,
    tolerance: float,
    samples: int = 100,
    *,
    fine: bool = False,
    longest: float | None = None,
) -> Motion:
    """Integrate from any state.

    Sampled at equal intervals from 0 on; `fine` with the formula for vibrations.
    """
    return integrate_tables(m.context, y, duration, tolerance, samples, fine=fine, longest=longest)


def integrate_tables(
    context: SolverContext,
    y: FloatArray,
    duration: float,
    tolerance: float,
    samples: int,
    *,
    fine: bool = False,
    longest: float | None = None,
) -> Motion:
    """Integrate what tables describe."""
    bundle, blocks, factors = context.bundle, context.blocks, context.factors
    mem = M.make_memory(y, context.scale, tolerance, bundle, samples + 8, stages=STAGES if fine else 0)
    interval = duration / samples
    control = mem.control
    control["step"], control["shortest_step"], control["longest_step"] = 1e-9, 1e-16, longest or interval
    control["sample_interval"] = interval
    mem.count["stale"] = 1
    compiled = core()
    advance = compiled.advance_finely if fine else compiled.advance
    while control["time"][0] < duration:
        status = advance(
            compiled.evaluate_pointer, compiled.jacobian_pointer, duration, 10_000, bundle, blocks, factors, mem
        )
        assert status in (Status.OK, Status.UNFINISHED), (Status(status), control["time"])
    n = int(mem.count["samples_waiting"][0])
    return Motion(mem.sample_t[:n].copy(), mem.sample_y[:n].copy(), int(mem.count["steps"][0]))


@cache
def machine(*overrides: str, case: str = CASE, angle: float = 0.0) -> Machine:
    """Return a built-in case with overrides on the compiled core."""
    return Machine(api.check(case, overrides), angle)


def inertial(psi: float, v: FloatArray) -> FloatArray:
    """Turn components x, r, t into x, y, z.

    At azimuth psi.
    """
    c, s = np.cos(psi), np.sin(psi)
    return np.array([v[0], c * v[1] - s * v[2], s * v[1] + c * v[2]])


def ball_centre(ball: FloatArray) -> FloatArray:
    return np.array([ball[L.BX], ball[L.BR] * np.cos(ball[L.BPSI]), ball[L.BR] * np.sin(ball[L.BPSI])])


def axis_of(body: FloatArray) -> FloatArray:
    """Return the unit axis of a shared body."""
    ay, az = body[L.SAY], body[L.SAZ]
    return np.array([np.sqrt(1.0 - ay * ay - az * az), ay, az])


def angular_velocity(body: FloatArray) -> FloatArray:
    """Return the whole angular velocity of a shared body, inertial."""
    a = axis_of(body)
    wy, wz = body[L.SWY], body[L.SWZ]
    across = np.array([-(wy * a[1] + wz * a[2]) / a[0], wy, wz])
    return np.array(across + body[L.SSIGMA] * a)


def jostle(m: Machine, state: State, rng: np.random.Generator, shift: float = 1.0, motion: float = 1.0) -> State:
    """Return a random state.

    Every ball and body displaced, tilted and moving.

    At 1 displacements are some 20 um, tilts 0.3 mrad, velocities 0.3 m/s, spins 30 rad/s on top of the state.
    """
    new, z = state.copy(), m.count
    ball_scale = np.repeat([shift, motion], [3, 6]) * [20e-6, 20e-6, 1e-3, 0.3, 0.1, 0.3, 30.0, 30.0, 30.0]
    body_scale = np.repeat([shift, motion], [6, 6]) * [10e-6, 10e-6, 10e-6, 3e-4, 3e-4, 1e-3, 0.05, 0.05, 0.05, 1, 1, 3]
    new.balls += rng.uniform(-1.0, 1.0, (z, L.NB)) * ball_scale
    new.shared += rng.uniform(-1.0, 1.0, new.shared.shape) * body_scale
    return new


def rolling(m: Machine, speed: float, azimuth: float = 0.0) -> State:
    """Return a rolling state.

    `at_rest` with the inner ring at `speed` [rad/s] and everything rolling without slip.
    """
    state, g = m.at_rest(azimuth), m.model.geometry
    inner = speed * (0.5 * g.pitch_diameter - 0.5 * g.ball_diameter)
    state.balls[:, L.BVT] = 0.5 * inner
    state.balls[:, L.BWX] = -inner / g.ball_diameter
    state.shared[0, L.SSIGMA] = speed
    state.shared[2, L.SSIGMA] = inner / g.pitch_diameter
    return state
