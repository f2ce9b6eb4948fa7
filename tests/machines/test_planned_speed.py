"""Test that laws and steps follow the planned speed."""

from __future__ import annotations

import tomllib
from typing import Any

import numpy as np
import pytest

from lambda_core.model.laws.law_context import max_speed
from lambda_core.model.machine_templates import shaft_text
from lambda_core.model.resolve_machine import resolve_machine
from lambda_core.solver.drivers.damping import _freed
from lambda_core.solver.drivers.law_inputs import RACEWAYS
from lambda_core.solver.drivers.machine_motion import MachineEngine, machine_engine
from lambda_core.solver.drivers.surface_steps import longest_step

DEFECT = {"models": {"surface": "defect"}, "parameters": {"surface": {"width": "0.8 mm", "depth": "20 um"}}}


@pytest.fixture(scope="module")
def engine() -> MachineEngine:
    """Return a shaft with a defect.

    It is on the left bearing's outer raceway.
    """
    tables: dict[str, Any] = tomllib.loads(shaft_text("geared-shaft", "box"))
    tables["bearings"]["left"]["forces"] = {"ball_outer": DEFECT}
    return machine_engine(resolve_machine(tables))


def test_laws_see_the_speed_of_the_shaft(engine: MachineEngine) -> None:
    """Pass the shaft's speed to the laws.

    In motion and about the equilibrium; parameters of damping that depend on it have the same bits.
    """
    machine, bundle = engine.model, engine.context.bundle
    for one, found in zip(engine.bearings, engine.start.equilibria, strict=True):
        assert max_speed(one.context.model) == machine.speed > 0.0
        assert max_speed(_freed(found.context).model) == machine.speed
        for ring, element in enumerate(RACEWAYS):
            begin, end = bundle.raceways[one.span.first_raceway + ring]["parameters"]["damping"]
            assert np.array_equal(bundle.par[begin:end], found.context.parameters(element, "damping"))


def test_no_step_of_a_machine_leaps_over_a_defect(engine: MachineEngine) -> None:
    """Cross a defect of 0.8 mm in four steps.

    The ball passes it, on the outer raceway, at 0.41 of 314 rad/s, 40 mm from the axis, 0.16 ms.
    """
    expected = longest_step(engine.start.equilibria[0].context)
    assert 1e-6 < expected < 0.16e-3 / 4.0
    assert float(engine._memory.control["longest_step"][0]) == expected
