"""Test study files.

Points as written, and everything that is refused with a sentence.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from lambda_core.domain.errors import CaseError
from lambda_core.domain.written_values import scale_of
from lambda_core.studies.definition import parse_study, study_json_schema
from lambda_core.studies.design import Plan

HEAD = 'name = "s"\ncase = "6319-cp10-1500"\n'


def plan(*parameters: str, head: str = HEAD, tail: str = "") -> Plan:
    return Plan(parse_study(head + "".join(f"[[parameters]]\n{text}\n" for text in parameters) + tail))


SPEED = 'path = "operation.speed"\nrange = ["500 rpm", "3000 rpm"]\npoints = 6'
LOAD = 'path = "loads.radial"\nvalues = ["16 kN", "24600 N", 20]'


def test_crossed_points_take_every_combination_in_order() -> None:
    found = plan(SPEED, 'path = "loads.radial"\nvalues = ["16 kN", "24600 N"]')
    assert found.count == 12
    points = list(found.points())
    assert [p.coordinates for p in points[:3]] == [(500.0, 16.0), (500.0, 24.6), (1000.0, 16.0)]
    assert points[1].changes == ("operation.speed=500 rpm", "loads.radial=24600 N")
    assert points[-1].coordinates == (3000.0, 24.6)
    assert len({p.changes for p in points}) == 12


def test_zipped_points_go_in_step() -> None:
    found = plan(SPEED, 'path = "loads.radial"\nrange = ["1 kN", "6 kN"]\npoints = 6', tail='[design]\nkind = "zipped"')
    assert [p.coordinates for p in found.points()] == [(500.0 * (i + 1), 1.0 + i) for i in range(6)]


def test_logarithmic_ranges_rise_by_equal_factors_and_end_exactly() -> None:
    found = plan('path = "a.b"\nrange = ["0.1 um", "100 um"]\npoints = 4\nspacing = "log"')
    assert [p.coordinates[0] for p in found.points()] == pytest.approx([0.1, 1.0, 10.0, 100.0], rel=1e-9)
    assert found.point(3).changes == ("a.b=100 um",)


def test_names_and_switches_are_entries_of_the_table() -> None:
    found = plan(
        'path = "models.traction"\nvalues = ["ree-eyring", "newtonian"]', 'path = "depth.cage"\nvalues = [true, false]'
    )
    points = list(found.points())
    assert points[0].coordinates == ("ree-eyring", "true")
    assert points[3].changes == ("models.traction=newtonian", "depth.cage=false")


@pytest.mark.parametrize("kind", ["latin-hypercube", "sobol"])
def test_samples_fill_the_range_and_repeat(kind: str) -> None:
    ranges = ('path = "a.x"\nrange = [1, 3]', 'path = "a.y"\nrange = ["10 N", "1 kN"]\nspacing = "log"')
    design = f'[design]\nkind = "{kind}"\nsamples = 16\nseed = 5'
    one, two = plan(*ranges, tail=design), plan(*ranges, tail=design)
    assert [p.changes for p in one.points()] == [p.changes for p in two.points()]
    values = np.array([p.coordinates for p in one.points()], float)
    x, y = (values[:, 0] - 1.0) / 2.0, np.log10(values[:, 1] / 10.0) / 2.0
    for share in (x, y):  # one sample in each sixteenth
        assert sorted(np.floor(share * 16).astype(int)) == list(range(16))
    assert plan(*ranges, tail=design.replace("5", "6")).point(0).changes != one.point(0).changes


def test_a_saltelli_design_mixes_columns() -> None:
    ranges = ('path = "a.x"\nrange = [0, 1]', 'path = "a.y"\nrange = [0, 1]')
    values = np.array([p.coordinates for p in plan(*ranges, tail='[design]\nkind = "saltelli"\nsamples = 8').points()])
    a, b, ab = values[:8], values[8:16], values[16:].reshape(2, 8, 2)
    np.testing.assert_array_equal(ab[0], np.stack([b[:, 0], a[:, 1]], axis=1))
    np.testing.assert_array_equal(ab[1], np.stack([a[:, 0], b[:, 1]], axis=1))


@given(
    first=st.floats(-1e6, 1e6).filter(lambda x: abs(x) > 1e-3),
    factor=st.floats(1.01, 1e3),
    points=st.integers(2, 40),
)
def test_ranges_are_monotonic_and_keep_their_ends(first: float, factor: float, points: int) -> None:
    last = first * factor
    found = plan(f'path = "a.b"\nrange = ["{first!r} N", "{last!r} N"]\npoints = {points}')
    values = [p.coordinates[0] for p in found.points()]
    assert values[0] == pytest.approx(first, rel=1e-9)
    assert values[-1] == pytest.approx(last, rel=1e-9)
    steps = np.diff(np.array(values, float)) * math.copysign(1.0, first)
    assert (steps >= 0.0).all()


def test_values_share_one_unit() -> None:
    found = scale_of(["0.5 mm", "30 um"])
    assert found is not None
    assert found[0].unit == "mm"
    assert found[1] == pytest.approx((0.5, 0.03))
    assert scale_of(["20 degC", "293.15 K"])[1] == pytest.approx((20.0, 20.0))  # type: ignore[index]
    assert scale_of(["C3", "CN"]) is None


@pytest.mark.parametrize(
    ("parameters", "words"),
    [
        (['path = "a"\nvalues = []'], "empty list"),
        (['path = "a"\nrange = [1, 1]\npoints = 3'], "the range is empty"),
        (['path = "a"\nrange = ["500 rpm", "500 1/min"]\npoints = 3'], "the range is empty"),
        (['path = "a"\nrange = ["1 kN", "3000 rpm"]\npoints = 3'], '"1 kN" and "3000 rpm" have no unit in common'),
        ([LOAD], '"20" has no unit, others have'),
        (['path = "a"\nrange = ["1,5 kN", "2 kN"]\npoints = 2'], 'write a decimal point: "1.5 kN"'),
        (['path = "a"\nrange = ["1,500 rpm", "2 rpm"]\npoints = 2'], 'write "1500 rpm" or "1.500 rpm"'),
        (['path = "a"\nrange = ["low", "high"]\npoints = 2'], "are not numbers"),
        (['path = "a"\nrange = [1, 2]'], "points = 10"),
        (['path = "a"\nrange = [1, 2]\npoints = 0'], "points"),
        (['path = "a"\nrange = [1, 2]\npoints = 1'], "at least two points"),
        (['path = "a"\nrange = [-1, 2]\npoints = 4\nspacing = "log"'], "needs positive ends"),
        (['path = "a"'], "either values or a range"),
        (['path = "a"\nvalues = [1]\nrange = [1, 2]'], "either values or a range"),
        (['path = "a"\nvalues = [1, 2]', 'path = "a"\nvalues = [3, 4]'], "a is varied twice"),
        (['path = "a"\nvalues = [1]\nstep = 3'], "step is not a known option"),
        (['path = "a"\nvalues = ["1 kN", "2 kN", "1000 N"]'], "1 kN and 1000 N are equal: give every value once"),
        (['path = "a"\nvalues = ["b", "c", "b"]'], "b stands twice: give every value once"),
        (['path = "a"\nvalues = ["1 kN", "nan kN"]'], '"nan kN" is not a finite number'),
        (['path = "a"\nvalues = [1.0, nan]'], "nan is not a finite number"),
        (['path = "a"\nrange = [1.0, inf]\npoints = 3'], "inf is not a finite number"),
        (['path = "a"\nvalues = ["1 kN", "low"]'], '"low" is not a number with a unit, others are'),
    ],
)
def test_parameters_without_sense_are_refused(parameters: list[str], words: str) -> None:
    with pytest.raises(CaseError) as caught:
        plan(*parameters)
    text = str(caught.value).replace('"step"', "step").replace("parameters.0.step", "step")
    assert words in " ".join(text.split())


def test_a_table_among_fixed_changes_is_one_mistake() -> None:
    with pytest.raises(CaseError, match="observers is no single value: write a line for each option") as caught:
        plan(SPEED, tail="[set]\nobservers = { dose = { every = 1 } }")
    assert len(caught.value.problems) == 1


@pytest.mark.parametrize(
    ("tail", "words"),
    [
        ('[design]\nkind = "sobol"\nsamples = 100', "64 or 128 samples"),
        ('[design]\nkind = "sobol"', "the number of samples is required for sobol"),
        ("[design]\nsamples = 8", "`samples` is not allowed for a crossed design"),
        ('[design]\nkind = "latin-hypercube"\nsamples = 8', "`points` is not allowed for a latin-hypercube design"),
        ('[design]\nkind = "optimise"', "needs both"),
        (
            '[design]\nkind = "optimise"\n[optimise]\nminimise = "x"\n'
            'constraints = [{ response = "y", at_least = 5.0, at_most = 3.0 }]',
            "no value is at least 5 and at most 3",
        ),
        ('[design]\nkind = "random"', "random"),
    ],
)
def test_designs_without_sense_are_refused(tail: str, words: str) -> None:
    with pytest.raises(CaseError) as caught:
        plan(SPEED, tail=tail)
    assert words in str(caught.value)


def test_zipped_parameters_of_different_length_are_refused() -> None:
    with pytest.raises(CaseError, match=r"operation\.speed 6, loads\.radial 2"):
        plan(SPEED, 'path = "loads.radial"\nvalues = ["1 kN", "2 kN"]', tail='[design]\nkind = "zipped"')


def test_no_study_has_more_than_a_million_points() -> None:
    with pytest.raises(CaseError, match=r"max_points\s+2000000: must be at most"):
        plan(SPEED, head=HEAD + "max_points = 2000000\n")


def test_a_value_may_stand_twice_in_step() -> None:
    """Repeat a value of zipped parameters.

    It may come again with another value of the other parameter.
    """
    found = plan('path = "a"\nvalues = [1, 1, 2]', 'path = "b"\nvalues = [3, 4, 3]', tail='[design]\nkind = "zipped"')
    assert [point.coordinates for point in found.points()] == [(1.0, 3.0), (1.0, 4.0), (2.0, 3.0)]


def test_a_billion_points_are_counted_without_being_made() -> None:
    parameter = 'range = [0.0, 1.0]\npoints = 1000\npath = "a.{}"'
    found = plan(*(parameter.format(name) for name in "xyz"))
    assert found.count == 10**9
    assert found.point(10**9 - 1).coordinates == (1.0, 1.0, 1.0)


def test_the_schema_of_study_files_names_every_option() -> None:
    schema: dict[str, Any] = study_json_schema()
    assert {"case", "mode", "parameters", "design", "responses", "optimise"} <= set(schema["properties"])
