"""Read channels and running integrals of every bearing.

The integrals of one bearing are exact. With several, the integrator adds up what pockets, lands and drag dissipate for
all together, and samples tell the shares.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Protocol

import numpy as np

from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.channels import LOSSES, SHORTED
from lambda_core.domain.elements import CAGE, INNER, OUTER
from lambda_core.domain.errors import SolverError
from lambda_core.solver import records as R
from lambda_core.solver.arrays import bundle as L
from lambda_core.solver.core import core
from lambda_core.solver.drivers.assembly import BearingSpan
from lambda_core.solver.drivers.element_forces import element_forces, named_forces
from lambda_core.solver.drivers.equilibrium import fault_sentence
from lambda_core.solver.drivers.observation import Scratch, channels_of, observe
from lambda_core.solver.drivers.ring_values import losses_by_ring, losses_of_raceways
from lambda_core.solver.drivers.solver_context import SolverContext
from lambda_core.solver.drivers.tables import running

Channels = dict[str, FloatArray]
Sums = dict[str, float]
_SHARED = ("pocket", "land", "drag", "bending")  # losses that only samples part by bearing


@dataclass(frozen=True)
class ReadBearing:
    """A bearing whose channels are read.

    Attributes
    ----------
    name : str
        "" for a bearing that is alone.
    context : SolverContext
        Of the bearing alone; of one of several with rings and cage that are free in every direction.
    span : BearingSpan
        Where it stands in tables and states of the motion.
    """

    name: str
    context: SolverContext
    span: BearingSpan


@dataclass(frozen=True)
class MachineSamples:
    """Samples of a motion.

    It has those of the machine, none of a bearing that is alone, and those of every bearing as a run of it alone has
    them.
    """

    machine: Channels
    bearings: list[Channels]


@dataclass(frozen=True)
class Seen:
    """A motion at one moment.

    Attributes
    ----------
    channels : mapping of str to float64 array
        Of a bearing that is alone, or of a machine.
    reactions : mapping of str to float64 array
        What a bearing puts on each of its bodies, or what each bearing of a machine puts on the shaft: force [N] and
        moment [N m], shape (6,).
    bearings : mapping of str to mapping
        Channels of each bearing of a machine.
    """

    channels: Channels
    reactions: Mapping[str, FloatArray]
    bearings: Mapping[str, Channels]

    @property
    def pressure(self) -> float:
        """Largest contact pressure [Pa]."""
        each = list(self.bearings.values()) or [self.channels]
        return max(float(one["max_pressure"].max()) for one in each)


class Readings(Protocol):
    """Readings of a motion's states."""

    @property
    def bearings(self) -> tuple[ReadBearing, ...]:
        """Return the bearings in the order of the assembly."""

    @property
    def adds_up_samples(self) -> bool:
        """Tell whether integrals need all samples up to now."""

    def begin(self, y: FloatArray, time: float) -> None:
        """Take a state as zero of angles."""

    def sampled(self, times: FloatArray, states: FloatArray) -> MachineSamples:
        """Return what is read at samples.

        They follow those of the last call.
        """

    def joined(self, blocks: list[MachineSamples]) -> MachineSamples:
        """Return blocks joined in time.

        There may be none.
        """

    def channels(self, number: int, time: float, y: FloatArray) -> Channels:
        """Return every channel of a bearing.

        They hold at a state; the first axis is time.
        """

    def integrals(self, values: FloatArray, y: FloatArray, stored: float) -> list[Sums]:
        """Return the running integrals of every bearing.

        `stored` is the energy taken up since the start [J].
        """

    def state(self) -> dict[str, FloatArray]:
        """Return what a continuation needs."""

    def restore(self, state: Mapping[str, FloatArray]) -> None:
        """Continue from what `state` returned."""


class BearingReadings:
    """Read a bearing that is alone."""

    adds_up_samples = False

    def __init__(self, context: SolverContext) -> None:
        self._context = context
        self.bearings = (ReadBearing("", context, context.assembly.spans()[0]),)
        self._start = np.zeros(2)

    def begin(self, y: FloatArray, time: float) -> None:
        """Take a state as zero of angles."""
        self._start = self._angles(y)

    def _angles(self, y: FloatArray) -> FloatArray:
        """Return cage and inner ring angles [rad].

        Cage angle (mean of the balls when there is no cage) and inner spin angle, to the outer ring.
        """
        context = self._context
        bodies = np.zeros(context.bundle.bodies.size, R.BODY_STATE)
        bodies.view(np.float64)[context.bundle.active] = context.shared_part(y)
        inner, outer, cage = (float(angle) for angle in bodies["angle"][: CAGE + 1])
        if not context.model.depth.cage:
            cage = float(np.mean(L.elements_in(context.bundle, y)["azimuth"]))
        return np.array([cage - outer, inner - outer])

    def sampled(self, times: FloatArray, states: FloatArray) -> MachineSamples:
        """Return every channel at samples.

        Channel -> array, first axis is time.
        """
        return MachineSamples({}, [observe(core(), self._context, times, states)])

    def joined(self, blocks: list[MachineSamples]) -> MachineSamples:
        """Return blocks one after the other in time as one."""
        if not blocks:
            return self.sampled(np.zeros(0), np.zeros((0, self._context.size)))
        return MachineSamples({}, [_joined([block.bearings[0] for block in blocks])])

    def channels(self, number: int, time: float, y: FloatArray) -> Channels:
        """Return every channel at a state."""
        return self.sampled(np.array([time]), y.reshape(1, -1)).bearings[0]

    def integrals(self, values: FloatArray, y: FloatArray, stored: float) -> list[Sums]:
        """Return the running integrals since the start.

        ``loss.<name>`` for each of LOSSES [J], ``support`` (taken by dampers to the ground) [J], ``input`` (all
        external work) [J], ``input_abs`` (its absolute value) [J], ``drive`` (work of the spin drives) [J], ``stored``
        (kinetic and elastic energy now minus at the start) [J], ``relative_angle`` (integral of |Omega_i - Omega_o|)
        [rad], ``cage_angle`` (cage angle relative to the outer ring; mean of the balls when the cage is off) [rad],
        ``inner_angle`` (inner ring spin angle relative to the outer) [rad], ``x``, ``y``, ``z`` (integral of the inner
        ring's position) [m s].
        """
        so_far, turned = running(values), self._angles(y) - self._start
        losses = losses_by_ring(self._context.model.geometry, values[: -L.NOT_LOST])
        own = {
            **{f"loss.{name}": float(losses[i]) for i, name in enumerate(LOSSES)},
            "support": float(so_far["support"]),
            "input": float(so_far["input"]),
            "input_abs": float(so_far["input_abs"]),
            "drive": float(so_far["drive"]),
            "stored": stored,
            "relative_angle": float(so_far["relative_speed"]),
            "cage_angle": float(turned[0]),
            "inner_angle": float(turned[1]),
            **dict(zip("xyz", so_far["position"].tolist(), strict=True)),
        }
        return [own]

    def state(self) -> dict[str, FloatArray]:
        """Return what a continuation needs."""
        return {"angles": self._start.copy()}

    def restore(self, state: Mapping[str, FloatArray]) -> None:
        """Continue from what `state` returned."""
        self._start = state["angles"].copy()


class MachineReadings:
    """Read every bearing of a machine.

    Parameters
    ----------
    context : SolverContext
        Of the machine.
    bearings : tuple of ReadBearing
    members : callable
        Returns channels of the machine from times [s] and the whole shared state of samples, shape (n, 12 bodies).
    standing : float64[:], shape (12 bodies,), or None
        The whole shared state where nothing that is prescribed changes; its free entries do not count. None where
        prescribed motions change.
    """

    adds_up_samples = True

    def __init__(
        self,
        context: SolverContext,
        bearings: tuple[ReadBearing, ...],
        members: Callable[[FloatArray, FloatArray], Channels],
        standing: FloatArray | None,
    ) -> None:
        self.bearings = bearings
        self._context, self._members, self._standing = context, members, standing
        self._start = np.zeros(2 * len(bearings))
        self._sampled = np.zeros((len(bearings), len(_SHARED) + 4))  # integrals of what only samples say
        self._last: list[FloatArray] = []  # their rates at the last sample
        self._last_time = 0.0

    def begin(self, y: FloatArray, time: float) -> None:
        """Take a state as zero of angles."""
        self._start, self._last_time = self._angles(y), time

    def _angles(self, y: FloatArray) -> FloatArray:
        """Return all cage and inner ring angles [rad].

        Cages (means of the balls without cages), then inner rings.

        Against the outer rings.
        """
        flat = np.zeros(self._context.bundle.shared.size)
        flat[self._context.bundle.active] = self._context.shared_part(y)
        angles, cages = flat.view(R.BODY_STATE)["angle"], []
        for one in self.bearings:
            balls = L.elements_in(one.context.bundle, y[one.span.begin : one.span.end])
            is_caged = one.context.model.depth.cage
            cages.append(float(angles[one.span.bodies[CAGE]] if is_caged else np.mean(balls["azimuth"])))
        inner, outer = (angles[[one.span.bodies[ring] for one in self.bearings]] for ring in (INNER, OUTER))
        found: FloatArray = np.concatenate([cages - outer, inner - outer])
        return found

    def sampled(self, times: FloatArray, states: FloatArray) -> MachineSamples:
        """Return what is read at samples.

        They follow those of the last call.
        """
        found = self.seen(times, states)
        for i, channels in enumerate(found.bearings):
            self._add_up(i, channels)
        self._last_time = float(times[-1])
        return found

    def seen(self, times: FloatArray, states: FloatArray) -> MachineSamples:
        """Return every channel at states.

        They add nothing to the integrals.
        """
        flat = self.shared(times, states)
        found = [self._observed(one, times, states, flat) for one in self.bearings]
        machine = {
            "time": times,
            **self._members(times, flat),
            "reaction_force": np.stack([wrenches[:, :3] for _, wrenches in found], axis=1),
            "reaction_moment": np.stack([wrenches[:, 3:] for _, wrenches in found], axis=1),
            **named_forces("connection", *element_forces(self._context, times, flat)),
            "power_loss": sum((channels["loss"].sum(axis=1) for channels, _ in found), np.zeros(times.size)),
        }
        return MachineSamples(machine, [channels for channels, _ in found])

    def joined(self, blocks: list[MachineSamples]) -> MachineSamples:
        """Return blocks joined in time.

        Without blocks there is no channel but an empty time.
        """
        if not blocks:
            return MachineSamples({"time": np.zeros(0)}, [{} for _ in self.bearings])
        each = [_joined([block.bearings[i] for block in blocks]) for i in range(len(self.bearings))]
        return MachineSamples(_joined([block.machine for block in blocks]), each)

    def channels(self, number: int, time: float, y: FloatArray) -> Channels:
        """Return every channel of a bearing at a state."""
        times, states = np.array([time]), y.reshape(1, -1)
        return self._observed(self.bearings[number], times, states, self.shared(times, states))[0]

    def shared(self, times: FloatArray, states: FloatArray) -> FloatArray:
        """Return the complete shared state of samples.

        The shape is (n, 12 bodies).
        """
        bundle = self._context.bundle
        if self._standing is None:
            return np.array([self._evaluated(float(t), y) for t, y in zip(times, states, strict=True)])
        flat = np.tile(self._standing, (len(states), 1))
        tail = int(bundle.system["tail"][0])
        flat[:, bundle.active] = states[:, tail : tail + bundle.active.size]
        return flat

    def _evaluated(self, t: float, state: FloatArray) -> FloatArray:
        """Return the complete shared state at a sample.

        It includes what is prescribed.
        """
        bundle, slope, rates = self._context.bundle, np.zeros(state.size), np.zeros(L.power_count(self._context.bundle))
        if core().evaluate(t, np.ascontiguousarray(state), bundle, slope, rates, 0) != 1:
            raise SolverError(fault_sentence(self._context, t))
        return np.asarray(bundle.shared.copy())

    def _observed(
        self, one: ReadBearing, times: FloatArray, states: FloatArray, flat: FloatArray
    ) -> tuple[Channels, FloatArray]:
        """Return a bearing's channels and reaction.

        The reaction is force and moment of its contacts on the shaft, (n, 6).
        """
        context, span, n = one.context, one.span, times.size
        kept = states.shape[1] - self._context.bundle.states.size + span.first_state
        own = flat.reshape(n, -1, L.NS)[:, list(span.bodies)].reshape(n, -1)[:, context.bundle.active]
        y = np.ascontiguousarray(np.concatenate([
            states[:, span.begin : span.end], own, states[:, kept : kept + span.states]
        ], axis=1))  # fmt: skip
        scratch, wrenches, evaluate = Scratch.of(n, context), np.zeros((n, 6)), core().evaluate_pointer
        for i in range(n):
            rows = [array[i : i + 1] for array in scratch[:-1]]
            ok = core().observe(times[i : i + 1], y[i : i + 1], context.bundle, evaluate, SHORTED, *rows, scratch.dydt)
            if ok != 1:
                raise SolverError(f"{one.name}: {fault_sentence(context, float(times[i]))}")
            wrenches[i] = context.bundle.body_wrenches.view(np.float64)[:6]
        return channels_of(1, context, times, y, scratch), wrenches

    def _add_up(self, i: int, channels: Channels) -> None:
        """Add to the integrals of samples.

        Samples alone have their values; the rule is the trapezium's.
        """
        columns = [channels["loss"][:, LOSSES.index(name)] for name in _SHARED]
        speed = channels["body_spin"][:, INNER] - channels["body_spin"][:, OUTER]
        rates = np.column_stack([*columns, channels["input_torque"] * speed, channels["body_position"][:, INNER]])
        if len(self._last) <= i:
            self._last.append(rates[0])
        steps = np.diff(np.concatenate([[self._last_time], channels["time"]]))[:, None]
        around = np.concatenate([self._last[i][None], rates])
        grown = np.concatenate([self._sampled[i][None], 0.5 * steps * (around[1:] + around[:-1])])
        self._sampled[i] = np.add.accumulate(grown)[-1]  # one after the other: the same bits in blocks of any length
        self._last[i] = rates[-1]

    def integrals(self, values: FloatArray, y: FloatArray, stored: float) -> list[Sums]:
        """Return every bearing's running integrals.

        They count from the start, as a run of the bearing alone has them.

        What its raceways dissipate is exact; pocket, land, drag and bending are known exactly for all bearings together
        and are parted by their samples. Energy is balanced for the machine: input is that of the machine less what the
        other bearings dissipate, stored and dampers to the ground are those of the machine, so that the residual is the
        machine's.
        """
        count, so_far = len(self.bearings), running(values)
        parted = self._sampled[:, : len(_SHARED)]
        sums = parted.sum(axis=0)
        shares = np.where(sums > 0.0, parted / np.where(sums > 0.0, sums, 1.0), 1.0 / count)
        losses = []
        for i, one in enumerate(self.bearings):
            own = losses_of_raceways(one.context.model.geometry, values, one.span.first_raceway)
            own |= {name: float(so_far[name]) * float(shares[i, k]) for k, name in enumerate(_SHARED)}
            losses.append(own)
        every = sum(sum(own.values()) for own in losses)
        turned = (self._angles(y) - self._start).tolist()
        return [
            {
                **{f"loss.{name}": value for name, value in own.items()},
                "support": float(so_far["support"]),
                "input": float(so_far["input"]) - (every - sum(own.values())),
                "input_abs": float(so_far["input_abs"]),
                "drive": float(self._sampled[i, len(_SHARED)]),
                "stored": stored,
                "relative_angle": float(so_far["relative_speed"]),
                "cage_angle": turned[i],
                "inner_angle": turned[count + i],
                **dict(zip("xyz", self._sampled[i, len(_SHARED) + 1 :].tolist(), strict=True)),
            }
            for i, own in enumerate(losses)
        ]

    def state(self) -> dict[str, FloatArray]:
        """Return what a continuation needs."""
        last = np.array(self._last)
        return {"angles": self._start.copy(), "sampled": self._sampled.copy(), "last": last,
                "last_time": np.array([self._last_time])}  # fmt: skip

    def restore(self, state: Mapping[str, FloatArray]) -> None:
        """Continue from what `state` returned."""
        self._start, self._sampled, self._last = state["angles"].copy(), state["sampled"].copy(), list(state["last"])
        self._last_time = float(state["last_time"][0])


def _joined(blocks: list[Channels]) -> Channels:
    return {name: np.concatenate([block[name] for block in blocks]) for name in blocks[0]}
