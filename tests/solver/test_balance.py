"""Test the energy accounting of the integrator.

It tests identities of the BDF, and the work of prescribed ring motion.
"""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np
import pytest

from lambda_core import api
from lambda_core.solver.arrays import integrator_memory as M
from lambda_core.solver.drivers.dynamics import BearingEngine
from lambda_core.solver.integrator import balance

RIM = "6319-cp10-1500"


@pytest.fixture
def in_python(monkeypatch: pytest.MonkeyPatch) -> None:
    """Let the estimate call plain Python.

    There is no machine code behind a part of the solver.
    """
    monkeypatch.setattr(balance, "_energy_of_bends", balance._energy_of_bends.py_func)


def memory(new: float, y: float, y1: float, h: float, h1: float) -> SimpleNamespace:
    """Return the estimate's inputs.

    For one speed of mass 1.
    """
    w = h / h1
    control = np.zeros(1, dtype=M.CONTROL).view(np.recarray)
    control["last_step"], control["back"] = h1, w * w / (1.0 + 2.0 * w)
    values = {"new": new, "y": y, "y1": y1, "inertia": 1.0}
    return SimpleNamespace(control=control, **{name: np.array([value]) for name, value in values.items()})


@pytest.mark.usefixtures("in_python")
def test_dissipation_of_equal_steps_is_a_quarter_of_the_squared_second_difference() -> None:
    assert balance._dissipated.py_func(memory(3.0, 1.0, 0.5, 2.0, 2.0), 2.0) == pytest.approx(0.25 * 1.5**2)


@pytest.mark.usefixtures("in_python")
@pytest.mark.parametrize("w", [0.5, 1.0, 1.7])
def test_a_steady_acceleration_loses_nothing(w: float) -> None:
    assert balance._dissipated.py_func(memory(1.0 + w, 1.0, 0.0, w, 1.0), w) == pytest.approx(0.0, abs=1e-15)


@pytest.mark.usefixtures("in_python")
@pytest.mark.parametrize("steps", [20, 40, 80])
def test_an_oscillator_loses_what_the_estimate_says(steps: int) -> None:
    """Compare the loss of an oscillator with its estimate.

    x'' = -x by BDF2 with equal steps: half of the loss is the kinetic estimate's, half the spring's.
    """
    h = 2.0 * np.pi / steps
    gamma, count = 2.0 * h / 3.0, 5 * steps
    points = [np.array([np.cos(t), -np.sin(t)]) for t in (-h, 0.0)]
    matrix = np.linalg.inv(np.array([[1.0, -gamma], [gamma, 1.0]]))
    for _ in range(count):
        points.append(matrix @ (4.0 * points[-1] - points[-2]) / 3.0)
    estimate = sum(
        balance._dissipated.py_func(memory(points[k][1], points[k - 1][1], points[k - 2][1], h, h), h)
        for k in range(2, len(points))
    )
    lost = 0.5 * (points[1] @ points[1] - points[-1] @ points[-1])
    assert lost > 0.0
    assert 2.0 * estimate == pytest.approx(lost, rel=0.5 * h)  # exact but for the ends, as steps shrink


def test_the_corner_of_a_ramp_costs_no_energy() -> None:
    """Balance energy at the corner of a ramp.

    The spin-up ends at full power: 740 kW stop within one step, and the kinetic energy equals the drive's work.
    """
    ramp = {"kind": "ramp", "start": "0 rpm", "end": "1500 rpm", "start_time": "1 ms", "end_time": "2 ms"}
    engine = BearingEngine(api.check(RIM, [f"operation.speed.{key}={value}" for key, value in ramp.items()]))
    assert engine.advance(2.5e-3).ok
    found = engine.integrals()
    lost = sum(value for name, value in found.items() if name.startswith(("loss.", "support")))
    assert found["stored"] > 50.0
    assert abs(found["input"] - lost - found["stored"]) < 5e-4 * found["input_abs"]
