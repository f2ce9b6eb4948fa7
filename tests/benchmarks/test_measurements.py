"""Test that benchmarks measure what they claim."""

from __future__ import annotations

import json
from functools import cache

import numpy as np
import pytest

from benchmarks import shaft_cost
from benchmarks.__main__ import main
from benchmarks.accuracy import Outcome, trajectory_totals
from benchmarks.cases import BALLS, MIDDLE, with_balls, without_samples
from benchmarks.handle import Handle
from benchmarks.integrators import Problem, cvode
from benchmarks.parallel import friction_map
from benchmarks.passage import Horizon, passage
from benchmarks.shaft import on_a_shaft, together
from lambda_core.solver.arrays import bundle as L
from lambda_core.solver.core import core
from lambda_core.solver.drivers.dynamics import initial_state
from lambda_core.solver.drivers.equilibrium import Equilibrium, solve


@cache
def start() -> Equilibrium:
    return solve(without_samples(MIDDLE.model()))


def test_the_handle_computes_what_the_solver_computes() -> None:
    context, y = start().context, initial_state(start())
    expected, got = np.zeros(y.size), np.zeros(y.size)
    assert core().evaluate(0.0, y, context.bundle, expected, np.zeros(L.power_count(context.bundle)), 0) == 1
    assert Handle(context).slope(0.0, y, got) == 1
    np.testing.assert_array_equal(got, expected)


def test_the_dense_jacobian_is_the_slope_of_the_right_hand_side() -> None:
    handle, y = Handle(start().context), initial_state(start())
    jacobian, up, down = np.zeros((y.size, y.size)), np.zeros(y.size), np.zeros(y.size)
    assert handle.jacobian(0.0, y, jacobian) == 1
    direction = start().context.scale * np.random.default_rng(1).uniform(-1.0, 1.0, y.size) * 1e-5
    handle.slope(0.0, y + direction, up)
    handle.slope(0.0, y - direction, down)
    change, predicted = 0.5 * (up - down), jacobian @ direction
    assert np.linalg.norm(change - predicted) <= 0.02 * np.linalg.norm(change)


def test_factors_of_bearings_on_one_shaft_are_computed_each_time() -> None:
    """Spoil the factors and repeat them.

    Several bearings on a shaft otherwise keep those of balls whose blocks are not newer.
    """
    context = on_a_shaft(start().context, [0.0, 0.0])
    handle = Handle(context)
    handle.settle_at(0.0, together(start().context, [initial_state(start())] * 2), 1e-6)
    expected = context.factors.own.copy()
    context.factors.own[:] = np.nan
    handle.repeat_factor(1, 1e-6)
    np.testing.assert_array_equal(context.factors.own, expected)


@pytest.mark.full
def test_integrators_agree_on_the_losses() -> None:
    """Compare power and cage speed of two integrators.

    They sum up the losses in different ways.
    """
    pytest.importorskip("sksundae")
    ours = passage(start().context.model, start(), Horizon(0.0, 1.0), samples=False)
    problem = Problem(start().context.model, start(), ours.simulated)
    other = cvode(problem, 1e-3, "dense", own_jacobian=False)
    first, last = trajectory_totals(problem.handle, other.times, other.states, (0.0, problem.end))
    theirs = Outcome.of(first, first, last)
    assert theirs.raceway_power == pytest.approx(ours.outcome.raceway_power, rel=5e-3)
    assert theirs.cage_ratio == pytest.approx(ours.outcome.cage_ratio, rel=2e-3)
    assert abs(theirs.energy_residual) < 5e-3


def test_nine_balls_are_the_bearing_itself() -> None:
    same, more = with_balls(BALLS), with_balls(2 * BALLS)
    original = MIDDLE.model()
    for name in ("ball_diameter", "pitch_diameter", "race_diameter_inner", "clearance", "groove_radius_outer"):
        assert getattr(same.geometry, name) == pytest.approx(getattr(original.geometry, name), rel=1e-9)
    assert more.geometry.ball_diameter == pytest.approx(original.geometry.ball_diameter)
    assert more.geometry.pitch_diameter == pytest.approx(2.0 * original.geometry.pitch_diameter)


@pytest.mark.full
def test_the_command_answers_in_json(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["--quick", "--json", "operating_point"]) == 0
    data = json.loads(capsys.readouterr().out)
    (section,) = data["sections"]
    assert section["name"] == "operating_point"
    assert all(milliseconds > 0.0 for row in section["tables"][0]["rows"] for milliseconds in row[1:])
    assert data["targets"][0]["unit"] == "ms"
    assert data["machine"]["versions"]


@pytest.mark.full
def test_a_shaft_is_compared_with_its_bearings(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(shaft_cost, "_MILLISECONDS_QUICK", 10)
    assert main(["--quick", "--json", "shaft_cost"]) == 0
    (section,) = json.loads(capsys.readouterr().out)["sections"]
    (table,), (target,) = section["tables"], section["targets"]
    rows = {row[0]: dict(zip(table["columns"], row, strict=True)) for row in table["rows"]}
    assert list(rows) == ["machine", "left", "right"]
    for name, row in rows.items():
        of_all = (2 if name == "machine" else 1) * row["Newton iterations"]
        assert row["bearings evaluated"] == of_all - row["bypasses"] >= row["steps"] > 0
    assert rows["machine"]["bypasses"] > 0 == rows["left"]["bypasses"]
    assert target["reached"] == pytest.approx(rows["machine"]["ms"] / (rows["left"]["ms"] + rows["right"]["ms"]))


def test_the_friction_map_has_the_speeds_that_are_asked_for() -> None:
    study = friction_map(7)
    assert study["parameters"][0]["path"] == "operation.speed"
    assert study["parameters"][0]["points"] == 7
