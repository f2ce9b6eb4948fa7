"""Describe one bearing in a thermal network.

Nodes, heat, conductances inside it and to its seats.
"""

from __future__ import annotations

import math

from lambda_core.analysis.thermal import iso15312
from lambda_core.analysis.thermal import surroundings as outside
from lambda_core.analysis.thermal.conductances import in_series, oil_film_coefficient, wall
from lambda_core.analysis.thermal.heat import destinations, heat_of
from lambda_core.analysis.thermal.losses import Point
from lambda_core.case.thermal import Thermal
from lambda_core.laws.context import Material
from lambda_core.model.bearing_model import BearingModel
from lambda_core.model.bodies.resolve_bodies import ring_inertia
from lambda_core.model.settings.resolve_thermal import CAGE, OWN_NODES, SUPPLY
from lambda_core.solver.drivers.tables import ball_mass

Pairs = dict[tuple[str, str], float]

_OIL_SHARE = 0.1  # of the volume between bore and outside diameter, where the case does not say how much oil there is
_COMMON = ("housing", "ambient")  # nodes that all bearings of a machine share


def _surface(model: BearingModel) -> float:
    """Return the surface of one rolling element [m2].

    A ball has pi D^2; a roller with its ends has pi D L + pi D^2/2.
    """
    if model.rollers is None:
        return math.pi * model.geometry.ball_diameter**2
    diameter = model.rollers.diameter
    return math.pi * diameter * (model.rollers.length + 0.5 * diameter)


class BearingNodes:
    """Nodes of one bearing.

    It is alone or one of several on a shaft.

    Parameters
    ----------
    model : BearingModel
        The bearing.
    thermal : Thermal
        What the case says of its network.
    name : str
        Of the bearing in its machine; empty for a bearing alone.
    """

    def __init__(self, model: BearingModel, thermal: Thermal, name: str = "") -> None:
        self.model, self.thermal, self.name = model, thermal, name
        self._shares = destinations(model)

    def node(self, own: str) -> str:
        """Return a bearing node's name in the network."""
        return own if own in _COMMON or not self.name else f"{self.name}.{own}"

    def _named(self, pairs: Pairs) -> Pairs:
        return {(self.node(one), self.node(other)): value for (one, other), value in pairs.items()}

    def heat(self, losses: dict[str, float]) -> dict[str, float]:
        """Return the heat of losses in the nodes [W].

        It follows from the losses of each mechanism [W].
        """
        heat = heat_of(losses, self._shares).tolist()
        return {self.node(own): value for own, value in zip(OWN_NODES, heat, strict=True)}

    def seats(self) -> Pairs:
        """Return the constant conductances [W/K].

        Seats and walls, which no operating point changes.
        """
        g, t, model = self.model.geometry, self.thermal, self.model
        if t.conductances == "none":
            return {}
        if t.conductances == "iso-15312":
            total = iso15312.conductance(g.bore_diameter, g.outside_diameter, g.width)
            share = g.bore_diameter / (g.bore_diameter + g.outside_diameter)
            return self._named(
                {("inner_ring", "ambient"): share * total, ("outer_ring", "ambient"): (1.0 - share) * total}
            )
        seats = [
            math.pi * g.width * diameter * t.seat_conductance for diameter in (g.bore_diameter, g.outside_diameter)
        ]
        inner = 0.5 * (g.bore_diameter + g.race_diameter_inner)
        outer = 0.5 * (g.outside_diameter + g.race_diameter_outer)
        block = outside.HEIGHT_RATIO * g.outside_diameter
        middle = math.sqrt(g.outside_diameter * block)
        return self._named(
            {
                ("inner_ring", "shaft"): in_series(
                    wall(g.bore_diameter, inner, g.width, model.inner_material.thermal_conductivity), seats[0]
                ),
                ("outer_ring", "housing"): in_series(
                    wall(outer, g.outside_diameter, g.width, model.outer_material.thermal_conductivity),
                    seats[1],
                    wall(g.outside_diameter, middle, g.width, outside.CAST_IRON_CONDUCTIVITY),
                ),
            }
        )

    def inside(self, point: Point) -> Pairs:
        """Return the conductances of contacts and oil [W/K].

        Between the oil and what it wets, all surfaces are wetted.
        """
        g, oil = self.model.geometry, self.model.oil
        nu, k = point["viscosity"], oil.thermal_conductivity
        prandtl = point["density"] * nu * oil.specific_heat / k
        speed = 0.5 * abs(point["orbit"]) * g.pitch_diameter
        h = oil_film_coefficient(speed, g.pitch_diameter, nu, k, prandtl)
        found = {
            ("inner_ring", "oil"): h * math.pi * g.race_diameter_inner * g.width,
            ("outer_ring", "oil"): h * math.pi * g.race_diameter_outer * g.width,
            ("balls", "oil"): h * g.ball_count * _surface(self.model),
            ("inner_ring", "balls"): point["contact_inner"],
            ("outer_ring", "balls"): point["contact_outer"],
        }
        if not self.model.full_complement:
            found[CAGE, "oil"] = h * 2.0 * math.pi * g.pitch_diameter * self.model.cage.width
        if self.thermal.conductances in ("harris", "palmgren"):
            slow = oil_film_coefficient(speed / 3.0, g.outside_diameter, nu, k, prandtl)
            found["oil", "housing"] = slow * 0.5 * math.pi * g.outside_diameter**2
        if self.thermal.oil_flow > 0.0:
            found["oil", SUPPLY] = point["density"] * oil.specific_heat * self.thermal.oil_flow
        return self._named(found)

    def capacities(self, density: float) -> dict[str, float]:
        """Return the heat capacities [J/K].

        They are those of the rings, the balls, the oil of a density [kg/m3], and the cage, if there is one.
        """
        g, model, t = self.model.geometry, self.model, self.thermal
        rings: dict[str, Material] = {"inner": model.inner_material, "outer": model.outer_material}
        space = math.pi / 4.0 * (g.outside_diameter**2 - g.bore_diameter**2) * g.width
        own = {
            f"{ring}_ring": ring_inertia(g, ring, part.density).mass * part.specific_heat  # type: ignore[arg-type]
            for ring, part in rings.items()
        }
        own["balls"] = g.ball_count * ball_mass(model) * model.ball_material.specific_heat
        own["oil"] = (t.oil_volume or _OIL_SHARE * space) * density * model.oil.specific_heat
        if not model.full_complement:
            own[CAGE] = model.cage_body.mass * model.cage_material.specific_heat
        return {self.node(name): value for name, value in own.items()}
