"""Test the model tree.

Complete, in order, and mistakes find their node.
"""

from __future__ import annotations

import pytest
from lambda_gui.checking import Checker, by_place, node_of
from lambda_gui.outline import Node, outline

from lambda_core import api
from lambda_core.case.case import Case
from lambda_core.domain.errors import Problem
from lambda_core.domain.option_tree import option_paths
from lambda_core.domain.roles import ROLES
from lambda_core.model.machine_templates import SHAFTS


def nodes(**names: tuple[str, ...]) -> list[Node]:
    return [node for top in outline(Case, names) for node in top.walk()]


def has_role(path: str) -> bool:
    """Tell whether a force element has a role."""
    _, element, _, *role = path.split(".")
    return not role or element in ROLES[role[0]].elements


def test_every_option_has_exactly_one_place() -> None:
    places = [".".join(place) for node in nodes() for place in node.places]
    assert len(places) == len(set(places))
    for path in option_paths(Case):
        if path.endswith("parameters") or (path.startswith("forces.") and not has_role(path)):
            continue  # parameters stand under their role
        owners = [place for place in places if f"{path}.".startswith(f"{place}.")]
        assert len(owners) == 1, (path, owners)


def test_the_tree_mirrors_the_set_up() -> None:
    titles = [node.title for node in outline(Case)]
    assert titles == [
        "Case",
        "Bearing",
        "Bodies",
        "Markers",
        "Force elements",
        "Loads and motion",
        "Lubricant",
        "Requirements",
        "Rating life",
        "Modelling depth",
        "Solver",
        "Outputs",
        "Electric circuit",
    ]
    keys = [node.key for node in nodes()]
    assert len(keys) == len(set(keys))
    for element in ("ball_inner", "ball_outer", "ball_cage", "cage_inner", "cage_outer", "fluid_drag"):
        roles = [node.role for node in nodes() if node.element == element and node.kind == "role"]
        assert roles == [role.name for role in ROLES.values() if element in role.elements]


@pytest.mark.parametrize(
    ("where", "key"),
    [
        ("loads.radial", "loads"),
        ("loads.radial.end_time", "loads"),
        ("loads.outer_ring.force_x", "boundary.outer_ring"),
        ("bodies.inner_ring.x", "boundary.inner_ring"),
        ("bodies.inner_ring.mass", "bodies.inner_ring"),
        ("materials.balls.density", "bodies.balls"),
        ("bearing", "bearing"),
        ("bearing.geometry.ball_count", "bearing.geometry"),
        ("models.traction", "models.traction"),
        ("parameters.traction.tau_eyring", "models.traction"),
        ("forces.ball_outer.parameters.damping.coefficient", "forces.ball_outer.damping"),
        ("markers.tip.body", "markers.tip"),
        ("elements.pull.parameters.air_gap", "elements.pull"),
        ("elements.pull.second", "elements.pull"),
        ("observers.wear.coefficient", "observers.wear"),
        ("events.whirl", "events.whirl"),
        ("operation.sped", "operation"),
        ("solver.duration", "solver"),
        ("thermal.ambient", "thermal"),
        ("thermal.links.flange.between", "thermal"),
    ],
)
def test_a_mistake_finds_its_node(where: str, key: str) -> None:
    found = node_of(
        Problem(where, "wrong"), nodes(markers=("tip",), elements=("pull",), observers=("wear",), events=("whirl",))
    )
    assert found is not None
    assert found.key == key


def test_an_empty_model_says_what_it_needs() -> None:
    found = Checker(Case).check(api.draft().tables, None)
    assert found.model is None
    assert [problem.where for problem in found.problems] == [
        "bearing.designation",
        "lubricant.name",
        "lubricant.temperature",
        "operation.speed",
    ]  # option by option, in the order of the tree
    of_designation, of_maker = by_place(found.problems, [("bearing", "designation"), ("bearing", "maker")])
    assert of_designation
    assert not of_maker


def test_a_new_bearing_is_held_as_init_holds_it() -> None:
    """Lock the inner ring's tilts in models and templates."""
    alone = [name for name in api.templates() if name not in SHAFTS]
    assert alone
    held = [api.draft(template=name).get("bodies", "inner_ring") for name in alone]
    assert held == [api.draft().get("bodies", "inner_ring")] * len(alone)


def test_a_mistake_stands_once_at_the_innermost_row() -> None:
    problems = [Problem("loads.axial.frequency", "is required"), Problem("loads", "is odd"), Problem("solver", "no")]
    places = [("loads", "radial"), ("loads", "axial"), ("loads", "axial", "frequency"), ("loads", "axial", "phase")]
    assert by_place(problems, places) == [["is odd"], [], ["is required"], []]


def test_a_good_case_resolves() -> None:
    draft = api.draft("6208-axial-1300")
    found = Checker(Case).check(draft.tables, draft.folder)
    assert not found.problems
    assert found.model is not None
    assert found.values
    assert draft.tables == api.draft("6208-axial-1300").tables  # checking changes nothing
