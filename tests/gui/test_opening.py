"""Test that the builder edits the opened case only."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from driving import SMALL, builder, checked, go_to, screen_text, wait_for, write
from lambda_gui import recovery
from lambda_gui.app import BuilderApp
from lambda_gui.builder import BuilderScreen
from lambda_gui.dialogs import Ask, OpenCase
from textual.events import AppBlur
from textual.pilot import Pilot
from textual.widgets import Input

from lambda_core import api


async def leave_unsaved_work() -> None:
    """Type into an empty model, and let the terminal go."""
    async with BuilderApp().run_test(size=SMALL) as pilot:
        await wait_for(pilot, lambda: isinstance(pilot.app.screen, OpenCase))
        screen = builder(pilot)
        screen.draft.set("name", value="typed before")
        screen._keep()
    (kept,) = (recovery.state_folder() / "unsaved").glob("*.json")
    content = json.loads(kept.read_text(encoding="utf-8"))
    content["process"]["start"] = "long ago"
    kept.write_text(json.dumps(content), encoding="utf-8")


def rescues() -> int:
    return len(list((recovery.state_folder() / "unsaved").glob("*.json")))


async def choose_the_file(pilot: Pilot[None]) -> None:
    await wait_for(pilot, lambda: isinstance(pilot.app.screen, OpenCase))
    await write(pilot, "drive")
    await pilot.press("enter")
    await wait_for(pilot, lambda: builder(pilot).draft.path is not None)
    await checked(pilot)


async def test_what_is_saved_is_what_is_shown(hand_written: Path) -> None:
    """Ask about unsaved work before opening a case."""
    await leave_unsaved_work()
    async with BuilderApp().run_test(size=SMALL) as pilot:
        await wait_for(pilot, lambda: isinstance(pilot.app.screen, Ask))
        await wait_for(pilot, lambda: "unsaved work on a case without a file" in screen_text(pilot.app))
        await pilot.press("down", "down", "enter")  # decide later
        await choose_the_file(pilot)
        assert sum(isinstance(screen, BuilderScreen) for screen in pilot.app.screen_stack) == 1
        await go_to(pilot, "operation.speed")
        await pilot.press("ctrl+a", "ctrl+k")
        await write(pilot, "3000 rpm")
        await pilot.press("ctrl+s")
        await wait_for(pilot, lambda: not builder(pilot).draft.is_changed())
        assert "unsaved" not in screen_text(pilot.app).splitlines()[0]
        await pilot.press("f2", "escape")  # screens over the case come and go
        await checked(pilot)
        builder(pilot).draft.set("loads", "radial", value="9 kN")
        await pilot.press("ctrl+q")
        await wait_for(pilot, lambda: isinstance(pilot.app.screen, Ask))
        assert "drive-end.toml has unsaved changes" in screen_text(pilot.app)
    assert 'speed = "3000 rpm"' in hand_written.read_text(encoding="utf-8")
    assert not Path("untitled.toml").exists()
    assert len(recovery.rescues(None)) == 1  # the file's own may be there, too, when the machine was slow


@pytest.mark.full
async def test_recovered_work_is_gone_on_with(hand_written: Path) -> None:
    await leave_unsaved_work()
    async with BuilderApp().run_test(size=SMALL) as pilot:
        await wait_for(pilot, lambda: isinstance(pilot.app.screen, Ask))
        await pilot.press("enter")  # recover
        await wait_for(pilot, lambda: builder(pilot).draft.get("name") == "typed before")
        await checked(pilot)
        assert isinstance(pilot.app.screen, BuilderScreen)  # nothing more to ask: this is the case
        assert "typed before" in screen_text(pilot.app)


@pytest.mark.full
async def test_discarded_work_is_asked_about_once(hand_written: Path) -> None:
    await leave_unsaved_work()
    async with BuilderApp().run_test(size=SMALL) as pilot:
        await wait_for(pilot, lambda: isinstance(pilot.app.screen, Ask))
        await pilot.press("down", "enter")  # discard
        await choose_the_file(pilot)
        assert rescues() == 0


@pytest.mark.full
async def test_a_case_opened_over_the_results_takes_the_place_of_the_one_below(hand_written: Path) -> None:
    """Replace the case below the results.

    The palette offers "Open a case" on every screen.
    """
    api.init_case("other", None, Path("other.toml"))
    async with BuilderApp(str(hand_written)).run_test(size=SMALL) as pilot:
        await checked(pilot)
        await pilot.press("f6")
        await wait_for(pilot, lambda: not isinstance(pilot.app.screen, BuilderScreen))
        app = pilot.app
        assert isinstance(app, BuilderApp)
        app.open("other.toml")
        await wait_for(pilot, lambda: builder(pilot).draft.path == Path("other.toml"))
        await checked(pilot)
        assert app.screen is builder(pilot)


async def test_a_question_that_came_while_the_page_had_no_keyboard_hears_the_first_key(work_folder: Path) -> None:
    async with BuilderApp("6208-axial-1300").run_test(size=SMALL) as pilot:
        await checked(pilot)
        pilot.app.post_message(AppBlur())
        await wait_for(pilot, lambda: not pilot.app.app_focus)
        pilot.app.action_open_case()  # type: ignore[attr-defined]
        await wait_for(pilot, lambda: isinstance(pilot.app.screen, OpenCase))
        assert pilot.app.screen.focused is None
        await pilot.press("x")
        assert pilot.app.screen.query_one(Input).value == "x"
