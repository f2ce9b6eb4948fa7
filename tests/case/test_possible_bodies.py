"""Test that impossible bodies and motions are refused."""

from __future__ import annotations

import tomllib
from typing import Any

import pytest

from lambda_core import api
from lambda_core.model.machine_templates import shaft_text

CASE = "6208-axial-1300"  # balls of 11.9 mm on 60 mm; the ring weighs 0.111 kg
ROLLERS: dict[str, Any] = {
    "name": "rollers",
    "bearing": {"designation": "NU 208", "maker": "SKF"},
    "lubricant": {"name": "FVA3", "temperature": "60 degC"},
    "loads": {"radial": "6.2 kN"},
    "operation": {"speed": "1500 rpm"},
}
MISTAKES = [
    ("inner_ring.mass", "1e-300 kg", "inner_ring.mass", "is below 1.11e-07 kg, a millionth"),
    ("cage.polar_inertia", "1e-300 kg m2", "cage.polar_inertia", "is below 2.29e-11 kg m2"),
    (
        "inner_ring.unbalance",
        "1e9 g mm",
        "inner_ring.unbalance",
        "from the axis: at most 66.9 kg mm",
    ),
    ("cage.y", '{ motion = "50 mm" }', "cage.y.motion", "reaches 50 mm: from 5.96 mm on pockets pass their balls"),
    ("cage.tilt_z", '{ motion = "-100 deg" }', "cage.tilt_z.motion", "reaches 100 deg"),
    ("inner_ring.y", '{ motion = "50 mm" }', "inner_ring.y.motion", "from 11.9 mm on raceways pass each other"),
    ("outer_ring.spin", '{ motion = "1e9 rpm" }', "outer_ring.spin.motion", "steel bursts"),
]


@pytest.mark.parametrize(("option", "value", "where", "words"), MISTAKES)
def test_a_body_or_motion_that_no_bearing_has_is_refused(option: str, value: str, where: str, words: str) -> None:
    """Refuse displaced cages and tiny masses.

    A cage 50 mm from its bearing ran to its end; masses of 1e-300 kg made the time steps too small.
    """
    with pytest.raises(api.CaseError) as caught:
        api.check(CASE, [f"bodies.{option}={value}"])
    (problem,) = caught.value.problems
    assert problem.where == f"bodies.{where}"
    assert words in problem.message


@pytest.mark.parametrize(("option", "value", "where", "words"), [row for row in MISTAKES if "inner_ring.y" not in row])
def test_so_it_is_in_a_machine(option: str, value: str, where: str, words: str) -> None:
    body, name = option.split(".")
    case: dict[str, Any] = tomllib.loads(shaft_text("geared-shaft", "box"))
    written = tomllib.loads(f"v = {value}")["v"] if value.startswith("{") else value
    case["bearings"]["left"][body] = {name: written}
    with pytest.raises(api.CaseError) as caught:
        api.check(case)
    (problem,) = caught.value.problems
    assert problem.where == f"bearings.left.{where}"


def test_bodies_that_move_together_may_move_far() -> None:
    shaken = '{ motion = { kind = "harmonic", amplitude = "50 mm", frequency = "2 Hz" } }'
    api.check(CASE, [f"bodies.outer_ring.y={shaken}"])  # the inner ring is free to follow
    api.check(CASE, [f"bodies.{body}.y={shaken}" for body in ("outer_ring", "inner_ring", "cage")])


@pytest.mark.parametrize(
    "change",
    [
        'bodies.inner_ring.tilt_y={ mode = "prescribed", motion = "1 rad" }',
        "bodies.inner_ring.mass=1e-300 kg",
        "operation.speed=1e9 rpm",
    ],
)
def test_rollers_are_refused_at_rest_as_in_motion(change: str) -> None:
    """Refuse impossible rollers in every question.

    `quasistatic` answered with 36 GPa where a ring turned by 57 deg.
    """
    for ask in (api.check, api.quasistatic, api.compare):
        with pytest.raises(api.CaseError, match=r"pass each other|is below|steel bursts"):
            ask(ROLLERS, [change])
