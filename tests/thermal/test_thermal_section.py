"""Test mistakes in the section thermal and their paths."""

from __future__ import annotations

from typing import Any

import pytest

from lambda_core import api
from lambda_core.case.written import merged

LINK = {"between": ["housing", "flange"], "conductance": "2 W/K"}
AIR = {"between": ["flange", "ambient"], "conductance": "1 W/K"}


def problems(ordinary: dict[str, Any], thermal: dict[str, Any], **more: Any) -> dict[str, str]:
    changed = merged(ordinary, {"thermal": thermal, **more})
    return {problem.where: problem.message for problem in api.problems(changed)}


@pytest.mark.parametrize(
    ("thermal", "where", "said"),
    [
        ({"conductances": "haris"}, "thermal.conductances", "harris"),
        ({"ambient": "20"}, "thermal.ambient", 'write "20 degC"'),
        ({"ambiant": "20 degC"}, "thermal.ambiant", "nearest: ambient"),
        ({"housing_area": "0.1 mm"}, "thermal.housing_area", "not a unit of area"),
        ({"oil_flow": "1 W/K"}, "thermal.oil_flow", "not a unit of volume_flow"),
        ({"emissivity": 1.2}, "thermal.emissivity", "must be at most 1"),
        ({"nodes": {"housing": {"heat": "3 N"}}}, "thermal.nodes.housing.heat", "not a unit of power"),
        ({"nodes": {"housing": {"heat_capacity": "0 J/K"}}}, "thermal.nodes.housing.heat_capacity", "greater than 0"),
        ({"nodes": {"ambient": {"heat": "3 W"}}}, "thermal.nodes.ambient", "change that"),
        (
            {"nodes": {"housing": {"temperature": "60 degC", "start": "20 degC"}}},
            "thermal.nodes.housing.start",
            "has no effect",
        ),
        ({"nodes": {"flange": {}}}, "thermal.nodes.flange", "has no heat path to a held temperature"),
        ({"links": {"foot": LINK}}, "thermal.links.foot.between", '"flange" is not a known node'),
        (
            {"links": {"foot": LINK | {"between": ["housng", "ambient"]}}},
            "thermal.links.foot.between",
            "nearest: housing",
        ),
        ({"links": {"foot": LINK | {"between": ["housing"]}}}, "thermal.links.foot.between", "needs 2 at least"),
        ({"links": {"foot": LINK | {"between": ["oil", "oil"]}}}, "thermal.links.foot.between", "two different nodes"),
        ({"links": {"foot": LINK | {"conductance": "2 W"}}}, "thermal.links.foot.conductance", "thermal_conductance"),
        (
            {
                "links": {
                    "one": {"between": ["housing", "ambient"], "conductance": "2 W/K"},
                    "two": {"between": ["ambient", "housing"], "conductance": "1 W/K"},
                }
            },
            "thermal.links.two.between",
            "joins the same nodes as thermal.links.one",
        ),
        (
            {"conductances": "none"},
            "thermal.links",
            "the bearing has no heat path to a held temperature: add thermal.links",
        ),
        ({"oil_supply": "40 degC"}, "thermal.oil_supply", "has no effect without thermal.oil_flow"),
        ({"ambient": "35 K"}, "thermal.ambient", "-238.15 degC is outside -100 degC to 500 degC"),
        ({"oil_supply": "40 K", "oil_flow": "1 l/min"}, "thermal.oil_supply", "is another unit meant?"),
    ],
)
def test_a_mistake_has_its_path(ordinary: dict[str, Any], thermal: dict[str, Any], where: str, said: str) -> None:
    found = problems(ordinary, thermal)
    assert list(found) == [where]
    assert said in found[where]


def test_every_mistake_is_said_at_once(ordinary: dict[str, Any]) -> None:
    wrong = {"oil_supply": "40 degC", "nodes": {"flange": {}}, "links": {"a": AIR | {"between": ["oil", "air"]}}}
    assert set(problems(ordinary, wrong)) == {"thermal.oil_supply", "thermal.links.a.between"}


def test_temperatures_are_given_or_computed_not_both(ordinary: dict[str, Any]) -> None:
    both = {"operation": {"temperatures": "computed"}, "bearing": {"temperatures": {"inner_ring": "80 degC"}}}
    found = problems(ordinary, {}, **both)
    assert "thermal.nodes.inner_ring.temperature" in found["bearing.temperatures.inner_ring"]


def test_a_network_that_says_all_is_well(ordinary: dict[str, Any]) -> None:
    assert problems(ordinary, {"nodes": {"flange": {}}, "links": {"foot": LINK, "air": AIR}}) == {}


def test_computed_temperatures_are_part_of_what_a_run_is(ordinary: dict[str, Any]) -> None:
    """Give computed temperatures another hash.

    Two cases whose temperatures will differ have different hashes; given ones do not depend on the network.
    """

    def hash_of(**changes: Any) -> str:
        return api.describe(api.check(merged(ordinary, changes))).hash

    computed = {"operation": {"temperatures": "computed"}}
    assert hash_of() == hash_of(thermal={"ambient": "30 degC"})
    assert hash_of(**computed) != hash_of()
    assert hash_of(**computed) != hash_of(**computed, thermal={"ambient": "30 degC"})


def test_what_the_network_fills_in_is_an_assumption(ordinary: dict[str, Any]) -> None:
    computed = {"operation": {"temperatures": "computed"}}
    found = "\n".join(api.check(merged(ordinary, {"thermal": {"oil_flow": "1 l/min"}, **computed})).assumptions)
    assert "oil flows in at the surroundings' 20 degC: thermal.oil_supply" in found
    assert "cast-iron pillow block" in found
    assert "emissivity of 0.9" in found
    given = {"oil_flow": "1 l/min", "oil_supply": "40 degC", "ambient": "25 degC", "conductances": "palmgren"}
    found = "\n".join(api.check(merged(ordinary, {"thermal": given, **computed})).assumptions)
    assert "thermal.oil_supply" not in found
    assert "thermal.ambient" not in found
    assert "thermal.conductances" not in found
    assert "emissivity" not in found
