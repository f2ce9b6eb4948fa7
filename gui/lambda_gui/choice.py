"""Define a choice that opens a list with help."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import ClassVar

from rich.text import Text
from textual import events
from textual.app import ComposeResult
from textual.binding import Binding, BindingType
from textual.containers import Vertical
from textual.geometry import Offset
from textual.message import Message
from textual.reactive import reactive
from textual.screen import ModalScreen
from textual.widget import Widget
from textual.widgets import OptionList, Static
from textual.widgets.option_list import Option

from lambda_gui.lifecycle import is_here


@dataclass(frozen=True)
class Entry:
    """One entry of a choice.

    It has a value, a text in the list, a meaning, and a text when chosen.
    """

    value: str
    label: str
    help: str = ""
    shown: str = ""


def unset(known: str, otherwise: str = "default") -> Entry:
    """Return the entry for nothing written.

    In grey it reads as the value that then applies, as in a field.
    """
    label = f"default ({known})" if known else otherwise
    return Entry("", label, "as when nothing is written", known or otherwise)


class PickList(ModalScreen[str | None]):
    """Open list of a choice.

    It answers with the value, None when left with Esc.
    """

    BINDINGS: ClassVar[list[BindingType]] = [
        Binding("escape", "dismiss(None)", "Back"),
        Binding("f1", "app.help", "Help", priority=True),
    ]
    DEFAULT_CSS = """
    PickList { background: $background 30%; }
    PickList > Vertical { max-width: 96%; height: auto; max-height: 100%; background: $panel; border: round $border;
        padding: 0; }
    PickList OptionList { width: 1fr; height: auto; max-height: 14; background: $panel; border: none; padding: 0 1; }
    PickList OptionList:focus { border: none; }
    PickList Static { width: 1fr; color: $text-muted; padding: 0 1;
        border-top: hkey $border-blurred; }
    """

    def __init__(self, entries: Sequence[Entry], value: str, at: Offset) -> None:
        super().__init__()
        self._entries, self._value, self._at = list(entries), value, at

    def compose(self) -> ComposeResult:
        """Lay out the list and a line of help."""
        with Vertical():
            yield OptionList(*(Option(entry.label) for entry in self._entries), markup=False)
            yield Static(markup=False)

    def on_mount(self) -> None:
        """Start at the present value, near the field."""
        widest = max(len(entry.label) for entry in self._entries) + 6
        has_help = any(entry.help for entry in self._entries)
        width = min(max(widest, 64 if has_help else 24), self.size.width - 4)
        self.query_one(Vertical).styles.width = width
        # as high as the longest help: the list must not move under the cursor
        told = self.query_one(Static)
        told.display = has_help
        told.styles.height = 1 + max(len(Text(e.help).wrap(self.app.console, width - 4)) for e in self._entries)
        options = self.query_one(OptionList)
        options.highlighted = next((i for i, e in enumerate(self._entries) if e.value == self._value), 0)
        self.call_after_refresh(self._place)

    def _place(self) -> None:
        if not is_here(self):
            return
        box = self.query_one(Vertical)
        width, height = box.outer_size
        x = max(0, min(self._at.x - 2, self.size.width - width))
        y = self._at.y + 1 if self._at.y + 1 + height <= self.size.height else max(0, self._at.y - height)
        box.styles.offset = (x, y)

    def on_option_list_option_highlighted(self, event: OptionList.OptionHighlighted) -> None:
        """Say what the entry is."""
        self.query_one(Static).update(self._entries[event.option_index].help)

    def on_option_list_option_selected(self, event: OptionList.OptionSelected) -> None:
        """Take the entry."""
        self.dismiss(self._entries[event.option_index].value)

    def on_click(self, event: events.Click) -> None:
        """Leave when clicked outside the list."""
        if event.widget is self:
            self.dismiss(None)


class Choice(Widget, can_focus=True):
    """Choice of one of several values.

    Enter or a click opens the list.

    Parameters
    ----------
    entries : sequence of Entry, or a function that returns it when the list is first needed
    value : str
        Value of the present entry; one that is in no entry is shown as it is.
    """

    BINDINGS: ClassVar[list[BindingType]] = [
        Binding("enter,space", "open", "Choose", show=False),
    ]
    DEFAULT_CSS = """
    Choice { height: 1; width: 1fr; background: $surface; color: $foreground; }
    Choice:focus { background: $block-cursor-background; color: $block-cursor-foreground; }
    Choice:hover { background: $panel; }
    """

    value: reactive[str] = reactive("")

    @dataclass
    class Changed(Message):
        """The person chose another entry."""

        choice: Choice
        value: str

        @property
        def control(self) -> Choice:
            """The choice."""
            return self.choice

    def __init__(
        self, entries: Sequence[Entry] | Callable[[], Sequence[Entry]], value: str, *, id: str | None = None
    ) -> None:
        super().__init__(id=id)
        self._source = entries
        self._known: list[Entry] | None = None if callable(entries) else list(entries)
        self.set_reactive(Choice.value, value)

    @property
    def entries(self) -> list[Entry]:
        """The entries, found when first needed."""
        if self._known is None:
            assert callable(self._source)
            self._known = list(self._source())
        return self._known

    def forget(self) -> None:
        """Find the entries anew when they are next needed."""
        if callable(self._source):
            self._known = None

    def show_value(self, value: str) -> None:
        """Show a value among the entries of now."""
        self.forget()
        self.value = value
        self.refresh()

    def render(self) -> Text:
        """Draw the present entry and an arrow."""
        known = {entry.value: entry.shown or entry.label for entry in self.entries}
        label = known.get(self.value, self.value)
        style = "dim" if self.value == "" else ""
        room = max(1, self.size.width - 2)
        text = Text(label, style=style, no_wrap=True, overflow="ellipsis")
        text.truncate(room, overflow="ellipsis", pad=True)
        return text.append(" ▾", style="dim")

    def action_open(self) -> None:
        """Open the list."""
        self.app.push_screen(PickList(self.entries, self.value, self.region.offset), self._chosen)

    def on_click(self) -> None:
        """Open the list."""
        self.focus()
        self.action_open()

    def _chosen(self, value: str | None) -> None:
        if value is not None and value != self.value:
            self.value = value
            self.post_message(self.Changed(self, value))
