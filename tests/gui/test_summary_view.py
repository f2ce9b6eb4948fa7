"""Test the summary of a run in the builder."""

from __future__ import annotations

from pathlib import Path

from lambda_gui.summary_view import summary_view

from lambda_core import api

CASE, SHORT = "6208-axial-1300", ["solver.duration=1 ms"]
COLOURS = {"success": "green", "warning": "yellow"}


def test_a_torque_with_a_model_band_has_the_digits_that_the_band_leaves(tmp_path: Path) -> None:
    plain = api.run(CASE, SHORT, out=tmp_path / "plain.h5").summary()
    banded = api.run(CASE, SHORT, out=tmp_path / "banded.h5", band=True).summary()
    one, other = (summary_view(found, COLOURS).plain for found in (plain, banded))
    low, high = banded.friction_torque_Nmm_band
    assert "(model" not in one
    assert f"friction torque {banded.friction_torque_Nmm:.0f} N mm (model {low:.0f} .. {high:.0f})" in other
    for name in ("friction torque", "power loss"):
        (line,) = [row for row in other.splitlines() if row.startswith(name) and "(model" in row]
        assert "±" not in line
    for label in ("static safety C0/P0", "viscosity ratio kappa", "cage over inner ring"):  # wider than the others
        assert f"\n{label}  " in one


def test_every_warning_and_reason_of_a_run_is_shown(tmp_path: Path) -> None:
    found = api.run(CASE, SHORT, out=tmp_path / "r.h5").summary()
    told = {"warnings": ["the oil is thick", "the load is light"], "reasons": ["too short", "too coarse"]}
    lines = summary_view(found.model_copy(update=told), COLOURS).plain.splitlines()
    assert [line for line in lines if line.startswith("▲")] == ["▲ the oil is thick", "▲ the load is light"]
    assert {"  too short", "  too coarse"} <= set(lines)
