"""Summarise temperatures, steady and over time."""

from __future__ import annotations

import math
from collections.abc import Collection, Iterable, Sequence
from typing import Any, Literal

import numpy as np
from pydantic import Field

from lambda_core.analysis.thermal.bearing_nodes import BearingNodes
from lambda_core.analysis.thermal.feedback import Gain, Loop, Steady, runaway_sentence
from lambda_core.analysis.thermal.losses import Point
from lambda_core.analysis.thermal.network import Network
from lambda_core.analysis.thermal.transient import Course, rise_time
from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.unit_systems import SI, UnitSystem
from lambda_core.model.geometry.resolve_clearance import CLEARANCE_HOLDS
from lambda_core.model.settings.machine_heat import BEARING_NODES
from lambda_core.model.settings.resolve_thermal import SUPPLY
from lambda_core.results.answer import Answer
from lambda_core.results.averages import finite
from lambda_core.results.model_band import ModelBand, temperature_of
from lambda_core.results.record import INTERFACE, Record
from lambda_core.results.summary import merged_cage

_ZERO_CELSIUS = 273.15


class LoopGain(Record):
    """Gain of the torque-temperature loop.

    The loop feeds itself from a gain of 1 on.
    """

    loop: float = Field(description="largest real part of the eigenvalues of the loop")
    clearance: float = Field(
        description="of a clearance on itself: temperatures take clearance, preload heats; the largest of all bearings"
    )
    viscosity: float = Field(
        description="of an inlet temperature on itself: negative where thinner oil loses less; the largest of all "
        "bearings"
    )

    @classmethod
    def of(cls, gain: Gain) -> LoopGain:
        """Take it over."""
        return cls(loop=gain.loop, clearance=gain.clearance, viscosity=gain.viscosity)


class HeatFlow(Record):
    """Heat between two nodes.

    The heat flows from `source` to `target`.
    """

    source: str
    target: str
    heat_W: float
    conductance_W_per_K: float


class State(Record):
    """State of a bearing at one moment."""

    friction_torque_Nmm: float | None
    power_loss_W: float = Field(description="dissipated in the bearing")
    viscosity_mm2_per_s: float = Field(description="kinematic, at the inlets of the contacts")
    inlet_degC: float = Field(description="temperature of the oil at the inlets of the contacts")
    clearance_um: float = Field(description="radial internal clearance in operation; negative is preload")
    max_pressure_GPa: float
    film_um: float | None = Field(description="smallest central film under load")
    film_parameter: float | None = Field(description="smallest Lambda under load")


class PlaceOnShaft(Record):
    """A node of the shaft."""

    node: str
    position_mm: float
    temperature_degC: float


class _Bearing(Record):
    """Bearing with its nodes in the network."""

    title: str
    elements: str = Field(default="balls", description="word for the node balls: balls, or rollers")
    nodes: dict[str, str] = Field(description="its parts and their nodes in the network")


class BearingState(_Bearing):
    """State of one bearing at steady temperatures."""

    position_mm: float
    growth_um: float = Field(description="of the shaft beyond the housing, at the bearing")
    state: State = Field(description="what the contacts make of the temperatures")
    losses_W: dict[str, float | None] = Field(description="by mechanism; the cage's contacts as one")


class BearingCourse(_Bearing):
    """State of one bearing over time."""

    friction_torque_Nmm: list[float | None]
    power_loss_W: list[float]
    clearance_um: list[float]
    growth_um: list[float] = Field(description="of the shaft beyond the housing, at the bearing")
    viscosity_mm2_per_s: list[float]
    film_um: list[float | None]


class SteadyTemperatures(Answer):
    """Steady temperatures of all nodes.

    Every node passes on the heat that it gets.

    Attributes
    ----------
    kind : str
        Tells the two answers about temperatures apart.
    """

    interface: int = INTERFACE
    kind: Literal["steady"] = "steady"
    case: str
    headline: str
    speed_rpm: float = Field(description="of the shaft")
    losses_from: str = Field(description="quasi-static point, or the averages of a run")
    conductances: str = Field(description="ready set")
    temperatures_degC: dict[str, float] = Field(description="by node")
    temperatures_degC_band: dict[str, list[float]] = Field(
        description="ends of the 90 % model band by node; empty without one", default={}
    )
    model_band: ModelBand | None = Field(description="where the bands come from; null without them", default=None)
    heat_W: dict[str, float] = Field(description="put in at each node, by losses and by the case")
    shaft: list[PlaceOnShaft] = Field(description="nodes along the shaft")
    bearings: dict[str, BearingState] = Field(description="by name; the only one of a case is `bearing`")
    flows: list[HeatFlow] = Field(description="between nodes, the largest first")
    power_loss_W: float = Field(description="of all bearings")
    gain: LoopGain = Field(description="of the torque-temperature loop")
    energy_residual: float = Field(description="(heat put in - heat that leaves)/heat put in")
    iterations: int = Field(description="of Newton's method")
    points_solved: int = Field(description="quasi-static points")
    network_assumptions: list[str] = Field(description="of the thermal network, and what it fills in")
    assumptions: list[str] = Field(description="other assumptions of the case")

    def with_band(self, band: ModelBand) -> SteadyTemperatures:
        """Return the same with the bands of its temperatures."""
        return self.model_copy(update=_banded(self.temperatures_degC, band))

    def text(self, units: UnitSystem = SI) -> str:
        """Return the lines for people."""
        from lambda_core.analysis.thermal.temperature_text import steady_text

        return steady_text(self, units)


class TemperaturesOverTime(Answer):
    """Temperatures from a start.

    Attributes
    ----------
    kind : str
        Tells the two answers about temperatures apart.
    """

    interface: int = INTERFACE
    kind: Literal["transient"] = "transient"
    case: str
    headline: str = Field(description="at the end")
    speed_rpm: float = Field(description="of the shaft")
    conductances: str = Field(description="ready set")
    ended: Literal["finished", "limit"] = Field(description="limit: a node passed thermal.limit")
    reason: str = Field(description="why it ended before its time; empty when it did not")
    time_s: list[float]
    temperatures_degC: dict[str, list[float]] = Field(description="by node, one for each time")
    shaft: list[PlaceOnShaft] = Field(description="nodes along the shaft, at the end")
    bearings: dict[str, BearingCourse] = Field(description="by name; the only one of a case is `bearing`")
    power_loss_W: list[float] = Field(description="of all bearings")
    rise_63_s: dict[str, float | None] = Field(description="time after which 63 % of the node's rise is done")
    heat_in_J: float = Field(description="by losses and by the case")
    heat_out_J: float = Field(description="through the nodes that are held")
    heat_stored_J: float = Field(description="in the others")
    energy_residual: float = Field(description="(in - out - stored)/in")
    points_solved: int = Field(description="quasi-static points; those between are interpolated")
    gain: LoopGain | None = Field(description="at the end, where the limit was passed")
    network_assumptions: list[str] = Field(description="of the thermal network, and what it fills in")
    assumptions: list[str] = Field(description="other assumptions of the case")

    def text(self, units: UnitSystem = SI) -> str:
        """Return the lines for people."""
        from lambda_core.analysis.thermal.temperature_text import course_text

        return course_text(self, units)


def steady_of(loop: Loop, found: Steady, losses_from: str = "quasi-static point") -> SteadyTemperatures:
    """Put steady temperatures into the units of the interface."""
    names, network = loop.nodes.names, found.network
    heat = float(network.heat.sum())
    grown = loop.grown(loop.nodes.named(found.temperatures)).tolist()
    each = zip(loop.bearings, loop.nodes.bearings, found.points, grown, strict=True)
    return SteadyTemperatures(
        case=loop.name,
        headline=loop.headline(found.points),
        speed_rpm=loop.speed * 30.0 / math.pi,
        losses_from=losses_from,
        conductances=loop.thermal.conductances,
        temperatures_degC={name: float(found.temperatures[i]) - _ZERO_CELSIUS for i, name in enumerate(names)},
        heat_W={name: float(network.heat[i]) for i, name in enumerate(names)},
        shaft=_along(loop, found.temperatures),
        bearings={
            bearing.name: BearingState(
                **_identity(nodes, names),
                position_mm=1e3 * bearing.position,
                growth_um=1e6 * growth,
                state=_state(point),
                losses_W=_in_watts(point.losses),
            )
            for bearing, nodes, point, growth in each
        },
        flows=_flows(network, found.temperatures),
        power_loss_W=sum(point.power for point in found.points),
        gain=LoopGain.of(found.gain),
        energy_residual=(heat - network.leaving(found.temperatures)) / heat if heat > 0.0 else 0.0,
        iterations=found.iterations,
        points_solved=loop.count,
        network_assumptions=loop.of_network,
        assumptions=_other_assumptions(loop),
    )


def course_of(loop: Loop, course: Course) -> TemperaturesOverTime:
    """Put temperatures over time into the units of the interface."""
    names = loop.nodes.names
    celsius = course.temperatures - _ZERO_CELSIUS
    grown = np.array([loop.grown(loop.nodes.named(temperatures)) for temperatures in course.temperatures])
    each = enumerate(zip(loop.bearings, loop.nodes.bearings, strict=True))
    return TemperaturesOverTime(
        case=loop.name,
        headline=loop.headline(course.points[-1]),
        speed_rpm=loop.speed * 30.0 / math.pi,
        conductances=loop.thermal.conductances,
        ended="limit" if course.beyond_limit else "finished",
        reason=_reason(loop, course),
        time_s=course.time.tolist(),
        temperatures_degC={name: celsius[:, i].tolist() for i, name in enumerate(names)},
        shaft=_along(loop, course.temperatures[-1]),
        bearings={
            bearing.name: _bearing_course(
                _identity(nodes, names), [points[i] for points in course.points], (1e6 * grown[:, i]).tolist()
            )
            for i, (bearing, nodes) in each
        },
        power_loss_W=[sum(point.power for point in points) for points in course.points],
        rise_63_s={name: finite(rise_time(course, i, 1.0 - math.exp(-1.0))) for i, name in enumerate(names)},
        heat_in_J=course.put_in,
        heat_out_J=course.taken_out,
        heat_stored_J=course.stored,
        energy_residual=course.residual,
        points_solved=course.solved,
        gain=LoopGain.of(course.gain) if course.gain else None,
        network_assumptions=loop.of_network,
        assumptions=_other_assumptions(loop),
    )


def _bearing_course(identity: dict[str, Any], points: Sequence[Point], growth_um: list[float]) -> BearingCourse:
    return BearingCourse(
        **identity,
        friction_torque_Nmm=[finite(1e3 * point["torque"]) for point in points],
        power_loss_W=[point.power for point in points],
        clearance_um=[1e6 * point.clearance for point in points],
        growth_um=growth_um,
        viscosity_mm2_per_s=[1e6 * point["viscosity"] for point in points],
        film_um=[finite(1e6 * point["film"]) for point in points],
    )


def _identity(nodes: BearingNodes, names: Collection[str]) -> dict[str, Any]:
    """Return title, elements and nodes of a bearing."""
    own = {part: nodes.node(part) for part in (*BEARING_NODES, SUPPLY)}
    return {
        "title": nodes.model.title,
        "elements": nodes.model.elements,
        "nodes": {part: name for part, name in own.items() if name in names},
    }


def _along(loop: Loop, temperatures: FloatArray) -> list[PlaceOnShaft]:
    at = loop.nodes.named(temperatures)
    return [
        PlaceOnShaft(node=name, position_mm=1e3 * x, temperature_degC=at[name] - _ZERO_CELSIUS)
        for name, x in loop.shaft
        if name in at
    ]


def _banded(nodes: Iterable[str], band: ModelBand) -> dict[str, Any]:
    """Return the fields of the bands by node."""
    known = {one.quantity: [one.low, one.high] for one in band.bands}
    ends = {node: known[name] for node in nodes if (name := temperature_of(node)) in known}
    return {"temperatures_degC_band": ends, "model_band": band}


def _other_assumptions(loop: Loop) -> list[str]:
    """Return the assumptions of the case beyond the network.

    What the case assumes of a clearance holds for temperatures that are not those found here.
    """
    passed = ("clearance in operation", CLEARANCE_HOLDS)
    return [
        text
        for text in loop.of_case
        if text not in loop.of_network
        and not text.startswith(passed)
        and not text.split(": ", 1)[-1].startswith(passed)  # behind the name of a bearing
    ]


def _flows(network: Network, temperatures: FloatArray) -> list[HeatFlow]:
    """Return the heat between all nodes.

    The largest flow comes first.
    """
    names, flows = network.names, network.flows(temperatures)
    pairs = [(i, j) for i in range(len(names)) for j in range(len(names)) if flows[i, j] > 0.0]
    return [
        HeatFlow(
            source=names[i],
            target=names[j],
            heat_W=float(flows[i, j]),
            conductance_W_per_K=float(network.conductance[i, j]),
        )
        for i, j in sorted(pairs, key=lambda pair: -flows[pair])
    ]


def _in_watts(losses: dict[str, float]) -> dict[str, float | None]:
    """Return losses by mechanism [W].

    The contacts of the cage are one.
    """
    return {name: None if value is None else 1e-3 * value for name, value in merged_cage(losses).items()}


def _state(point: Point) -> State:
    """Put a quasi-static point into the units of the interface."""
    return State(
        friction_torque_Nmm=finite(1e3 * point["torque"]),
        power_loss_W=point.power,
        viscosity_mm2_per_s=1e6 * point["viscosity"],
        inlet_degC=point.inlet - _ZERO_CELSIUS,
        clearance_um=1e6 * point.clearance,
        max_pressure_GPa=1e-9 * point["pressure"],
        film_um=finite(1e6 * point["film"]),
        film_parameter=finite(point["parameter"]),
    )


def _reason(loop: Loop, course: Course) -> str:
    """Explain the early end of a course.

    Empty when it did not end early.
    """
    if not course.beyond_limit:
        return ""
    last = np.where(np.isnan(loop.nodes.held), course.temperatures[-1], -math.inf)
    hottest = loop.nodes.names[int(np.argmax(last))]
    what = f"{hottest.replace('_', ' ')} passed thermal.limit = {loop.thermal.limit - _ZERO_CELSIUS:g} degC"
    feeding = course.gain is not None and course.gain.loop >= 1.0
    cause = f"{runaway_sentence(course.gain)}; " if feeding and course.gain else ""
    return f"{cause}{what} after {course.time[-1]:.4g} s"
