"""Test tables over time.

The curve stays between its points, or is a spline whose extremes are known and told.
"""

from __future__ import annotations

import tomllib
from collections.abc import Callable
from itertools import pairwise
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from lambda_core import api
from lambda_core.case.pairs import read_pairs
from lambda_core.fitting.measurements import read_measurements
from lambda_core.model.bearing_model import TableTerm, TimeFunction
from lambda_core.model.laws.time_functions import initial, peak, scaled
from lambda_core.model.machine_templates import shaft_text
from lambda_core.model.resolve_machine import resolve_machine
from lambda_core.solver import records as R
from lambda_core.solver.drivers.time_tables import add_terms
from lambda_core.solver.motion.prescribed import _spline
from lambda_core.studies.load_spectrum import read_spectrum

PULSE = [["0 ms", "0 N"], ["2 ms", "0 N"], ["2.5 ms", "30 N"], ["3 ms", "0 N"], ["100 ms", "0 N"]]
MODES = ("monotone", "spline")
ROUNDING = 1e-11


def course(function: TimeFunction) -> Callable[[float], tuple[float, float]]:
    """Return value and rate over time [s].

    By the solver's own code, not compiled.
    """
    rows: list[Any] = []
    table: list[float] = []
    add_terms(0, function, rows, table)
    assert all(row["kind"] == R.TABLE for row in rows)

    def at(t: float) -> tuple[float, float]:
        found = SimpleNamespace(value=0.0, rate=0.0, acceleration=0.0)
        for (row,) in rows:
            _spline.py_func(t, table, int(row["start"]), int(row["knots"]), found)
        return found.value, found.rate

    return at


@st.composite
def tables(draw: st.DrawFn, interpolation: str | None = None) -> TableTerm:
    """Draw points in time with values.

    Some times close together, many values alike.
    """
    gaps = draw(st.lists(st.floats(1e-6, 10.0), min_size=1, max_size=9))
    times = np.cumsum([draw(st.floats(-5.0, 5.0)), *gaps])
    numbers = st.floats(-1e6, 1e6).filter(lambda number: abs(number) > 1e-12) | st.sampled_from([0.0, 1.0, -1.0])
    values = draw(st.lists(numbers, min_size=len(times), max_size=len(times)))
    points = tuple(float(number) for pair in zip(times, values, strict=True) for number in pair)
    return TableTerm("table", points, interpolation or draw(st.sampled_from(MODES)))  # type: ignore[arg-type]


@settings(max_examples=80, deadline=None)
@given(tables("monotone"), st.lists(st.floats(0.0, 1.0), min_size=5, max_size=5))
def test_a_table_stays_between_neighbouring_points(term: TableTerm, shares: list[float]) -> None:
    function, times, values = TimeFunction((term,)), term.values[0::2], term.values[1::2]
    at, slack = course(function), ROUNDING * max(map(abs, values))
    for i, (begin, end) in enumerate(pairwise(times)):
        low, high = sorted(values[i : i + 2])
        for share in shares:
            found, _ = at(min(begin + share * (end - begin), end))
            assert low - slack <= found <= high + slack
    assert (at(times[0] - 1.0)[0], at(times[-1] + 1.0)[0]) == (values[0], values[-1])


@settings(max_examples=80, deadline=None)
@given(tables(), st.sampled_from([-2.5, -1e-6, 0.0, 1.0, 1e3]))
def test_peak_bounds_every_table(term: TableTerm, factor: float) -> None:
    function = scaled(TimeFunction((term,)), factor)
    bound, at, times = peak(function), course(function), term.values[0::2]
    grid = np.unique(np.concatenate([np.linspace(a, b, 21) for a, b in pairwise(times)]))
    largest = max(abs(at(float(t))[0]) for t in grid)
    assert largest <= bound * (1.0 + 1e-9)


@settings(deadline=None)
@given(tables())
def test_the_value_at_the_start_is_the_one_that_the_run_begins_with(term: TableTerm) -> None:
    function = TimeFunction((term,))
    assert initial(function) == pytest.approx(course(function)(0.0)[0], rel=1e-9, abs=1e-9 * peak(function))


@settings(deadline=None)
@given(tables().filter(lambda term: len(term.values) > 4))
def test_the_rate_has_no_jump(term: TableTerm) -> None:
    """Find one velocity at every point of a table.

    The first and last points are included.
    """
    function, times, values = TimeFunction((term,)), np.array(term.values[0::2]), np.array(term.values[1::2])
    at, steepest = course(function), np.abs(np.diff(values) / np.diff(times)).max()
    for t in times:
        gap = 1e-9 * np.diff(times).min()
        before, after = (at(float(t + side * gap))[1] for side in (-1.0, 1.0))
        assert abs(after - before) <= 1e-5 * steepest + 1e-9


def test_a_pulse_stays_a_pulse() -> None:
    """Keep an interpolated pulse between its points.

    It went to -1327 N: a load of 30 N took 1500 N off a bearing.
    """
    model = api.check("6208-axial-1300", ["loads.axial=1.5 kN", f'loads.radial={{kind = "table", points = {PULSE}}}'])
    down = scaled(model.inner_ring.force[2], -1.0)
    at = course(down)
    load = [at(t)[0] for t in np.linspace(0.0, 0.11, 1101)]
    assert min(load) == 0.0
    assert max(load) == pytest.approx(30.0)
    assert load.index(max(load)) == 25
    assert np.count_nonzero(load) == 9  # 2.1 to 2.9 ms, and nothing rings on
    assert peak(down) == 30.0
    assert not any("points" in warning for warning in api.describe(model).warnings)


@pytest.mark.parametrize("is_summand", [False, True])
def test_a_spline_says_where_it_leaves_its_points(is_summand: bool) -> None:
    table = f'{{kind = "table", interpolation = "spline", points = {PULSE}}}'
    signal = f'{{kind = "sum", terms = ["1 N", {table}]}}' if is_summand else table
    model = api.check("6208-axial-1300", [f"loads.radial={signal}"])
    (sentence,) = (warning for warning in api.describe(model).warnings if "spline" in warning)
    assert sentence.startswith("loads.radial.terms.1: " if is_summand else "loads.radial: ")
    assert "-1.327 kN at 35.33 ms" in sentence
    assert "0 N to 30 N" in sentence
    assert 'leave out interpolation = "spline"' in sentence
    assert peak(model.inner_ring.force[2]) == pytest.approx(1327.11 + is_summand, abs=0.01)


def test_a_spline_through_a_well_sampled_sine_is_silent() -> None:
    """Accept crests between the points of a sine.

    The table has 32 points per period, none of them on a crest.
    """
    times = np.arange(65) / 32.0
    points = [[f"{t} s", f"{np.sin(2.0 * np.pi * (t - 1.0 / 64.0)):.9f} kN"] for t in times]
    model = api.check("6208-axial-1300", [f'loads.radial={{kind="table", interpolation="spline", points={points}}}'])
    assert peak(model.inner_ring.force[2]) == pytest.approx(1000.0, rel=1e-3)
    assert not any("spline" in warning for warning in api.describe(model).warnings)


def test_a_shaft_says_where_a_spline_leaves_its_points() -> None:
    table = {"kind": "table", "interpolation": "spline", "points": PULSE}
    speed = {**table, "points": [["0 s", "1000 rpm"], ["1 s", "1000 rpm"], ["1.1 s", "2000 rpm"], ["3 s", "2000 rpm"]]}
    case = tomllib.loads(shaft_text("geared-shaft", "box")) | {"loads": {"kick": {"at": "85 mm", "force_z": table}}}
    del case["gears"]  # whose power asks for a constant speed
    case["operation"] = {**case["operation"], "speed": speed}
    told = [sentence for sentence in api.model_warnings(resolve_machine(case)) if "spline" in sentence]
    assert [sentence.split(": ")[0] for sentence in told] == ["operation.speed", "loads.kick.force_z"]
    assert "-1.327 kN at 35.33 ms" in told[1]


def test_every_csv_file_is_read_by_the_same_rules(tmp_path: Path) -> None:
    """Read comments and semicolons in every CSV file.

    Tables of loads and voltages accepted neither; measurements and spectra did.
    """
    rows = "\ufeff# bench 3\n\ntime [ms];{} [{}]\n0;1\n# a pause\n5 ; 2\n10;3\n"
    (tmp_path / "load.csv").write_text(rows.format("load", "kN"), encoding="utf-8")
    (tmp_path / "volts.csv").write_text(rows.format("voltage", "V"), encoding="utf-8")
    (tmp_path / "phases.csv").write_text(rows.format("operation.speed", "rpm"), encoding="utf-8")
    (tmp_path / "rig.csv").write_text(
        rows.format("friction torque", "N mm").replace("time [ms]", "speed [rpm]"), encoding="utf-8"
    )
    assert read_pairs(tmp_path / "load.csv", "force").points == ((0.0, 1e3), (5e-3, 2e3), (10e-3, 3e3))
    assert read_pairs(tmp_path / "volts.csv", "voltage").points == ((0.0, 1.0), (5e-3, 2.0), (10e-3, 3.0))
    assert read_measurements(tmp_path / "rig.csv").lines == (4, 6, 7)
    with pytest.raises(api.CaseError, match=r'line 4, time +"0" must be greater than 0'):
        read_spectrum(tmp_path / "phases.csv")
