"""Run the application: screens, files, themes, commands."""

from __future__ import annotations

import gc
from collections.abc import Iterable
from itertools import count
from pathlib import Path
from typing import TYPE_CHECKING, Any, ClassVar

from textual.app import App, SystemCommand
from textual.binding import Binding, BindingType
from textual.screen import Screen

from lambda_core import api
from lambda_core.domain.errors import LambdaError
from lambda_core.domain.unit_systems import SI, UnitSystem
from lambda_gui.builder import BuilderScreen
from lambda_gui.case_files import CaseApp
from lambda_gui.commands import OptionSearch
from lambda_gui.dialogs import Ask
from lambda_gui.runs import open_queue
from lambda_gui.theme import DARK, LIGHT

if TYPE_CHECKING:
    from textual.widget import Widget

    from lambda_core.api import QueuedRun, RunKind
    from lambda_gui.from_catalogue import Kind, Taken

_POLL = 0.2  # how often runs are asked what is new [s]


class BuilderApp(CaseApp):
    """The model builder.

    Parameters
    ----------
    case : str, optional
        Case file or built-in name; without one the builder asks.
    is_alone : bool
        Whether nothing else runs in this process.
    units : UnitSystem
        In which numbers that follow and results are shown; files and forms stay as they are written.
    picture : type of Widget, optional
        What shows a picture file in this terminal; without it views are text charts.
    """

    TITLE = "lambda-bearing"
    COMMANDS: ClassVar[set[Any]] = App.COMMANDS | {OptionSearch}
    BINDINGS: ClassVar[list[BindingType]] = [
        Binding("ctrl+q", "quit", "Quit", show=False, priority=True),
        Binding("f9", "toggle_theme", "Light or dark", show=False),
    ]
    DEFAULT_CSS = """
    Footer { background: $panel; }
    Toast { padding: 0 1; }
    * { scrollbar-size-vertical: 1; }
    """
    CSS = """
    DataTable, DataTable:focus, OptionList:focus, ModelTree:focus, Input:focus { background-tint: $foreground 0%; }
    CommandPalette SearchIcon { display: none; }
    Button, Button.-primary { background: $panel; color: $foreground; text-style: none; }
    Button:focus, Button.-primary:focus { background: $block-cursor-background; color: $block-cursor-foreground;
        text-style: bold; background-tint: $foreground 0%; }
    """

    def __init__(
        self,
        case: str | None = None,
        *,
        is_alone: bool = False,
        units: UnitSystem = SI,
        picture: type[Widget] | None = None,
    ) -> None:
        super().__init__()
        self.units = units
        self.picture = picture
        self._start = case
        self._is_alone = is_alone
        self.queue = open_queue(self._run_ended)

    def on_mount(self) -> None:
        """Show the case, or ask for one."""
        self.register_theme(DARK)
        self.register_theme(LIGHT)
        self.theme = DARK.name
        self.queue.find_earlier()
        self.set_interval(_POLL, self._poll_runs)
        if self._start is None:
            self._open(None, self.action_open_case)
        else:
            self.open(self._start)

    def watch_app_focus(self, focus: bool) -> None:
        """Give the keyboard to a widget.

        This includes a screen that was opened while a browser's page had not got it.

        A key tells so as well as the page does: the page may say that it lost the keyboard and nothing when it is back.
        """
        if focus and self.screen.focused is None:
            self.screen.focus_next()

    def stands(self) -> None:
        """Mark what is loaded as permanent.

        A garbage collection over it stops the picture for 0.1 s.
        """
        if self._is_alone:
            gc.collect()
            gc.freeze()
            self._is_alone = False

    # -- other screens --

    def show_catalogue(self, kind: Kind = "bearing") -> None:
        """Choose a bearing or a lubricant for the case."""
        from lambda_gui.catalogue import CatalogueScreen

        builder = self.builder
        try:
            catalogue = api.catalogue()
        except LambdaError as error:
            self.notify(str(error), severity="error", timeout=12)
            return

        def taken(found: Taken | None) -> None:
            builder.catalogue_changed()
            if found is not None:
                builder.take(found)

        before = builder.draft.get(*builder.bearing, "designation")
        self.push_screen(CatalogueScreen(catalogue, kind, before if isinstance(before, str) else ""), taken)

    def action_help(self) -> None:
        """Explain the screen."""
        from lambda_gui.help import ABOUT, HelpScreen
        from lambda_gui.rows import Row

        name = type(self.screen).__name__
        if name not in ABOUT:
            return  # the help itself, or the command palette, which explains every entry
        row = next((w for w in self.focused.ancestors_with_self if isinstance(w, Row)), None) if self.focused else None
        self.push_screen(HelpScreen(name, row.help() if row is not None else None))

    # -- runs --

    def action_run_case(self) -> None:
        """Run the present case, saved or not.

        A shaft moves with all its bearings.
        """
        self.builder.when_checked(self._run_case)

    def _run_case(self) -> None:
        builder = self.builder
        model = builder.check.model
        if model is None:
            self.notify(builder.what_is_wrong(), severity="warning", timeout=4)
            return
        self._queue_up(model.name, model.case_toml, "run")

    def _queue_up(self, name: str, case_toml: str, kind: RunKind, study_toml: str = "") -> None:
        path = self.builder.draft.path
        folder = path.resolve().parent if path else Path.cwd()
        try:
            run = self.queue.add(name, case_toml, folder, kind, study_toml)
        except LambdaError as error:
            self.notify(str(error), severity="error", timeout=10)
            return
        self.action_runs(run)

    # -- studies --

    def action_study(self) -> None:
        """Set up a study of the case.

        The option under the keyboard is the first that varies.
        """
        self.builder.when_checked(self._set_up_study)

    def _set_up_study(self) -> None:
        from lambda_gui.rows import Row
        from lambda_gui.study_screen import StudyScreen

        builder = self.builder
        model = builder.check.model
        if model is None:
            self.notify(builder.what_is_wrong(), severity="warning", timeout=4)
            return
        row = next((w for w in self.focused.ancestors_with_self if isinstance(w, Row)), None) if self.focused else None
        path, written = "", ""
        if row is not None:
            path, written = ".".join(row.place.keys), row.place.get() or builder.around.resolved(row.place.keys)
        self.push_screen(StudyScreen(builder.draft, model, builder.options(), path, str(written)))

    def action_duty(self) -> None:
        """Set up a duty cycle of the case."""
        self.builder.when_checked(self._set_up_duty)

    def _set_up_duty(self) -> None:
        from lambda_gui.duty_screen import DutyScreen

        builder = self.builder
        model = builder.check.model
        if model is None:
            self.notify(builder.what_is_wrong(), severity="warning", timeout=4)
            return
        width = self.size.width
        self.push_screen(DutyScreen(builder.draft, model.name, model.case_toml, builder.around, width))

    def action_fit_case(self) -> None:
        """Set up a fit of the case to measured points."""
        self.builder.when_checked(self._set_up_fit)

    def _set_up_fit(self) -> None:
        from lambda_gui.fit_screen import FitScreen

        builder = self.builder
        model = builder.check.model
        if model is None:
            self.notify(builder.what_is_wrong(), severity="warning", timeout=4)
            return
        self.push_screen(FitScreen(builder.draft, model))

    def run_study(self, study: dict[str, Any], case_toml: str) -> None:
        """Run a study of a case."""
        import tomlkit

        self._queue_up(str(study["name"]), case_toml, "study", tomlkit.dumps(study))

    def action_runs(self, shown: QueuedRun | None = None) -> None:
        """Show all runs."""
        from lambda_gui.run_screen import RunScreen

        if not isinstance(self.screen, RunScreen):
            self.push_screen(RunScreen(self.queue, shown))

    def _poll_runs(self) -> None:
        if not self.is_running or not self.queue.poll():
            return
        from lambda_gui.run_screen import RunScreen

        if isinstance(self.screen, RunScreen):
            self.screen.follow()
        for screen in self.screen_stack:
            if isinstance(screen, BuilderScreen) and screen.is_mounted and screen.is_here:
                screen.refresh_head()

    def _run_ended(self, run: QueuedRun) -> None:
        severity: Any = {"done": "information", "stopped": "warning", "failed": "error"}[run.state]
        self.notify(f"{run.name}: {run.message}", severity=severity, timeout=6)

    def run_words(self) -> str:
        """Return a text about the active runs."""
        active = self.queue.active
        if not active:
            return ""
        first = active[0]
        words = f"▶ {first.percent:.0f} %" if first.last or first.points else "▶ starting"
        return f"{words} +{len(active) - 1}" if len(active) > 1 else words

    # -- results --

    def action_results(self) -> None:
        """Show the results in the folder of the case."""
        path = self.builder.draft.path
        self.show_result(None, path.resolve().parent if path else Path.cwd())

    def show_result(self, path: Path | None, folder: Path | None = None) -> None:
        """Show one result, or those of a folder."""
        from lambda_gui.results_screen import ResultsScreen

        if path is not None and not path.exists():
            self.notify(f"{path} does not exist yet, or not any more", severity="warning")
            return
        where = folder or (path.parent if path is not None else Path.cwd())
        self.push_screen(ResultsScreen(where, path))

    def save_picture(self) -> None:
        """Write the screen as SVG.

        The file goes into the folder of the case; an existing file is kept.
        """
        from lambda_core.api import save_text

        path = self.builder.draft.path
        folder, stem = (path.resolve().parent, path.stem) if path else (Path.cwd(), "lambda-bearing")
        names = (f"{stem}-screen{'' if number == 1 else f'-{number}'}.svg" for number in count(1))
        target = next(folder / name for name in names if not (folder / name).exists())
        try:
            save_text(self.export_screenshot(title=self.TITLE), target)
        except LambdaError as error:
            self.notify(str(error), severity="error", timeout=10)
        else:
            self.notify(f"wrote {target}", timeout=6, markup=False)

    def action_toggle_theme(self) -> None:
        """Change between light and dark."""
        self.theme = LIGHT.name if self.theme == DARK.name else DARK.name

    async def action_quit(self) -> None:
        """Leave when everything is saved or given up."""
        self.unless_unsaved(self._unless_running)

    def _unless_running(self) -> None:
        active = self.queue.active
        waiting = [run for run in active if run.state == "waiting"]
        if not active:
            self.leave()
            return

        def answered(answer: str | None) -> None:
            if answer == "stop them":
                for run in active:
                    run.cancel()
            if answer in ("stop them", "let them go on"):
                self.leave()

        going = len(active) - len(waiting)
        text = f"{going} run{'s' * (going != 1)} going on, {len(waiting)} waiting (these would not be started)."
        self.push_screen(Ask(text, ["let them go on", "stop them", "go back"]), answered)

    def leave(self) -> None:
        """End the builder."""
        self.builder.keeper.drop()
        self.queue.close()
        self.exit()

    def get_system_commands(self, screen: Screen[Any]) -> Iterable[SystemCommand]:
        """Return the commands of the palette.

        They come in addition to the options of the case.
        """
        yield SystemCommand("Open a case", "a file, a built-in case, or an empty model", self.action_open_case)
        yield SystemCommand("Save", "write the case to its file", self.save_case)
        yield SystemCommand("Save as", "write the case to another file", self.action_save_as)
        yield SystemCommand("Run", "run the present case", self.action_run_case)
        yield SystemCommand("Runs", "the queue and live traces", self.action_runs)
        yield SystemCommand("Study", "let one or two options of the case vary", self.action_study)
        yield SystemCommand("Duty cycle", "life and losses over phases of the case", self.action_duty)
        yield SystemCommand("Fit", "parameters of the case from measured points", self.action_fit_case)
        yield SystemCommand("Answers", "equilibrium, temperatures, currents, friction of the case without a run",
                            lambda: self.builder.action_answers())  # fmt: skip
        yield SystemCommand("Results", "summary, views, comparison, export", self.action_results)
        yield SystemCommand("Catalogue of bearings", "choose one for the case", self.show_catalogue)
        yield SystemCommand(
            "Catalogue of lubricants", "choose one for the case", lambda: self.show_catalogue("lubricant")
        )
        yield SystemCommand("Undo", "take the last change back", lambda: self.builder.action_undo())
        yield SystemCommand("Light or dark", "change the colours", self.action_toggle_theme)
        yield SystemCommand("Themes", "choose among all colour themes", self.search_themes)
        yield SystemCommand("Picture of the screen", "write the screen into an SVG file", self.save_picture)
        yield SystemCommand("Help", "keys, axes and signs", self.action_help)
        yield SystemCommand("Quit", "leave the builder", self.action_quit)


def main(case: str | None = None, units: UnitSystem = SI) -> None:
    """Run the builder in this terminal."""
    from lambda_gui.pictures import picture_widget

    BuilderApp(case, is_alone=True, units=units, picture=picture_widget()).run()
