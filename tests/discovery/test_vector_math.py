"""Test vectorisable exp, log1p and asinh against the C library."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numba import float64, njit

from lambda_core.laws import vector_math
from lambda_core.laws.jit.machine_code import OPTIONS, make_callable
from lambda_core.laws.jit.reach import reach

EPS = np.finfo(float).eps


@given(st.floats(-690.0, 690.0))
def test_exp(x: float) -> None:
    assert vector_math.exp(x) == pytest.approx(math.exp(x), rel=3 * EPS)


@given(st.floats(0.0, 1e290, allow_subnormal=False))
def test_log1p(d: float) -> None:
    assert vector_math.log1p(d) == pytest.approx(math.log1p(d), rel=4 * EPS, abs=0.0)


@given(st.floats(1e-290, 1e290))
def test_log(x: float) -> None:
    # near 1 the argument x has digits that its logarithm feels one to one
    assert vector_math.log(x) == pytest.approx(math.log(x), rel=4 * EPS, abs=EPS)


@given(st.floats(1e-100, 1e100), st.floats(-3.0, 3.0))
def test_power(x: float, y: float) -> None:
    assert vector_math.power(x, y) == pytest.approx(x**y, rel=(4 + 4 * abs(y * math.log(x))) * EPS)


@pytest.mark.parametrize("x", [-1.0, 0.0, math.inf, math.nan])
def test_log_of_what_has_none(x: float) -> None:
    assert math.isnan(vector_math.log(x))


@given(st.floats(0.0, 1e140, allow_subnormal=False))
def test_asinh(y: float) -> None:
    assert vector_math.asinh(y) == pytest.approx(math.asinh(y), rel=6 * EPS, abs=1e-300)


@pytest.mark.parametrize("split", [math.sqrt(2.0) - 1.0, 1.0, 3.0, 0.0, 1e-300])
def test_no_step_where_the_exponent_changes(split: float) -> None:
    around = split * np.array([1.0 - 4 * EPS, 1.0 - EPS, 1.0, 1.0 + EPS, 1.0 + 4 * EPS])
    values = np.array([vector_math.log1p(d) for d in around])
    assert np.all(np.abs(values - np.log1p(around)) <= 4 * EPS * np.log1p(around))


def test_compiled_equals_plain_and_nan_stays_nan() -> None:
    for function in (vector_math.log1p, vector_math.exp):
        make_callable(reach(function).helpers)
    log1p = njit(float64(float64), **OPTIONS)(vector_math.log1p)
    exp = njit(float64(float64), **OPTIONS)(vector_math.exp)
    for x in np.random.default_rng(1).uniform(-50.0, 50.0, 2000):
        assert exp(x) == pytest.approx(vector_math.exp(x), rel=4 * EPS)
        assert log1p(abs(x)) == pytest.approx(vector_math.log1p(abs(x)), rel=4 * EPS)
    assert math.isnan(exp(math.nan))
    assert math.isnan(log1p(math.nan))
