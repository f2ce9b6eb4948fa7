"""Test rows, method, view and command of the package."""

from contextlib import closing

import numpy as np
import pytest
from northwind_bearings.method import stribeck
from northwind_bearings.view import ShareOptions, load_share
from typer.testing import CliRunner

from lambda_core import api
from lambda_core.plugins import NotApplicable
from lambda_core.testing import method_inputs, run_data


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


def ring_of_balls(loads):
    """Return a run of two equal samples.

    Balls are evenly around the bearing, contact angle zero.
    """
    count = len(loads)
    azimuth = 2.0 * np.pi * np.arange(count) / count
    pairs = np.stack([loads, loads], axis=1)
    return run_data(
        time=[0.0, 0.001], load=[pairs, pairs], contact_angle=np.zeros((2, count, 2)), ball_azimuth=[azimuth, azimuth]
    )


def test_view_against_the_cosine_distribution():
    # Q = Q_max cos(psi) on half of many balls carries Q_max Z/4: the share is 4.
    loads = np.maximum(np.cos(2.0 * np.pi * np.arange(360) / 360), 0.0)
    (series,) = load_share(ring_of_balls(loads), ShareOptions()).panels[0].series
    assert series.y == pytest.approx([4.0, 4.0])
    assert len(load_share(ring_of_balls(loads), ShareOptions(after=0.0005)).panels[0].series[0].x) == 1


def test_view_says_where_it_does_not_apply():
    with pytest.raises(NotApplicable, match="no radial load"):
        load_share(ring_of_balls(np.ones(9)), ShareOptions())
    with pytest.raises(NotApplicable, match="ends before 1 s"):
        load_share(ring_of_balls(np.ones(9)), ShareOptions(after=1.0))


def test_command():
    from northwind_bearings.command import app

    said = CliRunner().invoke(app, ["--bore", "40"])
    assert said.exit_code == 0
    assert said.output.split()[:4] == ["NW6208", "bore", "40", "mm"]
