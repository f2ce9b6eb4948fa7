"""Test input, completion and stored values of fields."""

from __future__ import annotations

import pytest
from lambda_gui.entry import completed, text_of, value_of

from lambda_core.case.cards import field_card
from lambda_core.case.modelling import Depth, Solver
from lambda_core.case.motion import Loads
from lambda_core.case.parts import Surface


@pytest.mark.parametrize(
    ("typed", "complete"),
    [
        ("700", "700 N"),
        (" 7.5e2", "7.5e2 N"),
        ("-3", "-3 N"),
        ("16 k", "16 kN"),
        ("16k", "16kN"),
        ("16 kN", "16 kN"),
        ("16 x", "16 x"),
        ("16,5", "16,5"),
        ("", ""),
        ("abc", "abc"),
    ],
)
def test_a_number_takes_its_unit(typed: str, complete: str) -> None:
    assert completed(typed, ["N", "kN", "MN"]) == complete


def test_values_as_the_case_has_them() -> None:
    assert value_of("700", field_card(Loads, "radial")) == "700 N"
    assert value_of("  ", field_card(Loads, "radial")) is None
    assert value_of("0.2", field_card(Surface, "roughness")) == "0.2 um"
    assert value_of("31", field_card(Depth, "strips")) == 31
    assert value_of("3.5", field_card(Depth, "strips")) == 3.5  # refused by the check, not swallowed here
    assert value_of("1e-4", field_card(Solver, "tolerance")) == 1e-4
    assert value_of("fine", field_card(Solver, "tolerance")) == "fine"


def test_texts_of_values() -> None:
    assert text_of(None) == ""
    assert text_of(True) == "true"
    assert text_of(1e-3) == "0.001"
    assert text_of("16 kN") == "16 kN"
