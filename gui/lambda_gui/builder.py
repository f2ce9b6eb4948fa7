"""Define the builder's screen: tree, form, help, numbers."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, ClassVar, get_origin

from rich.text import Text
from textual import events
from textual.app import ComposeResult
from textual.binding import Binding, BindingType
from textual.containers import Horizontal, Vertical
from textual.timer import Timer
from textual.widgets import Tree

from lambda_core.domain.errors import Problem
from lambda_core.domain.option_tree import option_paths
from lambda_gui import entries
from lambda_gui.checking import belongs, node_of
from lambda_gui.derived import Derived
from lambda_gui.footer import KeyLine
from lambda_gui.forms import NodeForm
from lambda_gui.head import Head
from lambda_gui.live_draft import LiveDraft
from lambda_gui.nodes import Keys, Node
from lambda_gui.option_help import OptionHelp
from lambda_gui.rows import Edited, Left, Row, row_of
from lambda_gui.sketch import Sketch
from lambda_gui.tree import ModelTree

if TYPE_CHECKING:
    from collections.abc import Sequence

    from lambda_core.api import Draft
    from lambda_gui.from_catalogue import Taken


class BuilderScreen(LiveDraft):
    """One case."""

    HORIZONTAL_BREAKPOINTS = [(0, "-narrow"), (140, "-wide")]  # noqa: RUF012
    VERTICAL_BREAKPOINTS = [(0, "-low"), (34, "-middle"), (44, "-high")]  # noqa: RUF012
    BINDINGS: ClassVar[list[BindingType]] = [
        Binding("f1", "app.help", "Help", priority=True),
        Binding("f2", "catalogue", "Catalogue", priority=True),
        Binding("f3", "app.study", "Study", priority=True),
        Binding("f4", "app.duty", "Duty cycle", show=False, priority=True),
        Binding("ctrl+f", "app.fit_case", "Fit", show=False, priority=True),
        Binding("f5,ctrl+r", "app.run_case", "Run", priority=True),
        Binding("f6", "app.results", "Results", priority=True),
        Binding("f10,ctrl+g", "answers", "Answers", priority=True, key_display="f10"),
        Binding("ctrl+s", "save", "Save", show=False, priority=True),
        Binding("f7", "app.runs", "Runs", show=False, priority=True),
        Binding("f8", "next_mistake", "Next mistake", show=False, priority=True),
        Binding("ctrl+z", "undo", "Undo", show=False, priority=True),
        Binding("ctrl+y", "redo", "Redo", show=False, priority=True),
        Binding("ctrl+o", "app.open_case", "Open", show=False, priority=True),
    ]
    DEFAULT_CSS = """
    BuilderScreen { layout: vertical; background: $background; }
    BuilderScreen #body { height: 1fr; }
    BuilderScreen #tree { width: 40; height: 1fr; border-right: vkey $border-blurred; }
    BuilderScreen #tree:focus { border-right: vkey $border; }
    BuilderScreen #right { width: 1fr; height: 1fr; background: $background; }
    BuilderScreen #side { height: 11; width: 1fr; border-top: hkey $border-blurred; }
    BuilderScreen #help { height: 4; }
    BuilderScreen #sketch { display: none; }
    BuilderScreen.-wide #tree { width: 49; }
    BuilderScreen.-wide #right { layout: horizontal; }
    BuilderScreen.-wide #side { width: 46; height: 1fr; border-top: none; border-left: vkey $border-blurred; }
    BuilderScreen.-wide #help { height: 10; border-bottom: hkey $border-blurred; }
    BuilderScreen.-wide #derived { height: 21; border-bottom: hkey $border-blurred; }
    BuilderScreen.-wide #sketch { display: block; height: 1fr; }
    BuilderScreen.-drawing-below #tree { width: 39; }
    BuilderScreen.-drawing-below #side { height: 4; }
    BuilderScreen.-drawing-below #help { height: 3; border-bottom: none; }
    BuilderScreen.-drawing-below #sketch { display: block; width: 1fr; height: 1fr; }
    BuilderScreen.-drawing-below #derived { width: 38; height: 1fr; border-bottom: none; }
    BuilderScreen #below { height: 10; border-top: hkey $border-blurred; }
    BuilderScreen.-middle #below { height: 15; }
    BuilderScreen.-high #below { height: 21; }
    BuilderScreen.-wide.-drawing-below #derived { width: 66; }
    BuilderScreen.-wide.-drawing-below #side { height: 1fr; }
    BuilderScreen.-wide.-drawing-below #help { height: 1fr; }
    """

    def __init__(self, draft: Draft) -> None:
        super().__init__(draft)
        self.set_class("shaft" in draft.root.model_fields, "-drawing-below")  # it is as long as the screen is wide
        self._form_timer: Timer | None = None
        # node and option that are to have the keyboard once its form stands, and whether its text is to be selected
        self._wanted: tuple[str, Keys, bool] | None = None
        self._mistake = (-1, "")  # number and place of the mistake that F8 went to last

    # -- layout --

    def compose(self) -> ComposeResult:
        """Lay out head, tree, form, numbers and drawing.

        The drawing of a bearing is at the side, that of a shaft below.
        """
        yield Head()
        is_below = self.has_class("-drawing-below")
        with Horizontal(id="body"):
            yield ModelTree(self.draft, self.around)
            with Vertical(id="right"), Vertical(id="side"):
                yield OptionHelp(id="help")
                if not is_below:
                    yield Derived()
                    yield Sketch()
        if is_below:
            with Horizontal(id="below"):
                yield Sketch()
                yield Derived()
        yield KeyLine()

    def on_mount(self) -> None:
        """Show the case and begin to check it."""
        self.app.theme_changed_signal.subscribe(self, lambda _: self._recolour())
        self.query_one(ModelTree).focus()
        self._show_head()
        self.begin()

    def on_resize(self, event: events.Resize) -> None:
        """Fit the head."""
        self._show_head()

    def _show_head(self) -> None:
        warned, running = len(self.query_one(Derived).warnings()), self.app.run_words()  # type: ignore[attr-defined]
        self.query_one(Head).show(self.draft, self.check, warned, running)

    def _recolour(self) -> None:
        self._show_head()
        self.query_one(ModelTree).refresh_marks(self.check.problems)
        self.query_one(Derived).draw()
        self.query_one(Sketch).draw()

    # -- tree and form --

    def on_tree_node_highlighted(self, event: Tree.NodeHighlighted[Node]) -> None:
        """Show the form of the highlighted node.

        A held arrow key does not draw every one it passes.
        """
        if self._form_timer is not None:
            self._form_timer.stop()
        node = event.node.data
        if node is not None:
            self._form_timer = self.set_timer(0.04, lambda: self.show_node(node))

    async def show_node(self, node: Node) -> None:
        """Put the form of a node in place.

        Values and mistakes appear in the same picture.
        """
        if not self.is_here:
            return
        if self.form is None or self.form.node is not node:
            form = NodeForm(node, self.draft, self.around)
            async with self.batch():
                if self.form is not None:
                    self.form.is_ready = False  # what checks come in meanwhile must not reach into it
                gone = self.query("#right > NodeForm").remove()
                await self.query_one("#right", Vertical).mount(form, before="#side")
                await gone
                if not self.is_here:
                    return
                form.reload(self.check.problems)
                self._show_node_help(node)
                self.query_one(Sketch).show_node(node)
        # On the way, the cursor may rest on another node (a tree that was planted anew begins at its first).
        if self._wanted is not None and self._wanted[0] == node.key and self.form is not None:
            self.form.show(*self._wanted[1:])
            self._wanted = None

    def _show_node_help(self, node: Node) -> None:
        words = node.help[:1].upper() + node.help[1:]
        if node.section is not None and not node.section.installed:
            words += f"; + adds a {node.section.one}" + ", Del removes it" * (node.kind == "item")
        self.query_one(OptionHelp).show(Text.assemble((node.heading, "bold"), f"  {words}"))

    @property
    def bearing(self) -> Keys:
        """Place of the bearing for a catalogue row.

        It is that of the form, else the first one.
        """
        if "bearing" in self.draft.root.model_fields:
            return ("bearing",)
        table = self.form.node.table[:2] if self.form is not None else ()
        if table[:1] == ("bearings",) and len(table) == 2:
            return table
        return ("bearings", next(iter(self.draft.get("bearings") or ("left",))))

    @property
    def form(self) -> NodeForm | None:
        """The form that is shown."""
        shown = list(self.query("#right > NodeForm").results(NodeForm))
        return shown[-1] if shown else None

    def on_model_tree_entered(self) -> None:
        """Go from the tree into the form."""
        if self.form is not None:
            self.form.enter()

    def on_node_form_left(self) -> None:
        """Go back to the tree."""
        self.query_one(ModelTree).focus()

    def on_node_form_opened(self, event: NodeForm.Opened) -> None:
        """Do what a button of the form asks for."""
        if event.what == "catalogue":
            self.action_catalogue()
        elif event.what == "node":
            self.query_one(ModelTree).go_to(event.name)
            self.query_one(ModelTree).focus()
        elif self.form is not None:
            self._change_tables(event.what, self.form.node, event.name)

    def on_model_tree_wished(self, event: ModelTree.Wished) -> None:
        """Add a table, or take one out."""
        self._change_tables(event.what, event.node)

    def _change_tables(self, what: str, node: Node, name: str = "") -> None:
        """Add, remove or rename a table, go there.

        It is a table of a section.
        """
        if node.section is None or (node.section.installed and what == "add" and not name):
            return
        if what == "remove":
            place = entries.remove(node, self.draft)
            self.query_one(ModelTree).focus()
        else:
            change = {"add": entries.add, "rename": entries.rename}[what]
            place = change(node, self.draft, name)
        self.edited()
        self.go_to(place)

    def on_descendant_focus(self, event: events.DescendantFocus) -> None:
        """Say what the option under the keyboard is."""
        row = row_of(event.widget)
        if row is not None:
            self.query_one(OptionHelp).show(row.help())
        elif isinstance(event.widget, ModelTree) and self.form is not None:
            self._show_node_help(self.form.node)

    def go_to(self, keys: Keys, *, select: bool = True) -> None:
        """Show an option, ready to be changed.

        Its text is selected, so typing replaces it.
        """
        tree = self.query_one(ModelTree)
        tree.refresh_marks(self.check.problems)
        node = tree.node_at(keys) or node_of(Problem(".".join(keys), ""), tree.all_nodes())
        if node is None:
            return
        at = tree.cursor_node  # where it has just gone to another node, the form of that one is still to come
        is_here = at is not None and at.data is node
        if is_here and self.form is not None and self.form.node is node and self.form.is_ready:
            self.form.show(keys, select)
            return
        self._wanted = (node.key, keys, select)
        tree.go_to(node.key)

    def options(self) -> list[str]:
        """Return the options that stand on some node."""
        nodes = self.query_one(ModelTree).all_nodes()
        places = {place for node in nodes for place in node.places}
        fields = self.draft.root.model_fields
        named = [name for name, info in fields.items() if get_origin(info.annotation) is dict or name == "shaft"]
        groups = (group for node in nodes for group in node.groups if group.table[:1] and group.table[0] in named)
        shown = (".".join(keys) for group in groups for keys in group.fields)
        split = ((path, tuple(path.split("."))) for path in dict.fromkeys((*option_paths(self.draft.root), *shown)))
        return [path for path, keys in split if any(keys[: n + 1] in places for n in range(len(keys)))]

    # -- changes --

    def on_edited(self, event: Edited) -> None:
        """Take a change in."""
        self.edited()

    def on_left(self, event: Left) -> None:
        """End a series of changes."""
        self.draft.seal()

    def edited(self) -> None:
        """Mark the change and check soon."""
        self._show_head()
        super().edited()

    def show_check(self) -> None:
        """Show the results of the last check.

        They are marks in the tree, mistakes at their fields, and derived values.
        """
        self.query_one(ModelTree).refresh_marks(self.check.problems)
        if self.form is not None:
            self.form.reload(self.check.problems)
        self.query_one(Derived).show_check(self.check)
        self.query_one(Sketch).show_check(self.check)
        self._show_head()

    def show_estimate(self, estimate: Any, say: str) -> None:
        """Show the numbers that follow."""
        if self.is_here:
            self.query_one(Derived).show_estimate(estimate, say)
            self.query_one(Sketch).show_estimate(estimate)
            self._show_head()

    def action_undo(self) -> None:
        """Take the last change back and show where it was."""
        self._moved(self.draft.undo(), "nothing to undo")

    def action_redo(self) -> None:
        """Bring back what was undone."""
        self._moved(self.draft.redo(), "nothing to bring back")

    def _moved(self, keys: Keys | None, otherwise: str) -> None:
        if keys is None:
            self.notify(otherwise, timeout=2)
            return
        if self.form is not None:
            self.form.reload(self.check.problems)
        self.go_to(keys)
        self.edited()

    def action_next_mistake(self) -> None:
        """Go to the next option with a mistake."""
        problems = self.check.problems
        if not problems:
            for warning in self.query_one(Derived).warnings():
                self.notify(warning, title="beyond a limit", severity="warning", timeout=15)
            self.notify("no mistakes", timeout=2)
            return
        places = list(dict.fromkeys(problem.where for problem in problems))
        at = self._mistake_at(problems, places)
        self._mistake = (at, places[at])
        row = self._row()
        if row is not None and places[at] == ".".join(map(str, row.place.keys)):
            self.notify("there is no other error", timeout=2)
            return
        self.go_to(tuple(places[at].split(".")), select=False)

    def _mistake_at(self, problems: Sequence[Problem], places: Sequence[str]) -> int:
        """Return the number of the place of the next mistake.

        It is the next one to the mistake under the keyboard, else to that which was shown last; where this one is
        corrected, its successor has its number.
        """
        number, place = self._mistake
        row = self._row()
        here = [places.index(p.where) for p in problems if row is not None and belongs(p, row.place.keys)]
        if here and place not in {places[at] for at in here}:
            return (here[-1] + 1) % len(places)
        if place in places:
            return (places.index(place) + 1) % len(places)
        return max(0, number) % len(places)

    def _row(self) -> Row | None:
        """Return the row that has the keyboard."""
        above = self.focused.ancestors_with_self if self.focused else ()
        return next((widget for widget in above if isinstance(widget, Row)), None)

    def action_answers(self) -> None:
        """Answer questions about the case as it stands."""
        self.when_checked(self._answer)

    def _answer(self) -> None:
        from lambda_gui.answer_screen import AnswerScreen

        if self.check.model is None:
            self.notify(self.what_is_wrong(), severity="warning", timeout=4)
        else:
            self.app.push_screen(AnswerScreen(self.draft))

    def what_is_wrong(self) -> str:
        """Return the number of mistakes and their key.

        The key leads to them.
        """
        count = len(self.check.problems)
        return f"correct {count} mistake{'s' * (count != 1)} first: F8"

    # -- file --

    def action_save(self) -> None:
        """Save, asking for a name where there is none."""
        self.app.save_case()  # type: ignore[attr-defined]

    def saved(self) -> None:
        """Show that everything is in the file."""
        self.keeper.drop()
        self.query_one(ModelTree).refresh_marks(self.check.problems)
        if self.form is not None:
            self.form.reload(self.check.problems)
        self._show_head()

    def refresh_head(self) -> None:
        """Draw the head anew: a run has gone on."""
        self._show_head()

    def action_catalogue(self) -> None:
        """Choose a bearing, or an oil.

        The form of the oil decides for the oil.
        """
        form = self.form
        is_oil = form is not None and form.node.key.startswith("lubricant")
        self.app.show_catalogue("lubricant" if is_oil else "bearing")  # type: ignore[attr-defined]

    def take(self, found: Taken) -> None:
        """Put a catalogue row into the case.

        Values of another bearing or oil written here are removed.
        """
        if found.kind == "bearing":
            self.draft.set(*self.bearing, "designation", value=found.name)
            self.draft.set(*self.bearing, "maker", value=found.maker)
            old = (*self.bearing, "geometry")
        else:
            self.draft.set("lubricant", "name", value=found.name)
            old = ("lubricant", "properties")
        if self.draft.get(*old) is not None:
            self.draft.set(*old, value=None)
            self.notify(f"[{'.'.join(old)}] belonged to the previous choice and was removed; Ctrl+Z restores it")
        if found.said:
            self.notify(f"{found.name}: {found.said}; Ctrl+Z undoes it", timeout=8)
        self.draft.seal()
        self.go_to((*self.bearing, "designation") if found.kind == "bearing" else ("lubricant", "name"))
        if self.form is not None:
            self.form.reload(self.check.problems)
        self.edited()
