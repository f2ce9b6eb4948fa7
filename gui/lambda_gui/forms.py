"""Make the form of a node from the case's declarations."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, ClassVar

from rich.console import Group as Lines
from rich.console import RenderableType
from rich.table import Table
from rich.text import Text
from textual.app import ComposeResult
from textual.binding import Binding, BindingType
from textual.containers import Horizontal, VerticalScroll
from textual.message import Message
from textual.widget import Widget
from textual.widgets import Button, Input, Static

from lambda_core.api import FieldCard, field_card
from lambda_core.domain.option_tree import members
from lambda_core.domain.value_status import ESTIMATED
from lambda_gui.case_context import CaseContext
from lambda_gui.checking import by_place
from lambda_gui.choice import Entry as ChoiceEntry
from lambda_gui.details import Sources
from lambda_gui.entries import free_name, is_list
from lambda_gui.entry import Entry
from lambda_gui.fields import ChoiceRow, ParagraphRow, TextRow, row_for
from lambda_gui.labels import label_of
from lambda_gui.laws import law_choice_row, law_choices, law_row
from lambda_gui.nodes import Group, Keys, Node, is_freedom, table_model
from lambda_gui.parts import FreedomRow, MaterialRow
from lambda_gui.places import Option
from lambda_gui.profiles import ProfileRow
from lambda_gui.rows import Row, Stepped
from lambda_gui.signals import SignalRow
from lambda_gui.watchers import new_watchers, watcher_rows

if TYPE_CHECKING:
    from lambda_core.api import Draft
    from lambda_core.domain.errors import Problem

_NAMES = {"designation": "bearing", "name": "lubricant"}  # options that name a row of the catalogue
_MATERIALS = ("materials", "shaft", "housing")  # sections in which a table is a material

_ROOMY = 56  # width of a form from which on nothing is shortened
_LABEL, _LABEL_NARROW = 30, 17  # most room for labels; 20 columns are left for values on a form at 80 columns

_STRANGER = FieldCard(
    name="",
    description="is not a known option; empty the field to take it out of the file",
    default="",
    required=False,
    quantity="",
    units=[],
    limits=[],
    kind="text",
    choices=[],
    reference="",
)


def row_at(draft: Draft, keys: Keys, around: CaseContext) -> Row:
    """Return the row for one option of the case."""
    table, name, place = table_model(draft.root, keys[:-1]), keys[-1], Option(draft, keys)
    card, annotation = field_card(table, name), table.model_fields[name].annotation
    freedom = next(members(annotation), None)
    if freedom is not None and is_freedom(freedom):
        return FreedomRow(place, card, around, freedom)
    if keys[0] in _MATERIALS and card.kind == "table":
        return MaterialRow(place, card, around)
    if keys == ("bodies", "cage", "type"):
        return ChoiceRow(place, card, around, lambda: [ChoiceEntry(name, name) for name in around.names("cage")])
    if keys == ("lubricant", "properties", "rheology"):
        return ChoiceRow(place, card, around, lambda: law_choices("rheology")[1:])
    if name == "profile" and keys[-2] == "rollers":
        return ProfileRow(draft, keys[:-1], around)
    if keys == ("description",):
        return ParagraphRow(place, card, around)
    if card.kind == "signal":
        return SignalRow(place, card, around, list(members(annotation)))
    if card.kind == "text":
        kind = _NAMES.get(name, "") if len(keys) > 1 else ""
        return TextRow(place, card, around, kind=kind)
    return row_for(place, card, around)


class NodeForm(VerticalScroll, can_focus=False):
    """Rows of one node under its title."""

    BINDINGS: ClassVar[list[BindingType]] = [
        Binding("down", "step(1)", "Next", show=False),
        Binding("up", "step(-1)", "Previous", show=False),
        Binding("escape", "leave", "Back to the tree", show=False),
    ]
    DEFAULT_CSS = """
    NodeForm { height: 1fr; padding: 0 1; scrollbar-size-vertical: 1; scrollbar-gutter: stable; }
    NodeForm > .title { width: 1fr; height: auto; margin-bottom: 1; }
    NodeForm > .group { width: 1fr; height: 1; color: $primary; margin-top: 1; }
    NodeForm > .in-effect { width: 1fr; height: auto; margin-top: 1; color: $text-muted; }
    NodeForm > .about { width: 1fr; height: auto; color: $text-muted; padding-left: 2; }
    NodeForm .buttons { height: 1; margin-top: 1; }
    NodeForm Button { margin-right: 2; }
    NodeForm > Input { margin-top: 1; width: 32; }
    """

    class Left(Message):
        """The person goes back to the tree."""

    class Opened(Message):
        """Request of a button.

        "catalogue", "add", "rename" (with a name), "remove", "node" (with its key).
        """

        def __init__(self, what: str, name: str = "") -> None:
            super().__init__()
            self.what, self.name = what, name

    def __init__(self, node: Node, draft: Draft, around: CaseContext) -> None:
        super().__init__()
        self.node, self._draft, self._around = node, draft, around
        self.is_ready = False

    def compose(self) -> ComposeResult:
        """Lay out the title and the rows."""
        yield Static(Text(self.node.heading, style="bold"), classes="title")
        yield from self._rows()
        yield from self._buttons()
        yield Static(classes="in-effect")

    def on_mount(self) -> None:
        """Take the rows in."""
        self.is_ready = True
        self._fit()

    def on_resize(self) -> None:
        """Fit labels and values in effect to the new width."""
        self._fit()
        self.query_one(".in-effect", Static).update(self._in_effect())

    @property
    def _room(self) -> int:
        """Width before the form is laid out.

        It is that of its place, less its edges.
        """
        return self.parent.size.width - 3 if isinstance(self.parent, Widget) else 0

    def _fit(self) -> None:
        """Give all labels the same room.

        The longest are wrapped where their values need it.
        """
        is_narrow = (self.size.width or self._room) < _ROOMY
        rows = list(self.query(Row))
        lengths = [len(row.short if is_narrow else row.label) + 2 * row.has_class("-deep") for row in rows]
        width = max(14, min(_LABEL_NARROW if is_narrow else _LABEL, max(lengths, default=0) + 3))
        for row in rows:
            row.fit(width, short=is_narrow)

    def _rows(self) -> Iterator[Widget]:
        node = self.node
        if node.role:
            yield law_row(self._draft, node, self._around)
        elif node.kind == "roles":
            for child in node.children:
                yield law_choice_row(self._draft, child, self._around)
        for group in node.groups:
            if group.title:
                yield Static(group.title, classes="group")
            for keys in group.fields:
                yield row_at(self._draft, keys, self._around)
            yield from self._strangers(group)
        if node.kind == "item":
            yield from watcher_rows(self._draft, node, self._around)
        if not (node.groups or node.kind in ("role", "roles", "named", "item")):
            for child in node.children:
                yield from _link(child)

    def _strangers(self, group: Group) -> Iterator[Widget]:
        """Yield a row for each unknown key.

        The file is hand-written; the row can remove the key.
        """
        table = group.table
        written = self._draft.get(*table) if table else self._draft.tables
        known = table_model(self._draft.root, table).model_fields
        for name in written if isinstance(written, dict) else ():
            if name not in known:
                yield TextRow(
                    Option(self._draft, (*table, name)), _STRANGER.model_copy(update={"name": name}), self._around
                )

    def _buttons(self) -> Iterator[Widget]:
        node, what = self.node, self.node.section
        if node.key in ("bearing", "lubricant") or _is_bearing(node):
            with Horizontal(classes="buttons"):
                yield Button("F2  choose from the catalogue", id="catalogue", compact=True)
        if node.kind == "named" and what is not None:
            for child in node.children:
                yield from _link(child)
            if what.installed:
                yield from new_watchers(node)
            elif is_list(node):
                with Horizontal(classes="buttons"):
                    yield Button(f"add a {what.one}", id="add", compact=True)
            else:
                proposed = free_name(node, self._draft) if what.usual else ""
                words = f": {proposed}, or its name" if proposed else ""
                yield Input(placeholder=f"a new {what.one}{words}, then Enter", compact=True, id="new-name")
        if node.kind == "item" and what is not None:
            if not (is_list(node) or what.installed):
                yield Input(placeholder=f"another name than {node.table[-1]}", compact=True, id="rename")
            with Horizontal(classes="buttons"):
                if is_list(node):
                    yield Button("add one after it", id="add", compact=True)
                yield Button("remove it" if is_list(node) else f"remove this {what.one}", id="remove", compact=True)

    def reload(self, problems: Sequence[Problem]) -> None:
        """Show what is written and what is wrong with it."""
        if not self.is_ready:
            return
        rows = list(self.query(Row))
        for row, mistakes in zip(rows, by_place(problems, [row.place.keys for row in rows]), strict=True):
            row.reload()
            row.say(mistakes)
        self.query_one(".in-effect", Static).update(self._in_effect())

    def _in_effect(self) -> RenderableType:
        """Show the values from elsewhere.

        The case takes them for this node, with grades and sources.
        """
        own = {row.place.keys[-1] for row in self.query(Row)}
        found = [
            value
            for value in (self._around.table(self.node.key) if _has_values(self.node) else ())
            if value.path.rpartition(".")[2] not in own and value.source != "case"
        ]
        if not found:
            return Text()
        table, sources = Table.grid(padding=(0, 1, 0, 0)), Sources()
        table.add_column(style="dim", max_width=24)
        table.add_column(no_wrap=True)
        table.add_column(no_wrap=True, style="dim")
        table.add_column(no_wrap=True, style="dim", justify="right")
        for value in found:
            mark = "≈ " if value.status in ESTIMATED else ""
            number = str(sources.number(value.source)) if self.size.width >= _ROOMY and value.source else ""
            keys = value.path.split(".")
            name = label_of(keys, keys[-1])
            table.add_row(name, f"{mark}{value.text}", value.grade or "-", number)
        told = Text()
        sources.write(told)
        title = "from the catalogue or derived; grade" + (", source" if told else "")
        return Lines(Text(title, style="italic"), table, told)

    def show(self, keys: Keys, select: bool = True) -> None:
        """Show one option and give it the keyboard.

        It is the row that is most about it.

        Text that is not selected is not typed over.
        """
        rows = [row for row in self.query(Row) if _meets(row.place.keys, keys)]
        for row in sorted(rows, key=lambda row: -len(row.place.keys) if len(row.place.keys) <= len(keys) else 0):
            entry = row.entry()
            if isinstance(entry, Entry) and not select:
                entry.visit()
                return
            if entry is not None:
                entry.focus()
                return

    def enter(self) -> None:
        """Give the keyboard to the first entry."""
        stops = list(self._stops())
        adds = [stop for stop in stops if stop.id in ("new-name", "add")] if self.node.kind == "named" else []
        if stops:
            (adds or stops)[0].focus()

    def _stops(self) -> Iterator[Widget]:
        return (widget for widget in self.query("*").results(Widget) if widget.focusable)

    def action_step(self, by: int) -> None:
        """Go to the next or previous entry."""
        stops = list(self._stops())
        if self.screen.focused in stops:
            at = stops.index(self.screen.focused) + by
            if 0 <= at < len(stops):
                stops[at].focus()

    def on_stepped(self, event: Stepped) -> None:
        """Go to the next or previous entry."""
        event.stop()
        self.action_step(event.by)

    def on_row_done(self, event: Row.Done) -> None:
        """Go on to what the next row is changed by."""
        event.stop()
        rows = list(self.query(Row))
        later = rows[rows.index(event.row) + 1 :] if event.row in rows else []
        entry = next((entry for row in later if (entry := row.entry()) is not None), None)
        if entry is not None:
            entry.focus()
        else:
            self.action_step(1)

    def action_leave(self) -> None:
        """Go back to the tree."""
        self.post_message(self.Left())

    def on_button_pressed(self, event: Button.Pressed) -> None:
        """Hand the wish on."""
        event.stop()
        what = event.button.id or ""
        if what.startswith("new-"):
            self.post_message(self.Opened("add", event.button.name or ""))
        else:
            self.post_message(self.Opened(what))

    def on_input_submitted(self, event: Input.Submitted) -> None:
        """Add a table of a name, or rename."""
        name, section = event.value.strip(), self.node.section
        if event.input.id == "new-name" and section is not None:
            event.stop()
            name = name or (free_name(self.node, self._draft) if section.usual else "")
            if name:
                self.post_message(self.Opened("add", name))
        elif event.input.id == "rename" and name:
            event.stop()
            self.post_message(self.Opened("rename", name))


def _is_bearing(node: Node) -> bool:
    """Tell whether a node is one of bearings.

    There are several bearings.
    """
    return len(node.table) == 2 and node.table[0] == "bearings"


def _has_values(node: Node) -> bool:
    """Tell whether a form shows catalogue values.

    Its table takes them from the catalogue.
    """
    return node.key in ("bearing", "lubricant") or _is_bearing(node)


def _meets(one: Keys, other: Keys) -> bool:
    """Tell whether one place lies in the other."""
    shared = min(len(one), len(other))
    return one[:shared] == other[:shared]


class _Link(Button):
    """Leads to a node below."""

    DEFAULT_CSS = """
    _Link { width: 1fr; text-align: left; content-align-horizontal: left; background: transparent; }
    """

    def __init__(self, node: Node) -> None:
        super().__init__(f"▸ {node.title}", compact=True)
        self._node = node

    def press(self) -> _Link:
        """Open the node."""
        self.post_message(NodeForm.Opened("node", self._node.key))
        return self


def _link(node: Node) -> Iterator[Widget]:
    """Yield a link to a node below.

    It names its subject.
    """
    yield _Link(node)
    yield Static(node.help, classes="about", markup=False)
