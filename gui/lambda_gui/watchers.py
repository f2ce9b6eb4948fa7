"""Define forms of observers and events."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from textual.widget import Widget
from textual.widgets import Button, Static

from lambda_core import api
from lambda_core.api import FieldCard
from lambda_gui.fields import row_for
from lambda_gui.nodes import Node
from lambda_gui.places import Option
from lambda_gui.rows import Surroundings

if TYPE_CHECKING:
    from lambda_core.api import Draft

_ACTION = FieldCard(
    name="action", description="what a run does at the event: it ends, or writes down when it began", default="stop",
    required=False, quantity="", units=[], limits=[], kind="choice", choices=["stop", "record"], reference="",
)  # fmt: skip


def watcher_rows(draft: Draft, node: Node, around: Surroundings) -> Iterator[Widget]:
    """Yield an observer's or event's rows.

    They are its description and a row for each parameter; other tables have none.
    """
    section, name = node.table[0], node.table[-1]
    kind = node.section.installed if node.section is not None else ""
    if not kind:
        return
    card = next((card for card in api.plugin_parts(kind) if card.name == name), None)
    about = f"no package that is installed brings it: {name}" if card is None else f"{card.title}\n{card.reference}"
    if card is not None:
        about += f"\nfrom {card.distribution}"
    yield Static(about, classes="about", markup=False)
    place = Option(draft, (section, name))
    if section == "events":
        yield row_for(place.part("action"), _ACTION, around)
    written = place.get()
    known = [] if card is None else card.parameters
    for parameter in known:
        yield row_for(place.part(parameter.name), parameter, around)
    for stranger in written if isinstance(written, dict) else ():
        if stranger != "action" and stranger not in [parameter.name for parameter in known]:
            said = {"name": stranger, "kind": "text", "description": "is not one of its parameters"}
            told = _ACTION.model_copy(update=said)
            yield row_for(place.part(stranger), told, around)


def new_watchers(node: Node) -> Iterator[Widget]:
    """Yield a button per unused observer or event.

    It is installed and not in the case.
    """
    what = node.section
    assert what is not None
    assert what.installed
    used = [child.title for child in node.children]
    cards = [card for card in api.plugin_parts(what.installed) if card.name not in used]
    for card in cards:
        yield Button(f"add {card.name}", id=f"new-{card.name.replace(':', '--')}", name=card.name, compact=True)
        yield Static(card.title, classes="about", markup=False)
    if not cards:
        text = f"no {'other ' if used else ''}{what.one} is installed: packages bring them (docs/plugins.md)"
        yield Static(text, classes="about", markup=False)
