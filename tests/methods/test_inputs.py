"""What methods get from a resolved model and its equilibrium."""

from __future__ import annotations

import math

import pytest

from lambda_core.physics.method_inputs import carried_load
from lambda_core.registry.method import ContactLoad, EquilibriumState


def test_carried_load_of_an_axially_loaded_bearing() -> None:
    angle = math.radians(15.0)
    contacts = tuple(ContactLoad(2 * math.pi * i / 9, 500.0, 500.0, angle, angle) for i in range(9))
    radial, axial = carried_load(EquilibriumState(contacts, (0.0,) * 5))
    assert axial == pytest.approx(9 * 500.0 * math.sin(angle))
    assert radial == pytest.approx(0.0, abs=1e-9)


def test_carried_load_of_one_ball() -> None:
    contact = ContactLoad(-math.pi / 2, 1000.0, 1010.0, -0.1, -0.1)
    radial, axial = carried_load(EquilibriumState((contact,), (0.0,) * 5))
    assert radial == pytest.approx(1000.0 * math.cos(0.1))
    assert axial == pytest.approx(1000.0 * math.sin(0.1))
