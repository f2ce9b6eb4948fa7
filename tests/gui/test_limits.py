"""Test that the builder shows exceeded limits before solving."""

from __future__ import annotations

from pathlib import Path

from driving import LARGE, SMALL, builder, checked, screen_text, wait_for
from lambda_gui.app import BuilderApp
from lambda_gui.derived import Derived

LIMITS = {
    "30 000 rpm": ("operation.speed", "30000 rpm", "30000 rpm is above the limiting speed"),
    "0 N": ("loads.radial", "0 N", "is below the minimum load of ball bearings"),
    "above C0": ("loads.radial", "30 kN", "is above the static load rating C0"),
    "4 mrad": (
        "bodies.inner_ring.tilt_y",
        {"mode": "prescribed", "motion": "4 mrad"},
        "tilts the rings against each other by 4 mrad",
    ),
    "300 degC": ("lubricant.temperature", "300 degC", "the oil at 300 degC is outside -40 to 200 degC"),
    "-40 degC": ("lubricant.temperature", "-40 degC", "the oil is so thick at this speed"),
}


async def test_each_limit_stands_in_the_status_and_in_words_before_anything_is_solved(hand_written: Path) -> None:
    async with BuilderApp(str(hand_written)).run_test(size=SMALL) as pilot:
        await checked(pilot)
        assert "ready  " in screen_text(pilot.app)
        draft = builder(pilot).draft
        draft.set("operation", "speed", value="12000 rpm")
        await checked(pilot)
        for size in (SMALL, LARGE):
            await pilot.resize_terminal(*size)
            await wait_for(pilot, lambda: "ready, ▲ 1 warning  F8" in screen_text(pilot.app))
            assert "▲ 12000 rpm is above the limiting" in screen_text(pilot.app)
        await pilot.press("f8")
        await wait_for(pilot, lambda: pilot.app._notifications)
        (said,) = (note.message for note in pilot.app._notifications if note.title == "beyond a limit")
        assert said == "12000 rpm is above the limiting speed of the bearing in the catalogue, 11000 rpm"
        for keys, value in (
            (("operation", "speed"), "30000 rpm"),
            (("loads", "radial"), "30 kN"),
            (("lubricant", "temperature"), "250 degC"),
        ):
            draft.set(*keys, value=value)
        await pilot.resize_terminal(*SMALL)
        await checked(pilot)
        assert "▲ 4 warnings  F8" in screen_text(pilot.app)
        while draft.undo():
            pass
        await pilot.resize_terminal(*LARGE)
        draft.set("loads", "axial", value=None)
        for path, value, words in LIMITS.values():
            keys = path.split(".")
            before = draft.get(*keys)
            draft.set(*keys, value=value)
            await checked(pilot)
            shown = " ".join(screen_text(pilot.app).split())
            assert "ready, ▲" in shown
            (warning,) = (w for w in builder(pilot).query_one(Derived).warnings() if words in w)
            assert f"▲ {warning[:20]}" in shown
            draft.set(*keys, value=before)
        draft.set("lubricant", "temperature", value="800 degC")
        await checked(pilot)
        (problem,) = builder(pilot).check.problems
        assert "800 degC: no oil is liquid there" in problem.message
        assert "▲ 1 mistake  F8" in screen_text(pilot.app)
