"""Compare heat and speed ratings with ISO 15312."""

from __future__ import annotations

import math

import pytest

from lambda_core import api
from lambda_core.analysis.thermal import iso15312

# d, D, B [mm], C_0r [N] of SKF's catalogue; n_theta,r [1/min] of the standard's formula with f_0r, f_1r of its annex A,
# evaluated apart from this program and rounded to 1/min.
RATINGS = {
    "6205": (25.0, 52.0, 15.0, 7800.0, 14421.0),
    "6208": (40.0, 80.0, 18.0, 19000.0, 9297.0),
    "6305": (25.0, 62.0, 17.0, 11600.0, 12273.0),
    "6308": (40.0, 90.0, 23.0, 24000.0, 9022.0),
    "6319": (95.0, 200.0, 45.0, 118000.0, 4925.0),
    "6220": (100.0, 180.0, 34.0, 93000.0, 4811.0),
}


@pytest.mark.parametrize("name", RATINGS)
def test_the_formula_for_six_bearings(name: str) -> None:
    bore, outside, width, rating, expected = RATINGS[name]
    f_0r, f_1r = iso15312.COEFFICIENTS[name[:2]]
    found = iso15312.speed_rating(bore * 1e-3, outside * 1e-3, width * 1e-3, rating, f_0r, f_1r) * 30.0 / math.pi
    assert found == pytest.approx(expected, rel=1e-3)


@pytest.mark.parametrize("name", RATINGS)
def test_the_rating_balances_loss_and_emitted_heat(name: str) -> None:
    """Compare the rating in the standard's units.

    mm, N, 1/min, mm2/s, W.
    """
    bore, outside, width, rating, _ = RATINGS[name]
    f_0r, f_1r = iso15312.COEFFICIENTS[name[:2]]
    n = iso15312.speed_rating(bore * 1e-3, outside * 1e-3, width * 1e-3, rating, f_0r, f_1r) * 30.0 / math.pi
    d_m, area = 0.5 * (bore + outside), math.pi * width * (bore + outside)
    torque = 1e-7 * f_0r * (12.0 * n) ** (2.0 / 3.0) * d_m**3 + f_1r * 0.05 * rating * d_m  # [N mm]
    density = 0.016 if area <= 50_000.0 else 0.016 * (area / 50_000.0) ** -0.34
    assert math.pi * n / 30e3 * torque == pytest.approx(density * area, rel=1e-9)


def test_a_large_bearing_has_the_smaller_heat_flow_density() -> None:
    assert iso15312.heat_flow_density(50_000e-6) == pytest.approx(16e3)
    assert iso15312.heat_flow_density(100_000e-6) == pytest.approx(16e3 * 2.0**-0.34)


def test_the_set_takes_the_reference_heat_at_fifty_kelvin() -> None:
    """Compare the heat at 70 degC with q_r A_r.

    A bearing of one temperature, surroundings of 20 degC.
    """
    case = {
        "name": "iso",
        "bearing": {"designation": "6208", "maker": "SKF"},
        "lubricant": {"name": "FVA3A", "temperature": "70 degC"},
        "loads": {"radial": "950 N"},
        "operation": {"speed": "5000 rpm"},
        "thermal": {"conductances": "iso-15312"},
    }
    found = api.thermal(case)
    out = {flow.source: flow.conductance_W_per_K for flow in found.flows if flow.target == "ambient"}
    assert set(out) == {"inner_ring", "outer_ring"}
    assert sum(out.values()) * 50.0 == pytest.approx(0.016 * math.pi * 18.0 * 120.0, rel=1e-9)
    assert out["inner_ring"] / out["outer_ring"] == pytest.approx(40.0 / 80.0)
    assert "shaft" not in found.temperatures_degC
