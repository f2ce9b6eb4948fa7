"""Test the warnings of results beyond the limits of laws."""

from __future__ import annotations

import json
import math
from pathlib import Path

import numpy as np
import pytest
from lambda_cli.main import main

from lambda_core import api
from lambda_core.results.limits import Grooves, shoulders, tolerance_warning, warnings

AXIAL = "6208-axial-1300"


def test_edge_of_a_shoulder_that_is_known() -> None:
    """Compare edges of shoulders with 60 and 90 degrees.

    A groove of radius 10 mm, shoulders 5 mm and 10 mm high.
    """
    geometry = {
        "groove_radius_inner": 0.01,
        "race_diameter_inner": 0.08,
        "shoulder_diameter_inner": 0.09,
        "groove_radius_outer": 0.01,
        "race_diameter_outer": 0.12,
        "shoulder_diameter_outer": 0.10,
    }
    grooves = Grooves.of(geometry)
    assert np.degrees(grooves.edge) == pytest.approx([60.0, 90.0])
    load = np.array([[1.0, 1.0], [1.0, 0.0], [0.0, 1.0]])
    angle = np.radians([[30.0, 30.0], [-45.0, 89.0], [80.0, 10.0]])
    inner, outer = shoulders(grooves, load, angle, np.full((3, 2), 0.003))
    assert (inner.ball, outer.ball) == (2, 1)  # of the contacts that carry
    assert inner.margin_um == pytest.approx(1e6 * (0.01 * math.radians(15.0) - 0.003))
    assert inner.ellipse_end_deg == pytest.approx(45.0 + math.degrees(0.3))
    assert "ball 2 runs 382 um over the inner ring's shoulder" in inner.warning()[0]
    assert outer.warning() == []


def test_the_low_shoulder_of_angular_contact() -> None:
    """Compare angles past a low shoulder.

    One at -2 degrees, 0.05 rad wide, lies beyond the bottom of its groove by 2 deg + 0.05; one at 20 does not.
    """
    grooves = Grooves(np.array([0.01, 0.01]), np.radians([60.0, 60.0]), one_sided=True)
    load, half = np.array([[100.0, 100.0], [50.0, 0.5]]), np.full((2, 2), 0.0005)
    angle = np.radians([[20.0, 20.0], [-2.0, -2.0]])
    inner, outer = shoulders(grooves, load, angle, half)
    assert (inner.ball, inner.low, inner.margin_um) == (2, True, pytest.approx(-1e4 * (math.radians(2.0) + 0.05)))
    assert (outer.ball, outer.low, outer.margin_um > 0.0) == (1, False, True)  # one that hardly carries does not count
    assert "over the low shoulder of the inner ring" in inner.warning()[0]
    other_way = shoulders(grooves, load, -angle, half)
    assert (other_way[0].low, other_way[0].margin_um) == (True, pytest.approx(inner.margin_um))


def test_nothing_is_said_in_normal_running() -> None:
    found = api.quasistatic(AXIAL)
    assert found.warnings == []
    assert {edge.ring for edge in found.shoulders} == {"inner", "outer"}
    assert all(edge.margin_um > 0.0 for edge in found.shoulders)
    # with the angle and the semi-axis that the equilibrium prints: physics.md, 15.14 degrees and 1.24 mm
    inner = found.shoulders[0]
    assert inner.contact_angle_deg == pytest.approx(15.14, abs=0.05)
    assert inner.ellipse_end_deg == pytest.approx(15.14 + math.degrees(1.24 / (0.52 * 11.91)), abs=0.6)


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ("loads.axial=30 kN", "over the inner ring's shoulder"),
        ("loads.radial=1 MN", "where steel yields"),
        ("lubricant.temperature=300 degC", "outside -40 to 200 degC"),
        ("lubricant.temperature=-50 degC", "outside -40 to 200 degC"),
    ],
)
def test_what_lies_beyond_is_said(change: str, words: str) -> None:
    found = api.quasistatic(AXIAL if "axial" in change else "6319-cp10-1500", [change])
    assert any(words in sentence for sentence in found.warnings), found.warnings
    assert "WARNING" in found.text()


def test_a_run_says_it_in_text_and_as_data(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    """Report limits over the complete run.

    A load that has long fallen again counts too.
    """
    ramp = [
        "loads.axial.kind=ramp", "loads.axial.start=30 kN", "loads.axial.end=1 kN", "loads.axial.end_time=3 ms",
    ]  # fmt: skip
    path = str(tmp_path / "r.h5")
    changes = [part for change in [*ramp, "output.interval=0.2 ms"] for part in ("--set", change)]
    assert main(["run", AXIAL, *changes, "--duration", "6 ms", "--out", path, "--quiet"]) == 5
    assert "OVER the edge" in capsys.readouterr().out
    main(["show", path, "--json"])
    data = json.loads(capsys.readouterr().out)
    bearing = data["bearings"]["bearing"]
    inner = next(edge for edge in bearing["shoulders"] if edge["ring"] == "inner")
    assert inner["margin_um"] < 0.0
    assert any("over the inner ring's shoulder" in sentence for sentence in data["warnings"])
    assert max(contact["load_N"] for contact in bearing["contacts"]) < 3000.0


def test_a_coarse_tolerance_is_said() -> None:
    assert tolerance_warning(1e-3) == []
    assert "solver.tolerance 0.002 is above 0.001" in tolerance_warning(2e-3)[0]


def test_pressure_without_contact_is_no_warning() -> None:
    assert warnings(math.nan, [], 0.0) == []


def test_a_tilt_above_ten_minutes_of_arc_is_said() -> None:
    assert warnings(1e9, [], math.radians(9.9 / 60.0)) == []
    (sentence,) = warnings(1e9, [], 4.06e-3)
    assert sentence.startswith("the inner ring tilts by 4.1 mrad: deep-groove ball bearings take up to 2.9 mrad")
