"""Test a ring on springs under a half-sine shock.

One mass, one spring: the bearing is too wide to touch the ring.
"""

import numpy as np
from shock_pulse import half_sine

from lambda_core import api
from lambda_core.testing import check_model

MASS, STIFFNESS, LOAD, LASTS = 2.0, 2e6, 100.0, 4e-3
CASE = [
    "bearing.clearance=0.3 mm", "loads.axial=0 N", "gravity.z=0 m/s2", f"bodies.inner_ring.mass={MASS} kg",
    "elements.s.law=bushing", "elements.s.second=inner_ring", "solver.tolerance=1e-4", "solver.duration=4 ms",
    "output.interval=0.1 ms", *(f"elements.s.parameters.stiffness_{axis}={STIFFNESS} N/m" for axis in "xyz"),
    f'loads.inner_ring.force_y={{kind="law", law="half-sine", amplitude="{LOAD} N", '
    f'parameters={{start="0 s", duration="{LASTS} s"}}}}',
]  # fmt: skip


def test_answer_to_a_shock(tmp_path):
    check_model(half_sine)
    result = api.run("6208-axial-1300", CASE, out=tmp_path / "run.h5")
    own, forced, t = np.sqrt(STIFFNESS / MASS), np.pi / LASTS, result["time"]
    wave = np.sin(forced * t) - forced / own * np.sin(own * t)
    expected = LOAD / MASS / (own**2 - forced**2) * wave
    np.testing.assert_allclose(result["body_position"][:, 0, 1], expected, atol=2e-3 * LOAD / STIFFNESS)
    assert abs(result.summary().energy_residual) < 1e-3
