"""Set up and solve a duty cycle of the case."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any, ClassVar

from rich.console import Group
from rich.text import Text
from textual import events, work
from textual.app import ComposeResult
from textual.binding import Binding, BindingType
from textual.containers import Horizontal, VerticalScroll
from textual.screen import Screen
from textual.widgets import Input, Static

from lambda_core.domain.errors import LambdaError
from lambda_gui.dialogs import AskText
from lambda_gui.duty_values import FIRST_TIME, NAME, TIME, Column, Phase, columns_of, cycle_tables, cycle_view
from lambda_gui.entry import Entry
from lambda_gui.footer import KeyLine
from lambda_gui.helper import Helper
from lambda_gui.lifecycle import is_here
from lambda_gui.new_files import save_next_to_case
from lambda_gui.option_help import OptionHelp
from lambda_gui.rows import Rows

if TYPE_CHECKING:
    from lambda_core.api import Draft
    from lambda_gui.case_context import CaseContext

_HINT = "F5 solves every phase and adds up life and losses; an empty place is as in the case"


class PhaseLine(Horizontal):
    """One phase: the values that differ in it."""

    DEFAULT_CSS = """
    PhaseLine { height: 1; }
    PhaseLine Entry { margin-right: 1; }
    """

    def __init__(self, phase: Phase, columns: Sequence[Column], usual: Mapping[str, str]) -> None:
        super().__init__()
        self.phase, self._columns, self._usual = phase, columns, usual

    def compose(self) -> ComposeResult:
        """Lay out an entry for each column."""
        for column in self._columns:
            entry = Entry(column.card)
            entry.value = self.phase.texts.get(column.key, "")
            entry.placeholder = self._usual.get(column.key, "")
            entry.styles.width = column.width
            yield entry

    def keep(self) -> None:
        """Take what stands in the entries, with its units."""
        for column, entry in zip(self._columns, self.query(Entry), strict=True):
            entry.complete()
            self.phase.texts[column.key] = entry.value.strip()

    def column_of(self, entry: Entry) -> int:
        """Return the number of an entry's column."""
        return list(self.query(Entry)).index(entry)


class DutyScreen(Screen[None]):
    """A form for a load spectrum.

    Parameters
    ----------
    draft : Draft
        The case that goes through the phases.
    name : str
        Name of the case.
    case_toml : str
        The same, complete.
    around : CaseContext
        The values that hold where the case says nothing.
    width : int
        Columns of the screen.
    """

    AUTO_FOCUS = "PhaseLine Entry"
    BINDINGS: ClassVar[list[BindingType]] = [
        Binding("f1", "app.help", "Help", priority=True),
        Binding("f5,ctrl+r", "solve", "Add up", priority=True),
        Binding("ctrl+n", "add", "New phase", priority=True),
        Binding("ctrl+d", "remove", "Remove", priority=True),
        Binding("ctrl+s", "save", "Save", priority=True),
        Binding("escape,f4", "app.pop_screen", "Back"),
        Binding("down", "step(1)", show=False, priority=True),
        Binding("up", "step(-1)", show=False, priority=True),
    ]
    DEFAULT_CSS = """
    DutyScreen { background: $background; }
    DutyScreen .title { height: 1; width: 1fr; background: $panel; padding: 0 1; }
    DutyScreen #heads { height: 1; padding: 0 1; color: $primary; }
    DutyScreen Rows { height: auto; max-height: 40vh; padding: 0 1; }
    DutyScreen OptionHelp { height: 3; border-top: hkey $border-blurred; }
    DutyScreen #found.-old { text-opacity: 50%; }
    DutyScreen #sum { height: 1fr; padding: 0 1; border-top: hkey $border-blurred; }
    """

    def __init__(self, draft: Draft, name: str, case_toml: str, around: CaseContext, width: int) -> None:
        super().__init__()
        self._draft, self._name, self._case_toml = draft, name, case_toml
        self.columns = columns_of(draft, width)
        self._usual = {TIME: FIRST_TIME} | {
            column.key: _usual(draft.get(*column.keys), around, column) for column in self.columns if column.keys
        }
        self.phases = [Phase({NAME: "work", TIME: FIRST_TIME})]
        self._helper = Helper(self._say, lambda: is_here(self))

    def compose(self) -> ComposeResult:
        """Lay out the spectrum over what comes of it."""
        title = Text.assemble((f"A duty cycle of {self._name}", "bold"), ("   what differs in each phase", "dim"))
        yield Static(title, classes="title")
        yield Static("".join(f"{column.head:<{column.width + 1}}" for column in self.columns), id="heads")
        with Rows():
            for phase in self.phases:
                yield PhaseLine(phase, self.columns, self._usual)
        yield OptionHelp()
        with VerticalScroll(id="sum", can_focus=False):
            yield Static(Text(_HINT, style="dim"), id="found")
        yield KeyLine()

    async def on_unmount(self) -> None:
        """End the helper."""
        await self._helper.close()

    # -- the spectrum --

    def _here(self) -> tuple[PhaseLine, int] | None:
        entry = self.focused
        if not isinstance(entry, Entry):
            return None
        line = next(each for each in self.query(PhaseLine) if entry in each.query(Entry))
        return line, line.column_of(entry)

    def on_descendant_focus(self, event: events.DescendantFocus) -> None:
        """Say what the column under the keyboard is."""
        here = self._here()
        if here is not None:
            self.query_one(OptionHelp).show(_about(self.columns[here[1]]))

    def on_input_changed(self, event: Input.Changed) -> None:
        """Discard the sum of another cycle."""
        self.query_one("#found").set_class(True, "-old")

    def on_input_submitted(self, event: Input.Submitted) -> None:
        """Go on to the next entry."""
        self.focus_next(Entry)

    def action_step(self, by: int) -> None:
        """Go to the same column of another phase."""
        lines, here = list(self.query(PhaseLine)), self._here()
        if here is None:
            return
        target = lines.index(here[0]) + by
        if 0 <= target < len(lines):
            list(lines[target].query(Entry))[here[1]].focus()

    async def action_add(self) -> None:
        """Add a phase below this one.

        It has the values of this one.
        """
        self._keep()
        here = self._here()
        line = here[0] if here else self.query(PhaseLine).last()
        place = self.phases.index(line.phase) + 1
        phase = Phase(line.phase.texts | {NAME: f"phase {len(self.phases) + 1}"})
        self.phases.insert(place, phase)
        new = PhaseLine(phase, self.columns, self._usual)
        await self.query_one(Rows).mount(new, after=line)
        new.query(Entry).first().focus()

    async def action_remove(self) -> None:
        """Remove the phase under the keyboard; one stays."""
        here = self._here()
        if here is None or len(self.phases) == 1:
            return
        place = self.phases.index(here[0].phase)
        self.phases.pop(place)
        await here[0].remove()
        list(self.query(PhaseLine))[max(0, place - 1)].query(Entry).first().focus()

    def _keep(self) -> None:
        for line in self.query(PhaseLine):
            line.keep()

    def _written(self) -> list[str]:
        """Return what stands in the entries."""
        return [entry.value for entry in self.query(Entry)]

    def cycle(self) -> dict[str, object]:
        """Return the cycle as it stands in the form."""
        self._keep()
        return cycle_tables(f"{self._name}-duty", self.phases)

    # -- what comes of it --

    def _say(self, text: str) -> None:
        self.query_one("#found", Static).update(Text(text, style="dim italic"))

    def action_solve(self) -> None:
        """Solve every phase."""
        self._solve(self.cycle())

    @work(exclusive=True, group="duty")
    async def _solve(self, cycle: dict[str, object]) -> None:
        self._say("solving every phase ...")
        solved = self._written()
        shown, colours = self.query_one("#found", Static), self.app.theme_variables
        try:
            found = await self._helper.ask("duty", cycle=cycle, case_toml=self._case_toml)
        except LambdaError as error:
            shown.update(Text(str(error), style=colours["error"]))
            return
        tables, words = cycle_view(found, self.app.units, colours["warning"])  # type: ignore[attr-defined]
        shown.set_class(self._written() != solved, "-old")
        shown.update(Group(*tables, words))
        self.query_one("#sum").scroll_home(animate=False)

    def action_save(self) -> None:
        """Write the cycle into its own file.

        It is in the folder of the case.
        """
        path = self._draft.path
        if path is None or self._draft.is_changed():
            self.notify(
                "a duty cycle needs the file of the case: save the case first (Esc, Ctrl+S)", severity="warning"
            )
            return
        cycle = self.cycle() | {"case": path.name}
        target = path.with_name(f"{cycle['name']}.toml")
        question = AskText("Save the duty cycle as", str(target))
        self.app.push_screen(question, lambda text: save_next_to_case(self, cycle, text, "lambda-bearing duty"))


def _about(column: Column) -> Text:
    units = f"  {', '.join(column.card.units[:4])}" if column.card.units else ""
    return Text.assemble((column.key, "bold"), f"  {column.card.description}", (units, "dim"))


def _usual(written: Any, around: CaseContext, column: Column) -> str:
    """Return the case's value for a phase.

    The phase has none.
    """
    if isinstance(written, str):
        return written
    return "as it is" if written else around.resolved(column.keys)
