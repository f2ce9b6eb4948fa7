"""Test that results explain a missing capacitance.

The reason is the same in a run and in the equilibrium.
"""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np

from lambda_core import api
from lambda_core.results.summary import capacitance_note

CASE = "6208-axial-700"
SLOW = ["operation.speed=10 rpm"]


def test_c1_a_capacitance_that_is_not_there_is_explained(tmp_path: Path) -> None:
    result = api.run(CASE, [*SLOW, "output.interval=50 us", "solver.duration=1 ms"], out=tmp_path / "r.h5")
    summary = result.summary()
    assert summary.bearing_capacitance_nF is None
    assert summary.contact_capacitance_pF == []
    assert not np.isnan(result["capacitance"]).any()
    said = "asperities short 18 of 18 contacts under load (film parameter below 2.03)"
    assert summary.capacitance_note.startswith(said)
    assert said in summary.text()


def test_d5_the_equilibrium_shorts_what_a_run_shorts() -> None:
    found = api.quasistatic(CASE, SLOW)
    assert [contact.capacitance_pF for contact in found.contacts] == [None] * 18
    assert "asperities short 18 of 18 contacts under load" in found.text()
    fast = api.quasistatic(CASE)
    assert fast.capacitance_note == ""
    assert all(contact.capacitance_pF for contact in fast.contacts)


def test_contacts_without_load_are_not_shorted() -> None:
    load = np.array([[1.0, 1.0], [0.0, 0.0]])
    capacitance = np.array([[math.inf, 1e-12], [1e-12, 1e-12]])
    assert capacitance_note(load, capacitance, "ball").startswith("asperities short 1 of 2 contacts under load (film")
    assert "no capacitor" not in capacitance_note(load, capacitance, "ball")


def test_a_ball_that_rests_by_its_weight_is_no_loaded_ball() -> None:
    load = np.array([[5000.0, 5001.0], [0.0, 1.0], [0.0, 0.0]])
    capacitance = np.array([[1e-10, 1e-10], [1e-12, math.inf], [1e-12, 1e-12]])
    note = capacitance_note(load, capacitance, "ball")
    assert note.startswith("asperities short 0 of 2 contacts under load and 1 of 1 others")
