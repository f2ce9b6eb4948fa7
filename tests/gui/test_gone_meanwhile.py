"""Test that closed screens ignore late callbacks."""

from __future__ import annotations

import asyncio
from pathlib import Path
from typing import Any

import pytest
from driving import LARGE, at_rest, builder, checked, go_to, wait_for
from lambda_gui.app import BuilderApp
from lambda_gui.catalogue import CatalogueScreen
from lambda_gui.choice import Entry, PickList
from lambda_gui.duty_screen import DutyScreen
from lambda_gui.helper import Helper
from lambda_gui.results_screen import ResultsScreen
from lambda_gui.run_screen import RunScreen
from lambda_gui.study_screen import StudyScreen
from textual.geometry import Offset
from textual.screen import Screen
from textual.widgets import Footer

from lambda_core import api
from lambda_core.domain.errors import LambdaError


@pytest.mark.full
@pytest.mark.parametrize(
    ("kind", "keys", "is_fault"),
    [
        pytest.param(StudyScreen, ["f3"], False, id="study"),
        pytest.param(StudyScreen, ["f3"], True, id="fault"),
        pytest.param(DutyScreen, ["f4", "f5"], False, id="duty"),
        pytest.param(ResultsScreen, ["f6"], False, id="results"),
    ],
)
async def test_an_answer(
    kind: type[Screen[None]], keys: list[str], is_fault: bool, hand_written: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Answer after parts of the screen are gone."""
    asked: list[asyncio.Future[Any]] = []

    async def answer(helper: Helper, work: str, **arguments: Any) -> Any:
        asked.append(asyncio.get_running_loop().create_future())
        return await asked[-1]

    async def answered(part: Footer) -> None:
        if asked and not asked[-1].done():
            if is_fault:
                asked[-1].set_exception(LambdaError("the helper process has ended"))
            else:
                asked[-1].set_result([])
            for _ in range(20):
                await asyncio.sleep(0)

    monkeypatch.setattr(Helper, "_answer", answer)
    async with BuilderApp(str(hand_written)).run_test(size=LARGE) as pilot:
        await checked(pilot)
        await go_to(pilot, "operation.speed")
        for key in keys:
            await pilot.press(key)
            await wait_for(pilot, lambda: isinstance(pilot.app.screen, kind))
        await wait_for(pilot, lambda: asked)
        monkeypatch.setattr(Footer, "on_unmount", answered, raising=False)
        await pilot.press("escape")
        await wait_for(pilot, lambda: pilot.app.screen is builder(pilot))
        await wait_for(pilot, lambda: asked[-1].done())
        assert pilot.app._exception is None


async def test_a_picture(hand_written: Path) -> None:
    """Draw after the screen was left."""
    async with BuilderApp(str(hand_written)).run_test(size=LARGE) as pilot:
        await checked(pilot)
        runs, catalogue = RunScreen(pilot.app.queue), CatalogueScreen(api.catalogue(), "bearing")  # type: ignore[attr-defined]
        choice = PickList([Entry("a", "a")], "a", Offset(0, 0))
        for screen in (runs, catalogue, choice):
            await pilot.app.push_screen(screen)
            await at_rest()
            await pilot.app.pop_screen()
        runs._draw()
        runs.follow()
        catalogue._show_details()
        choice._place()
    pilot.app.queue.poll = lambda: True  # type: ignore[attr-defined]
    pilot.app._poll_runs()  # type: ignore[attr-defined]
