"""The model tree of a shaft in several bearings, made from the declarations of its case."""

from __future__ import annotations

from typing import TYPE_CHECKING, get_origin

from lambda_core.api import InlineMaterial, ShaftCase
from lambda_core.domain.option_tree import members, model_at
from lambda_core.domain.roles import MOTION_ROLES, ROLES
from lambda_gui.nodes import Group, Keys, Named, Names, Node, about, form_node, is_freedom, plain_fields, table_model
from lambda_gui.outline import SHORT, electric_node, force_elements, named_node

if TYPE_CHECKING:
    from pydantic import BaseModel

    from lambda_core.api import Draft

SECTIONS = "shaft.sections"
_PIECES = Named("Shaft", "pieces of one diameter each, from the left end at x = 0", "piece", {})
_NAMED = {
    "bearings": Named("Bearings", "which bearings, where, and how they sit", "bearing", {},
                      usual=("left", "right", "middle", "fourth", "fifth", "sixth")),
    "gears": Named("Gears", "forces from what a mesh transmits", "gear", {}, usual=("gear", "pinion")),
    "discs": Named("Discs", "wheels and rotors: mass, inertia, unbalance", "disc", {}, usual=("wheel", "rotor")),
    "bodies": Named("Bodies", "housings that give way: mass, inertia, what holds them", "body", {},
                    usual=("housing", "cover")),
    "markers": Named("Markers", "named places on shaft, bodies and ground", "marker", {}, usual=("foot", "seat")),
    "connections": Named("Connections", "springs, dampers, bushings between shaft, bodies and ground", "connection", {},
                         usual=("spring", "damper", "mount")),
    "loads": Named("Loads", "forces and moments at a place, over time", "load", {}, usual=("belt", "load")),
}  # fmt: skip
_TITLES = {
    "operation": "Drive", "materials": "Materials", "surface": "Surfaces", "life": "Rating life",
    "requirements": "Requirements",
    "thermal": "Thermal network",
}  # fmt: skip
# What comes first on the form of a table: what each of them needs
_FIRST: dict[str, tuple[str, ...]] = {
    "bearings": ("designation", "at", "outer", "takes", "preload", "preload_force"),
    "markers": ("body", "x", "y", "z"),
    "bodies": ("x", "y", "z", "mass", "polar_inertia", "transverse_inertia"),
    "connections": ("at", "to"),
}
_BELOW: dict[Keys, dict[str, str]] = {
    ("lubricant",): {"properties": "Own properties"},
    ("bearings",): {
        "geometry": "Inner geometry",
        "fits": "Fits",
        "temperatures": "Temperatures",
        "lubricant": "Its oil",
        "lubricant.properties": "Properties of its oil",
        "elastic.outer_ring": "Elastic outer ring",
        "elastic.inner_ring": "Elastic inner ring",
        "elastic.cage": "Elastic cage",
    },
}
_ORDER = (
    "shaft",
    "bearings",
    "gears",
    "discs",
    "loads",
    "bodies",
    "markers",
    "connections",
    "operation",
    "housing",
    "lubricant",
)


def shaft_outline(names: Names | None = None) -> list[Node]:
    """Return the top nodes of the tree of a shaft's case with these names in its named sections."""
    names = names or {}
    nodes = [Node("case", "Case", "name, description, what its author assumed", [_group(())])]
    sections = [name for name in ShaftCase.model_fields if model_at(ShaftCase, (name,)) and name != "parameters"]
    for section in sorted(sections, key=lambda name: _ORDER.index(name) if name in _ORDER else len(_ORDER)):
        info = ShaftCase.model_fields[section]
        if section == "shaft":
            nodes.append(_shaft(names))
        elif section == "models":
            nodes.append(_laws())
        elif section == "electric":
            node = electric_node(ShaftCase)
            node.help += "; what single bearings have of their own is written in the file"
            node.in_file = [("electric", "bearings")]
            nodes.append(node)
        elif get_origin(info.annotation) is dict:
            nodes.append(_named(section, names.get(section, ())))
        else:
            node = Node(section, _title(section), about(ShaftCase, (section,)), [_group((section,))])
            node.children = _below((section,), section)
            if section == "thermal":
                node.help += "; nodes and links are written in the file"
                node.in_file = [("thermal", "nodes"), ("thermal", "links")]
            if section == "output":
                node.children += [named_node("observers", names), named_node("events", names)]
            nodes.append(node)
    return nodes


def shaft_names(draft: Draft) -> dict[str, tuple[str, ...]]:
    """Return what stands in the sections of named tables of a shaft's case, and the numbers of its pieces."""
    found: dict[str, tuple[str, ...]] = {}
    for section, info in ShaftCase.model_fields.items():
        tables = draft.get(section)
        if get_origin(info.annotation) is dict and isinstance(tables, dict):
            found[section] = tuple(name for name, table in tables.items() if isinstance(table, dict))
    pieces = draft.get(*SECTIONS.split("."))
    found[SECTIONS] = tuple(map(str, range(len(pieces)))) if isinstance(pieces, list) else ()
    return found


def _shaft(names: Names) -> Node:
    table = tuple(SECTIONS.split("."))
    pieces = [
        Node(f"{SECTIONS}.{number}", f"piece {int(number) + 1}", about(ShaftCase, (*table, number)),
             [_group((*table, number))], kind="item", section=_PIECES, table=(*table, number))
        for number in names.get(SECTIONS, ())
    ]  # fmt: skip
    words = about(ShaftCase, ("shaft",))
    node = Node("shaft", "Shaft", words, [_group(("shaft",))], pieces, kind="named", section=_PIECES, table=table)
    node.in_file = [("shaft", "temperatures")]
    return node


def _named(section: str, names: tuple[str, ...]) -> Node:
    words = str(ShaftCase.model_fields[section].description)
    what = _NAMED.get(section) or Named(_title(section), words, section.rstrip("s").replace("_", " "), {})
    nodes, below = [], {inner.split(".")[0] for inner in _BELOW.get((section,), {})}
    for name in names:
        table = (section, name)
        node = Node(f"{section}.{name}", name, about(ShaftCase, table), [_group(table)], kind="item", section=what,
                    table=table, heading=f"{what.one} {name}")  # fmt: skip
        node.groups += [
            Group(_title(inner), (*table, inner), tuple(_options((*table, inner))))
            for inner in _tables(table) if inner not in below and inner != "forces"
        ]  # fmt: skip
        node.children = _below(table, node.key, heading=f"{name} · ")
        if section == "bearings":
            node.children.append(_own_laws(table))
            node.in_file = [(*table, "thermal", "nodes"), (*table, "thermal", "links")]
        nodes.append(node)
    return Node(section, what.title, what.about, children=nodes, kind="named", section=what, table=(section,))


def _below(table: Keys, key: str, heading: str = "") -> list[Node]:
    """Return the nodes of the tables in a table that have forms of their own."""
    nodes = []
    for inner, title in _BELOW.get(table[:1], {}).items():
        node = form_node(ShaftCase, f"{key}.{inner}", title, (*table, *inner.split(".")))
        node.heading = f"{heading}{title[:1].lower() + title[1:]}" if heading else title
        nodes.append(node)
    return nodes


def _own_laws(bearing: Keys) -> Node:
    words = "models of this bearing alone, by contact, before those of every bearing: a defect in one of its raceways"
    key = ".".join((*bearing, "forces"))
    return Node(key, "Laws of its own", words, children=force_elements(bearing))


def _laws() -> Node:
    roles = [
        Node(f"models.{role}", role.replace("_", " "), ROLES[role].summary, kind="role", role=role,
             heading=f"Contacts · {role.replace('_', ' ')}", short=SHORT.get(role, ""))
        for role in MOTION_ROLES
    ]  # fmt: skip
    words = "the model that fills each role, in every bearing"
    return Node("models", "Laws of contacts", words, kind="roles", children=roles)


def _group(table: Keys) -> Group:
    """Return the options of a table, what it needs first."""
    names = _options(table)
    first = [name for name in _FIRST.get(table[0], ()) if name in names] if len(table) > 1 else []
    return Group("", table, (*first, *(name for name in names if name not in first)))


def _options(table: Keys) -> list[str]:
    """Return the options of a table; a material or a degree of freedom is one."""
    plain = plain_fields(ShaftCase, table)
    fields = table_model(ShaftCase, table).model_fields
    return [
        name for name, info in fields.items()
        if (name in plain or any(_is_one(inner) for inner in members(info.annotation)))
        and (*table, name) != ("parameters",)
    ]  # fmt: skip


def _is_one(table: type[BaseModel]) -> bool:
    return table is InlineMaterial or is_freedom(table)


def _tables(table: Keys) -> list[str]:
    """Return the tables in a table that are no options."""
    options = _options(table)
    return [name for name in table_model(ShaftCase, table).model_fields if name not in options]


def _title(section: str) -> str:
    return _TITLES.get(section, section.replace("_", " ").capitalize())
