"""Test studies and comparisons in the builder.

Set up, run, looked at, saved, by keyboard.
"""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import pytest
from driving import LARGE, SMALL, builder, checked, go_to, screen_text, wait_for, write
from lambda_gui import result_files
from lambda_gui.app import BuilderApp
from lambda_gui.dialogs import AskText
from lambda_gui.results_screen import ResultsScreen
from lambda_gui.run_screen import RunScreen
from lambda_gui.study_screen import StudyScreen
from lambda_gui.study_values import asked, first_values, studied, study_tables
from reading import cut_on
from textual.widgets import OptionList

from lambda_core import api
from lambda_core.case.case import Case
from lambda_core.domain.option_tree import option_paths
from lambda_core.studies.definition import read_study, validate_study
from lambda_core.studies.store import FILE

if TYPE_CHECKING:
    from textual.pilot import Pilot

    from lambda_core.results.reader import Result


def test_a_form_begins_with_the_option_under_the_keyboard() -> None:
    values = first_values("fan", "operation.speed", "3000 rpm")
    study = validate_study(study_tables(values, asked(())))
    assert study.name == "fan-speed"
    assert study.responses == list(asked(()))
    (parameter,) = study.parameters
    assert (parameter.path, parameter.range, parameter.points) == ("operation.speed", ["1500 rpm", "6000 rpm"], 11)
    assert ("0", "from") not in first_values("fan", "lubricant.temperature", "70 degC")  # no zero to start from
    assert ("0", "path") not in first_values("fan", "", "")


def test_a_list_counts_before_a_range_and_both_parameters_do() -> None:
    values = first_values("fan", "loads.radial", "2 kN") | {
        ("0", "points"): 3,
        ("1", "path"): "lubricant.name",
        ("1", "values"): "mineral-vg32, mineral-vg68",
        ("mode",): "dynamic",
        ("responses",): "friction_torque_Nmm",
    }
    study = validate_study(study_tables(values, asked(())))
    assert [parameter.values for parameter in study.parameters] == [None, ["mineral-vg32", "mineral-vg68"]]
    assert (study.mode, study.responses) == ("dynamic", ["friction_torque_Nmm"])
    assert {"operation.speed", "loads.radial", "bearing.clearance", "surface.roughness"} <= set(
        studied(Case, option_paths(Case))
    )
    assert "description" not in studied(Case, option_paths(Case))


def test_a_folder_is_a_study_by_the_file_that_makes_it_one(tmp_path: Path) -> None:
    assert result_files.MANIFEST == FILE
    assert result_files.results_in(tmp_path) == []


async def form(pilot: Pilot[None], path: str, *, is_fine: bool = True) -> StudyScreen:
    """Open a study's form on an option.

    It is one of the case; wait until its first point has been solved.
    """
    await checked(pilot)
    await go_to(pilot, path)
    await pilot.press("f3")
    await wait_for(pilot, lambda: isinstance(pilot.app.screen, StudyScreen))
    screen = pilot.app.screen
    assert isinstance(screen, StudyScreen)
    if is_fine:
        await wait_for(pilot, lambda: screen.is_fine)
    return screen


async def test_from_an_option_to_its_curve(hand_written: Path, warm_program: None) -> None:
    async with BuilderApp(str(hand_written)).run_test(size=SMALL) as pilot:
        screen = await form(pilot, "operation.speed")
        assert "operation.speed: 750 rpm to 3000 rpm, 11 points" in screen_text(pilot.app)
        assert not cut_on(pilot.app)
        await pilot.press("down", "down")
        await write(pilot, "3")
        await wait_for(pilot, lambda: screen.is_fine and "3 points" in screen_text(pilot.app))
        await pilot.press("f5")
        await wait_for(pilot, lambda: isinstance(pilot.app.screen, RunScreen))
        queue = pilot.app.queue
        await wait_for(pilot, lambda: queue.runs[0].state not in ("waiting", "running"))
        assert queue.runs[0].is_complete, queue.runs[0].message
        await wait_for(pilot, lambda: "3/3 points" in screen_text(pilot.app))
        assert not cut_on(pilot.app)
        await pilot.press("enter")
        await wait_for(pilot, lambda: isinstance(pilot.app.screen, ResultsScreen))
        await wait_for(pilot, lambda: "3 points, 3 done" in screen_text(pilot.app))
        assert "drive-end-speed/" in screen_text(pilot.app)
        views = pilot.app.screen.query_one(OptionList)
        await wait_for(pilot, lambda: views.option_count > 3)
        await pilot.press("down")
        await wait_for(pilot, lambda: "Schaeffler" in screen_text(pilot.app))
        shown = screen_text(pilot.app)  # simulation and catalogues on one axis
        assert "quasi-static" in shown
        assert "SKF" in shown
    status = api.study_status("drive-end-speed")
    assert (status.points, status.done) == (3, 3)


async def test_what_is_wrong_is_said_and_nothing_runs(hand_written: Path) -> None:
    async with BuilderApp(str(hand_written)).run_test(size=LARGE) as pilot:
        screen = await form(pilot, "loads.radial", is_fine=False)
        await write(pilot, "1 rpm")
        await wait_for(pilot, lambda: "rpm" in str(screen.query_one("#cost").render()))
        assert not screen.is_fine
        await pilot.press("f5")
        assert pilot.app.screen is screen
        assert not pilot.app.queue.runs


@pytest.mark.full
async def test_a_study_is_saved_for_the_shell(hand_written: Path) -> None:
    async with BuilderApp(str(hand_written)).run_test(size=LARGE) as pilot:
        await form(pilot, "operation.speed", is_fine=False)
        await pilot.press("ctrl+s")
        await wait_for(pilot, lambda: isinstance(pilot.app.screen, AskText))
        await pilot.press("enter")
        file = hand_written.with_name("drive-end-speed.toml")
        await wait_for(pilot, file.exists)
        study, folder = read_study(file)
        assert (study.case, folder) == ("drive-end.toml", hand_written.parent)
        await pilot.press("escape")
        builder(pilot).draft.set("operation", "speed", value="2000 rpm")
        await checked(pilot)
        await pilot.press("f3", "ctrl+s")
        await wait_for(pilot, lambda: pilot.app._notifications)
        assert any("save the case first" in note.message for note in pilot.app._notifications)


@pytest.mark.full
@pytest.mark.parametrize("size", [SMALL, pytest.param(LARGE, marks=pytest.mark.slow)])
async def test_two_results_say_what_differs(
    size: tuple[int, int], radial_run: Result, combined_run: Result, hand_written: Path
) -> None:
    async with BuilderApp(str(hand_written)).run_test(size=size) as pilot:
        await checked(pilot)
        screen = ResultsScreen(radial_run.path.parent, combined_run.path)
        await pilot.app.push_screen(screen)
        views = screen.query_one(OptionList)
        await wait_for(pilot, lambda: views.option_count > 3)
        await pilot.press("tab", "up", "up", "space", "down", "space")
        await wait_for(pilot, lambda: "static safety" in screen_text(pilot.app) or screen._view == "what differs")
        await wait_for(pilot, lambda: "bearing.designation" in screen_text(pilot.app))
        shown = screen_text(pilot.app)
        assert "6319" in shown
        assert "6208" in shown
        assert "torque [N mm]" in " ".join(shown.split())
        assert not cut_on(pilot.app)
