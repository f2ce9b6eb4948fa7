"""Test the electric circuit in the builder by keyboard.

The laws of the films, mistakes, and what a run says of it.
"""

from __future__ import annotations

from pathlib import Path

from driving import LARGE, SMALL, builder, checked, go_to, screen_text, wait_for, write
from lambda_gui.app import BuilderApp
from lambda_gui.run_screen import _state

from lambda_core.runs.progress import Progress
from lambda_core.studies.run_queue import QueuedRun


async def test_a_law_of_the_films_is_chosen_and_its_parameter_set(hand_written: Path) -> None:
    async with BuilderApp(str(hand_written)).run_test(size=LARGE) as pilot:
        await checked(pilot)
        draft = builder(pilot).draft
        await go_to(pilot, "electric.breakdown.parameters.strength")
        await pilot.press("ctrl+a", "ctrl+k")
        await write(pilot, "20")
        await pilot.press("enter")
        assert draft.get("electric", "breakdown", "parameters", "strength") == "20 V/um"
        await checked(pilot)
        assert not builder(pilot).check.problems
        shown = screen_text(pilot.app)
        assert "correlation length" in shown
        assert "least voltage" in shown


async def test_a_mistake_in_the_circuit_stands_at_its_field(hand_written: Path) -> None:
    async with BuilderApp(str(hand_written)).run_test(size=SMALL) as pilot:
        await checked(pilot)
        await go_to(pilot, "electric.inverter.rise_time")
        await pilot.press("ctrl+a", "ctrl+k")
        await write(pilot, "-50 ns")
        await pilot.press("enter")
        await checked(pilot)
        await wait_for(pilot, lambda: "must be greater than 0" in screen_text(pilot.app))


def test_a_run_says_what_its_bearing_stands(tmp_path: Path) -> None:
    """Show voltage and rate during a run.

    A run without a circuit shows neither.
    """
    said = Progress(
        time_s=0.1, percent=50.0, cage_revolutions=1.0, cage_revolutions_wanted=5.0, averaged=0,
        friction_torque_Nmm=None, friction_torque_ci_Nmm=None, friction_torque_now_Nmm=None, cage_speed_ratio=None,
        energy_residual=None, inner_loads_N=(), wall_s=1.0, left_s=1.0, bearing_voltage_V=(-18.04, 26.9),
        films_broken_per_s=14823.0,
    )  # fmt: skip
    run = QueuedRun("case", tmp_path / "r.h5", tmp_path)
    run.state, run.history = "running", [said]
    assert "bearing -18.0 .. 26.9 V   1.482e+04 films break per second" in _state(run, 80).plain
    run.history = [said.model_copy(update={"bearing_voltage_V": None})]
    assert "films break" not in _state(run, 80).plain
