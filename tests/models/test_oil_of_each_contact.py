"""Test that each raceway's contact has its own oil constants."""

from __future__ import annotations

import pytest

from lambda_core import api
from lambda_core.laws.context import Oil
from lambda_core.model.laws.law_context import ContactFrame
from lambda_core.solver.drivers.compiled_laws import Kernels, derive_oils

FRAME = ContactFrame((0.0, 0.0), (1000.0, 1000.0))
ROELANDS = "models.rheology=roelands"


def oils(*changes: str) -> tuple[Oil, Oil]:
    model = api.check("6319-cp10-1500", changes)
    return derive_oils(model, Kernels(model), FRAME)


def test_each_contact_takes_the_constants_of_its_own_rheology() -> None:
    usual, other = oils()[0], oils(ROELANDS)[0]
    assert other.alpha_p != pytest.approx(usual.alpha_p, rel=1e-3)
    assert oils(f"forces.ball_outer.{ROELANDS}") == (usual, other)
    assert oils(f"forces.ball_inner.{ROELANDS}") == (other, usual)
