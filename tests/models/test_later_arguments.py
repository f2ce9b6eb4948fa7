"""Test arguments that a role got later.

A kernel names them or not.
"""

from __future__ import annotations

import pytest

from lambda_core.domain.plugin_errors import PluginError
from lambda_core.laws.kernels import compile_kernel
from lambda_core.laws.law import law_of
from lambda_core.plugins import OK, law
from lambda_core.testing import check_model, evaluate


@law("damping", "of-the-film", role_api=3, reference="own work")
def of_the_film(delta, delta_dot, load, u_mean, eta0, par, out):  # type: ignore[no-untyped-def]
    """Write a recognisable number.

    Viscosity times the arguments of the contact.
    """
    out[0] = eta0 * (1.0 + u_mean) * delta_dot
    return OK


@law("damping", "in-another-order", role_api=3, reference="own work")
def in_another_order(delta, delta_dot, load, eta0, u_mean, par, out):  # type: ignore[no-untyped-def]
    out[0] = 0.0
    return OK


def test_a_kernel_gets_what_it_names() -> None:
    check_model(of_the_film)
    given = {"delta": 1e-6, "delta_dot": 0.5, "load": 10.0, "u_mean": 3.0, "eta0": 0.1}
    assert evaluate(of_the_film, **given)[0] == pytest.approx(0.1 * 4.0 * 0.5)


def test_the_order_is_the_roles() -> None:
    swapped = law_of(in_another_order)
    assert swapped is not None
    with pytest.raises(PluginError, match=r"damping kernels take .*u_mean, semi_a.* need only .*load, u_mean, eta0"):
        compile_kernel(swapped)
