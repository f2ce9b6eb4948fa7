"""Test editing, undo and saving by keyboard."""

from __future__ import annotations

import difflib
import json
import os
import shutil
import time
from pathlib import Path

import pytest
from driving import (
    HAND_WRITTEN,
    LARGE,
    SMALL,
    builder,
    checked,
    find,
    focused_place,
    go_to,
    screen_text,
    wait_for,
    write,
)
from lambda_gui import recovery
from lambda_gui.app import BuilderApp
from lambda_gui.builder import BuilderScreen
from lambda_gui.checking import Checker
from lambda_gui.choice import Choice
from lambda_gui.dialogs import Ask, AskText
from lambda_gui.help import HelpScreen
from lambda_gui.option_help import OptionHelp
from lambda_gui.theme import DARK, LIGHT
from lambda_gui.tree import ModelTree
from textual.pilot import Pilot
from textual.widgets import Button, Input

from lambda_core import api
from lambda_core.discovery import local_files, manager
from lambda_core.domain.installed import ON_VARIABLE


def changed_lines(before: str, after: str) -> list[str]:
    lines = difflib.unified_diff(before.splitlines(), after.splitlines(), lineterm="", n=0)
    return [line for line in lines if line[0] in "+-" and not line.startswith(("+++", "---"))]


async def test_a_mistake_is_corrected_and_a_load_changed_in_one_line(hand_written: Path) -> None:
    async with BuilderApp(str(hand_written)).run_test(size=SMALL) as pilot:
        await checked(pilot)
        assert "ready" in screen_text(pilot.app)
        await go_to(pilot, "lubricant.temperature")
        await pilot.press("ctrl+a", "ctrl+k")
        await write(pilot, "62,5 degC")
        await checked(pilot)
        shown = screen_text(pilot.app)
        assert "decimal point" in shown
        assert "▲ 1 mistake" in shown
        tree = pilot.app.screen.query_one(ModelTree)
        assert tree.wrong_nodes() == ["lubricant"]
        await pilot.press("escape", "home")
        await pilot.press("f8")
        await wait_for(pilot, lambda: focused_place(pilot) == ("lubricant", "temperature"))
        await pilot.press("ctrl+z")
        await checked(pilot)
        assert builder(pilot).draft.get("lubricant", "temperature") == "62.5 degC"
        assert not builder(pilot).check.problems
        await find(pilot, "loads.radial")
        await pilot.press("ctrl+a", "ctrl+k")
        await write(pilot, "1800")
        await pilot.press("enter")
        assert builder(pilot).draft.get("loads", "radial") == "1800 N"
        await checked(pilot)
        assert "● unsaved" in screen_text(pilot.app)
        await pilot.press("ctrl+s")
        await wait_for(pilot, lambda: not builder(pilot).draft.is_changed())
    after = hand_written.read_text(encoding="utf-8")
    assert changed_lines(HAND_WRITTEN, after) == ['-radial = "1.5 kN"      # belt', '+radial = "1800 N"      # belt']
    assert api.case(hand_written).loads.radial == 1800.0


@pytest.mark.full
async def test_every_kind_of_row_is_changed_undone_and_redone(hand_written: Path) -> None:
    async with BuilderApp(str(hand_written)).run_test(size=LARGE) as pilot:
        await checked(pilot)
        await go_to(pilot, "bearing.clearance_pick")
        await pilot.press("enter", "down", "enter")
        await go_to(pilot, "depth.cage")
        await pilot.press("space")
        await go_to(pilot, "depth.strips")
        await write(pilot, "21")
        draft = builder(pilot).draft
        assert draft.get("bearing", "clearance_pick") == "minimum"
        assert draft.get("depth") == {"cage": False, "strips": 21}
        await pilot.press(*["ctrl+z"] * 3)
        assert not draft.is_changed()
        await pilot.press("ctrl+y", "ctrl+y")
        assert draft.get("depth") == {"cage": False}
        await pilot.press("ctrl+z", "ctrl+z")
        assert not draft.is_changed()
        # a material of one's own begins with the values so far
        builder(pilot).go_to(("materials", "balls"))
        await wait_for(pilot, lambda: focused_place(pilot) == ("materials", "balls"))
        await pilot.press("enter", "end", "enter")
        await checked(pilot)
        own = builder(pilot).draft.get("materials", "balls")
        assert own["youngs_modulus"] == "210 GPa"
        assert own["poisson_ratio"] == 0.3
        assert not builder(pilot).check.problems
        # a law of one contact, and its parameter
        await go_to(pilot, "forces.ball_inner.models.traction")
        await pilot.press("enter", "down", "down", "enter")
        await checked(pilot)
        chosen = builder(pilot).draft.get("forces", "ball_inner", "models", "traction")
        assert chosen in [item.name for item in api.plugins().items if item.role == "traction"]
        shown = screen_text(pilot.app)
        card = api.plugin_model(f"traction/{chosen}")
        assert card.reference.split(",")[0] in shown.replace("\n", " ")
        await pilot.press("down")
        place = focused_place(pilot)
        assert place[:4] == ("forces", "ball_inner", "parameters", "traction")
        assert place[4] == card.parameters[0].name


@pytest.mark.full
async def test_a_load_over_time(hand_written: Path) -> None:
    async with BuilderApp(str(hand_written)).run_test(size=LARGE) as pilot:
        await checked(pilot)
        await go_to(pilot, "loads.radial")
        await pilot.press("shift+tab", "enter", "down", "enter")  # value, ramp
        draft = builder(pilot).draft
        assert draft.get("loads", "radial") == {"kind": "ramp", "start": "1.5 kN", "end": "1.5 kN"}
        await checked(pilot)
        assert [p.where for p in builder(pilot).check.problems] == ["loads.radial.end_time"]
        assert "is required" in screen_text(pilot.app)
        await pilot.press("f8")
        await wait_for(pilot, lambda: focused_place(pilot) == ("loads", "radial", "end_time"))
        await write(pilot, "20 m")
        await pilot.press("enter")
        await checked(pilot)
        assert draft.get("loads", "radial", "end_time") == "20 ms"
        assert not builder(pilot).check.problems


@pytest.mark.full
async def test_a_number_typed_on_the_kind_of_a_load_is_its_value(hand_written: Path) -> None:
    """Replace the value when a number is typed.

    Arrow keys reach the kind first; typed text replaces the old value from either field.
    """
    async with BuilderApp(str(hand_written)).run_test(size=SMALL) as pilot:
        await checked(pilot)
        draft = builder(pilot).draft
        await find(pilot, "loads.radial")
        await write(pilot, "2.5 k")
        await pilot.press("enter")
        assert draft.get("loads", "radial") == "2.5 kN"
        await find(pilot, "loads.axial")
        await pilot.press("shift+tab")
        await write(pilot, "0.5 k")
        await pilot.press("enter")
        assert draft.get("loads", "axial") == "0.5 kN"
        await find(pilot, "loads.radial")
        await pilot.press("shift+tab", "enter", "down", "enter")  # value, ramp
        await wait_for(pilot, lambda: draft.get("loads", "radial", "end") == "2.5 kN")
        await find(pilot, "loads.radial")
        assert isinstance(pilot.app.focused, Choice)
        await write(pilot, "12")
        await pilot.press("enter")
        assert draft.get("loads", "radial", "start") == "12 N"


@pytest.mark.full
async def test_a_sum_of_loads_and_a_table_of_points(hand_written: Path) -> None:
    async with BuilderApp(str(hand_written)).run_test(size=LARGE) as pilot:
        await checked(pilot)
        await go_to(pilot, "loads.axial")
        await pilot.press("shift+tab", "enter", "end", "enter")
        draft = builder(pilot).draft
        assert draft.get("loads", "axial") == {"kind": "sum", "terms": ["200 N"]}
        await pilot.click("#add-term")
        assert draft.get("loads", "axial", "terms") == ["200 N", "0 N"]
        await go_to(pilot, "loads.radial")
        await pilot.press("shift+tab", "enter", *["down"] * 3, "enter")
        assert draft.get("loads", "radial") == {"kind": "table", "points": [["0 s", "1.5 kN"]]}
        await pilot.press("tab", "end", "enter")
        await write(pilot, "1 s, 2 kN")
        await checked(pilot)
        assert draft.get("loads", "radial", "points") == [["0 s", "1.5 kN"], ["1 s", "2 kN"]]
        await go_to(pilot, "loads.radial.interpolation")
        await pilot.press("enter", "end", "enter")
        await checked(pilot)
        assert draft.get("loads", "radial", "interpolation") == "spline"
        assert not builder(pilot).check.problems


@pytest.mark.full
async def test_a_ring_is_moved_and_supported(hand_written: Path) -> None:
    async with BuilderApp(str(hand_written)).run_test(size=LARGE) as pilot:
        await checked(pilot)
        draft = builder(pilot).draft
        builder(pilot).go_to(("bodies", "inner_ring", "x"))
        await wait_for(pilot, lambda: focused_place(pilot) == ("bodies", "inner_ring", "x"))
        await pilot.press("enter", "down", "enter")  # free, free on a support
        await pilot.press("down")
        await write(pilot, "10 N/um")
        assert draft.get("bodies", "inner_ring", "x") == {"mode": "free", "stiffness": "10 N/um"}
        builder(pilot).go_to(("bodies", "outer_ring", "x"))
        await wait_for(pilot, lambda: focused_place(pilot) == ("bodies", "outer_ring", "x"))
        await pilot.press("enter", "end", "enter")
        await checked(pilot)
        assert draft.get("bodies", "outer_ring", "x") == "prescribed"
        assert "needs a motion" in screen_text(pilot.app)
        await pilot.press("enter", "up", "enter")  # locked, which is its default
        assert draft.get("bodies", "outer_ring") is None


@pytest.mark.full
async def test_markers_come_and_go(hand_written: Path) -> None:
    async with BuilderApp(str(hand_written)).run_test(size=LARGE) as pilot:
        await checked(pilot)
        tree = pilot.app.screen.query_one(ModelTree)
        tree.go_to("markers")
        await wait_for(pilot, lambda: pilot.app.screen.query("#new-name"))
        pilot.app.screen.query_one("#new-name", Input).focus()
        await write(pilot, "rim")
        await pilot.press("enter")
        await wait_for(pilot, lambda: focused_place(pilot) == ("markers", "rim", "body"))
        draft = builder(pilot).draft
        assert draft.get("markers", "rim") == {"body": "inner_ring"}
        await checked(pilot)
        assert not builder(pilot).check.problems
        await pilot.click("#remove")
        await checked(pilot)
        assert draft.get("markers") is None
        assert not draft.is_changed()


async def into(pilot: Pilot[None], section: str, first: str) -> None:
    """Go to a section's first field.

    In the tree, and with Enter to the first thing of its form.
    """
    tree = pilot.app.screen.query_one(ModelTree)
    tree.focus()
    tree.go_to(section)
    await wait_for(pilot, lambda: pilot.app.screen.query(first))
    await pilot.press("enter")
    await wait_for(pilot, lambda: pilot.app.screen.query_one(first).has_focus)


@pytest.mark.full
async def test_elements_come_and_go_by_keyboard(hand_written: Path) -> None:
    """Add, edit and remove a stiff spring by keyboard.

    It works at 80 x 24 and at any size.
    """
    async with BuilderApp(str(hand_written)).run_test(size=SMALL) as pilot:
        await checked(pilot)
        await into(pilot, "elements", "#new-name")
        await write(pilot, "seat")
        await pilot.press("enter")
        await wait_for(pilot, lambda: (focused_place(pilot) or ("",))[0] == "elements")
        draft = builder(pilot).draft
        assert draft.get("elements", "seat") == {"law": "bushing", "second": "inner_ring"}
        await checked(pilot)
        assert not builder(pilot).check.problems
        builder(pilot).go_to(("elements", "seat", "parameters", "stiffness_x"))
        await wait_for(pilot, lambda: focused_place(pilot) == ("elements", "seat", "parameters", "stiffness_x"))
        await write(pilot, "5 N/um")
        await pilot.press("enter")
        await checked(pilot)
        assert draft.get("elements", "seat", "parameters") == {"stiffness_x": "5 N/um"}
        assert not builder(pilot).check.problems
        pilot.app.screen.query_one("#remove", Button).focus()
        await pilot.press("enter")
        await checked(pilot)
        assert draft.get("elements") is None
        assert not draft.is_changed()


@pytest.mark.full
async def test_observers_and_events_of_plugins_come_and_go_by_keyboard(
    hand_written: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    examples = Path(__file__).parents[2] / "examples"
    for name in ("sliding-wear", "cage-whirl"):
        module = name.replace("-", "_")
        shutil.copy(examples / name / module / "__init__.py", hand_written.parent / f"{module}.py")
    files = [str(hand_written.parent / f"{name}.py") for name in ("sliding_wear", "cage_whirl")]
    monkeypatch.setenv(ON_VARIABLE, os.pathsep.join(files))
    monkeypatch.setattr(local_files, "_texts", {})
    manager.registry.cache_clear()
    try:
        async with BuilderApp(str(hand_written)).run_test(size=SMALL) as pilot:
            await checked(pilot)
            draft = builder(pilot).draft
            for section, name in (("observers", "sliding-wear"), ("events", "cage-whirl")):
                await into(pilot, section, f"#new-{name}")
                await pilot.press("enter")
                await wait_for(pilot, lambda section=section: (focused_place(pilot) or ("",))[0] == section)
                assert draft.get(section, name) == {}
                await checked(pilot)
                assert not builder(pilot).check.problems
            assert focused_place(pilot) == ("events", "cage-whirl", "action")
            builder(pilot).go_to(("observers", "sliding-wear", "coefficient"))
            await wait_for(pilot, lambda: (focused_place(pilot) or ("",))[-1] == "coefficient")
            await write(pilot, "2e-8")
            await pilot.press("enter")
            await checked(pilot)
            assert float(draft.get("observers", "sliding-wear", "coefficient")) == 2e-8
            assert not builder(pilot).check.problems
            pilot.app.screen.query_one("#remove", Button).focus()
            await pilot.press("enter")
            await checked(pilot)
            assert draft.get("observers") is None
            assert draft.get("events") == {"cage-whirl": {}}
    finally:
        monkeypatch.undo()
        manager.registry.cache_clear()


async def test_an_unknown_option_of_a_file_can_be_taken_out(hand_written: Path) -> None:
    hand_written.write_text(HAND_WRITTEN.replace('axial = "200 N"', 'axail = "200 N"'), encoding="utf-8")
    async with BuilderApp(str(hand_written)).run_test(size=LARGE) as pilot:
        await checked(pilot)
        assert "nearest: axial" in screen_text(pilot.app)
        await pilot.press("f8")
        await wait_for(pilot, lambda: focused_place(pilot) == ("loads", "axail"))
        await pilot.press("ctrl+a", "ctrl+k")
        await checked(pilot)
        assert not builder(pilot).check.problems


@pytest.mark.clock
async def test_checking_takes_less_than_30_ms_and_typing_does_not_wait_for_it(hand_written: Path) -> None:
    draft = api.draft(hand_written)
    checker = Checker(draft.root)
    checker.check(draft.tables, draft.folder)
    taken = []
    for _ in range(10):
        begin = time.process_time()  # other programs of the machine do not count
        assert checker.check(draft.tables, draft.folder).model is not None
        taken.append(time.process_time() - begin)
    assert min(taken) < 0.030
    checker.close()
    async with BuilderApp(str(hand_written)).run_test(size=SMALL) as pilot:
        await checked(pilot)
        begin = time.process_time()
        builder(pilot).edited()
        assert time.process_time() - begin < 0.030


async def test_unsaved_work_survives_a_crash(hand_written: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    async with BuilderApp(str(hand_written)).run_test(size=SMALL) as pilot:
        await checked(pilot)
        screen = builder(pilot)
        screen.draft.set("loads", "radial", value="9 kN")
        screen._keep()
    # The builder is gone without saving; its process, too, as far as the next one can tell.
    (kept,) = (recovery.state_folder() / "unsaved").glob("*.json")
    content = json.loads(kept.read_text(encoding="utf-8"))
    content["process"]["start"] = "long ago"
    kept.write_text(json.dumps(content), encoding="utf-8")
    async with BuilderApp(str(hand_written)).run_test(size=SMALL) as pilot:
        await wait_for(pilot, lambda: isinstance(pilot.app.screen, Ask))
        await wait_for(pilot, lambda: "unsaved work on drive-end.toml" in screen_text(pilot.app))
        await pilot.press("enter")
        await wait_for(pilot, lambda: builder(pilot).draft.get("loads", "radial") == "9 kN")
        assert builder(pilot).draft.is_changed()
        await pilot.press("ctrl+s")
        await wait_for(pilot, lambda: not builder(pilot).draft.is_changed())
    assert 'radial = "9 kN"        # belt' in hand_written.read_text(encoding="utf-8")
    assert not list((recovery.state_folder() / "unsaved").glob("*.json"))


async def test_a_file_changed_elsewhere_is_not_overwritten_silently_and_leaving_asks(hand_written: Path) -> None:
    app = BuilderApp(str(hand_written))
    async with app.run_test(size=SMALL) as pilot:
        await checked(pilot)
        hand_written.write_text(HAND_WRITTEN + "# theirs\n", encoding="utf-8")
        builder(pilot).draft.set("loads", "radial", value="9 kN")
        await pilot.press("ctrl+s")
        await wait_for(pilot, lambda: isinstance(pilot.app.screen, Ask))
        await pilot.press("enter")  # save under another name
        await wait_for(pilot, lambda: isinstance(pilot.app.screen, AskText))
        await pilot.press("ctrl+a", "ctrl+k")
        await write(pilot, "mine")
        await pilot.press("enter")
        await wait_for(pilot, lambda: Path("mine.toml").exists())
        assert hand_written.read_text(encoding="utf-8").endswith("# theirs\n")
        assert api.case("mine.toml").loads.radial == 9000.0
        builder(pilot).draft.set("loads", "radial", value="8 kN")
        await pilot.press("ctrl+q")
        await wait_for(pilot, lambda: isinstance(pilot.app.screen, Ask))
        await pilot.press("escape")
        assert app.is_running
        await pilot.press("ctrl+q")
        await wait_for(pilot, lambda: isinstance(pilot.app.screen, Ask))
        await pilot.press("enter")  # save
        await wait_for(pilot, lambda: not app.is_running)
    assert api.case("mine.toml").loads.radial == 8000.0


async def test_help_stands_on_every_screen_and_is_complete_for_a_field(hand_written: Path) -> None:
    async with BuilderApp(str(hand_written)).run_test(size=LARGE) as pilot:
        await checked(pilot)
        for way in ((), ("f2",), ("f7",), ("f6",)):
            await pilot.press(*way)
            assert isinstance(pilot.app.screen, BuilderScreen) != bool(way)
            await pilot.press("f1")
            await wait_for(pilot, lambda: isinstance(pilot.app.screen, HelpScreen))
            assert "Axes and signs" in screen_text(pilot.app)
            await pilot.press("escape")
            if way:
                await pilot.press("escape")
            assert isinstance(pilot.app.screen, BuilderScreen)
        await pilot.resize_terminal(*SMALL)
        await go_to(pilot, "models.traction")
        await pilot.press("down")
        short = pilot.app.screen.query_one(OptionHelp)
        await wait_for(pilot, lambda: "F1 shows the rest" in str(short.visual))
        await pilot.press("f1")
        await wait_for(pilot, lambda: isinstance(pilot.app.screen, HelpScreen))
        shown = screen_text(pilot.app)
        assert "limit ratio" in shown
        assert "parameters.traction.limit_ratio" in shown


async def test_colours_follow_the_theme_and_the_screen_its_size(hand_written: Path) -> None:
    async with BuilderApp(str(hand_written)).run_test(size=SMALL) as pilot:
        await checked(pilot)
        await wait_for(pilot, lambda: "ready" in screen_text(pilot.app))
        assert str(DARK.success) in pilot.app.export_screenshot().lower()
        dark = pilot.app.theme
        await pilot.press("f9")
        assert pilot.app.theme != dark
        await wait_for(pilot, lambda: str(LIGHT.success) in pilot.app.export_screenshot().lower())
        assert str(DARK.success) not in pilot.app.export_screenshot().lower()
        for size in (LARGE, SMALL, (60, 16), LARGE, (200, 60)):
            await pilot.resize_terminal(*size)
            assert "drive-end.toml" in screen_text(pilot.app)
