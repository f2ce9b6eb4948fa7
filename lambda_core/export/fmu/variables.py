"""Define names, units and positions of FMU inputs and outputs.

Values are SI; a host shows them in the units that engineers use. Names are those of a case and of a result:
``inner_ring.force_z`` and ``bearing.load`` of a bearing that is alone; ``gears.wheel.force_z``, ``bearings.left.load``
and ``shaft.spin`` of a machine.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterator
from dataclasses import dataclass
from enum import IntEnum
from typing import Literal

import numpy as np

from lambda_core.analysis.electric.columns import T_ARC, T_DISCHARGES
from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.elements import BODIES, CAGE, DOFS, INNER, OUTER, SPIN
from lambda_core.elements.ball.raceways import raceways
from lambda_core.export.fmu.frozen import Frozen
from lambda_core.export.fmu.prescribed_rings import TILT_STATES, axis_of
from lambda_core.formulas.elastic.beam import NODE
from lambda_core.model.bodies.locations import carried, carried_by_shaft
from lambda_core.model.machine_model import SHAFT, BearingPart, MachineModel, Place
from lambda_core.solver import records as R
from lambda_core.solver.arrays import bundle as L
from lambda_core.solver.arrays.integrator_memory import CONTROL, COUNT
from lambda_core.solver.drivers.external_inputs import SHAFT_SPIN, load_places
from lambda_core.solver.drivers.machine_assembly import member_numbers
from lambda_core.solver.drivers.machine_motion import MachineStart
from lambda_core.solver.drivers.readings import ReadBearing


class Kind(IntEnum):
    """Reading of a variable.

    The numbers are those of source/core.h.
    """

    TIME = 0
    INPUT = 1
    VALUE = 2
    LEAST = 3  # of several, those that are 0 left out
    GREATEST = 4
    SUM = 5
    TORQUE = 6
    COUNT = 7
    VARIED = 8  # an option that constants follow
    SOURCE = 9  # an input that moves nothing
    CAPACITANCE = 10  # of the balls that do not connect the rings by touching metal
    SHORTED = 11  # how many do
    WEIGHTED = 12  # a sum of numbers with weights


@dataclass(frozen=True)
class Variable:
    """One variable.

    Its value reference is its place in the list.
    """

    name: str
    text: str
    unit: str
    kind: Kind
    place: int  # [bytes] in the image
    count: int = 1
    stride: int = 0  # [bytes]
    scale: float = 1.0  # of an input: by how much it is changed for a slope
    begin: int = 0  # of an input: place of the time at which it was given
    start: float = 0.0
    limits: tuple[float, float] = (-math.inf, math.inf)
    tunable: bool = False  # a parameter of the host, not an input
    axis: int = -1  # in the matrix of slopes: of a reaction its row, of a motion its column
    turn: float = 1.0  # sign there
    parts: tuple[tuple[int, float], ...] = ()  # of a weighted sum: places [bytes] and weights

    @property
    def causality(self) -> Literal["independent", "input", "output", "parameter"]:
        """Causality of the variable."""
        if self.kind is Kind.TIME:
            return "independent"
        if not self.given:
            return "output"
        return "parameter" if self.tunable else "input"

    @property
    def given(self) -> bool:
        """True if a host sets it."""
        return self.kind in (Kind.INPUT, Kind.SOURCE, Kind.VARIED)


_STEPS = {"m": 1e-9, "rad": 1e-8, "m/s": 1e-6, "rad/s": 1e-5, "N": 1.0, "N m": 1e-2, "m/s2": 1.0, "rad/s2": 1.0}
_TITLES = {"x": "along the shaft", "y": "horizontal", "z": "vertical"}
_UNITS = {"force": "N", "moment": "N m"}
_TURN_ABOUT_X = 3  # row of a node
_POSE = tuple(dof for dof in DOFS if dof != SPIN)
# State of a body that each row of a node moves, its sign there, and the state of its rate; no turn about x.
_STATES = {
    0: (L.SX, 1.0, L.SVX), 1: (L.SY, 1.0, L.SVY), 2: (L.SZ, 1.0, L.SVZ),
    4: TILT_STATES["tilt_y"], 5: TILT_STATES["tilt_z"],
}  # fmt: skip


def variables(frozen: Frozen) -> list[Variable]:
    """Return the variables in order.

    The model is of a bearing or a machine; the order is that of the value references.
    """
    found = [Variable("time", "time", "s", Kind.TIME, 0)]
    own = _of_bearing(frozen) if frozen.machine is None else _of_machine(frozen, frozen.machine)
    taken = set()
    for each in (*own, *_circuit(frozen)):
        if each.name not in taken:
            found.append(each)
            taken.add(each.name)
    return [*found, *_varied(frozen)]


def named(path: str) -> str:
    """Return a path as FMI's structured names.

    Quotes enclose what is no identifier.
    """
    table, _, name = path.partition(".")
    return path if re.fullmatch(r"[A-Za-z_]\w*", name, re.ASCII) else f"{table}.'{name}'"


def _unit(name: str) -> tuple[str, str, str]:
    """Return the units of an input.

    They are the units of its value, its rate and its acceleration.
    """
    word = name.split(".")[1]
    if word.startswith("force"):
        return "N", "", ""
    if word.startswith("moment"):
        return "N m", "", ""
    if word == SPIN:
        return "rad/s", "rad/s2", ""
    return ("rad", "rad/s", "rad/s2") if word.startswith("tilt") else ("m", "m/s", "m/s2")


def _varied(frozen: Frozen) -> Iterator[Variable]:
    """Yield the options that a host may change."""
    behind = frozen.host.size - len(frozen.varied)
    for k, option in enumerate(frozen.varied):
        yield Variable(
            option.path,
            f"{option.path} of the case, between {option.lowest:g} and {option.highest:g} {option.unit}",
            option.unit,
            Kind.VARIED,
            frozen.image.place(frozen.host, behind + k),
            scale=1e-3 * (option.highest - option.lowest),
            start=option.start,
            limits=(option.lowest, option.highest),
            tunable=not option.is_temperature,
        )


# -- parts of bearings and machines --


def _pose(frozen: Frozen, name: str, title: str, member: int) -> Iterator[Variable]:
    """Yield a pose and its rates, without spin."""
    for axis, dof in enumerate(_POSE):
        state, sign, slope = TILT_STATES.get(dof, (L.SX + axis, 1.0, L.SVX + axis))
        unit, at = "rad" if dof.startswith("tilt") else "m", _state(frozen, member, state)
        yield Variable(f"{name}.{dof}", f"{dof} of {title}", unit, Kind.VALUE, at, scale=sign)
        text = f"rate of the {dof} of {title}"
        yield Variable(f"{name}.{dof}_rate", text, f"{unit}/s", Kind.VALUE, _state(frozen, member, slope))


def _spin(frozen: Frozen, name: str, title: str, member: int) -> Variable:
    return Variable(f"{name}.spin", f"speed of {title}", "rad/s", Kind.VALUE, _state(frozen, member, L.SSIGMA))


def _state(frozen: Frozen, member: int, state: int) -> int:
    """Return the place of a state of a member [bytes]."""
    return frozen.image.place(frozen.scratch.shared, L.NS * member + state)


def _wrench(frozen: Frozen, name: str, words: str, body: int, slopes: int | None = None) -> Iterator[Variable]:
    """Yield force and moment of a bearing on a body.

    `slopes` is the row of the first in the matrix of slopes.
    """
    begin = frozen.image.place(frozen.wrenches, 6 * body)
    for k, kind in enumerate(_UNITS):
        for a, axis in enumerate("xyz"):
            row = 3 * k + a
            yield Variable(
                f"{name}.reaction_{kind}_{axis}",
                f"{kind} of {words}, {axis} ({_TITLES[axis]})",
                _UNITS[kind],
                Kind.VALUE,
                begin + 8 * row,
                axis=-1 if slopes is None else slopes + row,
            )


def _contacts(frozen: Frozen, name: str, number: int, one: ReadBearing) -> Iterator[Variable]:
    """Yield extremes and capacitance of a bearing's contacts."""
    of = f" of {one.name}" if one.name else ""
    contacts, record = frozen.scratch.contacts, R.CONTACT_SAMPLE
    each, stride = contacts.shape[-2], 8 * contacts.shape[-1]
    begin, count = frozen.image.place(contacts) + stride * each * one.span.first_ball, each * one.span.balls
    for channel, text, unit, kind in (
        ("load", "largest contact load", "N", Kind.GREATEST),
        ("max_pressure", "largest contact pressure", "Pa", Kind.GREATEST),
        ("film_minimum", "smallest film of all contacts", "m", Kind.LEAST),
        ("film_parameter", "smallest film parameter Lambda of all contacts", "1", Kind.LEAST),
    ):
        place = begin + record.fields[channel][1]  # type: ignore[index]
        yield Variable(f"{name}.{channel}", f"{text}{of}", unit, kind, place, count, stride)
    text = f"capacitance between the rings{of}; balls that connect them are left out"
    yield Variable(f"{name}.capacitance", text, "F", Kind.CAPACITANCE, number)
    text = f"balls{of} that connect the rings: metal touches metal on both"
    yield Variable(f"{name}.shorted", text, "1", Kind.SHORTED, number)


def _friction(frozen: Frozen, name: str, of: str) -> Iterator[Variable]:
    """Yield the friction torque and its power."""
    yield Variable(f"{name}.friction_torque", f"friction torque{of}, mean over the step", "N m", Kind.TORQUE, 0)
    losses = frozen.image.place(frozen.scratch.rates)
    inside = of.replace(" of ", " in ")
    yield Variable(f"{name}.loss", f"power lost to friction{inside}", "W", Kind.SUM, losses, frozen.losses, 8)


def _energies(frozen: Frozen, name: str, bearings: str) -> Iterator[Variable]:
    """Yield energies since the start and the steps taken."""
    integrals = frozen.image.place(frozen.memory.integrals)
    text = "energy lost to friction since the start"
    yield Variable(f"{name}.energy_lost", text, "J", Kind.SUM, integrals, frozen.losses, 8)
    text = "energy that came in through everything external since the start"
    yield Variable(f"{name}.energy_in", text, "J", Kind.VALUE, frozen.integral("input"))
    text = f"energy that dampers outside the {bearings} have taken since the start"
    yield Variable(f"{name}.energy_to_dampers", text, "J", Kind.VALUE, frozen.integral("support"))
    place = frozen.image.place(frozen.memory.count) + COUNT.fields["steps"][1]  # type: ignore[index]
    yield Variable("solver.steps", "steps of the integrator", "", Kind.COUNT, place)


# -- a bearing that is alone --


def _of_bearing(frozen: Frozen) -> Iterator[Variable]:
    """Yield the variables of a bearing that is alone."""
    (one,) = frozen.bearings
    yield from _inputs(frozen)
    for member, (body, title) in enumerate(BODIES.items()):
        if frozen.moves(body):
            yield from _pose(frozen, body, f"the {title}", member)
            yield _spin(frozen, body, f"the {title}", member)
    for member, ring in ((INNER, "inner_ring"), (OUTER, "outer_ring")):
        words = f"the bearing on the {BODIES[ring]}"  # type: ignore[index]
        yield from _wrench(frozen, ring, words, member, 6 * member)
    yield from _friction(frozen, "bearing", "")
    yield from _contacts(frozen, "bearing", 0, one)
    yield from _energies(frozen, "bearing", "bearing")


def _inputs(frozen: Frozen) -> Iterator[Variable]:
    """Yield what a host gives, with the rates of motions."""
    for row, name in enumerate(frozen.inputs.names):
        begin = frozen.of_row(frozen.inputs.rows, row, "begin")
        for field, unit in zip(("value", "rate", "acceleration"), _unit(name), strict=True):
            if unit:
                place = frozen.of_row(frozen.inputs.rows, row, field)
                start = float(frozen.inputs.rows[row][field])
                full = name if field == "value" else f"{name}_{field}"
                text = _input_text(name, field)
                axis, turn = axis_of(name, field)
                yield Variable(
                    full, text, unit, Kind.INPUT, place,
                    scale=_STEPS[unit], begin=begin, start=start, axis=axis, turn=turn,
                )  # fmt: skip


def _input_text(name: str, field: str) -> str:
    body, word = name.split(".")
    title = BODIES[body]  # type: ignore[index]
    if word.startswith(("force", "moment")):
        kind, axis = word.split("_")
        about = "" if kind == "force" else "about its centre, axis "
        return f"{kind} on the {title}, {about}{axis}, added to the loads of the case"
    text = f"speed of the {title}" if word == SPIN else f"{word} of the {title}"
    return text if field == "value" else f"{field} of the {text}"


# -- machines --


def _of_machine(frozen: Frozen, start: MachineStart) -> Iterator[Variable]:
    """Yield the variables of a machine."""
    machine = _Machine(frozen, start)
    yield from _machine_inputs(machine)
    for name, place in load_places(machine.model).items():
        yield from _point(machine, name, place)
    for number, one in enumerate(frozen.bearings):
        yield from _mounted(machine, number, one)
    numbers = member_numbers(machine.model, start.shaft)
    for body, member in zip(machine.model.bodies, numbers.bodies.tolist(), strict=True):
        if _is_free(machine, member):
            yield from _pose(frozen, named(f"bodies.{body.name}"), f"the body {body.name}", member)
    yield from _friction(frozen, "machine", " of all bearings")
    contacts = frozen.scratch.contacts
    at = frozen.image.place(contacts) + int(R.CONTACT_SAMPLE.fields["max_pressure"][1])  # type: ignore[index]
    count, stride = contacts.size // contacts.shape[-1], 8 * contacts.shape[-1]
    yield Variable("machine.max_pressure", "largest contact pressure", "Pa", Kind.GREATEST, at, count, stride)
    yield from _energies(frozen, "machine", "bearings")


@dataclass(frozen=True)
class _Machine:
    frozen: Frozen
    start: MachineStart

    @property
    def model(self) -> MachineModel:
        return self.start.machine


def _machine_inputs(machine: _Machine) -> Iterator[Variable]:
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
                    _state(machine.frozen, member, slope if rate else state),
                    float(own[row]) * (1.0 if rate else sign),
                )


def _is_free(machine: _Machine, member: int) -> bool:
    dofs = machine.start.motion.context.assembly.members[member].body.dofs
    return any(dofs[dof].mode != "locked" for dof in _POSE)


def _mounted(machine: _Machine, number: int, one: ReadBearing) -> Iterator[Variable]:
    """Yield a bearing's motions, force on the shaft and answers."""
    frozen, name = machine.frozen, named(f"bearings.{one.name}")
    for ring, which in {"inner_ring": INNER, "outer_ring": OUTER}.items():
        member = one.span.bodies[which]
        if _is_free(machine, member):
            yield from _pose(frozen, f"{name}.{ring}", f"the {BODIES[ring]} of {one.name}", member)  # type: ignore[index]
    if one.context.model.depth.cage:
        yield _spin(frozen, f"{name}.cage", f"the cage of {one.name}", one.span.bodies[CAGE])
    if len(frozen.bearings) > 1:  # of one alone what its contacts put on the shaft is not kept apart from the rest
        yield from _wrench(frozen, name, f"{one.name} on the shaft", one.span.bodies[INNER])
    yield from _contacts(frozen, name, number, one)
    parts = tuple((place, 1.0) for place in _losses(frozen, number, one))
    text = f"power lost to friction in {one.name}, without bending of elastic parts"
    yield Variable(f"{name}.loss", text, "W", Kind.WEIGHTED, 0, parts=parts)


def _losses(frozen: Frozen, number: int, one: ReadBearing) -> Iterator[int]:
    """Yield the places of the powers that a bearing dissipates."""
    every = int(frozen.bundle.raceways.size)
    own = range(one.span.first_raceway, one.span.first_raceway + len(raceways(one.context.model.geometry)))
    for mechanism in range(L.MECHANISMS):
        for raceway in own:
            yield frozen.image.place(frozen.scratch.rates, mechanism * every + raceway)
    for loss in ("pocket", "land", "drag"):
        if len(frozen.bearings) == 1:
            yield frozen.rate(loss)
        else:
            yield frozen.of_row(frozen.bundle.bearing_powers, number, loss)


# -- circuit and control --


def _circuit(frozen: Frozen) -> Iterator[Variable]:
    """Yield the variables of the circuit.

    The host is the source, and the circuit answers.
    """
    found = frozen.circuit
    if found is None:
        return
    begin = found.place(frozen.image, "since")
    text = "voltage of the source, behind the capacitance of the winding"
    for name, unit, place in (("", "V", "given"), ("_rate", "V/s", "rate")):
        about = text if not name else f"rate of the {text}"
        at = found.place(frozen.image, place)
        yield Variable(f"electric.source_voltage{name}", about, unit, Kind.SOURCE, at, scale=1.0, begin=begin)
    text, at = "current from the source, mean over the step", found.place(frozen.image, "current")
    yield Variable("electric.source_current", text, "A", Kind.VALUE, at)
    if frozen.machine is not None:
        text, at = "voltage of the shaft against the frame", found.place(frozen.image, "shaft")
        yield Variable("electric.shaft_voltage", text, "V", Kind.VALUE, at)
    for number, one in enumerate(frozen.bearings):
        of, path = (f" of {one.name}", f"{named(f'bearings.{one.name}')}.") if one.name else ("", "electric.")
        for name, place, unit, text in (
            ("voltage", "voltage", "V", f"voltage of the inner ring{of} against the outer"),
            ("voltage_lowest", "lowest", "V", f"lowest voltage of the inner ring{of} against the outer in the step"),
            ("voltage_highest", "highest", "V", f"highest voltage of the inner ring{of} against the outer in the step"),
            (
                "arc_current",
                "arc_current",
                "A",
                f"current of discharges{of} from ring to ball or back, mean over the step",
            ),
            ("arc_peak", "peak", "A", f"largest current of a discharge{of} that began in the step"),
        ):
            yield Variable(f"{path}{name}", text, unit, Kind.VALUE, found.answer(frozen.image, number, place))
    total = found.arguments["total"]
    for name, column, unit, text in (
        ("discharges", T_DISCHARGES, "1", "discharges since the start"),
        ("discharge_energy", T_ARC, "J", "heat of discharges since the start"),
    ):
        yield Variable(f"electric.{name}", text, unit, Kind.VALUE, frozen.image.place(total, column))


def control(frozen: Frozen, name: str) -> int:
    """Return the place of a field of the integrator's control."""
    return frozen.image.place(frozen.memory.control) + int(CONTROL.fields[name][1])  # type: ignore[index]
