"""Test the results screen of a machine and its bearings."""

from __future__ import annotations

import tomllib
from pathlib import Path

from driving import LARGE, checked, screen_text, wait_for
from lambda_gui.app import BuilderApp
from lambda_gui.results_screen import ResultsScreen

from lambda_core import api
from lambda_core.model.machine_templates import shaft_text


async def test_a_machine_shows_its_bearings_one_after_the_other(tmp_path: Path, hand_written: Path) -> None:
    path = tmp_path / "box.h5"
    api.run(tomllib.loads(shaft_text("geared-shaft", "box")), ["solver.duration=0.2 ms"], out=path)
    async with BuilderApp(str(hand_written)).run_test(size=LARGE) as pilot:
        await checked(pilot)
        await pilot.app.push_screen(ResultsScreen(tmp_path, path))
        await wait_for(pilot, lambda: "force on shaft" in screen_text(pilot.app))
        await pilot.press("b")
        await wait_for(pilot, lambda: "left of box" in screen_text(pilot.app))
        await pilot.press("b")
        await wait_for(pilot, lambda: "right of box" in screen_text(pilot.app))
        await pilot.press("b")
        await wait_for(pilot, lambda: "force on shaft" in screen_text(pilot.app))
