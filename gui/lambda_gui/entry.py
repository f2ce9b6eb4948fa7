"""Define text entries with completion."""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from typing import Any

from textual import events
from textual.suggester import Suggester
from textual.widgets import Input

from lambda_core.api import FieldCard

_MOST_NAMES = 5  # in one sentence
_LONGEST_WAY = 1.0  # [s] of the keyboard to the next entry; then there is none
_BARE = re.compile(r"^\s*([+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)(\s*)([A-Za-z]*)$")


def completed(text: str, units: Sequence[str]) -> str:
    """Return a number with its unit completed.

    It was bare, or had the beginning of a unit.
    """
    match = _BARE.match(text)
    if not match or not units:
        return text
    number, gap, begun = match.groups()
    if not begun:
        return f"{number} {units[0]}"
    if begun in units:
        return text
    complete = next((unit for unit in units if unit.startswith(begun)), None)
    return f"{number}{gap}{complete}" if complete else text


def meant(text: str, names: Sequence[str]) -> list[str]:
    """Return the name that begins with a text.

    If none begins so, return all names that hold it; only letters and digits count.
    """
    folded = text.strip().casefold()
    first = next((name for name in names if name.casefold().startswith(folded)), None)
    if first is not None:
        return [first]
    plain = _plain(folded)
    return [name for name in names if plain and plain in _plain(name.casefold())]


def _plain(text: str) -> str:
    return "".join(filter(str.isalnum, text))


def value_of(text: str, card: FieldCard) -> Any:
    """Return the case's value of a typed text.

    The result is None for an empty text.
    """
    stripped = text.strip()
    if not stripped:
        return None
    if card.units:
        return completed(stripped, card.units)
    if card.kind == "integer" and re.fullmatch(r"[+-]?\d+", stripped):
        return int(stripped)
    if card.kind in ("number", "integer"):
        try:
            return float(stripped)
        except ValueError:
            return stripped
    return stripped


def text_of(value: Any) -> str:
    """Return the entry's text of a case's value."""
    if value is None:
        return ""
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, float):
        return f"{value:.15g}"
    return str(value)


class Completion(Suggester):
    """Completion of a unit or a name.

    The name begins with the typed text.
    """

    def __init__(self, units: Sequence[str], names: Callable[[], Sequence[str]] | None) -> None:
        super().__init__(use_cache=False, case_sensitive=True)
        self._units, self._names = units, names

    async def get_suggestion(self, value: str) -> str | None:
        """Return the whole text that `value` could become."""
        if self._names is not None and value:
            folded = value.casefold()
            return next(
                (value + name[len(value) :] for name in self._names() if name.casefold().startswith(folded)), None
            )
        complete = completed(value, self._units)
        return complete if complete != value else None


class Entry(Input):
    """One line of text.

    A number takes its unit when the entry is left or Enter is pressed.

    What stands there is selected when the keyboard comes: what is typed takes its place. What is typed after Enter
    belongs to the entry that the keyboard moves to, however long that takes.
    """

    def __init__(self, card: FieldCard, names: Callable[[], Sequence[str]] | None = None) -> None:
        super().__init__(compact=True, suggester=Completion(card.units, names))
        self._card = card
        self._names = names
        self._held: list[events.Key] | None = None  # keys since Enter, until the keyboard has moved on
        self.heard = ""  # the last text that its row has taken

    def show_value(self, text: str) -> None:
        """Show a text of the row.

        Not while what was typed is on its way to the row: older text would take its place, and move the cursor.
        """
        if self.has_focus and self.value != self.heard:
            return
        with self.prevent(Input.Changed):
            self.value = text
        self.heard = text

    def take(self, card: FieldCard) -> None:
        """Take the units of another card."""
        self._card = card
        self.suggester = Completion(card.units, self._names)

    def begin(self, letter: str) -> None:
        """Take the keyboard with a new value's letter.

        It is the first letter.
        """
        self.select_on_focus = False  # until the entry is left: what follows belongs to that letter
        self.focus()
        self.value = letter
        self.cursor_position = len(letter)

    def visit(self) -> None:
        """Take the keyboard behind the text.

        Typed characters are added to it.
        """
        self.select_on_focus = False
        self.focus()
        self.cursor_position = len(self.value)

    def complete(self) -> None:
        """Complete the unit or the name.

        The name may differ in capitals.
        """
        if self._card.units:
            self.value = completed(self.value, self._card.units)
        elif self._names is not None:
            folded = self.value.strip().casefold()
            self.value = next((name for name in self._names() if name.casefold() == folded), self.value)

    def accept(self) -> None:
        """Accept the proposal in grey.

        Without it, accept the only name that holds the typed text; list them if there are more.
        """
        self.complete()
        if self._names is None or not self.value or self.value in self._names():
            return
        found = meant(self.value, self._names())
        if len(found) == 1:
            self.value = found[0]
        elif found:
            more = f" and {len(found) - _MOST_NAMES} more" if len(found) > _MOST_NAMES else ""
            self.notify(f"{self.value}: {', '.join(found[:_MOST_NAMES])}{more}", timeout=8)

    async def _on_key(self, event: events.Key) -> None:
        """Type a key or keep it.

        The keyboard may be moving to another entry.
        """
        if self._held is not None:
            self._held.append(event)
        elif event.key == "enter":
            self._held = []
            self.set_timer(_LONGEST_WAY, self._hand_over)
            await self.action_submit()
        else:
            return  # to the handler of Input, which comes next
        event.stop()
        event.prevent_default()

    def _hand_over(self) -> None:
        """Pass the kept keys on.

        They go to the widget that has the keyboard now.
        """
        held, self._held = self._held, None
        focused = self.screen.focused if self.is_attached else None
        for key in held or ():
            if focused is not None:
                focused._forward_event(events.Key(key.key, key.character))

    def on_blur(self) -> None:
        """Complete what was typed."""
        self.complete()
        self.select_on_focus = True
        self._hand_over()
