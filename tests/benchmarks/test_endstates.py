"""The comparison of end states tells versions apart, and names nothing that b7aec9b did not have."""

from __future__ import annotations

import sys

from benchmarks import endstates
from lambda_core import api


def test_a_changed_bit_is_found_and_a_channel_of_one_version_is_not_compared() -> None:
    """Only what both know can differ."""
    one = {"case": {"load": "a", "film": "b", "fresh": "c"}}
    other = {"case": {"load": "a", "film": "x"}}
    assert endstates.differences(one, other) == {"case": ["film"]}


def test_the_named_laws_and_constants_are_allowed_in_every_case() -> None:
    """A constant that went out of the program would make every comparison fail."""
    for name in endstates.CASES:
        api.check(api.case(name).with_(**endstates.constants(newer=True)))


def test_two_runs_of_one_version_end_in_the_same_bits() -> None:
    """The same interpreter on both sides: a comparison that found differences here would be worth nothing."""
    states = [endstates.ask(sys.executable, ["6208-axial-1300"], 1e-4, newer=True) for _ in range(2)]
    assert states[0]["6208-axial-1300"].keys() >= {"load", "time"}
    assert endstates.differences(*states) == {"6208-axial-1300": []}
