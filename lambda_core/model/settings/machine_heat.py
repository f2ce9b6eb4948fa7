"""Resolve the thermal network of a machine."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from lambda_core.case.machine import MachineCase
from lambda_core.case.thermal import MachineThermal, Thermal, ThermalNode
from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.errors import unknown_name
from lambda_core.formulas.elastic.body import ElasticBody
from lambda_core.formulas.elastic.sections import BodyMaterial
from lambda_core.formulas.fits import REFERENCE_TEMPERATURE
from lambda_core.model.ledger import Ledger
from lambda_core.model.settings.resolve_thermal import (
    CAGE,
    INSIDE,
    NO_CAGE,
    OUTSIDE,
    OWN_NODES,
    SUPPLY,
    NodeSet,
    Pair,
    check_links,
    check_nodes,
    check_surroundings,
    common_assumptions,
    network_assumptions,
)

_SHARED = ("housing", "ambient")
BEARING_NODES = tuple(name for name in OWN_NODES if name not in _SHARED)
ENDS = ("shaft_begin", "shaft_end")  # nodes of the shaft
_NUMBERED = "shaft_node_"
_PARTS = ("inner_ring", "outer_ring", "balls", "shaft", "housing")


@dataclass(frozen=True)
class MachineHeat:
    """Thermal network of a machine.

    Attributes
    ----------
    section : MachineThermal
        Section of the case.
    bearings : mapping of str to Thermal
        The section with what each bearing has of its own.
    shaft : tuple of str
        Nodes of the shaft, at the positions of its body.
    nodes : NodeSet
        All nodes.
    material, housing : BodyMaterial
        Of shaft and housing.
    is_alone : bool
        Whether a pillow block and a long shaft surround a single bearing, as they do where the shaft is rigid.
    """

    section: MachineThermal
    bearings: Mapping[str, Thermal]
    shaft: tuple[str, ...]
    nodes: NodeSet
    material: BodyMaterial
    housing: BodyMaterial
    is_alone: bool

    @property
    def assumptions(self) -> list[str]:
        """Assumptions of the network.

        They include the values that the network adds where the case has none.
        """
        return network_assumptions(self.section) if self.is_alone else _assumptions(self.section)


def check_heat(case: MachineCase, ledger: Ledger) -> None:
    """Note wrong temperatures and surroundings.

    Whatever the shaft is.
    """
    section = case.thermal
    check_surroundings(section, ledger)
    if section.conductances == "iso-15312" and not case.shaft.is_rigid:
        ledger.problem("thermal.conductances", '"iso-15312" is the reference of one bearing alone: use "harris"')
    if section.shaft_length is not None and not case.shaft.is_rigid:
        ledger.problem("thermal.shaft_length", "has no effect: the sections of the shaft store heat")
    for name, bearing in case.bearings.items():
        own = bearing.thermal
        for node in own.nodes:
            if node not in BEARING_NODES:
                ledger.problem(f"bearings.{name}.thermal.nodes.{node}", unknown_name("node", node, BEARING_NODES))
        if own.oil_supply is not None and not _effective(section, case, name).oil_flow:
            ledger.problem(f"bearings.{name}.thermal.oil_supply", "has no effect without oil_flow")
    if section.oil_supply is not None and not any(_effective(section, case, b).oil_flow for b in case.bearings):
        ledger.problem("thermal.oil_supply", "has no effect without thermal.oil_flow")
    if case.operation.temperatures == "computed":
        _check_computed(case, ledger)


def resolve_heat(
    case: MachineCase,
    bearings: Mapping[str, bool],
    body: ElasticBody,
    materials: tuple[BodyMaterial, BodyMaterial],
    ledger: Ledger,
) -> MachineHeat:
    """Return the network.

    Problems of nodes and links are noted.

    Parameters
    ----------
    case : MachineCase
        With positions in place of markers.
    bearings : mapping of str to bool
        Whether they have a cage, by name, from left to right.
    body : ElasticBody
        The shaft.
    materials : tuple of BodyMaterial
        Of shaft and housing.
    ledger : Ledger
        Takes problems and assumptions.
    """
    section = case.thermal
    own = {name: _effective(section, case, name) for name in bearings}
    shaft = _shaft_nodes(case, body)
    given = {**section.nodes, **_own_nodes(case)}
    supplies = {f"{name}.{SUPPLY}": one for name, one in own.items() if one.oil_flow > 0.0}
    absent = {f"{name}.{CAGE}" for name, has_cage in bearings.items() if not has_cage}
    for name in absent & {*given}:
        ledger.problem(f"bearings.{name.removesuffix(f'.{CAGE}')}.thermal.nodes.{CAGE}", NO_CAGE)
    names = [f"{name}.{node}" for name in bearings for node in BEARING_NODES if node != "shaft"]
    names = [name for name in names if name not in absent]
    names += [*shaft, *_SHARED, *supplies]
    names += [name for name in given if name not in names]
    links = {(link.between[0], link.between[1]): link.conductance for link in section.links.values()}
    held = {name: node.temperature for name, node in given.items() if node.temperature is not None}
    held |= {name: one.oil_supply or one.ambient for name, one in supplies.items()}
    pairs = [*_pairs(own, section, shaft), *(pair for pair, value in links.items() if value > 0.0)]
    start = section.start or section.ambient
    nodes = NodeSet(tuple(names), tuple(pairs), {**held, "ambient": section.ambient}, given, links, start)
    check_nodes(section.nodes, tuple(supplies), ledger)
    if check_links(section, nodes.names, ledger):
        lost = nodes.isolated()
        if any(f"{name}.inner_ring" in lost for name in bearings):
            ledger.problem("thermal.links", "a bearing has no heat path to a held temperature: add thermal.links")
        else:
            for name in [name for name in lost if name in section.nodes]:
                ledger.problem(f"thermal.nodes.{name}", "has no heat path to a held temperature: add thermal.links")
    heat = MachineHeat(section, own, shaft, nodes, *materials, is_alone=body.is_rigid)
    if case.operation.temperatures == "computed":
        for sentence in heat.assumptions:
            ledger.assume(sentence)
    return heat


def stretch(at: FloatArray, places: FloatArray, temperatures: FloatArray, material: BodyMaterial) -> FloatArray:
    """Return the thermal displacement of places [m].

    Places of a free shaft move along x as it grows, against x = 0.

    The integral of alpha (T - 20 degC) from 0 to x, T linear between places and constant beyond them.

    Parameters
    ----------
    at : float64[:]
        Places that are wanted [m].
    places, temperatures : float64[:]
        Where temperatures are known, rising [m], and these [K].
    material : BodyMaterial
        Of the shaft.
    """
    nodes = np.unique(np.concatenate([[0.0], at, places]))
    strain = material.thermal_expansion * (np.interp(nodes, places, temperatures) - REFERENCE_TEMPERATURE)
    grown = np.concatenate([[0.0], np.cumsum(0.5 * np.diff(nodes) * (strain[1:] + strain[:-1]))])
    found: FloatArray = np.interp(at, nodes, grown) - np.interp(0.0, nodes, grown)
    return found


def _assumptions(section: MachineThermal) -> list[str]:
    """Return the assumptions of a shaft's network.

    The shaft has its sections.
    """
    found = common_assumptions(section)
    if section.conductances != "none":
        if section.housing_area is None:
            found.append(
                "housing: the surface of a cast-iron pillow block of height 1.5 D and width D for each bearing, in one "
                "housing of one temperature: thermal.housing_area"
            )
        found.append(f"seats conduct {section.seat_conductance:g} W/(m2 K): thermal.seat_conductance")
    if section.conductances == "harris":
        if "emissivity" not in section.model_fields_set:
            found.append(f"the housing's surface has an emissivity of {section.emissivity:g}: thermal.emissivity")
        where = "the housing" if section.enclosed else "the surroundings"
        found.append(f"between its outermost bearings the shaft gives heat to {where}: thermal.enclosed")
        found.append("the whole surface of the shaft gives heat, also below seats and hubs")
    found.append("losses of gears, seals and couplings count where thermal.nodes gives them")
    return found


def _effective(section: MachineThermal, case: MachineCase, name: str) -> Thermal:
    own = case.bearings[name].thermal
    names = ("inlet", "seat_conductance", "oil_volume", "oil_flow", "oil_supply")
    return section.model_copy(update={key: value for key in names if (value := getattr(own, key)) is not None})


def _own_nodes(case: MachineCase) -> dict[str, ThermalNode]:
    return {
        f"{name}.{key}": node for name, bearing in case.bearings.items() for key, node in bearing.thermal.nodes.items()
    }


def _shaft_nodes(case: MachineCase, body: ElasticBody) -> tuple[str, ...]:
    """Return the names of the shaft's nodes.

    A node has the name of its bearing, gear, disc, marker or end; the others have numbers.
    """
    named = [(name, gear.place) for name, gear in case.gears.items()]
    named += [(name, disc.place) for name, disc in case.discs.items()]
    if not body.is_rigid:
        named += [(name, marker.x) for name, marker in case.markers.items() if marker.body == "shaft"]
    at = {body.node(bearing.place): f"{name}.shaft" for name, bearing in case.bearings.items()}
    taken = set(_SHARED)
    for name, place in [*named, (ENDS[0], body.positions[0]), (ENDS[1], body.positions[-1])]:
        node = body.node(float(place))
        if node not in at and name not in taken:
            at[node] = name
            taken.add(name)
    return tuple(at.get(i, f"{_NUMBERED}{i + 1}") for i in range(body.positions.size))


def is_numbered(node: str) -> bool:
    """Tell whether a shaft's node has no name."""
    return node.startswith(_NUMBERED)


def _pairs(bearings: Mapping[str, Thermal], section: MachineThermal, shaft: Sequence[str]) -> list[Pair]:
    """Return every pair of nodes that the machine itself joins."""
    found = list(pairwise(shaft))
    for name, own in bearings.items():
        joined = [*INSIDE, *OUTSIDE[own.conductances], *((("oil", SUPPLY),) if own.oil_flow > 0.0 else ())]
        for pair in joined:
            one, other = (node if node in _SHARED else f"{name}.{node}" for node in pair)
            found.append((one, other))
    if section.conductances == "harris":
        found += [(name, "ambient") for name in shaft]
    return found


def _check_computed(case: MachineCase, ledger: Ledger) -> None:
    """Refuse temperatures that are given and computed."""
    found = 'is computed with operation.temperatures = "computed"'
    for where, section in (("shaft", case.shaft), ("housing", case.housing)):
        for option in ("temperature", "temperatures"):
            if option in section.model_fields_set:
                ledger.problem(f"{where}.{option}", f"{found}: leave it out")
    for name, bearing in case.bearings.items():
        for part in _PARTS:
            if bearing.temperatures is not None and getattr(bearing.temperatures, part) is not None:
                hold = f"bearings.{name}.thermal.nodes.{part}" if part != "housing" else "thermal.nodes.housing"
                ledger.problem(f"bearings.{name}.temperatures.{part}", f"{found}; to hold it: {hold}.temperature")
