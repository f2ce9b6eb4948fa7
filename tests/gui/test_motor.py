"""Test a motor bearing from nothing to a report.

6308 C3 under 2.5 kN and 0.5 kN at 6000 rpm, in at most 40 keys.
"""

from __future__ import annotations

import math
from pathlib import Path

import pytest
from driving import SMALL, builder, checked, focused_place, wait_for
from lambda_gui.app import BuilderApp
from lambda_gui.dialogs import AskText, OpenCase
from lambda_gui.results_screen import ResultsScreen
from lambda_gui.run_screen import RunScreen
from textual.command import CommandList, CommandPalette
from textual.pilot import Pilot

from lambda_core import api

MOST = 40


class Typist:
    """Types, and counts the keys."""

    def __init__(self, pilot: Pilot[None]) -> None:
        self._pilot, self.keys = pilot, 0

    async def press(self, *keys: str) -> None:
        """Press keys, one after the other."""
        self.keys += len(keys)
        await self._pilot.press(*keys)

    async def find(self, begin: str, path: str) -> None:
        """Go to an option by the palette."""
        await self.press("ctrl+p")
        await wait_for(self._pilot, lambda: isinstance(self._pilot.app.screen, CommandPalette))
        await self.press(*begin)
        hits = self._pilot.app.screen.query_one(CommandList)
        await wait_for(self._pilot, lambda: hits.option_count and path in str(hits.get_option_at_index(0).prompt))
        await self.press("enter")
        await wait_for(self._pilot, lambda: focused_place(self._pilot) == tuple(path.split(".")))


@pytest.mark.slow
async def test_from_nothing_to_a_report(work_folder: Path) -> None:
    async with BuilderApp().run_test(size=SMALL) as pilot:
        await wait_for(pilot, lambda: isinstance(pilot.app.screen, OpenCase))
        person = Typist(pilot)
        await person.press(*"motor", "enter")  # the machine: its bearing is the 6308 C3
        await checked(pilot)
        await person.find("rad", "loads.radial")
        await person.press(*"2.5 k", "enter", "down")
        await wait_for(pilot, lambda: focused_place(pilot) == ("loads", "axial"))
        await person.press(*"0.5 k", "enter")
        await person.find("spe", "operation.speed")
        await person.press(*"6000", "enter")
        await checked(pilot)
        model = builder(pilot).check.model
        assert model is not None
        await person.press("f5")
        await wait_for(pilot, lambda: isinstance(pilot.app.screen, RunScreen))
        queue = pilot.app.queue  # type: ignore[attr-defined]
        await wait_for(pilot, lambda: queue.runs[0].state not in ("waiting", "running"))
        assert queue.runs[0].message == "converged"
        await person.press("enter")
        await wait_for(pilot, lambda: isinstance(pilot.app.screen, ResultsScreen))
        await wait_for(pilot, lambda: pilot.app.screen.chosen())  # type: ignore[attr-defined]
        await person.press("t")
        await wait_for(pilot, lambda: isinstance(pilot.app.screen, AskText))
        await person.press("enter")
        page = work_folder / "electric-motor.html"
        await wait_for(pilot, page.exists)
    assert person.keys <= MOST, person.keys
    case = api.case(_written(work_folder))
    assert (case.bearing.designation, case.bearing.clearance) == ("6308", "C3")
    assert (case.loads.radial, case.loads.axial) == (2500.0, 500.0)
    assert case.operation.speed == pytest.approx(200.0 * math.pi)


def _written(folder: Path) -> Path:
    """Write the case of the result into a file."""
    file = folder / "case.toml"
    file.write_text(api.result(folder / "electric-motor.h5").case_toml, encoding="utf-8")
    return file
