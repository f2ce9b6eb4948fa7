"""The network of one bearing: its nodes, what they store, and the conductances at a quasi-static point."""

from __future__ import annotations

import math

import numpy as np

from lambda_core.case.thermal import Thermal
from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.errors import CaseError, Problem
from lambda_core.solver.drivers.tables import ball_mass
from lambda_core.system.bearing import BearingModel
from lambda_core.system.resolve_bodies import ring_inertia
from lambda_core.system.resolve_thermal import OWN_NODES, SUPPLY, held_temperatures, isolated, joined, node_names
from lambda_core.system.time_functions import initial
from lambda_core.thermal import iso15312
from lambda_core.thermal import surroundings as outside
from lambda_core.thermal.conductances import in_series, oil_film_coefficient, wall
from lambda_core.thermal.heat import destinations, heat_of
from lambda_core.thermal.losses import Point
from lambda_core.thermal.network import Network

_OIL_SHARE = 0.1  # of the volume between bore and outside diameter, where the case does not say how much oil there is
_SHAFT_WIDTHS = 2.0  # bearing widths of shaft that store heat


class BearingNetwork:
    """Nodes and conductances of a bearing and its surroundings.

    Parameters
    ----------
    model : BearingModel
        The bearing.
    thermal : Thermal
        Section of its case.

    Attributes
    ----------
    names : tuple of str
        All nodes.
    """

    def __init__(self, model: BearingModel, thermal: Thermal) -> None:
        self.model, self.thermal = model, thermal
        lost = isolated(node_names(thermal), joined(thermal), held_temperatures(thermal))
        self.names = tuple(name for name in node_names(thermal) if name not in lost)
        self._shares = destinations(model)
        held = held_temperatures(thermal)
        self.held = np.array([held.get(name, math.nan) for name in self.names])
        self._extra = np.array([n.heat if (n := thermal.nodes.get(name)) else 0.0 for name in self.names])
        self._constant = self._solid_parts()

    def index(self, name: str) -> int:
        """Return the number of a node."""
        return self.names.index(name)

    def own_heat(self, losses: dict[str, float]) -> FloatArray:
        """Return the heat that losses by mechanism [W] put into each node, with what the case adds, shape (n,)."""
        own = dict(zip(OWN_NODES, heat_of(losses, self._shares).tolist(), strict=True))
        found: FloatArray = self._extra + np.array([own.get(name, 0.0) for name in self.names])
        return found

    def network(self, point: Point, temperatures: FloatArray) -> Network:
        """Return the network at a quasi-static point and temperatures of the nodes [K]."""
        pairs = {**self._constant, **self._in_oil(point), **self._outer(point, temperatures)}
        pairs["inner_ring", "balls"], pairs["outer_ring", "balls"] = point["contact_inner"], point["contact_outer"]
        conductance = np.zeros((len(self.names), len(self.names)))
        for (one, other), value in pairs.items():
            self._join(conductance, one, other, value)
        for link in self.thermal.links.values():
            self._join(conductance, link.between[0], link.between[1], link.conductance)
        return Network(self.names, conductance, self.own_heat(point.losses), self.held)

    def _join(self, conductance: FloatArray, one: str, other: str, value: float) -> None:
        if one in self.names and other in self.names:
            i, j = self.index(one), self.index(other)
            conductance[i, j] = conductance[j, i] = value

    def _solid_parts(self) -> dict[tuple[str, str], float]:
        """Return the conductances that no operating point changes [W/K]: seats and walls."""
        g, t, model = self.model.geometry, self.thermal, self.model
        if t.conductances == "none":
            return {}
        if t.conductances == "iso-15312":
            total = iso15312.conductance(g.bore_diameter, g.outside_diameter, g.width)
            share = g.bore_diameter / (g.bore_diameter + g.outside_diameter)
            return {("inner_ring", "ambient"): share * total, ("outer_ring", "ambient"): (1.0 - share) * total}
        seats = [
            math.pi * g.width * diameter * t.seat_conductance for diameter in (g.bore_diameter, g.outside_diameter)
        ]
        inner = 0.5 * (g.bore_diameter + g.race_diameter_inner)
        outer = 0.5 * (g.outside_diameter + g.race_diameter_outer)
        block = outside.HEIGHT_RATIO * g.outside_diameter
        middle = math.sqrt(g.outside_diameter * block)
        return {
            ("inner_ring", "shaft"): in_series(
                wall(g.bore_diameter, inner, g.width, model.inner_material.thermal_conductivity), seats[0]
            ),
            ("outer_ring", "housing"): in_series(
                wall(outer, g.outside_diameter, g.width, model.outer_material.thermal_conductivity),
                seats[1],
                wall(g.outside_diameter, middle, g.width, outside.CAST_IRON_CONDUCTIVITY),
            ),
        }

    def _in_oil(self, point: Point) -> dict[tuple[str, str], float]:
        """Return the conductances between oil and what it wets, all surfaces wetted [W/K]."""
        g, oil = self.model.geometry, self.model.oil
        nu, k = point["viscosity"], oil.thermal_conductivity
        prandtl = point["density"] * nu * oil.specific_heat / k
        speed = 0.5 * abs(point["orbit"]) * g.pitch_diameter
        h = oil_film_coefficient(speed, g.pitch_diameter, nu, k, prandtl)
        found = {
            ("inner_ring", "oil"): h * math.pi * g.race_diameter_inner * g.width,
            ("outer_ring", "oil"): h * math.pi * g.race_diameter_outer * g.width,
            ("balls", "oil"): h * g.ball_count * math.pi * g.ball_diameter**2,
            ("cage", "oil"): h * 2.0 * math.pi * g.pitch_diameter * self.model.cage.width,
        }
        if self.thermal.conductances in ("harris", "palmgren"):
            slow = oil_film_coefficient(speed / 3.0, g.outside_diameter, nu, k, prandtl)
            found["oil", "housing"] = slow * 0.5 * math.pi * g.outside_diameter**2
        if self.thermal.oil_flow > 0.0:
            found["oil", SUPPLY] = point["density"] * oil.specific_heat * self.thermal.oil_flow
        return found

    def _outer(self, point: Point, temperatures: FloatArray) -> dict[tuple[str, str], float]:
        """Return the conductances from housing and shaft to the surroundings [W/K]."""
        g, t = self.model.geometry, self.thermal
        area = t.housing_area or outside.housing_area(g.outside_diameter)
        if t.conductances == "palmgren":
            return {("housing", "ambient"): outside.PALMGREN_COEFFICIENT * area}
        if t.conductances != "harris":
            return {}
        housing, shaft = (float(temperatures[self.index(name)]) for name in ("housing", "shaft"))
        height = outside.HEIGHT_RATIO * g.outside_diameter
        air = outside.natural_convection(height, housing, t.ambient)
        if t.air_speed > 0.0:
            air = max(air, outside.forced_convection(height, t.air_speed))
        spin = initial(self.model.inner_ring.dofs["spin"].motion)
        still = outside.natural_convection(g.bore_diameter, shaft, t.ambient)
        around = max(outside.rotating_shaft(g.bore_diameter, spin), still)
        conductivity = self.model.inner_material.thermal_conductivity
        return {
            ("housing", "ambient"): area * (air + outside.radiation(t.emissivity, housing, t.ambient)),
            ("shaft", "ambient"): outside.long_fin(g.bore_diameter, around, conductivity),
        }

    def capacities(self, density: float) -> FloatArray:
        """Return the heat capacity of every node [J/K], shape (n,); infinite where the temperature is held.

        Parameters
        ----------
        density : float
            Of the oil [kg/m3].

        Raises
        ------
        CaseError
            With the further nodes of the case that have none.
        """
        g, model, t = self.model.geometry, self.model, self.thermal
        rings = {ring: getattr(model, f"{ring}_material") for ring in ("inner", "outer")}
        space = math.pi / 4.0 * (g.outside_diameter**2 - g.bore_diameter**2) * g.width
        steel = model.inner_material
        length = t.shaft_length or _SHAFT_WIDTHS * g.width
        own = {
            f"{ring}_ring": ring_inertia(g, ring, part.density).mass * part.specific_heat  # type: ignore[arg-type]
            for ring, part in rings.items()
        }
        own["balls"] = g.ball_count * ball_mass(model) * model.ball_material.specific_heat
        own["oil"] = (t.oil_volume or _OIL_SHARE * space) * density * model.oil.specific_heat
        own["cage"] = model.cage_body.mass * model.cage_material.specific_heat
        own["shaft"] = math.pi / 4.0 * g.bore_diameter**2 * length * steel.density * steel.specific_heat
        own["housing"] = (t.housing_mass or outside.housing_mass(g.outside_diameter)) * outside.CAST_IRON_HEAT
        given = {name: node.heat_capacity for name, node in t.nodes.items() if node.heat_capacity is not None}
        found = {**own, **given}
        missing = [n for n, held in zip(self.names, self.held, strict=True) if n not in found and math.isnan(held)]
        if missing:
            problems = [Problem(f"thermal.nodes.{n}.heat_capacity", "is required over time") for n in missing]
            raise CaseError(model.name, problems)
        free = np.isnan(self.held)
        return np.where(free, [found.get(name, math.inf) for name in self.names], math.inf)

    def start(self) -> FloatArray:
        """Return the temperatures of the nodes at the start of a transient [K], shape (n,)."""
        common = self.thermal.start or self.thermal.ambient
        nodes = self.thermal.nodes
        first = [(nodes[name].start if name in nodes else None) or common for name in self.names]
        return np.where(np.isnan(self.held), first, self.held)
