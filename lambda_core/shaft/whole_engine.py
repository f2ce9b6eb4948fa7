"""The dynamics of a whole: one integration of the lumps of a shaft, its bearings with every ball, and the housing."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping

import numpy as np
from numpy.typing import NDArray

from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.channels import LOSSES, SHORTED
from lambda_core.domain.elements import CAGE, INNER, OUTER
from lambda_core.domain.errors import SolverError
from lambda_core.shaft.lumps import lump, unbalance_of_lumps
from lambda_core.shaft.machine_assembly import machine_assembly, member_numbers
from lambda_core.shaft.shaft_equilibrium import ShaftState, solve_shaft
from lambda_core.shaft.whole_markers import MarkerMotion, motions
from lambda_core.shaft.whole_samples import WholeSamples
from lambda_core.shaft.whole_start import start_state
from lambda_core.shaft.whole_tables import RING_SIGNS, RING_STATES, Part, all_free, make_parts
from lambda_core.solver import records as R
from lambda_core.solver.arrays import bundle as L
from lambda_core.solver.arrays.integrator_memory import Handle, make_memory
from lambda_core.solver.core import core
from lambda_core.solver.drivers.compiled_laws import Announce
from lambda_core.solver.drivers.engine import (
    FIRST_STEP,
    SMALLEST_STEP,
    WORK_PER_CALL,
    Advance,
    drive,
    usual_interval,
)
from lambda_core.solver.drivers.equilibrium import Equilibrium, fault_sentence
from lambda_core.solver.drivers.modes import ring_modes
from lambda_core.solver.drivers.observation import Scratch, channels_of
from lambda_core.solver.drivers.ring_values import losses_of_raceways
from lambda_core.solver.drivers.solver_context import context_of
from lambda_core.solver.drivers.surface_steps import longest_step
from lambda_core.solver.drivers.tables import SIGNS, STATES, running
from lambda_core.solver.integrator.tableau import STAGES
from lambda_core.system.machine import Machine

_CAPACITY = 512
_COUNTERS = (
    "steps", "rejected", "failed", "newton_iterations", "rhs_calls", "jacobians", "ball_jacobians", "factorisations",
    "rests",
)  # fmt: skip
_SHARED = ("pocket", "land", "drag")  # losses that only samples part by bearing
_WAVES = "support"  # of a bearing of a whole: what damps the waves of its elastic parts, known by samples alone


class WholeEngine:
    """Dynamics of a shaft in its bearings, started from the quasi-static equilibrium of the whole.

    Parameters
    ----------
    model : Machine
    announce : callable, optional
        Called with a sentence before something is compiled.

    Attributes
    ----------
    parts : tuple of Part
        The bearings, from left to right.
    equilibria : list of Equilibrium
        That each of them starts from.
    """

    def __init__(self, model: Machine, announce: Announce = None) -> None:
        self.model = model
        self.start: ShaftState = solve_shaft(model, announce)
        self._core, self.shaft = core(announce), lump(model)
        self.equilibria: list[Equilibrium] = [ring.equilibrium() for ring in self.start.rings]
        alone = [all_free(found.context) for found in self.equilibria]
        assembly = machine_assembly(model, self.shaft, [(one.kernels, one.frame, one.oils) for one in alone])
        self.parts = make_parts(model, assembly, alone)
        context = context_of(assembly)
        self._numbers = member_numbers(model, self.shaft)
        self._markers = MarkerMotion(model, self.shaft)
        self._bundle, self._blocks, self._factors = context.bundle, context.blocks, context.factors
        self._dense = self._factors.condensed
        start = start_state(model, self.shaft, self.parts, context, self.start, self.equilibria)
        tolerance = min(part.bearing.model.solver.tolerance for part in self.parts)
        stages = STAGES if model.solver.resolve else 0
        self._memory = make_memory(start, context.scale, tolerance, self._bundle, _CAPACITY, stages=stages)
        self.sample_interval = min(
            usual_interval(part.bearing.model, found.orbit)
            for part, found in zip(self.parts, self.equilibria, strict=True)
        )
        control, count = self._memory.control, self._memory.count
        longest = [min(part.bearing.model.solver.max_step, longest_step(part.alone)) for part in self.parts]
        control["longest_step"] = min(longest)
        control["step"] = np.minimum(FIRST_STEP, control["longest_step"])
        control["shortest_step"], control["sample_interval"] = SMALLEST_STEP, self.sample_interval
        count["stale"] = 1
        c = self._core
        advance = c.advance_finely_pointer if stages else c.advance_pointer
        self._handle = Handle(
            c.evaluate_pointer, c.jacobian_pointer, advance, c.observe_pointer, self._bundle, self._blocks,
            self._factors, self._memory,
        )  # fmt: skip
        self._changes = any(term.kind != "constant" for function in model.led for term in function.terms)
        self._drained: list[WholeSamples] = []
        self._sampled = np.zeros((len(self.parts), len(_SHARED) + 5))  # integrals of what only samples say
        self._last: list[FloatArray] = []  # their rates at the last sample
        self._last_time = 0.0
        self._start_angles = self._angles()
        self._start_energy = self._stored()

    @property
    def time(self) -> float:
        """Start of the next step [s]."""
        return float(self._memory.control["time"][0])

    @property
    def drive_torque(self) -> float:
        """Mean torque of the coupling without friction [N m]; nan where torques on the shaft change over time."""
        return math.nan if self.model.has_changing_torque else self.start.drive_torque

    @property
    def states(self) -> int:
        """Number of states."""
        return int(self._memory.y.size)

    def advance(self, until: float, pause: Callable[[], bool] | None = None) -> Advance:
        """Integrate until `time` >= `until` [s] or `pause` says so; samples gather meanwhile."""

        def integrate(end: float) -> int:
            return int(self._core.integrate(self._handle, end, WORK_PER_CALL))

        return drive(integrate, self, until, pause, self._drain, self._fault)

    def _fault(self) -> str:
        """Say which law of which bearing refused."""
        fault = self._bundle.scratch[0].fault
        part = next(p for p in reversed(self.parts) if fault.ball >= p.first_ball or p is self.parts[0])
        own = part.alone.bundle.scratch[0].fault
        for name in fault.dtype.names:
            own[name] = fault[name]
        own["ball"] -= part.first_ball
        if own["place"] >= part.first_raceway:
            own["place"] -= part.first_raceway
        return f"{part.bearing.name}: {fault_sentence(part.alone, self.time)}"

    def fingerprint(self) -> bytes:
        """Return the numbers that the motion is made of: another case or code has others."""
        tables = [getattr(self._bundle, name) for name in ("bodies", "par", "tie_stiffness", "terms", "table")]
        start = np.concatenate([self._start_angles, [self._start_energy, self.sample_interval]])
        return b"".join(table.tobytes() for table in (*tables, start))

    # -- what is written --

    def samples(self) -> WholeSamples | None:
        """Return and clear the buffered samples; None where there are none."""
        self._drain()
        blocks, self._drained = self._drained, []
        if not blocks:
            return None
        return WholeSamples.joined(blocks)

    def _drain(self) -> None:
        n = int(self._memory.count["samples_waiting"][0])
        if not n:
            return
        times, states = self._memory.sample_t[:n].copy(), self._memory.sample_y[:n].copy()
        self._memory.count["samples_waiting"] = 0
        flat = self._bodies(states, times)
        found = [self._observe(part, times, states, flat) for part in self.parts]
        lumps = flat.view(R.BODY_STATE)[:, self._numbers.lumps]
        twist, beside = self._twist(flat), motions(flat.view(R.BODY_STATE)[:, self._numbers.bodies])
        whole = {
            "time": times,
            "shaft_position": lumps["position"].copy(),
            "shaft_tilt": np.stack([-lumps["tilt"][:, :, 1], lumps["tilt"][:, :, 0]], axis=2),
            "shaft_twist": twist,
            "body_position": beside[:, :, :3],
            "body_tilt": beside[:, :, 3:],
            "marker_position": self._markers.displacements(motions(lumps, twist), beside),
            "reaction_force": np.stack([wrenches[:, :3] for _, wrenches in found], axis=1),
            "reaction_moment": np.stack([wrenches[:, 3:] for _, wrenches in found], axis=1),
            "power_loss": sum((channels["loss"].sum(axis=1) for channels, _ in found), np.zeros(n)),
        }
        each = [channels for channels, _ in found]
        for i, channels in enumerate(each):
            self._add_up(i, channels)
        self._last_time = float(times[-1])
        self._drained.append(WholeSamples(whole, each))

    def _twist(self, flat: FloatArray) -> FloatArray:
        """Return how far the lumps have turned beyond the coupling, shape (n, lumps) [rad]."""
        angles, azimuths = flat.view(R.BODY_STATE)["angle"], unbalance_of_lumps(self.model, self.shaft)[1]
        found: FloatArray = angles[:, self._numbers.lumps] - azimuths
        if not self.model.twists:
            return np.zeros_like(found)
        lead = angles[:, self._numbers.led] - np.append(azimuths, 0.0)[[self.shaft.driven]]
        return np.asarray(found - lead)

    def _bodies(self, states: FloatArray, times: FloatArray) -> FloatArray:
        """Return the whole shared state of samples, shape (n, 12 bodies)."""
        bundle = self._bundle
        if self._changes:
            return np.array([self._shared(float(t), y) for t, y in zip(times, states, strict=True)])
        flat = np.zeros((len(states), bundle.shared.size))
        flat.view(R.BODY_STATE)["spin"][:, self._numbers.lumps] = self.model.speed
        for part in self.parts:  # where it is free its state comes over it
            flat[:, L.NS * part.bodies[OUTER] + RING_STATES] = RING_SIGNS * part.bearing.seating.shift
        for number, rigid in zip(self._numbers.bodies, self.model.bodies, strict=True):
            flat[:, L.NS * number + STATES] = SIGNS * rigid.shift
        tail = L.NB * int(bundle.system["balls"][0])
        flat[:, bundle.active] = states[:, tail : tail + bundle.active.size]
        return flat

    def _shared(self, t: float, state: FloatArray) -> FloatArray:
        """Return the whole shared state at a sample, with what is led."""
        bundle, slope, rates = self._bundle, np.zeros(self.states), np.zeros(L.power_count(self._bundle))
        if self._core.evaluate(t, np.ascontiguousarray(state), bundle, slope, rates, 0) != 1:
            raise SolverError(self._fault())
        return np.asarray(bundle.shared.copy())

    def _observe(
        self, part: Part, times: FloatArray, states: FloatArray, flat: FloatArray
    ) -> tuple[dict[str, FloatArray], FloatArray]:
        """Return every channel of a bearing, and force and moment of its contacts on the shaft, (n, 6)."""
        context, n = part.alone, times.size
        begin = L.NB * part.first_ball
        kept = states.shape[1] - self._bundle.states.size + part.first_state
        own = flat.reshape(n, -1, L.NS)[:, list(part.bodies)].reshape(n, -1)[:, context.bundle.active]
        y = np.ascontiguousarray(np.concatenate([
            states[:, begin : begin + L.NB * part.balls], own, states[:, kept : kept + context.bundle.states.size]
        ], axis=1))  # fmt: skip
        scratch, wrenches, evaluate = Scratch.of(n, context), np.zeros((n, 6)), self._core.evaluate_pointer
        for i in range(n):
            rows = [array[i : i + 1] for array in scratch[:-1]]
            ok = self._core.observe(
                times[i : i + 1], y[i : i + 1], context.bundle, evaluate, SHORTED, *rows, scratch.dydt
            )
            if ok != 1:
                raise SolverError(f"{part.bearing.name}: {fault_sentence(context, float(times[i]))}")
            wrenches[i] = context.bundle.body_wrenches.view(np.float64)[:6]
        return channels_of(1, context, times, y, scratch), wrenches

    def _add_up(self, i: int, channels: Mapping[str, FloatArray]) -> None:
        """Go on with the integrals of what only samples say, by the trapezium rule."""
        columns = [channels["loss"][:, LOSSES.index(name)] for name in (*_SHARED, _WAVES)]
        speed = channels["body_spin"][:, INNER]
        rates = np.column_stack([*columns, channels["input_torque"] * speed, channels["body_position"][:, INNER]])
        if len(self._last) <= i:
            self._last.append(rates[0])
        steps = np.diff(np.concatenate([[self._last_time], channels["time"]]))[:, None]
        around = np.concatenate([self._last[i][None], rates])
        grown = np.concatenate([self._sampled[i][None], 0.5 * steps * (around[1:] + around[:-1])])
        self._sampled[i] = np.add.accumulate(grown)[-1]  # one after the other: the same bits in blocks of any length
        self._last[i] = rates[-1]

    # -- running integrals --

    def _stored(self) -> float:
        """Return kinetic and elastic energy now [J]."""
        powers = L.power_count(self._bundle)
        extra, one = np.zeros((1, powers + 2)), np.zeros((1, 1, 3))
        self._core.sample(
            self._handle, np.array([self.time]), self._memory.y.reshape(1, -1), -1.0, np.zeros((1, 1, 1, 16)), one,
            one.copy(), extra, np.zeros((1, self._bundle.shared.size)), np.zeros((1, powers)), np.zeros(self.states),
        )  # fmt: skip
        return float(extra[0, 0])

    def _angles(self) -> FloatArray:
        """Return the angles of all cages, then those of all inner rings [rad]."""
        flat, tail = np.zeros(self._bundle.shared.size), L.NB * int(self._bundle.system["balls"][0])
        flat[self._bundle.active] = self._memory.y[tail : tail + self._bundle.active.size]
        angles = flat.view(R.BODY_STATE)["angle"]
        return np.array([float(angles[part.bodies[body]]) for body in (CAGE, INNER) for part in self.parts])

    def integrals(self) -> list[dict[str, float]]:
        """Return the running integrals of every bearing since the start, as a run of it alone has them.

        What its raceways dissipate is exact; pocket, land and drag are known exactly for all bearings together and are
        parted by their samples. Energy is balanced for the whole: input is that of the whole less what the other
        bearings and the dampers of the shaft dissipate, stored that of the whole, so that the residual is the whole's.
        """
        self._drain()
        values, count = self._memory.integrals, len(self.parts)
        so_far = running(values)
        parted = self._sampled[:, : len(_SHARED)]
        sums = parted.sum(axis=0)
        shares = np.where(sums > 0.0, parted / np.where(sums > 0.0, sums, 1.0), 1.0 / count)
        losses = []
        for i, part in enumerate(self.parts):
            own = losses_of_raceways(part.alone.model.geometry, values, part.first_raceway)
            own |= {name: float(so_far[name]) * float(shares[i, k]) for k, name in enumerate(_SHARED)}
            losses.append(own)
        every = sum(sum(own.values()) for own in losses) + float(so_far["support"])  # dampers of the shaft, too
        for i, own in enumerate(losses):
            own[_WAVES] = float(self._sampled[i, len(_SHARED)])
        turned = (self._angles() - self._start_angles).tolist()
        return [
            {
                **{f"loss.{name}": value for name, value in own.items()},
                "input": float(so_far["input"]) - (every - sum(own.values())),
                "input_abs": float(so_far["input_abs"]),
                "drive": float(self._sampled[i, len(_SHARED) + 1]),
                "stored": self._stored() - self._start_energy,
                "relative_angle": float(so_far["relative_speed"]),
                "cage_angle": turned[i],
                "inner_angle": turned[count + i],
                **dict(zip("xyz", self._sampled[i, len(_SHARED) + 2 :].tolist(), strict=True)),
            }
            for i, own in enumerate(losses)
        ]

    def statistics(self) -> dict[str, float]:
        """Return counters of the integrator."""
        counted = {name: float(self._memory.count[name][0]) for name in _COUNTERS}
        steps, rest = self._memory.control["fourth_powers"][0], running(self._memory.integrals)["iteration"]
        return {**counted, "steps_to_the_fourth": float(steps), "iteration_work": float(rest)}

    def modes(self) -> list[tuple[float, float]]:
        """Return frequency [Hz] and damping ratio of the slowest modes of shaft, rings and bodies at `time`."""
        return ring_modes(self._bundle, self._blocks, self._memory.inertia, until=self.model.solver.resolve)

    def state(self) -> dict[str, NDArray[np.float64]]:
        """Return everything that a continuation needs."""
        parts: dict[str, NDArray[np.float64]] = {}
        for prefix, group in (("memory", self._memory), ("factors", self._factors), ("dense", self._dense)):
            arrays = group._asdict().items()
            parts |= {f"{prefix}.{name}": array.copy() for name, array in arrays if isinstance(array, np.ndarray)}
        for name in ("a", "b", "c", "d", "d_own", "changed", "newer", "cross", "shared", "parts"):
            parts[f"blocks.{name}"] = getattr(self._blocks, name).copy()
        parts["sampled"], parts["last"] = self._sampled.copy(), np.array(self._last)
        parts["start"] = np.array([self._last_time, self._start_energy, *self._start_angles])
        return parts

    def restore(self, state: Mapping[str, NDArray[np.float64]]) -> None:
        """Continue from what `state` returned; SolverError when that is of another model."""
        groups = {"memory": self._memory, "factors": self._factors, "blocks": self._blocks, "dense": self._dense}
        for key, saved in state.items():
            group, _, name = key.partition(".")
            if not name:
                continue
            array = getattr(groups[group], name)
            if array.shape != saved.shape or array.dtype != saved.dtype:
                raise SolverError(f"the checkpoint does not fit this model: {key} has shape {saved.shape}")
            array[...] = saved
        self._sampled, self._last = state["sampled"].copy(), list(state["last"])
        self._last_time, self._start_energy = float(state["start"][0]), float(state["start"][1])
        self._start_angles = state["start"][2:].copy()
