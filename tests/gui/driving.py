"""Drive the builder by keyboard.

Nothing here takes a time for enough: a key has been heard when nothing is left to do, and what takes time (a check, a
run, a timer) is waited for by what it does.
"""

from __future__ import annotations

import asyncio
import time
from collections.abc import Callable
from typing import Any

import pytest
import textual.app
import textual.pilot
from lambda_gui.app import BuilderApp
from lambda_gui.builder import BuilderScreen
from lambda_gui.rows import Row
from lambda_gui.tree import ModelTree
from textual import constants, events
from textual._compositor import Compositor
from textual._context import active_app
from textual.app import App
from textual.command import CommandList, CommandPalette
from textual.pilot import Pilot
from textual.screen import Screen

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


_LONGEST = 200.0  # nothing takes so long on the slowest machine; pytest's own limit says less [s]


async def at_rest(*_: float) -> None:
    """Wait for messages, callbacks and picture.

    Nothing else happens that waits neither for time nor for a thread.

    Textual's own way takes a process that gets little of the processor for one that has nothing to do.
    """
    loop, app = asyncio.get_running_loop(), active_app.get()
    for _ in range(1000):
        await asyncio.sleep(0)
        if loop._ready:  # type: ignore[attr-defined]
            continue
        if not app.screen_stack or not _is_to_be_drawn(app.screen):
            return
        app.screen._on_timer_update()
    raise AssertionError("there is always something to do")


def hear_every_key(patch: pytest.MonkeyPatch) -> None:
    """Let the pilot wait for keys.

    Textual's; what would move is at its end at once.

    Between two keys the screen is laid out and not drawn, as in a terminal that shows less pictures than a second has
    keys: drawing takes a third of the time. What is waited for, or looked at, is drawn.
    """

    async def screen_at_rest(self: Pilot[None], timeout: float = 0.0) -> bool:
        await at_rest()
        return self.app._exception is None

    shutdown = App._shutdown

    async def as_when_a_person_quits(self: App[None]) -> None:
        self._exit = True  # what App.exit says first, to all who come back late
        self.workers.cancel_all()
        await shutdown(self)

    patch.setattr(App, "_shutdown", as_when_a_person_quits)
    patch.setattr(textual.app, "wait_for_idle", at_rest)
    patch.setattr(textual.pilot, "wait_for_idle", at_rest)
    patch.setattr(Pilot, "_wait_for_screen", screen_at_rest)
    patch.setattr(constants, "TEXTUAL_ANIMATIONS", "none")
    patch.setattr(Compositor, "render_update", _draw_complete)


def _is_to_be_drawn(screen: Screen[object]) -> bool:
    if screen.app._batch_count or not screen.is_current:
        return False
    required = (screen._layout_required, screen._scroll_required, screen._repaint_required, screen._recompose_required)
    return any(required) or bool(screen._dirty_widgets) or bool(screen._callbacks)


_draw = Compositor.render_update


def _draw_complete(self: Compositor, full: bool = False, *what: Any, **how: Any) -> Any:
    return _draw(self, full, *what, **how) if full else None


async def wait_for(pilot: Pilot[None], what: Callable[[], object], seconds: float = _LONGEST) -> None:
    """Let the builder work until something is so."""
    end, pause = time.monotonic() + seconds, 0.01
    await at_rest()
    while not what():
        if time.monotonic() > end:
            raise AssertionError(f"waited {seconds} s in vain; on screen:\n{screen_text(pilot.app)}")  # type: ignore[arg-type]
        await asyncio.sleep(pause)
        pause = min(1.5 * pause, 0.1)  # to look takes as long as some pauses
        await at_rest()
    if pilot.app.screen_stack:
        _draw(pilot.app.screen._compositor, screen_stack=pilot.app._background_screens)


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
    """Wait for the check of the case.

    Its results are then shown.
    """
    await at_rest()  # what the last key did
    screen = builder(pilot)
    screen.edited()
    await wait_for(pilot, lambda: screen.is_checked)
    await at_rest()


async def write(pilot: Pilot[None], text: str) -> None:
    """Type a text."""
    await pilot.press(*text)


async def go_to(pilot: Pilot[None], path: str) -> None:
    """Go to an option by command.

    As an entry of the command palette does.
    """
    keys = tuple(path.split("."))
    builder(pilot).go_to(keys)
    await wait_for(pilot, lambda: focused_place(pilot) == keys)


async def move_to(pilot: Pilot[None], key: str) -> None:
    """Move the tree's cursor to a node.

    With the keyboard on the tree.
    """
    tree = pilot.app.screen.query_one(ModelTree)
    tree.focus()
    tree.go_to(key)

    def is_there() -> bool:
        at = tree.cursor_node
        return tree.has_focus and at is not None and at.data is not None and at.data.key == key

    await wait_for(pilot, is_there)


async def find(pilot: Pilot[None], path: str, begin: str = "") -> None:
    """Go to an option by keyboard.

    Put its name, or the beginning of it, into the command palette, as a paste does.

    Typed letter by letter, each letter is a search of all options.
    """
    await pilot.press("ctrl+p")
    await wait_for(pilot, lambda: isinstance(pilot.app.screen, CommandPalette) and pilot.app.focused is not None)
    pilot.app.post_message(events.Paste(begin or path))
    hits = pilot.app.screen.query_one(CommandList)
    await wait_for(pilot, lambda: hits.option_count and path in str(hits.get_option_at_index(0).prompt))
    await pilot.press("enter")
    await wait_for(pilot, lambda: focused_place(pilot) == tuple(path.split(".")))


def focused_place(pilot: Pilot[None]) -> tuple[str, ...]:
    """Return the focused row's place.

    It is a place in the case.
    """
    focused = pilot.app.focused
    rows = [w for w in focused.ancestors_with_self if isinstance(w, Row)] if focused else []
    return tuple(rows[0].place.keys) if rows else ()
