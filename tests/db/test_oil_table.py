"""Test oils over temperature and pressure by their own laws.

The printed checks of the constants come back.
"""

from __future__ import annotations

import math

import pytest
from lambda_db.catalogue import SqlCatalogue

from lambda_core.discovery.manager import registry
from lambda_core.domain.errors import CatalogueError
from lambda_core.formulas.oil import walther
from lambda_core.model.checks.oil_table import OilLaw, oil_table


def test_bode_mineral(catalogue: SqlCatalogue) -> None:
    table = oil_table(catalogue.lubricant("bode-mineral"), registry(), [313.15, 373.15], [0.0, 1e9])
    assert table.rheology == "bode"
    by_state = {(p.temperature_degC, p.pressure_GPa): p for p in table.points}
    assert by_state[40.0, 0.0].viscosity_mPas == pytest.approx(97.3, abs=0.05)
    assert by_state[40.0, 0.0].density_kgm3 == pytest.approx(874.8, abs=0.05)
    assert by_state[100.0, 0.0].viscosity_mPas == pytest.approx(8.81, abs=0.005)
    assert by_state[40.0, 1.0].permittivity == pytest.approx(2.51, abs=0.005)
    (at_40, _) = table.coefficients
    assert at_40.alpha_tangent_per_GPa == pytest.approx(20.4, abs=0.05)
    # this law flattens under pressure before its pole: secant < reciprocal < tangent at 40 degC
    assert at_40.alpha_secant_per_GPa < at_40.alpha_reciprocal_per_GPa < at_40.alpha_tangent_per_GPa
    assert table.validity
    assert table.reference


@pytest.mark.parametrize("name", ["FVA3", "FVA3A"])
def test_fva3(catalogue: SqlCatalogue, name: str) -> None:
    """Compare Vogel and Dicke at 62.5 degC by hand.

    0.062 exp(1021.7/164.0517) = 31.42 mPa s; 1e4/(327.7918 + 62.5 2.9862).
    """
    table = oil_table(catalogue.lubricant(name), registry(), [335.65])
    assert table.points[0].viscosity_mPas == pytest.approx(0.062 * math.exp(1021.7 / 164.0517), rel=1e-9)
    assert table.coefficients[0].alpha_tangent_per_GPa == pytest.approx(1e4 / (327.7918 + 62.5 * 2.9862), rel=1e-5)


def test_every_oil_has_a_table_by_every_law(catalogue: SqlCatalogue) -> None:
    """Compute viscosity and density from -10 to 150 degC.

    Every oil has both up to 1 GPa, whatever data it has.
    """
    models = registry()
    for row in catalogue.lubricants(limit=1000):
        for law in row.parameters["rheology"]:
            table = oil_table(row, models, [263.15, 313.15, 423.15], [0.0, 0.5e9, 1e9], law)
            viscosities = [p.viscosity_mPas for p in table.points]
            assert all(v > 0.0 for v in viscosities), (row.name, law)
            assert all(600.0 < p.density_kgm3 < 1400.0 for p in table.points), (row.name, law)
            for i in (0, 3, 6):
                assert viscosities[i] < viscosities[i + 1] <= viscosities[i + 2], (row.name, law)
            ambient = [viscosities[i] for i in (0, 3, 6)]
            assert ambient == sorted(ambient, reverse=True), (row.name, law)
            assert all(c.beta_per_K > 0.0 for c in table.coefficients), (row.name, law)


def test_generic_oils_follow_astm_d341(catalogue: SqlCatalogue) -> None:
    models = registry()
    for name in ("mineral-vg100", "pao-vg46", "pag-vg100", "ester-vg32"):
        row = catalogue.lubricant(name)
        value = {key: v.value for key, v in row.properties.items()}
        line = walther(313.15, value["kinematic_viscosity_40"], 373.15, value["kinematic_viscosity_100"])
        for point in oil_table(row, models, [293.15, 313.15, 343.15, 373.15]).points:
            expected = line.kinematic_viscosity(point.temperature_degC + 273.15) * 1e6
            assert point.kinematic_viscosity_mm2s == pytest.approx(expected, rel=1e-3), (name, point)


def test_law_without_data(catalogue: SqlCatalogue) -> None:
    with pytest.raises(CatalogueError, match='"bode" is not a known law with data'):
        oil_table(catalogue.lubricant("FVA3"), registry(), [313.15], rheology="bode")


def test_state_is_what_the_table_shows(catalogue: SqlCatalogue) -> None:
    law = OilLaw(catalogue.lubricant("FVA3"), registry())
    ln_eta, rho = law.state(0.2e9, 313.15)
    assert law.log_viscosity(313.15)(0.2e9) == ln_eta
    assert rho > 872.6
