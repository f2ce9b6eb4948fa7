"""Test a traction law without a limiting stress.

Told when it is checked, and where no equilibrium is found.
"""

from __future__ import annotations

from math import exp
from typing import Any

import pytest

from lambda_core import api
from lambda_core.discovery.manager import registry
from lambda_core.domain.errors import SolverError
from lambda_core.domain.plugin_errors import PluginError
from lambda_core.laws.check import check_model
from lambda_core.laws.law import law_of
from lambda_core.laws.parameter import Parameters, default_fault, parameter
from lambda_core.plugins import OK, NoParameters, law
from lambda_core.solver.drivers import equilibrium

BUILT_IN = registry().names("traction")


@law("traction", "limitless", role_api=3, reference="none")
def limitless(slip: Any, p: Any, T: Any, ln_eta: Any, h: Any, par: NoParameters, tau: Any) -> int:
    for i in range(slip.size):
        tau[i] = exp(min(ln_eta[i], 40.0)) * slip[i] / h[i]
    return OK


def test_a_law_without_a_limiting_stress_is_warned_of() -> None:
    made = law_of(limitless)
    assert made is not None
    (warning,) = check_model(made).warnings
    assert "gives shear stresses of up to" in warning
    assert "hold them at a limiting stress" in warning


@pytest.mark.parametrize("name", BUILT_IN)
def test_built_in_laws_stay_below_the_limit(name: str) -> None:
    model = registry().model("traction", name)
    assert check_model(model).warnings == ()


def test_where_no_equilibrium_is_found_the_law_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    """Name the law without a limit of shear stress.

    One iteration is too few for any law; the message must not blame speed or temperature.
    """
    monkeypatch.setattr(equilibrium, "MAX_ITERATIONS", {False: 5000, True: 0})
    monkeypatch.setattr(equilibrium, "_FRESH_STARTS", 0)
    for chosen, expected in (("ree-eyring", "try a speed or temperature nearby"), (limitless, "limiting stress")):
        case = api.case("6319-cp10-1500").with_(models={"traction": chosen})
        with pytest.raises(SolverError, match=expected):
            equilibrium.solve(api.check(case))


def test_a_law_of_no_oil_is_given_up_after_one_attempt(monkeypatch: pytest.MonkeyPatch) -> None:
    """Stop after one attempt.

    Four new starts and four warmer oils multiplied the time before the same message.
    """
    monkeypatch.setattr(equilibrium, "MAX_ITERATIONS", {False: 5000, True: 0})
    monkeypatch.setattr(equilibrium, "_FRESH_ITERATIONS", 0)
    attempt, made = equilibrium.attempt, []

    def counted(*arguments: Any) -> Any:
        made.append(arguments[3])
        return attempt(*arguments)

    monkeypatch.setattr(equilibrium, "attempt", counted)
    case = api.case("6319-cp10-1500").with_(models={"traction": limitless})
    with pytest.raises(SolverError, match="limiting stress"):
        equilibrium.solve(api.check(case))
    assert made.count(0) == 1


def test_a_default_with_a_unit_says_how_its_parameter_is_declared() -> None:
    class Stress(Parameters):
        tau: float = parameter("6 MPa", "Eyring stress")

    fault = default_fault(Stress)
    assert 'tau: Annotated[float, Quantity("pressure")]' in fault


def test_a_unit_as_keyword_of_a_parameter_is_refused() -> None:
    with pytest.raises(PluginError, match=r"no `unit`: bounds are ge, gt, le, lt; .* Annotated\[float, Quantity"):
        parameter(6e6, "Eyring stress", unit="Pa")
