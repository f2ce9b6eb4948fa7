"""Test runs step by step.

The same dynamics as a run, and loads from outside that act like those of the case.
"""

from __future__ import annotations

import math
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
import pytest

from lambda_core import api
from lambda_core.domain.errors import SolverError, UsageError
from lambda_core.results.averages import COLUMNS

if TYPE_CHECKING:
    from lambda_core.results.reader import Result

CASE = "6319-cp10-1500"


def test_stepping_is_the_run_bit_for_bit(tmp_path: Path) -> None:
    changes = ["solver.duration=4 ms"]
    run = api.run(CASE, changes, out=tmp_path / "run.h5").integrals()[-1]
    for interval in (None, 0.6e-3):
        steps = list(api.iterate(CASE, changes, interval=interval))
        last = steps[-1]
        assert last.time_s == run[COLUMNS.index("time")]
        angle = last["body_spin_angle"][0] - steps[0]["body_spin_angle"][0]
        assert angle == pytest.approx(1500.0 * math.pi / 30.0 * (last.time_s - steps[0].time_s), rel=1e-9)
        times = np.array([step.time_s for step in steps])
        assert np.all(np.diff(times) > 0.0)
        # The mean over all steps is the mean of the run.
        weights = np.diff(np.append(0.0, times))
        mean = np.average([step.friction_torque_Nmm for step in steps], weights=weights)
        columns = [COLUMNS.index(name) for name in COLUMNS if name.startswith("loss.")]
        assert mean == pytest.approx(1e3 * run[columns].sum() / run[COLUMNS.index("relative_angle")], rel=1e-9)


def test_a_step_has_every_channel_of_a_result(radial_run: Result) -> None:
    step = next(api.iterate(CASE, ["solver.duration=1 ms"]))
    for channel in radial_run.channels:
        assert step[channel.name].shape == radial_run[channel.name].shape[1:]
    with pytest.raises(UsageError, match='"loads" is not a known channel; nearest: load'):
        step["loads"]


def test_a_load_from_outside_acts_like_one_of_the_case() -> None:
    """Compare 14 and 2 kN with 16 kN.

    14 kN in the case and 2 kN from outside hold the ring in the same place.
    """
    stepping = api.iterate(CASE, ["solver.duration=30 ms", "loads.radial=14 kN"], interval=0.2e-3)
    place = []
    for step in stepping:
        stepping.push((0.0, 0.0, -2000.0 * min(step.time_s / 10e-3, 1.0)))  # slowly: no blow
        place.append(1e6 * step["body_position"][0, 2])
    at = {load: api.quasistatic(CASE, [f"loads.radial={load} kN"]).inner_ring_displacement_um[2] for load in (14, 16)}
    assert place[0] == pytest.approx(at[14], abs=0.3)
    assert np.mean(place[-45:]) == pytest.approx(at[16], abs=0.3)
    assert abs(at[16] - at[14]) > 3.0


def test_a_spring_that_another_program_is_shares_the_load() -> None:
    """Share a load with a spring of another program.

    Co-simulation: a support of 100 N/um under the inner ring takes the share of its stiffness.
    """
    stiffness = 1e8  # [N/m], explicit coupling: far softer than the bearing
    stepping = api.iterate(CASE, ["solver.duration=40 ms"], interval=20e-6)
    start = next(stepping)["body_position"][0, 2]
    place = start
    tail = []
    for step in stepping:
        place = step["body_position"][0, 2]
        force = -stiffness * (place - start) - 4000.0 * min(step.time_s / 15e-3, 1.0)
        stepping.push((0.0, 0.0, force))
        if step.time_s > 28e-3:
            tail.append((place - start, force))
    moved, force = np.mean(tail, axis=0)
    loads = 16.0 - 1e-3 * force  # what the bearing carries [kN]
    expected = api.quasistatic(CASE, [f"loads.radial={loads} kN"]).inner_ring_displacement_um[2]
    assert 1e6 * (start + moved) == pytest.approx(expected, abs=0.4)
    assert force == pytest.approx(-4000.0 - stiffness * moved, rel=1e-9)
    assert force > -4000.0  # the spring has taken some


@pytest.mark.parametrize(
    ("interval", "words"),
    [
        *((value, "must be positive and finite") for value in (0.0, -1e-3)),
        *((value, "give a finite number. Time between steps") for value in (math.nan, math.inf)),
    ],
)
def test_intervals_without_sense_are_refused(interval: float, words: str) -> None:
    with pytest.raises(UsageError, match=words):
        api.iterate(CASE, interval=interval)


def test_loads_without_sense_are_refused() -> None:
    stepping = api.iterate(CASE, ["solver.duration=1 ms"])
    with pytest.raises(UsageError, match="3 finite numbers"):
        stepping.push((1.0, 2.0))
    with pytest.raises(UsageError, match="2 finite numbers"):
        stepping.push(moment=(math.nan, 0.0))
    stepping = api.iterate(CASE, ["solver.duration=1 ms", "bodies.inner_ring.tilt_y.mode=locked"])
    with pytest.raises(UsageError, match="the inner ring is locked in tilt_y: a moment there does nothing"):
        stepping.push(moment=(1.0, 0.0))


def test_steps_end_exactly_where_they_are_asked_to() -> None:
    """End steps at given times.

    This changes the motion by less than the integration error.
    """
    changes = ["solver.duration=3 ms"]
    free, exact = (list(api.iterate(CASE, changes, interval=0.1e-3, exact=exact)) for exact in (False, True))
    assert [step.time_s for step in exact[:-1]] == [0.1e-3 * (i + 1) for i in range(len(exact) - 1)]
    assert exact[-1].time_s == 3e-3
    assert exact[-1]["body_position"][0] == pytest.approx(free[-1]["body_position"][0], abs=0.1e-6)
    stepping = api.iterate(CASE, changes)
    for time_s in (1e-9, 0.7e-3, 0.7e-3 + 3e-12, 2e-3):
        assert stepping.step_to(time_s).time_s == time_s
    with pytest.raises(UsageError, match="must end later than it begins"):
        stepping.step_to(1e-3)


def test_going_back_and_on_gives_the_same_bits() -> None:
    stepping = api.iterate(CASE, ["solver.duration=5 ms"], exact=True)
    stepping.step_to(0.5e-3)
    stepping.push((0.0, 0.0, -500.0))
    kept = stepping.state()
    first = stepping.step_to(1e-3)
    stepping.push((0.0, 0.0, 0.0))
    stepping.step_to(1.7e-3)
    stepping.restore(kept)
    again = stepping.step_to(1e-3)
    assert again.friction_torque_Nmm == first.friction_torque_Nmm
    for name in first.channels:
        assert np.array_equal(again[name], first[name], equal_nan=True), name


@pytest.mark.parametrize("exact", [True, False])
def test_what_no_bearing_takes_ends_and_changes_nothing(exact: bool) -> None:
    """Refuse a force in other units.

    Steps of picoseconds lead nowhere; a shock that a bearing may get passes.
    """
    changes = ["solver.duration=5 ms"]
    stepping, other = (api.iterate(CASE, changes, interval=1e-4, exact=exact) for _ in range(2))
    assert next(stepping).time_s == next(other).time_s
    kept = stepping.state()
    stepping.push((1e9, 0.0, 0.0))
    with pytest.raises(
        SolverError, match=r"at t = 0.000\S+ s, on the way to .* iterations are spent .* are loads in N"
    ):
        next(stepping)
    stepping.push()
    again = stepping.state()
    assert [
        name for name in kept if not name.startswith("given.") and kept[name].tobytes() != again[name].tobytes()
    ] == []
    for bearing in (stepping, other):
        bearing.push((0.0, 0.0, -50e3))
    after, expected = next(stepping), next(other)
    for name in expected.channels:
        assert np.array_equal(after[name], expected[name], equal_nan=True), name


def test_a_prescribed_ring_answers_with_the_load_of_its_place() -> None:
    """Move a ring and find a load of 16 kN.

    It moves from the place of 14 kN to that of 16 kN.
    """
    at = {load: api.quasistatic(CASE, [f"loads.radial={load} kN"]).inner_ring_displacement_um[2] for load in (14, 16)}
    stepping = api.iterate(CASE, ["solver.duration=12 ms", "loads.radial=14 kN"], interval=0.1e-3, couple="motion")
    begin, down = 1e-6 * at[14], 1e-6 * (at[16] - at[14])
    lifts = []
    for step in stepping:
        lifts.append(step.reactions["inner_ring"][2])
        share = min(step.time_s / 6e-3, 1.0)
        stepping.give("inner_ring.z", begin + share * down, down / 6e-3 if share < 1.0 else 0.0)
    weight = 9.80665 * stepping.model.inner_ring.mass
    assert lifts[0] == pytest.approx(14e3 + weight, rel=0.02)
    assert np.mean(lifts[-50:]) == pytest.approx(16e3 + weight, rel=0.02)
    assert stepping.step_to(13e-3).reactions["outer_ring"][2] == pytest.approx(-lifts[-1], rel=0.1)


def test_what_is_given_without_sense_is_refused() -> None:
    stepping = api.iterate(CASE, ["solver.duration=1 ms"], couple="motion")
    with pytest.raises(UsageError, match="finite numbers"):
        stepping.give("inner_ring.x", math.nan)
    with pytest.raises(UsageError, match="nearest: inner_ring"):
        stepping.give("inner_ring.xx", 0.0)
    with pytest.raises(UsageError, match="is prescribed in z"):
        stepping.push((0.0, 0.0, 1.0))
    with pytest.raises(UsageError, match='"force" or "motion"'):
        api.iterate(CASE, couple="both")
