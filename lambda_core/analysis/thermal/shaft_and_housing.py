"""Describe shaft and housing of several bearings."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from lambda_core.analysis.thermal import surroundings as outside
from lambda_core.analysis.thermal.bearing_nodes import BearingNodes, Pairs
from lambda_core.analysis.thermal.conductances import rod
from lambda_core.analysis.thermal.machine_network import MachineNetwork
from lambda_core.analysis.thermal.pillow_block import PillowBlock
from lambda_core.model.machine_model import MachineModel


@dataclass(frozen=True)
class _Piece:
    """A piece of the shaft between two of its nodes."""

    begin: str
    end: str
    length: float  # [m]
    diameter: float  # [m]
    bore: float  # [m]
    around: str  # node that it gives heat to

    @property
    def area(self) -> float:
        """Of the cross-section [m2]."""
        return 0.25 * math.pi * (self.diameter**2 - self.bore**2)


class ShaftAndHousing:
    """Shaft and housing of a machine.

    Parameters
    ----------
    machine : MachineModel
        With its network.
    """

    def __init__(self, machine: MachineModel) -> None:
        self.machine, self.heat = machine, machine.heat
        self._sizes = [bearing.model.geometry.outside_diameter for bearing in machine.bearings]
        self._pieces = _pieces(machine)

    def conductances(self, temperatures: Mapping[str, float]) -> Pairs:
        """Return the conductances of shaft and housing [W/K].

        They act along the shaft, and from shaft and housing to the surroundings.

        The housing has the surface of all bearings' pillow blocks, where the case does not say, and the height of the
        largest one.
        """
        section = self.heat.section
        found = self._along(temperatures)
        area = section.housing_area or sum(map(outside.housing_area, self._sizes))
        if section.conductances == "palmgren":
            found["housing", "ambient"] = outside.PALMGREN_COEFFICIENT * area
        elif section.conductances == "harris":
            height = outside.HEIGHT_RATIO * max(self._sizes)
            housing = temperatures["housing"]
            found["housing", "ambient"] = area * outside.housing_coefficient(
                height, housing, section.ambient, section.air_speed, section.emissivity
            )
        return found

    def _along(self, temperatures: Mapping[str, float]) -> Pairs:
        """Return the conductances along and around the shaft [W/K].

        They lead along and around its surface, and from its end faces to the air.
        """
        found: Pairs = {}
        conductivity = self.heat.material.thermal_conductivity
        if not self._pieces or self._pieces[0].begin not in temperatures:
            return found
        last = len(self._pieces) - 1
        for i, piece in enumerate(self._pieces):
            h = self._coefficient(piece, temperatures)
            through, side = rod(piece.length, piece.area, math.pi * piece.diameter, h, conductivity)
            found[piece.begin, piece.end] = through
            for node, is_end in ((piece.begin, i == 0), (piece.end, i == last)):
                value = side + (h * piece.area if is_end else 0.0)
                found[node, piece.around] = found.get((node, piece.around), 0.0) + value
        return found

    def _coefficient(self, piece: _Piece, temperatures: Mapping[str, float]) -> float:
        """Return a piece's surface heat transfer coefficient [W/(m2 K)]."""
        if self.heat.section.conductances != "harris":
            return 0.0
        surface = 0.5 * (temperatures[piece.begin] + temperatures[piece.end])
        return outside.shaft_coefficient(piece.diameter, self.machine.speed, surface, temperatures[piece.around])

    def capacities(self) -> dict[str, float]:
        """Return the heat capacities of shaft and housing [J/K].

        The shaft's nodes include the discs on them.
        """
        steel = self.heat.material
        found = dict.fromkeys(self.heat.shaft, 0.0)
        for piece in self._pieces:
            half = 0.5 * piece.area * piece.length * steel.density * steel.specific_heat
            found[piece.begin] += half
            found[piece.end] += half
        body = self.machine.body
        for disc in body.discs:
            found[self.heat.shaft[body.node(disc.position)]] += disc.mass * steel.specific_heat
        mass = self.heat.section.housing_mass or sum(map(outside.housing_mass, self._sizes))
        found["housing"] = mass * outside.CAST_IRON_HEAT
        return found


def _pieces(machine: MachineModel) -> tuple[_Piece, ...]:
    """Return the shaft's pieces between its nodes.

    Each has the diameter that it is drawn with.
    """
    heat, at = machine.heat, machine.body.positions
    seats = [bearing.position for bearing in machine.bearings]
    ends = np.array([end for _, end, _, _ in machine.outline[:-1]])
    found = []
    for (one, begin), (other, end) in pairwise(zip(heat.shaft, at.tolist(), strict=True)):
        middle = 0.5 * (begin + end)
        _, _, diameter, bore = machine.outline[int(np.searchsorted(ends, middle))]
        inside = heat.section.enclosed and min(seats) < middle < max(seats)
        found.append(_Piece(one, other, end - begin, diameter, bore, "housing" if inside else "ambient"))
    return tuple(found)


def network_of(machine: MachineModel) -> MachineNetwork:
    """Return the network of a machine."""
    heat = machine.heat
    bearings = [BearingNodes(b.model, heat.bearings[b.name], b.name) for b in machine.bearings]
    around = PillowBlock(bearings[0]) if heat.is_alone else ShaftAndHousing(machine)
    return MachineNetwork(machine.name, heat.nodes, bearings, around)
