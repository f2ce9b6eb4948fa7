"""Define rows for laws and their parameters."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

from rich.text import Text
from textual.widget import Widget
from textual.widgets import Static

from lambda_core.api import Case, FieldCard, Models, field_card
from lambda_core.domain.errors import LambdaError
from lambda_core.domain.roles import DEFAULT_MODELS, ROLES
from lambda_gui.branch import Branch
from lambda_gui.choice import Choice, unset
from lambda_gui.choice import Entry as ChoiceEntry
from lambda_gui.entry import text_of
from lambda_gui.fields import ChoiceRow, row_for
from lambda_gui.nodes import Node, table_model
from lambda_gui.places import Option, Part
from lambda_gui.rows import Left, Surroundings

if TYPE_CHECKING:
    from lambda_core.api import Draft, ModelCard

_OWN = "lambda-bearing"


def law_choices(role: str) -> list[ChoiceEntry]:
    """Return the installed models of a role.

    Those of other packages carry their distribution.
    """
    from lambda_core import api

    found = [ChoiceEntry("auto", "auto", "the law that the oil has data for")] if role == "rheology" else []
    for item in api.plugins().items:
        if item.kind == "model" and item.role == role:
            foreign = "" if item.distribution.split(" ")[0] == _OWN else f"  ({item.distribution})"
            found.append(ChoiceEntry(item.name, f"{item.name}{foreign}", _gist(role, item.name)))
    return found


def _gist(role: str, name: str) -> str:
    from lambda_core import api

    card = api.plugin_model(f"{role}/{name}")
    return "\n".join(filter(None, (card.summary, card.reference)))


def law_card(node: Node) -> FieldCard:
    """Return the card of the choice of a role's model."""
    if not ROLES[node.role].section:
        return field_card(Models, node.role)
    return field_card(table_model(Case, node.law_places[0][:-1]), "law")


def law_choice_row(draft: Draft, node: Node, around: Surroundings) -> ChoiceRow:
    """Return a row that only chooses the model."""
    place = Option(draft, node.law_places[0])
    return ChoiceRow(place, law_card(node), around, lambda: law_choices(node.role), short=node.short)


def law_row(draft: Draft, node: Node, around: Surroundings) -> LawRow:
    """Return the row of a role's model with its parameters."""
    model, parameters = (Option(draft, keys) for keys in node.law_places)
    return LawRow(node.role, model, parameters, law_card(node), around, label="model")


class LawRow(Branch):
    """Model of a role with its parameters.

    It shows its description, too.
    """

    DEFAULT_CSS = """
    LawRow .about { width: 1fr; height: auto; color: $text-muted; margin: 1 0; }
    LawRow .about.-none { display: none; }
    """

    def __init__(
        self, role: str, model: Option | Part, parameters: Option | Part, card: FieldCard, around: Surroundings,
        **how: Any,
    ) -> None:  # fmt: skip
        super().__init__(model, card, around, **how)
        self._role, self._parameters = role, parameters

    def control(self) -> Widget:
        """Return the choice of models."""
        return Choice(self._entries, text_of(self.place.get()))

    def _entries(self) -> list[ChoiceEntry]:
        known = self.around.resolved(self.place.keys) or DEFAULT_MODELS[self._role]
        return [unset(known), *law_choices(self._role)]

    def _model(self) -> str:
        """Return the name of the present model.

        The name is given as far as it is known.
        """
        written = self.place.get()
        if isinstance(written, str) and written != "auto":
            return written
        return self.around.resolved(self.place.keys) or DEFAULT_MODELS[self._role]

    def _card(self) -> ModelCard | str:
        from lambda_core import api

        try:
            return api.plugin_model(f"{self._role}/{self._model()}")
        except LambdaError as error:
            return str(error) if self._model() != "auto" else ""

    def shape(self) -> object:
        """Return the model."""
        return self._model()

    def show(self) -> None:
        """Show the choice."""
        self.query_one(Choice).show_value(text_of(self.place.get()))
        super().show()

    def twigs(self) -> Iterator[Widget]:
        """Yield the model's description and parameters.

        Each parameter has a row.
        """
        card = self._card()
        if isinstance(card, str):
            yield Static(card, classes="about", markup=False)
            return
        yield Static(_about(card), classes="about")
        for parameter in card.parameters:
            reference = " ".join(filter(None, (parameter.source, f"[{parameter.status}]" if parameter.status else "")))
            shown = FieldCard(**{**parameter.model_dump(include=set(FieldCard.model_fields)), "reference": reference})
            yield row_for(self._parameters.part(parameter.name), shown, self.around)

    def on_choice_changed(self, event: Choice.Changed) -> None:
        """Write the model.

        Parameters that only the old one had are removed with it.
        """
        if event.choice is not self.query_one(Choice):
            return
        event.stop()
        self.write(event.value or None)
        card = self._card()
        if not isinstance(card, str):
            known = {parameter.name for parameter in card.parameters}
            for name in list(self._parameters.get() or ()):
                if name not in known:
                    self._parameters.part(name).put(None)
        self.post_message(Left())
        self.reload()


def _about(card: ModelCard) -> Text:
    text = Text(card.summary)
    for title, line in (("", card.reference), ("valid for ", card.validity)):
        if line:
            text.append(f"\n{title}{line}", style="italic")
    if card.distribution.split(" ")[0] != _OWN:
        text.append(f"\nfrom {card.distribution}")
    if not card.parameters:
        text.append("\nno parameters")
    return text
