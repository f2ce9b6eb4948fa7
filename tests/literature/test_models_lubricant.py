"""Test viscosity, density and permittivity against published values."""

from __future__ import annotations

import math

import numpy as np
import pytest

from lambda_core.testing import evaluate

from .oils import BODE_PERMITTIVITY, BODE_VISCOSITY, FVA3, VG100
from .published import Published

SYLA = "Syla et al. 2026, Lubricants 14, 154, Table 5"
ZERO_C = 273.15


@pytest.mark.parametrize(
    ("celsius", "expected"),
    [
        (40.0, Published(97.3, f"{SYLA}: viscosity in mPa s", "printed digits", rel=1e-3)),
        (100.0, Published(8.81, f"{SYLA}: viscosity in mPa s", "printed digits", rel=1e-3)),
    ],
)
def test_bode_viscosity(celsius: float, expected: Published) -> None:
    ln_eta, _ = evaluate("rheology/bode", BODE_VISCOSITY, p=0.0, T=celsius + ZERO_C)
    expected.check(1e3 * math.exp(ln_eta[0]))


def test_bode_density_and_compressibility() -> None:
    p = np.array([0.0, 1e5])
    _, rho = evaluate("rheology/bode", BODE_VISCOSITY, p=p, T=313.15)
    Published(874.8, f"{SYLA}: density at 40 degC", "printed digits", abs=0.05).check(rho[0])
    per_bar = rho[1] / rho[0] - 1.0
    Published(
        6.70e-5, f"{SYLA}: compressibility at 40 degC in 1/bar", "printed digits, chord of 1 bar", rel=2e-3
    ).check(per_bar)


def test_bode_pressure_viscosity_coefficient() -> None:
    ln_eta, _ = evaluate("rheology/bode", BODE_VISCOSITY, p=np.array([0.0, 1e5]), T=313.15)
    Published(20.4e-9, f"{SYLA}: tangent at 40 degC", "printed digits", rel=3e-3).check((ln_eta[1] - ln_eta[0]) / 1e5)


@pytest.mark.parametrize(
    ("celsius", "p", "expected"),
    [
        (20.0, 0.0, 2.274),
        (40.0, 0.0, 2.243),
        (60.0, 0.0, 2.216),
        (80.0, 0.0, 2.194),
        (100.0, 0.0, 2.177),
        (40.0, 1e9, 2.51),
    ],
)
def test_bode_permittivity(celsius: float, p: float, expected: float) -> None:
    found = evaluate("permittivity/bode", BODE_PERMITTIVITY, p=p, T=celsius + ZERO_C, rho=870.0)
    Published(expected, f"{SYLA} in eq. 35-37", "printed digits", abs=0.006 if p else 0.0006).check(found[0])


@pytest.mark.parametrize(
    ("celsius", "expected"),
    [
        (
            40.0,
            Published(84.54, "FVA3, Vogel by hand in mPa s (Wingertszahn et al. 2023, Table A1)", "digits", rel=1e-4),
        ),
        (
            100.0,
            Published(9.861, "FVA3, Vogel by hand in mPa s (Wingertszahn et al. 2023, Table A1)", "digits", rel=1e-4),
        ),
    ],
)
def test_fva3_viscosity(celsius: float, expected: Published) -> None:
    ln_eta, _ = evaluate("rheology/vogel-dicke", FVA3, p=0.0, T=celsius + ZERO_C)
    expected.check(1e3 * math.exp(ln_eta[0]))


def test_fva3_is_an_iso_vg_100_oil() -> None:
    """Compare FVA3 with 90..110 mm2/s (ISO 3448)."""
    ln_eta, rho = evaluate("rheology/vogel-dicke", FVA3, p=0.0, T=313.15)
    assert 90.0 < 1e6 * math.exp(ln_eta[0]) / rho[0] < 110.0


def test_fva3_under_pressure_by_hand() -> None:
    """Compute viscosity at 0.5 GPa and 80 degC.

    0.5 GPa = 5000 bar: exponent p/[a1 + a2 t + (b1 + b2 t) p].
    """
    exponent = 5000.0 / (327.7918 + 2.9862 * 80.0 + (4.419e-3 + 3.0115e-4 * 80.0) * 5000.0)
    expected = math.log(0.062e-3) + 1021.7 / (101.5517 + 80.0) + exponent
    ln_eta, _ = evaluate("rheology/vogel-dicke", FVA3, p=0.5e9, T=353.15)
    assert ln_eta[0] == pytest.approx(expected, rel=1e-9)


def test_generic_oil_passes_its_two_points() -> None:
    """Compare the oil with its two given viscosities.

    ASTM D341 through nu40 and nu100; 1e-4 for the polynomial.
    """
    for name in ("roelands", "barus-limited"):
        ln_eta, rho = evaluate(f"rheology/{name}", VG100, p=0.0, T=np.array([313.15, 373.15]))
        assert 1e6 * np.exp(ln_eta) / rho == pytest.approx([100.0, 11.2], rel=1e-4)


def test_roelands_meets_its_pole_pressure_and_viscosity() -> None:
    """Compare Roelands' two constants.

    ln(ln eta - ln 6.31e-5) is linear in ln(1 + 5.1e-9 p) with the slope Z.
    """
    p = np.linspace(0.0, 1e8, 5)
    ln_eta, _ = evaluate("rheology/roelands", VG100, p=p, T=313.15)
    level = np.log(ln_eta - math.log(6.31e-5))
    Z = np.polyfit(np.log(1.0 + 5.1e-9 * p), level, 1)[0]
    assert Published(0.58, "Roelands 1966: Z of mineral oils 0.5..0.7", "range", abs=0.12).check(Z) is None
    assert level == pytest.approx(level[0] + Z * np.log(1.0 + 5.1e-9 * p), abs=1e-3)


def test_compression_after_dowson_and_higginson() -> None:
    """Compare density with Dowson and Higginson 1966.

    1 GPa compresses a mineral oil by 22 % in density, any pressure by at most 35 %.
    """
    _, rho = evaluate("rheology/roelands", VG100, p=np.array([0.0, 1e9, 1e12]), T=313.15)
    assert rho[1] / rho[0] == pytest.approx(1.2222, rel=1e-4)
    assert rho[2] / rho[0] == pytest.approx(1.353, rel=1e-3)


@pytest.mark.parametrize("label", ["rheology/roelands", "rheology/vogel-dicke", "rheology/bode"])
def test_mineral_oils_of_one_grade_stiffen_alike_at_moderate_pressure(label: str) -> None:
    """Compare three oils of VG 100 at 0.2 GPa.

    Two measured and one by Gold's alpha_p: 30..80 times as viscous at 40 degC.
    """
    given = {"rheology/roelands": VG100, "rheology/vogel-dicke": FVA3, "rheology/bode": BODE_VISCOSITY}[label]
    ln_eta, _ = evaluate(label, given, p=np.array([0.0, 2e8]), T=313.15)
    assert 30.0 < math.exp(ln_eta[1] - ln_eta[0]) < 80.0
