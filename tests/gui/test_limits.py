"""The builder says what lies beyond a limit before anything is solved."""

from __future__ import annotations

from pathlib import Path

import pytest
from driving import LARGE, SMALL, builder, checked, screen_text, wait_for
from lambda_gui.app import BuilderApp


@pytest.mark.parametrize("size", [SMALL, LARGE])
async def test_a_speed_above_the_limit_stands_in_the_status_and_in_words(
    hand_written: Path, size: tuple[int, int]
) -> None:
    async with BuilderApp(str(hand_written)).run_test(size=size) as pilot:
        await checked(pilot)
        assert "ready  " in screen_text(pilot.app)
        builder(pilot).draft.set("operation", "speed", value="12000 rpm")
        await checked(pilot)
        shown = screen_text(pilot.app)
        assert "ready, ▲ 1 warning  F8" in shown
        assert "▲ 12000 rpm is above the limiting" in shown
        await pilot.press("f8")
        await wait_for(pilot, lambda: pilot.app._notifications)
        (said,) = (note.message for note in pilot.app._notifications if note.title == "beyond a limit")
        assert said == "12000 rpm is above the limiting speed of the bearing in the catalogue, 11000 rpm"


async def test_several_warnings_leave_room_for_the_numbers(hand_written: Path) -> None:
    async with BuilderApp(str(hand_written)).run_test(size=SMALL) as pilot:
        await checked(pilot)
        for keys, value in (
            (("operation", "speed"), "30000 rpm"),
            (("loads", "radial"), "30 kN"),
            (("lubricant", "temperature"), "250 degC"),
        ):
            builder(pilot).draft.set(*keys, value=value)
        await checked(pilot)
        assert "▲ 4 warnings  F8" in screen_text(pilot.app)
