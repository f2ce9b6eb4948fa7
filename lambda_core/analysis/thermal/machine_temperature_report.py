"""Report the temperatures of a machine: steady, and over time."""

from __future__ import annotations

import math
from typing import Literal

import numpy as np
from pydantic import Field

from lambda_core.analysis.thermal.feedback import Steady
from lambda_core.analysis.thermal.losses import Point
from lambda_core.analysis.thermal.machine_temperatures import MachineLoop
from lambda_core.analysis.thermal.report import (
    HeatFlow,
    LoopGain,
    State,
    banded_temperatures,
    flows_of,
    in_watts,
    reason_of,
    state_of,
)
from lambda_core.analysis.thermal.transient import Course, rise_time
from lambda_core.domain.unit_systems import SI, UnitSystem
from lambda_core.model.geometry.resolve_clearance import CLEARANCE_HOLDS
from lambda_core.results.answer import Answer
from lambda_core.results.averages import finite
from lambda_core.results.model_band import ModelBand
from lambda_core.results.record import INTERFACE, Record

_ZERO_CELSIUS = 273.15


class PlaceOnShaft(Record):
    """A node of the shaft."""

    node: str
    position_mm: float
    temperature_degC: float


class BearingState(Record):
    """Temperatures and state of one bearing."""

    title: str
    elements: str = Field(default="balls", description="word for the node balls: balls, or rollers")
    position_mm: float
    growth_um: float = Field(description="of the shaft beyond the housing, at the bearing")
    state: State
    losses_W: dict[str, float | None] = Field(description="by mechanism; the cage's contacts as one")


class BearingCourse(Record):
    """State of one bearing over time."""

    title: str
    friction_torque_Nmm: list[float | None]
    power_loss_W: list[float]
    clearance_um: list[float]
    growth_um: list[float] = Field(description="of the shaft beyond the housing, at the bearing")
    viscosity_mm2_per_s: list[float]
    film_um: list[float | None]


class MachineTemperatures(Answer):
    """Steady temperatures of a machine.

    Every node passes on the heat that it gets.
    """

    interface: int = INTERFACE
    kind: Literal["steady machine"] = Field(default="steady machine", description="which report this is")
    case: str
    speed_rpm: float = Field(description="of the shaft")
    losses_from: str = Field(description="quasi-static points, or the averages of a run")
    conductances: str = Field(description="ready set")
    temperatures_degC: dict[str, float] = Field(description="by node")
    temperatures_degC_band: dict[str, list[float]] = Field(
        description="ends of the 90 % model band by node; empty without one", default={}
    )
    model_band: ModelBand | None = Field(description="where the bands come from; null without them", default=None)
    heat_W: dict[str, float] = Field(description="put in at each node, by losses and by the case")
    shaft: list[PlaceOnShaft] = Field(description="nodes along the shaft")
    bearings: dict[str, BearingState] = Field(description="by name: torque, power and state of each")
    flows: list[HeatFlow] = Field(description="between nodes, the largest first")
    power_loss_W: float = Field(description="of all bearings")
    gain: LoopGain = Field(description="of the torque-temperature loop; the largest of all bearings")
    energy_residual: float = Field(description="(heat put in - heat that leaves)/heat put in")
    iterations: int = Field(description="of Newton's method")
    points_solved: int = Field(description="equilibria of the machine")
    network_assumptions: list[str] = Field(description="of the thermal network, and what it fills in")
    assumptions: list[str] = Field(description="other assumptions of the case")

    def with_band(self, band: ModelBand) -> MachineTemperatures:
        """Return the same with the bands of its temperatures."""
        return self.model_copy(update=banded_temperatures(self.temperatures_degC, band))

    def text(self, units: UnitSystem = SI) -> str:
        """Return the lines for people."""
        from lambda_core.analysis.thermal.machine_temperature_text import steady_text

        return steady_text(self, units)


class MachineTemperaturesOverTime(Answer):
    """Temperatures of a machine from a start."""

    interface: int = INTERFACE
    kind: Literal["transient machine"] = Field(default="transient machine", description="which report this is")
    case: str
    speed_rpm: float = Field(description="of the shaft")
    conductances: str = Field(description="ready set")
    ended: Literal["finished", "limit"] = Field(description="limit: a node passed thermal.limit")
    reason: str = Field(description="why it ended before its time; empty when it did not")
    time_s: list[float]
    temperatures_degC: dict[str, list[float]] = Field(description="by node, one for each time")
    shaft: list[PlaceOnShaft] = Field(description="nodes along the shaft, at the end")
    bearings: dict[str, BearingCourse] = Field(description="by name: torque and power over time")
    power_loss_W: list[float] = Field(description="of all bearings")
    rise_63_s: dict[str, float | None] = Field(description="time after which 63 % of the node's rise is done")
    heat_in_J: float = Field(description="by losses and by the case")
    heat_out_J: float = Field(description="through the nodes that are held")
    heat_stored_J: float = Field(description="in the others")
    energy_residual: float = Field(description="(in - out - stored)/in")
    points_solved: int = Field(description="equilibria of the machine; losses between them are interpolated")
    gain: LoopGain | None = Field(description="at the end, where the limit was passed")
    network_assumptions: list[str] = Field(description="of the thermal network, and what it fills in")
    assumptions: list[str] = Field(description="other assumptions of the case")

    def text(self, units: UnitSystem = SI) -> str:
        """Return the lines for people."""
        from lambda_core.analysis.thermal.machine_temperature_text import course_text

        return course_text(self, units)


def steady_of(loop: MachineLoop, found: Steady, losses_from: str = "quasi-static points") -> MachineTemperatures:
    """Put steady temperatures into the units of the interface."""
    machine, names, network = loop.machine, loop.nodes.names, found.network
    heat = float(network.heat.sum())
    grown = loop.grown(loop.nodes.named(found.temperatures)).tolist()
    each = zip(machine.bearings, found.points, grown, strict=True)
    return MachineTemperatures(
        case=machine.name,
        speed_rpm=machine.speed * 30.0 / math.pi,
        losses_from=losses_from,
        conductances=loop.thermal.conductances,
        temperatures_degC=dict(zip(names, (found.temperatures - _ZERO_CELSIUS).tolist(), strict=True)),
        heat_W=dict(zip(names, network.heat.tolist(), strict=True)),
        shaft=_along(loop, found.temperatures),
        bearings={
            bearing.name: BearingState(
                title=bearing.model.title,
                elements=bearing.model.elements,
                position_mm=1e3 * bearing.position,
                growth_um=1e6 * growth,
                state=state_of(point),
                losses_W=in_watts(point.losses),
            )
            for bearing, point, growth in each
        },
        flows=flows_of(network, found.temperatures),
        power_loss_W=sum(point.power for point in found.points),
        gain=LoopGain.of(found.gain),
        energy_residual=(heat - network.leaving(found.temperatures)) / heat if heat > 0.0 else 0.0,
        iterations=found.iterations,
        points_solved=loop.count,
        network_assumptions=machine.heat.assumptions,
        assumptions=_assumptions(loop),
    )


def course_of(loop: MachineLoop, course: Course) -> MachineTemperaturesOverTime:
    """Put temperatures over time into the units of the interface."""
    machine, names = loop.machine, loop.nodes.names
    celsius = course.temperatures - _ZERO_CELSIUS
    grown = [loop.grown(loop.nodes.named(temperatures)) for temperatures in course.temperatures]
    return MachineTemperaturesOverTime(
        case=machine.name,
        speed_rpm=machine.speed * 30.0 / math.pi,
        conductances=loop.thermal.conductances,
        ended="limit" if course.beyond_limit else "finished",
        reason=reason_of(loop, course),
        time_s=course.time.tolist(),
        temperatures_degC={name: celsius[:, i].tolist() for i, name in enumerate(names)},
        shaft=_along(loop, course.temperatures[-1]),
        bearings={
            bearing.name: _bearing_course(
                bearing.model.title, [points[i] for points in course.points], [float(moved[i]) for moved in grown]
            )
            for i, bearing in enumerate(machine.bearings)
        },
        power_loss_W=[sum(point.power for point in points) for points in course.points],
        rise_63_s={name: finite(rise_time(course, i, 1.0 - math.exp(-1.0))) for i, name in enumerate(names)},
        heat_in_J=course.put_in,
        heat_out_J=course.taken_out,
        heat_stored_J=course.stored,
        energy_residual=course.residual,
        points_solved=course.solved,
        gain=LoopGain.of(course.gain) if course.gain else None,
        network_assumptions=machine.heat.assumptions,
        assumptions=_assumptions(loop),
    )


def _bearing_course(title: str, points: list[Point], grown: list[float]) -> BearingCourse:
    return BearingCourse(
        title=title,
        friction_torque_Nmm=[finite(1e3 * point["torque"]) for point in points],
        power_loss_W=[point.power for point in points],
        clearance_um=[1e6 * point.clearance for point in points],
        growth_um=[1e6 * growth for growth in grown],
        viscosity_mm2_per_s=[1e6 * point["viscosity"] for point in points],
        film_um=[finite(1e6 * point["film"]) for point in points],
    )


def _along(loop: MachineLoop, temperatures: np.ndarray) -> list[PlaceOnShaft]:
    at, machine = loop.nodes.named(temperatures), loop.machine
    nodes = zip(machine.heat.shaft, machine.body.positions.tolist(), strict=True)
    return [
        PlaceOnShaft(node=name, position_mm=1e3 * x, temperature_degC=at[name] - _ZERO_CELSIUS)
        for name, x in nodes
        if name in at
    ]


def _assumptions(loop: MachineLoop) -> list[str]:
    """Return the other assumptions of the case.

    Those of the network, and of clearances that differ from the computed ones, are left out.
    """
    known = loop.machine.heat.assumptions
    passed = ("clearance in operation", CLEARANCE_HOLDS)
    return [
        text
        for text in loop.machine.assumptions
        if text not in known and not text.split(": ", 1)[-1].startswith(passed)
    ]
