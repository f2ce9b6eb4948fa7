"""Compare catalogue friction models with printed values."""

from __future__ import annotations

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st
from lambda_plugins.methods.schaeffler import idle_torque, load_torque
from lambda_plugins.methods.skf import (
    SERIES,
    SKF,
    continuous_sliding,
    load_variables,
    series_constants,
    skf_friction,
)
from lambda_plugins.methods.skf_drag import drag_torque, drag_torque_2008
from lambda_plugins.methods.skf_seals import SEALS, seal_torque, seals_of

from .published import Published

RPM = math.pi / 30.0


def fva3(celsius: float) -> float:
    """Return the viscosity of FVA3 [m2/s].

    Kinematic: Vogel and density of Wingertszahn et al. 2023, table A1.
    """
    dynamic = 0.062e-3 * math.exp(1021.7 / (celsius + 101.5517))
    return dynamic / (887.6 - 0.6 * (celsius - 15.0))


# Syla et al. 2026, table 4, row "SKF-Catalogue" [N mm]: C/P with C = 160 kN, speed [1/min]
TABLE_4 = [
    (10.0, 500.0, 814.0),
    (10.0, 1500.0, 1190.0),
    (10.0, 3000.0, 1380.0),
    (6.5, 500.0, 1330.0),
    (6.5, 1500.0, 1720.0),
    (6.5, 3000.0, 2000.0),
]


def _torque_6319(ratio: float, speed: float, celsius: float, volume_factor: float) -> float:
    result = skf_friction(
        "63",
        0.095,
        0.2,
        160e3 / ratio,
        0.0,
        speed * RPM,
        fva3(celsius),
        oil_height=0.015,
        volume_factor=volume_factor,
    )
    return result.total * 1e3


@pytest.mark.parametrize(("ratio", "speed", "value"), TABLE_4)
def test_skf_row_of_table_4(ratio: float, speed: float, value: float) -> None:
    source = "Syla et al. 2026, table 4, SKF-Catalogue"
    reason = "oil temperature (62.5 degC taken) and V_M of that row are not printed"
    Published(value, source, reason, rel=0.07).check(_torque_6319(ratio, speed, 62.5, 0.0))
    Published(value, source, reason, rel=0.05).check(_torque_6319(ratio, speed, 62.5, 4.5e-5))


def test_temperature_that_explains_the_skf_row() -> None:
    """Find 60 to 63 degC by least squares.

    Six points, for every V_M that is not excluded.
    """
    for volume_factor in (0.0, 2.25e-5, 4.5e-5):
        temperatures = [50.0 + 0.25 * step for step in range(101)]
        best = min(
            temperatures,
            key=lambda t: sum((_torque_6319(r, n, t, volume_factor) / m - 1.0) ** 2 for r, n, m in TABLE_4),
        )
        assert 59.9 <= best <= 63.1
        error = [_torque_6319(r, n, best, volume_factor) / m - 1.0 for r, n, m in TABLE_4]
        assert max(abs(e) for e in error) < 0.05


def test_constant_coefficient_estimate() -> None:
    # SKF catalogue: M = 0.5 mu P d with mu = 0.0015 for deep-groove ball bearings at P about 0.1 C and good lubrication
    estimate = 0.5 * 0.0015 * 16e3 * 95.0
    reason = "the catalogue calls it an estimate for 0.1 C, good lubrication and normal conditions"
    Published(estimate, "SKF, Rolling bearings, table of constant coefficients", reason, rel=0.1).check(
        _torque_6319(10.0, 1500.0, 62.5, 0.0)
    )


@pytest.mark.parametrize("series", SERIES)
@pytest.mark.parametrize(("radial", "axial"), [(3000.0, 0.0), (3000.0, 900.0), (0.0, 900.0)])
def test_second_evaluation_of_the_skf_model(series: str, radial: float, axial: float) -> None:
    """Type the catalogue's formulas a second time.

    In logarithms, in mm, N, 1/min and mm2/s.
    """
    d, outer, c0, n, nu = 40.0, 80.0, 19000.0, 2400.0, 23.0
    dm = (d + outer) / 2.0
    r1, r2, s1, s2 = {
        "60": (4.1e-7, 1.7, 3.73e-3, 14.6),
        "62": (3.9e-7, 1.7, 3.23e-3, 36.5),
        "63": (3.7e-7, 1.7, 2.84e-3, 92.8),
        "64": (3.6e-7, 1.7, 2.43e-3, 198.0),
        "618": (4.7e-7, 1.7, 6.5e-3, 0.78),
        "619": (4.3e-7, 1.7, 4.75e-3, 3.6),
    }[series]
    log = math.log
    if axial:
        sine = math.sin(24.6 * (axial / c0) ** 0.24 * math.pi / 180.0)
        grr = math.exp(log(r1) + 1.96 * log(dm) + 0.54 * log(radial + r2 / sine * axial))
        gsl = math.exp(log(s1) - 0.145 * log(dm) + log(radial**5 + s2 * dm**1.5 / sine * axial**4) / 3.0)
    else:
        grr = math.exp(log(r1) + 1.96 * log(dm) + 0.54 * log(radial))
        gsl = math.exp(log(s1) - 0.26 * log(dm) + 5.0 / 3.0 * log(radial))
    inlet = 1.0 + math.exp(log(1.84e-9) + 1.28 * log(n * dm) + 0.64 * log(nu))
    starved = 3e-8 * nu * n * (d + outer) * math.sqrt(3.1 / 2.0 / (outer - d))
    rolling = grr / inlet / math.exp(starved) * math.exp(0.6 * log(nu * n))
    share = math.exp(-2.6e-8 * math.exp(1.4 * log(n * nu)) * dm)
    sliding = gsl * (0.05 + share * (0.12 - 0.05))
    computed = skf_friction(
        series, d * 1e-3, outer * 1e-3, radial, axial, n * RPM, nu * 1e-6, static_rating=c0, oil_height=0.0
    )
    assert computed.rolling * 1e3 == pytest.approx(rolling, rel=1e-12)
    assert computed.sliding * 1e3 == pytest.approx(sliding, rel=1e-12)
    assert computed.drag == 0.0


def test_wetted_area_of_the_drag_formula() -> None:
    """Compare R_s with a segment of a circle.

    Radius 0.6 d_m, below the oil: 0.36 d_m^2 (t - sin t) is twice its area.
    """
    dm, height = 60.0, 21.0
    radius = 0.6 * dm
    steps = 200_000
    depth = height / steps
    area = sum(2.0 * math.sqrt(radius**2 - (radius - (i + 0.5) * depth) ** 2) * depth for i in range(steps))
    _, churning = drag_torque(0.04, 0.08, 3000.0 * RPM, 30e-6, height * 1e-3, 0.0)
    t = 2.0 * math.acos((radius - height) / radius)
    reynolds = 3000.0 * dm**2 * math.sin(t / 2.0) / 30.0
    wetted = 2.0 * area * 0.05 * 3.1 * 120.0 / 40.0
    assert churning * 1e3 == pytest.approx(1.093e-7 * 3000.0**2 * dm**3 * reynolds**-1.379 * wetted, rel=1e-6)


def test_drag_editions_differ_by_the_factor_of_the_newer_one() -> None:
    # Syla et al. 2026, eq. 40 against 0.4 V_M K_ball d_m^5 n^2
    new, _ = drag_torque(0.095, 0.2, 3000 * RPM, 36e-6, 0.015, 3e-5)
    old, _ = drag_torque_2008(0.095, 0.2, 3000 * RPM, 3e-5)
    assert new == pytest.approx(0.4 * old)
    # K_ball d_m^5 n^2 by hand for the 6319: 3.1 * 295/105 * 1e-12 * 147.5^5 * 9e6
    assert old * 1e3 == pytest.approx(3e-5 * 3.1 * 295.0 / 105.0 * 1e-12 * 147.5**5 * 9e6, rel=1e-12)


@given(
    st.sampled_from(sorted(SERIES)),
    st.floats(100.0, 2e4),
    st.floats(100.0, 2e4),
    st.floats(1.05, 3.0),
)
def test_load_variables_grow_with_load(series: str, radial: float, axial: float, more: float) -> None:
    base = load_variables(SERIES[series], 0.06, radial, axial, 2e4)
    assert load_variables(SERIES[series], 0.06, more * radial, axial, 2e4) > base
    assert load_variables(SERIES[series], 0.06, radial, more * axial, 2e4) > base


def test_axial_load_that_is_only_noise() -> None:
    """Ignore axial loads of rounding errors.

    The catalogue's sliding variable jumps by d_m^0.115 where F_a leaves zero.
    """
    none, noise, some = (load_variables(SERIES["62"], 0.06, 3000.0, axial, 19e3) for axial in (0.0, 1e-6, 3.001))
    assert noise == none
    assert some[1] / none[1] == pytest.approx(60.0**0.115, rel=1e-3)
    assert some[0] / none[0] == pytest.approx(1.0, abs=0.02)  # the rolling variable is continuous, like F_a^0.76


def test_schaeffler_idle_torque() -> None:
    # Syla et al. 2026, eq. 38-39: by hand for f_0 = 2, d_m = 60 mm: nu n = 60000 -> 2e-7 * 216000 * 1532.6 = 66.2 N mm
    assert idle_torque(2.0, 0.06, 3000 * RPM, 20e-6) * 1e3 == pytest.approx(66.21, abs=0.01)
    # below nu n = 2000: 160e-7 * 2 * 216000 = 6.912 N mm
    assert idle_torque(2.0, 0.06, 50 * RPM, 20e-6) * 1e3 == pytest.approx(6.912, rel=1e-9)


def test_schaeffler_branches_meet() -> None:
    below, above = (idle_torque(2.0, 0.06, rpm * RPM, 20e-6) for rpm in (99.99, 100.01))
    reason = "160 stands for 2000^(2/3) = 158.7 in the catalogue"
    Published(above, "Syla et al. 2026, eq. 38-39", reason, rel=0.0081).check(below)


def test_schaeffler_load_torque() -> None:
    # 6208: f_1 = 0.0009, C_0 = 17.9 kN, F_r = 1790 N: sqrt(0.1) 1790 N 60 mm 0.0009 = 30.57 N mm
    torque, deciding = load_torque(0.0009, 0.06, 1790.0, 0.0, 17900.0)
    assert torque * 1e3 == pytest.approx(30.567, abs=0.001)
    assert deciding == 1790.0
    # axial load decides from F_a = F_r/3: P_1 = 3.3 F_a - 0.1 F_r
    assert load_torque(0.0009, 0.06, 1000.0, 1000.0, 17900.0)[1] == pytest.approx(3200.0)


def test_catalogues_agree_in_order_of_magnitude() -> None:
    """Compare Schaeffler's torque with SKF's.

    M_0 + M_1 of the 6319 lies above SKF's, by less than a factor of two (both printed tables).
    """
    for ratio, speed, _ in TABLE_4:
        load = 160e3 / ratio
        schaeffler = idle_torque(2.3, 0.1475, speed * RPM, fva3(62.5))
        schaeffler += load_torque(0.0009, 0.1475, load, 0.0, 112.6e3)[0]
        assert 1.0 < schaeffler * 1e3 / _torque_6319(ratio, speed, 62.5, 0.0) < 2.0


@pytest.mark.parametrize(
    ("kind", "outside", "counterface", "torque"),
    [
        # SKF, General catalogue 6000 (2008), table 4 of chapter Friction: K_S1 d_s^beta + K_S2 [N mm] by hand
        ("RSL", 25.0, 14.0, 0.0),
        ("RSL", 52.0, 31.3, 0.0018 * 31.3**2.25),  # 4.17
        ("RSH", 52.0, 31.3, 66.9),
        ("RS1", 62.0, 37.4, 81.6),
        ("RS1", 80.0, 49.1, 134.9),
        ("RS1", 90.0, 56.1, 170.1),
        ("RS1", 110.0, 68.8, 0.018 * 68.8**2.25),  # 245.4
        ("RZ", 90.0, 56.1, 0.0),
    ],
)
def test_seals_after_skf(kind: str, outside: float, counterface: float, torque: float) -> None:
    found = seal_torque(kind, outside * 1e-3, counterface * 1e-3)
    assert found is not None
    assert found * 1e3 == pytest.approx(torque, rel=2e-3)
    half = seal_torque(kind, outside * 1e-3, counterface * 1e-3, sides=1)
    assert half == pytest.approx(0.5 * found)


def test_seals_that_the_table_does_not_have() -> None:
    assert seal_torque("RSH", 0.062, 0.037) is None
    assert seal_torque("RSL", 0.062, 0.037) is None
    assert {kind: rows[-1].up_to for kind, rows in SEALS.items()} == {
        "RZ": 175.0, "RSL": 52.0, "RSH": 52.0, "RS1": math.inf
    }  # fmt: skip
    assert seals_of("6308-2RS1/C3") == ("RS1", 2)
    assert seals_of("6205 rsh") == ("RSH", 1)
    assert seals_of("6205-2RSH2") == ("", 0)  # of FKM
    assert seals_of("6308 C3") == ("", 0)


def test_a_sealed_bearing_turns_harder_in_the_catalogue() -> None:
    from lambda_core import api

    case = {
        "name": "sealed",
        "bearing": {"designation": "6308-2RS1", "maker": "SKF"},
        "lubricant": {"name": "mineral-vg68", "temperature": "70 degC"},
        "loads": {"radial": "2.5 kN"},
        "operation": {"speed": "3000 rpm"},
    }
    sealed, opened = (
        api.compare(case | {"bearing": {"designation": name, "maker": "SKF"}}, methods=["skf"])
        for name in ("6308-2RS1", "6308")
    )
    seals = sealed.value("skf", "friction", "seals")
    assert seals is not None
    shoulder = 1e3 * api.check(case).geometry.shoulder_diameter_inner
    assert seals == pytest.approx(0.018 * shoulder**2.25 + 15.0)
    totals = [found.value("skf", "friction", "total") for found in (sealed, opened)]
    assert totals[0] - totals[1] == pytest.approx(seals)  # type: ignore[operator]
    assert opened.value("skf", "friction", "seals") is None
    (method,) = sealed.methods
    assert any(line.startswith("2 RS1 seals on the shoulder") for line in method.assumptions)


def test_the_companion_of_the_sliding_variable_has_no_step() -> None:
    """Compare the step of SKF's sliding variable.

    A 6208 (d_m 60 mm, C_0 19 kN): the print steps by 60^0.115 = 1.60 at F_a = 0; the companion does not.
    """
    constants, diameter, rating = series_constants("62"), 60e-3, 19e3
    radial = 3000.0
    _, alone = load_variables(constants, diameter, radial)
    _, beyond = load_variables(constants, diameter, radial, 0.0011 * radial, rating)
    assert beyond / alone == pytest.approx(60.0**0.115, rel=1e-3)
    near = continuous_sliding(constants, diameter, radial, 0.0011 * radial, rating)
    assert near == pytest.approx(alone, rel=1e-6)
    assert continuous_sliding(constants, diameter, radial, 0.0, rating) == pytest.approx(alone, rel=1e-12)
    _, axial = load_variables(constants, diameter, 0.0, 2000.0, rating)
    assert continuous_sliding(constants, diameter, 0.0, 2000.0, rating) == pytest.approx(axial, rel=1e-12)
    for load in (10.0, 100.0, 1000.0, 5000.0):
        printed = load_variables(constants, diameter, radial, load, rating)[1]
        found = continuous_sliding(constants, diameter, radial, load, rating)
        assert printed / 60.0**0.115 * (1.0 - 1e-12) <= found <= printed


def test_the_method_keeps_the_print_and_adds_the_companion() -> None:
    from lambda_core.testing import method_inputs

    combined = SKF.evaluate(method_inputs(radial_load=3000.0, axial_load=300.0, static_rating=19e3))
    assert combined.value("friction", "total, continuous") < combined.value("friction", "total")
    step = combined.value("friction", "sliding") - combined.value("friction", "sliding, continuous")
    assert combined.value("friction", "total") - combined.value("friction", "total, continuous") == pytest.approx(step)
    alone = SKF.evaluate(method_inputs(radial_load=3000.0, axial_load=0.0, static_rating=19e3))
    assert not any("continuous" in row.name for row in alone.rows)
