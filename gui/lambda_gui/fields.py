"""Define form rows for plain options."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable
from typing import Any

from textual.app import ComposeResult
from textual.containers import Horizontal
from textual.widget import Widget
from textual.widgets import Checkbox, Input, Static, TextArea

from lambda_core.api import FieldCard
from lambda_gui.choice import Choice, unset
from lambda_gui.choice import Entry as ChoiceEntry
from lambda_gui.entry import Entry, text_of, value_of
from lambda_gui.places import Place
from lambda_gui.rows import Left, Row, Stepped, Surroundings

_NARROW = 20  # columns of the narrowest entry: the help next to the form gives the default in full


class TextRow(Row):
    """Row of a number or text.

    A quantity, a name or a line of text.
    """

    def __init__(
        self,
        place: Place,
        card: FieldCard,
        around: Surroundings,
        *,
        kind: str = "",
        **how: Any,
    ) -> None:
        super().__init__(place, card, around, **how)
        self._kind = kind

    def take(self, card: FieldCard) -> None:
        """Change the row to another option.

        Its units complete the typed text.
        """
        self.card = card
        self.query_one(Entry).take(card)

    def control(self) -> Widget:
        """Return an entry with completion."""
        names = (lambda: self.around.names(self._kind)) if self._kind else None
        return Entry(self.card, names)

    def show(self) -> None:
        """Show what is written, and in grey what holds otherwise."""
        entry = self.query_one(Entry)
        value = self.place.get()
        if value_of(entry.value, self.card) != value:
            entry.show_value(text_of(value))
        entry.placeholder = self.placeholder()
        self.mark()

    def placeholder(self) -> str:
        """Return what holds when nothing is written."""
        if self.card.required:
            return "required"
        known = self.around.resolved(self.place.keys) or self.card.default
        _, _, absent = self.card.description.partition("absent: ")
        return known or (absent if len(absent) <= _NARROW else "see the help")

    def on_input_changed(self, event: Input.Changed) -> None:
        """Write what was typed."""
        event.stop()
        self.query_one(Entry).heard = event.value
        value = value_of(event.value, self.card)
        if value != self.place.get():
            self.write(value)

    def on_input_submitted(self, event: Input.Submitted) -> None:
        """Go on to the next entry."""
        event.stop()
        self.query_one(Entry).accept()
        self.post_message(self.Done(self))

    def on_descendant_blur(self) -> None:
        """End a series of changes."""
        self.post_message(Left())


class ChoiceRow(Row):
    """Row of one of several values.

    The first entry stands for the value that applies when nothing is written.
    """

    def __init__(
        self,
        place: Place,
        card: FieldCard,
        around: Surroundings,
        entries: Callable[[], Iterable[ChoiceEntry]] | None = None,
        **how: Any,
    ) -> None:
        super().__init__(place, card, around, **how)
        self._entries = entries or (lambda: [ChoiceEntry(choice, choice) for choice in card.choices])

    def control(self) -> Widget:
        """Return the choice."""
        return Choice(self._all, text_of(self.place.get()))

    def _all(self) -> list[ChoiceEntry]:
        if self.card.required:
            return list(self._entries())
        return [unset(self.around.resolved(self.place.keys) or self.card.default), *self._entries()]

    def show(self) -> None:
        """Show what is written."""
        self.query_one(Choice).show_value(text_of(self.place.get()))
        self.mark()

    def on_choice_changed(self, event: Choice.Changed) -> None:
        """Write the choice."""
        event.stop()
        self.write(event.value or None)
        self.post_message(Left())


class FlagRow(Row):
    """Yes or no."""

    DEFAULT_CSS = """
    FlagRow Checkbox { width: auto; min-width: 7; }
    """

    def control(self) -> Widget:
        """Return a tick box."""
        return Checkbox("", compact=True)

    def show(self) -> None:
        """Show what is written, else the default."""
        value = self.place.get()
        with self.prevent(Checkbox.Changed):
            self.query_one(Checkbox).value = bool(self.card.default == "true" if value is None else value)
        self.mark()

    def on_checkbox_changed(self, event: Checkbox.Changed) -> None:
        """Write the flag."""
        event.stop()
        self.write(event.value)
        self.post_message(Left())


class _Lines(TextArea):
    """Lines of text between other entries.

    The arrow keys also lead out of them.
    """

    def action_cursor_down(self, select: bool = False) -> None:
        """Go down a line or an entry.

        The last line passes to the next entry.
        """
        if not select and self.navigator.is_last_wrapped_line(self.cursor_location):
            self.post_message(Stepped(1))
        else:
            super().action_cursor_down(select)

    def action_cursor_up(self, select: bool = False) -> None:
        """Go up a line or an entry.

        The first line passes to the entry before.
        """
        if not select and self.navigator.is_first_wrapped_line(self.cursor_location):
            self.post_message(Stepped(-1))
        else:
            super().action_cursor_up(select)


class LinesRow(Row):
    """Several texts, one per line."""

    DEFAULT_CSS = """
    LinesRow > .line > .label { width: 1fr; }
    LinesRow TextArea { height: 5; width: 1fr; border: none; padding: 0 0 0 2; }
    """

    def __init__(self, place: Place, card: FieldCard, around: Surroundings, **how: Any) -> None:
        super().__init__(place, card, around, **how)
        self.words = f"{self.label}, one per line"

    def control(self) -> Widget:
        """Return a text area."""
        return _Lines(compact=True, show_line_numbers=False)

    def compose(self) -> ComposeResult:
        """Lay out the lines under their label.

        They take the full width.
        """
        with Horizontal(classes="line"):
            yield Static(self.words, classes="label", markup=False)
        yield self.control()

    def show(self) -> None:
        """Show the lines that are written."""
        area = self.query_one(TextArea)
        if self.parse(area.text) != (self.place.get() or None):
            with self.prevent(TextArea.Changed):
                area.text = self.lines(self.place.get())
        self.mark()

    def fit(self, width: int, *, short: bool = False) -> None:
        """Keep the label over the whole width."""

    def lines(self, value: Any) -> str:
        """Return the lines of a value."""
        return "\n".join(str(line) for line in value or ())

    def parse(self, text: str) -> Any:
        """Return the value of the lines, None without any."""
        return [line.strip() for line in text.splitlines() if line.strip()] or None

    def on_text_area_changed(self, event: TextArea.Changed) -> None:
        """Write the lines."""
        event.stop()
        value = self.parse(event.text_area.text)
        if value != (self.place.get() or None):
            self.write(value)

    def on_descendant_blur(self) -> None:
        """End a series of changes."""
        self.post_message(Left())


class ParagraphRow(LinesRow):
    """Long text in one paragraph.

    It is wrapped, and written as one line.
    """

    DEFAULT_CSS = """
    ParagraphRow TextArea { height: auto; min-height: 1; max-height: 5; }
    """

    def __init__(self, place: Place, card: FieldCard, around: Surroundings, **how: Any) -> None:
        super().__init__(place, card, around, **how)
        self.words = self.label

    def lines(self, value: Any) -> str:
        """Return the text."""
        return str(value or "")

    def parse(self, text: str) -> Any:
        """Return the text in one line, None without any."""
        return " ".join(text.split()) or None


class PointsRow(LinesRow):
    """Pairs of values, one per line.

    An example is the points of a table over time, "time, value".
    """

    def lines(self, value: Any) -> str:
        """Return one line per pair."""
        return "\n".join(", ".join(str(cell) for cell in point) for point in value or ())

    def parse(self, text: str) -> Any:
        """Return the pairs."""
        lines = [line for line in text.splitlines() if line.strip()]
        return [[cell.strip() for cell in re.split(r"[,;\t]", line)] for line in lines] or None


def row_for(place: Place, card: FieldCard, around: Surroundings, *, deep: bool = False, label: str = "") -> Row:
    """Return the row that suits a plain option."""
    if card.kind == "flag":
        return FlagRow(place, card, around, deep=deep, label=label)
    if card.kind == "choice":
        return ChoiceRow(place, card, around, deep=deep, label=label)
    if card.kind in ("texts", "pairs"):
        row = LinesRow if card.kind == "texts" else PointsRow
        return row(place, card, around, deep=deep, label=label)
    return TextRow(place, card, around, deep=deep, label=label)
