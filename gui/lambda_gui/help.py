"""The help screen: keys, axes and signs."""

from __future__ import annotations

from typing import ClassVar

from rich.text import Text
from textual.app import ComposeResult
from textual.binding import Binding, BindingType
from textual.containers import VerticalScroll
from textual.screen import ModalScreen
from textual.widgets import Static

AXES = r"""
            z up
            │   azimuth from +y towards +z
            │  ╮ 270° is down
      ______│___╲______                  outer ring      Frames
     ╱    ◯ │ ◯  ╲     ╲                                 x  shaft axis
    │  ◯  ╭─┼─╮  ◯│     │   gravity ↓ -z                 y  horizontal
    │     │ x⊙──────────── y horizontal                  z  up
    │  ◯  ╰───╯  ◯│     │                                tilt y, z: rotation about y, z
     ╲    ◯   ◯  ╱     ╱                                 spin: about the body's own axis
      ‾‾‾‾‾‾‾‾‾‾‾‾‾‾‾‾‾
"""

SIGNS = """
A positive speed turns y towards z. A positive axial load pushes the inner ring along +x; the
radial load acts at its azimuth (270° = down). The contact angle is positive when the ball pushes
the outer ring towards +x. Clearance is the radial internal clearance, a diametral measure.
A friction torque is the dissipated power over the relative speed of the rings.
"""

KEYS: dict[str, tuple[tuple[str, str], ...]] = {
    "BuilderScreen": (
        ("arrows", "move in the tree; → opens a node or goes into its form, ← closes it"),
        ("Enter", "into the form; in a field: complete it and go on; on a choice: open its list"),
        ("Esc", "back: from the form to the tree, from every other screen to the builder"),
        ("Tab, ↑ ↓", "between fields; the line below says what the field is"),
        ("F2", "choose a bearing or an oil from the catalogue"),
        ("F5 (Ctrl+R)", "run the case as it stands; F7 shows all runs"),
        ("F6", "results: summary, views, comparison, export"),
        ("F8", "go to the next mistake"),
        ("Ctrl+S", "save; only what you changed is changed in the file"),
        ("Ctrl+Z, Ctrl+Y", "undo, redo"),
        ("Ctrl+O", "open another case, a built-in one, or an empty model"),
        ("Ctrl+P", "all commands; type the name of any option to go to it"),
        ("F9", "light or dark"),
        ("Ctrl+Q", "quit"),
    ),
}

MARKS = """
●  differs from the file      ▲2  two mistakes here or below      ≈  estimated or assumed, with its grade
grey text in a field is what holds when nothing is written there; clearing a field goes back to it
numbers take a unit: "16 kN"; a bare number gets the unit that is proposed in grey
"""


class HelpScreen(ModalScreen[None]):
    """Help for one screen."""

    BINDINGS: ClassVar[list[BindingType]] = [
        Binding("escape,f1,q", "dismiss", "Back"),
        Binding("down", "scroll(1)", show=False),
        Binding("up", "scroll(-1)", show=False),
    ]
    DEFAULT_CSS = """
    HelpScreen { align: center middle; background: $background 60%; }
    HelpScreen > VerticalScroll { width: 104; max-width: 98%; height: auto; max-height: 96%; background: $surface;
        border: round $border; padding: 0 2; }
    HelpScreen Static { width: 1fr; height: auto; }
    """

    def __init__(self, screen: str) -> None:
        super().__init__()
        self._screen = screen

    def compose(self) -> ComposeResult:
        """Lay out keys, marks and axes."""
        text = Text("Keys\n", style="bold")
        for key, meaning in KEYS.get(self._screen, KEYS["BuilderScreen"]):
            text.append(f"{key:<16}", style="bold").append(f"{meaning}\n", style="not bold")
        text.append("\nMarks", style="bold").append(MARKS, style="not bold")
        text.append("\nAxes and signs", style="bold").append(AXES, style="not bold").append(SIGNS, style="not bold")
        with VerticalScroll() as box:
            box.can_focus = True
            yield Static(text)

    def action_scroll(self, by: int) -> None:
        """Scroll."""
        self.query_one(VerticalScroll).scroll_relative(y=2 * by)
