"""Test mistakes of every stage at once.

Of the tables, of single bearings, of places, of the machine and of its files.
"""

from __future__ import annotations

import tomllib
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import pytest

from lambda_core import api
from lambda_core.case.written import merged
from lambda_core.model.machine_templates import shaft_text


def mistakes(changes: Mapping[str, Any]) -> dict[str, str]:
    """Return the mistakes by path.

    Of the template's case after changes.
    """
    with pytest.raises(api.CaseError) as caught:
        api.check(merged(tomllib.loads(shaft_text("geared-shaft", "box")), changes))
    found = {problem.where: problem.message for problem in caught.value.problems}
    assert len(found) == len(caught.value.problems)
    return found


def test_no_stage_hides_another_one() -> None:
    found = mistakes({
        "lubricant": {"temperature": "70 mm"},
        "bearings": {"right": {"designation": "SKF 62066"}, "left": {"at": "300 mm", "takes": "+x"}},
        "gears": {"wheel": {"helix_angle": "85 deg"}},
        "connections": {"a": {"at": "nowhere", "x": "1 N/um"}, "b": {"at": "10 mm", "tilt_x": "1 N m/rad"}},
        "discs": {"wheel": {"at": "400 mm"}},
        "shaft": {"material": "cheese"},
        "bodies": {"plate": {"x": "1 mm", "mass": "1 kg", "polar_inertia": "9 kg m2", "transverse_inertia": "1 kg m2"}},
        "housing": {"reduced": "nothing.json"},
    })  # fmt: skip
    said = {
        "lubricant.temperature": "mm is not a unit of temperature",
        "gears.wheel.helix_angle": "85 deg: must be less than 80 deg",
        "bearings.right.designation": '"SKF 62066" is not a known bearing',
        "bearings.left.at": "300 mm is not on the shaft: 0 mm to 170 mm",
        "connections.a.at": '"nowhere" is not a known marker or bearing; available: left, right',
        "connections.b.tilt_x": "would prevent rotation",
        "discs.wheel.at": "400 mm is not on the shaft",
        "shaft.material": '"cheese" is not a known material',
        "bodies.plate.polar_inertia": "more than twice its transverse one",
        "housing.reduced": "nothing.json: cannot be read: no such file",
    }
    assert set(found) == set(said)
    for where, words in said.items():
        assert words in found[where]


@pytest.mark.parametrize(
    ("changes", "paths"),
    [
        # how long the shaft is, nobody knows: what stands beyond it is not said; a power at rest is
        (
            {
                "shaft": {"sections": [{"length": "3", "diameter": "2 mm"}]},
                "loads": {"far": {"at": "9 m"}},
                "operation": {"speed": "0 rpm"},
            },
            ["shaft.sections.0.length", "gears.wheel.power"],
        ),
        # names of its nodes cannot be known
        (
            {
                "shaft": {"reduced": "none.npz", "sections": None},
                "bearings": {"left": {"at": "seat"}},
                "connections": {"b": {"at": "1 m", "tilt_x": "1 N m/rad"}},
            },
            ["shaft.reduced", "connections.b.tilt_x"],
        ),
        # markers on a body that is wrong, and what stands at them
        (
            {
                "bodies": {"box": {"x": "1 mm", "length": "3"}},
                "markers": {"foot": {"body": "box", "x": "1 mm"}},
                "loads": {"push": {"at": "foot"}},
                "bearings": {"left": {"outer": "foot"}, "right": {"outer": "boxx"}},
            },
            ["bodies.box.length", "bearings.right.outer"],
        ),
        ({"bearings": {"left": None, "right": {"at": None}}}, ["bearings.right.at"]),
        (
            {"bearings": {"left": None, "right": None}, "discs": {"wheel": {"at": "1 m"}}},
            ["bearings", "discs.wheel.at"],
        ),
        ({"shaft": {"sections": [{"length": "1000 m", "diameter": "40 mm"}]}}, ["shaft.sections"]),
        (
            {"markers": {"ground": {"x": "1 mm"}}, "loads": {"far": {"at": "9 m"}}},
            ["markers.ground", "loads.far.at"],
        ),
    ],
)
def test_what_follows_is_not_said(changes: dict[str, Any], paths: list[str]) -> None:
    """Skip messages about stand-ins of wrong items.

    Messages about a stand-in, or about references to it, are no mistakes.
    """
    found = mistakes(changes)
    assert sorted(found) == sorted(paths), found


def test_too_few_are_said_in_words() -> None:
    assert "needs 1 at least" in mistakes({"bearings": {"left": None, "right": None}})["bearings"]


def test_nothing_in_a_table_is_nothing_said(tmp_path: Path) -> None:
    """Take an option back by None.

    This holds for plain tables, as in the case of one bearing.
    """
    tables = tomllib.loads(shaft_text("geared-shaft", "box"))
    tables["life"]["contamination"] = None
    machine = api.check(tables, folder=tmp_path)
    assert [bearing.model.contamination for bearing in machine.bearings] == [None, None]


@pytest.mark.parametrize("name", ["a.b", "right.cage", "two words", "line\n", "-x", ""])
@pytest.mark.parametrize("table", ["markers", "loads"])
def test_names_of_parts_can_be_steps_of_a_path(table: str, name: str) -> None:
    """Refuse a dot, which separates the steps.

    No change could reach loads.a.b.force_z, and a line break ended a name unseen.
    """
    found = mistakes({table: {name: {"x": "20 mm"} if table == "markers" else {"at": "20 mm"}}})
    assert found[f"{table}.{name}"] == "use letters, digits, dash and underscore in names, the first a letter or digit"
