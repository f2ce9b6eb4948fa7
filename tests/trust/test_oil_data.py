"""Test laws whose data the oil lacks.

An assumption that is recorded, or one sentence before anything runs.
"""

from __future__ import annotations

import pytest

from lambda_core import api
from lambda_core.domain.errors import CaseError
from lambda_core.model.checking import check_bearing

CASE = "6208-axial-1300"


def test_c1_a_law_that_the_oil_has_no_data_for_is_refused_in_one_sentence() -> None:
    with pytest.raises(CaseError) as caught:
        api.check(CASE, ["lubricant.name=FVA3A", "models.rheology=bode"])
    (problem,) = caught.value.problems
    assert problem.where == "models.rheology"
    assert "rheology bode needs rho_s, alpha_s" in problem.message
    assert "FVA3A has no data for them; it has data for" in problem.message


def test_d12_an_oil_of_ones_own_needs_no_data_of_permittivity() -> None:
    oil = {
        "name": "mine",
        "properties": {"rheology": "roelands", "thermal_conductivity": "0.14 W/(m K)", "specific_heat": "2 kJ/(kg K)"},
    }
    values: dict[str, object] = {
        "kinematic_viscosity_40": "46 mm2/s", "kinematic_viscosity_100": "6.8 mm2/s", "alpha_p": "18 1/GPa",
        "density_15": "870 kg/m3", "density_slope": -0.6,
    }  # fmt: skip
    model = check_bearing(api.case(CASE).with_(lubricant=oil, parameters={"rheology": values}))
    assert "permittivity model constant: mine has no data for bode" in model.assumptions


def test_c1_a_study_refuses_oils_and_laws_that_do_not_go_together_before_it_starts() -> None:
    study = {
        "name": "oils", "case": CASE, "responses": ["max_load_N"],
        "parameters": [
            {"path": "lubricant.name", "values": ["bode-mineral", "FVA3A"]},
            {"path": "models.rheology", "values": ["auto", "bode"]},
        ],
    }  # fmt: skip
    with pytest.raises(CaseError) as caught:
        api.study_check(study)
    (problem,) = caught.value.problems
    assert problem.where == "lubricant.name = FVA3A, models.rheology = bode"
    assert "has no data for them" in problem.message
