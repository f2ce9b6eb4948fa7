"""Test the heat balance and the contracts of both laws."""

from warm_contact import warm, warm_eyring

from lambda_core.testing import check_model, evaluate


def test_laws():
    zero = dict.fromkeys(
        ["t", "load", "semi_a", "semi_b", "p_max", "u_mean", "u_slide", "spin", "h", "Lambda", "psi", "T_film"], 0.0
    )
    assert abs(evaluate(warm, T_in=313.15, power=3.0, **zero)[0] - 3.0 / 2e-3) < 1e-9
    check_model(warm)
    check_model(warm_eyring)
