"""Rows, method and command of the package."""

from contextlib import closing

import pytest
from northwind_bearings.method import stribeck
from typer.testing import CliRunner

from lambda_core import api
from lambda_core.plugins import NotApplicable
from lambda_core.testing import method_inputs


def test_bearings_and_oil_are_in_the_catalogue():
    with closing(api.catalogue()) as catalogue:
        row = catalogue.bearing("NW6208")
        assert (row.maker, row.layer) == ("Northwind", "plugin")
        assert row.ball_diameter.value == pytest.approx(11.906e-3)
        assert row.race_diameter_outer.value - row.race_diameter_inner.value == pytest.approx(2 * 11.906e-3)
        assert catalogue.lubricant("northwind-spindle").rheology == "roelands"


def test_method_against_the_number_of_stribeck():
    table = stribeck(method_inputs(radial_load=9000.0, ball_count=9))
    assert table.value("load", "largest ball load") == pytest.approx(4370.0)
    assert table.value("load", "largest ball load with clearance") == pytest.approx(5000.0)


def test_method_says_where_it_does_not_apply():
    with pytest.raises(NotApplicable, match="radial load alone"):
        stribeck(method_inputs(radial_load=1000.0, axial_load=500.0))
    with pytest.raises(NotApplicable, match="is for a radial load"):
        stribeck(method_inputs(radial_load=0.0, axial_load=500.0))


def test_command():
    from northwind_bearings.command import app

    said = CliRunner().invoke(app, ["--bore", "40"])
    assert said.exit_code == 0
    assert said.output.split()[:4] == ["NW6208", "bore", "40", "mm"]
