"""Make rows for degrees of freedom and materials."""

from __future__ import annotations

from collections.abc import Iterator
from typing import get_args

from pydantic import BaseModel
from textual.widget import Widget

from lambda_core.api import FieldCard, InlineMaterial, field_card
from lambda_core.domain.option_tree import members
from lambda_gui.branch import Branch
from lambda_gui.choice import Choice, unset
from lambda_gui.choice import Entry as ChoiceEntry
from lambda_gui.entry import text_of
from lambda_gui.fields import row_for
from lambda_gui.places import Option
from lambda_gui.rows import Left, Surroundings
from lambda_gui.signals import SignalRow

_EMPTY = {"youngs_modulus": ""}  # begins a table of one's own where nothing is known

_SENSE = {
    "x": "axial",
    "y": "horizontal",
    "z": "vertical",
    "tilt_x": "about x",
    "tilt_y": "about y",
    "tilt_z": "about z",
    "spin": "about x",
}


class FreedomRow(Branch):
    """One degree of freedom of a body.

    It shows its motion and its support.
    """

    _MODES = (
        ("free", "free", "moves by the forces on it"),
        ("support", "free on a support", "moves by the forces on it and an elastic, damped support to ground"),
        ("locked", "locked", "does not move"),
        ("prescribed", "prescribed", "moves as written, whatever the forces"),
    )

    def __init__(self, place: Option, card: FieldCard, around: Surroundings, table: type[BaseModel]) -> None:
        modes = [label for _, label, _ in self._modes(table)]
        told = card.model_copy(update={"choices": modes, "description": f"how it moves: {card.description}"})
        super().__init__(place, told, around, label=f"{card.name.replace('_', ' ')}  {_SENSE[card.name]}")
        self._option, self._table = place, table
        self._supported = False

    def _modes(self, table: type[BaseModel]) -> list[tuple[str, str, str]]:
        """Return the possible modes.

        A rotation about the body's own axis can only be resisted.
        """
        known = get_args(table.model_fields["mode"].annotation)
        modes = [mode for mode in self._MODES if mode[0] in (*known, "support")]
        if "stiffness" in table.model_fields:
            return modes
        resisted = ("support", "free with resistance", "moves by the forces on it and a moment against its speed")
        return [resisted if mode[0] == "support" else mode for mode in modes]

    def control(self) -> Widget:
        """Return the choice of modes."""
        modes = [ChoiceEntry(value, label, text) for value, label, text in self._modes(self._table)]
        return Choice(modes, self._mode())

    def _mode(self) -> str:
        written = {name: self._option.part(name).get() for name in ("mode", "motion", "stiffness", "damping")}
        implied = "prescribed" if written["motion"] is not None else "free"
        mode = str(written["mode"] or (self.card.default if self.place.get() is None else implied))
        held = written["stiffness"] is not None or written["damping"] is not None
        return "support" if mode == "free" and (held or self._supported) else mode

    def shape(self) -> object:
        """Return the mode."""
        return self._mode()

    def show(self) -> None:
        """Show the mode."""
        self.query_one(Choice).value = self._mode()
        super().show()

    def twigs(self) -> Iterator[Widget]:
        """Yield the support's options, or the motion."""
        mode = self._mode()
        if mode == "prescribed" and "motion" in self._table.model_fields:
            tables = list(members(self._table.model_fields["motion"].annotation))
            card = field_card(self._table, "motion").model_copy(update={"required": True})
            yield SignalRow(self._option.part("motion"), card, self.around, tables, deep=True)
        if mode == "support":
            for name in ("stiffness", "damping"):
                if name in self._table.model_fields:
                    yield row_for(self._option.part(name), field_card(self._table, name), self.around, deep=True)

    def on_choice_changed(self, event: Choice.Changed) -> None:
        """Write the mode.

        Values of another mode are removed with it.
        """
        if event.choice is not self.query_one(Choice):
            return
        event.stop()
        self._supported = event.value == "support"
        mode = "free" if self._supported else event.value
        self.write(None if mode == self.card.default and not self._supported else mode)
        self.post_message(Left())
        self.reload()


class MaterialRow(Branch):
    """A material by name, or its properties written here."""

    _OWN = "own values"

    def __init__(self, place: Option, card: FieldCard, around: Surroundings) -> None:
        super().__init__(place, card, around)
        self._option = place

    def control(self) -> Widget:
        """Return the choice of materials."""
        return Choice(self._entries, self._chosen())

    def _entries(self) -> list[ChoiceEntry]:
        known = self.card.default or self.around.resolved(self.place.keys)
        names = [ChoiceEntry(name, name) for name in self.around.names("material")]
        own = ChoiceEntry(self._OWN, self._OWN, "write the properties here")
        return [unset(known, "that of the cage"), *names, own]

    def _chosen(self) -> str:
        value = self.place.get()
        return self._OWN if isinstance(value, dict) else text_of(value)

    def shape(self) -> object:
        """Return whether the properties are written here."""
        return self._chosen() == self._OWN

    def show(self) -> None:
        """Show the name."""
        self.query_one(Choice).show_value(self._chosen())
        super().show()

    def twigs(self) -> Iterator[Widget]:
        """Yield the properties."""
        if self._chosen() == self._OWN:
            for name in InlineMaterial.model_fields:
                yield row_for(self._option.part(name), field_card(InlineMaterial, name), self.around, deep=True)

    def on_choice_changed(self, event: Choice.Changed) -> None:
        """Write the name or a new table.

        The table begins with the values of the material so far.
        """
        event.stop()
        if event.value == self._OWN:
            known = {name: self.around.value((*self.place.keys, name)) for name in InlineMaterial.model_fields}
            texts = {name: value.text for name, value in known.items() if value is not None}
            self.write({n: float(text) if n == "poisson_ratio" else text for n, text in texts.items()} or _EMPTY)
        else:
            self.write(event.value or None)
        self.post_message(Left())
        self.reload()
