"""Build the model tree and its options.

The order is that in which a multibody model is set up. Every declared option has one place. A new option appears on the
node of its section, and a new section gets a node, without a change here.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, get_origin

from lambda_core.api import SHARED_GEOMETRY, InlineMaterial
from lambda_core.domain.elements import DOFS
from lambda_core.domain.option_tree import members, model_at
from lambda_core.domain.roles import MOTION_ROLES, ROLES
from lambda_gui.nodes import PROFILE, Group, Keys, Named, Names, Node, about, is_freedom, plain_fields, table_model

if TYPE_CHECKING:
    from pydantic import BaseModel

    from lambda_core.api import Draft

SECTIONS = "shaft.sections"
BODIES = {"inner_ring": "Inner ring", "outer_ring": "Outer ring", "cage": "Cage"}
ELEMENTS = {
    "ball_inner": "Inner raceway",
    "ball_outer": "Outer raceway",
    "rib_inner": "Inner ribs",
    "rib_outer": "Outer ribs",
    "ball_cage": "Cage pockets",
    "ball_ball": "Neighbours",
    "cage_inner": "Inner land",
    "cage_outer": "Outer land",
    "fluid_drag": "Oil drag",
}
LIKE = {"rib_inner": "ball_inner", "rib_outer": "ball_outer"}  # ribs have the roles of raceways
# Titles of roles where the tree is narrow: one word before the name of the law
SHORT = {
    "normal_contact": "contact",
    "film_thickness": "film",
    "thermal_correction": "thermal",
    "contact_temperature": "temperature",
    "rolling_resistance": "rolling",
    "elastic_hysteresis": "hysteresis",
    "asperity_load": "asperities",
    "boundary_friction": "boundary",
    "mixing": "mixing",
    "supply": "supply",
    "cage_contact": "cage",
    "fluid_drag": "drag",
}
_PIECES = Named("Shaft", "pieces of one diameter each, from the left end at x = 0", "piece", {})
NAMED = {
    "bearings": Named("Bearings", "type, position and seat of each bearing", "bearing", {},
                      usual=("left", "right", "middle", "fourth", "fifth", "sixth")),
    "gears": Named("Gears", "forces from the power that a mesh transmits", "gear", {}, usual=("gear", "pinion")),
    "discs": Named("Discs", "wheels and rotors: mass, inertia, unbalance", "disc", {}, usual=("wheel", "rotor")),
    "bodies": Named("Bodies", "mounted housings: mass, inertia, support", "body", {}, usual=("housing", "cover")),
    "markers": Named("Markers", "named points on bodies; the result has their motion", "marker", {},
                     usual=("foot", "seat")),
    "connections": Named("Connections", "springs, dampers, bushings between shaft, bodies and ground", "connection", {},
                         usual=("spring", "damper", "mount")),
    "loads": Named("Loads", "forces and moments at a place, over time", "load", {}, usual=("belt", "load")),
    "elements": Named("Between bodies", "springs, dampers, pulls between two bodies, or a body and the ground, by laws",
                      "element", {"law": "bushing", "second": "inner_ring"}),
    "observers": Named("Observers", "channels of plugins in the result", "observer", {}, "observer"),
    "events": Named("Events", "conditions of plugins that end a run, or are recorded", "event", {}, "event"),
}  # fmt: skip
_TITLES = {
    "operation": "Drive",
    "surface": "Surfaces",
    "life": "Rating life",
    "thermal": "Thermal network",
    "depth": "Modelling depth",
    "output": "Outputs",
    "electric": "Electric circuit",
}
# Options that come first on the form of a table
_FIRST: dict[str, tuple[str, ...]] = {
    "bearings": ("designation", "at", "outer", "takes", "preload", "preload_force"),
    "markers": ("body", "x", "y", "z"),
    "bodies": ("x", "y", "z", "mass", "polar_inertia", "transverse_inertia"),
    "connections": ("at", "to"),
}
# Tables of a bearing that have a form of their own
_OF_A_BEARING = {
    "geometry": "Inner geometry",
    "rollers": "Rollers",
    "fits": "Fits",
    "temperatures": "Temperatures",
    "lubricant": "Its oil",
    "lubricant.properties": "Properties of its oil",
    "elastic.outer_ring": "Elastic outer ring",
    "elastic.inner_ring": "Elastic inner ring",
    "elastic.cage": "Elastic cage",
}
_OF_THE_CIRCUIT = {
    "inverter": "Inverter",
    "sine": "Sine",
    "step": "Step",
    "series": "Measured series",
    "machine": "Machine",
    "grounding": "Grounding",
    "film": "Films",
    "cage": "Cage",
}
_IN_FILE = {"electric": ("bearings",), "thermal": ("nodes", "links")}  # tables that have no form


def outline(root: type[BaseModel], names: Names | None = None) -> list[Node]:
    """Return the top nodes of the tree of a case.

    Parameters
    ----------
    root : type of BaseModel
        The class of the case.
    names : mapping
        What the case has in its sections of named tables, and the numbers of the pieces of its shaft.
    """
    return _Outline(root, names or {}).nodes()


def section_names(draft: Draft) -> dict[str, tuple[str, ...]]:
    """Return the names of a draft's tables.

    They are those in sections of named tables, and the numbers of the pieces of its shaft.
    """
    found: dict[str, tuple[str, ...]] = {}
    for section, info in draft.root.model_fields.items():
        tables = draft.get(section)
        if section != "parameters" and get_origin(info.annotation) is dict and isinstance(tables, dict):
            found[section] = tuple(name for name, table in tables.items() if isinstance(table, dict))
    pieces = draft.get(*SECTIONS.split("."))
    if isinstance(pieces, list):
        found[SECTIONS] = tuple(map(str, range(len(pieces))))
    return found


@dataclass(frozen=True)
class _Outline:
    """Tree of one class of cases.

    These names are in it.
    """

    root: type[BaseModel]
    names: Names

    def nodes(self) -> list[Node]:
        """Return the top nodes and other sections.

        One node for each section that none of the top nodes has.
        """
        told = (
            self._case(), self._shaft(), self._bearing(), self._of("gears"), self._of("discs"), self._bodies(),
            self._of("markers"), self._of("connections"), self._forces(), self._motion(), self._of("housing"),
            self._lubricant(), self._of("requirements"), self._of("life"), self._of("depth"), self._of("solver"),
            self._output(), self._circuit(),
        )  # fmt: skip
        found = [node for node in told if node is not None]
        known = {place[0] for top in found for node in top.walk() for place in node.places}
        others = (self._of(section) for section in self.root.model_fields if section not in (*known, "parameters"))
        return [*found, *(node for node in others if node is not None)]

    # -- sections --

    def has(self, section: str) -> bool:
        """Tell whether the case has a section."""
        return section in self.root.model_fields

    def is_named(self, section: str) -> bool:
        """Tell whether a section has named tables.

        The names are their own.
        """
        return self.has(section) and get_origin(self.root.model_fields[section].annotation) is dict

    def _of(self, section: str, key: str = "") -> Node | None:
        """Return the node of a section.

        None where the case has none.
        """
        if not self.has(section):
            return None
        if self.is_named(section):
            return self._named(section)
        return self._form(key or section, _title(section), (section,))

    def _form(self, key: str, title: str, table: Keys, heading: str = "") -> Node:
        """Return the node of a table with all its options."""
        group = self._group(table)
        node = Node(key, title, about(self.root, table), [group], heading=heading)
        if table[-1] == "rollers":  # the row of the profile has a row for each of its options
            node.groups = [replace(group, names=tuple(name for name in group.names if name not in PROFILE))]
            node.in_file = [(*table, name) for name in PROFILE]
        if table[-1] == "geometry":  # rollers have a table of their own for the rest
            apart = tuple(name for name in group.names if name not in SHARED_GEOMETRY)
            node.groups = [Group("", table, SHARED_GEOMETRY), Group("Balls", table, apart)]
        inner = [name for name in _IN_FILE.get(table[-1], ()) if name in table_model(self.root, table).model_fields]
        if inner:
            node.in_file = [(*table, name) for name in inner]
            node.help += f"; {' and '.join(inner)} are written in the file"
        return node

    def _case(self) -> Node:
        fields = tuple(name for name in plain_fields(self.root, ()) if name != "parameters" and not self.is_named(name))
        node = Node("case", "Case", "name, description, assumptions of its author", [Group("", (), fields)])
        if self.has("fit"):  # the command fit writes it
            node.in_file = [("fit", name) for name in table_model(self.root, ("fit",)).model_fields]
        return node

    def _shaft(self) -> Node | None:
        if not self.has("shaft"):
            return None
        table = tuple(SECTIONS.split("."))
        pieces = [
            Node(f"{SECTIONS}.{number}", f"piece {int(number) + 1}", about(self.root, (*table, number)),
                 [self._group((*table, number))], kind="item", section=_PIECES, table=(*table, number))
            for number in self.names.get(SECTIONS, ())
        ]  # fmt: skip
        node = Node("shaft", "Shaft", about(self.root, ("shaft",)), [self._group(("shaft",))], pieces, kind="named",
                    section=_PIECES, table=table)  # fmt: skip
        node.in_file = [("shaft", "temperatures")]
        node.groups += self._inner_groups(("shaft",), {"sections", "temperatures"})
        return node

    def _bearing(self) -> Node | None:
        if not self.has("bearing"):
            return self._of("bearings")
        node = self._form("bearing", "Bearing", ("bearing",))
        node.children = self._below(("bearing",))
        return node

    def _bodies(self) -> Node | None:
        """Return the bodies.

        They are those that the case names, or rings, cage and rolling elements of its bearing.
        """
        if self.is_named("bodies"):
            return self._named("bodies")
        parts = {"inner_ring": "inner", "outer_ring": "outer", "cage": "cage"}
        nodes = []
        for body, title in BODIES.items():
            own = [name for name in plain_fields(self.root, ("bodies", body)) if name not in DOFS]
            groups = [Group("", ("bodies", body), tuple(own)), Group("Material", ("materials",), (parts[body],))]
            node = Node(f"bodies.{body}", title, about(self.root, ("bodies", body)), groups)
            node.children = [self._form(f"elastic.{body}", "Elastic", ("elastic", body))]
            nodes.append(node)
        elements = [Group("", ("materials",), ("balls",))]
        words = "material of balls or rollers; the bearing has number and size"
        nodes.insert(2, Node("bodies.balls", "Rolling elements", words, elements))
        words = "rings, rolling elements and cage: masses, materials, type of the cage"
        return Node("bodies", "Bodies", words, children=nodes)

    def _forces(self) -> Node:
        """Return the laws of contacts.

        They include those of single ones where the case has one bearing.
        """
        every = Node("models", "All elements", "one law for every force element that has the role", kind="roles",
                     children=[self._role("", role) for role in MOTION_ROLES])  # fmt: skip
        nodes = [every, *(self._elements() if self.has("forces") else ())]
        nodes += [self._named("elements")] if self.has("elements") else []
        if len(nodes) == 1:
            every.title = every.heading = every.short = "Laws of contacts"
            return every
        return Node("forces", "Force elements", "every contact and the model that fills each role", children=nodes)

    def _motion(self) -> Node:
        told = [self._of("operation"), self._loads(), *self._boundaries(), self._of("gravity")]
        nodes = [node for node in told if node is not None]
        return Node("motion", "Loads and motion", "drive, loads and supports", children=nodes)

    def _loads(self) -> Node | None:
        if self.is_named("loads"):
            return self._named("loads")
        own = [name for name in plain_fields(self.root, ("loads",)) if name not in BODIES]
        return Node("loads", "Loads", "external loads on the inner ring over time", [Group("", ("loads",), tuple(own))])

    def _boundaries(self) -> Iterator[Node]:
        for body, title in {} if self.is_named("bodies") else BODIES.items():
            freedoms = Group("", ("bodies", body), tuple(DOFS))
            more = Group("Further loads", ("loads", body), tuple(plain_fields(self.root, ("loads", body))))
            text = f"boundary conditions of the {title.lower()}: free, locked, or moved; further loads on it"
            yield Node(f"boundary.{body}", title, text, [freedoms, more], heading=f"{title} · boundary conditions")

    def _lubricant(self) -> Node:
        node = self._form("lubricant", "Lubricant", ("lubricant",))
        own = self._form("lubricant.properties", "Own properties", ("lubricant", "properties"))
        told = [own, self._of("surface"), self._of("thermal")]
        node.children = [inner for inner in told if inner is not None]
        return node

    def _output(self) -> Node:
        node = self._form("output", "Outputs", ("output",))
        node.children = [self._named("observers"), self._named("events")]
        return node

    def _circuit(self) -> Node:
        node = self._form("electric", "Electric circuit", ("electric",))
        node.children = [
            self._form(f"electric.{name}", title, ("electric", name)) for name, title in _OF_THE_CIRCUIT.items()
        ]
        node.children += [self._film_law("breakdown", "Breakdown"), self._film_law("discharge", "Arcs")]
        return node

    def _film_law(self, role: str, title: str) -> Node:
        """Return the node of a film law.

        It is a law in a section of its own with further options.
        """
        table = ("electric", role)
        names = tuple(name for name in plain_fields(self.root, table) if name not in ("law", "parameters"))
        return Node(f"electric.{role}", title, ROLES[role].summary, [Group("", table, names)] if names else [],
                    kind="role", role=role, heading=f"Electric circuit · {title.lower()}")  # fmt: skip

    # -- named tables --

    def _named(self, section: str) -> Node:
        """Return the node of named tables.

        It has one below it for each name.
        """
        words = str(self.root.model_fields[section].description)
        what = NAMED.get(section) or Named(_title(section), words, section.rstrip("s").replace("_", " "), {})
        if section == "markers" and not self.is_named("bodies"):
            what = replace(what, begins={"body": "inner_ring"}, usual=())
        nodes = [self._item((section, name), what) for name in self.names.get(section, ())]
        return Node(section, what.title, what.about, children=nodes, kind="named", section=what, table=(section,))

    def _item(self, table: Keys, what: Named) -> Node:
        section, name = table
        node = Node(".".join(table), name, what.about, kind="item", section=what, table=table)
        if what.installed:
            return node
        node.heading = f"{what.one} {name}"
        if section == "elements":
            node.groups, node.role, node.element = [Group("", table, ("first", "second"))], "force_element", name
            return node
        node.help = about(self.root, table)
        is_bearing = section == "bearings"
        below = {inner.split(".")[0] for inner in _OF_A_BEARING} | {"forces"} if is_bearing else set()
        node.groups = [self._group(table), *self._inner_groups(table, below)]
        if is_bearing:
            words = "laws of this bearing alone, by contact, before the general ones: a defect in one of its raceways"
            node.children = self._below(table, heading=f"{name} · ")
            node.children.append(
                Node(".".join((*table, "forces")), "Laws of its own", words, children=self._elements(table))
            )
            node.in_file = [(*table, "thermal", "nodes"), (*table, "thermal", "links")]
        return node

    def _below(self, bearing: Keys, heading: str = "") -> list[Node]:
        """Return the nodes of a bearing's tables.

        They have forms of their own.
        """
        nodes = []
        for inner, title in _OF_A_BEARING.items():
            table = (*bearing, *inner.split("."))
            if model_at(self.root, table) is not None:
                words = f"{heading}{title[:1].lower() + title[1:]}" if heading else title
                nodes.append(self._form(".".join(table), title, table, words))
        return nodes

    # -- laws --

    def _elements(self, bearing: Keys = ()) -> list[Node]:
        """Return a node per force element.

        Its roles are below it.

        `bearing` is where the bearing is written, () where the case has one.
        """
        nodes = []
        for element, title in ELEMENTS.items():
            words = (
                f"{about(self.root, (*bearing, 'forces', element), own=False)}: its own laws before the general ones"
            )
            like = LIKE.get(element, element)
            roles = [self._role(element, role.name, bearing) for role in MOTION_ROLES.values() if like in role.elements]
            key = ".".join((*bearing, "forces", element))
            nodes.append(Node(key, title, words, kind="roles", element=element, children=roles))
        return nodes

    def _role(self, element: str, role: str, bearing: Keys = ()) -> Node:
        key = ".".join((*bearing, "forces", element, role)) if element else f"models.{role}"
        title = role.replace("_", " ")
        heading = " · ".join((*bearing[1:], ELEMENTS.get(element, "All elements"), title))
        return Node(key, title, ROLES[role].summary, kind="role", role=role, element=element, heading=heading,
                    short=SHORT.get(role, ""), table=bearing)  # fmt: skip

    # -- options --

    def _group(self, table: Keys) -> Group:
        """Return the options of a table, the usual ones first."""
        names = self._options(table)
        first = [name for name in _FIRST.get(table[0], ()) if name in names] if len(table) > 1 else []
        return Group("", table, (*first, *(name for name in names if name not in first)))

    def _inner_groups(self, table: Keys, without: set[str]) -> list[Group]:
        """Return a group for each inner table.

        Some tables have none.
        """
        inner = [name for name in self._tables(table) if name not in without]
        return [Group(_title(name), (*table, name), tuple(self._options((*table, name)))) for name in inner]

    def _options(self, table: Keys) -> list[str]:
        """Return the options of a table.

        A material or a degree of freedom is one.
        """
        plain = plain_fields(self.root, table)
        fields = table_model(self.root, table).model_fields
        return [
            name
            for name, info in fields.items()
            if name in plain or any(_is_one(inner) for inner in members(info.annotation))
        ]

    def _tables(self, table: Keys) -> list[str]:
        """Return the tables in a table that are no options."""
        options = self._options(table)
        return [name for name in table_model(self.root, table).model_fields if name not in options]


def _is_one(table: type[BaseModel]) -> bool:
    return table is InlineMaterial or is_freedom(table)


def _title(section: str) -> str:
    return _TITLES.get(section, section.replace("_", " ").capitalize())
