"""Test that messages about refusing laws name their arguments."""

from __future__ import annotations

from typing import Any

import pytest

from lambda_core import api
from lambda_core.domain.errors import LambdaError
from lambda_core.domain.roles import ROLES as KERNELS
from lambda_core.plugins import NoParameters, law
from lambda_core.solver.arrays.fault_roles import ROLES
from lambda_core.solver.drivers.equilibrium import solve
from lambda_core.solver.drivers.fault_inputs import INPUTS


def test_every_role_of_the_solver_names_its_inputs() -> None:
    assert set(INPUTS) == set(ROLES)
    for role, names in INPUTS.items():
        known = {argument.name for argument in KERNELS[role].arguments} | {
            "heated",
            "load",
            "out",
            "state",
        }  # of the contact
        assert {name.partition("[")[0] for name in names} <= known, role


@law("fluid_drag", "choosy", role_api=3, reference="none", errors={2: "too fast for this law"})
def choosy(
    v_orbit: float, omega_spin: float, azimuth: float, nu: float, rho: float, par: NoParameters, out: Any
) -> int:
    out[0] = 0.0
    out[1] = 0.0
    return 2 if v_orbit > 0.5 and nu > 0.0 else 1


def test_a_refusing_law_is_told_with_the_names_of_its_inputs() -> None:
    case = api.case("6319-cp10-1500").with_(models={"fluid_drag": choosy})
    with pytest.raises(LambdaError, match=r"too fast for this law \(.*v_orbit [0-9.]+, omega_spin [0-9.]+, azimuth"):
        solve(api.check(case))
