"""Driving the builder by keyboard."""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import TYPE_CHECKING

from lambda_gui.app import BuilderApp
from lambda_gui.builder import BuilderScreen
from lambda_gui.rows import Row
from lambda_gui.tree import ModelTree
from textual.command import CommandList, CommandPalette

if TYPE_CHECKING:
    from textual.pilot import Pilot

HAND_WRITTEN = """\
# Drive end of the fan.
name = "drive-end"

[bearing]
designation = "6208"   # from the parts list
maker = "SKF"

[lubricant]
name = "FVA3"
temperature = "62.5 degC"

[loads]
radial = "1.5 kN"      # belt
axial = "200 N"

[operation]
speed = "1500 rpm"
"""

SMALL, LARGE = (80, 24), (160, 48)


async def wait_for(pilot: Pilot[None], what: Callable[[], object], seconds: float = 20.0) -> None:
    """Let the builder work until something is so."""
    end = time.monotonic() + seconds
    while not what():
        if time.monotonic() > end:
            raise AssertionError(f"waited {seconds} s in vain; on screen:\n{screen_text(pilot.app)}")  # type: ignore[arg-type]
        await pilot.pause(0.03)


def screen_text(app: BuilderApp) -> str:
    """Return what stands on the screen."""
    width, height = app.size
    strips = app.screen._compositor.render_strips(app.size)
    return "\n".join("".join(segment.text for segment in strip)[:width] for strip in strips[:height])


def builder(pilot: Pilot[None]) -> BuilderScreen:
    """Return the builder's screen."""
    assert isinstance(pilot.app, BuilderApp)
    return pilot.app.builder


async def checked(pilot: Pilot[None]) -> None:
    """Wait until the case, as it stands, has been checked."""
    screen = builder(pilot)
    before = screen.check
    screen.edited()
    await wait_for(pilot, lambda: screen.check is not before)
    await pilot.pause(0.05)


async def write(pilot: Pilot[None], text: str) -> None:
    """Type a text."""
    await pilot.press(*text)


async def go_to(pilot: Pilot[None], path: str) -> None:
    """Go to an option, as an entry of the command palette does."""
    keys = tuple(path.split("."))
    builder(pilot).go_to(keys)
    await wait_for(pilot, lambda: focused_place(pilot) == keys)


async def move_to(pilot: Pilot[None], key: str) -> None:
    """Move the tree's cursor to a node, with the keyboard on the tree."""
    tree = pilot.app.screen.query_one(ModelTree)
    tree.focus()
    tree.go_to(key)

    def is_there() -> bool:
        at = tree.cursor_node
        return tree.has_focus and at is not None and at.data is not None and at.data.key == key

    await wait_for(pilot, is_there)


async def find(pilot: Pilot[None], path: str, begin: str = "") -> None:
    """Go to an option by keyboard: type its name, or the beginning of it, into the command palette."""
    await pilot.press("ctrl+p")
    await wait_for(pilot, lambda: isinstance(pilot.app.screen, CommandPalette))
    await write(pilot, begin or path)
    hits = pilot.app.screen.query_one(CommandList)
    await wait_for(pilot, lambda: hits.option_count and path in str(hits.get_option_at_index(0).prompt))
    await pilot.press("enter")
    await wait_for(pilot, lambda: focused_place(pilot) == tuple(path.split(".")))


def focused_place(pilot: Pilot[None]) -> tuple[str, ...]:
    """Return the place in the case of the row that has the keyboard."""
    focused = pilot.app.focused
    rows = [w for w in focused.ancestors_with_self if isinstance(w, Row)] if focused else []
    return tuple(rows[0].place.keys) if rows else ()
