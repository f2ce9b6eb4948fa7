"""Set up and run a study of the case."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, ClassVar

from rich.text import Text
from textual import events, work
from textual.app import ComposeResult
from textual.binding import Binding, BindingType
from textual.screen import Screen
from textual.timer import Timer
from textual.widgets import Static

from lambda_core.domain.errors import LambdaError
from lambda_gui.dialogs import AskText
from lambda_gui.entry import Entry
from lambda_gui.fields import TextRow, row_for
from lambda_gui.footer import KeyLine
from lambda_gui.helper import Helper
from lambda_gui.lifecycle import is_here
from lambda_gui.new_files import save_next_to_case
from lambda_gui.option_help import OptionHelp
from lambda_gui.places import Held
from lambda_gui.rows import Edited, Names, Row, Rows, row_of
from lambda_gui.study_values import MODES, POINTS, Values, asked, card, card_of, first_values, studied, study_tables

if TYPE_CHECKING:
    from lambda_core.api import BearingModel, Draft, FieldCard, MachineModel

_CHECK_AFTER = 0.5  # of quiet [s]: the first point is solved each time
_OPTION = "option"


class StudyScreen(Screen[None]):
    """A form for a study.

    Parameters
    ----------
    draft : Draft
        The case that is studied.
    model : BearingModel or MachineModel
        The same, resolved.
    options : sequence of str
        Paths of the options that the case has.
    path : str
        Option that varies first, "" to leave that open.
    written : str
        Its value now.
    """

    AUTO_FOCUS = ""
    BINDINGS: ClassVar[list[BindingType]] = [
        Binding("f1", "app.help", "Help", priority=True),
        Binding("f5,ctrl+r", "run", "Run", priority=True),
        Binding("ctrl+s", "save", "Save the study", priority=True),
        Binding("f6", "app.results", "Results", priority=True),
        Binding("f7", "app.runs", "Runs", show=False, priority=True),
        Binding("escape,f3", "app.pop_screen", "Back"),
        Binding("down", "app.focus_next", show=False),
        Binding("up", "app.focus_previous", show=False),
    ]
    DEFAULT_CSS = """
    StudyScreen { background: $background; }
    StudyScreen .title { height: 1; width: 1fr; background: $panel; padding: 0 1; }
    StudyScreen Rows { height: 1fr; padding: 0 1; }
    StudyScreen .group { width: 1fr; height: 1; color: $primary; }
    StudyScreen OptionHelp { height: 3; border-top: hkey $border-blurred; }
    StudyScreen #cost { height: 6; padding: 0 1; border-top: hkey $border-blurred; }
    """

    def __init__(
        self,
        draft: Draft,
        model: BearingModel | MachineModel,
        options: Sequence[str],
        path: str = "",
        written: str = "",
    ) -> None:
        super().__init__()
        self._draft, self._model = draft, model
        self._usual = asked(filter(None, model.bearing_models))
        self._around = Names({_OPTION: studied(draft.root, options)})
        varies = path if path in self._around.names(_OPTION) else ""
        self.values: Values = first_values(model.name, varies, written)
        self._helper = Helper(self._say, lambda: is_here(self))
        self._timer: Timer | None = None
        self.is_fine = False

    def compose(self) -> ComposeResult:
        """Lay out what varies over what is asked."""
        title = Text.assemble((f"A study of {self._model.name}", "bold"), ("   one or two of its options vary", "dim"))
        yield Static(title, classes="title")
        with Rows():
            for number, group in (("0", "Option that varies"), ("1", "Second option, if two vary")):
                yield Static(group, classes="group")
                yield from self._parameter(number)
            yield Static("Responses", classes="group")
            yield from self._asked()
        yield OptionHelp()
        yield Static("checking ...", id="cost")
        yield KeyLine()

    def _parameter(self, number: str) -> Iterator[Row]:
        around = self._around
        option = card("option", "path of an option of the case, as everywhere; type its beginning, Enter completes it")
        yield TextRow(Held(self.values, (number, "path")), option, around, kind=_OPTION)
        for name, about in (("from", "first value"), ("to", "last value")):
            yield row_for(Held(self.values, (number, name)), self._value_card(number, name, about), around)
        points = card("points", "how many values from the first to the last", kind="integer", default=str(POINTS))
        yield row_for(Held(self.values, (number, "points")), points, around)
        listed = card("or these values", "a list with commas instead of a range: mineral-vg32, mineral-vg68")
        yield row_for(Held(self.values, (number, "values")), listed, around)

    def _value_card(self, number: str, name: str, about: str) -> FieldCard:
        """Return the card of a range's end.

        It takes the units of the option that varies.
        """
        units = card_of(self._draft.root, str(self.values.get((number, "path")) or "")).units
        return card(name, about).model_copy(update={"units": units, "kind": "quantity" if units else "text"})

    def _asked(self) -> Iterator[Row]:
        around = self._around
        mode = card(
            "mode", "equilibria, or runs to convergence: seconds for each point", choices=MODES, default=MODES[0]
        )
        yield row_for(Held(self.values, ("mode",)), mode, around)
        about = (
            f"names with commas, of methods too (METHOD/GROUP/ROW); where nothing is written: {', '.join(self._usual)}"
        )
        responses = card("responses", about, default="the usual ones")
        yield row_for(Held(self.values, ("responses",)), responses, around)
        yield row_for(Held(self.values, ("name",)), card("name", "of the study, and of its folder"), around)

    def on_mount(self) -> None:
        """Take the first row, and check."""
        for row in self.query(Row):
            row.fit(18)
        first = ("0", "from" if self.values.get(("0", "path")) else "path")
        row = next(row for row in self.query(TextRow) if row.place.keys == first)
        self.call_after_refresh(row.query_one(Entry).focus)
        self._check()

    async def on_unmount(self) -> None:
        """End the helper."""
        await self._helper.close()

    # -- rows --

    def on_edited(self, event: Edited) -> None:
        """Check typed values soon.

        Another option brings its own units.
        """
        if event.keys[-1] == "path":
            self._take_units(event.keys[0])
        self.is_fine = False
        if self._timer is not None:
            self._timer.stop()
        self._timer = self.set_timer(_CHECK_AFTER, self._check)

    def _take_units(self, number: str) -> None:
        for row in self.query(TextRow):
            if row.place.keys in ((number, "from"), (number, "to")):
                row.take(self._value_card(number, row.card.name, row.card.description))

    def on_descendant_focus(self, event: events.DescendantFocus) -> None:
        """Say what the row under the keyboard is."""
        row = row_of(event.widget)
        if row is not None:
            self.query_one(OptionHelp).show(row.help())

    def on_row_done(self, event: Row.Done) -> None:
        """Go on to the next row."""
        self.focus_next()

    # -- what it takes --

    def _say(self, text: str) -> None:
        self._tell(text, "dim italic")

    @work(exclusive=True, group="check")
    async def _check(self) -> None:
        study = study_tables(self.values, self._usual)
        if not study["parameters"]:
            self._tell("choose what varies: an option, and its first and last value", "dim")
            return
        try:
            found, fault = await self._helper.ask("study_cost", study=study, case_toml=self._model.case_toml), ""
        except LambdaError as error:
            found, fault = "", str(error)
        if study != study_tables(self.values, self._usual):
            return  # typed on meanwhile: checked again soon
        self.is_fine = not fault
        self._tell(fault or found, self.app.theme_variables["error"] if fault else "")

    def _tell(self, text: str, style: str) -> None:
        self.query_one("#cost", Static).update(Text(text, style=style))

    # -- what comes of it --

    def action_run(self) -> None:
        """Put the study into the queue."""
        if not self.is_fine:
            self.notify("the study has errors or is not checked yet: see below", severity="warning")
            return
        self.app.run_study(study_tables(self.values, self._usual), self._model.case_toml)  # type: ignore[attr-defined]

    def action_save(self) -> None:
        """Write the study into its own file.

        It is in the folder of the case.
        """
        path = self._draft.path
        if path is None or self._draft.is_changed():
            self.notify("a study needs the file of the case: save the case first (Esc, Ctrl+S)", severity="warning")
            return
        study = study_tables(self.values, self._usual) | {"case": path.name}
        target = path.with_name(f"{study['name']}.toml")
        question = AskText("Save the study as", str(target))
        self.app.push_screen(question, lambda text: save_next_to_case(self, study, text, "lambda-bearing study run"))
