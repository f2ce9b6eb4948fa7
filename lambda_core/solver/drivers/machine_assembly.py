"""Describe a machine to the compiled solver.

Members stand in the order: first lump, outer ring of the first bearing, the other lumps, then the other outer rings and
cages bearing by bearing. A bearing's inner ring is the lump at its place; every bearing has its own origin at its place
along the shaft, so that all positions are displacements. Rigid bodies follow. Where the shaft twists and the coupling
turns it at none of the lumps, a member without mass comes last, whose angle leads.
"""

from __future__ import annotations

import dataclasses
import math
from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.elements import DOFS, POSE, SPIN
from lambda_core.formulas.elastic.beam import NODE
from lambda_core.model.bearing_model import ZERO, BearingModel, Body, DofState, TimeFunction
from lambda_core.model.laws.law_context import ContactFrame
from lambda_core.model.laws.time_functions import added, initial, scaled
from lambda_core.model.machine_model import GROUND, PLACES, SHAFT, BearingPart, Carrier, MachineModel, Place, RigidBody
from lambda_core.solver.drivers.assembly import AssembledBearing, AssembledLink, Assembly, Member, Ties
from lambda_core.solver.drivers.compiled_laws import Kernels
from lambda_core.solver.drivers.law_inputs import Oils
from lambda_core.solver.drivers.lumps import LumpedShaft, unbalance_of_lumps
from lambda_core.solver.drivers.structure import Rows, structure

_ABOUT_X = 3  # row of a node
_FREE, _LOCKED = DofState("free"), DofState("locked")
Frozen = tuple[Kernels, ContactFrame, Oils]  # laws of a bearing as they are compiled and frozen
Load = tuple[TimeFunction, ...]  # force x, y, z [N] and moment about x, y, z [N m]


@dataclass(frozen=True)
class MemberNumbers:
    """Numbers of the members of a machine.

    Attributes
    ----------
    lumps : int64[:]
    outer_rings, cages : tuple of ints
        Of each bearing.
    inner : tuple of ints
        Lump that carries the inner ring of each.
    bodies : int64[:]
    driven : int64[:]
        Members that the coupling turns: all lumps, or where the shaft twists one, or the member behind all.
    count : int
    """

    lumps: NDArray[np.int64]
    inner: tuple[int, ...]
    outer_rings: tuple[int, ...]
    cages: tuple[int, ...]
    bodies: NDArray[np.int64]
    driven: NDArray[np.int64]
    count: int

    def carrier(self, machine: MachineModel, body: Carrier) -> tuple[int, tuple[float, float, float]]:
        """Return a carrying member and its place [m].

        It is a rigid body or a part of a bearing; the place is where its centre is drawn.
        """
        if isinstance(body, BearingPart):
            return self.part(machine, body), (machine.bearings[machine.index(body)].position, 0.0, 0.0)
        return int(self.bodies[body - 1]), machine.bodies[body - 1].centre

    def part(self, machine: MachineModel, part: BearingPart) -> int:
        """Return the number of an outer ring or a cage."""
        return (self.outer_rings if part.part == "outer_ring" else self.cages)[machine.index(part)]


def member_numbers(machine: MachineModel, shaft: LumpedShaft) -> MemberNumbers:
    """Return the numbers of the members."""
    lumps, bearings = shaft.positions.size, len(machine.bearings)
    own = np.array([0, *range(2, lumps + 1)])
    with_mass = lumps + 2 * bearings + len(machine.bodies)
    driven = np.append(own, with_mass)[[shaft.driven]] if machine.twists else own
    return MemberNumbers(
        lumps=own,
        inner=tuple(int(own[shaft.at(bearing.position)]) for bearing in machine.bearings),
        outer_rings=(1, *(lumps + 2 * i for i in range(1, bearings))),
        cages=tuple(lumps + 2 * i + 1 for i in range(bearings)),
        bodies=np.arange(with_mass - len(machine.bodies), with_mass),
        driven=driven,
        count=max(with_mass, int(driven.max()) + 1),
    )


def with_free_bodies(model: BearingModel) -> BearingModel:
    """Return a bearing with free bodies.

    Rings and cage are free in every direction, without force elements of their own.
    """
    bodies = {name: getattr(model, name).freed(DOFS) for name in ("inner_ring", "outer_ring", "cage_body")}
    return dataclasses.replace(model, **bodies, links={})


def machine_assembly(machine: MachineModel, shaft: LumpedShaft, frozen: list[Frozen]) -> Assembly:
    """Return the assembly of a machine.

    Each bearing has its laws as they are frozen.
    """
    numbers = member_numbers(machine, shaft)
    members, ties = machine_members(machine, shaft)
    bearings = [
        AssembledBearing(
            mounted.name, with_free_bodies(mounted.model), kernels, angles, oils,
            (numbers.inner[i], numbers.outer_rings[i], numbers.cages[i]),
        )
        for i, (mounted, (kernels, angles, oils)) in enumerate(zip(machine.bearings, frozen, strict=True))
    ]  # fmt: skip
    return Assembly(members, tuple(bearings), machine.gravity, _links(machine, shaft, numbers), ties=ties)


def machine_members(machine: MachineModel, shaft: LumpedShaft) -> tuple[tuple[Member, ...], Ties]:
    """Return a machine's members and ties.

    Everything that has a motion, and what ties it together.
    """
    numbers = member_numbers(machine, shaft)
    members = _lumps(machine, shaft, numbers)
    for i, bearing in enumerate(machine.bearings):
        model = with_free_bodies(bearing.model)
        members[numbers.outer_rings[i]] = Member(f"{bearing.name} outer ring", _outer_ring(machine, i, model))
        cage = _loaded(machine.bearings[i].model.cage_body, machine.load_on(BearingPart(bearing.name, "cage")))
        members[numbers.cages[i]] = Member(f"{bearing.name} cage", cage)
    loads = _loads_on_bodies(machine)
    for k, rigid in enumerate(machine.bodies):
        members[int(numbers.bodies[k])] = Member(rigid.name, _rigid(rigid, loads[k]))
    for number in numbers.driven:  # the member without mass, where there is one
        members.setdefault(int(number), Member("coupling", Body(0.0, 0.0, 0.0, _turned(machine, _LOCKED))))
    ties = _as_supports(_ties(machine, shaft, numbers), members)
    return tuple(members[number] for number in range(numbers.count)), ties


def _as_supports(ties: Ties, members: dict[int, Member]) -> Ties:
    """Turn ground ties into supports.

    They hold members alone where they are drawn; return the remaining ties.
    """
    stiffness, damping = ties.stiffness.copy(), ties.damping.copy()
    for row, (number, direction) in enumerate(zip(ties.member.tolist(), ties.direction.tolist(), strict=True)):
        if direction == _ABOUT_X or ties.rest[row] or ties.joins_others(row):
            continue
        body, name = members[number].body, POSE[PLACES.index(direction)]
        held = body.dofs[name]
        if held.mode != "free":
            continue
        k, c = float(stiffness[row, row]), float(damping[row, row])
        dof = dataclasses.replace(held, stiffness=held.stiffness + k, damping=held.damping + c)
        supported = dataclasses.replace(body, dofs={**body.dofs, name: dof})
        members[number] = dataclasses.replace(members[number], body=supported)
        stiffness[row, row] = damping[row, row] = 0.0
    return dataclasses.replace(ties, stiffness=stiffness, damping=damping)


def _links(machine: MachineModel, shaft: LumpedShaft, numbers: MemberNumbers) -> tuple[AssembledLink, ...]:
    """Return the connections by laws.

    The laws are among those of the first bearing.
    """
    found, azimuths = [], dict(zip(numbers.lumps.tolist(), unbalance_of_lumps(machine, shaft)[1], strict=True))
    for link in machine.links:
        (first, own), (second, other) = (_end(machine, shaft, numbers, place) for place in (link.first, link.second))
        arms = [
            _unturned(np.subtract(place.point, centre), azimuths.get(member, 0.0))
            for place, member, centre in ((link.first, first, own), (link.second, second, other))
        ]
        apart = np.subtract(other, own).tolist()
        found.append(AssembledLink(0, link.element, first, arms[0], second, arms[1], tuple(apart)))
    return tuple(found)


def _unturned(arm: FloatArray, angle: float) -> tuple[float, float, float]:
    """Return an arm in a turned member's frame.

    The member has turned about x by its unbalance's angle at t = 0 [rad].
    """
    x, y, z = arm.tolist()
    c, s = math.cos(angle), math.sin(angle)
    return x, c * y + s * z, c * z - s * y


def _end(
    machine: MachineModel, shaft: LumpedShaft, numbers: MemberNumbers, place: Place
) -> tuple[int, tuple[float, float, float]]:
    """Return a place's member and origin [m].

    The origin is where the member is drawn.
    """
    if place.body == GROUND:
        return GROUND, (0.0, 0.0, 0.0)
    if place.body == SHAFT:
        lump = shaft.at(place.point[0])
        return int(numbers.lumps[lump]), (float(shaft.positions[lump]), 0.0, 0.0)
    return numbers.carrier(machine, place.body)


def _lumps(machine: MachineModel, shaft: LumpedShaft, numbers: MemberNumbers) -> dict[int, Member]:
    """Return the shaft's lumps with inner rings.

    They carry the rings.
    """
    unbalances, loads = unbalance_of_lumps(machine, shaft)[0], _loads_on_lumps(machine, shaft)
    found = {}
    for k, number in enumerate(numbers.lumps.tolist()):
        mass, polar = float(shaft.mass[k]), float(shaft.polar_inertia[k])
        transverse = float(shaft.transverse_inertia[k])
        for inner, mounted in zip(numbers.inner, machine.bearings, strict=True):
            if inner == number:
                ring = mounted.model.inner_ring
                mass, polar = mass + ring.mass, polar + ring.polar_inertia
                transverse += ring.transverse_inertia
        dofs = _turned(machine, _FREE) if number in numbers.driven else dict.fromkeys(DOFS, _FREE)
        if machine.hold is not None and k == shaft.at(machine.hold.position):
            held = zip(POSE, machine.hold.prescribed, strict=True)
            dofs |= {name: _prescribed(lead) for name, lead in held if lead is not None}
        brake = machine.resistance
        if brake is not None and k == shaft.at(brake.position):
            dofs |= {SPIN: dataclasses.replace(dofs[SPIN], damping=brake.damping)}
        load = loads[k]
        if machine.torque is not None and number in numbers.driven:
            load = (*load[:_ABOUT_X], added(load[_ABOUT_X], machine.torque), *load[_ABOUT_X + 1 :])
        body = _loaded(Body(mass, transverse, polar, dofs, unbalance=float(unbalances[k])), load)
        found[number] = Member(f"shaft at {1e3 * float(shaft.positions[k]):.4g} mm", body)
    return found


def _turned(machine: MachineModel, others: DofState) -> dict[str, DofState]:
    """Return the coupled member's degrees of freedom.

    The coupling turns it, by its speed or by a torque.
    """
    mode: Literal["free", "prescribed"] = "prescribed" if machine.torque is None else "free"
    return {**dict.fromkeys(DOFS, others), SPIN: DofState(mode, machine.speed_over_time)}


def _outer_ring(machine: MachineModel, i: int, model: BearingModel) -> Body:
    """Return an outer ring in its seat.

    Springs and elastic housings tie it, and it is free between them.
    """
    seating, dofs = machine.bearings[i].seating, {SPIN: machine.bearings[i].model.outer_ring.dofs[SPIN]}
    is_housed = machine.housing is not None and machine.bearings[i].carrier == GROUND
    for name, stiffness, lead in zip(POSE, seating.stiffness, seating.prescribed, strict=True):
        dofs[name] = _FREE if math.isfinite(stiffness) or is_housed else _prescribed(lead)
    along, *others = machine.load_on(BearingPart(machine.bearings[i].name, "outer_ring"))
    load = (added(along, TimeFunction.constant(seating.force)), *others)
    return _loaded(dataclasses.replace(model.outer_ring, dofs=dofs), load)


def _prescribed(motion: TimeFunction) -> DofState:
    return DofState("prescribed", motion) if motion.terms else _LOCKED


def _rigid(rigid: RigidBody, load: Load) -> Body:
    dofs: dict[str, DofState] = {}
    for name, place in zip(DOFS, (*PLACES, _ABOUT_X), strict=True):  # the turn about x comes last
        dofs[name] = _FREE if math.isfinite(rigid.hold[place]) else _prescribed(rigid.prescribed[place])
    return _loaded(Body(rigid.mass, rigid.transverse_inertia, rigid.polar_inertia, dofs), load)


def _loaded(body: Body, load: Load) -> Body:
    x, y, z, about_x, about_y, about_z = load
    return dataclasses.replace(body, force=(x, y, z), moment=(about_x, about_y, about_z))


def _loads_on_lumps(machine: MachineModel, shaft: LumpedShaft) -> list[Load]:
    """Return force and moment on each lump.

    Loads, weight and growth by temperature go to the lumps as the beam hands them on; of the weight the part that
    gravity does to the lumps anyway is taken off.
    """
    size, nodes = machine.body.mass.shape[0], NODE * machine.body.positions.size
    follow = shaft.follow[:, : NODE * shaft.positions.size]
    given, weight = machine.loads[:size].copy(), (machine.weight + machine.growth)[:size]
    if not machine.twists:  # torques go straight to the coupling
        given[_ABOUT_X:nodes:NODE] = weight[_ABOUT_X:nodes:NODE] = 0.0
    terms: list[TimeFunction] = [ZERO] * follow.shape[1]
    for row, function in machine.varying:
        if row >= size or (row % NODE == _ABOUT_X and not machine.twists):
            continue
        given[row] -= initial(function)
        terms = [added(sofar, scaled(function, float(share))) for sofar, share in zip(terms, follow[row], strict=True)]
    hung = (follow.T @ weight).reshape(-1, NODE)
    hung[:, :3] -= np.outer(shaft.mass, machine.gravity)
    still = (follow.T @ given).reshape(-1, NODE) + hung
    constant = [TimeFunction.constant(float(value)) for value in still.ravel()]
    every = [added(one, other) for one, other in zip(terms, constant, strict=True)]
    return [tuple(every[k : k + NODE]) for k in range(0, len(every), NODE)]


def _loads_on_bodies(machine: MachineModel) -> list[Load]:
    """Return force and moment on each rigid body."""
    size, changing = machine.body.mass.shape[0], dict(machine.varying)
    every = [
        changing.get(row) or added(TimeFunction.constant(float(machine.loads[row])))
        for row in range(size, size + NODE * len(machine.bodies))
    ]
    return [tuple(every[k : k + NODE]) for k in range(0, len(every), NODE)]


def _ties(machine: MachineModel, shaft: LumpedShaft, numbers: MemberNumbers) -> Ties:
    """Return the ties of members.

    Shaft, housing, seats, springs and dampers, and what holds rigid bodies.
    """
    lumps, turns = numbers.lumps, np.arange(NODE)
    lead = [numbers.count - 1] if shaft.driven == lumps.size else []
    rings, bodies = np.array(numbers.outer_rings), numbers.bodies
    member = np.concatenate([np.repeat(lumps, NODE), lead, np.repeat(rings, len(POSE)), np.repeat(bodies, NODE)])
    direction = np.concatenate([
        np.tile(turns, lumps.size), [_ABOUT_X] * len(lead), np.tile(PLACES, rings.size), np.tile(turns, bodies.size)
    ])  # fmt: skip
    size = shaft.stiffness.shape[0]
    own = slice(size, size + len(POSE) * rings.size)
    rows = Rows(lambda x: NODE * shaft.at(x), own.start, own.stop, member.size)
    stiffness, damping = structure(machine, rows)
    stiffness[:size, :size] += shaft.stiffness
    if machine.housing is not None:
        stiffness[own, own] += machine.housing
    if machine.housing_damping is not None:
        damping[own, own] += machine.housing_damping
    rest: FloatArray = np.zeros(member.size)
    rest[_ABOUT_X : NODE * lumps.size : NODE] = unbalance_of_lumps(machine, shaft)[1]  # angle 0 is the unbalance's
    rest[own] = np.concatenate([bearing.seating.shift for bearing in machine.bearings])
    if not machine.twists:
        about = np.flatnonzero(direction[:size] == _ABOUT_X)
        stiffness[about] = stiffness[:, about] = 0.0
    return Ties(member.astype(np.int64), direction.astype(np.int64), stiffness, damping, rest)
