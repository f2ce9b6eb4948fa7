"""Test keys that arrive faster than checks and answers."""

from __future__ import annotations

import asyncio
import threading
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

import pytest
from driving import LARGE, SMALL, at_rest, builder, checked, focused_place, go_to, wait_for, write
from lambda_gui.app import BuilderApp
from lambda_gui.builder import BuilderScreen
from lambda_gui.catalogue import CatalogueScreen
from lambda_gui.checking import Check, Checker
from lambda_gui.duty_screen import DutyScreen
from lambda_gui.entry import Entry
from lambda_gui.forms import NodeForm
from lambda_gui.helper import Helper
from lambda_gui.rows import Row
from lambda_gui.study_screen import StudyScreen


class SlowChecks:
    """Checks that wait for the test.

    The first draft that is checked has number 0.
    """

    def __init__(self, patch: pytest.MonkeyPatch) -> None:
        self._check = Checker.check
        self.is_slow = True
        self.seen: list[Mapping[str, Any]] = []
        self._may_end: list[threading.Event] = []
        patch.setattr(Checker, "check", lambda checker, tables, folder: self._slowly(checker, tables, folder))

    def _slowly(self, checker: Checker, tables: Mapping[str, Any], folder: Path | None) -> Check:
        self._may_end.append(may_end := threading.Event())
        self.seen.append(tables)
        if self.is_slow:
            may_end.wait(100.0)
        return self._check(checker, tables, folder)

    def end(self, number: int) -> None:
        """Let a check go on."""
        self._may_end[number].set()

    def end_all(self) -> None:
        """Let everything go on, now and from now on."""
        self.is_slow = False
        for may_end in self._may_end:
            may_end.set()


@pytest.fixture
def checks(monkeypatch: pytest.MonkeyPatch) -> Iterator[SlowChecks]:
    """Have checks wait for the test."""
    slow = SlowChecks(monkeypatch)
    yield slow
    slow.end_all()


async def test_what_is_run_is_what_stands_there(
    hand_written: Path, checks: SlowChecks, monkeypatch: pytest.MonkeyPatch
) -> None:
    run: list[str] = []
    monkeypatch.setattr(BuilderApp, "_queue_up", lambda app, name, case_toml, *rest: run.append(case_toml))
    async with BuilderApp(str(hand_written)).run_test(size=SMALL) as pilot:
        await wait_for(pilot, lambda: len(checks.seen) == 1)
        checks.end(0)
        await wait_for(pilot, lambda: builder(pilot).is_checked)
        await go_to(pilot, "loads.radial")
        await pilot.press("ctrl+a", "ctrl+k", *"1.8 kN", "f5")
        assert not run
        checks.end_all()
        await wait_for(pilot, lambda: run)
    assert 'radial = "1.8 kN"' in run[0]
    assert len(run) == 1


async def test_an_old_check_that_ends_last_is_not_shown(hand_written: Path, checks: SlowChecks) -> None:
    async with BuilderApp(str(hand_written)).run_test(size=SMALL) as pilot:
        screen = builder(pilot)
        await wait_for(pilot, lambda: len(checks.seen) == 1)
        screen.draft.set("loads", "radial", value="1.5 lb")
        screen.edited()
        assert checks.seen[0]["loads"]["radial"] == "1.5 kN"  # what a check goes through does not change under it
        await wait_for(pilot, lambda: len(checks.seen) == 2)
        checks.end(1)
        await wait_for(pilot, lambda: screen.is_checked)
        assert [problem.where for problem in screen.check.problems] == ["loads.radial"]
        checks.end(0)
        await wait_for(pilot, lambda: not pilot.app.workers._workers)
        assert [problem.where for problem in screen.check.problems] == ["loads.radial"]


@pytest.mark.full
async def test_the_next_mistake_has_the_keyboard_though_the_cursor_has_just_moved(
    hand_written: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Keep the keyboard at the next mistake.

    The form of the node below the cursor is still to come and must not take the keyboard away.
    """
    async with BuilderApp(str(hand_written)).run_test(size=SMALL) as pilot:
        await checked(pilot)
        await go_to(pilot, "lubricant.temperature")
        await pilot.press("ctrl+a", "ctrl+k", *"62,5 degC")
        await checked(pilot)
        screen = builder(pilot)
        at_once = BuilderScreen.set_timer

        def later(self: BuilderScreen, delay: float, *rest: Any, **more: Any) -> Any:
            return at_once(self, max(delay, 0.3), *rest, **more)

        monkeypatch.setattr(BuilderScreen, "set_timer", later)
        await pilot.press("escape", "home", "f8")
        await wait_for(pilot, lambda: focused_place(pilot) == ("lubricant", "temperature"))
        timer = screen._form_timer
        assert timer is not None
        await wait_for(pilot, lambda: timer._task is None or timer._task.done())
        await at_rest()
        assert focused_place(pilot) == ("lubricant", "temperature")


async def test_a_bearing_is_taken_from_the_list_of_what_was_typed(
    hand_written: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    async with BuilderApp(str(hand_written)).run_test(size=SMALL) as pilot:
        await checked(pilot)
        await pilot.press("f2")
        await wait_for(pilot, lambda: isinstance(pilot.app.screen, CatalogueScreen))
        at_once = CatalogueScreen.set_timer
        monkeypatch.setattr(CatalogueScreen, "set_timer", lambda self, delay, then: at_once(self, 200.0, then))
        await write(pilot, "6208 syla")
        await pilot.press("enter")
        await wait_for(pilot, lambda: isinstance(pilot.app.screen, BuilderScreen))
        assert builder(pilot).draft.get("bearing") == {"designation": "6208", "maker": "Syla2026"}


class SlowAnswers:
    """A helper that answers when a test says so."""

    def __init__(self, patch: pytest.MonkeyPatch, answer: object) -> None:
        self._answer = answer
        self.asked: list[asyncio.Future[object]] = []

        async def ask(helper: Helper, work: str, **arguments: Any) -> Any:
            self.asked.append(asyncio.get_running_loop().create_future())
            return await self.asked[-1]

        patch.setattr(Helper, "ask", ask)

    async def answer(self, number: int) -> None:
        """Give an answer and let it be taken in."""
        self.asked[number].set_result(self._answer)
        await at_rest()


@pytest.mark.full
async def test_a_study_typed_on_is_not_checked(hand_written: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    async with BuilderApp(str(hand_written)).run_test(size=LARGE) as pilot:
        await checked(pilot)
        await go_to(pilot, "operation.speed")
        answers = SlowAnswers(monkeypatch, "11 points")
        await pilot.press("f3")
        await wait_for(pilot, lambda: isinstance(pilot.app.screen, StudyScreen))
        screen = pilot.app.screen
        assert isinstance(screen, StudyScreen)
        await wait_for(pilot, lambda: len(answers.asked) == 1)
        await write(pilot, "1")
        await answers.answer(0)
        assert not screen.is_fine  # that was about the study before
        await wait_for(pilot, lambda: len(answers.asked) == 2)
        await answers.answer(1)
        assert screen.is_fine


async def test_a_cycle_typed_on_leaves_its_sums_those_of_another(
    hand_written: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("lambda_gui.duty_screen.cycle_view", lambda *_: (["sums"], "words"))
    async with BuilderApp(str(hand_written)).run_test(size=LARGE) as pilot:
        await checked(pilot)
        await pilot.press("f4")
        await wait_for(pilot, lambda: isinstance(pilot.app.screen, DutyScreen))
        answers = SlowAnswers(monkeypatch, "sums")
        found = pilot.app.screen.query_one("#found")
        await pilot.press("f5")
        await wait_for(pilot, lambda: len(answers.asked) == 1)
        await write(pilot, "1")
        await answers.answer(0)
        assert found.has_class("-old")
        await pilot.press("f5")
        await wait_for(pilot, lambda: len(answers.asked) == 2)
        await answers.answer(1)
        assert not found.has_class("-old")


async def test_a_check_that_comes_back_while_the_screen_goes(
    hand_written: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    came_back = []

    def gone(form: NodeForm) -> None:  # its own parts are gone already, the screen still stands
        screen = form.screen
        assert isinstance(screen, BuilderScreen)
        screen.app._exit = False  # ended by its host, not by a person
        screen._checked(screen.check, 0.0, 0)
        came_back.append(form)

    monkeypatch.setattr(NodeForm, "on_unmount", gone, raising=False)
    async with BuilderApp(str(hand_written)).run_test(size=SMALL) as pilot:
        await checked(pilot)
    assert came_back


async def test_typed_text_is_not_replaced_by_an_older_one(hand_written: Path) -> None:
    """Show a row while a letter is on its way.

    The older text took its place and left the cursor before it: "N/um" became "N/mu".
    """
    async with BuilderApp(str(hand_written)).run_test(size=LARGE) as pilot:
        await checked(pilot)
        await go_to(pilot, "loads.radial")
        entry = pilot.app.focused
        assert isinstance(entry, Entry)
        row = next(one for one in entry.ancestors if isinstance(one, Row))
        entry.value = "7 k"
        row.show()
        assert entry.value == "7 k"
        await wait_for(pilot, lambda: builder(pilot).draft.get("loads", "radial") == "7 kN")
        row.place.put("8 kN")
        row.show()
        assert entry.value == "8 kN"
