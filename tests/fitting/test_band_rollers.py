"""Test model bands of quasi-static roller bearings."""

from __future__ import annotations

from typing import Any

import pytest

from lambda_core import api
from lambda_core.results.model_band import ModelBand


def case(designation: str, speed: str, **loads: str) -> dict[str, Any]:
    return {
        "name": "rollers",
        "bearing": {"designation": designation},
        "lubricant": {"name": "FVA3", "temperature": "60 degC"},
        "loads": loads,
        "operation": {"speed": speed},
    }


def band(source: dict[str, Any]) -> ModelBand:
    found = api.quasistatic(source, band=True).model_band
    assert isinstance(found, ModelBand)
    return found


def test_the_roughness_of_the_rib_rules_a_slow_tapered_bearing() -> None:
    torque = band(case("SKF 32216", "20 rpm", axial="10 kN")).band("friction torque")
    assert torque.contributors[0].name == "bearing.rollers.rib_roughness"
    assert torque.contributors[0].low < 0.7 * torque.value
    assert torque.low < torque.value < torque.high


def test_the_clearance_moves_pressure_and_life_of_a_cylindrical_bearing() -> None:
    found = band(case("SKF NU 208 ECP", "3000 rpm", radial="5 kN"))
    for name in ("maximum pressure", "rating life"):
        one = found.band(name)
        assert [cause.name for cause in one.contributors] == ["bearing.clearance"]
        assert one.low < one.value < one.high
    torque = {cause.name for cause in found.band("friction torque").contributors}
    assert {"bearing.clearance", "law of rolling_resistance"} <= torque


def test_published_laws_of_rolling_resistance_and_film_are_exchanged() -> None:
    """Hold the answers with other laws in the band."""
    source = case("SKF 32216", "1500 rpm", axial="6 kN")
    torque = band(source).band("friction torque")
    assert torque.contributors[0].name == "law of rolling_resistance"
    for law in ("matsuyama-line", "zhou-hoeprich-line", "aihara-line"):
        other = api.quasistatic(source, (f"models.rolling_resistance={law}",))
        assert torque.low < other.friction_torque_Nmm < torque.high
    film = band(case("SKF NU 208 ECP", "3000 rpm", radial="5 kN")).band("minimum film")
    assert "law of film_thickness" in {cause.name for cause in film.contributors}


def test_the_capacitance_of_rollers_has_a_band_of_oil_film_and_clearance() -> None:
    source = case("SKF NU 208 ECP", "3000 rpm", radial="5 kN")
    found = api.quasistatic(source, band=True)
    one = found.model_band.band("capacitance")
    assert one.value == found.bearing_capacitance_nF
    assert found.bearing_capacitance_nF_band == [one.low, one.high]
    assert {"permittivity.eps_r", "lubricant.temperature"} <= {cause.name for cause in one.contributors}
    for permittivity in (2.1, 2.3):
        moved = {"models": {"permittivity": "constant"}, "parameters": {"permittivity": {"eps_r": permittivity}}}
        assert one.low < api.quasistatic(source | moved, band=False).bearing_capacitance_nF < one.high


def test_a_known_clearance_is_not_varied() -> None:
    known = case("SKF NU 208 ECP", "3000 rpm", radial="5 kN")
    known["bearing"] |= {"clearance": "20 um"}
    pressure = band(known).band("maximum pressure")
    assert pressure.low == pytest.approx(pressure.high)


def test_a_bearing_on_a_shaft_has_the_band_of_one_that_is_alone() -> None:
    source = {
        "name": "machine",
        "shaft": {
            "sections": [{"length": "60 mm", "diameter": "400 mm"}],
            "support": {"at": "30 mm", "x": "locked"},
        },
        "bearings": {"one": {"designation": "SKF NU 208 ECP", "at": "30 mm"}},
        "loads": {"down": {"at": "30 mm", "force_z": "-5 kN"}},
        "lubricant": {"name": "FVA3", "temperature": "60 degC"},
        "operation": {"speed": "3000 rpm"},
        "gravity": {"z": "0 m/s2"},
    }
    on_shaft = api.quasistatic(source, band=True).bearing("one").friction_torque_Nmm_band
    alone = band(case("SKF NU 208 ECP", "3000 rpm", radial="5 kN")).fields()["friction_torque_Nmm_band"]
    assert on_shaft == pytest.approx(alone, rel=5e-3)


def test_full_complements_have_a_band() -> None:
    torque = band(case("SKF NCF 3008", "1000 rpm", radial="5 kN")).band("friction torque")
    assert torque.low < torque.value < torque.high


def test_tapered_full_complements_have_a_band() -> None:
    source = case("SKF 32216", "1000 rpm", axial="5 kN") | {"depth": {"cage": False}}
    torque = band(source).band("friction torque")
    assert torque.low < torque.value < torque.high
