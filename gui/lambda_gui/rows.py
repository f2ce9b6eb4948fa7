"""Form rows: one option each, with label, entry, help, mistake and mark of change."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from rich.text import Text
from textual.app import ComposeResult
from textual.containers import Horizontal, Vertical
from textual.message import Message
from textual.widget import Widget
from textual.widgets import Checkbox, Input, Static, TextArea

from lambda_core.schema.cards import FieldCard
from lambda_gui.choice import Choice
from lambda_gui.choice import Entry as ChoiceEntry
from lambda_gui.entry import Entry, text_of, value_of
from lambda_gui.outline import Keys
from lambda_gui.places import Place

if TYPE_CHECKING:
    from lambda_core.physics.describe import ValueReport


@dataclass
class Edited(Message):
    """An option was changed by the person."""

    keys: Keys


@dataclass
class Left(Message):
    """An entry was left: the next change of the same place is undone on its own."""


class Surroundings:
    """What rows need of the case around them: resolved values, names of the catalogue, what has changed."""

    def resolved(self, keys: Keys) -> str:
        """Return the value an option has when it is not written, "" when that is not known."""
        return ""

    def value(self, keys: Keys) -> ValueReport | None:
        """Return the value an option has when it is not written, with its origin."""
        return None

    def origin(self, keys: Keys) -> str:
        """Return the value an option has when it is not written, with where it comes from."""
        return ""

    def names(self, kind: str) -> list[str]:
        """Return the names of one kind in the catalogue."""
        return []

    def is_changed(self, keys: Keys) -> bool:
        """Tell whether an option differs from the file."""
        return False


class Row(Vertical):
    """One option. Subclasses bring the widget that is typed in or chosen from."""

    DEFAULT_CSS = """
    Row { height: auto; width: 1fr; }
    Row > .line { height: 1; width: 1fr; }
    Row > .line > .label { width: 23; color: $text-muted; text-overflow: ellipsis; text-wrap: nowrap; }
    Row.-deep > .line > .label { padding-left: 2; }
    Row:focus-within > .line > .label { color: $text; }
    Row > .line > Entry, Row > .line > Choice { width: 1fr; max-width: 60; }
    Row > .line > .mark { width: 2; color: $accent; padding-left: 1; }
    Row > .mistake { display: none; width: 1fr; height: auto; color: $text-error; padding-left: 2; }
    Row.-wrong > .mistake { display: block; }
    Row.-wrong > .line > .label { color: $text-error; }
    """

    def __init__(
        self, place: Place, card: FieldCard, around: Surroundings, *, label: str = "", deep: bool = False
    ) -> None:
        super().__init__(classes="-deep" if deep else "")
        self.place, self.card, self.around = place, card, around
        self.label = label or card.name.replace("_", " ")
        self.stands = False  # whether the parts are there
        self._width = 23

    def control(self) -> Widget:
        """Return the widget that shows and takes the value."""
        raise NotImplementedError

    def compose(self) -> ComposeResult:
        """Lay out label, control, mark and, under them, the mistake."""
        with Horizontal(classes="line"):
            yield Static(self.label, classes="label", markup=False)
            yield self.control()
            yield Static(classes="mark")
        yield Static(classes="mistake", markup=False)

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
        """Bring control, placeholder and mark to what is written."""
        raise NotImplementedError

    def fit(self, width: int) -> None:
        """Give the label as much room as those of the whole form take."""
        self._width = width
        if self.stands:
            self.query_one(".label").styles.width = width

    def write(self, value: Any) -> None:
        """Write a value that the person gave."""
        self.place.put(value)
        self.mark()
        self.post_message(Edited(self.place.keys))

    def mark(self) -> None:
        """Show whether the option differs from the file."""
        self.query_one(".mark", Static).update("●" if self.around.is_changed(self.place.keys) else "")

    def say(self, mistakes: Sequence[str]) -> None:
        """Show what is wrong with the option, nothing when it is fine."""
        if not self.stands:
            return
        self.set_class(bool(mistakes), "-wrong")
        self.query_one(".mistake", Static).update("\n".join(f"▲ {text}" for text in mistakes))

    def entry(self) -> Widget | None:
        """Return what takes the keyboard when somebody comes to change the option."""
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
        text.append(f"\n{'.'.join(self.place.keys)}", style="not bold")
        return text


class TextRow(Row):
    """A number, a quantity, a name or a line of text."""

    def __init__(
        self,
        place: Place,
        card: FieldCard,
        around: Surroundings,
        *,
        kind: str = "",
        label: str = "",
        deep: bool = False,
    ) -> None:
        super().__init__(place, card, around, label=label, deep=deep)
        self._kind = kind

    def control(self) -> Widget:
        """Return an entry with completion."""
        names = (lambda: self.around.names(self._kind)) if self._kind else None
        return Entry(self.card, names)

    def show(self) -> None:
        """Show what is written, and in grey what holds otherwise."""
        entry = self.query_one(Entry)
        value = self.place.get()
        if value_of(entry.value, self.card) != value:
            with self.prevent(Input.Changed):
                entry.value = text_of(value)
        entry.placeholder = self.placeholder()
        self.mark()

    def placeholder(self) -> str:
        """Return what holds when nothing is written."""
        if self.card.required:
            return "required"
        known = self.around.resolved(self.place.keys) or self.card.default
        _, _, absent = self.card.description.partition("absent: ")
        return known or absent

    def on_input_changed(self, event: Input.Changed) -> None:
        """Write what was typed."""
        event.stop()
        value = value_of(event.value, self.card)
        if value != self.place.get():
            self.write(value)

    def on_input_submitted(self, event: Input.Submitted) -> None:
        """Go on to the next entry."""
        event.stop()
        self.query_one(Entry).complete()
        self.screen.focus_next()

    def on_descendant_blur(self) -> None:
        """End a series of changes."""
        self.post_message(Left())


class ChoiceRow(Row):
    """One of several values; the first entry stands for what holds when nothing is written."""

    def __init__(
        self,
        place: Place,
        card: FieldCard,
        around: Surroundings,
        entries: Callable[[], Iterable[ChoiceEntry]] | None = None,
        *,
        label: str = "",
        deep: bool = False,
    ) -> None:
        super().__init__(place, card, around, label=label, deep=deep)
        self._entries = entries or (lambda: [ChoiceEntry(choice, choice) for choice in card.choices])

    def control(self) -> Widget:
        """Return the choice."""
        return Choice(self._all, text_of(self.place.get()))

    def _all(self) -> list[ChoiceEntry]:
        if self.card.required:
            return list(self._entries())
        return [ChoiceEntry("", self.unset(), "as when nothing is written"), *self._entries()]

    def unset(self) -> str:
        """Return how "nothing is written" reads."""
        known = self.around.resolved(self.place.keys) or self.card.default
        return f"default ({known})" if known else "default"

    def show(self) -> None:
        """Show what is written."""
        choice = self.query_one(Choice)
        choice.forget()
        choice.value = text_of(self.place.get())
        choice.refresh()
        self.mark()

    def on_choice_changed(self, event: Choice.Changed) -> None:
        """Write the choice."""
        event.stop()
        self.write(event.value or None)
        self.post_message(Left())


class FlagRow(Row):
    """Yes or no."""

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


class LinesRow(Row):
    """Several texts, one per line."""

    DEFAULT_CSS = """
    LinesRow > .line > .label { width: 1fr; }
    LinesRow TextArea { height: 5; width: 1fr; border: none; padding: 0 0 0 2; }
    """

    def control(self) -> Widget:
        """Return a text area."""
        return TextArea(compact=True, show_line_numbers=False)

    def compose(self) -> ComposeResult:
        """Lay out the lines under their label, over the whole width."""
        with Horizontal(classes="line"):
            yield Static(f"{self.label}, one per line", classes="label", markup=False)
            yield Static(classes="mark")
        yield self.control()
        yield Static(classes="mistake", markup=False)

    def show(self) -> None:
        """Show the lines that are written."""
        area = self.query_one(TextArea)
        if self.parse(area.text) != (self.place.get() or None):
            with self.prevent(TextArea.Changed):
                area.text = self.lines(self.place.get())
        self.mark()

    def fit(self, width: int) -> None:
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


def row_for(place: Place, card: FieldCard, around: Surroundings, *, deep: bool = False, label: str = "") -> Row:
    """Return the row that suits a plain option."""
    if card.kind == "flag":
        return FlagRow(place, card, around, deep=deep, label=label)
    if card.kind == "choice":
        return ChoiceRow(place, card, around, deep=deep, label=label)
    if card.kind == "texts":
        return LinesRow(place, card, around, deep=deep, label=label)
    return TextRow(place, card, around, deep=deep, label=label)
