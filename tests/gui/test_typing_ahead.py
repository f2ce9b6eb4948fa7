"""Test that keys typed ahead reach their entry."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest
from driving import SMALL, builder, go_to, screen_text, wait_for
from lambda_gui.app import BuilderApp
from lambda_gui.builder import BuilderScreen
from lambda_gui.forms import NodeForm


async def test_what_follows_enter_belongs_to_the_next_entry(work_folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Type two values while the next row loads."""
    at_once = NodeForm.on_row_done

    def slowly(self: NodeForm, event: Any) -> None:
        event.stop()
        self.set_timer(0.2, lambda: at_once(self, event))

    async with BuilderApp().run_test(size=SMALL) as pilot:
        await wait_for(pilot, lambda: "new machine" in screen_text(pilot.app))  # type: ignore[arg-type]
        await pilot.press(*"new", "enter")
        await wait_for(pilot, lambda: isinstance(pilot.app.screen, BuilderScreen))
        await go_to(pilot, "gravity.x")
        monkeypatch.setattr(NodeForm, "on_row_done", slowly)
        await pilot.press(*"1", "enter", *"2", "enter", *"3", "enter")
        await wait_for(pilot, lambda: builder(pilot).draft.get("gravity", "z") == "3 m/s2")
        assert builder(pilot).draft.get("gravity") == {"x": "1 m/s2", "y": "2 m/s2", "z": "3 m/s2"}
