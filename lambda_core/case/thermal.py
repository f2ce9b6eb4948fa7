"""Declare the thermal network of a bearing or a machine."""

from __future__ import annotations

from typing import Literal

from pydantic import field_validator

from lambda_core.case.option import Section, option
from lambda_core.domain.units import (
    Area,
    HeatCapacity,
    HeatTransfer,
    Length,
    Mass,
    Power,
    Temperature,
    ThermalConductance,
    Velocity,
    Volume,
    VolumeFlow,
)

Conductances = Literal["harris", "palmgren", "iso-15312", "none"]


class ThermalNode(Section):
    """Node of the thermal network.

    It is one of the bearing's own, or a further one.
    """

    heat_capacity: HeatCapacity | None = option(
        None, "heat capacity; absent: estimated for the bearing's own nodes, none for a further one", gt=0.0
    )
    temperature: Temperature | None = option(None, "temperature at which the node is held; absent: it is found")
    start: Temperature | None = option(None, "temperature at the start of a transient; absent: thermal.start")
    heat: Power = option("0 W", "heat put in from outside: a seal's, a gear's, a motor's")


class ThermalLink(Section):
    """Conductance between two nodes.

    It takes the place of the set's own between the same two.
    """

    between: list[str] = option(description="names of the two nodes", min_length=2, max_length=2)
    conductance: ThermalConductance = option(description="heat flow per difference of temperature", ge=0.0)

    @field_validator("between")
    @classmethod
    def _two(cls, names: list[str]) -> list[str]:
        if names[0] == names[1]:
            raise ValueError(f'a link joins two different nodes, not "{names[0]}" with itself')
        return names


class Thermal(Section):
    """Thermal network of the bearing and its surroundings."""

    conductances: Conductances = option(
        "harris",
        'ready set of conductances to the surroundings: "harris" (convection and radiation of housing and shaft), '
        '"palmgren" (one cooling factor of the housing), "iso-15312" (reference conditions of the thermal speed '
        'rating), "none" (only the links written here)',
    )
    ambient: Temperature = option("20 degC", "temperature of the surroundings", reference="ISO 15312: 20 degC")
    start: Temperature | None = option(None, "temperature of all nodes at the start of a transient; absent: ambient")
    inlet: Literal["oil", "surfaces"] = option(
        "oil", "temperature of the oil that enters the contacts: that of the bath, or the mean of rings and balls"
    )
    limit: Temperature = option("200 degC", "a bearing that does not stay below this temperature runs away")
    housing_area: Area | None = option(
        None, "outer surface of the housing; absent: that of a pillow block of usual proportions", gt=0.0
    )
    housing_mass: Mass | None = option(None, "absent: that of the same pillow block, of cast iron", gt=0.0)
    shaft_length: Length | None = option(
        None, "length of the shaft that takes part in storing heat; absent: twice the bearing's width", gt=0.0
    )
    air_speed: Velocity = option("0 m/s", "speed of the air over the housing; 0 is still air", ge=0.0)
    emissivity: float = option(0.9, "of the housing's surface; painted or rusted metal", ge=0.0, le=1.0)
    seat_conductance: HeatTransfer = option(
        "2600 W/(m2 K)",
        "of the joints ring - shaft and ring - housing, per area",
        reference="10 um of air, 0.026 W/(m K), across the whole seat",
        gt=0.0,
    )
    oil_volume: Volume | None = option(None, "oil that stores heat; absent: a tenth of the bearing's volume", gt=0.0)
    oil_flow: VolumeFlow = option("0 l/min", "oil that flows through the bearing and takes heat along", ge=0.0)
    oil_supply: Temperature | None = option(None, "temperature of the oil that flows in; absent: ambient")
    nodes: dict[str, ThermalNode] = option({}, "nodes by name, the bearing's own or further ones")
    links: dict[str, ThermalLink] = option({}, "conductances by any name")


class MachineThermal(Thermal):
    """Thermal network of a machine: shaft, housing and all bearings."""

    enclosed: bool = option(
        True,
        "whether the housing encloses the shaft between its outermost bearings: the shaft then gives heat to the "
        "housing there, otherwise to the surroundings",
    )


class BearingThermal(Section):
    """Thermal options of one bearing of a machine.

    If the table is absent, [thermal] applies.
    """

    inlet: Literal["oil", "surfaces"] | None = option(None, "temperature of the oil that enters its contacts")
    seat_conductance: HeatTransfer | None = option(None, "of its joints ring - shaft and ring - housing", gt=0.0)
    oil_volume: Volume | None = option(None, "its oil that stores heat", gt=0.0)
    oil_flow: VolumeFlow | None = option(None, "oil that flows through it", ge=0.0)
    oil_supply: Temperature | None = option(None, "temperature of the oil that flows in")
    nodes: dict[str, ThermalNode] = option({}, "its own nodes by name, without the bearing's name")
