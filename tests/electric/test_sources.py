"""Test common-mode voltages and mistakes in them."""

from __future__ import annotations

import tomllib
from pathlib import Path
from typing import Annotated

import numpy as np
import pytest

from lambda_core import api
from lambda_core.analysis.electric.outcome import source_words
from lambda_core.analysis.electric.voltage_sources import corners, one_period
from lambda_core.case.case import Case
from lambda_core.case.case_io import bearing_case
from lambda_core.case.case_writer import standalone_toml
from lambda_core.case.electric import Electric, Inverter, Series, Sine, Step
from lambda_core.case.signals import Table
from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.errors import CaseError
from lambda_core.domain.units import Quantity


def case_with(electric: dict[str, object], folder: Path | None = None) -> Case:
    base = bearing_case("6208-axial-1300")
    base._folder = folder
    return base.with_(electric=electric)


def test_inverter_levels_and_edges() -> None:
    """Find six edges of a third per period.

    The levels are a half and a sixth of the dc link.
    """
    source = Inverter(dc_link="600 V", switching_frequency="8 kHz", rise_time="40 ns", modulation=0.5)
    time, volts = corners(source, 0.25, 0.35, lambda t: 300.0 * t)
    assert time[0] == 0.25
    assert time[-1] >= 0.35
    assert np.all(np.diff(time) > 0.0)
    assert np.abs(volts).max() == pytest.approx(300.0)
    slope = np.diff(volts) / np.diff(time)
    flat = slope == 0.0
    np.testing.assert_allclose(np.unique(np.round(np.abs(volts[:-1][flat]))), [100.0, 300.0])
    single = ~flat & np.isclose(np.diff(time), 40e-9)
    phases = np.abs(slope[single]) / (200.0 / 40e-9)  # two of them may switch at one instant
    np.testing.assert_allclose(phases, np.round(phases), rtol=1e-6)
    assert np.median(phases) == pytest.approx(1.0, rel=1e-6)
    inside = (time[:-1] >= 0.25) & (time[:-1] < 0.35)
    assert np.abs(np.diff(volts))[inside].sum() == pytest.approx(6 * 200.0 * 800, rel=2e-3)


def test_average_follows_no_fundamental() -> None:
    """Find no fundamental in the common mode.

    Three sines at 120 degrees; the mean over many periods vanishes.
    """
    time, volts = corners(Inverter(), 0.0, 0.2, lambda t: 2.0 * np.pi * 25.0 * t)
    assert abs(np.trapezoid(volts, time) / 0.2) < 0.02 * 400.0


@pytest.mark.parametrize(
    "source",
    [
        Inverter(),
        Sine(amplitude="10 V", frequency="3 kHz"),
        Series(points=[("0 s", "0 V"), ("7 us", "5 V"), ("9 us", "1 V")], repeat=True),
    ],
)
def test_stretches_have_the_same_corners(source: Inverter | Sine | Series) -> None:
    """Cut a span in two and compare its corners.

    They agree bit by bit.
    """

    def turned(t: FloatArray) -> FloatArray:
        return np.asarray(300.0 * t + 40.0 * t * t)

    complete = set(zip(*map(tuple, corners(source, 0.1, 0.11, turned)), strict=True))
    for begin, end in ((0.1, 0.1023), (0.1023, 0.10231), (0.10231, 0.11)):
        time, volts = corners(source, begin, end, turned, origin=0.1)
        assert time[0] <= begin + 1e-12
        assert time[-1] >= end - 1e-12
        assert set(zip(time[1:-1], volts[1:-1], strict=True)) <= complete


def test_step() -> None:
    time, volts = corners(Step(amplitude="100 V", time="1 ms", rise_time="1 us"), 0.0, 0.01, np.zeros_like)
    np.testing.assert_allclose(np.interp([0.5e-3, 1.0005e-3, 2e-3, 9e-3], time, volts), [0.0, 50.0, 100.0, 100.0])


def test_series_is_repeated(tmp_path: Path) -> None:
    (tmp_path / "shaft.csv").write_text("time [us],voltage [V]\n0,1\n10,2\n20,-1\n30,0\n")
    case = case_with({"series": {"file": "shaft.csv", "repeat": True}}, tmp_path)
    assert case.electric is not None
    assert isinstance(case.electric.source, Series)
    time, volts = corners(case.electric.source, 0.0, 100e-6, np.zeros_like)
    np.testing.assert_allclose(np.interp([5e-6, 45e-6, 85e-6, 38e-6], time, volts), [1.5, 1.5, 1.5, 0.8])
    alone = standalone_toml(case)
    assert "shaft.csv" not in alone
    assert '["20 us", "-1 V"]' in alone
    assert tomllib.loads(alone)["electric"]["series"]["repeat"]


@pytest.mark.parametrize(
    ("electric", "where", "words"),
    [
        ({"inverter": {"rise_time": "-50 ns"}}, "electric.inverter.rise_time", "must be greater than 0 ns"),
        ({"inverter": {"rise_time": "50"}}, "electric.inverter.rise_time", "has no unit"),
        ({"inverter": {"rise_time": "20 us"}}, "electric.inverter", "1/20 of a switching period"),
        ({"inverter": {"dc_lnk": "1 V"}}, "electric.inverter.dc_lnk", "nearest: dc_link"),
        ({"inverted": {}}, "electric.inverted", "nearest: inverter"),
        ({"sine": {"frequency": "1 kHz"}}, "electric.sine.amplitude", "is required"),
        ({"inverter": {"dc_link": "800 A"}}, "electric.inverter.dc_link", "is not a unit of voltage"),
        ({"inverter": {}, "step": {"amplitude": "1 V"}}, "electric", "inverter and step are both sources"),
        (
            {"series": {"points": [["0 s", "1 V"], ["1 s", "1 V"], ["1 s", "2 V"]]}},
            "electric.series",
            '"points" entry 3: the times',
        ),
        ({"series": {"points": ["0 s, 1 V"]}}, "electric.series.points.0", "is not a pair in brackets"),
        ({"grounding": {"shunt": "1 Ohm"}}, "electric.grounding", "`shunt` requires `insulation`"),
        ({"series": {}}, "electric.series", "give either `points` or `file`"),
    ],
)
def test_mistakes_are_named(electric: dict[str, object], where: str, words: str) -> None:
    with pytest.raises(CaseError) as caught:
        case_with(electric)
    (problem,) = caught.value.problems
    assert problem.where == where
    assert words in problem.message


def _series(*points: tuple[str, str], repeat: bool = False) -> Electric:
    found = case_with({"series": {"points": points, "repeat": repeat}}).electric
    assert found is not None
    return found


def test_a_series_has_the_syntax_and_the_ends_of_a_table() -> None:
    """Read pairs and hold the first and last values.

    The series began again, and its points were texts.
    """
    points = (("10 us", "1 V"), ("20 us", "4 V"), ("30 us", "2 V"))
    held = _series(*points)
    for origin in (0.0, 0.5):
        times, volts = corners(held.source, origin, origin + 1e-3, np.zeros_like, origin)
        assert times[0] <= origin
        assert times[-1] >= origin + 1e-3
        seen = np.interp([origin, origin + 15e-6, origin + 45e-6, origin + 1e-3], times, volts)
        np.testing.assert_allclose(seen, [1.0, 2.5, 2.0, 2.0])
    assert one_period(held.source, 0.0, np.zeros_like)[0].size == 0
    assert source_words(held) == "measured series, 3 rows to 0.03 ms, 2 V from there on"
    times, volts = corners(_series(*points, repeat=True).source, 0.0, 1e-4, np.zeros_like)
    np.testing.assert_allclose(np.interp([15e-6, 45e-6, 75e-6], times, volts), [2.5, 2.5, 2.5])
    assert Table[Annotated[float, Quantity("voltage")]](kind="table", points=points).rows == held.source.rows


def test_a_series_that_ends_where_it_began_is_one_period() -> None:
    """Repeat a series of 100 us every 100 us.

    A series that does not close gets one more step.
    """
    closed = _series(("0 us", "0 V"), ("25 us", "9 V"), ("75 us", "-9 V"), ("100 us", "0 V"), repeat=True)
    times, volts = corners(closed.source, 0.0, 2e-4, lambda t: t)
    np.testing.assert_allclose(times, [0.0, 25e-6, 75e-6, 100e-6, 125e-6, 175e-6, 200e-6], atol=1e-12)
    np.testing.assert_allclose(volts, [0.0, 9.0, -9.0, 0.0, 9.0, -9.0, 0.0])
    assert "repeated every 0.1 ms" in source_words(closed)
    opened = _series(("0 us", "0 V"), ("25 us", "9 V"), ("50 us", "3 V"), repeat=True)
    assert corners(opened.source, 0.0, 1e-5, lambda t: t)[0][-1] == pytest.approx(75e-6)


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("time [s],voltage [V]\n0,1\n1,2\n2,1\n3,1\n90,1\n", "line 6: a gap of 87 s"),
        ("time [s],voltage [V]\n0,1\n1,2\n1,1\n", "line 4: the times must increase"),
        ("time [s],voltage [V]\n\n0,1\n  \n1,2\n\n1,1\n", "line 7: the times must increase"),
        ("\ntime [s],voltage [V]\n\n0,1\n1,x\n2,2\n", "line 5"),
        ("time [s],voltage [V]\n0,1\n1,2\n", "at least three rows"),
        ("time,voltage\n0,1\n1,2\n2,3\n", "must name both columns with units"),
        ("time [s],voltage [A]\n0,1\n1,2\n2,3\n", "is not a unit of voltage"),
        ("time [s],voltage [V]\n0,1\n1,\n2,3\n", "line 3"),
        ('time [s],voltage [V]\n0,1\n"1,2\n' + 20000 * "2.0000,3\n", "single quote mark at character 1"),
    ],
)
def test_mistakes_in_a_series_are_named(text: str, words: str, tmp_path: Path) -> None:
    (tmp_path / "shaft.csv").write_text(text)
    with pytest.raises(CaseError) as caught:
        case_with({"series": {"file": "shaft.csv"}}, tmp_path)
    (problem,) = caught.value.problems
    assert problem.where == "electric.series"
    assert "shaft.csv" in problem.message
    assert words in problem.message


@pytest.mark.parametrize(
    ("changes", "where", "words"),
    [
        (["discharge.parameters.least_current=1 A"], "electric.breakdown.least_voltage", "must be above 10 V"),
        (["breakdown.law=field-strength"], "electric.breakdown.law", "available: statistical, field, particles"),
        (["discharge.law=resistence"], "electric.discharge.law", "nearest: resistance"),
        (["breakdown.parameters.strenght=20 V/um"], "electric.breakdown.parameters.strenght", "nearest: strength"),
        (["breakdown.parameters.strength=20"], "electric.breakdown.parameters.strength", "has no unit"),
        (["breakdown.parameters.strength=-2 V/um"], "electric.breakdown.parameters.strength", "greater than 0 V/um"),
        (["discharge.law=arc-voltage"], "electric.discharge.parameters.voltage", "is required"),
    ],
)
def test_mistakes_in_laws_are_named(changes: list[str], where: str, words: str) -> None:
    """Name the mistakes by `check` before any computation."""
    with pytest.raises(CaseError) as caught:
        api.check("6208-axial-1300", [f"electric.{change}" for change in changes])
    (problem,) = caught.value.problems
    assert problem.where == where
    assert words in problem.message
