"""Compare capacitances of the 6208 with the paper's.

Syla et al. 2026, section 4.3 and Fig. 7.
"""

from __future__ import annotations

import math

import pytest
from lambda_plugins.methods.capacitance import evaluate

from lambda_core.laws.context import Material, Oil
from lambda_core.views.method import (
    ContactLoad,
    EquilibriumState,
    MethodInputs,
    MethodTable,
)

from .paper_6208 import BALL, INNER, OUTER, PITCH, SPEED, axial_6208
from .published import Published

STEEL = Material("steel", 210e9, 0.3, 7850.0, 46.0, 460.0)
KELVIN = 313.15

# Syla et al. 2026, table 5
RHO_S, ALPHA_S = 1073.465942, 0.0005911
A1, A2, A3, A4, A5 = 0.08970567, 6348.426753, -27.52010404, 0.04547532, -0.00002769
V1, V2, V3, V4 = 0.03380703, 2.82632938, 785.285992, 0.00162619
K1, K2, K3 = 0.00379557, 0.00258151, 0.00130612
SCALE = A2 + A3 * KELVIN + A4 * KELVIN**2 + A5 * KELVIN**3  # [bar]


def density(pressure: float) -> float:
    return RHO_S * (1.0 - ALPHA_S * KELVIN) / (1.0 - A1 * math.log1p(pressure * 1e-5 / SCALE))


def log_viscosity(pressure: float) -> float:
    return math.log(1e-3 * V1) + V2 / (V3 * (1.0 + V4 * KELVIN) / density(pressure) - 1.0)


def permittivity(pressure: float) -> float:
    # eq. 35-37
    base = K1 * (A1 / SCALE) ** -0.5 * density(0.0) ** (1.0 / 6.0) + K2 * KELVIN
    return base + K3 * (density(pressure) - density(0.0))


OIL = Oil(
    "mineral oil of table 5",
    "mineral",
    KELVIN,
    0.134,
    2000.0,
    viscosity=math.exp(log_viscosity(0.0)),
    density=density(0.0),
    alpha_p=(log_viscosity(1e5) - log_viscosity(0.0)) / 1e5,
    beta=0.05,
)


def inputs_6208(axial_load: float) -> MethodInputs:
    ball = axial_6208(axial_load, running=True)
    contacts = tuple(
        ContactLoad(2.0 * math.pi * i / 9, ball.load_inner, ball.load_outer, ball.angle_inner, ball.angle_outer)
        for i in range(9)
    )
    return MethodInputs(
        title="6208 (Syla2026)",
        series="62",
        bore_diameter=0.04,
        outside_diameter=0.08,
        width=0.018,
        ball_count=9,
        ball_diameter=BALL,
        pitch_diameter=PITCH,
        groove_radius_inner=INNER,
        groove_radius_outer=OUTER,
        ball=STEEL,
        inner_ring=STEEL,
        outer_ring=STEEL,
        oil=OIL,
        radial_load=0.0,
        axial_load=axial_load,
        inner_speed=SPEED,
        outer_speed=0.0,
        permittivity=permittivity,
        state=EquilibriumState(contacts, (0.0,) * 5),
    )


@pytest.fixture(scope="module")
def tables() -> dict[float, MethodTable]:
    return {load: evaluate(inputs_6208(load)) for load in (700.0, 1300.0, 2000.0)}


def row(table: MethodTable, name: str) -> float:
    return table.value("capacitance", name)


@pytest.mark.parametrize(("load", "inner", "outer"), [(700.0, 8.2, 7.4), (1300.0, 12.1, 11.0), (2000.0, 15.9, 14.4)])
def test_hertzian_capacitance(tables: dict[float, MethodTable], load: float, inner: float, outer: float) -> None:
    source = "independent evaluation with exact Hertz ellipses"
    reason = "Hamrock-Brewe areas are 0.4 to 0.7 % below exact ones; two to three printed digits"
    Published(inner, source, reason, rel=0.012).check(row(tables[load], "inner Hertzian area"))
    Published(outer, source, reason, rel=0.012).check(row(tables[load], "outer Hertzian area"))


def test_growth_of_the_contact_area(tables: dict[float, MethodTable]) -> None:
    growth = row(tables[2000.0], "inner area") / row(tables[700.0], "inner area") - 1.0
    source = "Syla et al. 2026, section 4.3: the contact area increases by 78 %"
    Published(78.0, source, "two printed digits", abs=1.5).check(100.0 * growth)
    # exact: the area goes with Q^(2/3)
    loads = [axial_6208(load, running=True).load_inner for load in (700.0, 2000.0)]
    assert growth == pytest.approx((loads[1] / loads[0]) ** (2.0 / 3.0) - 1.0, abs=0.01)


@pytest.mark.parametrize("load", [700.0, 1300.0, 2000.0])
def test_outer_against_inner(tables: dict[float, MethodTable], load: float) -> None:
    table = tables[load]
    source = "Syla et al. 2026, section 4.3"
    film = row(table, "outer film") / row(table, "inner film")
    Published(1.20, source, '"about 20 %"', abs=0.01).check(film)
    area = row(table, "outer area") / row(table, "inner area")
    Published(1.10, source, '"about 10 %"', abs=0.015).check(area)
    lower = 1.0 - row(table, "outer Hertzian area") / row(table, "inner Hertzian area")
    reason = '"10 % to 14 % lower", of the full model too; the isothermal one misses the lower end by 0.5 to 0.9 points'
    Published(0.10, source, reason, abs=0.01).check(lower)


def test_film_falls_with_load_by_the_power_of_the_film_law(tables: dict[float, MethodTable]) -> None:
    # the paper's -9 % cannot come from the load alone: W^-0.073 gives -6 %
    change = row(tables[2000.0], "inner film") / row(tables[700.0], "inner film") - 1.0
    assert change == pytest.approx(-0.06, abs=0.003)


@pytest.mark.parametrize(("load", "inner", "outer"), [(700.0, 4.6, 4.9), (2000.0, 3.5, 3.7)])
def test_correction_factor(tables: dict[float, MethodTable], load: float, inner: float, outer: float) -> None:
    source = "Schneider et al. 2021 through Syla et al. 2026, eq. 34, evaluated independently"
    reason = "two printed digits; the ellipse ratio of Hamrock and Brewe is 3 % smaller, to the power 0.14"
    Published(inner, source, reason, abs=0.07).check(row(tables[load], "inner factor"))
    Published(outer, source, reason, abs=0.07).check(row(tables[load], "outer factor"))


def test_oil_of_table_5() -> None:
    # checks of the constants as transcribed; the last digit
    assert density(0.0) == pytest.approx(874.8, abs=0.05)
    assert 1e3 * OIL.viscosity == pytest.approx(97.3, abs=0.05)
    assert permittivity(0.0) == pytest.approx(2.243, abs=0.0005)
    assert permittivity(1e9) == pytest.approx(2.51, abs=0.005)
    assert 1e9 * OIL.alpha_p == pytest.approx(20.4, abs=0.05)


def test_bearing_is_nine_series_pairs_in_parallel(tables: dict[float, MethodTable]) -> None:
    table = tables[1300.0]
    pair = 1.0 / (1.0 / row(table, "inner contact") + 1.0 / row(table, "outer contact"))
    assert row(table, "bearing") == pytest.approx(9.0 * pair, rel=1e-12)
