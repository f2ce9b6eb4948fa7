"""Solve the quasi-static equilibrium of a shaft.

It uses Newton's method on shaft nodes and outer rings.

Every bearing answers a pose of its inner ring against the outer one with a force, a moment and a stiffness, its balls
in equilibrium throughout. Contacts open and close, so that the steps are damped as Levenberg and Marquardt do:
a spring to the last state at every ring, softer as the residual falls; each step ends where the potential does.

The equilibrium of a bearing alone (:mod:`~lambda_core.solver.drivers.equilibrium`) is another job: its loads are given
and rolling friction counts among them. Here loads follow from the poses of all rings; each bearing of the solution is
then handed to that module, which finds the motion of its balls with friction.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.elements import POSE
from lambda_core.domain.errors import SolverError
from lambda_core.formulas.elastic.beam import NODE
from lambda_core.model.bearing_model import BearingModel, Body
from lambda_core.model.laws.time_functions import initial
from lambda_core.model.machine_model import GROUND, PLACES, BearingPart, MachineModel, MountedBearing
from lambda_core.solver.drivers.bearing_reaction import BearingReaction
from lambda_core.solver.drivers.compiled_laws import Announce, Kernels
from lambda_core.solver.drivers.first_state import free_contact_angle
from lambda_core.solver.drivers.link_forces import SolvedLink, link_forces
from lambda_core.solver.drivers.rigid_shaft import bearing_on_rigid_shaft
from lambda_core.solver.drivers.roller_reaction import Ring, RollerReaction
from lambda_core.solver.drivers.structure import static_rows, structure
from lambda_core.solver.drivers.unconstrained_motion import unconstrained_motion

_GUESS = np.array([5e7, 1e8, 1e8, 1e3, 1e3])  # [N/m, N m/rad] of a bearing before its contacts are known
_LOOSE = np.array([0.0, 1.0, 1.0, 1.0, 1.0])  # of rollers that nothing holds along x
_ITERATIONS, _FRAMES, _TRIES = 100, 6, 20
_CONVERGED, _ROUNDING = 1e-9, 1e-6  # residual over the loads: wanted; where the balls' own tolerance may end it
_DAMPING, _LEAST_DAMPING = 1e-3, 1e-10  # of _GUESS
_SLOPE, _NARROW = 0.5, 1e-3  # of the first slope, of the step: where a search along a step ends
_ARMS = np.array([1.0, 1.0, 1.0, 0.03, 0.03])  # [m] at which tilts are lengths
_AXES = ("x", "y", "z", "tilt_x", "tilt_y", "tilt_z")
_LONGEST = 2e-4  # [m] largest move of a ring per step; tilts count at the pitch radius


@dataclass
class MachineState:
    """The solution.

    Attributes
    ----------
    displacement : float64[:], shape (6 n,)
        Of the shaft's nodes [m, rad].
    outer : float64[:, :], shape (bearings, 5)
        Of the outer rings in the order of POSE.
    bodies : float64[:, :], shape (bodies, 6)
        Of the other bodies [m, rad].
    reactions : float64[:, :], shape (bearings, 5)
        Force and moment of each bearing on the shaft [N, N m].
    stiffness : float64[:, :, :], shape (bearings, 5, 5)
        Of each bearing alone.
    rings : list of BearingReaction or RollerReaction
        At their last poses.
    drive_torque : float
        Of the coupling on the shaft [N m].
    residual : float
        Largest unbalanced force over the loads.
    iterations : int
        Of Newton's method.
    links : list of SolvedLink
        Connections by laws.
    """

    displacement: FloatArray
    outer: FloatArray
    bodies: FloatArray
    reactions: FloatArray
    stiffness: FloatArray
    rings: list[Ring]
    drive_torque: float
    residual: float
    iterations: int
    links: list[SolvedLink]

    @property
    def motions(self) -> FloatArray:
        """Motions of shaft, outer rings and bodies.

        The rows are those of structure.static_rows.
        """
        return np.concatenate([self.displacement, self.outer.ravel(), self.bodies.ravel()])

    def pose(self, model: MachineModel, index: int) -> FloatArray:
        """Return a bearing's relative pose.

        It is that of its inner ring against its outer one, shape (5,).
        """
        rows = model.body.rows(model.bearings[index].position).start + np.array(PLACES)
        return np.asarray(self.displacement[rows] - self.outer[index])


class _System:
    """Unknowns of a machine and their forces.

    One vector holds shaft, outer rings and other bodies.

    The shaft's are the pose of the node that the coupling holds and, of all others, what they move relative to a rigid
    shaft with that pose. Elastic forces then are those of deflections alone: however stiff the shaft is, its motion as
    a rigid body leaves no rounding in them.
    """

    def __init__(self, model: MachineModel, rings: list[Ring], kernels: Kernels) -> None:
        self.model, self.rings = model, rings
        rows = static_rows(model)
        self.size, count = rows.rings, rows.size
        self.outer = np.arange(rows.rings, rows.bodies).reshape(len(rings), len(POSE))
        self.links = link_forces(model, rows, rings, kernels)
        frame = np.arange(NODE) + NODE * (model.drive // NODE)
        if model.hold is not None:  # a rigid shaft turns with the coupling and moves with what holds it
            frame[list(PLACES)] = model.body.rows(model.hold.position).start + np.array(PLACES)
        self.moves = np.eye(count)  # of shaft, rings and bodies with the unknowns
        self.moves[: self.size, : self.size] = _carried(model, frame)
        deflects = np.setdiff1d(np.arange(self.size), frame)
        self.linear: FloatArray = np.zeros((count, count))
        self.linear[np.ix_(deflects, deflects)] = model.body.stiffness[np.ix_(deflects, deflects)]
        holds = [k for body in model.bodies for k in body.hold]  # six of each; inf where locked
        held = [model.drive, *(rows.bodies + np.flatnonzero(np.isinf(holds))).tolist()]
        self.start = np.zeros(count)
        ties = structure(model, rows)[0]
        given = np.zeros(count)
        acting = model.loads + model.weight + model.growth
        given[: self.size], given[rows.bodies :] = acting[: self.size], acting[self.size :]
        for own, bearing in zip(self.outer, model.bearings, strict=True):
            given[model.body.rows(bearing.position)][:3] += weight_of(model, bearing.model.inner_ring)
            self.start[own] = bearing.seating.shift
            given[own] += seat_load(model, bearing)
            is_held = np.isinf(bearing.seating.stiffness) & (model.housing is None or bearing.carrier != GROUND)
            held += own[is_held].tolist()
        if model.housing is not None:
            own = self.outer.ravel()
            ties[np.ix_(own, own)] += model.housing
        self.linear += self.moves.T @ ties @ self.moves
        self.given = self.moves.T @ (given + ties @ self.start)
        self.start[rows.bodies :] = np.ravel([body.shift for body in model.bodies])
        if model.hold is not None:
            own = frame[np.array(PLACES)[list(model.hold.held)]]
            held += own.tolist()
            self.start[own] = np.array(model.hold.shift)[list(model.hold.held)]
        self.free = np.setdiff1d(np.arange(count), held)
        # of every bearing, how its inner ring moves against its outer one, shape (bearings, 5, unknowns)
        self.reach = np.zeros((len(rings), len(POSE), count))
        for reach, outer, bearing in zip(self.reach, self.outer, model.bearings, strict=True):
            reach[:] = self.moves[model.body.rows(bearing.position).start + np.array(PLACES)]
            reach[range(len(POSE)), outer] = -1.0
        # lengths that make moments forces: residuals of one kind
        arms = np.ones(count)
        length = float(np.ptp(model.body.positions)) or model.bearings[0].model.geometry.pitch_diameter
        arms[: NODE * model.body.positions.size].reshape(-1, NODE)[:, 3:] = length
        arms[self.outer[:, 3:]] = length
        arms[rows.bodies :].reshape(-1, NODE)[:, 3:] = length
        self.arms = arms
        loads = np.abs(model.loads + model.weight) / np.concatenate([arms[: self.size], arms[rows.bodies :]])
        on_rings = [float(np.abs(seat_load(model, b)[:3]).max()) for b in model.bearings]
        self.scale = max(float(loads.max()), *on_rings, 1.0)
        self.carried = 0.0  # largest reaction of a bearing at the last state [N]

    def poses(self, q: FloatArray) -> FloatArray:
        """Return every inner ring's relative pose.

        It is relative to the outer ring; the array has shape (bearings, 5).
        """
        return np.asarray(self.reach @ q)

    def residual(self, q: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return residual and bearing reactions.

        The residual is unbalanced [N, N m]; the reactions act on the shaft.
        """
        reactions = np.array([ring.reaction(pose) for ring, pose in zip(self.rings, self.poses(q), strict=True)])
        self.carried = float(np.abs(reactions[:, :3]).max())
        pushed = np.asarray(np.einsum("bij,bi->j", self.reach, reactions))
        return self.elastic(q) + pushed, reactions

    def elastic(self, q: FloatArray) -> FloatArray:
        """Return what is unbalanced without the bearings [N, N m]."""
        found: FloatArray = self.given - self.linear @ q
        for link in self.links:
            found += self.moves.T @ link.force(self.moves @ q)
        return found

    def tangent(self, each: FloatArray, q: FloatArray) -> FloatArray:
        """Return the machine's stiffness.

        Every bearing adds a matrix of shape (5, 5).
        """
        found = np.asarray(self.linear + sum(reach.T @ k @ reach for reach, k in zip(self.reach, each, strict=True)))
        for link in self.links:
            found = found + self.moves.T @ link.slope(self.moves @ q) @ self.moves
        return found

    def unknowns(self, state: MachineState) -> FloatArray:
        """Return the unknowns of a state.

        Held ones have the places of this machine.
        """
        found = self.start.copy()
        found[self.free] = np.linalg.solve(self.moves, state.motions)[self.free]
        return found

    def merit(self, unbalanced: FloatArray) -> float:
        """Return the size of the residual over the loads."""
        return float(np.linalg.norm((unbalanced / self.arms)[self.free])) / max(self.scale, self.carried)

    def step(self, tangent: FloatArray, unbalanced: FloatArray) -> FloatArray:
        """Return the step of the free unknowns, zeros elsewhere."""
        move = np.zeros(unbalanced.size)
        block = tangent[np.ix_(self.free, self.free)]
        # of one unit and size: the condition is that of the structure, however stiff parts of it are
        # (a ball that only the centrifugal force presses may give a direction a stiffness of 0 or less)
        size = np.where(np.diag(block) > 0.0, np.diag(block), np.abs(block).max(axis=1))
        scale = 1.0 / np.sqrt(np.maximum(size, np.finfo(float).tiny))
        scaled, pull = block * np.outer(scale, scale), scale * unbalanced[self.free]
        try:
            move[self.free] = scale * np.linalg.solve(scaled, pull)
        except np.linalg.LinAlgError:  # nothing holds it in some direction: the search ends there and says which
            move[self.free] = scale * np.linalg.lstsq(scaled, pull)[0]
        return move


def seat_load(model: MachineModel, bearing: MountedBearing) -> FloatArray:
    """Return an outer ring's load at t = 0.

    It has force and moment in the order of POSE [N, N m].
    """
    load = model.load_on(BearingPart(bearing.name, "outer_ring"))
    found = np.array([initial(load[row]) for row in PLACES])
    found[0] += bearing.seating.force
    found[:3] += weight_of(model, bearing.model.outer_ring)
    return found


def weight_of(model: MachineModel, ring: Body) -> FloatArray:
    """Return a ring's weight x, y, z [N].

    The weight of the rolling elements counts in motion only.
    """
    return ring.mass * np.array(model.gravity)


def _carried(model: MachineModel, frame: NDArray[np.int64]) -> FloatArray:
    """Return the rows' motion by the unknowns.

    The unknowns are a node's pose, or the way relative to a rigid shaft.
    """
    found: FloatArray = np.eye(model.body.stiffness.shape[0])
    at = model.body.positions[frame[0] // NODE]
    for node, place in enumerate(model.body.positions):
        first = NODE * node
        found[range(first, first + NODE), frame] = 1.0
        found[first + 1, frame[5]], found[first + 2, frame[4]] = place - at, at - place  # tilts carry y and z along
    return found


class SharedKernels:
    """Compiled laws by their choice.

    Bearings on one shaft mostly have the same, and laws are tested once.
    """

    def __init__(self, announce: Announce = None) -> None:
        self._announce = announce
        self._known: dict[tuple[tuple[str, str, str], ...], Kernels] = {}

    def of(self, model: BearingModel, announce: Announce = None) -> Kernels:
        """Return the compiled laws of a bearing."""
        choice = tuple((e, r, law.model.label) for e, roles in model.laws.items() for r, law in roles.items())
        if choice not in self._known:
            self._known[choice] = Kernels(model, announce or self._announce)
        return self._known[choice]


def solve_machine(
    model: MachineModel,
    announce: Announce = None,
    kernels: SharedKernels | None = None,
    near: MachineState | None = None,
) -> MachineState:
    """Find the equilibrium of shaft, bearings and housing.

    Parameters
    ----------
    model : MachineModel
        From :func:`lambda_core.api.check`.
    announce : callable, optional
        Called with a sentence before something is compiled.
    kernels : SharedKernels, optional
        Of another shaft, whose laws need not be tried out again.
    near : MachineState, optional
        Of this machine in a condition nearby, where the search starts.

    Raises
    ------
    SolverError
        When there is none: nothing holds the shaft, or a bearing falls apart.
    """
    if model.awaits_temperatures:
        raise SolverError(f"{model.name}: internal error: temperatures must be computed before the equilibrium")
    shared = kernels or SharedKernels(announce)
    beginnings = [None] * len(model.bearings) if near is None else near.rings
    rings = [
        _ring(bearing, shared.of(bearing.model, announce), announce, beginning)
        for bearing, beginning in zip(model.bearings, beginnings, strict=True)
    ]
    system = _System(model, rings, shared.of(model.bearings[0].model))
    _refuse_loose(system)
    q = _first_guess(system) if near is None else system.unknowns(near)
    iterations = 0
    for _ in range(_FRAMES):
        q, used = _newton(system, q)
        iterations += used
        if not sum(ring.refresh() for ring in rings):
            break
    unbalanced, reactions = system.residual(q)
    _check_sides(model, reactions)
    rings[0].alone = bearing_on_rigid_shaft(model)
    torque = -float(unbalanced[model.drive])
    moved = system.moves @ q
    return MachineState(
        displacement=moved[: system.size],
        outer=q[system.outer],
        bodies=moved[system.outer.max() + 1 :].reshape(-1, NODE),
        reactions=reactions,
        stiffness=np.array([ring.stiffness() for ring in rings]),
        rings=rings,
        drive_torque=torque,
        residual=system.merit(unbalanced),
        iterations=iterations,
        links=[link.solved(moved) for link in system.links],
    )


def _ring(bearing: MountedBearing, kernels: Kernels, announce: Announce, near: Any) -> Ring:
    """Return a bearing by the pose of its inner ring."""
    model = bearing.model
    if model.rollers is not None:
        return RollerReaction(model, model.rollers, kernels, announce, near)
    angle = free_contact_angle(model) if bearing.takes else model.geometry.resting_angle
    return BearingReaction(model, angle, 1000.0, kernels, announce, near)


def _springs(rings: list[Ring]) -> FloatArray:
    """Return a stiffness before contacts are known.

    It is that of every bearing; the array has shape (bearings, 5, 5).
    """
    free = [isinstance(ring, RollerReaction) and not ring.holds_along for ring in rings]
    return np.array([np.diag(_GUESS * _LOOSE if is_free else _GUESS) for is_free in free])


def _first_guess(system: _System) -> FloatArray:
    """Return a first guess in contact.

    Every loaded bearing is in contact: springs first, then the way to touching rings.
    """
    model = system.model
    springs = _springs(system.rings)
    tangent, q = system.tangent(springs, system.start), system.start.copy()
    offset = np.zeros((len(system.rings), len(POSE)))
    for i, bearing in enumerate(model.bearings):
        if bearing.takes:
            offset[i, 0] = -system.start[system.outer[i, 0]]
    for _ in range(2):
        pull = system.elastic(system.start)
        forces = np.array([k @ o for k, o in zip(springs, offset, strict=True)])
        for i in range(len(system.rings)):
            pull += system.reach[i].T @ (forces[i] - springs[i] @ system.reach[i] @ system.start)
        q = system.start + system.step(tangent, pull)
        for i, bearing in enumerate(model.bearings):
            pushed = (system.poses(q)[i] - offset[i])[1:3]
            size = float(np.hypot(*pushed))
            if not bearing.takes and size > 0.0:
                offset[i, 1:3] = 0.5 * max(bearing.model.geometry.clearance, 0.0) * pushed / size
    return q


def _newton(system: _System, q: FloatArray) -> tuple[FloatArray, int]:
    """Return the balance next to `q`.

    Also return the number of iterations.
    """
    unbalanced, _ = system.residual(q)
    merit = system.merit(unbalanced)
    for iteration in range(_ITERATIONS):
        if merit < _CONVERGED:
            return q, iteration
        damping = min(_DAMPING, max(_LEAST_DAMPING, _DAMPING * merit))
        each = np.array([ring.stiffness() for ring in system.rings])
        move = system.step(system.tangent(each + damping * np.diag(_GUESS), q), unbalanced)
        longest = float(np.abs(system.poses(move) * _ARMS).max())
        move *= min(1.0, _LONGEST / max(longest, 1e-300))
        q, unbalanced = _along(system, q, move, unbalanced)
        before, merit = merit, system.merit(unbalanced)
        if merit < _ROUNDING and merit > 0.3 * before:
            return q, iteration
    raise SolverError(_no_balance(system, unbalanced, merit))


def _along(system: _System, q: FloatArray, move: FloatArray, unbalanced: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return the state of least potential.

    It lies along a step, to a share of the step's first slope.

    Forces of frictionless contacts have a potential; its slope along the step is the work of what is unbalanced. Where
    a gap closes along the way it turns over, and a secant finds where.
    """
    first = float(unbalanced @ move)
    if first <= 0.0:  # what is left is rounding
        return q + move, system.residual(q + move)[0]
    low, at_low, high, at_high = 0.0, first, 1.0, math.nan
    share = 1.0
    for _ in range(_TRIES):
        try:
            trial, _ = system.residual(q + share * move)
        except SolverError:
            high, at_high, share = share, math.nan, 0.5 * (low + share)
            continue
        slope = float(trial @ move)
        if slope >= -_SLOPE * abs(first):
            if math.isnan(at_high) or slope <= _SLOPE * abs(first) or high - low < _NARROW:
                break
            low, at_low = share, slope
        else:
            high, at_high = share, slope
        secant = low + (high - low) * at_low / (at_low - at_high) if at_high < 0.0 else 0.5 * (low + high)
        share = min(max(secant, low + 0.1 * (high - low)), high - 0.1 * (high - low))
    else:
        trial, _ = system.residual(q + share * move)
    return q + share * move, trial


def _refuse_loose(system: _System) -> None:
    """Refuse a loose shaft or body.

    Nothing holds it in a direction in which something pulls it.
    """
    held = system.tangent(_springs(system.rings), system.start)
    held = held[np.ix_(system.free, system.free)]
    pull = system.elastic(system.start)[system.free]
    way = unconstrained_motion(held, pull, system.arms[system.free], system.scale)
    if way is not None:
        axis, what = _named(system, int(system.free[np.flatnonzero(np.abs(way) > 0.99)[0]]))
        turned = f"against turning about {axis[-1]}" if axis.startswith("tilt") else f"along {axis}"
        raise SolverError(f"{system.model.name}: no equilibrium of the shaft: nothing holds it {turned} ({what})")


def _no_balance(system: _System, unbalanced: FloatArray, merit: float) -> str:
    sizes = np.abs(unbalanced / system.arms)
    of_rings = set(system.outer.ravel().tolist())
    axis, what = _named(
        system, int(max((row for row in system.free if row not in of_rings), key=lambda row: sizes[row]))
    )
    return (
        f"{system.model.name}: no equilibrium of the shaft: {merit:.1e} of the loads stay unbalanced, most "
        f"along {axis} {what}: is the shaft held in every direction, and does each bearing take what comes to it?"
    )


def _named(system: _System, row: int) -> tuple[str, str]:
    """Return the axis of an unknown, and where it is."""
    model, beyond = system.model, row - system.size
    if beyond >= system.outer.size:
        body, axis = divmod(beyond - system.outer.size, NODE)
        return _AXES[axis], f"of {model.bodies[body].name}"
    if beyond >= 0:
        bearing, place = divmod(beyond, len(POSE))
        return _AXES[PLACES[place]], f"outer ring of {model.bearings[bearing].name}"
    node, axis = divmod(row, NODE)
    if node < model.body.positions.size:
        return _AXES[axis], f"at {1e3 * model.body.positions[node]:.4g} mm"
    return "one", "of the shaft's own modes"


def _check_sides(model: MachineModel, reactions: FloatArray) -> None:
    """Refuse a bearing pushed to its open side.

    It is an angular contact bearing in a solution.
    """
    for bearing, reaction in zip(model.bearings, reactions, strict=True):
        if bearing.takes and reaction[0] * bearing.takes > 1e-6 * max(1.0, float(np.abs(reaction[:3]).max())):
            side = "+x" if bearing.takes > 0 else "-x"
            raise SolverError(
                f"{model.name}: {bearing.name} takes axial force along {side} and would have to take "
                f"{abs(reaction[0]):.4g} N the other way: change the arrangement or give more preload"
            )
