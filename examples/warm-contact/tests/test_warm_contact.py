"""Test the heat balance and the contracts of both laws."""

import math

from warm_contact import warm, warm_eyring

from lambda_core.testing import check_model, evaluate, states_over_time

_SILENT = ["load", "semi_a", "semi_b", "p_max", "u_mean", "u_slide", "spin", "h", "Lambda", "psi", "T_film"]
ZERO = dict.fromkeys(_SILENT, 0.0)


def test_laws():
    assert abs(evaluate(warm, T_in=313.15, power=3.0, t=0.0, **ZERO)[0] - 3.0 / 2e-3) < 1e-9
    check_model(warm)
    check_model(warm_eyring)


def test_a_contact_warms_as_one_lump_does():
    par = {"capacity": 2e-3, "conductance": 0.2}
    warmer = states_over_time(warm, [0.0, 0.01], par, T_in=lambda t: 313.15, power=3.0, **ZERO)[:, 0]
    rise = 3.0 / 0.2 * (1.0 - math.exp(-0.01 * 0.2 / 2e-3))
    assert abs(warmer[1] - 313.15 - rise - (warmer[0] - 313.15) * math.exp(-1.0)) < 1e-5
