"""Test the cards of declared options."""

from __future__ import annotations

import pytest

from lambda_core.case.cards import FieldCard, field_card
from lambda_core.case.case import Case
from lambda_core.domain.option_tree import model_at, option_paths


def card(path: str) -> FieldCard:
    *parents, name = path.split(".")
    table = model_at(Case, parents)
    assert table is not None
    return field_card(table, name)


def test_every_option_has_a_card_with_help() -> None:
    cards = {path: card(path) for path in option_paths(Case)}
    assert len(cards) > 300
    assert [path for path, found in cards.items() if not found.description] == []
    assert [path for path, found in cards.items() if found.kind in ("quantity", "signal") and not found.units] == []
    defaults = {path: found for path, found in cards.items() if found.default and found.units}
    assert [path for path, found in defaults.items() if found.default.split(" ", 1)[1] not in found.units] == []


@pytest.mark.parametrize(
    ("path", "kind"),
    [
        ("name", "text"),
        ("assumptions", "texts"),
        ("bearing.clearance_pick", "choice"),
        ("bearing.geometry.ball_count", "integer"),
        ("bearing.geometry.ball_diameter", "quantity"),
        ("bearing.geometry.conformity_inner", "number"),
        ("loads.radial", "signal"),
        ("electric.series.points", "pairs"),
        ("bodies.outer_ring.x.motion", "signal"),
        ("depth.cage", "flag"),
        ("markers", "table"),
        ("materials", "table"),
    ],
)
def test_kinds(path: str, kind: str) -> None:
    assert card(path).kind == kind


def test_limits_units_defaults_and_choices() -> None:
    ball = card("bearing.geometry.ball_diameter")
    assert ball.limits == ["> 0 mm"]
    assert ball.units[0] == "mm"
    assert not ball.required
    assert card("bearing.geometry.ball_count").limits == [">= 3", "<= 60"]
    assert card("operation.speed").required
    assert card("gravity.z").default == "-9.80665 m/s2"
    assert "standard gravity" in card("gravity.z").reference
    assert card("bearing.geometry.series").choices == [
        "60",
        "62",
        "63",
        "64",
        "618",
        "619",
        "70",
        "72",
        "73",
        "32",
        "33",
        "QJ2",
        "QJ3",
        "12",
        "13",
        "22",
        "23",
    ]
    assert card("depth.cage").default == "true"
