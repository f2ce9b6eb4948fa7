"""Fit parameters of the case to measured points."""

from __future__ import annotations

import tomllib
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, ClassVar

from rich.text import Text
from textual import events, work
from textual.app import ComposeResult
from textual.binding import Binding, BindingType
from textual.containers import VerticalScroll
from textual.screen import Screen
from textual.widget import Widget
from textual.widgets import Static

from lambda_core.domain.errors import LambdaError
from lambda_core.domain.wrapping import wrapped
from lambda_core.views.other_units import in_units
from lambda_gui.charts import rows_of
from lambda_gui.dialogs import AskText
from lambda_gui.fields import TextRow
from lambda_gui.footer import KeyLine
from lambda_gui.helper import Helper
from lambda_gui.lifecycle import is_here
from lambda_gui.option_help import OptionHelp
from lambda_gui.places import Held
from lambda_gui.rows import Names, Row, Rows, row_of
from lambda_gui.study_values import Values, card

if TYPE_CHECKING:
    from lambda_core.api import BearingModel, Draft, FitReport, MachineModel
    from lambda_core.domain.unit_systems import UnitSystem

_HINT = (
    "F5 fits the parameters to the measured points of the file. Its first line names the columns with their units: "
    "speed [1/min],radial load [kN],friction torque [N mm],friction torque error [%]"
)
_PARAMETER, _FILE, _BEARING = "parameter", "file", "bearing"
_PARAMETERS = 3  # rows for parameters


class FitScreen(Screen[None]):
    """Form of a fit above its result.

    Parameters
    ----------
    draft : Draft
        The case that is fitted.
    model : BearingModel or MachineModel
        The same, resolved.
    """

    AUTO_FOCUS = "FitScreen Entry"
    BINDINGS: ClassVar[list[BindingType]] = [
        Binding("f1", "app.help", "Help", priority=True),
        Binding("f5,ctrl+r", "fit", "Fit", priority=True),
        Binding("f8", "stop", "Stop", priority=True),
        Binding("ctrl+s", "save", "Save", priority=True),
        Binding("pagedown", "scroll(1)", "Scroll", priority=True),
        Binding("pageup", "scroll(-1)", show=False, priority=True),
        Binding("escape,ctrl+f", "app.pop_screen", "Back", priority=True, key_display="Esc"),
        Binding("down", "app.focus_next", show=False),
        Binding("up", "app.focus_previous", show=False),
    ]
    DEFAULT_CSS = """
    FitScreen { background: $background; }
    FitScreen .title { height: 1; width: 1fr; background: $panel; padding: 0 1; }
    FitScreen Rows { height: auto; max-height: 6; padding: 0 1; }
    FitScreen OptionHelp { height: 3; border-top: hkey $border-blurred; }
    FitScreen #found { height: 1fr; padding: 0 1; border-top: hkey $border-blurred; }
    FitScreen #found Static { width: 1fr; height: auto; }
    FitScreen .row { width: 1fr; }
    """

    def __init__(self, draft: Draft, model: BearingModel | MachineModel) -> None:
        super().__init__()
        self._draft, self._name, self._case = draft, model.name, tomllib.loads(model.case_toml)
        self._bearings = [name for name in model.bearing_models if name]
        folder = draft.path.resolve().parent if draft.path else Path.cwd()
        names = {
            _PARAMETER: _parameters(model),
            _FILE: sorted(path.name for path in folder.glob("*.csv")),
            _BEARING: self._bearings,
        }
        self._folder, self._around = folder, Names(names)
        self.values: Values = {}
        self.report: FitReport | None = None
        self._is_busy = False
        self._helper = Helper(self._say, lambda: is_here(self))

    def compose(self) -> ComposeResult:
        """Lay out what is fitted over what is found."""
        title = Text.assemble((f"A fit of {self._name}", "bold"), ("   parameters from measured points", "dim"))
        yield Static(title, classes="title")
        with Rows():
            yield from self._rows()
        yield OptionHelp()
        with VerticalScroll(id="found", can_focus=False):
            yield Static(Text(_HINT, style="dim"))
        yield KeyLine()

    def _rows(self) -> Iterator[Row]:
        around = self._around
        file = card("data file", "CSV file of measured points; a name alone is in the folder of the case")
        yield TextRow(Held(self.values, ("file",)), file, around, kind=_FILE)
        about = "parameters to fit: type a beginning, Enter completes it; with a range: tau_eyring=3 MPa..10 MPa"
        for number in range(_PARAMETERS):
            one = card(f"parameter {number + 1}", about)
            yield TextRow(Held(self.values, ("vary", str(number))), one, around, kind=_PARAMETER)
        if self._bearings:
            one = card("bearing", "columns and parameters without a name are those of this one")
            yield TextRow(Held(self.values, ("bearing",)), one, around, kind=_BEARING)

    def on_mount(self) -> None:
        """Fit the labels."""
        for row in self.query(Row):
            row.fit(18)

    async def on_unmount(self) -> None:
        """End the helper."""
        await self._helper.close()

    def on_descendant_focus(self, event: events.DescendantFocus) -> None:
        """Say what the row under the keyboard is."""
        row = row_of(event.widget)
        if row is not None:
            self.query_one(OptionHelp).show(row.help())

    def on_row_done(self, event: Row.Done) -> None:
        """Go on to the next row."""
        self.focus_next()

    # -- the fit --

    @property
    def _units(self) -> UnitSystem:
        found: UnitSystem = self.app.units  # type: ignore[attr-defined]
        return found

    def _vary(self) -> list[str]:
        written = [str(self.values.get(("vary", str(number))) or "").strip() for number in range(_PARAMETERS)]
        return [text for text in written if text]

    def action_fit(self) -> None:
        """Fit, unless a fit is going on."""
        if self._is_busy:
            self.notify("a fit is running: F8 stops it and keeps the best values so far", severity="warning")
            return
        name, vary = str(self.values.get(("file",)) or "").strip(), self._vary()
        if not name or not vary:
            what = "data file" if not name else "parameter"
            self.notify(f"a fit needs a data file and a parameter: the {what} is missing", severity="warning")
            return
        self._fit(str(self._folder / Path(name).expanduser()), vary, str(self.values.get(("bearing",)) or "") or None)

    def action_stop(self) -> None:
        """End the fit early.

        It keeps the best values so far.
        """
        if self._is_busy:
            self._say("stopping ...")
            self._helper.interrupt()

    @work(exclusive=True, group="fit")
    async def _fit(self, data: str, vary: list[str], bearing: str | None) -> None:
        self._is_busy, self.report = True, None
        await self._put([Static(Text("fitting ...", style="dim italic"), id="progress")])
        question: dict[str, Any] = {"case": self._case, "data": data, "vary": vary, "bearing": bearing}
        try:
            self.report, text, pictures = await self._helper.ask("fit", **question, units=self._units.name)
        except LambdaError as error:
            await self._put([Static(Text(str(error), style=self.app.theme_variables["error"]))])
            return
        finally:
            self._is_busy = False
        room = self.query_one("#found", VerticalScroll).size
        shown: list[Widget] = [Static(Text("\n".join(wrapped(text.splitlines(), max(40, room.width - 2)))))]
        for view in pictures:
            shown += rows_of(in_units(view, self._units), room.width - 2, max(12, room.height))
        await self._put(shown)

    def _say(self, words: str) -> None:
        for told in self.query("#progress").results(Static):
            told.update(Text(f"{words}   F8 stops and keeps the best values so far", style="dim italic"))

    async def _put(self, widgets: Sequence[Widget]) -> None:
        found = self.query_one("#found", VerticalScroll)
        async with self.batch():
            await found.remove_children()
            if is_here(self):
                await found.mount(*widgets)
                found.scroll_home(animate=False)

    def action_scroll(self, by: int) -> None:
        """Scroll what was found by a screen."""
        found = self.query_one("#found", VerticalScroll)
        found.scroll_relative(y=by * max(1, found.size.height - 1), animate=False)

    # -- the fitted case --

    def action_save(self) -> None:
        """Write the case with the fitted values."""
        if self.report is None:
            self.notify("there are no fitted values yet: F5 fits", severity="warning")
            return
        target = self._folder / f"{self._name}-fitted.toml"
        self.app.push_screen(AskText("Save the fitted case as", str(target)), self._saved)

    def _saved(self, text: str | None) -> None:
        from lambda_core import api

        if text is None or self.report is None:
            return
        path = self._draft.path
        is_file = path is not None and not self._draft.is_changed()
        try:
            target = api.fitted_case(path if is_file and path else self._case, self.report, Path(text).expanduser())
        except LambdaError as error:
            self.notify(str(error), severity="error", timeout=8)
            return
        self.notify(f"saved {target}: Ctrl+O in the builder opens it", timeout=8, markup=False)


def _parameters(model: BearingModel | MachineModel) -> list[str]:
    """Return the laws' parameters with published range.

    They are for completion.
    """
    found: dict[str, None] = {}
    for one in model.bearing_models.values():
        for roles in one.laws.values():
            for role, law in roles.items():
                for name, info in type(law.parameters).model_fields.items():
                    extra = info.json_schema_extra
                    if isinstance(extra, dict) and "published_range" in extra:
                        found[f"parameters.{role}.{name}"] = None
    return sorted(found)
