"""Test the stiffness of single bearings as a measured quantity."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from lambda_core import api
from lambda_core.domain.errors import CaseError
from lambda_core.fitting.measurements import parse_measurements
from lambda_core.fitting.subjects import subject_of

_STEP = 0.01  # of a load, for differences


def _case(designation: str, **loads: str) -> dict[str, Any]:
    return {
        "name": "one",
        "bearing": {"designation": designation},
        "lubricant": {"name": "FVA3", "temperature": "60 degC"},
        "loads": loads,
        "operation": {"speed": "1000 rpm"},
    }


@pytest.mark.parametrize(
    ("designation", "load", "axis", "newtons"),
    [("SKF 7208BE", "axial", "x", 2000.0), ("SKF NU 208 ECP", "radial", "z", 5000.0), ("SKF 32208", "axial", "x", 3e3)],
)
def test_stiffness_is_the_slope_of_load_over_displacement(
    designation: str, load: str, axis: str, newtons: float
) -> None:
    """Compare with differences of the displacement.

    Rings stay parallel under these loads, and no other direction moves.
    """
    subject = subject_of(_case(designation, **{load: f"{newtons} N"}))
    ends = [newtons * (1.0 - _STEP), newtons * (1.0 + _STEP)]
    moved = [
        subject.values((f"loads.{load}={end} N",), (), (f"displacement {axis}",), one=False).mean() for end in ends
    ]
    slope = (ends[1] - ends[0]) / abs(moved[1] - moved[0])
    found = subject.values((), (), (f"stiffness {axis}",), one=False).mean()
    assert found == pytest.approx(slope, rel=0.02)


@pytest.mark.full
def test_clearance_is_fitted_to_stiffness() -> None:
    """Find a clearance from radial and tilting stiffness."""
    source = _case("SKF 6208", radial="2 kN", axial="500 N")
    subject, names = subject_of(source), ("stiffness z", "stiffness tilt y")
    head = (f"{name} [{subject.words.measured[name].unit}],{name} error [%]" for name in names)
    rows = [f"radial load [kN],{','.join(head)}"]
    for load in (1, 2, 4):
        at = (f"loads.radial={load} kN", "bearing.clearance=14 um")
        radial, tilting = subject.values(at, (), names, one=False).mean(axis=0)
        rows.append(f"{load},{radial:.8g},1,{tilting:.8g},1")
    measured = parse_measurements("\n".join(rows), "rig.csv", subject.words)
    report = api.fit(source, measured, ["bearing.clearance=5 um..30 um"], suggest=False)
    assert report.parameters[0].value == pytest.approx(14.0, abs=0.1)


def test_stiffness_has_an_error_of_the_model() -> None:
    """Let the clearance move a stiffness, not laws of friction."""
    subject = subject_of(_case("SKF 6208", radial="2 kN", axial="500 N"))
    value = subject.values((), (), ("stiffness z",), one=False).mean()
    low, high = subject.bands((), ("stiffness z",))["stiffness z"]
    assert low < value < high
    given = subject_of({**_case("SKF 6208", radial="2 kN", axial="500 N")}, ("bearing.clearance=10 um",))
    known = np.array(given.bands((), ("stiffness z",))["stiffness z"])
    assert np.ptp(known) < 0.2 * (high - low)


@pytest.mark.parametrize("designation", ["SKF 6208", "SKF NU 208 ECP"])
@pytest.mark.parametrize("name", ["natural frequency 1", "bending frequency 2"])
def test_a_frequency_of_a_bearing_alone_is_refused_in_one_sentence(designation: str, name: str) -> None:
    words = subject_of(_case(designation, radial="2 kN")).words
    with pytest.raises(CaseError) as caught:
        parse_measurements(f"speed [1/min],{name} [Hz]\n1000,50\n", "rig.csv", words)
    (problem,) = caught.value.problems
    assert problem.where == "line 1, column 2"
    assert "a bearing alone has no shaft that vibrates or bends: name the case of a machine" in problem.message
