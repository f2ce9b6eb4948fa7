"""Test drag of the oil bath in the quasi-static equilibrium.

The mean of one revolution on every ball.
"""

from __future__ import annotations

import numpy as np

from lambda_core import api
from lambda_core.solver.arrays import bundle as L
from lambda_core.solver.drivers.equilibrium import Equilibrium, solve

from .test_physics_angular_contact import BALLS, CASE


def fast_thrust(*changes: str) -> Equilibrium:
    """Return the 218 under thrust.

    4.45 kN at 10 000 1/min in an oil bath, without weight.
    """
    model = api.check(CASE, ["operation.speed=10000 rpm", "loads.axial=4450 N", "gravity.z=0 m/s2", *changes])
    return solve(model)


def test_the_ball_in_the_oil_bath_carries_as_much_as_the_others() -> None:
    """Load all balls alike under pure thrust.

    The ring stays in the middle, and the ball in the oil bath carries as much.
    """
    found = fast_thrust()
    loads = found.contacts[:, 0, 0]
    assert np.ptp(loads) < 1e-6 * loads.mean()
    assert float(np.hypot(*found.displacement[1:3])) < 1e-9
    balls = found.state[: L.NB * BALLS].reshape(BALLS, L.NB)
    orbits = balls[:, L.BVT] / balls[:, L.BR]
    assert np.ptp(orbits) < 1e-6 * orbits.mean()


def test_drag_slows_the_balls_of_a_quasi_static_solution() -> None:
    """Slow the balls by more oil.

    The mean of the drag over a revolution acts.
    """
    free, usual, full = (
        fast_thrust(*change).orbit for change in (["models.fluid_drag=none"], [], ["lubricant.oil_level=60 mm"])
    )
    assert full < usual < free


def test_the_friction_of_a_quasi_static_solution_does_not_depend_on_where_the_balls_stand() -> None:
    """Turn the balls by half a pitch.

    Under pure thrust this changes neither friction nor losses of the drag.
    """
    model = api.check(CASE, ["operation.speed=3000 rpm", "gravity.z=0 m/s2"])
    losses = [float(solve(model, phase=phase).losses.sum()) for phase in (0.0, 0.5)]
    assert losses[0] == losses[1] or abs(losses[0] / losses[1] - 1.0) < 1e-5


def test_in_motion_drag_is_that_at_the_azimuth_of_the_ball() -> None:
    """Compute drag at each ball in motion.

    The mean is for solutions without time; after the equilibrium the tables ask for drag at each ball again.
    """
    assert fast_thrust().context.bundle.system[0]["drag_azimuths"] == 1
