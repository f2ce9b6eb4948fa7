"""The model tree of one bearing: which nodes there are, and which options of the case stand on which node.

The order is that in which a multibody model is set up. Every declared option has one place;
a new option of a section appears on that section's node by itself.
"""

from __future__ import annotations

from pydantic import BaseModel

from lambda_core.api import Case
from lambda_core.domain.elements import DOFS
from lambda_core.domain.roles import MOTION_ROLES, ROLES
from lambda_gui.nodes import Group, Keys, Named, Names, Node, about, form_node, plain_fields, table_model

BODIES = {"inner_ring": "Inner ring", "outer_ring": "Outer ring", "cage": "Cage"}
ELEMENTS = {
    "ball_inner": "Ball - inner",
    "ball_outer": "Ball - outer",
    "ball_cage": "Ball - cage",
    "ball_ball": "Ball - ball",
    "cage_inner": "Cage - inner",
    "cage_outer": "Cage - outer",
    "fluid_drag": "Oil on the balls",
}

# Titles of roles where the tree is narrow: one word beside the name of the law
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


NAMED = {
    "markers": Named("Markers", "named points whose motion is written", "marker", {"body": "inner_ring"}),
    "elements": Named(
        "Between bodies", "springs, dampers, pulls between two bodies, or a body and the ground, by laws", "element",
        {"law": "bushing", "second": "inner_ring"},
    ),
    "observers": Named("Observers", "channels of plugins in the result", "observer", {}, "observer"),
    "events": Named("Events", "what ends a run, or is recorded, found by plugins", "event", {}, "event"),
}  # fmt: skip


def outline(names: Names | None = None) -> list[Node]:
    """Return the top nodes of the tree of a case with these names in its named sections."""
    names = names or {}
    return [
        Node(
            "case",
            "Case",
            "name, description, what its author assumed",
            [Group("", (), tuple(_case_fields()))],
            in_file=[("fit", name) for name in table_model(Case, ("fit",)).model_fields],  # the command fit writes it
        ),
        _bearing(),
        _bodies(),
        named_node("markers", names),
        _forces(names),
        _loads(),
        _lubricant(),
        _form("requirements", "Requirements", ("requirements",)),
        _form("life", "Rating life", ("life",)),
        _form("depth", "Modelling depth", ("depth",)),
        _form("solver", "Solver", ("solver",)),
        _output(names),
        electric_node(Case),
    ]


def _output(names: Names) -> Node:
    node = _form("output", "Outputs", ("output",))
    node.children = [named_node("observers", names), named_node("events", names)]
    return node


def _bearing() -> Node:
    node = _form("bearing", "Bearing", ("bearing",))
    node.children = [
        _form("bearing.geometry", "Inner geometry", ("bearing", "geometry")),
        _form("bearing.fits", "Fits", ("bearing", "fits")),
    ]
    return node


def _bodies() -> Node:
    parts = {"inner_ring": "inner", "outer_ring": "outer", "cage": "cage"}
    nodes = []
    for body, title in BODIES.items():
        own = [name for name in plain_fields(Case, ("bodies", body)) if name not in DOFS]
        groups = [Group("", ("bodies", body), tuple(own)), Group("Material", ("materials",), (parts[body],))]
        node = Node(f"bodies.{body}", title, about(Case, ("bodies", body)), groups)
        node.children = [_form(f"elastic.{body}", "Elastic", ("elastic", body))]
        nodes.append(node)
    balls = Node("bodies.balls", "Balls", "number and size are the bearing's", [Group("", ("materials",), ("balls",))])
    nodes.insert(2, balls)
    return Node("bodies", "Bodies", "rings, balls and cage: masses, materials, the cage's type", children=nodes)


def named_node(section: str, names: Names) -> Node:
    """Return the node of a section of named tables, one below it for each name."""
    what = NAMED[section]
    nodes = []
    for name in names.get(section, ()):
        node = Node(f"{section}.{name}", name, what.about, kind="item", section=what, table=(section, name))
        if section == "markers":
            node.groups = [Group("", (section, name), tuple(plain_fields(Case, (section, name))))]
        elif section == "elements":
            node.groups = [Group("", (section, name), ("first", "second"))]
            node.role, node.element = "force_element", name
        nodes.append(node)
    return Node(section, what.title, what.about, children=nodes, kind="named", section=what, table=(section,))


def _forces(names: Names) -> Node:
    every = Node(
        "models",
        "All elements",
        "one choice for every force element that has the role",
        kind="roles",
        children=[_role("", role) for role in MOTION_ROLES],
    )
    nodes = [every, *force_elements(), named_node("elements", names)]
    return Node("forces", "Force elements", "every contact and the model that fills each role", children=nodes)


def force_elements(bearing: Keys = ()) -> list[Node]:
    """Return a node for every force element with its roles below, of the case's bearing or of one among several.

    Parameters
    ----------
    bearing : tuple of str
        Where one among several is written.
    """
    nodes = []
    for element, title in ELEMENTS.items():
        words = f"{about(Case, ('forces', element), own=False)}: models of its own before the general ones"
        roles = [_role(element, role.name, bearing) for role in MOTION_ROLES.values() if element in role.elements]
        key = ".".join((*bearing, "forces", element))
        nodes.append(Node(key, title, words, kind="roles", element=element, children=roles))
    return nodes


def _role(element: str, role: str, bearing: Keys = ()) -> Node:
    key = ".".join((*bearing, "forces", element, role)) if element else f"models.{role}"
    title, told = role.replace("_", " "), ROLES[role].summary
    heading = " · ".join((*bearing[1:], ELEMENTS.get(element, "All elements"), title))
    return Node(
        key, title, told, kind="role", role=role, element=element, heading=heading, short=SHORT.get(role, ""),
        table=bearing,
    )  # fmt: skip


def _loads() -> Node:
    own = [name for name in plain_fields(Case, ("loads",)) if name not in BODIES]
    nodes = [
        Node("operation", "Drive", about(Case, ("operation",)), [_group(("operation",))]),
        Node("loads", "Loads", "external loads on the inner ring over time", [Group("", ("loads",), tuple(own))]),
    ]
    for body, title in BODIES.items():
        freedoms = Group("", ("bodies", body), tuple(name for name in DOFS))
        more = Group("Further loads", ("loads", body), tuple(plain_fields(Case, ("loads", body))))
        text = f"boundary conditions of the {title.lower()}: free, locked, or moved; further loads on it"
        nodes.append(Node(f"boundary.{body}", title, text, [freedoms, more], heading=f"{title} · boundary conditions"))
    nodes.append(Node("gravity", "Gravity", about(Case, ("gravity",)), [_group(("gravity",))]))
    return Node("motion", "Loads and motion", "what drives, loads and holds the bodies", children=nodes)


def _lubricant() -> Node:
    node = _form("lubricant", "Lubricant", ("lubricant",))
    node.children = [
        _form("lubricant.properties", "Own properties", ("lubricant", "properties")),
        _form("surface", "Surfaces", ("surface",)),
        _form("bearing.temperatures", "Temperatures", ("bearing", "temperatures")),
        _thermal(),
    ]
    return node


def _thermal() -> Node:
    node = _form("thermal", "Thermal network", ("thermal",))
    node.help += "; nodes and links are written in the file"
    node.in_file = [("thermal", "nodes"), ("thermal", "links")]
    return node


def electric_node(root: type[BaseModel]) -> Node:
    """Return the node of the circuit of one bearing or of a machine."""
    node = form_node(root, "electric", "Electric circuit", ("electric",))
    tables = {
        "inverter": "Inverter",
        "sine": "Sine",
        "step": "Step",
        "series": "Measured series",
        "machine": "Machine",
        "grounding": "Grounding",
        "film": "Films",
        "cage": "Cage",
    }
    node.children = [form_node(root, f"electric.{name}", title, ("electric", name)) for name, title in tables.items()]
    laws = (("breakdown", "Breakdown"), ("discharge", "Arcs"))
    node.children += [_film_law(root, role, title) for role, title in laws]
    return node


def _film_law(root: type[BaseModel], role: str, title: str) -> Node:
    """Return the node of a law in a section of its own that has further options."""
    table = ("electric", role)
    names = tuple(name for name in plain_fields(root, table) if name not in ("law", "parameters"))
    return Node(
        f"electric.{role}", title, ROLES[role].summary, [Group("", table, names)] if names else [],
        kind="role", role=role, heading=f"Electric circuit · {title.lower()}",
    )  # fmt: skip


def _form(key: str, title: str, table: Keys) -> Node:
    return form_node(Case, key, title, table)


def _group(table: Keys) -> Group:
    return Group("", table, tuple(plain_fields(Case, table)))


def _case_fields() -> list[str]:
    """Return the options that stand before the first table of the file."""
    elsewhere = ("parameters", *(section for section, what in NAMED.items() if what.installed))
    return [name for name in plain_fields(Case, ()) if name not in elsewhere]
