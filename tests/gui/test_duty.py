"""Test a duty cycle in the builder.

A load spectrum is written, added up, saved for the shell, by keyboard.
"""

from __future__ import annotations

from pathlib import Path

import pytest
from driving import LARGE, SMALL, builder, checked, screen_text, wait_for
from lambda_gui.app import BuilderApp
from lambda_gui.dialogs import AskText
from lambda_gui.duty_screen import DutyScreen
from lambda_gui.duty_values import Phase, cycle_tables, cycle_view
from reading import cut_on
from rich.table import Table
from textual.widgets import Input

from lambda_core.domain.unit_systems import US
from lambda_core.studies.duty_cycle import DutyCycle, PhaseResult, duty


def test_what_is_left_open_is_as_in_the_case() -> None:
    phases = [Phase({"time": "2 h", "loads.radial": "3 kN"}), Phase({"name": "rest", "operation.speed": "0 rpm"})]
    assert cycle_tables("day", phases) == {
        "name": "day",
        "case": "case.toml",
        "phases": [
            {"name": "phase 1", "time": "2 h", "changes": {"loads.radial": "3 kN"}},
            {"name": "rest", "time": "1 h", "changes": {"operation.speed": "0 rpm"}},
        ],
    }


def test_the_sum_is_told_in_the_persons_units() -> None:
    phase = PhaseResult(
        name="work", share=0.25, speed_rpm=3000.0, equivalent_load_N=2000.0, basic_life_h=21234.0,
        reference_life_h=20123.0, damage=1.0, friction_torque_Nmm=100.0, power_loss_W=31.4, energy_loss_kJ=113.0,
        warnings=["the load P = 2 kN is odd"],
    )  # fmt: skip
    found = DutyCycle(
        name="day", case="x", cycle_h=1.0, phases=[phase], basic_life_h=21234.0, reference_life_h=20123.0,
        mean_load_N=2000.0, mean_speed_rpm=3000.0, mean_power_loss_W=31.4, energy_loss_kJ=113.0,
        energy_loss_kWh_per_year=275.0, assumptions=["damages add"],
    )  # fmt: skip
    tables, words = cycle_view(found, US, "red")
    table = tables[0]
    assert isinstance(table, Table)
    assert [column.header for column in table.columns][1:4:2] == ["time %", "P lbf"]
    assert list(table.columns[1].cells) == ["25.0", "100.0"]
    assert list(table.columns[3].cells) == ["449.6", "449.6"]
    assert "20 000 h (ISO/TS 16281)   21 000 h (ISO 281)" in words.plain
    assert "▲ work: the load P = 450 lbf is odd" in words.plain


async def test_a_spectrum_is_written_added_up_and_saved(hand_written: Path) -> None:
    async with BuilderApp(str(hand_written)).run_test(size=SMALL) as pilot:
        await checked(pilot)
        await pilot.press("f4")
        await wait_for(pilot, lambda: isinstance(pilot.app.screen, DutyScreen))
        screen = pilot.app.screen
        assert isinstance(screen, DutyScreen)
        await pilot.press(*"start", "enter", *"30 min", "enter", *"4 k", "tab", "tab", *"1000", "enter")
        await pilot.press("ctrl+n")
        await wait_for(pilot, lambda: len(screen.query("PhaseLine")) == 2)
        await pilot.press(*"work", "tab", *"7.5", "tab", *"1.5 k", "up", "down")
        await pilot.press("ctrl+n")
        await wait_for(pilot, lambda: len(screen.query("PhaseLine")) == 3)
        await pilot.press("ctrl+d")  # a copy of it was one too many
        await wait_for(pilot, lambda: len(screen.query("PhaseLine")) == 2)
        assert [phase.texts["loads.radial"] for phase in screen.phases] == ["4 kN", "1.5 kN"]
        await pilot.press("f5")
        await wait_for(pilot, lambda: "together" in screen_text(pilot.app))
        shown = screen_text(pilot.app)
        assert cut_on(pilot.app) == []
        assert "lost in a cycle of 8.00 h" in shown
        await pilot.press("ctrl+s")
        await wait_for(pilot, lambda: isinstance(pilot.app.screen, AskText))
        target = Path(pilot.app.screen.query_one(Input).value)
        await pilot.press("enter")
        await wait_for(pilot, target.is_file)
        await pilot.press("f5", "escape")  # it may be left while it is solved
        await wait_for(pilot, lambda: pilot.app.screen is builder(pilot))
    saved = duty(target)  # what the shell adds up is what stood on the screen
    assert [phase.name for phase in saved.phases] == ["start", "work"]
    assert f"{saved.energy_loss_kJ:,.1f}".replace(",", " ") + " kJ lost" in shown


@pytest.mark.full
async def test_what_is_wrong_with_a_phase_is_said(hand_written: Path) -> None:
    async with BuilderApp(str(hand_written)).run_test(size=LARGE) as pilot:
        await checked(pilot)
        await pilot.press("f4")
        await wait_for(pilot, lambda: isinstance(pilot.app.screen, DutyScreen))
        await pilot.press("tab", "tab", *"4 kg", "f5")
        await wait_for(pilot, lambda: 'phase "work"' in screen_text(pilot.app))
        assert "loads.radial" in screen_text(pilot.app)
