"""Test options of each bearing of a machine.

Oil, paths of its mistakes, laws that fit its cage.
"""

from __future__ import annotations

import tomllib
from typing import Any

import pytest

from lambda_core import api
from lambda_core.case.written import merged
from lambda_core.model.machine_model import MachineModel
from lambda_core.model.machine_templates import shaft_text


def tables(**changes: Any) -> dict[str, Any]:
    """Return the case that init writes, changed."""
    return merged(tomllib.loads(shaft_text("geared-shaft", "box")), changes)


def machine(**changes: Any) -> MachineModel:
    """Return that case resolved."""
    found = api.check(tables(**changes))
    assert isinstance(found, api.MachineModel)
    return found


def mistakes(**changes: Any) -> dict[str, str]:
    """Return what is wrong with that case, by place."""
    with pytest.raises(api.CaseError) as caught:
        api.check(tables(**changes))
    return {problem.where: problem.message for problem in caught.value.problems}


def test_each_bearing_has_its_own_oil() -> None:
    """Compare each bearing's films with a machine of that oil.

    Values that a bearing leaves out are those of the machine.
    """
    thin = {"name": "mineral-vg32", "temperature": "50 degC"}
    mixed = api.quasistatic(machine(bearings={"right": {"lubricant": thin}}))
    shared, other = api.quasistatic(machine()), api.quasistatic(machine(lubricant=thin))
    by_name = [{name: bearing.film_um for name, bearing in found.bearings.items()} for found in (mixed, shared, other)]
    assert by_name[0]["left"] == pytest.approx(by_name[1]["left"], rel=1e-3)
    assert by_name[0]["right"] == pytest.approx(by_name[2]["right"], rel=1e-3)
    assert abs(by_name[2]["right"][0] / by_name[1]["right"][0] - 1.0) > 0.1
    warm = machine(bearings={"right": {"lubricant": {"temperature": "80 degC"}}}).bearings
    assert warm[0].model.oil.name == warm[1].model.oil.name
    assert warm[1].model.oil.temperature == pytest.approx(warm[0].model.oil.temperature + 10.0)


def test_mistakes_of_one_bearing_stand_at_its_place() -> None:
    found = mistakes(
        bearings={
            "left": {"lubricant": {"name": "FVA99"}, "cage": {"type": "gold"}, "clearance": "C9"},
            "right": {"forces": {"ball_inner": {"models": {"mixing": "x"}}}},
        },
        surface={"roughness": "1 m"},
    )  # fmt: skip
    assert "bearings.left.lubricant.name" in found
    assert "bearings.left.cage.type" in found
    assert "bearings.left.clearance" in found
    assert "bearings.right.forces.ball_inner.models.mixing" in found


@pytest.mark.parametrize(
    ("changes", "where"),
    [
        ({"models": {"cage_contact": "land-guidance"}}, "models.cage_contact"),
        (
            {"bearings": {"left": {"forces": {"cage_inner": {"models": {"cage_contact": "land-guidance"}}}}}},
            "bearings.left.forces.cage_inner.models.cage_contact",
        ),
    ],
)
def test_a_land_guides_the_cage_that_it_guides(changes: dict[str, Any], where: str) -> None:
    assert "land-guidance" in mistakes(**changes)[where]


def test_a_machine_without_cages() -> None:
    model = machine(depth={"cage": False})
    assert not any(bearing.model.depth.cage for bearing in model.bearings)


def test_laws_know_the_flow_of_oil() -> None:
    """Take the flow from `[thermal]` or from the bearing.

    An oil jet needs it.
    """
    jet = {"lubrication": "oil jet"}
    shared = machine(lubricant=jet, thermal={"oil_flow": "1 l/min", "oil_supply": "40 degC"})
    assert [bearing.model.oil_flow for bearing in shared.bearings] == pytest.approx([1e-3 / 60.0] * 2)
    own = {"thermal": {"oil_flow": "2 l/min"}}
    mixed = machine(lubricant=jet, thermal={"oil_flow": "1 l/min"}, bearings={"right": own})
    assert [bearing.model.oil_flow for bearing in mixed.bearings] == pytest.approx([1e-3 / 60.0, 2e-3 / 60.0])
    assert "thermal.oil_flow" in mistakes(lubricant=jet)
