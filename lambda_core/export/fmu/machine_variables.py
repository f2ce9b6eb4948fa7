"""Define inputs and outputs of a machine's FMU.

Names are those of a case and of a result: ``gears.wheel.force_z``, ``bearings.left.load``, ``shaft.spin``.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.elements import BODIES, CAGE, DOFS, INNER, OUTER, SPIN
from lambda_core.elements.ball.raceways import raceways
from lambda_core.export.fmu.frozen import Frozen
from lambda_core.export.fmu.prescribed_rings import TILT_STATES
from lambda_core.export.fmu.variables import Kind, Variable, named, of_circuit, of_contacts, steps
from lambda_core.formulas.elastic.beam import NODE
from lambda_core.model.bodies.locations import carried, carried_by_shaft
from lambda_core.model.machine_model import SHAFT, BearingPart, MachineModel, Place
from lambda_core.solver import records as R
from lambda_core.solver.arrays import bundle as L
from lambda_core.solver.drivers.external_inputs import SHAFT_SPIN, load_places
from lambda_core.solver.drivers.machine_assembly import member_numbers
from lambda_core.solver.drivers.machine_motion import MachineStart
from lambda_core.solver.drivers.readings import ReadBearing

_UNITS = {"force": "N", "moment": "N m"}
_TURN_ABOUT_X = 3  # row of a node
_TITLES = {"x": "along the shaft", "y": "horizontal", "z": "vertical"}
_POSE = tuple(dof for dof in DOFS if dof != SPIN)
# State of a body that each row of a node moves, its sign there, and the state of its rate; no turn about x.
_STATES = {
    0: (L.SX, 1.0, L.SVX), 1: (L.SY, 1.0, L.SVY), 2: (L.SZ, 1.0, L.SVZ),
    4: TILT_STATES["tilt_y"], 5: TILT_STATES["tilt_z"],
}  # fmt: skip


@dataclass(frozen=True)
class _Machine:
    frozen: Frozen
    start: MachineStart

    @property
    def model(self) -> MachineModel:
        return self.start.machine

    def state(self, member: int, state: int) -> int:
        """Return the place of a state of a member [bytes]."""
        return self.frozen.image.place(self.frozen.scratch.shared, L.NS * member + state)


def machine_variables(frozen: Frozen, start: MachineStart) -> Iterator[Variable]:
    """Yield the variables of a machine.

    Time and options are not among them.
    """
    machine = _Machine(frozen, start)
    yield from _inputs(machine)
    for place, at in load_places(machine.model).items():
        yield from _point(machine, place, at)
    for number, one in enumerate(frozen.bearings):
        yield from _motions(machine, one)
        yield from _bearing(machine, number, one)
    yield from _bodies(machine)
    yield from _totals(machine)
    yield from of_circuit(frozen)


def _inputs(machine: _Machine) -> Iterator[Variable]:
    frozen = machine.frozen
    for name in frozen.inputs.names:
        at = frozen.input_place(name)
        if name == SHAFT_SPIN:
            text, speed = "speed of the shaft", machine.model.speed
            yield Variable(name, text, "rad/s", Kind.INPUT, at, scale=1e-5, start=speed)
            yield Variable(f"{name}_rate", f"rate of the {text}", "rad/s2", Kind.INPUT, at + 8, scale=1.0)
            continue
        place, _, word = name.rpartition(".")
        kind, axis = word.split("_")
        text = f"{kind} at {place}, {axis} ({_TITLES[axis]}), added to the loads of the case"
        yield Variable(f"{named(place)}.{word}", text, _UNITS[kind], Kind.INPUT, at, scale=1.0)


def _point(machine: _Machine, name: str, place: Place) -> Iterator[Variable]:
    """Yield the motion of a point.

    It is on the shaft or a body; the shaft's rotation does not move it.
    """
    if place.body == SHAFT:
        shaft = machine.start.shaft
        lumps = member_numbers(machine.model, shaft).lumps
        at, moves = carried_by_shaft(machine.model.body, place.point)
        moved = moves @ shaft.follow[machine.model.body.rows(at), : NODE * lumps.size]
        members = lumps.tolist()
    else:
        numbers = member_numbers(machine.model, machine.start.shaft)
        member, centre = numbers.carrier(machine.model, place.body)
        moved = carried(np.subtract(place.point, centre))
        if isinstance(place.body, BearingPart):
            moved[:, _TURN_ABOUT_X] = 0.0  # its rotation moves no marker, as that of the shaft
        members = [member]
    for axis, word in enumerate("xyz"):
        for suffix, unit, rate in (("", "m", False), ("_rate", "m/s", True)):
            text = f"{word} of {name} ({_TITLES[word]})"
            parts = tuple(_shares(machine, members, moved[axis], rate))
            yield Variable(
                f"{named(name)}.{word}{suffix}",
                f"rate of {text}" if rate else text,
                unit,
                Kind.WEIGHTED,
                0,
                parts=parts,
            )


def _shares(machine: _Machine, members: list[int], weights: FloatArray, rate: bool) -> Iterator[tuple[int, float]]:
    """Yield places of states with their weights.

    They are states of members.
    """
    for member, own in zip(members, weights.reshape(-1, NODE), strict=True):
        for row, (state, sign, slope) in _STATES.items():
            if own[row] != 0.0:
                yield (
                    machine.state(member, slope if rate else state),
                    float(own[row]) * (1.0 if rate else sign),
                )


def _pose(machine: _Machine, name: str, title: str, member: int) -> Iterator[Variable]:
    """Yield how a member stands and moves."""
    for axis, dof in enumerate(_POSE):
        state, sign, slope = TILT_STATES.get(dof, (L.SX + axis, 1.0, L.SVX + axis))
        unit = "rad" if dof.startswith("tilt") else "m"
        yield Variable(f"{name}.{dof}", f"{dof} of {title}", unit, Kind.VALUE, machine.state(member, state), scale=sign)
        text = f"rate of the {dof} of {title}"
        yield Variable(f"{name}.{dof}_rate", text, f"{unit}/s", Kind.VALUE, machine.state(member, slope))


def _is_free(machine: _Machine, member: int) -> bool:
    dofs = machine.start.motion.context.assembly.members[member].body.dofs
    return any(dofs[dof].mode != "locked" for dof in _POSE)


def _motions(machine: _Machine, one: ReadBearing) -> Iterator[Variable]:
    """Yield a bearing's motions and forces.

    They are motions of rings and cage, and what the bearing exerts on the shaft.
    """
    name, rings = named(f"bearings.{one.name}"), {"inner_ring": INNER, "outer_ring": OUTER}
    for ring, which in rings.items():
        member = one.span.bodies[which]
        if _is_free(machine, member):
            yield from _pose(machine, f"{name}.{ring}", f"the {BODIES[ring]} of {one.name}", member)  # type: ignore[index]
    if one.context.model.depth.cage:
        at = machine.state(one.span.bodies[CAGE], L.SSIGMA)
        yield Variable(f"{name}.cage.spin", f"speed of the cage of {one.name}", "rad/s", Kind.VALUE, at)
    if len(machine.frozen.bearings) == 1:
        return  # what its contacts put on the shaft is not kept apart from the rest
    begin = machine.frozen.image.place(machine.frozen.wrenches, 6 * one.span.bodies[INNER])
    for k, kind in enumerate(("force", "moment")):
        for a, axis in enumerate("xyz"):
            text = f"{kind} of {one.name} on the shaft, {axis} ({_TITLES[axis]})"
            at = begin + 8 * (3 * k + a)
            yield Variable(f"{name}.reaction_{kind}_{axis}", text, _UNITS[kind], Kind.VALUE, at)


def _bearing(machine: _Machine, number: int, one: ReadBearing) -> Iterator[Variable]:
    """Yield the answers of a bearing."""
    name = named(f"bearings.{one.name}")
    yield from of_contacts(machine.frozen, name, f" of {one.name}", one.span.first_ball, one.span.balls)
    text = f"capacitance between the rings of {one.name}; balls that connect them are left out"
    yield Variable(f"{name}.capacitance", text, "F", Kind.CAPACITANCE, number)
    text = f"balls of {one.name} that connect the rings: metal touches metal on both"
    yield Variable(f"{name}.shorted", text, "1", Kind.SHORTED, number)
    parts = tuple((place, 1.0) for place in _losses(machine, number, one))
    yield Variable(
        f"{name}.loss",
        f"power lost to friction in {one.name}, without bending of elastic parts",
        "W",
        Kind.WEIGHTED,
        0,
        parts=parts,
    )


def _losses(machine: _Machine, number: int, one: ReadBearing) -> Iterator[int]:
    """Yield the places of the powers that a bearing dissipates."""
    frozen, every = machine.frozen, int(machine.frozen.bundle.raceways.size)
    own = range(one.span.first_raceway, one.span.first_raceway + len(raceways(one.context.model.geometry)))
    for mechanism in range(L.MECHANISMS):
        for raceway in own:
            yield frozen.image.place(frozen.scratch.rates, mechanism * every + raceway)
    for loss in ("pocket", "land", "drag"):
        if len(frozen.bearings) == 1:
            yield frozen.rate(loss)
        else:
            yield frozen.of_row(frozen.bundle.bearing_powers, number, loss)


def _bodies(machine: _Machine) -> Iterator[Variable]:
    numbers = member_numbers(machine.model, machine.start.shaft)
    for body, member in zip(machine.model.bodies, numbers.bodies.tolist(), strict=True):
        if _is_free(machine, member):
            yield from _pose(machine, named(f"bodies.{body.name}"), f"the body {body.name}", member)


def _totals(machine: _Machine) -> Iterator[Variable]:
    """Yield what the machine answers with."""
    frozen = machine.frozen
    losses, contacts = frozen.image.place(frozen.scratch.rates), frozen.scratch.contacts
    integrals = frozen.image.place(frozen.memory.integrals)
    at = frozen.image.place(contacts) + int(R.CONTACT_SAMPLE.fields["max_pressure"][1])  # type: ignore[index]
    count, stride = contacts.size // contacts.shape[-1], 8 * contacts.shape[-1]
    text = "friction torque of all bearings, mean over the step"
    yield Variable("machine.friction_torque", text, "N m", Kind.TORQUE, 0)
    text = "power lost to friction in all bearings"
    yield Variable("machine.loss", text, "W", Kind.SUM, losses, frozen.losses, 8)
    text = "largest contact pressure"
    yield Variable("machine.max_pressure", text, "Pa", Kind.GREATEST, at, count, stride)
    text = "energy lost to friction since the start"
    yield Variable("machine.energy_lost", text, "J", Kind.SUM, integrals, frozen.losses, 8)
    text = "energy that came in through everything external since the start"
    yield Variable("machine.energy_in", text, "J", Kind.VALUE, frozen.integral("input"))
    text = "energy that dampers outside the bearings have taken since the start"
    yield Variable("machine.energy_to_dampers", text, "J", Kind.VALUE, frozen.integral("support"))
    yield steps(frozen)
