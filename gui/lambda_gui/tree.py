"""Show the model tree with values, changes and errors."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, ClassVar

from rich.text import Text
from textual.binding import Binding, BindingType
from textual.message import Message
from textual.widgets import Tree
from textual.widgets.tree import TreeNode

from lambda_gui.checking import node_of
from lambda_gui.nodes import Keys, Node
from lambda_gui.outline import outline, section_names
from lambda_gui.summaries import summary

if TYPE_CHECKING:
    from lambda_core.api import Draft
    from lambda_core.domain.errors import Problem
    from lambda_gui.case_context import CaseContext

_ROOMY = 44  # width of the tree from which on roles have their full names
_NARROW = 38
_COLUMN, _COLUMN_ROOMY = 17, 25  # where what is set stands, as far as there is room
_OPEN = (
    "bearing",
    "bodies",
    "motion",
    "lubricant",
    "markers",
    "shaft",
    "bearings",
    "gears",
    "discs",
    "loads",
    "connections",
)


class ModelTree(Tree[Node]):
    """Nodes of the case.

    Moving onto one shows its form, Enter goes into it.
    """

    BINDINGS: ClassVar[list[BindingType]] = [
        Binding("enter", "enter", "Edit", show=False),
        Binding("right", "deeper", "Open", show=False),
        Binding("left", "shallower", "Close", show=False),
        Binding("space", "toggle_node", "Open or close", show=False),
        Binding("plus,insert", "add", "Add", show=False),
        Binding("delete", "take_out", "Remove", show=False),
    ]
    DEFAULT_CSS = """
    ModelTree { background: $background; padding: 0; scrollbar-size-vertical: 1; scrollbar-size-horizontal: 0; }
    """

    class Entered(Message):
        """Message to enter the form.

        It is that of the node under the cursor.
        """

    class Wished(Message):
        """Message to add or remove a table.

        It is after the node under the cursor, or that of the node.
        """

        def __init__(self, what: str, node: Node) -> None:
            super().__init__()
            self.what, self.node = what, node

    def __init__(self, draft: Draft, around: CaseContext) -> None:
        super().__init__("case", id="tree")
        self.show_root, self.guide_depth, self.auto_expand = False, 2, False
        self.draft, self._around = draft, around
        self._names: dict[str, tuple[str, ...]] = {}
        self._wrong: dict[str, int] = {}
        self._changed: set[str] = set()  # keys of nodes that differ from the file
        self._plant()

    def _plant(self) -> None:
        is_open = {line.data.key: line.is_expanded for line in self._tree_nodes.values() if line.data is not None}
        self.clear()
        self._names = section_names(self.draft)
        for node in outline(self.draft.root, self._names):
            self._add(self.root, node, is_open)
        self.root.expand()
        self.cursor_line = 0

    def _add(self, parent: TreeNode[Node], node: Node, is_open: Mapping[str, bool]) -> None:
        if node.children:
            branch = parent.add(node.title, node, expand=is_open.get(node.key, False) or node.key in _OPEN)
            for child in node.children:
                self._add(branch, child, is_open)
        else:
            parent.add_leaf(node.title, node)

    def all_nodes(self) -> list[Node]:
        """Return every node of the case."""
        return [node.data for node in self._tree_nodes.values() if node.data is not None]

    def refresh_marks(self, problems: Sequence[Problem]) -> None:
        """Refresh the marks of all nodes.

        They count mistakes and show set options; named tables that came or went are taken in.
        """
        if section_names(self.draft) != self._names:
            self._plant()
        nodes = self.all_nodes()
        self._wrong = {}
        for problem in problems:
            found = node_of(problem, nodes)
            if found is not None:
                self._wrong[found.key] = self._wrong.get(found.key, 0) + 1
        self._changed = {node.key for node in nodes if any(self.draft.is_changed(*place) for place in node.places)}
        self._refresh_labels()

    def on_resize(self) -> None:
        """Fit the labels to the new width."""
        self._refresh_labels()

    def _refresh_labels(self) -> None:
        for node in self._tree_nodes.values():
            if node.data is None:
                continue
            label, shown = self._label(node, node.data), node.label
            if label != shown or label.style != getattr(shown, "style", ""):  # each label that is set is drawn anew
                node.set_label(label)

    def _label(self, line: TreeNode[Node], node: Node) -> Text:
        wrong = sum(self._wrong.get(inner.key, 0) for inner in node.walk())
        changed = any(inner.key in self._changed for inner in node.walk())
        depth, above = 0, line.parent
        while above is not None and above is not self.root:
            depth, above = depth + 1, above.parent
        arrow = 2 if node.children else 0
        width = self.size.width - 1 if self.size else _NARROW  # a column is left for the scroll bar
        room = max(12, width - 2 * depth - arrow)
        colours = self.app.theme_variables
        marks = Text()
        if changed:
            marks.append(" ●", style=colours["accent"])
        if wrong:
            marks.append(f" ▲{wrong}", style=colours["error"])
        text = Text(node.title if width >= _ROOMY else node.short, style="bold" if depth == 0 else "")
        words = summary(node, self.draft, self._around)
        if words:
            left = room - len(marks) - len(text)
            column = max(1, (_COLUMN_ROOMY if width >= _ROOMY else _COLUMN) - 2 * depth - arrow - len(text))
            words = _fitting(words.split("\t"), left - column)
            text.append(" " * max(1, min(column, left - len(words))) + words, style="dim not bold")
        text.truncate(room - len(marks), overflow="ellipsis", pad=True)
        return text.append_text(marks)

    def wrong_nodes(self) -> list[str]:
        """Return the keys of the nodes with mistakes, in order."""
        return [node.key for node in self.all_nodes() if self._wrong.get(node.key)]

    def node_at(self, keys: Keys) -> Node | None:
        """Return the node of a place.

        It is a place in the case.
        """
        best: tuple[int, Node] | None = None
        for node in self.all_nodes():
            for place in node.places:
                if place == keys[: len(place)] and (best is None or len(place) > best[0]):
                    best = (len(place), node)
        return best[1] if best else None

    def go_to(self, key: str) -> None:
        """Move to a node, opening what is above it."""
        for line in self._tree_nodes.values():
            if line.data is not None and line.data.key == key:
                above = line.parent
                while above is not None:
                    above.expand()
                    above = above.parent
        self.call_after_refresh(self._move_to, key)

    def _move_to(self, key: str) -> None:
        """Put the cursor on a node.

        Lines are looked up late, since the tree may have been built anew.
        """
        line = next((at for at in self._tree_nodes.values() if at.data is not None and at.data.key == key), None)
        if line is not None:
            self.move_cursor(line)

    def action_enter(self) -> None:
        """Go into the form.

        A node that only groups others opens.
        """
        self.post_message(self.Entered())

    def action_deeper(self) -> None:
        """Open the node or its form.

        The form if the node is open.
        """
        line = self.cursor_node
        if line is not None and line.allow_expand and not line.is_expanded:
            line.expand()
        else:
            self.post_message(self.Entered())

    def action_add(self) -> None:
        """Add a table to the section under the cursor."""
        line = self.cursor_node
        while line is not None and line.data is not None and line.data.section is None:
            line = line.parent
        if line is not None and line.data is not None:
            self.post_message(self.Wished("add", line.data))

    def action_take_out(self) -> None:
        """Remove the table under the cursor."""
        node = self.cursor_node.data if self.cursor_node is not None else None
        if node is not None and node.kind == "item":
            self.post_message(self.Wished("remove", node))

    def action_shallower(self) -> None:
        """Close the node, or go to the one above."""
        line = self.cursor_node
        if line is None:
            return
        if line.allow_expand and line.is_expanded:
            line.collapse()
        elif line.parent is not None and line.parent is not self.root:
            self.move_cursor(line.parent)


def _fitting(parts: list[str], room: int) -> str:
    """Join as many parts as fit."""
    shown = parts[0]
    for part in parts[1:]:
        if len(shown) + 3 + len(part) > room:
            break
        shown += f" · {part}"
    return shown
