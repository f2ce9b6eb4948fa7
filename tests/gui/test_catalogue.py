"""Test the catalogue in the builder.

Filter, details, take, rows of one's own.
"""

from __future__ import annotations

from contextlib import closing
from pathlib import Path

import pytest
from driving import LARGE, SMALL, builder, checked, screen_text, wait_for, write
from lambda_gui.app import BuilderApp
from lambda_gui.catalogue import CatalogueScreen
from lambda_gui.from_catalogue import bearing_taken
from lambda_gui.own_row import OwnRow
from lambda_gui.rows import Row
from textual.widgets import DataTable

from lambda_core import api


async def test_a_bearing_is_found_and_taken(hand_written: Path) -> None:
    async with BuilderApp(str(hand_written)).run_test(size=SMALL) as pilot:
        await checked(pilot)
        await pilot.press("f2")
        await wait_for(pilot, lambda: isinstance(pilot.app.screen, CatalogueScreen))
        await write(pilot, "6208 syla")
        table = pilot.app.screen.query_one(DataTable)
        await wait_for(pilot, lambda: table.row_count == 1)
        shown = screen_text(pilot.app)
        for words in ("Syla2026", "A published", "pitch diameter", "D 80 mm"):
            assert words in shown
        await pilot.press("enter")
        await checked(pilot)
        draft = builder(pilot).draft
        assert draft.get("bearing") == {"designation": "6208", "maker": "Syla2026"}


@pytest.mark.parametrize(
    ("before", "typed", "after", "said"),
    [
        ("", "skf 6308 c3", "6308 C3", ""),
        ("6308 C3", "SKF 6308 C4", "6308 C4", "C3 of the designation before goes"),
        ("6308-2Z/C3", "skf 6308", "6308 2Z C3", "2Z, C3 of the designation before stays"),
        ("6208-2Z/C3", "skf 6308", "6308 C3", "C3 of the designation before stays; 2Z of the designation before goes"),
        ("6208 C3", "skf d=40 D=90", "6308 C3", "C3 of the designation before stays"),
        ("6308 C3", "6308/c3 skf", "6308 C3", ""),
    ],
)
def test_suffixes_of_a_designation_are_kept(before: str, typed: str, after: str, said: str) -> None:
    with closing(api.catalogue()) as catalogue:
        taken = bearing_taken(catalogue.bearing("6308", "SKF"), typed, before, catalogue)
    assert (taken.name, taken.maker, taken.said) == (after, "SKF", said)


def test_a_clearance_class_goes_where_the_contact_angle_counts() -> None:
    with closing(api.catalogue()) as catalogue:
        taken = bearing_taken(catalogue.bearing("7208B", "NSK"), "", "6308-2Z/C3", catalogue)
    assert (taken.name, taken.said) == ("7208B", "2Z, C3 of the designation before goes")


@pytest.mark.full
async def test_the_clearance_that_was_typed_is_taken(hand_written: Path) -> None:
    async with BuilderApp(str(hand_written)).run_test(size=SMALL) as pilot:
        await checked(pilot)
        for typed, designation, clearance in (("6308 c3 skf", "6308 C3", 24e-6), ("6308 skf", "6308 C3", 24e-6)):
            await pilot.press("f2")
            await wait_for(pilot, lambda: isinstance(pilot.app.screen, CatalogueScreen))
            await write(pilot, typed)
            table = pilot.app.screen.query_one(DataTable)
            await wait_for(pilot, lambda table=table: table.row_count == 1)
            await pilot.press("enter")
            await checked(pilot)
            assert builder(pilot).draft.get("bearing", "designation") == designation
            model = builder(pilot).check.model
            assert model is not None
            assert model.geometry.clearance == pytest.approx(clearance, abs=1e-6)  # middle of C3, not of CN (13 um)
        said = [note.message for note in pilot.app._notifications]
        assert "6308 C3: C3 of the designation before stays; Ctrl+Z undoes it" in said


async def test_estimated_geometry_is_marked(hand_written: Path) -> None:
    async with BuilderApp(str(hand_written)).run_test(size=LARGE) as pilot:
        await checked(pilot)
        await pilot.press("f2")
        await wait_for(pilot, lambda: isinstance(pilot.app.screen, CatalogueScreen))
        await write(pilot, "6208 skf")
        await wait_for(pilot, lambda: pilot.app.screen.query_one(DataTable).row_count == 1)
        shown = screen_text(pilot.app)
        assert "≈9 x 12.303" in shown
        assert "B derived" in shown
        assert "designs that fit the ratings" in shown
        await pilot.press("pagedown")
        await wait_for(pilot, lambda: "estimated from C0" in screen_text(pilot.app))


async def test_an_oil_is_taken_in_place_of_own_properties(hand_written: Path) -> None:
    async with BuilderApp(str(hand_written)).run_test(size=SMALL) as pilot:
        await checked(pilot)
        draft = builder(pilot).draft
        draft.set("lubricant", "properties", "density_15", value="880 kg/m3")
        await pilot.press("f2")
        await wait_for(pilot, lambda: isinstance(pilot.app.screen, CatalogueScreen))
        await pilot.press("f2")
        await write(pilot, "bode")
        await wait_for(pilot, lambda: pilot.app.screen.query_one(DataTable).row_count == 1)
        await pilot.press("enter")
        await checked(pilot)
        assert draft.get("lubricant", "name") == "bode-mineral"
        assert draft.get("lubricant", "properties") is None
        await pilot.press("ctrl+z")
        assert draft.get("lubricant", "properties") == {"density_15": "880 kg/m3"}


async def test_a_row_of_ones_own_begins_as_a_copy(hand_written: Path) -> None:
    async with BuilderApp(str(hand_written)).run_test(size=LARGE) as pilot:
        await checked(pilot)
        await pilot.press("f2")
        await wait_for(pilot, lambda: isinstance(pilot.app.screen, CatalogueScreen))
        await write(pilot, "6208 syla")
        await wait_for(pilot, lambda: pilot.app.screen.query_one(DataTable).row_count == 1)
        await pilot.press("f4")
        await wait_for(pilot, lambda: isinstance(pilot.app.screen, OwnRow))
        rows = {row.place.keys: row for row in pilot.app.screen.query(Row)}
        rows[("value", "groove_radius_inner")].write("6.25 mm")
        await pilot.press("ctrl+s")  # refused: nobody knows where the value comes from
        assert isinstance(pilot.app.screen, OwnRow)
        rows[("source",)].write("measured by us")
        await pilot.press("ctrl+s")
        await wait_for(pilot, lambda: isinstance(pilot.app.screen, CatalogueScreen))
        await wait_for(pilot, lambda: "own" in screen_text(pilot.app))
        await pilot.press("enter")
        await checked(pilot)
        assert builder(pilot).draft.get("bearing", "maker") == "own"
        assert not builder(pilot).check.problems
    with closing(api.catalogue()) as catalogue:
        row = catalogue.bearing("6208", "own")
        assert row.groove_radius_inner is not None
        assert row.ball_diameter is not None
        assert (row.groove_radius_inner.value, row.groove_radius_inner.source) == (0.00625, "measured by us")
        assert row.ball_diameter.source != "measured by us"  # what was not changed keeps its own source
