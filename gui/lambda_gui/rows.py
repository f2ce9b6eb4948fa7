"""Define form rows of one option each.

Label, entry, help, error and mark of change.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from rich.text import Text
from textual.app import ComposeResult
from textual.containers import Horizontal, Vertical, VerticalScroll
from textual.message import Message
from textual.widget import Widget
from textual.widgets import Static

from lambda_core.api import FieldCard
from lambda_gui.labels import label_of
from lambda_gui.nodes import Keys
from lambda_gui.places import Held, Place

if TYPE_CHECKING:
    from lambda_core.api import ValueReport


@dataclass
class Edited(Message):
    """An option was changed by the person."""

    keys: Keys


@dataclass
class Left(Message):
    """Message that an entry was left.

    The next change of the same place is undone on its own.
    """


@dataclass
class Stepped(Message):
    """Message to go to another entry.

    It is the next entry or the one before.
    """

    by: int


class Surroundings:
    """Case around the rows.

    Resolved values, names of the catalogue, changes.
    """

    def resolved(self, keys: Keys) -> str:
        """Return the value of a missing option.

        "" when that is not known.
        """
        return ""

    def value(self, keys: Keys) -> ValueReport | None:
        """Return a missing option's value and origin."""
        return None

    def origin(self, keys: Keys) -> str:
        """Return a missing option's value and origin."""
        return ""

    def names(self, kind: str) -> list[str]:
        """Return the names of one kind in the catalogue."""
        return []

    def is_changed(self, keys: Keys) -> bool:
        """Tell whether an option differs from the file."""
        return False


class Names(Surroundings):
    """Names for completion, by their kind.

    They belong to a form of its own.
    """

    def __init__(self, names: Mapping[str, Sequence[str]]) -> None:
        self._names = names

    def names(self, kind: str) -> list[str]:
        """Return the names of one kind."""
        return list(self._names.get(kind, ()))


def row_of(widget: Widget) -> Row | None:
    """Return the row of a widget.

    It is None outside of rows.
    """
    return next((around for around in widget.ancestors_with_self if isinstance(around, Row)), None)


class Rows(VerticalScroll, can_focus=False, inherit_bindings=False):
    """Rows of a form of its own.

    The arrow keys are left to the screen, which goes from row to row.
    """


class Row(Vertical):
    """Row of one option.

    Subclasses bring the widget for typing or choosing.
    """

    @dataclass
    class Done(Message):
        """Message that the row is done.

        The next row follows.
        """

        row: Row

    DEFAULT_CSS = """
    Row { height: auto; width: 1fr; }
    Row > .line { height: auto; width: 1fr; }
    Row > .line > .label { width: 23; height: auto; color: $text-muted; padding-right: 1; }
    Row.-deep > .line > .label { padding-left: 2; }
    Row:focus-within > .line > .label { color: $text; }
    Row > .line > Entry, Row > .line > Choice { width: 1fr; max-width: 60; }
    Row > .mistake { width: 1fr; height: auto; color: $text-error; padding-left: 2; }
    Row.-wrong > .line > .label { color: $text-error; }
    """

    def __init__(
        self,
        place: Place,
        card: FieldCard,
        around: Surroundings,
        *,
        label: str = "",
        short: str = "",
        deep: bool = False,
    ) -> None:
        super().__init__(classes="-deep" if deep else "")
        self.place, self.card, self.around = place, card, around
        self.label = label or label_of(place.keys, card.name)
        self.short = short or self.label  # where the form is narrow
        self.words = self.label  # what stands before the control
        self.stands = False  # whether the parts are there
        self._width = 23
        self._is_marked: bool | None = False  # None: to be written anew
        self._told: Static | None = None

    def control(self) -> Widget:
        """Return the widget that shows and takes the value."""
        raise NotImplementedError

    def compose(self) -> ComposeResult:
        """Lay out label and control.

        A mistake comes under them when there is one.
        """
        with Horizontal(classes="line"):
            yield Static(self.words, classes="label", markup=False)
            yield self.control()

    def on_mount(self) -> None:
        """Show what is written."""
        self.stands = True
        self.fit(self._width)
        self.show()

    def reload(self) -> None:
        """Show what is written now."""
        if self.stands:
            self.show()

    def show(self) -> None:
        """Bring control, placeholder and label to what is written."""
        raise NotImplementedError

    def fit(self, width: int, *, short: bool = False) -> None:
        """Fit the label to the form's labels.

        It has as much room as they take; its short form where requested.
        """
        self._width = width
        words = self.short if short else self.label
        if words != self.words:
            self.words, self._is_marked = words, None
        if self.stands:
            self.query_one(".label").styles.width = width
            self.mark()

    def write(self, value: Any) -> None:
        """Write a value that the person gave."""
        self.place.put(value)
        self.mark()
        self.post_message(Edited(self.place.keys))

    def mark(self) -> None:
        """Show whether the option differs from the file."""
        is_changed = self.around.is_changed(self.place.keys)
        if is_changed == self._is_marked:
            return
        self._is_marked = is_changed
        label = Text(self.words)
        if is_changed:
            label.append(" ●", style=self.app.theme_variables["accent"])
        self.query_one(".label", Static).update(label)

    def say(self, mistakes: Sequence[str]) -> None:
        """Show the mistake of the option.

        Nothing when it is fine.
        """
        if not self.stands:
            return
        self.set_class(bool(mistakes), "-wrong")
        if not mistakes:
            if self._told is not None:
                self._told.remove()
                self._told = None
            return
        words = "\n".join(f"▲ {text}" for text in mistakes)
        if self._told is None:
            self._told = Static(words, classes="mistake", markup=False)
            self.mount(self._told, after=self.query_one(".line"))
        elif str(self._told.content) != words:
            self._told.update(words)

    def entry(self) -> Widget | None:
        """Return the widget for the keyboard.

        It changes the option.
        """
        return next((widget for widget in self.query("*").results(Widget) if widget.focusable), None)

    def help(self) -> Text:
        """Return what the option is: meaning, default, units, limits, source."""
        card = self.card
        text = Text(self.label, style="bold")
        text.append(f"  {card.description}" if card.description else "", style="not bold")
        facts = [
            "required" if card.required else f"default {card.default}" if card.default else "",
            f"units {', '.join(card.units)}" if card.units else "",
            f"allowed {' and '.join(card.limits)}" if card.limits else "",
            f"one of {', '.join(card.choices)}" if card.choices else "",
        ]
        told = "   ".join(fact for fact in facts if fact)
        if told:
            text.append(f"\n{told}", style="not bold")
        origin = self.around.origin(self.place.keys)
        if origin:
            text.append(f"\nnow {origin}", style="not bold")
        if card.reference:
            text.append(f"\n{card.reference}", style="italic not bold")
        if not isinstance(self.place, Held):  # only options of a case have a path
            text.append(f"\n{'.'.join(self.place.keys)}", style="not bold")
        return text
