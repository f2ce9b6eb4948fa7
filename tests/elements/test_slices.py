"""Test load over the slices of a roller.

Laminae and deflection matrix.
"""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from lambda_core.elements.roller import line_contact, profiles, slices
from lambda_core.elements.roller.slices import Elastic

MODULUS = 226e9
LENGTH, DIAMETER, COUNT = 12e-3, 11e-3, 30
X = slices.slice_positions(LENGTH, COUNT)
DROP = 2.0 * profiles.iso_cylindrical(X, LENGTH, DIAMETER)
BOTH = Elastic((4.6e-3, 6.4e-3), MODULUS)
ONE = Elastic((5e-3,), MODULUS)
MODELS = pytest.mark.parametrize("elastic", [None, BOTH], ids=["laminae", "matrix"])


@MODELS
@given(approach=st.floats(-2e-6, 3e-5), tilt=st.floats(-3e-3, 3e-3))
@settings(max_examples=40, deadline=None)
def test_tilt_mirrors_the_loads(elastic: Elastic | None, approach: float, tilt: float) -> None:
    there, back = (slices.slice_loads(approach, sign * tilt, DROP, LENGTH, elastic) for sign in (1.0, -1.0))
    largest = max(float(there.load), 1e-9)
    assert there.loads == pytest.approx(back.loads[::-1], abs=1e-9 * largest)
    assert float(there.load) == pytest.approx(float(back.load), abs=1e-9 * largest)
    assert float(there.moment) == pytest.approx(-float(back.moment), abs=1e-9 * largest * LENGTH)
    assert float(there.moment) * tilt >= -1e-9 * largest * LENGTH * abs(tilt)


@MODELS
def test_many_rollers_are_each_alone(elastic: Elastic | None) -> None:
    approach, tilt = np.linspace(-5e-6, 3e-5, 12).reshape(3, 4), np.linspace(-2e-3, 2e-3, 12).reshape(3, 4)
    found = slices.slice_loads(approach, tilt, DROP, LENGTH, elastic)
    assert found.loads.shape == (3, 4, COUNT)
    for place in np.ndindex(3, 4):
        alone = slices.slice_loads(float(approach[place]), float(tilt[place]), DROP, LENGTH, elastic)
        assert found.loads[place] == pytest.approx(alone.loads, rel=1e-9, abs=1e-9)


@MODELS
def test_a_roller_out_of_contact_carries_nothing(elastic: Elastic | None) -> None:
    found = slices.slice_loads(-1e-6, 0.0, DROP, LENGTH, elastic)
    assert float(found.load) == 0.0
    assert float(found.moment) == 0.0


@MODELS
def test_the_approach_at_a_load_carries_it(elastic: Elastic | None) -> None:
    approach = slices.approach_at_load(2000.0, 1e-3, DROP, LENGTH, elastic)
    assert float(slices.slice_loads(approach, 1e-3, DROP, LENGTH, elastic).load) == pytest.approx(2000.0, rel=1e-9)


@given(approach=st.floats(1e-6, 3e-5), tilt=st.floats(-3e-3, 3e-3))
@settings(max_examples=30, deadline=None)
def test_slices_press_or_gape(approach: float, tilt: float) -> None:
    """Find neither tension nor overlap.

    q >= 0, gap >= 0, and one of both is zero.
    """
    found = slices.elastic_loads(approach, tilt, DROP, LENGTH, BOTH)
    deflected = slices.deflection_matrix(found.loads[None, :], X, BOTH)[0] @ found.loads
    gap = deflected - (approach - X * math.tan(tilt) - DROP)
    assert np.all(found.loads >= 0.0)
    assert np.all(gap >= -1e-9 * approach)
    assert np.all(np.abs(gap[found.loads > 0.0]) <= 1e-9 * approach)


def test_a_slice_that_barely_touches_settles() -> None:
    # the edge slice carries 2e-6 of the largest: its rounding is no change of the loads
    length, count = 0.03585437627059061, 50
    elastic = Elastic((0.017959701656029614,), MODULUS)
    found = slices.elastic_loads(4.93804948e-05, -0.00281083, np.zeros(count), length, elastic)
    assert 0.0 < found.loads[found.loads > 0.0].min() < 1e-5 * found.loads.max()


def test_strips_deflect_as_a_finite_hertz_line() -> None:
    # an even load on a half space without images: the middle has Lundberg's approach
    count, load = 90, 2000.0
    x = slices.slice_positions(LENGTH, count)
    even = np.full(count, load / count)
    matrix = slices.deflection_matrix(even[None, :], x, Elastic((5e-3,), MODULUS, images=0.0))[0]
    middle = 0.5 * float((matrix @ even)[count // 2 - 1 : count // 2 + 1].sum())
    assert middle == pytest.approx(line_contact.finite_line_approach(load, LENGTH, 5e-3, MODULUS), rel=2e-4)


def test_far_strips_act_as_point_loads() -> None:
    matrix = slices.deflection_matrix(np.full((1, COUNT), 50.0), X, Elastic((5e-3,), MODULUS, images=0.0))[0]
    assert matrix[0, -1] == pytest.approx(2.0 / (math.pi * MODULUS * (X[-1] - X[0])), rel=1e-3)


def test_long_rollers_without_profile_have_hertz_pressure() -> None:
    # 60 mm without profile: no edge; the middle differs from Hertz by what the end images leave
    length, count, load = 60e-3, 60, 10e3
    drop = np.zeros(count)
    approach = slices.approach_at_load(load, 0.0, drop, length, ONE)
    found = slices.elastic_loads(approach, 0.0, drop, length, ONE)
    pressure = line_contact.peak_pressure(found.loads / (length / count), 5e-3, MODULUS)
    assert pressure == pytest.approx(line_contact.peak_pressure(load / length, 5e-3, MODULUS), rel=0.005)


def test_radii_may_vary_along_the_roller() -> None:
    even = slices.elastic_loads(2e-5, 0.0, DROP, LENGTH, ONE)
    same = slices.elastic_loads(2e-5, 0.0, DROP, LENGTH, Elastic((np.full(COUNT, 5e-3),), MODULUS))
    taper = slices.elastic_loads(2e-5, 0.0, DROP, LENGTH, Elastic((5e-3 + 0.05 * X,), MODULUS))
    assert same.loads == pytest.approx(even.loads, rel=1e-12)
    # a larger radius has a larger half width, and so a stiffer slice: the thick end, x > 0, carries more
    thick, thin = taper.loads[COUNT // 2 :], taper.loads[: COUNT // 2][::-1]
    assert np.all(thick[thin > 0.0] > thin[thin > 0.0])


def test_images_remove_the_false_edges() -> None:
    drop, load = np.zeros(COUNT), 2000.0
    edges = []
    for images in (1.0, 0.5, 0.0):
        elastic = Elastic((5e-3,), MODULUS, images)
        approach = slices.approach_at_load(load, 0.0, drop, LENGTH, elastic)
        edges.append(float(slices.elastic_loads(approach, 0.0, drop, LENGTH, elastic).loads[0]) / (load / COUNT))
    assert edges[0] == pytest.approx(1.0, abs=0.02)
    assert 1.02 < edges[1] < edges[2]
    assert edges[2] > 1.3


@pytest.mark.parametrize("tilt", [0.0, 2e-3])
def test_thirty_slices_suffice(tilt: float) -> None:
    found = []
    for count in (30, 200):
        x = slices.slice_positions(LENGTH, count)
        drop = 2.0 * profiles.iso_cylindrical(x, LENGTH, DIAMETER)
        found.append(slices.elastic_loads(20e-6, tilt, drop, LENGTH, BOTH))
    assert float(found[0].load) == pytest.approx(float(found[1].load), rel=1e-3)
    assert float(found[0].moment) == pytest.approx(float(found[1].moment), rel=5e-3, abs=1e-9)
