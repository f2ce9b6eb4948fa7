"""Check the thermal section: names, links and ways of heat."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass

from lambda_core.case.case import Case
from lambda_core.case.thermal import Thermal, ThermalNode
from lambda_core.domain.errors import unknown_name
from lambda_core.domain.units import show
from lambda_core.model.ledger import Ledger

# The bearing's own nodes, in the order in which every network has them.
OWN_NODES = ("inner_ring", "outer_ring", "balls", "oil", "cage", "shaft", "housing", "ambient")
CAGE = "cage"
NO_CAGE = "rollers of a full complement have no cage: leave it out"
SUPPLY = "oil_supply"  # where oil that flows through the bearing comes from
Pair = tuple[str, str]

INSIDE: tuple[Pair, ...] = (
    ("inner_ring", "balls"),
    ("outer_ring", "balls"),
    ("inner_ring", "oil"),
    ("outer_ring", "oil"),
    ("balls", "oil"),
    ("cage", "oil"),
)
_SEATS: tuple[Pair, ...] = (("inner_ring", "shaft"), ("outer_ring", "housing"))
# What each ready set joins beyond the bearing.
OUTSIDE: dict[str, tuple[Pair, ...]] = {
    "harris": (*_SEATS, ("oil", "housing"), ("housing", "ambient"), ("shaft", "ambient")),
    "palmgren": (*_SEATS, ("oil", "housing"), ("housing", "ambient")),
    "iso-15312": (("inner_ring", "ambient"), ("outer_ring", "ambient")),
    "none": (),
}
_PARTS = ("inner_ring", "outer_ring", "balls", "shaft", "housing")
# No weather is colder (-89 degC), and beyond a furnace no bearing stands: what lies outside is a slip of the unit.
_SURROUNDINGS = (173.15, 773.15)  # [K]


@dataclass(frozen=True)
class NodeSet:
    """Nodes of a network and their links.

    It has the options of the case.

    Attributes
    ----------
    names : tuple of str
        Of all nodes.
    pairs : tuple of Pair
        What a conductance joins.
    held : mapping of str to float
        Temperatures of the nodes that are held [K].
    given : mapping of str to ThermalNode
        Nodes of the case.
    links : mapping of Pair to float
        Conductances of the case; they take the place of computed ones [W/K].
    start : float
        Temperature at the start of a transient [K].
    """

    names: tuple[str, ...]
    pairs: tuple[Pair, ...]
    held: Mapping[str, float]
    given: Mapping[str, ThermalNode]
    links: Mapping[Pair, float]
    start: float

    def isolated(self) -> list[str]:
        """Return the nodes without a held temperature.

        They have no way to a held temperature; the order is that of the nodes.
        """
        return isolated(self.names, self.pairs, self.held)


def nodes_alone(thermal: Thermal, *, has_cage: bool) -> NodeSet:
    """Return the nodes of a bearing alone."""
    return NodeSet(
        names=node_names(thermal, has_cage=has_cage),
        pairs=joined(thermal),
        held=held_temperatures(thermal),
        given=thermal.nodes,
        links={(link.between[0], link.between[1]): link.conductance for link in thermal.links.values()},
        start=thermal.start or thermal.ambient,
    )


def node_names(thermal: Thermal, *, has_cage: bool) -> tuple[str, ...]:
    """Return the names of all nodes.

    The bearing's own, the oil supply where oil flows, the case's further ones.
    """
    parts = (name for name in OWN_NODES if has_cage or name != CAGE)
    own = (*parts, *([SUPPLY] if thermal.oil_flow > 0.0 else []))
    return (*own, *(name for name in thermal.nodes if name not in own))


def joined(thermal: Thermal) -> tuple[Pair, ...]:
    """Return every pair of nodes that a conductance joins."""
    flow = (("oil", SUPPLY),) if thermal.oil_flow > 0.0 else ()
    own = [(link.between[0], link.between[1]) for link in thermal.links.values() if link.conductance > 0.0]
    return (*INSIDE, *OUTSIDE[thermal.conductances], *flow, *own)


def held_temperatures(thermal: Thermal) -> dict[str, float]:
    """Return the temperatures of the nodes that are held [K]."""
    held = {name: node.temperature for name, node in thermal.nodes.items() if node.temperature is not None}
    supply = {SUPPLY: thermal.oil_supply or thermal.ambient} if thermal.oil_flow > 0.0 else {}
    return {**held, **supply, "ambient": thermal.ambient}


def isolated(names: Iterable[str], pairs: Iterable[Pair], held: Iterable[str]) -> list[str]:
    """Return the nodes without a held temperature.

    They have no way to a held temperature; the order is that of the nodes.
    """
    reached, links = set(held), list(pairs)
    while True:
        more = {b for a, b in links if a in reached} | {a for a, b in links if b in reached}
        if more <= reached:
            return [name for name in names if name not in reached]
        reached |= more


def check_thermal(case: Case, ledger: Ledger, *, has_cage: bool) -> None:
    """Note everything impossible in a thermal network.

    It is that of a case; a full complement has no cage.
    """
    thermal = case.thermal
    names = node_names(thermal, has_cage=has_cage)
    if not has_cage and CAGE in thermal.nodes:
        ledger.problem(f"thermal.nodes.{CAGE}", NO_CAGE)
    check_surroundings(thermal, ledger)
    check_nodes(thermal.nodes, (SUPPLY,), ledger)
    fine = check_links(thermal, names, ledger)
    if thermal.oil_supply is not None and thermal.oil_flow == 0.0:
        ledger.problem("thermal.oil_supply", "has no effect without thermal.oil_flow")
    if fine:
        lost = isolated(names, joined(thermal), held_temperatures(thermal))
        if "inner_ring" in lost:
            ledger.problem("thermal.links", "the bearing has no heat path to a held temperature: add thermal.links")
        for name in [name for name in lost if name in thermal.nodes and "inner_ring" not in lost]:
            ledger.problem(f"thermal.nodes.{name}", "has no heat path to a held temperature: add thermal.links")
    if case.operation.temperatures == "computed":
        _check_computed(case, ledger)


def network_assumptions(thermal: Thermal) -> list[str]:
    """Return the assumptions of a bearing's network.

    The bearing is alone; values that the case lacks are among them.
    """
    found = common_assumptions(thermal)
    if thermal.conductances in ("harris", "palmgren"):
        if thermal.housing_area is None:
            found.append("housing: a cast-iron pillow block of height 1.5 D and width D: thermal.housing_area")
        found.append(f"seats conduct {thermal.seat_conductance:g} W/(m2 K)")
    if thermal.conductances == "harris" and "emissivity" not in thermal.model_fields_set:
        found.append(f"the housing's surface has an emissivity of {thermal.emissivity:g}")
    if thermal.conductances == "iso-15312":
        found.append("shaft and housing take q_r A_r per 50 K, shared by the areas of the seats (ISO 15312)")
    return found


def common_assumptions(thermal: Thermal) -> list[str]:
    """Return the assumptions of every network.

    Values of surroundings and oil that the case lacks are among them.
    """
    given = thermal.model_fields_set
    found = [
        "heat of sheared films and of rolling goes into the two surfaces by their effusivities, of hysteresis by their "
        "compliance, of drag into the oil",
        "each part has one temperature; oil wets all its surfaces and is mixed",
        "contacts see the oil at the temperature of "
        + ("the oil node" if thermal.inlet == "oil" else "rings and balls (mean of both contacts)"),
    ]
    if "ambient" not in given:
        found.append(f"surroundings at {show(thermal.ambient, 'temperature', 6)}: thermal.ambient")
    if thermal.oil_flow > 0.0 and thermal.oil_supply is None:
        found.append(f"oil flows in at the surroundings' {show(thermal.ambient, 'temperature', 6)}: thermal.oil_supply")
    if "conductances" not in given:
        found.append(f"conductances to the surroundings from the set {thermal.conductances}: thermal.conductances")
    return found


def check_surroundings(thermal: Thermal, ledger: Ledger) -> None:
    """Refuse surroundings in which no bearing stands."""
    coldest, hottest = _SURROUNDINGS
    for name in ("ambient", "oil_supply"):
        temperature = getattr(thermal, name)
        if temperature is not None and not coldest <= temperature <= hottest:
            ledger.problem(
                f"thermal.{name}",
                f"{show(temperature, 'temperature', 6)} is outside {show(coldest, 'temperature', 6)} to "
                f"{show(hottest, 'temperature', 6)}: is another unit meant?",
            )


def check_nodes(nodes: Mapping[str, ThermalNode], supplies: Iterable[str], ledger: Ledger) -> None:
    """Note nodes that the case cannot change.

    Also note start temperatures of nodes that are held.
    """
    if "ambient" in nodes:
        ledger.problem("thermal.nodes.ambient", "is held at `thermal.ambient`: change that option")
    for supply in supplies:
        if supply in nodes:
            ledger.problem(f"thermal.nodes.{supply}", "is held at `thermal.oil_supply`: change that option")
    for name, node in nodes.items():
        if node.temperature is not None and node.start is not None:
            ledger.problem(f"thermal.nodes.{name}.start", "has no effect on a node that is held at a temperature")


def check_links(thermal: Thermal, names: tuple[str, ...], ledger: Ledger) -> bool:
    fine, seen = True, dict[frozenset[str], str]()
    for key, link in thermal.links.items():
        path = f"thermal.links.{key}.between"
        for name in link.between:
            if name not in names:
                ledger.problem(path, unknown_name("node", name, names))
                fine = False
        pair = frozenset(link.between)
        if pair in seen:
            ledger.problem(path, f"joins the same nodes as thermal.links.{seen[pair]}")
        seen[pair] = key
    return fine


def _check_computed(case: Case, ledger: Ledger) -> None:
    """Refuse temperatures that are given and computed.

    Report what computing them assumes.
    """
    for sentence in network_assumptions(case.thermal):
        ledger.assume(sentence)
    given = case.bearing.temperatures
    for part in _PARTS:
        if given is not None and getattr(given, part) is not None:
            ledger.problem(
                f"bearing.temperatures.{part}",
                f'is computed with operation.temperatures = "computed"; to hold it: thermal.nodes.{part}.temperature',
            )
