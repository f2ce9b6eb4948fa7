"""Test the role's contract and both limits of the law."""

import numpy as np
from limiting_shear import gecim_winer

from lambda_core.testing import assert_increasing, assert_limit, check_model, evaluate

FILM = {"p": 1.0e9, "T": 330.0, "ln_eta": 3.0, "h": 0.5e-6}


def test_contract():
    check_model(gecim_winer)


def test_slow_shear_is_newtonian():
    slip = 1e-6
    assert_limit(gecim_winer, "slip", slip, np.exp(3.0) * slip / 0.5e-6, rtol=1e-5, **FILM)


def test_fast_shear_reaches_the_limit():
    assert_limit(gecim_winer, "slip", 100.0, 2.0e6 + 0.065 * 1.0e9, rtol=1e-12, **FILM)


def test_more_slip_never_means_less_stress():
    assert_increasing(gecim_winer, "slip", np.geomspace(1e-6, 10.0, 30), **FILM)


def test_parameters_read_units():
    low = evaluate(gecim_winer, {"ambient": "4 MPa", "slope": 0.04}, slip=100.0, **FILM)
    np.testing.assert_allclose(low, 4.0e6 + 0.04 * 1.0e9)
