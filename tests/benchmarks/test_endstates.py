"""Test the comparison of end states between versions."""

from __future__ import annotations

import sys

import pytest

from benchmarks import endstates
from benchmarks.endstate_worker import bearing_case
from lambda_core import api

KINDS = {"deep groove", "angular contact", "four-point", "double row", "self-aligning"}


def test_a_changed_bit_is_found_and_a_channel_of_one_version_is_not_compared() -> None:
    """Compare only the channels that both versions have."""
    one = {"case": {"load": "a", "film": "b", "fresh": "c"}}
    other = {"case": {"load": "a", "film": "x"}}
    assert endstates.differences(one, other) == {"case": ["film"]}


def test_the_named_laws_and_constants_are_allowed_in_every_case() -> None:
    """Find every named law and constant in the program.

    A constant that the program no longer has would make every comparison fail.
    """
    for name in endstates.CASES:
        api.check(api.case(name).with_(**endstates.constants(newer=True)))


def test_the_recent_cases_cover_every_kind_of_bearing_and_three_shafts() -> None:
    """Resolve each entry of the recent cases.

    Together they have all kinds, elastic parts, a circuit and resumed runs.
    """
    entries = endstates.recent_cases()
    models = {name: api.check(bearing_case(entry)) for name, entry in entries["bearings"].items()}
    assert {model.geometry.kind.name for model in models.values()} == KINDS
    assert len([api.check({"name": "endstate"} | entry["case"]) for entry in entries["shafts"].values()]) == 3
    assert sum("stop" in entry for kind in endstates.KINDS for entry in entries[kind].values()) >= 3


def test_a_case_without_common_channels_is_not_equal(capsys: pytest.CaptureFixture[str]) -> None:
    """Reject equality when a renamed layout leaves nothing in common."""
    assert endstates.tell({"case": {"left/load": "a"}}, {"case": {"load": "a"}}) == ["case"]
    assert "no channel in common" in capsys.readouterr().out


@pytest.mark.full
@pytest.mark.parametrize(
    ("kind", "name"), [pytest.param("bearings", "default-laws-axial", marks=pytest.mark.slow), ("shafts", "gearbox")]
)
def test_a_recent_case_gives_hashes(kind: str, name: str) -> None:
    """Run both kinds briefly and hash the results.

    The hashes include the circuit and the integrals.
    """
    entry = endstates.recent_cases()[kind][name] | {"duration": "0.2 ms"}
    states = endstates.ask(sys.executable, [], 0.0, newer=True, recent={kind: {name: entry}})
    assert len(states[name]) > 30
    assert any(channel.endswith("integrals") for channel in states[name])


@pytest.mark.full
def test_two_runs_of_one_version_end_in_the_same_bits() -> None:
    """Run the same interpreter on both sides.

    If this comparison found differences, none could be trusted.
    """
    states = [endstates.ask(sys.executable, ["6208-axial-1300"], 1e-4, newer=True) for _ in range(2)]
    assert states[0]["6208-axial-1300"].keys() >= {"load", "time"}
    assert endstates.differences(*states) == {"6208-axial-1300": []}
