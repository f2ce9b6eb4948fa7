"""Join bearings, shaft, housing and surroundings to one network."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Protocol

import numpy as np

from lambda_core.analysis.thermal.bearing_nodes import BearingNodes, Pairs
from lambda_core.analysis.thermal.losses import Point
from lambda_core.analysis.thermal.network import Network
from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.errors import CaseError, Problem
from lambda_core.model.settings.resolve_thermal import NodeSet


class Surroundings(Protocol):
    """Shaft and housing around the bearings."""

    def conductances(self, temperatures: Mapping[str, float]) -> Pairs:
        """Return conductances of the shaft and surroundings [W/K].

        They act along the shaft and to the surroundings, at temperatures of the nodes [K].
        """

    def capacities(self) -> dict[str, float]:
        """Return heat capacities of shaft and housing nodes [J/K]."""


class MachineNetwork:
    """Nodes and conductances of bearings and what carries them.

    Parameters
    ----------
    case : str
        Name of the case, for errors.
    nodes : NodeSet
        All nodes, and what the case says of them.
    bearings : sequence of BearingNodes
        From left to right.
    around : Surroundings
        Shaft and housing.

    Attributes
    ----------
    names : tuple of str
        All nodes that anything joins to a held temperature.
    held : float64[:], shape (n,)
        Temperatures of the nodes that are held [K], NaN at those that are found.
    """

    def __init__(self, case: str, nodes: NodeSet, bearings: Sequence[BearingNodes], around: Surroundings) -> None:
        self._case, self._nodes, self.bearings, self.around = case, nodes, tuple(bearings), around
        lost = nodes.isolated()
        self.names = tuple(name for name in nodes.names if name not in lost)
        self._number = {name: i for i, name in enumerate(self.names)}
        self.held = np.array([nodes.held.get(name, math.nan) for name in self.names])
        self._extra = np.array([n.heat if (n := nodes.given.get(name)) else 0.0 for name in self.names])
        self._seats: Pairs = {}
        for bearing in self.bearings:
            self._seats.update(bearing.seats())

    def index(self, name: str) -> int:
        """Return the number of a node."""
        return self._number[name]

    def named(self, temperatures: FloatArray) -> dict[str, float]:
        """Return the temperatures by node [K]."""
        return dict(zip(self.names, temperatures.tolist(), strict=True))

    def heat(self, points: Sequence[Point]) -> FloatArray:
        """Return the heat of all losses per node [W].

        It is that of all bearings with what the case adds; the array has shape (n,).
        """
        own: dict[str, float] = {}
        for bearing, point in zip(self.bearings, points, strict=True):
            for name, value in bearing.heat(point.losses).items():
                own[name] = own.get(name, 0.0) + value
        found: FloatArray = self._extra + np.array([own.get(name, 0.0) for name in self.names])
        return found

    def network(self, points: Sequence[Point], temperatures: FloatArray) -> Network:
        """Return the network at points and temperatures [K].

        The points are quasi-static points of the bearings, the temperatures those of the nodes.
        """
        pairs = {**self._seats, **self.around.conductances(self.named(temperatures))}
        for bearing, point in zip(self.bearings, points, strict=True):
            pairs.update(bearing.inside(point))
        conductance = np.zeros((len(self.names), len(self.names)))
        for (one, other), value in (*pairs.items(), *self._nodes.links.items()):
            if one in self._number and other in self._number:
                i, j = self._number[one], self._number[other]
                conductance[i, j] = conductance[j, i] = value
        return Network(self.names, conductance, self.heat(points), self.held)

    def capacities(self, points: Sequence[Point]) -> FloatArray:
        """Return the heat capacity of every node [J/K].

        The shape is (n,); the capacity is infinite where the temperature is held.

        Parameters
        ----------
        points : sequence of Point
            Whose oil has the densities that count.

        Raises
        ------
        CaseError
            With the further nodes of the case that have none.
        """
        found = self.around.capacities()
        for bearing, point in zip(self.bearings, points, strict=True):
            found.update(bearing.capacities(point["density"]))
        given = self._nodes.given
        found.update({name: node.heat_capacity for name, node in given.items() if node.heat_capacity is not None})
        missing = [n for n, held in zip(self.names, self.held, strict=True) if n not in found and math.isnan(held)]
        if missing:
            problems = [
                Problem(f"thermal.nodes.{n}.heat_capacity", "is required for a course over time") for n in missing
            ]
            raise CaseError(self._case, problems)
        free = np.isnan(self.held)
        return np.where(free, [found.get(name, math.inf) for name in self.names], math.inf)

    def start(self) -> FloatArray:
        """Return the initial node temperatures of a transient [K].

        The array has shape (n,).
        """
        given, common = self._nodes.given, self._nodes.start
        first = [(given[name].start if name in given else None) or common for name in self.names]
        return np.where(np.isnan(self.held), first, self.held)
