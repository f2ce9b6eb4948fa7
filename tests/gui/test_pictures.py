"""Test results in a terminal that shows pictures.

The view as it is drawn for files, or as text.
"""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import pytest
from driving import LARGE, checked, screen_text, wait_for
from lambda_gui.app import BuilderApp
from lambda_gui.pictures import picture_widget
from lambda_gui.results_screen import ResultsScreen
from textual.widgets import OptionList

pytest.importorskip("textual_image")

if TYPE_CHECKING:
    from lambda_core.results.reader import Result


def test_no_terminal_no_pictures() -> None:
    assert picture_widget() is None


@pytest.mark.full
async def test_a_view_is_a_picture_or_text(combined_run: Result, hand_written: Path) -> None:
    from textual_image.widget import HalfcellImage

    async with BuilderApp(str(hand_written), picture=HalfcellImage).run_test(size=LARGE) as pilot:
        await checked(pilot)
        await pilot.app.push_screen(ResultsScreen(combined_run.path.parent, combined_run.path))
        views = pilot.app.screen.query_one("#views", OptionList)
        await wait_for(pilot, lambda: views.option_count > 3)
        await pilot.press("down")
        await wait_for(pilot, lambda: pilot.app.screen.query(HalfcellImage))
        image = pilot.app.screen.query_one(HalfcellImage)
        room = pilot.app.screen.query_one("#content").size
        await wait_for(pilot, lambda: image.size.width > 20)
        assert image.size.width <= room.width
        assert image.size.height <= room.height
        await pilot.press("p")
        await wait_for(pilot, lambda: not pilot.app.screen.query(HalfcellImage))
        await wait_for(pilot, lambda: "over azimuth" in screen_text(pilot.app))


async def test_other_terminals_say_why_not(combined_run: Result, hand_written: Path) -> None:
    async with BuilderApp(str(hand_written)).run_test(size=LARGE) as pilot:
        await checked(pilot)
        await pilot.app.push_screen(ResultsScreen(combined_run.path.parent, combined_run.path))
        await pilot.press("p")
        await wait_for(pilot, lambda: any("lambda-bearing[pictures]" in n.message for n in pilot.app._notifications))
