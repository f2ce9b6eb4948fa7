"""Start and read the motion of a machine."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.elements import CAGE, DOFS, INNER, OUTER, POSE, SPIN
from lambda_core.formulas.elastic.beam import NODE
from lambda_core.model.bearing_model import Body, DofState, TimeFunction
from lambda_core.model.bodies.locations import carried, carried_by_shaft
from lambda_core.model.laws.time_functions import initial, spin_at_start
from lambda_core.model.machine_model import GROUND, PLACES, SHAFT, BearingPart, MachineModel
from lambda_core.solver import records as R
from lambda_core.solver.arrays import bundle as L
from lambda_core.solver.drivers.assembly import Assembly, BearingSpan
from lambda_core.solver.drivers.compiled_laws import Announce, derive_oils
from lambda_core.solver.drivers.dynamics import CAPACITY, MotionEngine, MotionStart, initial_state
from lambda_core.solver.drivers.engine import usual_interval
from lambda_core.solver.drivers.equilibrium import Equilibrium
from lambda_core.solver.drivers.external_inputs import machine_inputs, no_inputs
from lambda_core.solver.drivers.lumps import LumpedShaft, lump, unbalance_of_lumps
from lambda_core.solver.drivers.machine_assembly import machine_assembly, member_numbers, with_free_bodies
from lambda_core.solver.drivers.machine_statics import MachineState, solve_machine
from lambda_core.solver.drivers.readings import Channels, MachineReadings, MachineSamples, ReadBearing, Seen, Sums
from lambda_core.solver.drivers.row_cages import cages_in, own_bodies, put_cages
from lambda_core.solver.drivers.solver_context import SolverContext, assemble, context_of
from lambda_core.solver.drivers.surface_steps import longest_step
from lambda_core.solver.drivers.tables import SIGNS, STATES

# State that each displacement of POSE moves, and its sign.
RING_STATES, RING_SIGNS = STATES[np.array(PLACES)], SIGNS[np.array(PLACES)]
_AXES = 3


@dataclass(frozen=True)
class MachineStart:
    """A machine at t = 0.

    Attributes
    ----------
    machine : MachineModel
    shaft : LumpedShaft
    state : MachineState
        The quasi-static equilibrium of shaft, rings and bodies.
    equilibria : tuple of Equilibrium
        Of each bearing there, with the friction of its balls.
    motion : MotionStart
        What the engine begins with.
    readings : MachineReadings
    """

    machine: MachineModel
    shaft: LumpedShaft
    state: MachineState
    equilibria: tuple[Equilibrium, ...]
    motion: MotionStart
    readings: MachineReadings

    @property
    def drive_torque(self) -> float:
        """Mean frictionless torque of the coupling [N m].

        NaN where torques change or one drives the shaft.
        """
        is_given = self.machine.has_changing_torque or self.machine.torque is not None
        return math.nan if is_given else self.state.drive_torque


def machine_start(
    machine: MachineModel, announce: Announce = None, *, is_given: bool = False, guides_cages: bool = False
) -> MachineStart:
    """Return a machine in equilibrium at t = 0.

    The equilibrium is quasi-static.

    Parameters
    ----------
    is_given : bool
        Whether another program gives loads and speed.
    guides_cages : bool
        Whether cages follow their kinematic paths: centred, at the mean orbital speed of the balls.

    Raises
    ------
    SolverError
        When there is none.
    """
    state, shaft = solve_machine(machine, announce), lump(machine)
    # where cages follow given paths, balls begin between rings at the poses of the equilibrium
    equilibria = tuple(ring.at_pose() if guides_cages else ring.equilibrium() for ring in state.rings)
    alone = [_free(found.context) for found in equilibria]
    begun = _begun(machine, shaft, state, equilibria, alone, is_given=is_given, guides_cages=guides_cages)
    if guides_cages or state.rings[0].alone is None:
        return begun
    return replace(begun, motion=replace(begun.motion, state=initial_state(equilibria[0])))


def changed_start(start: MachineStart, machine: MachineModel) -> MachineStart:
    """Return the start of a changed model.

    It is a machine's, in the state and with the contact frames of the first model.
    """
    alone = [
        assemble(with_free_bodies(one.model), old.kernels, old.frame, derive_oils(one.model, old.kernels, old.frame))
        for one, old in zip(machine.bearings, (found.context for found in start.equilibria), strict=True)
    ]
    given = bool(start.motion.inputs.names)
    return _begun(machine, lump(machine), start.state, start.equilibria, alone, is_given=given)


def _begun(
    machine: MachineModel, shaft: LumpedShaft, state: MachineState, equilibria: tuple[Equilibrium, ...],
    alone: list[SolverContext], *, is_given: bool, guides_cages: bool = False,
) -> MachineStart:  # fmt: skip
    """Return a machine at t = 0.

    It is in an equilibrium, and each bearing has a context of its own.
    """
    assembly = machine_assembly(machine, shaft, [(one.kernels, one.frame, one.oils) for one in alone])
    context = context_of(_with_guided_cages(assembly, equilibria, state.outer) if guides_cages else assembly)
    names = [bearing.name for bearing in machine.bearings]
    bearings = tuple(map(ReadBearing, names, alone, context.assembly.spans()))
    inputs = machine_inputs(machine, shaft, context) if is_given else no_inputs()
    changes = any(term.kind != "constant" for function in machine.prescribed_motions for term in function.terms)
    changes = changes or guides_cages or inputs.turns
    solvers = [bearing.model.solver for bearing in machine.bearings]
    intervals = [
        one.model.output.interval or usual_interval(one.model, found.orbit)
        for one, found in zip(machine.bearings, equilibria, strict=True)
    ]
    steps = [min(own.max_step, longest_step(one)) for own, one in zip(solvers, alone, strict=True)]
    readings = MachineReadings(
        context, bearings, MemberChannels(machine, shaft), None if changes else _standing(machine, shaft, context)
    )
    motion = MotionStart(
        context=context,
        state=_start_state(machine, shaft, context, bearings, state, equilibria),
        readings=readings,
        tolerance=min(own.tolerance for own in solvers),
        sample_interval=min(intervals),
        longest_step=min(steps),
        resolve=machine.solver.resolve,
        modes_until=machine.solver.resolve,
        inputs=inputs,
    )
    return MachineStart(machine, shaft, state, equilibria, motion, readings)


class MachineEngine(MotionEngine):
    """The dynamics of a machine, started from its quasi-static equilibrium.

    Parameters
    ----------
    start : MachineStart
    announce : callable, optional
        Called with a sentence before something is compiled.
    capacity : int
        Samples that the buffer holds.
    """

    def __init__(self, start: MachineStart, announce: Announce = None, *, capacity: int = CAPACITY) -> None:
        super().__init__(start.motion, announce, capacity=capacity)
        self.start = start

    def samples(self) -> MachineSamples:
        """Return and clear the buffered samples."""
        return self.all_samples()

    def integrals(self) -> list[Sums]:
        """Return the running integrals of every bearing."""
        return self.all_integrals()

    def now(self) -> MachineSamples:
        """Return every channel at `time`.

        They are those of the machine and of its bearings.
        """
        found = self.start.readings.seen(np.array([self.time]), self._memory.y.reshape(1, -1))
        machine, *bearings = (
            {name: values[0] for name, values in channels.items()} for channels in (found.machine, *found.bearings)
        )
        return MachineSamples(machine, bearings)

    def seen(self) -> Seen:
        """Return channels and reactions at `time`."""
        found, names = self.now(), [one.name for one in self.bearings]
        pairs = zip(found.machine["reaction_force"], found.machine["reaction_moment"], strict=True)
        reactions = dict(zip(names, map(np.concatenate, pairs), strict=True))
        return Seen(found.machine, reactions, dict(zip(names, found.bearings, strict=True)))

    @property
    def model(self) -> MachineModel:
        """Model in motion."""
        return self.start.machine


def machine_engine(machine: MachineModel, announce: Announce = None) -> MachineEngine:
    """Return the dynamics of a machine at t = 0.

    Raises
    ------
    SolverError
        When there is no equilibrium to start from.
    """
    return MachineEngine(machine_start(machine, announce), announce)


def _with_guided_cages(assembly: Assembly, equilibria: tuple[Equilibrium, ...], outer: FloatArray) -> Assembly:
    """Return an assembly with guided cages.

    They follow the balls: centred on them, at their mean orbital speed.
    """
    members = list(assembly.members)
    for bearing, found, pose in zip(assembly.bearings, equilibria, outer, strict=True):
        number = bearing.members[CAGE]
        x = float(np.mean(L.elements_in(found.context.bundle, found.state)["x"])) + float(pose[0])
        dofs = dict.fromkeys(DOFS, DofState("locked"))
        dofs |= {"x": DofState("prescribed", TimeFunction.constant(x))}
        dofs |= {SPIN: DofState("prescribed", TimeFunction.constant(found.orbit))}
        members[number] = replace(members[number], body=replace(members[number].body, dofs=dofs))
    return replace(assembly, members=tuple(members))


def _free(found: SolverContext) -> SolverContext:
    """Return the context with free bodies.

    The bearing is the same; its bodies are free in every direction.
    """
    return assemble(with_free_bodies(found.model), found.kernels, found.frame, found.oils)


def _start_state(
    machine: MachineModel, shaft: LumpedShaft, context: SolverContext, bearings: tuple[ReadBearing, ...],
    state: MachineState, equilibria: tuple[Equilibrium, ...],
) -> FloatArray:  # fmt: skip
    """Return the initial state of the motion.

    It is the equilibrium with every ball at its cage's speed.
    """
    bodies, numbers = np.zeros(context.bundle.bodies.size, R.BODY_STATE), member_numbers(machine, shaft)
    flat = bodies.view(np.float64)
    moved = np.array([state.displacement[machine.body.rows(float(x))] for x in shaft.positions])
    for body, own, azimuth in zip(numbers.lumps, moved, unbalance_of_lumps(machine, shaft)[1], strict=True):
        flat[L.NS * body + STATES] = SIGNS * own
        bodies["angle"][body] *= machine.twists
        bodies["angle"][body] += azimuth  # a body's unbalance points to its own angle 0
        bodies["spin"][body] = machine.speed
    for body, own in zip(numbers.bodies, state.bodies, strict=True):
        flat[L.NS * body + STATES] = SIGNS * own
    balls, kept = [], []
    for one, found, outer in zip(bearings, equilibria, state.outer, strict=True):
        y = initial_state(found)
        flat[L.NS * one.span.bodies[OUTER] + RING_STATES] = RING_SIGNS * outer
        own = np.zeros(found.context.bundle.bodies.size, R.BODY_STATE)
        own.view(np.float64)[found.context.bundle.active] = found.context.shared_part(y)
        _place_cage(bodies, own, one.span, found, outer)
        balls.append(_carried(L.elements_in(found.context.bundle, y).copy(), outer).view(np.float64))
        kept.append(y[y.size - found.context.bundle.states.size :])
    return np.concatenate([*balls, flat[context.bundle.active], *kept])


def _place_cage(bodies: np.ndarray, own: np.ndarray, span: BearingSpan, found: Equilibrium, outer: FloatArray) -> None:
    """Write the states of cages and waves.

    The parts are elastic; the states come from the bearing alone.
    """
    first = own_bodies(found.context.model)
    own["position"][CAGE:first] += outer[:3]
    bodies[list(span.bodies[CAGE:first])] = own[CAGE:first]
    for body, wave, row in zip(span.bodies[first:], own[first:], found.context.bundle.waves, strict=True):
        # waves stand in the material of their ring, which a lump's unbalance has turned
        turned = float(row["order"] * bodies["angle"][span.bodies[INNER]]) if row["ring"] == INNER else 0.0
        c, s = math.cos(turned), math.sin(turned)
        _, cosine, sine = wave["position"]
        bodies["position"][body, 1:] = cosine * c + sine * s, sine * c - cosine * s


def _carried(balls: np.ndarray, pose: FloatArray) -> np.ndarray:
    """Move balls with an outer ring.

    The ring moves by a small pose.
    """
    x, y, z = balls["x"], balls["radius"] * np.cos(balls["azimuth"]), balls["radius"] * np.sin(balls["azimuth"])
    about_y, about_z = pose[3], pose[4]
    balls["x"] = x + pose[0] + about_y * z - about_z * y
    y, z = y + pose[1] + about_z * x, z + pose[2] - about_y * x
    turned = np.arctan2(z, y) - balls["azimuth"]
    balls["azimuth"] += np.remainder(turned + math.pi, 2.0 * math.pi) - math.pi
    balls["radius"] = np.hypot(y, z)
    return balls


def _standing(machine: MachineModel, shaft: LumpedShaft, context: SolverContext) -> FloatArray:
    """Return the complete shared state at rest.

    Prescribed values do not change, and free ones are missing.
    """
    numbers = member_numbers(machine, shaft)
    flat = np.zeros(context.bundle.shared.size)
    flat.view(R.BODY_STATE)["spin"][numbers.lumps] = machine.speed
    if machine.hold is not None:
        lump = int(numbers.lumps[shaft.at(machine.hold.position)])
        flat[L.NS * lump + RING_STATES] = RING_SIGNS * machine.hold.shift
    for outer, bearing in zip(numbers.outer_rings, machine.bearings, strict=True):
        flat[L.NS * outer + RING_STATES] = RING_SIGNS * bearing.seating.shift
        flat.view(R.BODY_STATE)["spin"][outer] = spin_at_start(bearing.model.outer_ring)
    put_cages(context.assembly, flat.view(R.BODY_STATE)["position"])
    for span, bearing in zip(context.assembly.spans(), machine.bearings, strict=True):
        for cage in cages_in(span.bodies, bearing.model):
            flat[L.NS * cage + RING_STATES] += RING_SIGNS * _pose(bearing.model.cage_body)
            flat.view(R.BODY_STATE)["spin"][cage] = spin_at_start(bearing.model.cage_body)
    for number, rigid in zip(numbers.bodies, machine.bodies, strict=True):
        flat[L.NS * number + STATES] = SIGNS * rigid.shift
    return flat


def _pose(body: Body) -> FloatArray:
    """Return a body's held pose at t = 0.

    It has the order of POSE and is 0 where the body is free or locked.
    """
    return np.array([initial(body.dofs[dof].motion) if body.dofs[dof].mode == "prescribed" else 0.0 for dof in POSE])


class MemberChannels:
    """Motions of shaft, bodies and markers.

    They come from the states of members.
    """

    def __init__(self, machine: MachineModel, shaft: LumpedShaft) -> None:
        self._machine, self._shaft = machine, shaft
        self._numbers = member_numbers(machine, shaft)
        self._azimuths = unbalance_of_lumps(machine, shaft)[1]
        count = len(machine.markers)
        self._of_lumps = np.zeros((count, _AXES, NODE * shaft.positions.size))
        # rings and cages move their markers as bodies do; their rotation moves none, as that of the shaft
        self._parts = [*self._numbers.outer_rings, *self._numbers.cages]
        self._of_bodies = np.zeros((count, _AXES, NODE * (len(machine.bodies) + len(self._parts))))
        for k, (_, place) in enumerate(machine.markers):
            if place.body == SHAFT:
                at, moves = carried_by_shaft(machine.body, place.point)
                node = shaft.follow[machine.body.rows(at), : self._of_lumps.shape[2]]
                self._of_lumps[k] = (moves @ node)[:_AXES]
            elif place.body != GROUND:
                number, centre = self._body(place.body)
                first, arm = NODE * number, np.subtract(place.point, centre)
                self._of_bodies[k, :, first : first + NODE] = carried(arm)[:_AXES]

    def _body(self, body: int | BearingPart) -> tuple[int, tuple[float, float, float]]:
        """Return a body's number and place [m].

        Among rigid bodies, outer rings and cages; the place is where its centre is drawn.
        """
        if not isinstance(body, BearingPart):
            return body - 1, self._machine.bodies[body - 1].centre
        number = self._parts.index(self._numbers.part(self._machine, body))
        position = self._machine.bearings[self._machine.index(body)].position
        return len(self._machine.bodies) + number, (position, 0.0, 0.0)

    def __call__(self, times: FloatArray, flat: FloatArray) -> Channels:
        """Return the channels from shared states.

        The argument is the complete shared state of samples, shape (n, 12 bodies).
        """
        bodies = flat.view(R.BODY_STATE)
        lumps, twist = bodies[:, self._numbers.lumps], self._twist(flat)
        rigid = _motions(bodies[:, self._numbers.bodies])
        return {
            "shaft_position": lumps["position"].copy(),
            "shaft_tilt": np.stack([-lumps["tilt"][:, :, 1], lumps["tilt"][:, :, 0]], axis=2),
            "shaft_twist": twist,
            "body_position": rigid[:, :, :3],
            "body_tilt": rigid[:, :, 3:],
            "marker_position": self._markers(_motions(lumps, twist), self._with_parts(bodies, rigid)),
        }

    def _with_parts(self, bodies: np.ndarray, rigid: FloatArray) -> FloatArray:
        """Return the motions of bodies and parts.

        Rigid bodies come first, then outer rings and cages without their rotation.
        """
        parts = bodies[:, self._parts]
        return np.concatenate([rigid, _motions(parts, np.zeros(parts.shape))], axis=1)

    def _twist(self, flat: FloatArray) -> FloatArray:
        """Return the lumps' twist [rad].

        How far they have turned beyond the coupling, shape (n, lumps).
        """
        angles = flat.view(R.BODY_STATE)["angle"]
        found: FloatArray = angles[:, self._numbers.lumps] - self._azimuths
        if not self._machine.twists:
            return np.zeros_like(found)
        lead = angles[:, self._numbers.driven] - np.append(self._azimuths, 0.0)[[self._shaft.driven]]
        return np.asarray(found - lead)

    def _markers(self, lumps: FloatArray, bodies: FloatArray) -> FloatArray:
        """Return x, y, z of every marker.

        They have the shape (n, markers, 3) and follow from motions of shape (n, lumps or bodies, 6).
        """
        n = len(lumps)
        found: FloatArray = np.einsum("maj,nj->nma", self._of_lumps, lumps.reshape(n, -1))
        found += np.einsum("maj,nj->nma", self._of_bodies, bodies.reshape(n, -1))
        return found


def _motions(bodies: np.ndarray, twist: FloatArray | None = None) -> FloatArray:
    """Return the bodies' motions in samples.

    They are x, y, z and turns about x, y, z, shape (n, bodies, 6), with `twist` in place of angles.
    """
    about = bodies["angle"] if twist is None else twist
    turns = [about[..., None], -bodies["tilt"][..., 1:], bodies["tilt"][..., :1]]
    return np.concatenate([bodies["position"], *turns], axis=-1)
