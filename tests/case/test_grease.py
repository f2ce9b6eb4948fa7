"""Test a grease as lubricant.

Its base oil, SKF's supply of grease, no bath; its maker's temperatures are limits.
"""

from __future__ import annotations

from pathlib import Path

import pytest

from lambda_core import api
from lambda_core.domain.errors import CaseError
from lambda_core.model.checks.operating_limits import operating_warnings
from lambda_core.model.laws.method_inputs import method_inputs
from lambda_core.results.verdict import limits_of

GREASED = """\
name = "greased"
bearing = { designation = "6308 C3", maker = "SKF" }
lubricant = { name = "arcanol-multi2", temperature = "70 degC" }
loads = { radial = "2.5 kN" }
operation = { speed = "3000 rpm" }
"""


@pytest.fixture
def greased(tmp_path: Path) -> Path:
    path = tmp_path / "greased.toml"
    path.write_text(GREASED, encoding="utf-8")
    return path


def test_a_grease_is_its_base_oil_with_its_supply_and_no_bath(greased: Path) -> None:
    model = api.check(greased)
    supply = model.laws["ball_inner"]["supply"]
    assert supply.model.name == "skf-replenishment"
    assert supply.parameters.model_dump()["k_rs"] == 6e-8
    assert "Friction: K_rs = 6e-8 for grease" in supply.origins["k_rs"]
    assert model.oil_level < -0.5 * model.geometry.ball_diameter
    assert any("the grease arcanol-multi2 is taken as its base oil" in text for text in model.assumptions)
    assert not any("oil level" in text for text in model.assumptions)
    assert method_inputs(model, model.oil).lubrication == "grease"  # type: ignore[arg-type]
    oiled = api.check(greased, ["lubricant.name=mineral-vg100"])
    assert method_inputs(oiled, oiled.oil).lubrication == "oil bath"  # type: ignore[arg-type]


def test_methods_know_that_it_is_a_grease(greased: Path) -> None:
    said = api.compare(greased).model_dump_json()
    assert "lubrication: grease" in said
    assert "(grease)" in said


def test_a_grease_stands_at_no_level(greased: Path) -> None:
    with pytest.raises(CaseError, match="is a grease, which has no level"):
        api.check(greased, ["lubricant.oil_level=2 mm"])


def test_beyond_the_temperatures_of_its_maker_is_a_warning(greased: Path) -> None:
    assert operating_warnings(api.check(greased)) == []
    (said,) = operating_warnings(api.check(greased, ["lubricant.temperature=130 degC"]))
    assert said == ("the grease arcanol-multi2 at 130 degC is outside what its maker gives it for, -30 to 120 degC")
    assert limits_of(api.check(greased)).oil_limit_degC == pytest.approx(120.0)
