"""Define rows for values that change over time."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

from pydantic import BaseModel
from textual import events
from textual.app import ComposeResult
from textual.containers import Horizontal, Vertical
from textual.widget import Widget
from textual.widgets import Button, Input, Static

from lambda_core.api import SIGNAL_KINDS, FieldCard, field_card
from lambda_core.domain.option_tree import members
from lambda_gui.branch import Branch
from lambda_gui.choice import Choice
from lambda_gui.choice import Entry as ChoiceEntry
from lambda_gui.entry import Entry, text_of, value_of
from lambda_gui.fields import PointsRow, row_for
from lambda_gui.laws import LawRow
from lambda_gui.places import Option, Part
from lambda_gui.rows import Left, Surroundings

_BEGINS_A_NUMBER = "0123456789.+-"
_SIGNALS = {
    "value": "the same at all times",
    "constant": "the same at all times, written as a table",
    "ramp": "linear from one value to another, constant before and after",
    "harmonic": "amplitude * sin(2 pi frequency t + phase), about zero; with a constant part: a sum",
    "table": "points in time joined by a smooth curve, or a CSV file",
    "law": "a course over time by a law, times an amplitude: chirp, or what a plugin brings",
    "sum": "several of these added, for example a value and a harmonic",
}


class SignalRow(Branch):
    """Load, speed or motion over time.

    It is a value or one of the time functions.
    """

    DEFAULT_CSS = """
    SignalRow > .line > Choice { width: 10; margin-right: 1; }
    SignalRow > .line > Entry { width: 1fr; }
    """

    def __init__(
        self, place: Option | Part, card: FieldCard, around: Surroundings, tables: Sequence[type[BaseModel]], **how: Any
    ) -> None:
        super().__init__(place, card, around, **how)
        self._option = place
        self._tables = {_kind_of(table): table for table in tables}
        self._plain = card.model_copy(update={"kind": "quantity"})

    def compose(self) -> ComposeResult:
        """Lay out kind, value and what follows."""
        with Horizontal(classes="line"):
            yield Static(self.words, classes="label", markup=False)
            yield Choice(self._kinds, self._kind())
            yield Entry(self._plain)
        with Vertical(classes="twigs"):
            yield from self.twigs()

    def _kinds(self) -> list[ChoiceEntry]:
        """Return the kinds of functions.

        A constant, which is a value written at length, only where a file has it.
        """
        now = self._kind()
        kinds = [kind for kind in SIGNAL_KINDS if kind in self._tables and (kind != "constant" or now == "constant")]
        return [ChoiceEntry(kind, kind, _SIGNALS[kind]) for kind in ("value", *kinds)]

    def _kind(self) -> str:
        value = self.place.get()
        return str(value.get("kind", "value")) if isinstance(value, dict) else "value"

    def shape(self) -> object:
        """Return the kind and terms.

        A sum gives how many terms of which kinds it has.
        """
        value = self.place.get()
        terms = value.get("terms") if isinstance(value, dict) else None
        return self._kind(), [isinstance(term, dict) for term in terms] if isinstance(terms, list) else None

    def show(self) -> None:
        """Show kind and value."""
        kind = self._kind()
        self.query_one(Choice).value = kind
        entry = self.query_one(Entry)
        entry.display = kind == "value"
        if kind == "value":
            value = self.place.get()
            if value_of(entry.value, self._plain) != value:
                entry.show_value(text_of(value))
            entry.placeholder = "required" if self.card.required else self.card.default or "none"
        super().show()

    def entry(self) -> Widget | None:
        """Return the value's widget where it exists.

        It is changed more often than the kind before it.
        """
        return self.query_one(Entry) if self._kind() == "value" else super().entry()

    def twigs(self) -> Iterator[Widget]:
        """Yield the options of the kind.

        For a sum, yield its terms.
        """
        table = self._tables.get(self._kind())
        if table is None:
            return
        if _kind_of(table) == "sum":
            yield from self._terms(table)
            return
        for name in table.model_fields:
            if name in ("kind", "parameters"):
                continue
            card = field_card(table, name)
            if name == "law":
                law, parameters = self._option.part("law"), self._option.part("parameters")
                yield LawRow("time_function", law, parameters, card, self.around, deep=True)
            elif name == "points":
                yield PointsRow(self._option.part(name), card, self.around, deep=True)
            else:
                yield row_for(self._option.part(name), card, self.around, deep=True)

    def _terms(self, table: type[BaseModel]) -> Iterator[Widget]:
        inner = list(members(table.model_fields["terms"].annotation))
        terms = (self.place.get() or {}).get("terms") or []
        terms_place = self._option.part("terms")
        for number, _ in enumerate(terms):
            card = self.card.model_copy(update={"description": "one term of the sum", "required": True})
            yield SignalRow(Part(terms_place, number), card, self.around, inner, deep=True, label=f"term {number + 1}")
        yield Horizontal(
            Button("add a term", id="add-term", compact=True),
            Button("remove the last", id="drop-term", compact=True, disabled=len(terms) < 2),
            classes="buttons",
        )

    def on_key(self, event: events.Key) -> None:
        """Start the value with a typed number.

        It was typed on the kind.
        """
        if event.character and event.character in _BEGINS_A_NUMBER and self.query_one(Choice).has_focus:
            entry = next((entry for entry in self.query(Entry) if entry.display), None)
            if entry is not None:
                event.stop()
                entry.begin(event.character)

    def on_choice_changed(self, event: Choice.Changed) -> None:
        """Write the new kind.

        It takes the values that the old one has for it.
        """
        event.stop()
        self.write(_as_kind(event.value, self.place.get()))
        self.post_message(Left())
        self.reload()

    def on_input_changed(self, event: Input.Changed) -> None:
        """Write the value."""
        event.stop()
        self.query_one(Entry).heard = event.value
        value = value_of(event.value, self._plain)
        if self._kind() == "value" and value != self.place.get():
            self.write(value)

    def on_input_submitted(self, event: Input.Submitted) -> None:
        """Go on to the next entry."""
        event.stop()
        self.query_one(Entry).accept()
        self.post_message(self.Done(self))

    def on_button_pressed(self, event: Button.Pressed) -> None:
        """Add or remove a term."""
        event.stop()
        value = self.place.get()
        terms = list(value["terms"])
        terms = [*terms, "0 " + self.card.units[0]] if event.button.id == "add-term" else terms[:-1]
        self.write({**value, "terms": terms})
        self.reload()

    def on_descendant_blur(self) -> None:
        """End a series of changes."""
        self.post_message(Left())


def _kind_of(table: type[BaseModel]) -> str:
    return str(table.model_fields["kind"].annotation.__args__[0])  # type: ignore[union-attr]


def _as_kind(kind: str, value: Any) -> Any:
    """Return a function of another kind.

    It begins with the values of the old one.
    """
    plain = value
    if isinstance(value, dict):
        terms = value.get("terms") or [None]
        plain = value.get("value") or value.get("end") or value.get("amplitude") or terms[0]
        if isinstance(plain, dict):
            plain = None
    if kind == "value":
        return plain
    known: dict[str, dict[str, Any]] = {
        "constant": {"value": plain},
        "ramp": {"start": plain, "end": plain},
        "harmonic": {"amplitude": plain},
        "table": {"points": [["0 s", plain]] if plain else None},
        "law": {"law": "chirp", "amplitude": plain},
        "sum": {"terms": [value] if value is not None else [""]},
    }
    return {"kind": kind, **{name: text for name, text in known[kind].items() if text is not None}}
