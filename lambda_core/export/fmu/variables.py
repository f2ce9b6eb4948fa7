"""Define names, units and positions of FMU inputs and outputs.

Values are SI; a host shows them in the units that engineers use. Names are those of a case and of a result.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterator
from dataclasses import dataclass
from enum import IntEnum
from typing import Literal

from lambda_core.analysis.electric.columns import T_ARC, T_DISCHARGES
from lambda_core.domain.elements import BODIES, DOFS, SPIN
from lambda_core.export.fmu.frozen import Frozen
from lambda_core.export.fmu.prescribed_rings import TILT_STATES, axis_of
from lambda_core.solver import records as R
from lambda_core.solver.arrays import bundle as L
from lambda_core.solver.arrays.integrator_memory import CONTROL, COUNT


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


def variables(frozen: Frozen) -> list[Variable]:
    """Return the variables in order.

    The model is of a bearing or a machine; the order is that of the value references.
    """
    found = [Variable("time", "time", "s", Kind.TIME, 0)]
    if frozen.machine is not None:
        from lambda_core.export.fmu.machine_variables import machine_variables

        return [*found, *machine_variables(frozen, frozen.machine), *_varied(frozen)]
    found += _inputs(frozen)
    taken = {each.name for each in found}
    found += [
        each
        for each in (*_places(frozen), *_reactions(frozen), *_bearing(frozen), *of_circuit(frozen))
        if each.name not in taken
    ]
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


def _input_text(name: str, field: str) -> str:
    body, word = name.split(".")
    title = BODIES[body]  # type: ignore[index]
    if word.startswith(("force", "moment")):
        kind, axis = word.split("_")
        about = "" if kind == "force" else "about its centre, axis "
        return f"{kind} on the {title}, {about}{axis}, added to the loads of the case"
    text = f"speed of the {title}" if word == SPIN else f"{word} of the {title}"
    return text if field == "value" else f"{field} of the {text}"


def _places(frozen: Frozen) -> Iterator[Variable]:
    """Yield where the bodies stand and how they move."""
    for b, body in enumerate(BODIES):
        if not frozen.moves(body):
            continue
        title = BODIES[body]
        begin = frozen.image.place(frozen.scratch.shared, L.NS * b)
        for axis, dof in enumerate(DOFS):
            unit, rate, _ = _unit(f"{body}.{dof}")
            if dof == SPIN:
                yield Variable(f"{body}.spin", f"speed of the {title}", unit, Kind.VALUE, begin + 8 * L.SSIGMA)
                continue
            at, sign, slope = TILT_STATES.get(dof, (axis, 1.0, L.SVX + axis))
            yield Variable(f"{body}.{dof}", f"{dof} of the {title}", unit, Kind.VALUE, begin + 8 * at, scale=sign)
            text = f"rate of the {dof} of the {title}"
            yield Variable(f"{body}.{dof}_rate", text, rate, Kind.VALUE, begin + 8 * slope)


def _reactions(frozen: Frozen) -> Iterator[Variable]:
    """Yield what the bearing puts on its rings."""
    for b, ring in enumerate(("inner_ring", "outer_ring")):
        begin = frozen.image.place(frozen.wrenches, 6 * b)
        for k, kind in enumerate(("force", "moment")):
            for a, axis in enumerate("xyz"):
                text = f"{kind} of the bearing on the {BODIES[ring]}, {axis} ({_TITLES[axis]})"  # type: ignore[index]
                unit = "N" if kind == "force" else "N m"
                name, row = f"{ring}.reaction_{kind}_{axis}", 3 * k + a
                yield Variable(name, text, unit, Kind.VALUE, begin + 8 * row, axis=6 * b + row)


def _bearing(frozen: Frozen) -> Iterator[Variable]:
    """Yield the answers of a bearing that is alone."""
    yield Variable("bearing.friction_torque", "friction torque, mean over the step", "N m", Kind.TORQUE, 0)
    losses = frozen.image.place(frozen.scratch.rates)
    yield Variable("bearing.loss", "power lost to friction", "W", Kind.SUM, losses, frozen.losses, 8)
    yield from of_contacts(frozen, "bearing", "", 0, frozen.bearings[0].span.balls)
    text = "capacitance between the rings; balls that connect them are left out"
    yield Variable("bearing.capacitance", text, "F", Kind.CAPACITANCE, 0)
    text = "balls that connect the rings: metal touches metal on both"
    yield Variable("bearing.shorted", text, "1", Kind.SHORTED, 0)
    integrals = frozen.image.place(frozen.memory.integrals)
    text = "energy lost to friction since the start"
    yield Variable("bearing.energy_lost", text, "J", Kind.SUM, integrals, frozen.losses, 8)
    text = "energy that came in through everything external since the start"
    yield Variable("bearing.energy_in", text, "J", Kind.VALUE, frozen.integral("input"))
    text = "energy that dampers outside the bearing have taken since the start"
    yield Variable("bearing.energy_to_dampers", text, "J", Kind.VALUE, frozen.integral("support"))
    yield steps(frozen)


def of_contacts(frozen: Frozen, name: str, of: str, first: int, balls: int) -> Iterator[Variable]:
    """Yield extremes over the contacts of a bearing's balls."""
    contacts, record = frozen.scratch.contacts, R.CONTACT_SAMPLE
    each, stride = contacts.shape[-2], 8 * contacts.shape[-1]
    begin, count = frozen.image.place(contacts) + stride * each * first, each * balls
    for channel, text, unit, kind in (
        ("load", "largest contact load", "N", Kind.GREATEST),
        ("max_pressure", "largest contact pressure", "Pa", Kind.GREATEST),
        ("film_minimum", "smallest film of all contacts", "m", Kind.LEAST),
        ("film_parameter", "smallest film parameter Lambda of all contacts", "1", Kind.LEAST),
    ):
        place = begin + record.fields[channel][1]  # type: ignore[index]
        yield Variable(f"{name}.{channel}", f"{text}{of}", unit, kind, place, count, stride)


def steps(frozen: Frozen) -> Variable:
    """Return the counter of the integrator's steps."""
    place = frozen.image.place(frozen.memory.count) + COUNT.fields["steps"][1]  # type: ignore[index]
    return Variable("solver.steps", "steps of the integrator", "", Kind.COUNT, place)


def of_circuit(frozen: Frozen) -> Iterator[Variable]:
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
