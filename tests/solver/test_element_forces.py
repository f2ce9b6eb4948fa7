"""Test forces and powers of force elements at samples.

Those that the compiled right-hand side computes with.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from lambda_core import api
from lambda_core.model.machine_templates import shaft_text
from lambda_core.solver.arrays.bundle import power_count
from lambda_core.solver.core import core
from lambda_core.solver.drivers.element_forces import element_forces
from lambda_core.solver.drivers.tables import running

from .test_power import MODELS, machine, random_state

SPRING = (
    "solver.duration=0.3 ms", "elements.spring.second=inner_ring", "elements.spring.parameters.stiffness_x=2 N/um",
    "elements.spring.parameters.damping_x=300 N s/m", "elements.spring.parameters.preload_x=40 N",
)  # fmt: skip
SEAL = """
[connections.seal]
at = "160 mm"
law = "bushing"
parameters = { stiffness_z = "1 N/um", spin_damping = "0.001 N m s/rad" }
"""


def test_power_and_force_are_those_of_the_right_hand_side() -> None:
    """Compare with the right-hand side to rounding.

    Without their parameters the bushings have no force: the difference is the bushings' action.
    """
    m = machine(*MODELS["force elements"])
    y, bundle = random_state(m, 3, "rolling"), m.context.bundle
    found, power = element_forces(m.context, np.zeros(1), m.shared_state(y, 0.0).reshape(1, -1))
    seen = []
    for factor in (1.0, 0.0):
        for row in bundle.links:
            bundle.par[slice(*row["parameters"])] *= factor
        rates = np.zeros(power_count(bundle))
        assert core().evaluate(0.0, y, bundle, np.zeros(y.size), rates, 1) == 1
        powers = running(rates)  # what turns the ring takes what an element at its rim brings
        seen.append((float(powers["input"] - powers["drive"]), bundle.body_wrenches["force"].copy()))
    (with_power, with_force), (without_power, without_force) = seen
    assert abs(power.sum()) > 0.1
    assert power.sum() == pytest.approx(with_power - without_power, abs=1e-9 * abs(with_power))
    expected = np.zeros_like(with_force)
    for row in bundle.links:
        expected[row["second"]] += found[0, row["number"], :3]
        if row["first"] >= 0:
            expected[row["first"]] -= found[0, row["number"], :3]
    assert np.abs(expected).max() > 1.0
    np.testing.assert_allclose(with_force - without_force, expected, rtol=0.0, atol=1e-9 * np.abs(with_force).max())


def test_a_run_writes_force_and_power_of_an_element(tmp_path: Path) -> None:
    result = api.run("6208-axial-1300", SPRING, out=tmp_path / "r.h5")
    x = np.asarray(result["body_position"])[:, 0, 0]
    v = np.asarray(result["body_velocity"])[:, 0, 0]
    force, power = np.asarray(result["element_force"]), np.asarray(result["element_power"])
    assert list(result.labels("element")) == ["spring"]
    np.testing.assert_allclose(force[:, 0, 0], 40.0 - 2e6 * x - 300.0 * v, rtol=1e-9)
    np.testing.assert_allclose(power[:, 0], force[:, 0, 0] * v, rtol=1e-9, atol=1e-15)
    summary = result.summary()
    assert summary.elements["spring"].force_N[0] == pytest.approx(force[:, 0, 0].mean(), rel=1e-2)
    assert "element spring" in summary.text()


def test_a_machine_writes_force_and_power_of_a_connection(tmp_path: Path) -> None:
    (tmp_path / "box.toml").write_text(shaft_text("geared-shaft", "box") + SEAL)
    result = api.run(tmp_path / "box.toml", ["solver.duration=0.2 ms"], out=tmp_path / "r.h5")
    summary = result.summary()
    turning = 3000.0 * np.pi / 30.0
    # the seal brakes the turning shaft: -c omega^2
    assert summary.elements["seal"].power_W == pytest.approx(-1e-3 * turning**2, rel=1e-3)
    assert "element seal" in summary.text()
    assert np.asarray(result.of_machine()["connection_force"]).shape[1:] == (1, 3)
