"""Test fits in the builder, by keyboard."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from driving import SMALL, checked, screen_text, wait_for
from lambda_gui.app import BuilderApp
from lambda_gui.dialogs import AskText
from lambda_gui.fit_screen import FitScreen
from lambda_gui.rows import Row
from reading import cut_on
from textual.widgets import Input

from lambda_core import api

DATA = """\
speed [1/min],friction torque [N mm],friction torque error [%]
500,115,2
1500,150,2
3000,175,2
"""


async def test_a_parameter_is_fitted_and_the_fitted_case_saved(hand_written: Path) -> None:
    hand_written.with_name("rig.csv").write_text(DATA)
    async with BuilderApp(str(hand_written)).run_test(size=SMALL) as pilot:
        await checked(pilot)
        await pilot.press("ctrl+f")
        await wait_for(pilot, lambda: isinstance(pilot.app.screen, FitScreen))
        screen = pilot.app.screen
        assert isinstance(screen, FitScreen)
        await pilot.press("f5")  # nothing is chosen yet
        await wait_for(pilot, lambda: any("data file is missing" in note.message for note in pilot.app._notifications))
        await pilot.press(*"rig", "enter", *"loss_f", "enter")
        assert screen.values["file",] == "rig.csv"
        assert screen.values["vary", "0"] == "parameters.elastic_hysteresis.loss_factor"
        await pilot.press("f5")
        await wait_for(pilot, lambda: screen.report is not None and "chi-square" in screen_text(pilot.app))
        assert "elastic_hysteresis.loss_factor" in screen_text(pilot.app)
        assert cut_on(pilot.app) == []
        assert "vary." not in " ".join(row.help().plain for row in screen.query(Row))  # it is no path of the case
        await pilot.press("ctrl+s")
        await wait_for(pilot, lambda: isinstance(pilot.app.screen, AskText))
        target = Path(pilot.app.screen.query_one(Input).value)
        await pilot.press("enter")
        await wait_for(pilot, target.is_file)
    case = api.case(target)
    assert case.fit is not None
    assert case.fit.file == "rig.csv"
    assert "# belt" in target.read_text()  # comments stay


@pytest.mark.full
async def test_a_fit_that_is_stopped_keeps_its_best_values(hand_written: Path) -> None:
    rows = [f"{speed},{100 + speed / 40},2" for speed in range(300, 4000, 180)]
    hand_written.with_name("rig.csv").write_text("\n".join([DATA.splitlines()[0], *rows]))
    async with BuilderApp(str(hand_written)).run_test(size=SMALL) as pilot:
        await checked(pilot)
        await pilot.press("ctrl+f")
        await wait_for(pilot, lambda: isinstance(pilot.app.screen, FitScreen))
        screen = pilot.app.screen
        assert isinstance(screen, FitScreen)
        await pilot.press(*"rig", "enter", *"loss_f", "enter", *"tau_e", "enter", "f5")
        solved = re.compile(r"(\d+) operating points solved")
        # Past the first look at all rows: before, nothing is known that a stop could keep.
        await wait_for(
            pilot, lambda: any(int(found) > 2 * len(rows) for found in solved.findall(screen_text(pilot.app)))
        )
        await pilot.press("f8")
        await wait_for(pilot, lambda: screen.report is not None)
        assert screen.report is not None
        assert screen.report.is_interrupted
        await wait_for(pilot, lambda: "The fit was interrupted" in screen_text(pilot.app))


async def test_a_mistake_in_the_file_is_shown_with_its_line(hand_written: Path) -> None:
    hand_written.with_name("rig.csv").write_text(DATA.replace("150", "1,5"))
    async with BuilderApp(str(hand_written)).run_test(size=SMALL) as pilot:
        await checked(pilot)
        await pilot.press("ctrl+f")
        await wait_for(pilot, lambda: isinstance(pilot.app.screen, FitScreen))
        await pilot.press(*"rig", "enter", *"loss_f", "enter", "f5")
        await wait_for(pilot, lambda: "line 3" in screen_text(pilot.app))
