"""Test a released ring against one mass on a spring.

The bearing is too wide to touch the ring; frequency and decay are those of the mass.
"""

import numpy as np
from spring_damper import spring_damper

from lambda_core import api
from lambda_core.testing import check_model

MASS, STIFFNESS, DAMPING, LOAD = 2.0, 2e6, 200.0, 100.0
CASE = [
    "bearing.clearance=0.2 mm", "loads.axial=0 N", "gravity.z=0 m/s2", f"bodies.inner_ring.mass={MASS} kg",
    "elements.s.law=spring-damper", "elements.s.second=inner_ring", f"elements.s.parameters.stiffness={STIFFNESS} N/m",
    f"elements.s.parameters.damping={DAMPING} N s/m", "solver.tolerance=3e-5", "solver.duration=6 ms",
    "output.interval=0.1 ms",
    f'loads.inner_ring.force_y={{kind="ramp", start="{LOAD} N", end="0 N", start_time="0.1 us", end_time="0.2 us"}}',
]  # fmt: skip


def test_frequency_and_decay(tmp_path):
    check_model(spring_damper)
    result = api.run("6208-axial-1300", CASE, out=tmp_path / "run.h5")
    decay = DAMPING / (2.0 * MASS)
    turning = np.sqrt(STIFFNESS / MASS - decay**2)
    t = result["time"] - 0.15e-6
    wave = np.cos(turning * t) + decay / turning * np.sin(turning * t)
    expected = LOAD / STIFFNESS * np.exp(-decay * t) * wave
    np.testing.assert_allclose(result["body_position"][1:, 0, 1], expected[1:], atol=2e-3 * LOAD / STIFFNESS)
    assert abs(result.summary().energy_residual) < 1e-3
