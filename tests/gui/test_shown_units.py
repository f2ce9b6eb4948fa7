"""Test the builder in customary units.

What follows from a case, and results.
"""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from driving import SMALL, checked, screen_text, wait_for
from lambda_gui.app import BuilderApp
from lambda_gui.results_screen import ResultsScreen
from lambda_gui.shown_units import fact_in_units

from lambda_core.domain.unit_systems import SI, US

if TYPE_CHECKING:
    from lambda_core.results.reader import Result


def test_a_fact_keeps_the_words_behind_its_unit() -> None:
    assert fact_in_units(("Q max", "1 440", "N inner"), US) == ("Q max", "323.7", "lbf inner")
    assert fact_in_units(("balls", "≈ 8 x 15.08", "mm"), US) == ("balls", "≈ 8 x 0.5937", "in")
    assert fact_in_units(("h", "0.43..0.60", "um"), US) == ("h", "16.9..23.6", "uin")
    assert fact_in_units(("M ≈", "250", "N mm"), US) == ("M ≈", "2.21", "lbf in")
    assert fact_in_units(("L10", "12 000", "h"), US) == ("L10", "12 000", "h")
    assert fact_in_units(("p", "1.94", "GPa"), SI) == ("p", "1.94", "GPa")


async def test_results_and_numbers_that_follow_are_in_them(combined_run: Result, hand_written: Path) -> None:
    async with BuilderApp(str(hand_written), units=US).run_test(size=SMALL) as pilot:
        await checked(pilot)
        assert " in" in screen_text(pilot.app)
        assert "15.0" not in screen_text(pilot.app)
        await pilot.app.push_screen(ResultsScreen(combined_run.path.parent, combined_run.path))
        await wait_for(pilot, lambda: "lbf in" in screen_text(pilot.app))
        shown = " ".join(screen_text(pilot.app).split())
        assert "N mm" not in shown
        assert "degF" in shown
