"""Test paths of balls across grooves against a run."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from lambda_core import api
from lambda_core.model.bearing_model import BearingModel
from lambda_core.model.checking import check_bearing
from lambda_core.solver import records as R
from lambda_core.solver.arrays import bundle as L
from lambda_core.solver.drivers import ball_paths
from lambda_core.solver.drivers.ball_paths import path_velocities
from lambda_core.solver.drivers.dynamics import BearingEngine
from lambda_core.solver.drivers.equilibrium import solve

COMBINED = ["loads.radial=1 kN", "operation.speed=1000 rpm", "models.fluid_drag=none"]


def test_velocity_along_a_known_path() -> None:
    """Compare velocity along a path by hand.

    x = x0 + a cos(psi) + b sin(2 psi) has dx/dt = omega (-a sin(psi) + 2 b cos(2 psi)), for even and odd rows.
    """
    for count in (7, 8):
        balls = np.zeros(count, R.BALL)
        psi = 2.0 * np.pi * np.arange(count) / count - 0.3
        balls["x"] = 1e-3 + 2e-5 * np.cos(psi) + 1e-5 * np.sin(2.0 * psi)
        balls["radius"], balls["velocity"][:, 2] = 0.03, 0.03 * 42.0
        along = 42.0 * (-2e-5 * np.sin(psi) + 2e-5 * np.cos(2.0 * psi))
        found = path_velocities(balls)
        assert found[:, 0] == pytest.approx(along, abs=1e-12)
        assert found[:, 1] == pytest.approx(0.0, abs=1e-12)


def test_tilt_under_combined_load_is_that_of_a_run() -> None:
    """Compare shift and tilt with a run to 5 %.

    6208, 1 kN radial and 0.7 kN axial, free to tilt, 1000 1/min.

    Balls that stood on their paths dragged the ring aside twice as far.
    """
    model = api.check("6208-axial-700", COMBINED)
    still = solve(model)
    engine = BearingEngine(model, equilibrium=still)
    assert engine.advance(0.1).ok
    engine.forget_samples()
    assert engine.advance(0.4).ok
    samples = engine.samples()
    shift = samples["body_position"][:, 0, 1].mean()
    lean = samples["body_tilt"][:, 0, 1].mean()
    assert still.displacement[1] == pytest.approx(shift, rel=0.05)
    assert still.displacement[4] == pytest.approx(lean, rel=0.05)
    assert abs(shift) > 0.5e-6


def test_one_load_alone_has_no_path() -> None:
    """Find no axial motion under radial load."""
    model = api.check("6319-cp10-500")
    balls = solve(model).state[: L.NB * model.geometry.ball_count].view(R.BALL)
    assert not balls["velocity"][:, :2].any()


def test_paths_are_found_at_low_speed_where_few_balls_carry(tmp_path: Path, caplog: pytest.LogCaptureFixture) -> None:
    """Find paths near 70 1/min.

    Left bearing of the shaft that `init` writes: steps of a fixed share diverged there, with a warning.
    """
    box = api.init_case("box", template="geared-shaft", path=tmp_path / "box.toml")
    api.stribeck(box, bearing="left", speeds_rpm=[37.0, 68.0])
    assert not [record for record in caplog.records if "deviate from their paths" in record.getMessage()]


def double_row() -> BearingModel:
    """Return two rows with a ball at its limit."""
    return check_bearing(
        {
            "name": "double",
            "bearing": {"designation": "3317A", "maker": "SKF"},
            "lubricant": {"name": "FVA3A", "temperature": "60 degC"},
            "loads": {"radial": "2 kN"},
            "operation": {"speed": "1500 rpm"},
            "bodies": {"inner_ring": {"tilt_y": "locked", "tilt_z": "locked"}},
        },
        is_static=True,
    )


def test_a_ball_at_its_limit_is_held_as_it_was(
    monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture
) -> None:
    """Find paths where a ball alternates between two motions.

    Decided anew each time, 20 steps alternated between two motions and ended with a warning.
    """
    asked: list[int] = []
    monkeypatch.setattr(ball_paths, "path_velocities", lambda row: [asked.append(1), path_velocities(row)][1])
    found = solve(double_row(), phase=0.125)
    assert len(asked) <= 2 * 6  # two rows
    assert not [record for record in caplog.records if "deviate from their paths" in record.getMessage()]
    # all steps, in the motion that they ended in
    assert found.losses.sum() == pytest.approx(110.554, rel=1e-3)


def test_alternating_stages_go_on_from_the_even_one() -> None:
    """Choose the motion in which all steps would end."""
    sets = [np.array(each) for each in ([0, 0], [1, 0], [0, 0], [0, 1], [0, 0])]
    stages = [ball_paths._Stage(each, each, each, each, each) for each in sets]
    assert ball_paths._first_of_alternating(stages[:1], sets[0]) is None
    assert ball_paths._first_of_alternating(stages[:2], sets[1]) is None  # settled
    assert ball_paths._first_of_alternating(stages[:2], sets[3]) is None  # a third set
    assert ball_paths._first_of_alternating(stages[:2], sets[0]) is stages[0]
    assert ball_paths._first_of_alternating(stages[1:4], sets[2]) is stages[3]
