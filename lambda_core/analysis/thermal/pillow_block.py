"""Surround one bearing by a pillow block and shaft."""

from __future__ import annotations

import math
from collections.abc import Mapping

from lambda_core.analysis.thermal import surroundings as outside
from lambda_core.analysis.thermal.bearing_nodes import BearingNodes, Pairs
from lambda_core.analysis.thermal.machine_network import MachineNetwork
from lambda_core.case.thermal import Thermal
from lambda_core.model.bearing_model import BearingModel
from lambda_core.model.laws.time_functions import initial
from lambda_core.model.settings.resolve_thermal import nodes_alone

_SHAFT_WIDTHS = 2.0  # bearing widths of shaft that store heat


class PillowBlock:
    """Housing and shaft of one bearing alone.

    Parameters
    ----------
    bearing : BearingNodes
        The bearing.
    """

    def __init__(self, bearing: BearingNodes) -> None:
        self.model, self.thermal = bearing.model, bearing.thermal
        self._shaft = bearing.node("shaft")

    def conductances(self, temperatures: Mapping[str, float]) -> Pairs:
        """Return the conductances to the surroundings [W/K].

        They lead from housing and shaft and hold at temperatures [K].
        """
        g, t = self.model.geometry, self.thermal
        area = t.housing_area or outside.housing_area(g.outside_diameter)
        if t.conductances == "palmgren":
            return {("housing", "ambient"): outside.PALMGREN_COEFFICIENT * area}
        if t.conductances != "harris":
            return {}
        housing, shaft = temperatures["housing"], temperatures[self._shaft]
        around = outside.housing_coefficient(
            outside.HEIGHT_RATIO * g.outside_diameter, housing, t.ambient, t.air_speed, t.emissivity
        )
        spin = initial(self.model.inner_ring.dofs["spin"].motion)
        along = outside.shaft_coefficient(g.bore_diameter, spin, shaft, t.ambient)
        conductivity = self.model.inner_material.thermal_conductivity
        return {
            ("housing", "ambient"): area * around,
            (self._shaft, "ambient"): outside.long_fin(g.bore_diameter, along, conductivity),
        }

    def capacities(self) -> dict[str, float]:
        """Return the heat capacities of shaft and housing [J/K]."""
        g, t, steel = self.model.geometry, self.thermal, self.model.inner_material
        length = t.shaft_length or _SHAFT_WIDTHS * g.width
        return {
            self._shaft: math.pi / 4.0 * g.bore_diameter**2 * length * steel.density * steel.specific_heat,
            "housing": (t.housing_mass or outside.housing_mass(g.outside_diameter)) * outside.CAST_IRON_HEAT,
        }


def bearing_network(model: BearingModel, thermal: Thermal) -> MachineNetwork:
    """Return the network of one bearing alone.

    It is in a pillow block.
    """
    bearing = BearingNodes(model, thermal)
    return MachineNetwork(
        model.name, nodes_alone(thermal, has_cage=not model.full_complement), (bearing,), PillowBlock(bearing)
    )
