"""Define the row of the profile of rollers."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from textual.widget import Widget
from textual.widgets import Static

from lambda_core.api import PROFILE_OPTIONS, Case, field_card
from lambda_gui.branch import Branch
from lambda_gui.choice import Choice, unset
from lambda_gui.choice import Entry as ChoiceEntry
from lambda_gui.entry import text_of
from lambda_gui.fields import row_for
from lambda_gui.nodes import PROFILE, PROFILE_PARAMETERS, Keys, table_model
from lambda_gui.places import Option
from lambda_gui.rows import Left, Row

if TYPE_CHECKING:
    from lambda_core.api import Draft, PartCard
    from lambda_gui.rows import Surroundings

_TABLE = ("bearing", "rollers")
_ABOUT = {
    "iso": "ISO 16281, B.5 and B.6",
    "logarithmic": "Teutsch 2005: scale times diameter, over a length",
    "crowned": "one radius over the whole length",
    "two-radii": "a middle, straight or with a radius, and ends with another",
    "tabulated": "points of distance from the middle and drop",
    "none": "straight to the ends",
}


class ProfileRow(Branch):
    """Profile of the rollers with its options.

    Those of plugins stand in the list, too.
    """

    DEFAULT_CSS = """
    ProfileRow .about { width: 1fr; height: auto; color: $text-muted; margin: 1 0; }
    """

    def __init__(self, draft: Draft, table: Keys, around: Surroundings) -> None:
        self._rollers, self._class = Option(draft, table), table_model(Case, _TABLE)
        super().__init__(self._rollers.part("profile"), field_card(self._class, "profile"), around)

    def control(self) -> Widget:
        """Return the choice of profiles."""
        return Choice(self._entries, text_of(self.place.get()))

    def _entries(self) -> list[ChoiceEntry]:
        own = [ChoiceEntry(name, name, _ABOUT[name]) for name in PROFILE_OPTIONS]
        others = [
            ChoiceEntry(card.name, f"{card.name}  ({card.distribution})", f"{card.title}\n{card.reference}")
            for card in _of_plugins()
        ]
        return [unset("the catalogue's, else iso"), *own, *others]

    def shape(self) -> object:
        """Return the profile."""
        return self.place.get()

    def show(self) -> None:
        """Show the choice."""
        self.query_one(Choice).show_value(text_of(self.place.get()))
        super().show()

    def twigs(self) -> Iterator[Widget]:
        """Yield the options that the profile takes.

        Options that are written and belong to no profile that is known have rows to empty them.
        """
        name = self.place.get()
        card = next((card for card in _of_plugins() if card.name == name), None)
        if card is not None:
            yield Static(f"{card.title}\n{card.reference}\nfrom {card.distribution}", classes="about", markup=False)
            for parameter in card.parameters:
                yield row_for(
                    self._rollers.part(PROFILE_PARAMETERS).part(parameter.name), parameter, self.around, deep=True
                )
        takes = PROFILE_OPTIONS.get(str(name), ())
        for option in PROFILE:
            is_stray = option not in takes and self._rollers.part(option).get() is not None
            if option in takes or (is_stray and not (option == PROFILE_PARAMETERS and card is not None)):
                yield self._row(option)

    def _row(self, option: str) -> Row:
        return row_for(self._rollers.part(option), field_card(self._class, option), self.around, deep=True)

    def on_choice_changed(self, event: Choice.Changed) -> None:
        """Write the profile.

        Options that only the old one had are removed with it.
        """
        if event.choice is not self.query_one(Choice):
            return
        event.stop()
        self.write(event.value or None)
        takes = PROFILE_OPTIONS.get(event.value, ())
        for option in PROFILE:
            if option not in takes and self._rollers.part(option).get() is not None:
                self._rollers.part(option).put(None)
        self.post_message(Left())
        self.reload()


def _of_plugins() -> list[PartCard]:
    from lambda_core import api

    return api.plugin_parts("profile")
