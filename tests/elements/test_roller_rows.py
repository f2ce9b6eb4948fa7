"""Load distribution over one row of rollers."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from lambda_core.elements.roller import line_contact, profiles, slices
from lambda_core.elements.roller.load_distribution import RollerRow, distribute, loads_at

LENGTH, COUNT = 12e-3, 30
X = slices.slice_positions(LENGTH, COUNT)
DROP = 2.0 * profiles.iso_cylindrical(X, LENGTH, 11e-3)
CUP = math.radians(14.0)


@given(
    load=st.floats(50.0, 5e4), clearance=st.floats(-5e-6, 5e-5), tilt=st.floats(-2e-3, 2e-3), first=st.floats(0.0, 0.3)
)
@settings(max_examples=25, deadline=None)
def test_cylindrical_rollers_balance_the_radial_load(load: float, clearance: float, tilt: float, first: float) -> None:
    row = RollerRow(14, LENGTH, DROP, clearance=clearance, first_angle=first)
    found = distribute(row, load, tilt=tilt)
    assert float(np.sum(np.cos(row.angles) * found.slices.load)) == pytest.approx(load, rel=1e-7)
    assert found.tilt == tilt
    assert found.moment * tilt >= -1e-12 * load * LENGTH * abs(tilt)


@given(radial=st.floats(0.0, 2e4), axial=st.floats(1e3, 2e4))
@settings(max_examples=25, deadline=None)
def test_tapered_rollers_balance_both_loads(radial: float, axial: float) -> None:
    row = RollerRow(16, LENGTH, DROP, contact_angle=CUP)
    found = distribute(row, min(radial, 3.5 * axial), axial)
    loads = found.slices.load
    assert math.sin(CUP) * float(loads.sum()) == pytest.approx(axial, rel=1e-6)
    assert math.cos(CUP) * float(np.sum(np.cos(row.angles) * loads)) == pytest.approx(
        min(radial, 3.5 * axial), rel=1e-6, abs=1e-5 * axial
    )


def test_a_free_tilt_balances_the_moment() -> None:
    row = RollerRow(14, LENGTH, DROP)
    for moment in (-5.0, 0.0, 5.0):
        found = distribute(row, 5e3, tilt=None, moment=moment)
        assert found.moment == pytest.approx(moment, abs=1e-6)
        assert math.copysign(1.0, found.tilt) == math.copysign(1.0, moment) or abs(found.tilt) < 1e-9


def test_moment_and_tilt_change_sign_together() -> None:
    row = RollerRow(14, LENGTH, DROP, clearance=2e-5)
    there, back = (distribute(row, 5e3, tilt=tilt) for tilt in (1e-3, -1e-3))
    assert there.moment == pytest.approx(-back.moment, rel=1e-7)
    assert there.slices.load == pytest.approx(back.slices.load, rel=1e-6, abs=1e-6)


def test_clearance_narrows_the_loaded_zone() -> None:
    carrying = [
        int((distribute(RollerRow(40, LENGTH, DROP, clearance=gap), 5e3).slices.load > 0.0).sum())
        for gap in (-2e-5, 0.0, 5e-5)
    ]
    assert carrying == sorted(carrying, reverse=True)
    assert carrying[0] > carrying[2]


def test_pure_axial_load_is_even() -> None:
    found = distribute(RollerRow(16, LENGTH, DROP, contact_angle=CUP), 0.0, 6e3)
    assert found.slices.load == pytest.approx(np.full(16, 6e3 / (16 * math.sin(CUP))), rel=1e-7)
    assert found.radial == pytest.approx(0.0, abs=1e-12)


def test_displacements_close_the_rollers_along_the_contact_normal() -> None:
    row = RollerRow(16, LENGTH, np.zeros(COUNT), contact_angle=CUP, clearance=4e-6)
    closed = (3e-5 * np.cos(row.angles) - 2e-6) * math.cos(CUP) + 5e-5 * math.sin(CUP)
    assert loads_at(row, 3e-5, 5e-5, 0.0).slices.load == pytest.approx(line_contact.iso_load(closed, LENGTH), rel=1e-12)


def test_rows_of_elastic_slices_balance_too() -> None:
    row = RollerRow(14, LENGTH, DROP, elastic=slices.Elastic((4.6e-3, 6.4e-3), 226e9))
    found = distribute(row, 5e3, tilt=1e-3)
    assert float(np.sum(np.cos(row.angles) * found.slices.load)) == pytest.approx(5e3, rel=1e-7)
    laminae = distribute(RollerRow(14, LENGTH, DROP), 5e3, tilt=1e-3)
    # the matrix is 19 % softer than ISO 16281's constant, which hardly moves the shares of the rollers
    assert found.slices.load[0] == pytest.approx(float(laminae.slices.load[0]), rel=0.03)


def test_given_displacements_give_loads() -> None:
    row = RollerRow(14, LENGTH, DROP, contact_angle=CUP)
    found = distribute(row, 4e3, 2e3, tilt=5e-4)
    again = loads_at(row, found.radial, found.axial, found.tilt)
    assert again.slices.loads.tolist() == found.slices.loads.tolist()


def test_rows_refuse_loads_they_cannot_carry() -> None:
    with pytest.raises(ValueError, match="zero for a cylindrical"):
        distribute(RollerRow(14, LENGTH, DROP), 1e3, 1e3)
    with pytest.raises(ValueError, match="positive for a tapered"):
        distribute(RollerRow(14, LENGTH, DROP, contact_angle=CUP), 1e3)
