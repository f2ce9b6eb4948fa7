"""Test how a user finds the way."""

from __future__ import annotations

import tempfile
from pathlib import Path

import pytest
from driving import HAND_WRITTEN, SMALL, builder, checked, focused_place, go_to, screen_text, wait_for, write
from lambda_db.recent import recent_cases, remember
from lambda_gui.app import BuilderApp
from lambda_gui.catalogue import CatalogueScreen
from lambda_gui.entry import Entry, meant
from textual.widgets import DataTable

_WRONG = (
    HAND_WRITTEN.replace('"62.5 degC"', '"62,5 degC"')
    .replace('"1.5 kN"', '"1.5 kg"')
    .replace("[operation]", '[solver]\nduration = "1 m"\n\n[operation]')
)


async def test_f8_goes_through_all_mistakes_and_typing_keeps_what_is_written(work_folder: Path) -> None:
    path = work_folder / "drive-end.toml"
    path.write_text(_WRONG, encoding="utf-8")
    async with BuilderApp(str(path)).run_test(size=SMALL) as pilot:
        await checked(pilot)
        places = [("lubricant", "temperature"), ("loads", "radial"), ("solver", "duration")]
        assert {problem.where for problem in builder(pilot).check.problems} == {".".join(keys) for keys in places}
        for place in (*places, places[0]):
            await pilot.press("f8")
            await wait_for(pilot, lambda place=place: focused_place(pilot) == place)
        entry = pilot.app.focused
        assert isinstance(entry, Entry)
        assert (entry.cursor_position, entry.selected_text) == (len("62,5 degC"), "")
        await pilot.press("home", "right", "right", "delete", "full_stop")  # the comma becomes a point
        draft = builder(pilot).draft
        assert draft.get("lubricant", "temperature") == "62.5 degC"
        await checked(pilot)
        await pilot.press("f8")  # the corrected one is gone: the next one, not the first
        await wait_for(pilot, lambda: focused_place(pilot) == places[1])
        await write(pilot, "x")
        assert draft.get("loads", "radial") == "1.5 kgx"
        draft.set("loads", "radial", value="1.5 kN")
        await checked(pilot)
        await pilot.press("f8")
        await wait_for(pilot, lambda: focused_place(pilot) == places[2])
        await pilot.press("f8")
        await wait_for(pilot, lambda: any("no other error" in note.message for note in pilot.app._notifications))
        assert focused_place(pilot) == places[2]
        await write(pilot, "s")
        assert draft.get("solver", "duration") == "1 ms"


async def test_a_picture_of_the_screen_and_an_oil_by_the_middle_of_its_name(hand_written: Path) -> None:
    assert meant("VG 68", ["FVA3", "mineral-vg68", "pag-vg100"]) == ["mineral-vg68"]
    assert meant("vg", ["mineral-vg68", "pag-vg100"]) == ["mineral-vg68", "pag-vg100"]
    assert meant("fva", ["FVA2", "FVA3"]) == ["FVA2"]
    assert meant("-", ["a-b"]) == []
    async with BuilderApp(str(hand_written)).run_test(size=SMALL) as pilot:
        await checked(pilot)
        await pilot.press("ctrl+p", *"picture of")
        await wait_for(pilot, lambda: "Picture of the screen" in screen_text(pilot.app))
        await pilot.press("enter")
        target = hand_written.with_name("drive-end-screen.svg")
        await wait_for(pilot, target.exists)
        assert "drive-end.toml" in target.read_text(encoding="utf-8")
        pilot.app.save_picture()
        await wait_for(pilot, hand_written.with_name("drive-end-screen-2.svg").exists)
        draft = builder(pilot).draft
        await go_to(pilot, "lubricant.name")
        await write(pilot, "vg100")
        await pilot.press("enter")
        await wait_for(pilot, lambda: any("mineral-vg100, pag-vg100" in n.message for n in pilot.app._notifications))
        assert draft.get("lubricant", "name") == "vg100"
        await go_to(pilot, "lubricant.name")
        await write(pilot, "vg68")
        await pilot.press("enter")
        assert draft.get("lubricant", "name") == "mineral-vg68"
        await go_to(pilot, "bearing.designation")  # the catalogue opens with the bearings
        await pilot.press("f2")
        await wait_for(pilot, lambda: isinstance(pilot.app.screen, CatalogueScreen))
        await write(pilot, "vg68")
        await wait_for(pilot, lambda: "no bearing matches, but 1 lubricant matches: F2" in screen_text(pilot.app))
        await pilot.press("f2")
        await wait_for(pilot, lambda: pilot.app.screen.query_one(DataTable).row_count == 1)
        assert "mineral-vg68" in screen_text(pilot.app)


async def test_temporary_files_are_no_recent_cases(
    hand_written: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (temporary := tmp_path / "temporary").mkdir()
    monkeypatch.setattr(tempfile, "tempdir", str(temporary))
    passing = temporary / "trial.toml"
    passing.write_text(HAND_WRITTEN, encoding="utf-8")
    remember(passing)
    remember(hand_written)
    assert recent_cases() == [hand_written.resolve()]
    monkeypatch.chdir(tmp_path)
    async with BuilderApp().run_test(size=SMALL) as pilot:
        await wait_for(pilot, lambda: "drive-end.toml" in screen_text(pilot.app))
        assert "trial.toml" not in screen_text(pilot.app)
