"""Test unit strings.

What is read, what is refused and with which advice, and that writing is exact.
"""

from __future__ import annotations

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from lambda_core.domain.units import UNITS, parse, show


@pytest.mark.parametrize(
    ("text", "quantity", "expected"),
    [
        ("16 kN", "force", 16e3),
        ("0.1 um", "small_length", 1e-7),
        ("100 nm", "small_length", 1e-7),
        ("3000 rpm", "rotational_speed", 3000.0 * math.pi / 30.0),
        ("3000 1/min", "rotational_speed", 3000.0 * math.pi / 30.0),
        ("3000 min^-1", "rotational_speed", 3000.0 * math.pi / 30.0),
        ("62.5 degC", "temperature", 335.65),
        ("62.5 °C", "temperature", 335.65),
        ("14 µm", "small_length", 14e-6),
        ("20.4 1/GPa", "pressure_viscosity", 20.4e-9),
        ("1.5e-3 N·m", "moment", 1.5e-3),
        ("  -9.81   m/s² ", "acceleration", -9.81),
        ("2 g", "acceleration", 19.6133),
    ],
)
def test_reads_si(text: str, quantity: str, expected: float) -> None:
    assert parse(text, quantity) == pytest.approx(expected, rel=1e-15)


@pytest.mark.parametrize(
    ("text", "quantity", "advice"),
    [
        ("16,5 kN", "force", 'write a decimal point: "16.5 kN"'),
        ("0,125 kN", "force", 'write a decimal point: "0.125 kN"'),
        ("6,000 rpm", "rotational_speed", 'two ways: write "6000 rpm" or "6.000 rpm", without a comma'),
        ("2,500 N", "force", 'two ways: write "2500 N" or "2.500 N", without a comma'),
        ("2,500", "force", 'two ways: write "2500 N" or "2.500 N", without a comma'),
        ("-12,000 rpm", "rotational_speed", '"-12000 rpm" or "-12.000 rpm"'),
        ("1,234.5 N", "force", 'write the digits together: "1234.5 N"'),
        ("1,000,000 rpm", "rotational_speed", 'write the digits together: "1000000 rpm"'),
        ("6 000 rpm", "rotational_speed", 'write the digits together: "6000 rpm"'),
        ("6'000 rpm", "rotational_speed", 'write the digits together: "6000 rpm"'),
        (16, "force", 'has no unit: write "16 N"'),
        (float("nan"), "inertia", 'must be a finite number with its unit, for example "1 kg m2"'),
        (10**400, "force", 'must be a finite number with its unit, for example "1 N"'),
        ("16", "force", 'has no unit: write "16 N"'),
        (6e6, "pressure", 'has no unit: write "6e+06 Pa"'),
        ("6e6", "pressure", 'has no unit: write "6e6 Pa"'),
        (2e-5, "small_length", 'has no unit: write "2e-05 m"'),
        (14, "small_length", 'has no unit: write "14 um"'),
        ("16 rpm", "force", "rpm is not a unit of force; allowed: N, kN, MN"),
        ("50 Hz", "rotational_speed", "Hz is not a unit of rotational_speed"),
        ("16 KN", "force", "did you mean kN?"),
        ("-300 degC", "temperature", "absolute zero"),
        ("1e999 N", "force", "not a finite number"),
        ("1e9999999999999999999 N", "force", "not a finite number"),
        ("much", "force", "is not a number with a unit"),
        (True, "force", "expected a force with its unit"),
        (None, "force", "expected a force with its unit"),
        (None, "angle", "expected an angle with its unit"),
        (None, "rotational_speed", "expected a rotational speed with its unit"),
        ("1.234,5 N", "force", "is not"),
    ],
)
def test_refuses_with_advice(text: object, quantity: str, advice: str) -> None:
    with pytest.raises(ValueError, match=r".+") as caught:
        parse(text, quantity)
    assert advice in str(caught.value)


@given(st.floats(allow_nan=False, allow_infinity=False), st.sampled_from(sorted(UNITS)))
def test_written_value_reads_back_equal(value: float, quantity: str) -> None:
    value = abs(value) + 1.0 if quantity == "temperature" else value
    if math.isfinite(value):
        assert parse(show(value, quantity), quantity) == value


@pytest.mark.parametrize(
    ("value", "quantity", "text"),
    [
        (16e3, "force", "16 kN"),
        (700.0, "force", "700 N"),
        (2750.0 * (math.pi / 30.0), "rotational_speed", "2750 rpm"),
        (335.65, "temperature", "62.5 degC"),
        (0.0, "force", "0 N"),
        (14e-6, "small_length", "14 um"),
        (1e-7, "small_length", "0.1 um"),
    ],
)
def test_writes_the_unit_people_use(value: float, quantity: str, text: str) -> None:
    assert show(value, quantity) == text
