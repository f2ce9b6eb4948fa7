"""Test that no screen cuts text, small or large."""

from __future__ import annotations

import shutil
from collections.abc import Callable, Iterable, Sequence
from pathlib import Path

import pytest
from driving import SMALL, at_rest, builder, checked, focused_place, screen_text, wait_for
from lambda_gui.app import BuilderApp
from lambda_gui.catalogue import CatalogueScreen
from lambda_gui.choice import Choice, Entry, PickList
from lambda_gui.dialogs import Ask, AskText, OpenCase
from lambda_gui.help import ABOUT, HelpScreen
from lambda_gui.outline import Node
from lambda_gui.own_row import OwnRow
from lambda_gui.results_screen import ResultsScreen
from lambda_gui.run_screen import RunScreen
from lambda_gui.tree import ModelTree
from reading import cut_on
from textual.geometry import Offset
from textual.pilot import Pilot
from textual.screen import Screen
from textual.widget import Widget
from textual.widgets import DataTable, Input, OptionList, Static

from lambda_core import api
from lambda_core.results.reader import Result
from lambda_core.runs.progress import Progress

MIDDLE = (120, 40)
SIZES = pytest.mark.parametrize("size", [SMALL, MIDDLE], ids=["80x24", "120x40"])
# where little is to be found that the smaller screen does not show, the larger one is left to the slow tests
SMALL_FIRST = pytest.mark.parametrize(
    "size", [pytest.param(SMALL, id="80x24"), pytest.param(MIDDLE, id="120x40", marks=pytest.mark.slow)]
)
FIRST, *OTHERS = api.builtin_cases()


def nothing(found: list[str]) -> None:
    """Require that nothing is cut."""
    assert not found, "\n".join(["cut:", *dict.fromkeys(found)])


def read(pilot: Pilot[None], where: str, within: Widget | None = None) -> list[str]:
    """Return cut texts with their places.

    On the screen, or within a part of it.
    """
    return [f"{where}: {what}" for what in cut_on(pilot.app, within)]  # type: ignore[arg-type]


async def read_at_rest(pilot: Pilot[None], where: str) -> list[str]:
    """Return what is cut once everything is laid out."""
    await at_rest()
    return read(pilot, where)


async def read_forms(pilot: Pilot[None], wanted: Callable[[Node], bool]) -> list[str]:
    """Read every form and its lists.

    The form of each node, and the lists of its choices.
    """
    screen, tree = builder(pilot), pilot.app.screen.query_one(ModelTree)
    for line in list(tree._tree_nodes.values()):
        line.expand()
    await pilot.pause()
    found, lists = read(pilot, "tree"), dict[tuple[str, ...], tuple[str, Sequence[Entry]]]()
    for node in filter(wanted, tree.all_nodes()):
        await screen.show_node(node)
        await pilot.pause()
        assert screen.form is not None
        assert str(screen.form.query_one(".title", Static).visual) == node.heading
        found += read(pilot, node.key, screen.form)
        for choice in screen.query(Choice):
            lists.setdefault(tuple(entry.label for entry in choice.entries), (f"{node.key}, a list", choice.entries))
    await pilot.app.push_screen(Screen())  # a form below would be drawn with each of the lists
    for where, entries in lists.values():
        found += await read_list(pilot, entries, where)
    pilot.app.pop_screen()
    assert not screen.draft.is_changed()  # nothing changes by looking
    return found


async def read_list(pilot: Pilot[None], entries: Sequence[Entry], where: str) -> list[str]:
    """Open a list at the entry with most to say."""
    most = max(entries, key=lambda entry: len(entry.help))
    await pilot.app.push_screen(PickList(entries, most.value, Offset(60, 10)))
    await pilot.pause()
    assert isinstance(pilot.app.screen, PickList)
    found = read(pilot, f"{where}, {most.label}")
    await pilot.app.pop_screen()
    return found


def is_of_one_element(node: Node) -> bool:
    """Tell whether a form repeats another.

    It is that of all elements again, for one of them.
    """
    return node.kind == "role" and bool(node.element)


@pytest.mark.full
@SMALL_FIRST
async def test_every_form_of_a_case(size: tuple[int, int]) -> None:
    async with BuilderApp(FIRST).run_test(size=size) as pilot:
        await checked(pilot)
        nothing(await read_forms(pilot, lambda node: not is_of_one_element(node)))


@pytest.mark.full
@pytest.mark.parametrize("case", ["6220-excited", pytest.param("6319-cp10-1500", marks=pytest.mark.slow)])
async def test_what_is_written_in_other_cases(case: str) -> None:
    """Show the forms that other cases change."""
    async with BuilderApp(case).run_test(size=SMALL) as pilot:
        await checked(pilot)
        draft = builder(pilot).draft
        nothing(await read_forms(pilot, lambda node: any(draft.get(*place) is not None for place in node.places)))


@pytest.mark.slow
@SIZES
@pytest.mark.parametrize("case", [FIRST, *OTHERS])
async def test_every_form_of_every_case(case: str, size: tuple[int, int]) -> None:
    async with BuilderApp(case).run_test(size=size) as pilot:
        await checked(pilot)
        nothing(await read_forms(pilot, lambda node: True))


@pytest.mark.full
@SMALL_FIRST
async def test_an_empty_model_and_what_it_asks(work_folder: Path, size: tuple[int, int]) -> None:
    (work_folder / "a-case-with-quite-a-long-name-of-its-own.toml").write_text("", encoding="utf-8")
    found = []
    async with BuilderApp().run_test(size=size) as pilot:
        await wait_for(pilot, lambda: isinstance(pilot.app.screen, OpenCase))
        await wait_for(pilot, lambda: "geared-shaft" in screen_text(pilot.app))
        await pilot.pause()
        found += read(pilot, "which case")
        await pilot.press("enter")
        await checked(pilot)
        found += read(pilot, "mistakes")
        await pilot.press("f8")
        await wait_for(pilot, lambda: focused_place(pilot))
        found += read(pilot, "a required field")
        await pilot.press("ctrl+p", *"radial")
        await wait_for(pilot, lambda: "loads.radial_direction" in screen_text(pilot.app))
        found += read(pilot, "palette")
        await pilot.press("escape")
        for question in (
            Ask("drive-end-of-the-fan.toml has unsaved changes.", ["save", "discard the changes", "go back"]),
            Ask("1 run going on, 2 waiting (these would not be started).", ["let them go on", "stop them", "go back"]),
            Ask(
                "drive-end.toml has been changed by another program since it was opened here.",
                ["save under another name", "overwrite", "go back"],
            ),
            Ask("There is unsaved work on drive-end.toml from 12 minutes ago.", ["recover", "discard", "decide later"]),
            AskText("Save the case as", "drive-end.toml"),
            *(HelpScreen(screen) for screen in ABOUT),
        ):
            await pilot.app.push_screen(question)
            await pilot.pause()
            found += read(pilot, str(question))
            pilot.app.pop_screen()
    nothing(found)


@pytest.mark.full
@SMALL_FIRST
async def test_the_catalogue(size: tuple[int, int]) -> None:
    found = []
    async with BuilderApp(FIRST).run_test(size=size) as pilot:
        await checked(pilot)
        for key, most in (("f2", 12), ("f2", 100)):
            await pilot.press(key)
            await wait_for(pilot, lambda: isinstance(pilot.app.screen, CatalogueScreen))
            await pilot.pause()
            screen = pilot.app.screen
            assert isinstance(screen, CatalogueScreen)
            rows = screen.query_one(DataTable)
            for number in range(min(most, rows.row_count)):
                rows.move_cursor(row=number)
                await pilot.pause()
                found += read(pilot, f"{screen._kind} {number}")
            await pilot.press("f4")
            await wait_for(pilot, lambda: isinstance(pilot.app.screen, OwnRow))
            found += read(pilot, f"own {screen._kind}")
            await pilot.press("escape")
            await wait_for(pilot, lambda: isinstance(pilot.app.screen, CatalogueScreen))
        for text in ("6208 skf", "6319", "nothing of this name"):
            screen._kind = "bearing"
            screen._show_kind()
            screen.query_one(Input).value = text
            screen.find()
            await pilot.pause()
            found += read(pilot, text)
    nothing(found)


def runs_of_every_kind(folder: Path) -> Iterable[api.QueuedRun]:
    """Return runs in every state.

    With names and messages as long as they come.
    """
    history = [
        Progress(
            time_s=0.01 * n,
            percent=0.5 * n,
            cage_revolutions=0.02 * n,
            cage_revolutions_wanted=20.0,
            averaged=0,
            friction_torque_Nmm=12345.6,
            friction_torque_ci_Nmm=123.4,
            friction_torque_now_Nmm=12300.0 + 10 * (n % 7),
            cage_speed_ratio=0.4,
            energy_residual=-1.2e-5,
            inner_loads_N=[12345.0] * 9,
            wall_s=0.1 * n,
            left_s=4000.0,
        )
        for n in range(150)
    ]
    long = (
        "balls do not touch their rings: the load of 16 N is too small for a ring that turns at 15 000 1/min; "
        "add an axial load"
    )
    for state, message in (
        ("waiting", ""),
        ("running", "running"),
        ("done", "converged"),
        ("done", "not converged within 30 turns of the cage: the confidence interval of the friction torque is 4 %"),
        ("stopped", "stopped; what it has is kept"),
        ("failed", long),
    ):
        run = api.QueuedRun("6319-cp6.5-3000-with-more", folder / f"{state}.h5", folder, state=state, message=message)  # type: ignore[arg-type]
        run.history = history if state != "waiting" else []
        yield run


@SMALL_FIRST
async def test_runs(work_folder: Path, size: tuple[int, int]) -> None:
    async with BuilderApp(FIRST).run_test(size=size) as pilot:
        await checked(pilot)
        await pilot.press("f7")
        await wait_for(pilot, lambda: isinstance(pilot.app.screen, RunScreen))
        found = read(pilot, "no runs")
        screen = pilot.app.screen
        assert isinstance(screen, RunScreen)
        pilot.app.queue.poll = lambda: False
        pilot.app.queue.runs += runs_of_every_kind(work_folder)
        screen.follow()
        for number, run in enumerate(pilot.app.queue.runs):
            screen.query_one(DataTable).move_cursor(row=number)
            await pilot.pause()
            found += await read_at_rest(pilot, f"{run.state} {run.message[:20]}")
        pilot.app.queue.runs.clear()
    nothing(found)


@pytest.mark.full
@SMALL_FIRST
async def test_results(work_folder: Path, combined_run: Result, size: tuple[int, int]) -> None:
    for name in ("6319-cp6.5-3000", "6208-axial-1300"):
        shutil.copy(combined_run.path, work_folder / f"{name}.h5")
    found = []
    async with BuilderApp(FIRST).run_test(size=size) as pilot:
        await checked(pilot)
        await pilot.press("f6")
        await wait_for(pilot, lambda: isinstance(pilot.app.screen, ResultsScreen))
        screen = pilot.app.screen
        await pilot.press("f1")
        await wait_for(pilot, lambda: isinstance(pilot.app.screen, HelpScreen))
        await pilot.press("escape")
        views = screen.query_one("#views", OptionList)
        for marked in (0, 2):
            if marked:
                await pilot.press("tab", *["space", "down"] * marked, "tab")
            wanted = "comparison" if marked else "film"
            await wait_for(pilot, lambda wanted=wanted: any(option.id == wanted for option in views.options))
            # Of two runs side by side, the views that one alone has not shown already, and some of the others.
            for number in range(0, views.option_count, 4 if marked else 1):
                views.highlighted = number
                await wait_for(pilot, lambda: not any(worker.is_running for worker in pilot.app.workers))
                await pilot.pause()
                found += await read_at_rest(pilot, f"{marked} marked, {views.get_option_at_index(number).id}")
    nothing(found)
